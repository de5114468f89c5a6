use homebody_core::calendar::Calendar;
use homebody_core::home::Home;
use homebody_core::random::Stream;
use homebody_core::time::{DAY, HOUR, RunTime, Span};
use homebody_walk::places::HomePlaces;
use homebody_walk::{Gains, Mesh};
use std::sync::Arc;

#[derive(Debug)]
pub struct Cast {
    pub home: Arc<Home>,
    pub places: Arc<HomePlaces>,
    pub mesh: Arc<Mesh>,
    pub calendar: Calendar,
    /// By resident id.
    pub names: Vec<String>,
    pub name: String,
    pub pace_mps: f64,
    pub gains: Gains,
    pub seed: u64,
}

impl Cast {
    /// From 0 to 24.
    pub fn hour(&self, now: RunTime) -> f64 {
        let midnight = self.calendar.instant(self.calendar.day(now), Span::ZERO);
        (now - midnight).ratio(HOUR).clamp(0.0, DAY.ratio(HOUR))
    }

    pub(crate) fn stream(&self, name: &str) -> Stream {
        Stream::named(self.seed, &format!("script/{}/{name}", self.name))
    }
}
