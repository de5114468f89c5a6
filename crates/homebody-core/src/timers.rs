//! Which of many timers is due next.

use crate::sensor_set::MAX_SENSORS;
use crate::time::RunTime;

/// The timers of all sensors, as a tournament: each node holds the earlier of its two, so that setting one
/// costs a few comparisons without a branch. Of timers due at once, the first sensor's is next.
#[derive(Clone, Debug)]
pub struct Timers {
    /// The root at 1, the children of n at 2n and 2n + 1, the sensors last: instant and sensor in one number.
    keys: Vec<i64>,
    leaves: usize,
}

/// Instants are shifted by so many bits to make room for the sensor: 10 leave 2^53 microseconds, 285 years, and a run is at
/// most 100 years long.
const SENSOR_BITS: u32 = MAX_SENSORS.ilog2();
const SENSOR: i64 = (1 << SENSOR_BITS) - 1;

/// The key of a timer that is never due.
const NEVER: i64 = RunTime::NEVER.micros();

impl Timers {
    /// Timers that are never due.
    pub fn new(sensors: usize) -> Timers {
        let leaves = sensors.next_power_of_two();
        Timers { keys: vec![NEVER; 2 * leaves], leaves }
    }

    #[inline]
    pub fn set(&mut self, sensor: usize, at: RunTime) {
        let mut node = self.leaves + sensor;
        self.keys[node] = if at == RunTime::NEVER { NEVER } else { at.micros() << SENSOR_BITS | sensor as i64 };
        while node > 1 {
            node /= 2;
            self.keys[node] = self.keys[2 * node].min(self.keys[2 * node + 1]);
        }
    }

    /// The next timer and its owner; [`RunTime::NEVER`] if there is none.
    #[inline]
    pub fn next(&self) -> (RunTime, usize) {
        let key = self.keys[1];
        let at = if key == NEVER { RunTime::NEVER } else { RunTime::from_micros(key >> SENSOR_BITS) };
        (at, (key & SENSOR) as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn instant(sensor: usize) -> RunTime {
        RunTime::from_micros(100 - (sensor as i64 / 2).min(9))
    }

    #[test]
    fn the_earliest_is_next_and_of_equals_the_first() {
        for sensors in [0, 1, 2, 5, MAX_SENSORS] {
            let mut timers = Timers::new(sensors);
            assert_eq!(timers.next().0, RunTime::NEVER);
            for sensor in 0..sensors {
                timers.set(sensor, instant(sensor));
            }
            let mut due = Vec::new();
            while timers.next().0 != RunTime::NEVER {
                let (at, sensor) = timers.next();
                due.push((at, sensor));
                timers.set(sensor, RunTime::NEVER);
            }
            let mut expected: Vec<_> = (0..sensors).map(|sensor| (instant(sensor), sensor)).collect();
            expected.sort();
            assert_eq!(due, expected);
        }
    }
}
