//! Which of a table's columns tell time, sensor and value.

use homebody_core::scenario::logger::LoggerFile;

/// What a column is called in the logs that are known, ours first. Names are compared in lower case.
const TIMES: [&str; 9] =
    ["fired_at", "time", "timestamp", "datetime", "date_time", "last_changed", "last_changed_ts", "at", "ts"];
const SENSORS: [&str; 8] = ["sensor", "device", "entity_id", "sensor_id", "device_id", "item", "name", "code"];
const VALUES: [&str; 5] = ["value", "state", "message", "status", "event"];

const LABELS: [&str; 3] = ["activity", "label", "activities"];

/// Where a row's time, sensor and value are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Places {
    /// The column of the time.
    pub time: usize,
    /// That of the sensor.
    pub sensor: usize,
    /// That of what it said.
    pub value: usize,
    /// Where what somebody did is, if the rows tell it.
    pub label: Option<usize>,
    /// Whether the columns have the names of the mapping: then cells are as they were written, with the blanks at their ends.
    pub is_mapped: bool,
}

impl Places {
    /// By the names of a mapping or, failing them, the usual ones.
    pub fn by_name(names: &[String], file: &LoggerFile) -> Option<Places> {
        let exactly = |wanted: &str| names.iter().position(|name| name == wanted);
        let usual = |wanted: &[&str]| {
            wanted.iter().find_map(|wanted| names.iter().position(|name| name.trim().eq_ignore_ascii_case(wanted)))
        };
        let columns = &file.columns;
        let label = usual(&LABELS);
        let mapped = || {
            Some(Places {
                time: exactly(&columns.time)?,
                sensor: exactly(&columns.sensor)?,
                value: exactly(&columns.value)?,
                label,
                is_mapped: true,
            })
        };
        let guessed = || {
            let (time, sensor, value) = (usual(&TIMES)?, usual(&SENSORS)?, usual(&VALUES)?);
            Some(Places { time, sensor, value, label, is_mapped: false })
        };
        mapped().or_else(guessed)
    }
}
