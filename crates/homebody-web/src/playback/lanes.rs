//! How often each sensor of a stored run spoke, over the whole of it: what a time line shows of months.

use super::{Opened, Playback, Refusal};
use crate::wire::LanesView;
use homebody_core::time::{DAY, HOUR, RunTime, Span};

/// Largest number of counts in an answer (our choice): a hundred sensors by the hour over two years.
const MOST_COUNTS: i64 = 2_000_000;

/// How long the parts are that are counted, the shortest first.
const PARTS: [Span; 4] = [HOUR, HOUR.times(6), DAY, DAY.times(7)];

impl Playback {
    /// How often each sensor spoke in each part of a run. What says that something is over does not count.
    pub fn lanes(&self, name: &str) -> Result<LanesView, Refusal> {
        self.open(name)?.lanes()
    }
}

impl Opened {
    fn lanes(&self) -> Result<LanesView, Refusal> {
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
