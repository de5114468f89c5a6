//! DayHours of the day on the clock on the wall, over the days of a log or a run.

use homebody_core::time::{ClockChange, DAY, Interval, MINUTE, Span, TimePoint, joined};
use std::fmt;
use std::str::FromStr;

/// A part of each day in minutes; over midnight where the first is later.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DayHours {
    from_min: u32,
    to_min: u32,
}

/// A day by the clock on the wall, in instants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SearchDay<T> {
    pub begin: T,
    pub end: T,
    /// The time of day at its start: the first day of a run may begin at noon.
    pub clock: Span,
    /// The change of the clocks in it, if there is one.
    pub turn: Option<ClockChange<T>>,
}

homebody_core::messages! {
    /// Problems with hours of the day.
    #[derive(Clone, PartialEq, Eq)]
    pub enum HoursMessage in "hours" {
        /// DayHours are two times of day with a hyphen between, from 0 to 24. The second may be on the next day: `22-6` is the night.
        NotHours { text: String } error "not-hours" ("{text:?} is not a range of hours")
            hint ("write two times of day, such as 0-6, 22-6 or 08:30-20:00");
    }
}

const DAY_MIN: u32 = 24 * 60;

impl DayHours {
    /// From a minute of the day to another; `None` if one is out of range, or both are equal.
    pub fn new(from_min: u32, to_min: u32) -> Option<DayHours> {
        let is_day = from_min < DAY_MIN && to_min <= DAY_MIN && from_min != to_min;
        is_day.then_some(DayHours { from_min, to_min })
    }

    /// The times between these hours, in order; one over midnight is one interval.
    pub fn over<T: TimePoint>(self, days: &[SearchDay<T>]) -> Vec<Interval<T>> {
        let [from, to] = [self.from_min, self.to_min].map(|minutes| i64::from(minutes) * MINUTE);
        let pieces = if from < to { vec![(from, to)] } else { vec![(Span::ZERO, to), (from, DAY)] };
        let mut all: Vec<Interval<T>> = Vec::new();
        for day in days {
            let at = |clock: Span, turned: Span| day.begin + clock - day.clock - turned;
            // Before clocks are set, and after.
            let parts = match day.turn {
                None => vec![(Interval::new(day.begin, day.end), Span::ZERO)],
                Some(ClockChange { at, by }) => {
                    vec![(Interval::new(day.begin, at), Span::ZERO), (Interval::new(at, day.end), by)]
                }
            };
            let mut of_day: Vec<Interval<T>> = Vec::new();
            for (part, turned) in parts {
                let of_part = pieces.iter().map(|&(from, to)| Interval::new(at(from, turned), at(to, turned)));
                of_day.extend(of_part.map(|piece| piece.intersection(part)).filter(|piece| !piece.is_empty()));
            }
            of_day.sort_unstable();
            all.extend(of_day);
        }
        joined(all, Span::ZERO)
    }
}

impl FromStr for DayHours {
    type Err = HoursMessage;

    fn from_str(text: &str) -> Result<DayHours, HoursMessage> {
        let minutes = |text: &str| {
            let (hours, minutes) = text.trim().split_once(':').unwrap_or((text.trim(), "0"));
            let (hours, minutes): (u32, u32) = (hours.parse().ok()?, minutes.parse().ok()?);
            (hours <= 24 && minutes < 60).then_some(hours * 60 + minutes)
        };
        let hours = text.split_once('-').and_then(|(from, to)| DayHours::new(minutes(from)? % DAY_MIN, minutes(to)?));
        hours.ok_or_else(|| HoursMessage::NotHours { text: text.to_owned() })
    }
}

impl fmt::Display for DayHours {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        let clock = |minutes: u32| format!("{:02}:{:02}", minutes / 60, minutes % 60);
        write!(formatter, "{}-{}", clock(self.from_min), clock(self.to_min))
    }
}
