//! A simulated person, measured in the ground truth and in the firings.

use super::nights::nights;
use super::{DailyFigures, NightlyFigures, PersonRecord, SensingFigures};
use homebody_timeline::Episode;
use serde::Serialize;

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PersonFigures {
    pub nights: NightlyFigures,
    pub days: DailyFigures,
    pub sensing: SensingFigures,
}

impl PersonFigures {
    pub fn measure(lived: &PersonRecord) -> PersonFigures {
        let done = lived.timeline.activities.iter().filter(|one| !one.time.is_empty());
        let activities: Vec<Episode> = done.cloned().collect();
        let moves = lived.moves();
        let nights = nights(lived, &activities, &moves);
        PersonFigures {
            nights: NightlyFigures::measure(&nights, &activities),
            days: DailyFigures::measure(lived, &activities, &moves),
            sensing: SensingFigures::measure(lived),
        }
    }
}
