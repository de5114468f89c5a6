//! On which days, in which part of the day, and from when on.

use serde::Serialize;

/// On which days.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Days {
    /// Bit 0 is Monday, bit 6 Sunday.
    pub weekdays: u8,
    /// Bit 0 is January, bit 11 December.
    pub months: u16,
    /// Every so many days, counted from the first; 1 is every day.
    pub every: u32,
    /// The first and the last of the days of each month: from 1 to 7 with a Monday is the first Monday, and from 0 to 7
    /// is the last week of the month.
    pub of_month: (u8, u8),
    /// Only the days of this kind.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kind: Option<DayKind>,
}

/// How lively a day is, beside the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum DayKind {
    Quiet,
    Busy,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PartOfDay {
    Morning,
    Noon,
    Afternoon,
    Evening,
    Night,
    Day,
}

/// From when on, how gradually, until when.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Phase {
    /// Nothing: from the beginning.
    pub from: Option<Moment>,
    /// How many days until it is fully there.
    pub over_days: f64,
    /// The first moment at which it is no longer so, or begins to fade.
    pub until: Option<Moment>,
    /// How many days until it is fully gone again, after `until`.
    pub fading_days: f64,
}

/// A day of the run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Moment {
    /// Days since the first, which is 0.
    Day(i32),
    /// Year, month and day of the calendar.
    Date(i16, u8, u8),
}

impl Days {
    pub const ALL: Days = Days { weekdays: 0x7f, months: 0xfff, every: 1, of_month: (1, 31), kind: None };
}
