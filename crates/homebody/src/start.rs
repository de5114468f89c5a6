//! The start of a run.

use crate::failure::Failure;
use homebody_core::time::RunTime;
use homebody_simulation::OpenScenario;
use jiff::Timestamp;
use jiff::civil::{Date, DateTime, Time};
use jiff::tz::TimeZone;
use std::str::FromStr;

/// A date and time on the clock of the home.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StartTime {
    /// The current second.
    Now,
    /// The last midnight.
    Today,
    At(DateTime),
}

impl FromStr for StartTime {
    type Err = String;

    fn from_str(text: &str) -> Result<StartTime, String> {
        match text {
            "now" => return Ok(StartTime::Now),
            "today" => return Ok(StartTime::Today),
            _ => {}
        }
        let date = text.parse::<Date>().map(|date| date.to_datetime(Time::midnight()));
        let is_plain = text.bytes().all(|byte| byte.is_ascii_digit() || b"-:T ".contains(&byte));
        let at = if text.len() > 10 { text.parse::<DateTime>() } else { date };
        match at {
            Ok(at) if is_plain => Ok(StartTime::At(at)),
            _ => Err("not a date and time\n  hint: write now, today, 2026-11-01 or 2026-11-01T08:00".into()),
        }
    }
}

impl StartTime {
    /// The scenario with this start.
    pub fn of(self, scenario: &OpenScenario) -> Result<OpenScenario, Failure> {
        let zone = scenario.scenario().calendar.local(RunTime::START).time_zone().clone();
        Ok(scenario.starting(self.on_clock(&zone))?)
    }

    fn on_clock(self, zone: &TimeZone) -> String {
        let now = || Timestamp::now().to_zoned(zone.clone()).datetime();
        let at = match self {
            StartTime::Now => now(),
            StartTime::Today => now().date().to_datetime(Time::midnight()),
            StartTime::At(at) => at,
        };
        at.strftime("%Y-%m-%dT%H:%M:%S").to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_start_is_a_date_a_date_and_time_or_now() {
        let on_clock = |text: &str| text.parse::<StartTime>().map(|start| start.on_clock(&TimeZone::UTC));
        assert_eq!(on_clock("2026-11-01").unwrap(), "2026-11-01T00:00:00");
        assert_eq!(on_clock("2026-11-01T08:05").unwrap(), "2026-11-01T08:05:00");
        assert_eq!(on_clock("2026-11-01 08:05:09").unwrap(), "2026-11-01T08:05:09");
        assert!(on_clock("today").unwrap().ends_with("T00:00:00"));
        for wrong in ["tomorrow", "2026-13-01", "08:00", "2026-11-01T08:00:00Z", "2026-11-01T25:00"] {
            assert!(on_clock(wrong).is_err(), "{wrong}");
        }
    }
}
