//! Times and parts of the day.

use super::amounts::{ABOUT, DAY_S};
use super::clock::clock;
use super::messages::TimeSentenceMessage;
use super::reader::SentenceReader;
use crate::routine::PartOfDay;
use homebody_core::fuzzy::Fuzzy;

/// How far "about" a time of day reaches, in seconds.
pub const ABOUT_TIME_S: f64 = 20.0 * 60.0;
/// How far a time of day said without "about" reaches.
pub const PLAIN_TIME_S: f64 = 5.0 * 60.0;

const HOUR_S: f64 = 3600.0;

pub const PARTS: [(&str, PartOfDay); 8] = [
    ("morning|mornings", PartOfDay::Morning),
    ("noon|midday", PartOfDay::Noon),
    ("lunchtime", PartOfDay::Noon),
    ("afternoon|afternoons", PartOfDay::Afternoon),
    ("evening|evenings", PartOfDay::Evening),
    ("night|nights", PartOfDay::Night),
    ("daytime", PartOfDay::Day),
    ("day", PartOfDay::Day),
];

/// A time of day, about or plainly: seconds since midnight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeOfDay {
    pub at: f64,
    pub about: bool,
}

impl TimeOfDay {
    pub fn fuzzy(self) -> Fuzzy {
        Fuzzy::around(self.at, if self.about { ABOUT_TIME_S } else { PLAIN_TIME_S })
    }
}

pub fn time(reader: &mut SentenceReader, bare: bool) -> Option<TimeOfDay> {
    time_after(reader, bare, None)
}

fn time_after(reader: &mut SentenceReader, bare: bool, begin: Option<f64>) -> Option<TimeOfDay> {
    reader.attempt(|reader| {
        let about = reader.eat_any(&ABOUT).is_some();
        reader.eat("exactly");
        Some(TimeOfDay { at: clock(reader, bare, begin)?, about })
    })
}

pub fn time_range(reader: &mut SentenceReader, between: &str) -> Option<(TimeOfDay, TimeOfDay)> {
    reader.attempt(|reader| {
        let (start, faults) = (reader.at, reader.faults.count());
        let from = time(reader, true)?;
        if !reader.eat(between) {
            return None;
        }
        let mut to = time_after(reader, true, Some(from.at))?;
        /// Earliest time at which an activity ends that begins later on the same clock (our choice): "9:30 to 3:30".
        const EARLY_S: f64 = 7.0 * HOUR_S;
        if to.at < EARLY_S && from.at < DAY_S / 2.0 && to.at < from.at {
            to.at += DAY_S / 2.0;
        } else if is_of_next_day(to.at, from.at) {
            to.at += DAY_S;
        } else if to.at <= from.at {
            if reader.faults.count() == faults {
                let span = reader.span(start);
                reader.fault(span, TimeSentenceMessage::ReversedTimes { text: reader.said(span) });
            }
            to.at = from.at;
        }
        Some((from, to))
    })
}

pub fn is_of_next_day(end: f64, begin: f64) -> bool {
    /// Start of the afternoon, and end of the morning (our choice).
    const LATE_S: f64 = 15.0 * HOUR_S;
    const EARLY_S: f64 = 9.0 * HOUR_S;
    end <= begin && (begin >= DAY_S || begin >= LATE_S && end <= EARLY_S)
}
