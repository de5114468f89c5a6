//! Instants and spans: whole microseconds, never floats, so that equal times compare equal.

/// An instant since the scenario's start, or a span of time, in whole microseconds.
pub type Micros = i64;

/// One second.
pub const SECOND: Micros = 1_000_000;

/// A day of 24 hours.
pub const DAY: Micros = 24 * 60 * 60 * SECOND;

/// Longest run: a hundred years.
pub const LONGEST: Micros = 36_525 * DAY;

/// An instant that does not come.
pub const NEVER: Micros = Micros::MAX;

/// Seconds as a file writes them, rounded to the nearest microsecond.
///
/// Values out of range saturate: the checks of a scenario refuse them before they get here.
pub fn micros(seconds: f64) -> Micros {
    libm::round(seconds * SECOND as f64) as Micros
}

/// A span in seconds, for people and for formulas.
pub fn seconds(span: Micros) -> f64 {
    span as f64 / SECOND as f64
}
