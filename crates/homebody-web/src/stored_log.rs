//! The rows of a stored log, as playback has them.

use crate::refusal::shortened;
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

/// The rows of a log by day, on the run's own clock. They are in a file without a name, which is gone with this: a log of ten years
/// takes no memory.
pub struct StoredRows {
    file: BufWriter<File>,
    days: Vec<SearchDay<RunTime>>,
    calendar: Calendar,
    length: Span,
    /// What comes later is left out.
    until: RunTime,
    /// For each day the places of its first row and behind its last: rows of other days may lie between.
    spans: Vec<Range<u64>>,
    /// How many rows there are in each hour of each day's clock.
    pub hours: Vec<Vec<u32>>,
    /// The numbers of sensors in the view, by sensor of the log.
    pub numbers: Vec<u32>,
    count: u64,
    /// The instant of the last row that came.
    last: RunTime,
}

/// How a row lies in the file: instant, sensor and value.
const ROW_BYTES: usize = 16;

impl StoredRows {
    /// No rows yet; their file is to be in this folder, or else where temporary files are.
    pub fn new(beside: &Path, view: &PlaybackView, calendar: &Calendar, until: RunTime) -> io::Result<StoredRows> {
        StoredRows::of_days(beside, &view.days, calendar, view.length(), until)
    }

    /// The same of these days, of a run of some length.
    pub fn of_days(
        beside: &Path,
        days: &[DateView],
        calendar: &Calendar,
        length: Span,
        until: RunTime,
    ) -> io::Result<StoredRows> {
        let file = tempfile::tempfile_in(beside).or_else(|_| tempfile::tempfile())?;
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

    /// Reads a log with so many of its rows at most, and remarks if there are more.
    pub fn read(&mut self, from: impl Into<LogSource>, logger: &LoggerFile, most: u64) -> Result<Log, LogError> {
        let mut scale = None;
        let mut log = homebody_log::stream(from, logger, &mut |part| self.take(part, &mut scale, most).map(drop))?;
        self.flush(&mut log, most)?;
        Ok(log)
    }

    /// Adds a part of a log, with so many rows of the log at most; `scale` is that of the parts before. Returns the instant of its last row.
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

    /// After the last part. A remark says that a log has more rows than were taken.
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

    /// What the last instant of a run says belongs to its last day.
    fn day_of(&self, at: RunTime) -> usize {
        self.days.partition_point(|day| day.end <= at).min(self.days.len().saturating_sub(1))
    }

    /// The rows of a day in the order of time, with the view's sensors.
    pub fn of(&mut self, day: usize) -> io::Result<Vec<Event<RunTime>>> {
        let span = self.spans.get(day).cloned().unwrap_or_default();
        let mut bytes = vec![0; (span.end - span.start) as usize * ROW_BYTES];
        // More may be on its way to the file, behind what is looked for.
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
        // Where messages overtake each other, the log's order is another.
        rows.sort_by_key(|row| row.at);
        Ok(rows)
    }
}

/// The number of a sensor that stands nowhere in the home.
pub fn stranger(id: &str, sensors: &mut Vec<String>) -> u32 {
    sensors.push(id.to_owned());
    sensors.len() as u32 - 1
}

/// What else is known of a log, in sentences.
pub fn told_of(log: &Log) -> Vec<String> {
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
    fn of_a_log_that_is_too_long_the_first_rows_are_kept_and_it_is_said() {
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
            let days = crate::dates::all(&scenario.calendar, DAY);
            let mut all = StoredRows::of_days(folder.path(), &days, &scenario.calendar, DAY, RunTime::MAX).unwrap();
            all.numbers = vec![5];
            let log = all.read(&url, &LoggerFile::default(), most).unwrap();
            assert_eq!(log.remarks, remarks);
            let rows: Vec<Event<RunTime>> = (0..days.len()).flat_map(|day| all.of(day).unwrap()).collect();
            assert_eq!(rows.len() as u64, most);
            assert!(rows.iter().all(|row| row.sensor == 5) && rows.is_sorted_by_key(|row| row.at));
            assert_eq!(all.hours.iter().flatten().sum::<u32>() as u64, most);
        }
    }
}
