//! The rows of a stored log, for playback.

use crate::request_error::shortened;
use crate::wire::{DateView, PlaybackView};
use homebody_core::calendar::Calendar;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::{HOUR, RunTime, Span, TimeScale};
use homebody_log::{Event, Log, LogError, LogSource};
use homebody_query::search::SearchDay;
use std::fs::File;
use std::io::{self, BufWriter, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::Path;

/// Largest number of rows of a log that are stored (our choice): 1.6 GB on disk, forty years of a home's.
pub const MOST_ROWS: u64 = 100_000_000;

/// The rows of a log by day, on the run's own clock. A temporary file holds them, so that a log of ten years takes no memory.
pub struct StoredRows {
    file: BufWriter<File>,
    days: Vec<SearchDay<RunTime>>,
    calendar: Calendar,
    length: Span,
    /// Later rows are left out.
    until: RunTime,
    /// For each day the first row and the end; rows of other days may lie between.
    spans: Vec<Range<u64>>,
    /// The number of rows in each hour of each day's clock.
    pub hours: Vec<Vec<u32>>,
    /// The numbers of sensors in the view, by sensor of the log.
    pub numbers: Vec<u32>,
    count: u64,
    last: RunTime,
}

/// Instant, sensor and value.
const ROW_BYTES: usize = 16;

impl StoredRows {
    /// The file is in this folder, or among temporary files.
    pub fn new(folder: &Path, view: &PlaybackView, calendar: &Calendar, until: RunTime) -> io::Result<StoredRows> {
        StoredRows::for_days(folder, &view.days, calendar, view.length(), until)
    }

    pub fn for_days(
        folder: &Path,
        days: &[DateView],
        calendar: &Calendar,
        length: Span,
        until: RunTime,
    ) -> io::Result<StoredRows> {
        let file = tempfile::tempfile_in(folder).or_else(|_| tempfile::tempfile())?;
        Ok(StoredRows {
            file: BufWriter::with_capacity(1 << 20, file),
            spans: vec![0..0; days.len()],
            hours: vec![vec![0; 24]; days.len()],
            days: days.iter().map(DateView::clock).collect(),
            calendar: calendar.clone(),
            length,
            until,
            numbers: Vec::new(),
            count: 0,
            last: RunTime::MIN,
        })
    }

    /// Reads at most `most` rows of a log. A remark says if it has more.
    pub fn read(&mut self, from: impl Into<LogSource>, logger: &LoggerFile, most: u64) -> Result<Log, LogError> {
        let mut scale = None;
        let mut log = homebody_log::stream(from, logger, &mut |part| self.take(part, &mut scale, most).map(drop))?;
        self.flush(&mut log, most)?;
        Ok(log)
    }

    /// Adds a part of a log; `scale` is that of the parts before. Returns the instant of its last row.
    pub fn take(&mut self, part: &Log, scale: &mut Option<TimeScale>, most: u64) -> Result<RunTime, LogError> {
        let scale = scale.get_or_insert_with(|| part.clock.scale(&self.calendar, self.length));
        for row in &part.events {
            if self.count >= most {
                break;
            }
            self.last = scale.run_from_wall(row.at, self.last);
            self.add(self.last, row).map_err(unwritten)?;
        }
        Ok(self.last)
    }

    /// Ends the log. A remark says if it has more rows than were read.
    pub fn flush(&mut self, log: &mut Log, most: u64) -> Result<(), LogError> {
        self.file.flush().map_err(unwritten)?;
        if log.rows > self.count && self.count >= most {
            log.remarks.push(format!("The log has {} rows. Only the first {most} are shown.", log.rows));
        }
        Ok(())
    }

    fn add(&mut self, at: RunTime, row: &Event) -> io::Result<()> {
        if at > self.until || self.days.is_empty() {
            return Ok(());
        }
        let number = self.day_of(at);
        let day = &self.days[number];
        let turned = day.turn.filter(|turn| at >= turn.at).map_or(Span::ZERO, |turn| turn.by);
        let hour = (at - day.begin + day.clock + turned).div_euclid(HOUR).clamp(0, 23);
        self.hours[number][hour as usize] += 1;
        let span = &mut self.spans[number];
        let start = if span.is_empty() { self.count } else { span.start };
        *span = start..self.count + 1;
        self.count += 1;
        self.file.write_all(&at.micros().to_le_bytes())?;
        self.file.write_all(&row.sensor.to_le_bytes())?;
        self.file.write_all(&row.value.to_le_bytes())
    }

    /// The last instant of a run belongs to its last day.
    fn day_of(&self, at: RunTime) -> usize {
        self.days.partition_point(|day| day.end <= at).min(self.days.len().saturating_sub(1))
    }

    /// The rows of a day in the order of time, with the view's sensors.
    pub fn day(&mut self, day: usize) -> io::Result<Vec<Event<RunTime>>> {
        let span = self.spans.get(day).cloned().unwrap_or_default();
        let mut bytes = vec![0; (span.end - span.start) as usize * ROW_BYTES];
        // The last rows may not be in the file yet.
        self.file.flush()?;
        let file = self.file.get_mut();
        file.seek(SeekFrom::Start(span.start * ROW_BYTES as u64))?;
        file.read_exact(&mut bytes)?;
        file.seek(SeekFrom::End(0))?;
        let number = |bytes: &[u8]| u32::from_le_bytes(bytes.try_into().expect("four bytes"));
        let row = |bytes: &[u8]| Event {
            at: RunTime::from_micros(i64::from_le_bytes(bytes[..8].try_into().expect("eight bytes"))),
            sensor: self.numbers.get(number(&bytes[8..12]) as usize).copied().unwrap_or(0),
            value: number(&bytes[12..]),
        };
        let mut rows: Vec<Event<RunTime>> = bytes.chunks_exact(ROW_BYTES).map(row).collect();
        rows.retain(|row| self.day_of(row.at) == day);
        // Delayed messages are out of order in the log.
        rows.sort_by_key(|row| row.at);
        Ok(rows)
    }
}

/// Adds a sensor that has no place in the home, and returns its number.
pub fn add_unplaced_sensor(id: &str, sensors: &mut Vec<String>) -> u32 {
    sensors.push(id.to_owned());
    sensors.len() as u32 - 1
}

pub fn log_remarks(log: &Log) -> Vec<String> {
    let mut remarks = log.remarks.clone();
    if let Some(first) = log.problems.first() {
        let why = shortened(&first.why);
        remarks.push(format!("Skipped {} lines of the log; line {}: {why}", log.skipped, first.line));
    }
    remarks
}

fn unwritten(source: io::Error) -> LogError {
    LogError::File { place: "the file of its rows".into(), source }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::scenario::load::{Files, Scenario};
    use homebody_core::time::DAY;
    use homebody_log::Url;
    use homebody_simulation::Template;
    use std::collections::BTreeMap;
    use std::fs;

    #[test]
    fn stores_the_first_rows_of_a_long_log_with_a_remark() {
        let folder = tempfile::tempdir().unwrap();
        let texts: BTreeMap<String, String> = Template::named("by-hand")
            .unwrap()
            .files()
            .map(|(name, text)| (name.to_owned(), text.to_owned()))
            .collect();
        let scenario = Scenario::load(&texts as &dyn Files, "scenario.json").unwrap();
        let file = folder.path().join("log.csv");
        let start = scenario.calendar.wall_clock(RunTime::START);
        let rows: String = (10..30).map(|s| format!("{} 09:00:{s},hall motion,ON\n", &start[..10])).collect();
        fs::write(&file, format!("time,sensor,value\n{rows}")).unwrap();
        let url: Url = format!("csv:{}", file.display()).parse().unwrap();
        for (most, remarks) in [(20, vec![]), (7, vec!["The log has 20 rows. Only the first 7 are shown."])] {
            let days = crate::dates::all_days(&scenario.calendar, DAY);
            let mut all = StoredRows::for_days(folder.path(), &days, &scenario.calendar, DAY, RunTime::MAX).unwrap();
            all.numbers = vec![5];
            let log = all.read(&url, &LoggerFile::default(), most).unwrap();
            assert_eq!(log.remarks, remarks);
            let rows: Vec<Event<RunTime>> = (0..days.len()).flat_map(|day| all.day(day).unwrap()).collect();
            assert_eq!(rows.len() as u64, most);
            assert!(rows.iter().all(|row| row.sensor == 5) && rows.is_sorted_by_key(|row| row.at));
            assert_eq!(all.hours.iter().flatten().sum::<u32>() as u64, most);
        }
    }
}
