//! Hours of the day on the clock on the wall, over the days of a log or a run.

use homebody_analysis::measures::{Span, joined};
use homebody_core::time::{DAY, Micros, SECOND};
use std::fmt;
use std::str::FromStr;

/// A minute.
pub const MINUTE: Micros = 60 * SECOND;

/// From which minute of the day to which; over midnight where the first is later.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hours {
    from_min: u32,
    to_min: u32,
}

/// A day by the clock on the wall, in instants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DayClock {
    /// When it begins.
    pub begin: Micros,
    /// When it ends.
    pub end: Micros,
    /// What the clock shows when it begins, since midnight: the first day of a run may begin at noon.
    pub clock: Micros,
    /// When clocks are set in it, and by how much.
    pub turn: Option<(Micros, Micros)>,
}

homebody_core::messages! {
    /// Problems with hours of the day.
    #[derive(Clone, PartialEq, Eq)]
    pub enum HoursMessage in "hours" {
        /// Hours are two times of day with a hyphen between, from 0 to 24. The second may be on the next day: `22-6` is the night.
        NotHours {
            /// The text.
            text: String,
        } error "not-hours" ("{text:?} is not a range of hours")
            hint ("write two times of day, such as 0-6, 22-6 or 08:30-20:00");
    }
}

const DAY_MIN: u32 = 24 * 60;

impl Hours {
    /// From a minute of the day to another; `None` where one is none, or both are the same.
    pub fn new(from_min: u32, to_min: u32) -> Option<Hours> {
        let is_day = from_min < DAY_MIN && to_min <= DAY_MIN && from_min != to_min;
        is_day.then_some(Hours { from_min, to_min })
    }

    /// When it is between these hours, in order; what goes on over midnight is one.
    pub fn over(self, days: &[DayClock]) -> Vec<Span> {
        let [from, to] = [self.from_min, self.to_min].map(|minutes| Micros::from(minutes) * MINUTE);
        let pieces = if from < to { vec![(from, to)] } else { vec![(0, to), (from, DAY)] };
        let mut all: Vec<Span> = Vec::new();
        for day in days {
            let at = |clock: Micros, turned: Micros| day.begin + clock - day.clock - turned;
            // Before clocks are set, and after.
            let parts = match day.turn {
                None => vec![((day.begin, day.end), 0)],
                Some((turn, by)) => vec![((day.begin, turn), 0), ((turn, day.end), by)],
            };
            let mut of_day: Vec<Span> = Vec::new();
            for ((begin, end), turned) in parts {
                let spans = pieces.iter().map(|&(from, to)| (at(from, turned).max(begin), at(to, turned).min(end)));
                of_day.extend(spans.filter(|(begin, end)| begin < end));
            }
            of_day.sort_unstable();
            all.extend(of_day);
        }
        joined(all.into_iter(), 0)
    }
}

impl FromStr for Hours {
    type Err = HoursMessage;

    fn from_str(text: &str) -> Result<Hours, HoursMessage> {
        let minutes = |text: &str| {
            let (hours, minutes) = text.trim().split_once(':').unwrap_or((text.trim(), "0"));
            let (hours, minutes): (u32, u32) = (hours.parse().ok()?, minutes.parse().ok()?);
            (hours <= 24 && minutes < 60).then_some(hours * 60 + minutes)
        };
        let hours = text.split_once('-').and_then(|(from, to)| Hours::new(minutes(from)? % DAY_MIN, minutes(to)?));
        hours.ok_or_else(|| HoursMessage::NotHours { text: text.to_owned() })
    }
}

impl fmt::Display for Hours {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        let clock = |minutes: u32| format!("{:02}:{:02}", minutes / 60, minutes % 60);
        write!(formatter, "{}-{}", clock(self.from_min), clock(self.to_min))
    }
}

/// The parts of a span that lie in spans in order; what has no length is in them or not.
pub fn cut((begin, end): Span, within: &[Span]) -> Vec<Span> {
    let first = within.partition_point(|span| span.1 <= begin);
    let touching = within[first..].iter().take_while(|span| span.0 < end || span.0 <= begin);
    let parts = touching.map(|span| (begin.max(span.0), end.min(span.1)));
    parts.filter(|part| part.0 < part.1 || begin == end).collect()
}

/// What two lists of spans in order have in common.
pub fn intersected(spans: &[Span], others: &[Span]) -> Vec<Span> {
    let mut all = Vec::new();
    let (mut i, mut j) = (0, 0);
    while let (Some(one), Some(other)) = (spans.get(i), others.get(j)) {
        let (begin, end) = (one.0.max(other.0), one.1.min(other.1));
        if begin < end {
            all.push((begin, end));
        }
        match one.1 < other.1 {
            true => i += 1,
            false => j += 1,
        }
    }
    all
}
