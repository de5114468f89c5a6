//! Times of the day.

pub const HOUR_S: f64 = 3600.0;

/// How far "about" a time of day reaches, in seconds.
pub const ABOUT_TIME_S: f64 = 20.0 * 60.0;
/// How far a time of day said without "about" reaches.
pub const PLAIN_TIME_S: f64 = 5.0 * 60.0;

/// Whether something that begins late in the day ends on the next one.
pub fn is_of_next_day(end: f64, begin: f64) -> bool {
    /// Start of the afternoon, and end of the morning (our choice).
    const LATE_S: f64 = 15.0 * HOUR_S;
    const EARLY_S: f64 = 9.0 * HOUR_S;
    end <= begin && (begin >= super::amounts::DAY_S || begin >= LATE_S && end <= EARLY_S)
}
