//! How often each sensor of a stored run spoke, over the whole of it: what a time line shows of months.

use super::{Opened, Playback, Refusal};
use crate::wire::LanesView;
use homebody_core::time::{DAY, Micros, SECOND};

/// Largest number of counts in an answer (our choice): a hundred sensors by the hour over two years.
const MOST_COUNTS: i64 = 2_000_000;

/// How long the parts are that are counted, the shortest first.
const PARTS: [Micros; 4] = [3600 * SECOND, 6 * 3600 * SECOND, DAY, 7 * DAY];

impl Playback {
    /// How often each sensor spoke in each part of a run. What says that something is over does not count.
    pub fn lanes(&self, name: &str) -> Result<LanesView, Refusal> {
        self.open(name)?.lanes()
    }
}

impl Opened {
    fn lanes(&self) -> Result<LanesView, Refusal> {
        let Some(reading) = &self.reading else { return Ok(LanesView { bucket_us: PARTS[0], counts: Vec::new() }) };
        let mut known = reading.until(Micros::MAX)?;
        let sensors = known.sensors.len();
        let length = self.view.length_us.max(1);
        let parts = |part: Micros| (length + part - 1) / part;
        let is_few = |part: &&Micros| parts(**part) * sensors as i64 <= MOST_COUNTS;
        let bucket_us = *PARTS.iter().find(is_few).unwrap_or(&PARTS[PARTS.len() - 1]);
        let is_off = |value: &String| ["off", "false"].iter().any(|off| value.eq_ignore_ascii_case(off));
        let off: Vec<bool> = known.values.iter().map(is_off).collect();
        let mut counts = vec![vec![0u32; parts(bucket_us) as usize]; sensors];
        for day in 0..self.view.days.len() {
            for row in known.of(day)? {
                if off.get(row.value as usize) != Some(&true) {
                    let part = usize::try_from(row.at / bucket_us).unwrap_or(0);
                    let count = counts.get_mut(row.sensor as usize).and_then(|lane| lane.get_mut(part));
                    count.into_iter().for_each(|count| *count += 1);
                }
            }
        }
        Ok(LanesView { bucket_us, counts })
    }
}
