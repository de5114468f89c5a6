//! A measured life, and the result of one field of a statement.

use super::deeds::Deed;
use crate::claims::{ClaimTruth, Occurrence, Subject};
use homebody_core::calendar::Calendar;
pub use homebody_core::time::MINUTE;
use homebody_core::time::{HOUR, Interval, RunTime, Span};

/// Largest delay of an activity that is still in time, in minutes (our choice): the previous one is finished first, and a walk follows.
pub const GRACE_MIN: f64 = 15.0;

/// Largest time that an activity begins or ends before its words say, in minutes (our choice).
pub const EARLY_MIN: f64 = 1.0;

/// The truth of one run.
pub struct LifeView<'a> {
    pub life: &'a ClaimTruth,
    pub calendar: &'a Calendar,
    pub who: usize,
    pub person: &'static str,
    pub days: i32,
    pub up_min: f64,
    pub bed_min: f64,
    /// Days on which the resident is out for days, or another statement takes all of the time.
    pub excused: Vec<bool>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct FieldResult {
    pub field: String,
    pub expected: String,
    pub measured: String,
    pub holds: bool,
}

/// The subject of a reported difference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldTopic {
    Days,
    Time,
    Length,
    Other,
}

impl FieldResult {
    pub fn range(field: &str, low: f64, high: f64, value: f64, unit: &str) -> FieldResult {
        let in_words = |value: f64| match value.abs() {
            large if large >= 10.0 => format!("{value:.0}"),
            _ => format!("{value:.2}"),
        };
        let expected = if low == high { in_words(low) } else { format!("{} to {}", in_words(low), in_words(high)) };
        let holds = value >= low - 1e-9 && value <= high + 1e-9;
        let (expected, measured) = (format!("{expected} {unit}"), in_words(value));
        FieldResult { field: field.to_owned(), expected, measured, holds }
    }

    /// Most of the cases, with the first that is not.
    pub fn most(field: &str, what: &str, cases: &[(bool, String)]) -> Option<FieldResult> {
        let right = cases.iter().filter(|(is_right, _)| *is_right).count();
        let first = cases.iter().find(|(is_right, _)| !is_right).map_or("", |(_, words)| words);
        (!cases.is_empty()).then(|| FieldResult {
            field: field.to_owned(),
            expected: format!("{what} in nine of ten"),
            measured: format!("{right} of {}{}{first}", cases.len(), if first.is_empty() { "" } else { ", such as " }),
            holds: super::bounds::most(right, cases.len()),
        })
    }

    pub fn topic(&self) -> FieldTopic {
        let field = self.field.as_str();
        match field {
            "length" => FieldTopic::Length,
            "end" | "night" => FieldTopic::Length,
            "at" | "mean time" | "part of the day" | "with" | "any time" => FieldTopic::Time,
            _ if field.starts_with("after") || field.starts_with("before") => FieldTopic::Time,
            "place" | "room" | "door" | "host" | "key" | "work" | "help" | "meanwhile" | "in the way"
            | "explained numbers" => FieldTopic::Other,
            _ => FieldTopic::Days,
        }
    }
}

impl LifeView<'_> {
    pub fn at(&self, day: i32, minute: f64) -> RunTime {
        self.calendar.instant(day, Span::from_seconds(minute * 60.0))
    }

    /// The day of an instant, which lasts from five to five.
    pub fn day_of(&self, at: RunTime) -> i32 {
        self.life.day_of(at - 5 * HOUR)
    }

    pub fn is_excused(&self, day: i32) -> bool {
        self.excused.get(day.max(0) as usize).copied().unwrap_or(true)
    }

    /// All times that an activity was done. With a place and a length, the user's words are its label.
    pub fn deeds(&self, deed: &Deed) -> Vec<Occurrence> {
        let mut labels = vec![deed.label.to_owned(), deed.words.to_owned(), deed.words.replace("her ", "his ")];
        labels.dedup();
        let mut all: Vec<Occurrence> =
            labels.into_iter().flat_map(|label| self.life.spans(self.who, &Subject::Activity(label))).collect();
        all.sort_by_key(|one| one.time.begin);
        all
    }

    pub fn labelled(&self, label: &str) -> Vec<Occurrence> {
        self.life.spans(self.who, &Subject::Activity(label.to_owned()))
    }

    /// The time of a visitor in the home, by visit.
    pub fn stays(&self, visitor: &str) -> Option<Vec<Occurrence>> {
        // The other resident may have such a visitor, too.
        let body = self.life.body(Some(&format!("{}'s {visitor}", self.person)), self.who)?;
        Some(self.life.at_home(body))
    }

    /// An instant for people.
    pub fn clock(&self, at: RunTime) -> String {
        self.calendar.wall_clock(at)
    }
}

pub fn minutes(span: Span) -> f64 {
    span.ratio(MINUTE)
}

/// The first interval of a list, in order of time, that contains an instant.
pub fn containing(all: &[Occurrence], at: RunTime) -> Option<&Occurrence> {
    all.iter().find(|one| Interval::new(one.time.begin, one.time.end).contains(at))
}
