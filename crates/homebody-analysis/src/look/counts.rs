use crate::dates::MOST_DAYS;
use homebody_core::time::{DAY, WallTime};
use jiff::civil::Date;
use std::collections::BTreeMap;

/// Largest number of stored counts (our choice): a thousand sensors for ten years.
const MOST_COUNTS: usize = 4_000_000;

#[derive(Default)]
pub(super) struct DayCounts {
    /// Days since 1970.
    all: BTreeMap<(i64, u32), u32>,
    day: i64,
    /// The counts of this day, by sensor, and the numbers of those above 0.
    now: Vec<u32>,
    touched: Vec<u32>,
    is_too_long: bool,
}

impl DayCounts {
    pub fn take(&mut self, sensor: u32, at: WallTime) {
        let day = at.day_number();
        if day != self.day {
            self.keep();
            self.day = day;
        }
        let index = sensor as usize;
        if self.now.len() <= index {
            self.now.resize(index + 1, 0);
        }
        if self.now[index] == 0 {
            self.touched.push(sensor);
        }
        self.now[index] += 1;
    }

    fn keep(&mut self) {
        for sensor in self.touched.drain(..) {
            let count = std::mem::take(&mut self.now[sensor as usize]);
            *self.all.entry((self.day, sensor)).or_default() += count;
        }
        self.is_too_long |= self.all.len() > MOST_COUNTS;
        if self.is_too_long {
            self.all.clear();
        }
    }

    /// The dates from the first to the last, and by sensor the counts of all these; both empty where they are too many.
    pub fn finish(mut self, sensors: usize) -> (Vec<Date>, Vec<Vec<u32>>) {
        self.keep();
        let (Some(((first, _), _)), Some(((last, _), _))) = (self.all.first_key_value(), self.all.last_key_value())
        else {
            return (Vec::new(), Vec::new());
        };
        let (first, days) = (*first, last - first + 1);
        if days as usize > MOST_DAYS || days as usize * sensors > MOST_COUNTS {
            return (Vec::new(), Vec::new());
        }
        let mut by_sensor = vec![vec![0; days as usize]; sensors];
        for ((day, sensor), count) in self.all {
            by_sensor[sensor as usize][(day - first) as usize] = count;
        }
        ((first..first + days).map(|day| (WallTime::EPOCH + day * DAY).date()).collect(), by_sensor)
    }
}
