//! A log that is too long for memory: each pass over its rows reads it again.

use homebody_analysis::dates::on_wall;
use homebody_analysis::density::NoMap;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::{HOUR, Interval, Span, WallTime};
use homebody_log::{Event, Log, LogError, LogSource, stream};
use jiff::tz::TimeZone;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Largest number of rows of a log that is held in memory: they take 32 MB.
pub const MOST_ROWS: usize = 2_000_000;

/// Largest number of rows of a log that are compared with its ground truth (our choice).
pub(crate) const MOST_COMPARED: usize = 2000;

/// Largest number of rows that wait for earlier ones.
const MOST_WAITING: usize = 1 << 17;

/// Largest change of a clock that is set back.
const SET_BACK: Span = HOUR.times(3);

pub type TakeEvent<'t> = &'t mut dyn FnMut(&Event) -> Result<(), NoMap>;

pub(crate) struct LongLog {
    place: LogSource,
    mapping: LoggerFile,
    /// The zone of the home, if the log is in UTC.
    zone: Option<TimeZone>,
    /// The time of its rows, on its own clock.
    span: Interval<WallTime>,
    waiting: usize,
}

/// The rows of a log in memory, unless they are too many.
pub(crate) struct KeptRows {
    most: usize,
    events: Vec<Event>,
    span: Option<Interval<WallTime>>,
    is_long: bool,
}

impl KeptRows {
    /// At most so many rows; empty for a log with more.
    pub fn new(most: usize) -> KeptRows {
        KeptRows { most, events: Vec::new(), span: None, is_long: false }
    }

    pub fn take(&mut self, part: &Log) {
        let times = part.events.iter().map(|event| Interval::instant(event.at));
        self.span = self.span.into_iter().chain(times).reduce(Interval::hull);
        self.is_long |= self.events.len() + part.events.len() > self.most;
        match self.is_long {
            true => self.events = Vec::new(),
            false => self.events.extend_from_slice(&part.events),
        }
    }

    /// Gives a log its rows; if they are too many, returns the long log instead.
    pub fn give(self, log: &mut Log, place: &LogSource, mapping: &LoggerFile) -> Option<LongLog> {
        log.events = self.events;
        let span = self.span.filter(|_| self.is_long)?;
        Some(LongLog { place: place.clone(), mapping: mapping.clone(), zone: None, span, waiting: MOST_WAITING })
    }
}

impl LongLog {
    /// Puts its rows on the wall of a zone.
    pub fn put_on_wall(&mut self, zone: &TimeZone) {
        self.zone = Some(zone.clone());
    }

    pub fn span(&self) -> Interval<WallTime> {
        self.span.map(|at| self.on_wall(at))
    }

    fn on_wall(&self, at: WallTime) -> WallTime {
        self.zone.as_ref().map_or(at, |zone| on_wall(at, zone))
    }

