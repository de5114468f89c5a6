//! The signs of an episode: measures that moved, with the days that show it.

use super::patterns::Distances;
use super::reference::Usual;
use crate::measures::{DailyMeasure, DayMeasures, MEASURES, MeasureGroup};
use homebody_core::statistics::mean;
use jiff::civil::Date;
use serde::Serialize;
use std::ops::Range;

/// Smallest mean distance of a sign in standard deviations of a day, and of its mean in standard errors (our choice).
const LEAST_SHIFT_SD: f64 = 0.7;
const LEAST_SURE_SE: f64 = 3.0;
/// Smallest distance of a day that shows a sign, in standard deviations (our choice).
const SHOWS_SD: f64 = 1.0;
/// Number of the last days of an episode that give the value of a sign.
const LAST_DAYS: usize = 7;
/// Largest number of signs (our choice): people read no more.
const MOST_SIGNS: usize = 8;

/// A measure that moved.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub struct Sign {
    pub measure: &'static str,
    pub is_more: bool,
    /// The mean of the last week of the episode.
    pub value: f64,
    /// The usual value of the same days.
    pub usual: f64,
    /// The mean distance of all days of the episode, in standard deviations of a day.
    pub shift_sd: f64,
    /// The days that show it.
    #[cfg_attr(feature = "wire", ts(type = "string[]"))]
    pub shown_by: Vec<Date>,
    /// The difference in words, such as `getting up 47 min later`.
    pub words: String,
    /// The value and the usual one, such as `at 07:34 on average, usually 06:46`.
    pub numbers: String,
}

pub(super) struct WatchedColumns<'a> {
    pub days: &'a [DayMeasures],
    pub distances: &'a [Distances],
    pub usual: &'a [Vec<Option<Usual>>],
}

/// The signs in some days, the strongest first. Of measures of one thing the strongest stays.
pub(super) fn signs(watched: &WatchedColumns, during: Range<usize>) -> Vec<Sign> {
    let mut signs: Vec<(f64, Sign)> =
        of_single_days().filter_map(|number| sign(watched, during.clone(), number)).collect();
    signs.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut kept: Vec<Sign> = Vec::new();
    for (_, sign) in signs {
        let is_said = kept.iter().any(|other| subject(other.measure) == subject(sign.measure));
        if !is_said && kept.len() < MOST_SIGNS {
            kept.push(sign);
        }
    }
    kept
}

/// The numbers of measures of single days. The others are of many days in a row, and lag behind.
fn of_single_days() -> impl Iterator<Item = usize> {
    (0..MEASURES.len()).filter(|number| MEASURES[*number].group != MeasureGroup::Rhythm)
}

/// Measures with one subject say the same in other words.
fn subject(name: &'static str) -> &'static str {
    match name {
        "pace_slow" | "walking_speed" | "walking_speed_slow" | "walking_speed_fast" => "pace",
        "outings" => "time_out",
        "visits" => "company",
        "time_in_bed" => "sleep",
        name => name,
    }
}

/// The mean distance of a measure that moved, in standard deviations of a day, and in standard errors.
fn shift(days: &[Distances], number: usize) -> Option<(f64, f64)> {
    let known: Vec<f64> = days.iter().filter_map(|day| day[number]).collect();
    let shift_sd = mean(&known)?;
    let sure = shift_sd.abs() * (known.len() as f64).sqrt();
    (shift_sd.abs() >= LEAST_SHIFT_SD && sure >= LEAST_SURE_SE).then_some((shift_sd, sure))
}

/// The number of things that moved in some days. Measures of one thing count once.
pub(super) fn moved(days: &[Distances]) -> usize {
    let moved = of_single_days().filter(|number| shift(days, *number).is_some());
    let mut subjects: Vec<&str> = moved.map(|number| subject(MEASURES[number].name)).collect();
    subjects.sort_unstable();
    subjects.dedup();
    subjects.len()
}

fn sign(watched: &WatchedColumns, during: Range<usize>, number: usize) -> Option<(f64, Sign)> {
    let measure: &'static DailyMeasure = &MEASURES[number];
    let (shift_sd, sure) = shift(&watched.distances[during.clone()], number)?;
    let known: Vec<(usize, f64)> = during.filter_map(|day| Some((day, watched.distances[day][number]?))).collect();
    let is_more = shift_sd > 0.0;
    let last = &known[known.len().saturating_sub(LAST_DAYS)..];
    let value = mean(&last.iter().filter_map(|(day, _)| watched.days[*day].values[number]).collect::<Vec<f64>>())?;
    let usual_on = |day: &usize| Some(watched.usual[*day][number]?.on(watched.days[*day].date));
    let usual = mean(&last.iter().filter_map(|(day, _)| usual_on(day)).collect::<Vec<f64>>())?;
    let now = mean(&last.iter().map(|(_, distance)| *distance).collect::<Vec<f64>>())?;
    // It moved and has come back.
    if (value > usual) != is_more || now.abs() < LEAST_SHIFT_SD / 2.0 {
        return None;
    }
    let shows = |(_, distance): &&(usize, f64)| if is_more { *distance >= SHOWS_SD } else { *distance <= -SHOWS_SD };
    let shown_by = known.iter().filter(shows).map(|(day, _)| watched.days[*day].date).collect();
    let (words, numbers) = measure.sign_words(value, usual);
    Some((sure, Sign { measure: measure.name, is_more, value, usual, shift_sd, shown_by, words, numbers }))
}
