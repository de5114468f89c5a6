//! The rows of a stored log, as playback has them in memory.

use crate::wire::PlaybackView;
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::Micros;
use homebody_log::{Event, Log, LogError, RunClock, Source, Url};
use std::collections::HashMap;
use std::fmt::Display;

/// So many rows of a log are kept in memory (ours): some years of a home's.
pub const MOST_ROWS: usize = 5_000_000;

/// Why there is no answer, in a sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// There is no such run, or no such day of it.
    Unknown(String),
    /// Its files cannot be understood.
    Damaged(String),
}

pub fn damaged(error: impl Display) -> Refusal {
    Refusal::Damaged(shortened(&error.to_string()))
}

/// Problems of a scenario can be many lines; the page has room for a few.
pub fn shortened(why: &str) -> String {
    const LONGEST: usize = 600;
    why.chars().take(LONGEST).collect()
}

/// A log with so many of its rows at most, and a remark if there are more.
pub fn first_rows(from: impl Into<Source>, logger: &LoggerFile, most: usize) -> Result<Log, LogError> {
    let mut events = Vec::new();
    let mut log = homebody_log::stream(from, logger, &mut |part| {
        events.extend(part.events.iter().take(most - events.len()));
        Ok(())
    })?;
    if log.rows > events.len() as u64 {
        log.remarks.push(format!("The log has {} rows, of which the first {most} are shown.", log.rows));
    }
    Ok(Log { events, ..log })
}

/// The numbers of a run's sensors in its view, by sensor of its log; those that stand nowhere in the home come last there.
pub fn numbers(log: &Log, url: &Url, scenario: &Scenario, view: &mut PlaybackView) -> Vec<u32> {
    let names: Vec<String> = view.home.sensors.iter().map(|sensor| sensor.name.clone()).collect();
    view.sensors = homebody_log::ids(url, &scenario.logger, &names);
    let known: HashMap<String, u32> = view.sensors.iter().cloned().zip(0..).collect();
    let number = |sensor: &String| known.get(sensor).copied().unwrap_or_else(|| stranger(sensor, view));
    log.sensors.iter().map(number).collect()
}

/// The number of a sensor that stands nowhere in the home.
pub fn stranger(id: &str, view: &mut PlaybackView) -> u32 {
    view.sensors.push(id.to_owned());
    view.sensors.len() as u32 - 1
}

/// A log's rows on the run's own clock, with the view's sensors, whose numbers are known by sensor of the log.
pub fn rows_of(log: Log, numbers: &[u32], clock: &RunClock, view: &mut PlaybackView) -> Vec<Event> {
    view.remarks.extend(log.remarks);
    if let Some(first) = log.problems.first() {
        let why = shortened(&first.why);
        view.remarks.push(format!("{} lines of the log were skipped; line {}: {why}", log.skipped, first.line));
    }
    view.values = log.values;
    let mut rows = log.events;
    let mut last = Micros::MIN;
    for row in &mut rows {
        row.at = clock.instant(row.at, last);
        row.sensor = numbers[row.sensor as usize];
        last = row.at;
    }
    // Where messages overtake each other, the log's order is another.
    if !rows.is_sorted_by_key(|row| row.at) {
        rows.sort_by_key(|row| row.at);
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn of_a_log_that_is_too_long_the_first_rows_are_kept_and_it_is_said() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("log.csv");
        let rows: String = (10..30).map(|s| format!("2026-01-05T09:00:{s},hall motion,ON\n")).collect();
        fs::write(&file, format!("time,sensor,value\n{rows}")).unwrap();
        let url: Url = format!("csv:{}", file.display()).parse().unwrap();
        let all = first_rows(&url, &LoggerFile::default(), 20).unwrap();
        assert_eq!((all.events.len(), all.remarks.len()), (20, 0), "{:?}", all.remarks);
        let some = first_rows(&url, &LoggerFile::default(), 7).unwrap();
        assert_eq!(some.events, all.events[..7]);
        assert_eq!(some.remarks, ["The log has 20 rows, of which the first 7 are shown."]);
    }
}
