//! Small logs for tests.

use homebody_core::time::{Micros, SECOND};
use homebody_log::{Event, Log};

/// A log of rows: seconds since 1970, sensor and value.
pub fn log(rows: &[(Micros, &str, &str)]) -> Log {
    let mut log = Log::default();
    let number = |known: &mut Vec<String>, name: &str| {
        known.iter().position(|one| one == name).unwrap_or_else(|| {
            known.push(name.into());
            known.len() - 1
        }) as u32
    };
    for &(at, sensor, value) in rows {
        let (sensor, value) = (number(&mut log.sensors, sensor), number(&mut log.values, value));
        log.events.push(Event { at: at * SECOND, sensor, value });
    }
    log
}
