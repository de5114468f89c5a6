//! All rows of one table of a truth, wherever it is, with instants on the run's own clock.

use super::turns::TruthClock;
use super::{RecordedTruth, is_brief};
use crate::error::LogError;
use crate::files::database::text;
use crate::source::{InstantReader, TruthValue, instant_of_cell};
use crate::table::truth::{Truth, tables};
use crate::table::{ColumnKind, Table};
use crate::text::one_word;
use crate::url::Url;
use homebody_core::time::{RunTime, SECOND, Span, TimeScale, WallTime};
use rusqlite::Row;
use rusqlite::types::ValueRef;
use std::collections::HashMap;

/// Gives the rows of a table of a truth in the order in which they were written, with their cells in the order of the columns of
/// [`tables`]. An instant is a [`TruthValue::Integer`]: microseconds of [`RunTime`]. The wall of the scale is as in
/// [`read_timeline`](crate::read_timeline).
///
/// # Errors
///
/// [`LogError::NoTruth`] if there is none in this place, or none with this table; those of `take`.
pub fn truth_rows(
    url: &Url,
    table: Truth,
    scale: &TimeScale,
    take: &mut dyn FnMut(&[TruthValue<'_>]) -> Result<(), LogError>,
) -> Result<(), LogError> {
    let truth = RecordedTruth::open(url, &[table])?;
    let turns = TruthClock::new(&truth, &truth.scale(scale))?;
    let table = &tables()[table as usize];
    let columns: Vec<String> = table.columns.iter().map(|column| format!("{:?}", column.name)).collect();
    let sql = format!("SELECT {} FROM {:?} ORDER BY rowid", columns.join(", "), table.name);
    let failed = |error| truth.error(error);
    let mut statement = truth.connection.prepare(&sql).map_err(failed)?;
    let mut rows = statement.query([]).map_err(failed)?;
    let mut reader = TruthRowReader { table, turns, instants: InstantReader::default(), last: HashMap::new() };
    while let Some(row) = rows.next().map_err(failed)? {
        take(&reader.cells(row).map_err(failed)?)?;
    }
    Ok(())
}

struct TruthRowReader<'t> {
    table: &'t Table,
    turns: TruthClock,
    instants: InstantReader,
    /// The last instant that was read, by whose it was.
    last: HashMap<String, RunTime>,
}

impl TruthRowReader<'_> {
    fn cells<'r>(&mut self, row: &'r Row) -> rusqlite::Result<Vec<TruthValue<'r>>> {
        let who = self.table.column("resident").map(|column| row.get_ref(column)).transpose()?;
        let who = who.map_or_else(String::new, |who| text(who).into_owned());
        let mut cells = Vec::with_capacity(self.table.columns.len());
        for (index, column) in self.table.columns.iter().enumerate() {
            cells.push(match (column.kind, row.get_ref(index)?) {
                (ColumnKind::Instant, _) => match instant_of_cell(row, index, &mut self.instants)? {
                    None => TruthValue::Null,
                    Some(at) => TruthValue::Integer(self.turned(&who, at).micros()),
                },
                (ColumnKind::Real, ValueRef::Integer(number)) => TruthValue::Real(number as f64),
                (_, ValueRef::Integer(number)) => TruthValue::Integer(number),
                (_, ValueRef::Real(number)) => TruthValue::Real(number),
                // What is empty is nothing, as in files of text.
                (_, ValueRef::Text(bytes)) if !bytes.is_empty() => {
                    TruthValue::Text(str::from_utf8(bytes).unwrap_or(""))
                }
                _ => TruthValue::Null,
            });
        }
        Ok(cells)
    }

    fn turned(&mut self, who: &str, at: WallTime) -> RunTime {
        let last = self.last.get_mut(who);
        let turned = self.turns.turn(who, at, last.as_ref().map_or(RunTime::MIN, |last| **last));
        match last {
            Some(last) => *last = turned,
            None => _ = self.last.insert(who.to_owned(), turned),
        }
        turned
    }
}

/// Logs round their times by at most this (our choice).
const ROUNDED: Span = SECOND;

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
pub fn is_truth_of(
    truth: &Url,
    rows: &[(&str, WallTime)],
    also: &dyn Fn(WallTime) -> WallTime,
) -> Result<bool, LogError> {
    if rows.is_empty() || is_brief(truth) {
        return Ok(true);
    }
    let cause = &tables()[Truth::Cause as usize];
    let column = |name: &str| cause.columns.iter().position(|column| column.name == name);
    let (Some(sensor), Some(fired_at)) = (column("sensor"), column("fired_at")) else { return Ok(true) };
    let mut times: HashMap<String, Vec<WallTime>> = HashMap::new();
    let as_told = TimeScale::one();
    truth_rows(truth, Truth::Cause, &as_told, &mut |cells| {
        if let (TruthValue::Text(sensor), &TruthValue::Integer(at)) = (&cells[sensor], &cells[fired_at]) {
            let at = as_told.run_to_wall(RunTime::from_micros(at));
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
    let is_firing = |&&(sensor, at): &&(&str, WallTime)| {
        let Some(times) = times.get(sensor) else { return false };
        times.get(times.partition_point(|time| *time < at - ROUNDED)).is_some_and(|time| *time <= at + ROUNDED)
    };
    Ok(rows.iter().filter(is_firing).count() as f64 >= LEAST_SHARE * rows.len() as f64)
}
