//! The reference of a resident: the first days that count. Later days are compared with them.

use crate::measures::{DayMeasures, MEASURES};
use homebody_core::statistics::{mean, quantile};
use jiff::civil::Date;
use serde::Serialize;

/// Days of a whole reference (our choice): four of each weekday.
pub const REFERENCE_DAYS: usize = 28;
/// Days of the shortest reference (our choice): each weekday once.
pub const LEAST_DAYS: usize = 7;
/// Number of days on a weekday at which half of their own difference counts (our choice).
const WEEKDAY_DAYS: f64 = 6.0;
/// Share of the days at either end that say nothing of the middle and the spread, and the distance between the ends of the others
/// in standard deviations of a normal distribution.
const TRIMMED: f64 = 0.1;
const TRIMMED_SD: f64 = 2.563;

/// The days of a reference.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub struct ReferenceDays {
    #[cfg_attr(feature = "wire", ts(type = "string"))]
    pub from: Date,
    #[cfg_attr(feature = "wire", ts(type = "string"))]
    pub to: Date,
    /// The number of days that count.
    pub days: usize,
    /// Somebody chose its first day. Otherwise it is the first of the log.
    pub is_marked: bool,
}

impl ReferenceDays {
    pub fn is_whole(&self) -> bool {
        self.days >= REFERENCE_DAYS
    }
}

/// The usual values of a measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Usual {
    pub middle: f64,
    pub spread: f64,
    /// By day of the week, from Monday on: the difference from the middle.
    pub by_weekday: [f64; 7],
    pub days: usize,
}

impl Usual {
    /// Of the values of some days, with the least spread of the measure.
    fn of(values: &[(Date, f64)], least_sd: f64) -> Option<Usual> {
        if values.len() < LEAST_DAYS {
            return None;
        }
        let plain: Vec<f64> = values.iter().map(|(_, value)| *value).collect();
        let middle = trimmed_mean(&plain)?;
        let mut by_weekday = [0.0; 7];
        for (weekday, off) in by_weekday.iter_mut().enumerate() {
            let same = values.iter().filter(|(date, _)| weekday_of(*date) == weekday);
            let apart: Vec<f64> = same.map(|(_, value)| value - middle).collect();
            let weight = apart.len() as f64 / (apart.len() as f64 + WEEKDAY_DAYS);
            *off = mean(&apart).unwrap_or(0.0) * weight;
        }
        let left: Vec<f64> = values.iter().map(|(date, value)| value - by_weekday[weekday_of(*date)]).collect();
        let ends = quantile(&left, 1.0 - TRIMMED)? - quantile(&left, TRIMMED)?;
        let spread = (ends / TRIMMED_SD).max(least_sd);
        Some(Usual { middle, spread, by_weekday, days: values.len() })
    }

    pub fn on(&self, date: Date) -> f64 {
        self.middle + self.by_weekday[weekday_of(date)]
    }

    /// The distance of a value from the usual one, in standard deviations of a new day.
    pub fn distance(&self, date: Date, value: f64) -> f64 {
        (value - self.on(date)) / (self.spread * (1.0 + 1.0 / self.days as f64).sqrt())
    }
}

fn weekday_of(date: Date) -> usize {
    date.weekday().to_monday_zero_offset() as usize
}

/// The mean without the lowest and the highest tenth.
fn trimmed_mean(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let cut = (sorted.len() as f64 * TRIMMED) as usize;
    mean(&sorted[cut..sorted.len() - cut])
}

/// A reference that grows day by day until it is whole.
#[derive(Clone, Debug, Default)]
pub(super) struct GrowingReference {
    pub days: Option<ReferenceDays>,
    values: Vec<Vec<(Date, f64)>>,
    usual: Vec<Option<Usual>>,
}

impl GrowingReference {
    pub fn new() -> GrowingReference {
        GrowingReference { days: None, values: vec![Vec::new(); MEASURES.len()], usual: vec![None; MEASURES.len()] }
    }

    pub fn take(&mut self, day: &DayMeasures, is_marked: bool) {
        let days = self.days.get_or_insert(ReferenceDays { from: day.date, to: day.date, days: 0, is_marked });
        if days.is_whole() {
            return;
        }
        (days.to, days.days) = (day.date, days.days + 1);
        for (number, measure) in MEASURES.iter().enumerate() {
            self.values[number].extend(day.values[number].map(|value| (day.date, value)));
            self.usual[number] = Usual::of(&self.values[number], measure.least_sd);
        }
    }

    pub fn usual(&self, measure: usize) -> Option<&Usual> {
        self.usual[measure].as_ref()
    }
}
