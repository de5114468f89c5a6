use crate::measures::{DayMeasures, MEASURES, Measures};
use homebody_core::time::{Interval, SECOND, WallTime};
use homebody_log::{Event, Log};
use jiff::civil::date;

/// The instant so many seconds after the beginning of 1970.
pub fn at(seconds: i64) -> WallTime {
    WallTime::EPOCH + seconds * SECOND
}

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

/// Rows such as `24:00:05 front door OPEN, 90000 front door CLOSE`: an instant, as a time of day or in seconds, a sensor and a value.
pub fn parsed(rows: &str) -> Vec<(i64, &str, &str)> {
    let seconds = |at: &str| at.split(':').fold(0, |sum, part| 60 * sum + part.parse::<i64>().unwrap());
    let rows = rows.split(", ").map(|row| {
        let (at, row) = row.split_once(' ').unwrap();
        let (sensor, value) = row.rsplit_once(' ').unwrap();
        (seconds(at), sensor, value)
    });
    rows.collect()
}

/// Days from the beginning of 2024 on with these values of some measures, and no other values.
pub fn days(columns: &[(&str, Vec<Option<f64>>)]) -> Measures {
    let day = |day: usize| {
        let mut values = vec![None; MEASURES.len()];
        for (name, column) in columns {
            values[MEASURES.iter().position(|measure| measure.name == *name).unwrap()] = column[day];
        }
        let date = date(2024, 1, 1).saturating_add(jiff::Span::new().days(day as i64));
        DayMeasures { date, is_whole: true, values }
    };
    let days = (0..columns[0].1.len()).map(day).collect();
    Measures { name: "log".into(), measures: MEASURES, days, ..Measures::default() }
}

/// Numbers that look random, and are the same each time.
pub struct TestRandom(pub u64);

impl TestRandom {
    pub fn below(&mut self, below: i64) -> i64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % below as u64) as i64
    }
}