    /// Gives all its rows in the order of time.
    ///
    /// # Errors
    ///
    /// [`NoMap::Unread`] where it cannot be read again, [`NoMap::Disorder`] where its rows are farther out of order than some that
    /// wait can be put right, and those of `take`.
    pub fn rows(&self, take: TakeEvent) -> Result<(), NoMap> {
        let mut waiting: BinaryHeap<Reverse<(WallTime, u64, u32, u32)>> = BinaryHeap::new();
        let (mut come, mut given) = (0, WallTime::MIN);
        let mut failed: Option<NoMap> = None;
        let mut give = |at: WallTime, sensor: u32, value: u32| {
            let before = given;
            given = given.max(at);
            // When clocks are set back, an hour repeats.
            let is_order = at >= before || self.zone.is_some() && before - at <= SET_BACK;
            if is_order { take(&Event { at, sensor, value }) } else { Err(NoMap::Disorder { at, before }) }
        };
        let read = stream(self.place.clone(), &self.mapping, &mut |part| {
            for event in &part.events {
                waiting.push(Reverse((event.at, come, event.sensor, event.value)));
                come += 1;
                if waiting.len() > self.waiting
                    && let Some(Reverse((at, _, sensor, value))) = waiting.pop()
                    && let Err(why) = give(self.on_wall(at), sensor, value)
                {
                    failed = Some(why);
                    // This error only ends the reading.
                    return Err(LogError::Stopped { place: String::new() });
                }
            }
            Ok(())
        });
        match (failed, read) {
            (Some(why), _) => return Err(why),
            (None, Err(error)) => return Err(NoMap::Unread(error.to_string())),
            (None, Ok(_)) => {}
        }
        while let Some(Reverse((at, _, sensor, value))) = waiting.pop() {
            give(self.on_wall(at), sensor, value)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::loaded_log::LoadedLog;
    use crate::log_ref::LogRef;
    use homebody_core::time::SECOND;
    use std::fmt::Write;
    use std::fs;
    use std::path::Path;

    /// A long log of the rows of these seconds.
    fn long(folder: &Path, seconds: &[i64], waiting: usize) -> LongLog {
        let path = folder.join("log.csv");
        let rows = seconds.iter().map(|at| format!("2024-03-01 10:{:02}:{:02},hall,ON\n", at / 60, at % 60));
        fs::write(&path, format!("time,sensor,value\n{}", rows.collect::<String>())).unwrap();
        let (place, mapping) = (LogSource::recognise(&path).unwrap(), LoggerFile::default());
        let mut kept = KeptRows::new(seconds.len() - 1);
        let mut log = stream(place.clone(), &mapping, &mut |part| {
            kept.take(part);
            Ok(())
        })
        .unwrap();
        let long = kept.give(&mut log, &place, &mapping).unwrap();
        assert!(log.events.is_empty() && log.rows == seconds.len() as u64);
        LongLog { waiting, ..long }
    }

    fn seconds(long: &LongLog) -> Result<Vec<i64>, NoMap> {
        let mut found = Vec::new();
        long.rows(&mut |row| {
            found.push((row.at - long.span.begin) / SECOND);
            Ok(())
        })?;
        Ok(found)
    }

    #[test]
    fn rows_of_a_long_log_come_in_order_each_time() {
        let folder = tempfile::tempdir().unwrap();
        let log = long(folder.path(), &[0, 9, 3, 5, 12, 11], 2);
        assert_eq!(seconds(&log).unwrap(), [0, 3, 5, 9, 11, 12]);
        assert_eq!(seconds(&log).unwrap(), [0, 3, 5, 9, 11, 12]);
        assert_eq!(log.span.length() / SECOND, 12);
    }

    #[test]
    fn a_long_log_that_is_far_out_of_order_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let told = seconds(&long(folder.path(), &[0, 60, 120, 180, 5], 2)).unwrap_err().to_string();
        assert!(told.contains("10:00:05") && told.contains("10:01:00") && told.contains("hint: sort"), "{told}");
    }

    #[test]
    fn a_log_that_is_too_long_for_memory_is_measured_as_one_that_is_not() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("log.csv");
        let mut rows = String::from("time,sensor,value\n");
        for (day, hour) in (1..=20).flat_map(|day| (0..24).map(move |hour| (day, hour))) {
            for (minute, sensor) in [(day, "bedroom motion"), (25, "kitchen motion"), (30 + day, "front hall motion")] {
                if (hour + day) % 5 != 0 {
                    writeln!(rows, "2024-03-{day:02} {hour:02}:{minute:02}:00,{sensor},ON").unwrap();
                }
            }
        }
        fs::write(&path, rows).unwrap();
        let read = |most: usize| {
            let named = LogRef::find(&path.display().to_string()).unwrap();
            LoadedLog::of_length(named, None, most).unwrap()
        };
        let (short, long) = (read(1_000_000), read(100));
        assert!(long.log.events.is_empty() && !short.log.events.is_empty());
        assert_eq!(long.dates(), short.dates());
        let [of_short, of_long] = [&short, &long].map(|log| log.measures().unwrap());
        assert_eq!(of_long.days, of_short.days);
        assert!(of_short.days.iter().any(|day| day.value("room_changes").is_some()));
        let asked = short.density_asked();
        assert_eq!(long.density(&asked), short.density(&asked));
        assert!(short.density(&asked).unwrap().events > 0);
    }
}
