//! A log as it is read, wherever it comes from.

use super::activities::Activity;
use crate::sensor_info::SensorInfo;
use crate::skipped::Skipped;
use homebody_core::time::Micros;
use serde::Serialize;

/// A log in memory, or a part of one that is streamed; its rows in the order in which they were stored.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Log {
    /// The ids of the sensors, in the order in which they came.
    pub sensors: Vec<String>,
    /// What is known of sensors beside their ids, in no particular order; nothing of most.
    pub known: Vec<SensorInfo>,
    /// What sensors said, such as `ON`.
    pub values: Vec<String>,
    /// The rows that are in memory.
    pub events: Vec<Event>,
    /// How many rows have been read.
    pub rows: u64,
    /// The clock that its instants are told by.
    pub clock: Clock,
    /// What residents did, where the log notes it.
    pub activities: Vec<Activity>,
    /// What else is left out than lines: a sentence each.
    pub remarks: Vec<String>,
    /// The first of the lines that were skipped.
    pub problems: Vec<Skipped>,
    /// How many lines were skipped.
    pub skipped: u64,
}

/// One row of a log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Event {
    /// Microseconds since 1970 on the log's clock.
    pub at: Micros,
    /// Index into the log's sensors.
    pub sensor: u32,
    /// Index into the log's values.
    pub value: u32,
}

/// Which clock a log's instants are told by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Clock {
    /// The one on the wall, of a zone that the log does not tell.
    #[default]
    Local,
    /// The same everywhere on earth.
    Utc,
}

impl Log {
    /// The sensor's name.
    pub fn sensor(&self, event: &Event) -> &str {
        &self.sensors[event.sensor as usize]
    }

    /// Its rows in order of time; of one instant as they were read. Real logs are not always in order.
    pub fn in_order(&self) -> Vec<&Event> {
        let mut events: Vec<&Event> = self.events.iter().collect();
        events.sort_by_key(|event| event.at);
        events
    }

    /// What its sensors are called, in their order: by room and name, as far as they are known, or else by their ids.
    pub fn called(&self) -> Vec<String> {
        let called = |id: &String| {
            let known = self.known.iter().find(|known| known.id == *id)?;
            Some(known.room.iter().chain([&known.name]).map(String::as_str).collect::<Vec<_>>().join(" "))
        };
        self.sensors.iter().map(|id| called(id).unwrap_or_else(|| id.clone())).collect()
    }

    /// What the sensor said.
    pub fn value(&self, event: &Event) -> &str {
        &self.values[event.value as usize]
    }
}
