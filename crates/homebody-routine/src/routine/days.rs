//! Days, parts of days, and phases.

use serde::Serialize;

/// The days of a habit or change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct DaySelection {
    /// Bit 0 is Monday, bit 6 Sunday.
    pub weekdays: u8,
    /// Bit 0 is January, bit 11 December.
    pub months: u16,
    /// Every this many days from the first; 1 is every day.
    pub every: u32,
    /// First and last day of the month: from 1 to 7 with Mondays selects the first Monday, from 0 to 7 the last week.
    pub of_month: (u8, u8),
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kind: Option<DayKind>,
}

/// The activity level of a day relative to others.
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

/// The course of a change: start, growth, end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Phase {
    /// `None` from the beginning.
    pub from: Option<PhaseDay>,
    /// Days from the start to full strength.
    pub over_days: f64,
    /// The first day without it, or on which it begins to fade.
    pub until: Option<PhaseDay>,
    /// Days from `until` to zero strength.
    pub fading_days: f64,
}

/// A day.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PhaseDay {
    /// Since the first, which is 0.
    Day(i32),
    /// Year, month and day.
    Date(i16, u8, u8),
}

impl DaySelection {
    pub const ALL: DaySelection =
        DaySelection { weekdays: 0x7f, months: 0xfff, every: 1, of_month: (1, 31), kind: None };
}
