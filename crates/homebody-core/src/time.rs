//! Time in whole microseconds, never floats, so that equal times compare equal.
//!
//! An instant has one of three scales, and each scale has its own type. A difference of two instants is a [`Span`], on any scale:
//!
//! | type | counts from | scale |
//! |---|---|---|
//! | [`RunTime`] | the start of a run | never set, never ambiguous |
//! | [`UtcTime`] | 1970-01-01T00:00:00Z | the same everywhere on earth |
//! | [`WallTime`] | 1970-01-01 00:00:00 on the wall | a clock on a wall, which daylight saving time sets |
//!
//! A [`TimeScale`] converts between the three. An [`Interval`] has two instants of one scale.

mod interval;
mod scale;

pub use interval::{Interval, intersection, joined, union, without};
pub use scale::{ClockChange, TimeScale};

use jiff::civil::{Date, DateTime, date};
use jiff::{SignedDuration, Timestamp};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Rem, Sub, SubAssign};

/// One second.
pub const SECOND: Span = Span(1_000_000);

/// One minute.
pub const MINUTE: Span = Span(60 * SECOND.0);

/// One hour.
pub const HOUR: Span = Span(60 * MINUTE.0);

/// A day of 24 hours.
pub const DAY: Span = Span(24 * HOUR.0);

/// Longest run: a hundred years.
pub const LONGEST: Span = Span(36_525 * DAY.0);

/// A length of time, or a difference of two instants, in whole microseconds; below zero where the second one is earlier.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, schemars::JsonSchema,
)]
#[serde(transparent)]
pub struct Span(i64);

impl Span {
    /// No time at all.
    pub const ZERO: Span = Span(0);
    /// The shortest span above zero.
    pub const MICROSECOND: Span = Span(1);
    /// The longest span.
    pub const MAX: Span = Span(i64::MAX);
    /// The span that is furthest below zero.
    pub const MIN: Span = Span(i64::MIN);

    /// So many microseconds.
    #[inline]
    pub const fn from_micros(micros: i64) -> Span {
        Span(micros)
    }

    /// So many milliseconds.
    #[inline]
    pub const fn from_millis(millis: i64) -> Span {
        Span(millis * 1000)
    }

    /// So many seconds, rounded to the nearest microsecond.
    ///
    /// Values out of range saturate: the checks of a scenario refuse them before they get here.
    #[inline]
    pub fn from_seconds(seconds: f64) -> Span {
        Span(libm::round(seconds * SECOND.0 as f64) as i64)
    }

    /// So many days of 24 hours, rounded to the nearest microsecond.
    #[inline]
    pub fn from_days(days: f64) -> Span {
        Span(libm::round(days * DAY.0 as f64) as i64)
    }

    /// Whole microseconds.
    #[inline]
    pub const fn micros(self) -> i64 {
        self.0
    }

    /// Seconds, for people and for formulas.
    #[inline]
    pub fn seconds(self) -> f64 {
        self.0 as f64 / SECOND.0 as f64
    }

    /// The quotient of two spans as a fraction.
    #[inline]
    pub fn ratio(self, other: Span) -> f64 {
        self.0 as f64 / other.0 as f64
    }

    /// This span times a factor, rounded to the nearest microsecond.
    #[inline]
    pub fn scaled(self, factor: f64) -> Span {
        Span(libm::round(self.0 as f64 * factor) as i64)
    }

    /// This span times a factor, cut off to whole microseconds.
    #[inline]
    pub fn share(self, factor: f64) -> Span {
        Span((self.0 as f64 * factor) as i64)
    }

    /// So many times this span: `*` for constants.
    #[inline]
    pub const fn times(self, times: i64) -> Span {
        Span(self.0 * times)
    }

    /// The length without its sign.
    #[inline]
    pub const fn abs(self) -> Span {
        Span(self.0.abs())
    }

    /// The whole number of times that `other`, which is above zero, fits into it, rounded down.
    #[inline]
    pub const fn div_euclid(self, other: Span) -> i64 {
        self.0.div_euclid(other.0)
    }

    /// The rest that [`Span::div_euclid`] leaves, never below zero.
    #[inline]
    pub const fn rem_euclid(self, other: Span) -> Span {
        Span(self.0.rem_euclid(other.0))
    }

    /// The sum, or the longest span.
    #[inline]
    pub const fn saturating_add(self, other: Span) -> Span {
        Span(self.0.saturating_add(other.0))
    }

    /// The difference, or the longest span.
    #[inline]
    pub const fn saturating_sub(self, other: Span) -> Span {
        Span(self.0.saturating_sub(other.0))
    }

    /// The product, or the longest span.
    #[inline]
    pub const fn saturating_mul(self, times: i64) -> Span {
        Span(self.0.saturating_mul(times))
    }

    /// The sum, unless it is too long.
    #[inline]
    pub fn checked_add(self, other: Span) -> Option<Span> {
        self.0.checked_add(other.0).map(Span)
    }

    /// The same for the standard library and the operating system; nothing where it is below zero.
    pub fn to_duration(self) -> std::time::Duration {
        std::time::Duration::from_micros(self.0.max(0).unsigned_abs())
    }

