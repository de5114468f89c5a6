//! The start of a run: a date and time on the clock of the home.

use crate::error::SimulationError;
use crate::open_scenario::OpenScenario;
use homebody_core::time::RunTime;
use jiff::Timestamp;
use jiff::civil::{Date, DateTime, Time};
use jiff::tz::TimeZone;
use serde::{Deserialize, Deserializer};
use std::fmt;
use std::str::FromStr;

/// The start of a run. In JSON it is a text, and the scenario checks its date and time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RunStart {
    /// The present second.
    Now,
    /// The midnight before it.
    Today,
    /// A date and time, such as `2026-11-01T08:00:00`.
    At(String),
}

impl<'de> Deserialize<'de> for RunStart {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<RunStart, D::Error> {
        String::deserialize(from).map(RunStart::unchecked)
    }
}

/// Reads it as users write it: a date alone means midnight, and seconds may be missing.
impl FromStr for RunStart {
    type Err = String;

    fn from_str(text: &str) -> Result<RunStart, String> {
        match RunStart::unchecked(text.to_owned()) {
            RunStart::At(_) => {}
            known => return Ok(known),
        }
        let date = text.parse::<Date>().map(|date| date.to_datetime(Time::midnight()));
        let is_plain = text.bytes().all(|byte| byte.is_ascii_digit() || b"-:T ".contains(&byte));
        let at = if text.len() > 10 { text.parse::<DateTime>() } else { date };
        match at {
            Ok(at) if is_plain => Ok(RunStart::At(written(at))),
            _ => Err("not a date and time\n  hint: write now, today, 2026-11-01 or 2026-11-01T08:00".into()),
        }
    }
}

impl fmt::Display for RunStart {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            RunStart::Now => "now",
            RunStart::Today => "today",
            RunStart::At(at) => at,
        })
    }
}

impl RunStart {
    /// An implementation of `From` would make clap use it in place of `FromStr`, which checks the text.
    fn unchecked(text: String) -> RunStart {
        match text.as_str() {
            "now" => RunStart::Now,
            "today" => RunStart::Today,
            _ => RunStart::At(text),
        }
    }

    /// The scenario with this start.
    ///
    /// # Errors
    ///
    /// [`SimulationError::Problems`] without such a date and time.
    pub fn in_scenario(&self, scenario: &OpenScenario) -> Result<OpenScenario, SimulationError> {
        let zone = scenario.scenario().calendar.local(RunTime::START).time_zone().clone();
        scenario.starting(self.on_clock(&zone))
    }

    fn on_clock(&self, zone: &TimeZone) -> String {
        let now = || Timestamp::now().to_zoned(zone.clone()).datetime();
        match self {
            RunStart::Now => written(now()),
            RunStart::Today => written(now().date().to_datetime(Time::midnight())),
            RunStart::At(at) => at.clone(),
        }
    }
}

fn written(at: DateTime) -> String {
    at.strftime("%Y-%m-%dT%H:%M:%S").to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_dates_times_and_now() {
        let on_clock = |text: &str| text.parse::<RunStart>().map(|start| start.on_clock(&TimeZone::UTC));
        assert_eq!(on_clock("2026-11-01").unwrap(), "2026-11-01T00:00:00");
        assert_eq!(on_clock("2026-11-01T08:05").unwrap(), "2026-11-01T08:05:00");
        assert_eq!(on_clock("2026-11-01 08:05:09").unwrap(), "2026-11-01T08:05:09");
        assert!(on_clock("today").unwrap().ends_with("T00:00:00"));
        for wrong in ["tomorrow", "2026-13-01", "08:00", "2026-11-01T08:00:00Z", "2026-11-01T25:00"] {
            assert!(on_clock(wrong).is_err(), "{wrong}");
        }
    }
}
