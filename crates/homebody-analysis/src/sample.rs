//! Small logs for tests.

use homebody_core::time::{Interval, SECOND, WallTime};
use homebody_log::{Event, Log};

/// The instant so many seconds after the beginning of 1970.
pub fn at(seconds: i64) -> WallTime {
    WallTime::EPOCH + seconds * SECOND
}

/// From one of these instants to another.
pub fn span(from: i64, to: i64) -> Interval<WallTime> {
    Interval::new(at(from), at(to))
}

/// A log of rows: seconds since 1970, sensor and value.
pub fn log(rows: &[(i64, &str, &str)]) -> Log {
    let mut log = Log::default();
    let number = |known: &mut Vec<String>, name: &str| {
        known.iter().position(|one| one == name).unwrap_or_else(|| {
            known.push(name.into());
            known.len() - 1
        }) as u32
    };
    for &(seconds, sensor, value) in rows {
        let (sensor, value) = (number(&mut log.sensors, sensor), number(&mut log.values, value));
        log.events.push(Event { at: at(seconds), sensor, value });
    }
    log
}
