//! The log of a run, read in the background: of ten years the page shows the first days at once, and the last as soon as they are
//! read.

use super::background_read::{BackgroundRead, PartlyRead, ReadProgress, read_in};
use crate::request_error::{RequestError, failed, unprocessable};
use crate::stored_log::{MOST_ROWS, StoredRows, add_unplaced_sensor, log_remarks};
use crate::wire::PlaybackView;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{DAY, RunTime, Span, TimeScale};
use homebody_log::{Event, Log, LogError, Url};
use std::collections::HashMap;

/// Longest delay of a message after others of its time (our choice): a log that is being read may still get rows from
/// this far back.
const LATE: Span = DAY;

pub(super) type Reading = BackgroundRead<KnownRows>;

pub(super) struct KnownRows {
    pub rows: StoredRows,
    /// The sensors of the log, those of the home first.
    pub sensors: Vec<String>,
    pub values: Vec<String>,
    pub remarks: Vec<String>,
    how_far: ReadProgress,
}

impl BackgroundRead<KnownRows> {
    pub fn whole(rows: StoredRows, view: &mut PlaybackView) -> Reading {
        BackgroundRead::new(KnownRows {
            rows,
            sensors: std::mem::take(&mut view.sensors),
            values: std::mem::take(&mut view.values),
            remarks: Vec::new(),
            how_far: ReadProgress::whole(),
        })
    }

    /// Reads a run's own log in another thread. An incomplete run may have no log yet.
    pub fn begin(
        url: Url,
        scenario: &Scenario,
        is_complete: bool,
        view: &PlaybackView,
        rows: StoredRows,
    ) -> Result<Reading, RequestError> {
        let names: Vec<String> = view.home.sensors.iter().map(|sensor| sensor.name.clone()).collect();
        let sensors = homebody_log::ids(&url, &scenario.logger, &names);
        let mut numbers: HashMap<String, u32> = sensors.iter().cloned().zip(0..).collect();
        let (values, remarks) = (Vec::new(), Vec::new());
        let reading =
            BackgroundRead::new(KnownRows { rows, sensors, values, remarks, how_far: ReadProgress::begun(LATE) });
        let (coming, logger) = (reading.clone(), scenario.logger.clone());
        read_in("reads a log", move || {
            let mut scale = None;
            let mut take = |part: &Log| coming.grow(|known| known.take(part, &mut scale, &mut numbers));
            let read = homebody_log::stream(&url, &logger, &mut take);
            let read = match read {
                // The run was killed before its first row, or has just started.
                Err(LogError::NoTables { .. }) if !is_complete => Ok(Log::default()),
                read => read.map_err(unprocessable),
            };
            coming.end(|known| known.end(read, is_complete));
        })?;
        Ok(reading)
    }
}

impl PartlyRead for KnownRows {
    fn how_far(&self) -> &ReadProgress {
        &self.how_far
    }
}

impl KnownRows {
    pub fn of(&mut self, day: usize) -> Result<Vec<Event<RunTime>>, RequestError> {
        self.rows.day(day).map_err(failed)
    }

    fn take(
        &mut self,
        part: &Log,
        scale: &mut Option<TimeScale>,
        numbers: &mut HashMap<String, u32>,
    ) -> Result<(), LogError> {
        let KnownRows { rows, sensors, values, how_far, .. } = self;
        for id in part.sensors.iter().skip(rows.numbers.len()) {
            let number = *numbers.entry(id.clone()).or_insert_with(|| add_unplaced_sensor(id, sensors));
            rows.numbers.push(number);
        }
        values.extend_from_slice(part.values.get(values.len()..).unwrap_or_default());
        how_far.last_us = how_far.last_us.max(rows.take(part, scale, MOST_ROWS)?);
        Ok(())
    }

    fn end(&mut self, read: Result<Log, RequestError>, is_complete: bool) {
        let ended = read.and_then(|mut log| {
            self.rows.flush(&mut log, MOST_ROWS).map_err(unprocessable)?;
            if log.rows == 0 && !is_complete {
                self.remarks.push("The run has no rows yet.".into());
            }
            self.remarks.extend(log_remarks(&log));
            Ok(())
        });
        self.how_far.ended = Some(ended);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dates;
    use crate::messages::PageMessage;
    use homebody_core::calendar::Calendar;
    use homebody_core::time::{HOUR, WallTime};
    use std::path::Path;
    use std::thread;
    use std::time::Duration;

    /// An empty log of four days.
    fn begun() -> Reading {
        let calendar = Calendar::new("2009-03-02T00:00:00", "UTC").unwrap();
        let days = dates::all_days(&calendar, 4 * DAY);
        let rows = StoredRows::for_days(Path::new("."), &days, &calendar, 4 * DAY, RunTime::MAX).unwrap();
        let (sensors, values, remarks) = (vec!["hall".into()], Vec::new(), Vec::new());
        BackgroundRead::new(KnownRows { rows, sensors, values, remarks, how_far: ReadProgress::begun(LATE) })
    }

    /// A part with a row each hour, for some days.
    fn part(days: std::ops::Range<i64>) -> Log {
        let start = WallTime::from_micros(1_235_952_000_000_000);
        let hours = days.start * 24..days.end * 24;
        Log {
            sensors: vec!["attic".into(), "hall".into()],
            values: vec!["ON".into()],
            events: hours.map(|hour| Event { at: start + hour * HOUR, sensor: (hour % 2) as u32, value: 0 }).collect(),
            ..Log::default()
        }
    }

    #[test]
    fn days_are_there_once_nothing_more_of_them_comes() {
        let reading = begun();
        let mut numbers = HashMap::from([("hall".to_owned(), 0)]);
        let mut scale = None;
        let mut take = |days| reading.grow(|known| known.take(&part(days), &mut scale, &mut numbers));
        let start = RunTime::START;
        assert!(reading.wait(start + DAY, Duration::from_millis(20)).read_us().unwrap().unwrap() < start);
        take(0..2).unwrap();
        // Late rows may be of the second day.
        assert_eq!(reading.known().read_us(), Ok(Some(start + 23 * HOUR)));
        take(2..3).unwrap();
        let first = reading.until(start + DAY).unwrap().of(0).unwrap();
        assert_eq!(first.iter().map(|row| row.sensor).collect::<Vec<_>>(), [1, 0].repeat(12));
        take(3..4).unwrap();
        assert_eq!(reading.until(start + DAY).unwrap().of(0).unwrap(), first);
        reading.end(|known| known.end(Ok(Log::default()), true));
        assert_eq!(reading.known().read_us(), Ok(None));
        let mut known = reading.until(RunTime::MAX).unwrap();
        assert_eq!(
            (known.of(3).unwrap().len(), &known.sensors[..]),
            (24, &["hall".to_owned(), "attic".to_owned()][..])
        );
    }

    #[test]
    fn what_breaks_off_is_told_to_whoever_waits_and_what_nobody_wants_ends() {
        let reading = begun();
        let waiting = thread::spawn({
            let reading = reading.clone();
            move || reading.until(RunTime::MAX).map(drop)
        });
        reading.end(|known| known.end(Err(unprocessable(PageMessage::LogIncomplete)), true));
        assert_eq!(waiting.join().unwrap(), Err(unprocessable(PageMessage::LogIncomplete)));
        let reading = begun();
        reading.stop();
        let stopped = reading.grow(|known| known.take(&part(0..1), &mut None, &mut HashMap::new()));
        assert!(matches!(stopped, Err(LogError::Stopped { .. })));
    }
}
