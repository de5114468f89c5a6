//! The figures of lengths and days.

/// How far "about" reaches, as a share of the number.
pub const ABOUT_SHARE: f64 = 0.25;
/// How far a duration said without "about" reaches.
pub const PLAIN_SHARE: f64 = 0.1;
/// How far "about" reaches for a walking speed, which hardly varies from day to day.
pub const ABOUT_PACE_SHARE: f64 = 0.1;

pub const DAY_S: f64 = 86_400.0;
/// The days of a month and of a year in counts of days, as in the categories `DayUnit` and `MomentUnit` of the grammar.
pub const MONTH_DAYS: f64 = 30.0;
pub const YEAR_DAYS: f64 = 365.0;
