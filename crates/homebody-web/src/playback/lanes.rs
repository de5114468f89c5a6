//! Events of each sensor over a whole stored run, for a time line of months.

use super::{OpenRun, Playback, RequestError};
use crate::wire::LanesView;
use homebody_core::time::{DAY, HOUR, RunTime, Span};

/// Largest number of counts in an answer (our choice): a hundred sensors by the hour over two years.
const MOST_COUNTS: i64 = 2_000_000;

/// The lengths of parts, the shortest first.
const PARTS: [Span; 4] = [HOUR, HOUR.times(6), DAY, DAY.times(7)];

impl Playback {
    /// The number of events of each sensor in each part of a run, without those that end something.
    pub fn lanes(&self, name: &str) -> Result<LanesView, RequestError> {
        self.open(name)?.lanes()
    }
}

impl OpenRun {
    fn lanes(&self) -> Result<LanesView, RequestError> {
        let Some(reading) = &self.reading else {
            return Ok(LanesView { bucket_us: PARTS[0].micros(), counts: Vec::new() });
        };
        let mut known = reading.until(RunTime::MAX)?;
        let sensors = known.sensors.len();
        let length = self.view.length().max(Span::MICROSECOND);
        let parts = |part: Span| (length + part - Span::MICROSECOND) / part;
        let is_few = |part: &&Span| parts(**part) * sensors as i64 <= MOST_COUNTS;
        let bucket = *PARTS.iter().find(is_few).unwrap_or(&PARTS[PARTS.len() - 1]);
        let is_off = |value: &String| ["off", "false"].iter().any(|off| value.eq_ignore_ascii_case(off));
        let off: Vec<bool> = known.values.iter().map(is_off).collect();
        let mut counts = vec![vec![0u32; parts(bucket) as usize]; sensors];
        for day in 0..self.view.days.len() {
            for row in known.of(day)? {
                if off.get(row.value as usize) != Some(&true) {
                    let part = usize::try_from(row.at.since_zero() / bucket).unwrap_or(0);
                    let count = counts.get_mut(row.sensor as usize).and_then(|lane| lane.get_mut(part));
                    count.into_iter().for_each(|count| *count += 1);
                }
            }
        }
        Ok(LanesView { bucket_us: bucket.micros(), counts })
    }
}
