//! The length of a run: days by the calendar of the home, hours and less by the clock.

use crate::error::SimulationError;
use homebody_core::calendar::Calendar;
use homebody_core::time::{DAY, LONGEST, Span};
use serde::Deserialize;
use std::str::FromStr;

/// The length of a run. As a text it has a unit, such as `90s`, `2h` or `7d`; in JSON it is a number of days.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(from = "f64")]
pub enum RunLength {
    /// Days of the home's time zone: one on which clocks change has 23 or 25 hours.
    Days(f64),
    /// A span of time.
    Span(Span),
}

impl From<f64> for RunLength {
    fn from(days: f64) -> RunLength {
        RunLength::Days(days)
    }
}

impl FromStr for RunLength {
    type Err = String;

    fn from_str(text: &str) -> Result<RunLength, String> {
        let (number, unit) = parts(text)?;
        let span = span(text)?;
        Ok(match unit {
            "d" => RunLength::Days(number),
            "w" => RunLength::Days(number * 7.0),
            _ => RunLength::Span(span),
        })
    }
}

impl RunLength {
    /// The span from the start of a run on, by its calendar.
    ///
    /// # Errors
    ///
    /// [`SimulationError::Length`] unless it is longer than 0 and at most 100 years.
    pub fn span(self, calendar: &Calendar) -> Result<Span, SimulationError> {
        let days = match self {
            RunLength::Days(days) => days,
            RunLength::Span(span) => span.ratio(DAY),
        };
        let wrong = SimulationError::Length { days };
        if !(days > 0.0 && days <= (LONGEST / DAY) as f64) {
            return Err(wrong);
        }
        let span = match self {
            RunLength::Days(days) => calendar.span_of_days(days),
            RunLength::Span(span) => span,
        };
        if span > Span::ZERO { Ok(span) } else { Err(wrong) }
    }
}

/// A span of time with its unit, in which all days have 24 hours.
///
/// # Errors
///
/// The expected form, as a sentence.
pub fn span(text: &str) -> Result<Span, String> {
    let (number, unit) = parts(text)?;
    let unit = match unit {
        "s" => 1.0,
        "m" | "min" => 60.0,
        "h" => 3600.0,
        "d" => 86_400.0,
        _ => 604_800.0,
    };
    let span = Span::from_seconds(number * unit);
    let is_span = span > Span::ZERO && span <= LONGEST;
    is_span.then_some(span).ok_or_else(|| "a duration is longer than 0 and at most 100 years".into())
}

fn parts(text: &str) -> Result<(f64, &str), String> {
    let (number, unit) = text.split_at(text.trim_end_matches(|c: char| c.is_ascii_alphabetic()).len());
    if !["s", "m", "min", "h", "d", "w"].contains(&unit) {
        return Err("write a number with its unit: 90s, 15m, 2h, 7d or 52w".into());
    }
    let number = number.parse().map_err(|_| "write one number with its unit: 90s, 15m, 2h, 7d or 52w")?;
    Ok((number, unit))
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::{DAY, HOUR, RunTime, SECOND};

    #[test]
    fn reads_lengths_with_their_units() {
        assert_eq!(span("90s"), Ok(90 * SECOND));
        assert_eq!(span("1.5h"), Ok(3 * HOUR / 2));
        assert_eq!(span("7d"), Ok(7 * DAY));
        assert_eq!("7d".parse(), Ok(RunLength::Days(7.0)));
        assert_eq!("1.5w".parse(), Ok(RunLength::Days(10.5)));
        assert_eq!("48h".parse(), Ok(RunLength::Span(2 * DAY)));
        for wrong in ["", "7", "d", "-1d", "0s", "NaNd", "7 days", "1e9d", "infd", "1e-9s"] {
            assert!(span(wrong).is_err() && wrong.parse::<RunLength>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn days_end_at_the_hour_of_their_start() {
        // Clocks go forward on 2009-03-08 in Chicago and on 03-29 in Berlin, back on 11-01 and 10-25.
        for (zone, start, days, hours) in [
            ("America/Chicago", "2009-03-02T00:00:00", 60.0, 60 * 24 - 1),
            ("America/Chicago", "2009-10-02T18:30:00", 60.0, 60 * 24 + 1),
            ("America/Chicago", "2009-03-07T12:00:00", 1.0, 23),
            ("America/Chicago", "2009-10-31T12:00:00", 1.0, 25),
            ("Europe/Berlin", "2009-03-02T00:00:00", 60.0, 60 * 24 - 1),
            ("Europe/Berlin", "2009-10-02T00:00:00", 60.0, 60 * 24 + 1),
            ("Europe/Berlin", "2009-03-02T00:00:00", 365.0, 365 * 24),
            ("UTC", "2009-03-02T00:00:00", 60.0, 60 * 24),
        ] {
            let calendar = Calendar::new(start, zone).unwrap();
            let length = RunLength::Days(days).span(&calendar).unwrap();
            let end = RunTime::START + length;
            assert_eq!(length, hours * HOUR, "{days} days from {start} in {zone}");
            assert_eq!(calendar.local(end).time(), calendar.local(RunTime::START).time());
            assert_eq!(calendar.days_lived(end), days);
            assert_eq!(RunLength::Span(Span::from_days(days)).span(&calendar).unwrap(), Span::from_days(days));
        }
    }

    #[test]
    fn a_day_with_a_skipped_or_repeated_end_ends_once() {
        let skipped = Calendar::new("2009-03-07T02:30:00", "America/Chicago").unwrap();
        let end = RunTime::START + RunLength::Days(1.0).span(&skipped).unwrap();
        assert_eq!(skipped.local(end).to_string(), "2009-03-08T03:30:00-05:00[America/Chicago]");
        let twice = Calendar::new("2009-10-31T01:30:00", "America/Chicago").unwrap();
        assert_eq!(RunLength::Days(1.0).span(&twice).unwrap(), 24 * HOUR);
        assert_eq!(RunLength::Days(2.0).span(&twice).unwrap(), 49 * HOUR);
    }

    #[test]
    fn parts_of_days_are_parts_of_their_day() {
        let calendar = Calendar::new("2009-03-07T00:00:00", "America/Chicago").unwrap();
        assert_eq!(RunLength::Days(0.5).span(&calendar).unwrap(), 12 * HOUR);
        assert_eq!(RunLength::Days(1.5).span(&calendar).unwrap(), 24 * HOUR + 23 * HOUR / 2);
        for days in [0.01, 0.5, 1.0, 1.5, 2.25, 239.75] {
            let lived = calendar.days_lived(RunTime::START + RunLength::Days(days).span(&calendar).unwrap());
            assert!((lived - days).abs() < 1e-9, "{days} but {lived}");
        }
        let noon = Calendar::new("2009-03-07T12:00:00", "America/Chicago").unwrap();
        assert_eq!(noon.days_lived(RunTime::START + 6 * HOUR), 6.0 / 23.0);
        assert_eq!(noon.days_lived(RunTime::START + 13 * HOUR), 13.0 / 23.0);
    }
}
