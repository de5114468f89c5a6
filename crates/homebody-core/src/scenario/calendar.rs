//! Local time at the edges: the world itself knows only microseconds since the start.

use crate::time::Micros;
use jiff::civil::DateTime;
use jiff::tz::{TimeZone, TimeZoneDatabase};
use jiff::{SignedDuration, Timestamp, Zoned};

/// Ties a run's microseconds to the clock on the wall of the home.
#[derive(Clone, Debug, PartialEq)]
pub struct Calendar {
    start: Zoned,
}

impl Calendar {
    /// The calendar of a scenario's `start` and `time_zone`, or the reason why there is none.
    pub fn new(start: &str, time_zone: &str) -> Result<Calendar, String> {
        let zone = Calendar::zone(time_zone)?;
        let start: DateTime =
            start.parse().map_err(|_| format!("{start:?} is no date and time; write it as 2009-03-02T00:00:00"))?;
        let start = start.to_zoned(zone).map_err(|error| error.to_string())?;
        Ok(Calendar { start })
    }

    /// A time zone of the bundled database.
    pub fn zone(name: &str) -> Result<TimeZone, String> {
        TimeZoneDatabase::bundled()
            .get(name)
            .map_err(|_| format!("there is no time zone {name:?}; write an IANA name such as America/Chicago"))
    }

    /// The instant on the world's clock.
    pub fn timestamp(&self, at: Micros) -> Timestamp {
        self.start.timestamp() + SignedDuration::from_micros(at)
    }

    /// The instant on the clock on the wall.
    pub fn local(&self, at: Micros) -> Zoned {
        self.timestamp(at).to_zoned(self.start.time_zone().clone())
    }

    /// The run's microseconds at an instant of the world's clock.
    pub fn micros(&self, at: Timestamp) -> Micros {
        at.as_microsecond() - self.start.timestamp().as_microsecond()
    }
}