    /// The same for the calendar.
    pub fn to_signed_duration(self) -> SignedDuration {
        SignedDuration::from_micros(self.0)
    }
}

impl From<std::time::Duration> for Span {
    fn from(duration: std::time::Duration) -> Span {
        Span(i64::try_from(duration.as_micros()).unwrap_or(i64::MAX))
    }
}

impl fmt::Display for Span {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// Implements operators.
macro_rules! operators {
    ($($operator:ident::$call:ident($one:ty, $other:ty) -> $out:ty: |$a:ident, $b:ident| $value:expr;)*) => {$(
        impl $operator<$other> for $one {
            type Output = $out;
            #[inline]
            fn $call(self, other: $other) -> $out {
                let ($a, $b) = (self, other);
                $value
            }
        }
    )*};
}

/// Implements operators that assign.
macro_rules! assigning_operators {
    ($($operator:ident::$call:ident($one:ty, $other:ty): $sign:tt;)*) => {$(
        impl $operator<$other> for $one {
            #[inline]
            fn $call(&mut self, other: $other) {
                *self = *self $sign other;
            }
        }
    )*};
}

operators! {
    Add::add(Span, Span) -> Span: |a, b| Span(a.0 + b.0);
    Sub::sub(Span, Span) -> Span: |a, b| Span(a.0 - b.0);
    Mul::mul(Span, i64) -> Span: |span, times| Span(span.0 * times);
    Mul::mul(i64, Span) -> Span: |times, span| Span(times * span.0);
    Div::div(Span, i64) -> Span: |span, parts| Span(span.0 / parts);
    Div::div(Span, Span) -> i64: |a, b| a.0 / b.0;
    Rem::rem(Span, Span) -> Span: |a, b| Span(a.0 % b.0);
}

assigning_operators! {
    AddAssign::add_assign(Span, Span): +;
    SubAssign::sub_assign(Span, Span): -;
    MulAssign::mul_assign(Span, i64): *;
    DivAssign::div_assign(Span, i64): /;
}

impl Neg for Span {
    type Output = Span;
    #[inline]
    fn neg(self) -> Span {
        Span(-self.0)
    }
}

impl Sum for Span {
    fn sum<I: Iterator<Item = Span>>(spans: I) -> Span {
        spans.fold(Span::ZERO, Add::add)
    }
}

impl<'a> Sum<&'a Span> for Span {
    fn sum<I: Iterator<Item = &'a Span>>(spans: I) -> Span {
        spans.copied().sum()
    }
}

/// An instant of one scale: what [`Interval`] and functions over any scale need.
pub trait TimePoint:
    Copy + Ord + fmt::Debug + Add<Span, Output = Self> + Sub<Span, Output = Self> + Sub<Output = Span>
{
    /// The earliest instant.
    const MIN: Self;
    /// The latest instant.
    const MAX: Self;
}

/// Makes the type of the instants of one scale.
macro_rules! instant {
    ($(#[$doc:meta])* $name:ident, $zero:ident: $zero_doc:literal) => {
        $(#[$doc])*
        #[derive(
            Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, schemars::JsonSchema,
        )]
        #[serde(transparent)]
        pub struct $name(i64);

        impl $name {
            #[doc = $zero_doc]
            pub const $zero: $name = $name(0);
            /// The earliest instant.
            pub const MIN: $name = $name(i64::MIN);
            /// The latest instant.
            pub const MAX: $name = $name(i64::MAX);

            /// The instant so many microseconds after the zero of its scale.
            #[inline]
            pub const fn from_micros(micros: i64) -> $name {
                $name(micros)
            }

            /// Microseconds since the zero of its scale.
            #[inline]
            pub const fn micros(self) -> i64 {
                self.0
            }

            /// The time since the zero of its scale.
            #[inline]
            pub const fn since_zero(self) -> Span {
                Span(self.0)
            }

            /// The instant so much later, or the latest one.
            #[inline]
            pub const fn saturating_add(self, span: Span) -> $name {
                $name(self.0.saturating_add(span.0))
            }

            /// The instant so much earlier, or the earliest one.
            #[inline]
            pub const fn saturating_sub(self, span: Span) -> $name {
                $name(self.0.saturating_sub(span.0))
            }

            /// The time since another instant, or the longest span.
            #[inline]
            pub const fn saturating_since(self, other: $name) -> Span {
                Span(self.0.saturating_sub(other.0))
            }

            /// The distance to another instant, in microseconds.
            #[inline]
            pub const fn abs_diff(self, other: $name) -> u64 {
                self.0.abs_diff(other.0)
            }

            /// The instant after a span, unless it is out of range.
            #[inline]
            pub fn checked_add(self, span: Span) -> Option<$name> {
                self.0.checked_add(span.0).map($name)
            }
        }

        impl TimePoint for $name {
            const MIN: $name = $name::MIN;
            const MAX: $name = $name::MAX;
        }

        operators! {
            Add::add($name, Span) -> $name: |at, span| $name(at.0 + span.0);
            Sub::sub($name, Span) -> $name: |at, span| $name(at.0 - span.0);
            Sub::sub($name, $name) -> Span: |at, other| Span(at.0 - other.0);
        }

        assigning_operators! {
            AddAssign::add_assign($name, Span): +;
            SubAssign::sub_assign($name, Span): -;
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
                self.0.fmt(f)
            }
        }
    };
}

