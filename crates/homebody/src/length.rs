//! Durations: days by the calendar, hours and less by the clock.

use homebody_core::calendar::Calendar;
use homebody_core::time::{LONGEST, Span};

/// The length of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Length {
    /// Days of the local time of the home: one with a clock change has 23 or 25 hours.
    Days(f64),
    Time(Span),
}

impl Length {
    /// The duration from the start of a run, by its calendar.
    pub fn by(self, calendar: &Calendar) -> Span {
        match self {
            Length::Time(span) => span,
            Length::Days(days) => calendar.span_of_days(days),
        }
    }
}

pub fn length(text: &str) -> Result<Length, String> {
    let (number, unit) = parts(text)?;
    match unit {
        "d" => span(text).map(|_| Length::Days(number)),
        "w" => span(text).map(|_| Length::Days(number * 7.0)),
        _ => span(text).map(Length::Time),
    }
}

/// A duration, in which all days have 24 hours.
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

/// A number and a known unit.
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
    fn spans_are_read_as_people_write_them() {
        assert_eq!(span("90s"), Ok(90 * SECOND));
        assert_eq!(span("1.5h"), Ok(3 * HOUR / 2));
        assert_eq!(span("7d"), Ok(7 * DAY));
        assert_eq!(length("7d"), Ok(Length::Days(7.0)));
        assert_eq!(length("1.5w"), Ok(Length::Days(10.5)));
        assert_eq!(length("48h"), Ok(Length::Time(2 * DAY)));
        for wrong in ["", "7", "d", "-1d", "0s", "NaNd", "7 days", "1e9d", "infd", "1e-9s"] {
            assert!(span(wrong).is_err() && length(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn days_end_at_the_hour_at_which_they_began() {
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
            let length = Length::Days(days).by(&calendar);
            let end = RunTime::START + length;
            assert_eq!(length, hours * HOUR, "{days} days from {start} in {zone}");
            assert_eq!(calendar.local(end).time(), calendar.local(RunTime::START).time());
            assert_eq!(calendar.days_lived(end), days);
            assert_eq!(Length::Time(Span::from_days(days)).by(&calendar), Span::from_days(days));
        }
    }

    #[test]
    fn a_day_whose_end_the_clock_skips_or_shows_twice_ends_once() {
        let skipped = Calendar::new("2009-03-07T02:30:00", "America/Chicago").unwrap();
        let end = RunTime::START + Length::Days(1.0).by(&skipped);
        assert_eq!(skipped.local(end).to_string(), "2009-03-08T03:30:00-05:00[America/Chicago]");
        let twice = Calendar::new("2009-10-31T01:30:00", "America/Chicago").unwrap();
        assert_eq!(Length::Days(1.0).by(&twice), 24 * HOUR);
        assert_eq!(Length::Days(2.0).by(&twice), 49 * HOUR);
    }

    #[test]
    fn parts_of_days_are_parts_of_the_day_that_it_is() {
        let calendar = Calendar::new("2009-03-07T00:00:00", "America/Chicago").unwrap();
        assert_eq!(Length::Days(0.5).by(&calendar), 12 * HOUR);
        assert_eq!(Length::Days(1.5).by(&calendar), 24 * HOUR + 23 * HOUR / 2);
        for days in [0.0, 0.01, 0.5, 1.0, 1.5, 2.25, 239.75] {
            let lived = calendar.days_lived(RunTime::START + Length::Days(days).by(&calendar));
            assert!((lived - days).abs() < 1e-9, "{days} but {lived}");
        }
        let noon = Calendar::new("2009-03-07T12:00:00", "America/Chicago").unwrap();
        assert_eq!(noon.days_lived(RunTime::START + 6 * HOUR), 6.0 / 23.0);
        assert_eq!(noon.days_lived(RunTime::START + 13 * HOUR), 13.0 / 23.0);
    }
}
