//! Whether a ground truth belongs to a log.

use super::recorded_truth::is_brief;
use super::run_clock::RunClock;
use super::tables::Value;
use super::truth_rows::truth_rows;
use crate::error::LogError;
use crate::truth::{Truth, tables};
use crate::url::Url;
use crate::word::one_word;
use homebody_core::time::{Micros, SECOND};
use std::collections::HashMap;

/// Logs round their times by at most this (our choice).
const ROUNDED: Micros = SECOND;

/// Least share of the rows of a log that are firings of its truth (our choice). All rows are, except the OFF that end a hold. Two runs of
/// one scenario share one row in ten by chance.
const LEAST_SHARE: f64 = 0.25;

/// Whether a ground truth is of the run of a log: `rows` are some of its rows, each with its sensor and its time as the log has it.
/// `also` reads the times of the truth another way, for example on the clock on the wall of the home. A brief truth, which has no firings,
/// belongs to any log.
///
/// # Errors
///
/// [`LogError::NoTruth`] if the place has no ground truth.
pub fn is_truth_of(truth: &Url, rows: &[(&str, Micros)], also: &dyn Fn(Micros) -> Micros) -> Result<bool, LogError> {
    if rows.is_empty() || is_brief(truth) {
        return Ok(true);
    }
    let cause = &tables()[Truth::Cause as usize];
    let column = |name: &str| cause.columns.iter().position(|column| column.name == name);
    let (Some(sensor), Some(fired_at)) = (column("sensor"), column("fired_at")) else { return Ok(true) };
    let mut times: HashMap<String, Vec<Micros>> = HashMap::new();
    truth_rows(truth, Truth::Cause, &RunClock::as_told(), &mut |cells| {
        if let (Value::Text(sensor), &Value::Integer(at)) = (&cells[sensor], &cells[fired_at]) {
            match times.get_mut(*sensor) {
                Some(times) => times.extend([at, also(at)]),
                None => drop(times.insert((*sensor).to_owned(), vec![at, also(at)])),
            }
        }
        Ok(())
    })?;
    let words: Vec<(String, String)> = times.keys().map(|sensor| (one_word(sensor), sensor.clone())).collect();
    for (word, sensor) in words.into_iter().filter(|(word, sensor)| word != sensor) {
        let of_sensor = times[&sensor].clone();
        times.entry(word).or_default().extend(of_sensor);
    }
    times.values_mut().for_each(|times| times.sort_unstable());
    let is_firing = |&&(sensor, at): &&(&str, Micros)| {
        let Some(times) = times.get(sensor) else { return false };
        times.get(times.partition_point(|time| *time < at - ROUNDED)).is_some_and(|time| *time <= at + ROUNDED)
    };
    Ok(rows.iter().filter(is_firing).count() as f64 >= LEAST_SHARE * rows.len() as f64)
}
