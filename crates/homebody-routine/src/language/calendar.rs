//! Days of the run and dates.

use crate::routine::PhaseDay;

pub fn later(moment: PhaseDay, days: i32) -> PhaseDay {
    match moment {
        PhaseDay::Day(day) => PhaseDay::Day(day.saturating_add(days)),
        PhaseDay::Date(year, month, day) => of_number(number_of(year, month, day) + i64::from(days)),
    }
}

pub fn days_between(from: PhaseDay, to: PhaseDay, first: Option<(i16, u8, u8)>) -> Option<i64> {
    let number = |moment| match (moment, first) {
        (PhaseDay::Day(day), Some((y, m, d))) => Some(number_of(y, m, d) + i64::from(day)),
        (PhaseDay::Date(y, m, d), _) => Some(number_of(y, m, d)),
        (PhaseDay::Day(_), None) => None,
    };
    match (from, to) {
        (PhaseDay::Day(from), PhaseDay::Day(to)) => Some(i64::from(to) - i64::from(from)),
        _ => Some(number(to)? - number(from)?),
    }
}

/// `None` for a date that does not exist, or is not between 1900 and 2200.
pub fn date(year: u32, month: u32, day: u32) -> Option<PhaseDay> {
    let is_date = (1900..=2200).contains(&year) && (1..=12).contains(&month) && day >= 1;
    (is_date && day <= days_of(year as i16, month as u8)).then_some(PhaseDay::Date(year as i16, month as u8, day as u8))
}

fn days_of(year: i16, month: u8) -> u32 {
    match month {
        2 if year % 4 == 0 && (year % 100 != 0 || year % 400 == 0) => 29,
        2 => 28,
        4 | 6 | 9 | 11 => 30,
        _ => 31,
    }
}

fn number_of(year: i16, month: u8, day: u8) -> i64 {
    let years = (1900..year).map(|year| if days_of(year, 2) == 29 { 366 } else { 365 }).sum::<i64>();
    years + (1..month).map(|month| i64::from(days_of(year, month))).sum::<i64>() + i64::from(day) - 1
}

fn of_number(mut days: i64) -> PhaseDay {
    let (mut year, mut month) = (1900, 1);
    while days >= i64::from(days_of(year, month)) && year < 9999 {
        days -= i64::from(days_of(year, month));
        (year, month) = if month == 12 { (year + 1, 1) } else { (year, month + 1) };
    }
    PhaseDay::Date(year, month, days.clamp(0, 30) as u8 + 1)
}