instant! {
    /// An instant of a run, in microseconds since its start. Only a calendar knows when that was.
    RunTime, START: "The start of the run."
}

instant! {
    /// An instant of the world's clock, in microseconds since 1970.
    UtcTime, EPOCH: "Midnight at the beginning of 1970, in UTC."
}

instant! {
    /// Date and time as a clock on a wall shows them, in microseconds since 1970 on that wall. When clocks are set back, two instants
    /// have one wall time.
    WallTime, EPOCH: "Midnight at the beginning of 1970, on that wall."
}

impl RunTime {
    /// An instant that does not come.
    pub const NEVER: RunTime = RunTime::MAX;

    /// The instant so many days of 24 hours after the start.
    #[inline]
    pub fn from_days(days: f64) -> RunTime {
        RunTime::START + Span::from_days(days)
    }

    /// Seconds since the start, for people and for formulas.
    #[inline]
    pub fn seconds(self) -> f64 {
        self.since_zero().seconds()
    }
}

impl UtcTime {
    /// The same for the calendar, which ends in the year 9999: the first or the last instant that it has stands for those beyond.
    pub fn timestamp(self) -> Timestamp {
        Timestamp::from_microsecond(self.0).unwrap_or(if self.0 < 0 { Timestamp::MIN } else { Timestamp::MAX })
    }

    /// The time that a clock in UTC shows at this instant.
    #[inline]
    pub const fn on_wall_of_utc(self) -> WallTime {
        WallTime(self.0)
    }
}

impl From<Timestamp> for UtcTime {
    fn from(timestamp: Timestamp) -> UtcTime {
        UtcTime(timestamp.as_microsecond())
    }
}

impl WallTime {
    /// Midnight at the beginning of a date.
    pub fn midnight(day: Date) -> WallTime {
        let days = date(1970, 1, 1).until(day).map_or(0, |span| span.get_days());
        WallTime(i64::from(days) * DAY.0)
    }

    /// The date.
    pub fn date(self) -> Date {
        date(1970, 1, 1).saturating_add(jiff::Span::new().days(self.day_number()))
    }

    /// The instant at which a wall that is so far ahead of UTC shows it.
    #[inline]
    pub fn to_utc(self, ahead: Span) -> UtcTime {
        UtcTime(self.0 - ahead.0)
    }

    /// The number of the day since 1970.
    #[inline]
    pub const fn day_number(self) -> i64 {
        self.0.div_euclid(DAY.0)
    }

    /// The time since midnight.
    #[inline]
    pub const fn time_of_day(self) -> Span {
        Span(self.0.rem_euclid(DAY.0))
    }

    /// The instant at which a clock on the wall of UTC shows it.
    #[inline]
    pub const fn as_of_utc(self) -> UtcTime {
        UtcTime(self.0)
    }

    /// Date and time for the calendar.
    pub fn datetime(self) -> DateTime {
        date(1970, 1, 1).at(0, 0, 0, 0).saturating_add(self.since_zero().to_signed_duration())
    }
}

impl From<DateTime> for WallTime {
    fn from(datetime: DateTime) -> WallTime {
        let since = datetime.duration_since(date(1970, 1, 1).at(0, 0, 0, 0));
        WallTime(since.as_secs() * SECOND.0 + i64::from(since.subsec_micros()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_and_instants_count_microseconds() {
        assert_eq!(Span::from_seconds(1.5), SECOND * 3 / 2);
        assert_eq!((DAY / HOUR, DAY % (7 * HOUR), Span::from_days(0.25)), (24, 3 * HOUR, 6 * HOUR));
        assert_eq!(
            [-HOUR, HOUR].map(|span| (span.div_euclid(DAY), span.rem_euclid(DAY))),
            [(-1, 23 * HOUR), (0, HOUR)]
        );
        let at = RunTime::START + 2 * HOUR;
        assert_eq!((at - RunTime::from_micros(1)).micros(), 2 * HOUR.micros() - 1);
        assert_eq!(RunTime::NEVER.saturating_add(HOUR), RunTime::NEVER);
    }

    #[test]
    fn wall_times_have_dates_before_and_after_1970() {
        let day = date(2009, 3, 2);
        let midnight = WallTime::midnight(day);
        assert_eq!(midnight.micros(), 1_235_952_000 * SECOND.micros());
        assert_eq!([-MINUTE, Span::ZERO, DAY].map(|off| (midnight + off).date().day()), [1, 2, 3]);
        assert_eq!((midnight + HOUR).time_of_day(), HOUR);
        assert_eq!(WallTime::from((midnight + HOUR).datetime()), midnight + HOUR);
        assert_eq!(WallTime::midnight(date(1969, 12, 31)).date(), date(1969, 12, 31));
    }
}
