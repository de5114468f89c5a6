//! A log in memory, from any source.

pub(crate) mod activities;
pub(crate) mod pairs;
pub(crate) mod sensor_info;
pub(crate) mod spans;

use crate::error::Skipped;
pub(crate) use activities::ActivityNotes;
use homebody_core::calendar::Calendar;
use homebody_core::time::{Interval, Span, TimeScale, UtcTime, WallTime};
use homebody_timeline::Episode;
use jiff::tz::TimeZone;
pub(crate) use pairs::Pairs;
pub(crate) use sensor_info::SENSOR;
pub use sensor_info::{SENSOR_COLUMNS, SaidBy, SensorInfo, says_more_of, sensor_cells};
use serde::Serialize;
pub(crate) use spans::{CHANGE, GoingOn, LABEL, RowNotes};
pub use spans::{SPAN_COLUMNS, SPANS};

/// A log in memory, or a part of one that is streamed, with its rows in the order of storage.
///
/// Its instants are local times of its clock. A log on the clock of a run is a `Log<RunTime>`, a log in UTC a `Log<UtcTime>`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Log<T = WallTime> {
    /// The ids of the sensors, in the order of their first rows.
    pub sensors: Vec<String>,
    /// Facts about sensors beyond their ids, in no particular order; most sensors have none.
    pub known: Vec<SensorInfo>,
    /// The values of rows, such as `ON`.
    pub values: Vec<String>,
    /// The sensors that report two texts in turn, one of which is not a known state; empty before the last row.
    pub pairs: Vec<ValuePair>,
    /// The rows that are in memory.
    pub events: Vec<Event<T>>,
    /// The number of rows.
    pub rows: u64,
    /// The clock of the instants in its file.
    pub clock: Clock,
    /// The activities of residents, if the log notes them.
    pub activities: Vec<Episode<T>>,
    /// The role of each column of a table, and the evidence; empty for forms without columns.
    pub columns: Vec<ColumnUse>,
    /// The offsets from UTC that its instants were written with, in the order of the rows; empty without offsets.
    pub offsets: Vec<OffsetSpan>,
    /// The zone of its home, where the place of the log names it.
    pub zone: Option<TimeZone>,
    /// Spans without a record, in the order of time. The state before such a span is unknown within it.
    pub gaps: Vec<Interval<T>>,
    /// Omissions other than lines, a sentence each.
    pub remarks: Vec<String>,
    /// The first of the lines that were skipped.
    pub problems: Vec<Skipped>,
    /// The number of skipped lines.
    pub skipped: u64,
}

/// One row of a log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Event<T = WallTime> {
    /// When it was stored.
    pub at: T,
    /// Index into the log's sensors.
    pub sensor: u32,
    /// Index into the log's values.
    pub value: u32,
}

/// A sensor that says two texts in turn, and none but these.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ValuePair {
    /// The sensor, by its number in the log.
    pub sensor: u32,
    /// The two texts, by their numbers in the log, the first one first.
    pub values: [u32; 2],
    /// For how long each of them held in all, until the next row.
    pub held: [Span; 2],
    /// Whether the other text follows most of the times.
    pub takes_turns: bool,
}

/// From when to when instants were written with one offset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OffsetSpan {
    /// The first of them.
    pub from: UtcTime,
    /// The last.
    pub to: UtcTime,
    /// The offset of local time from UTC.
    pub ahead: Span,
}

/// The role that a reader gave to a column of a table.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ColumnUse {
    /// Its heading; without one its place, such as `column 2`.
    pub column: String,
    /// Its role.
    pub used_as: ColumnRole,
    /// By which evidence, such as `its heading` or `9 of 10 cells are instants`.
    pub because: String,
    /// Whether the cells of a table decide, instead of a heading or the form.
    #[serde(skip)]
    pub is_guess: bool,
}

impl ColumnUse {
    /// The reason for a column that its heading decides.
    pub(crate) const HEADING: &str = "its heading";

    /// The use of a column of a table, whose heading decides where the reason begins so.
    pub(crate) fn of_table(column: String, used_as: ColumnRole, because: String) -> ColumnUse {
        let has_heading = because.starts_with(Self::HEADING);
        let is_guess = !has_heading && !matches!(used_as, ColumnRole::Unused | ColumnRole::OneSensor);
        ColumnUse { column, used_as, because, is_guess }
    }
}

/// The role of a column of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ColumnRole {
    /// When a row was stored, or a part of it: a date alone, a time of day alone.
    Time,
    /// When what the row reports ended.
    End,
    /// For how long it lasted.
    Duration,
    /// Which sensor reported.
    Sensor,
    /// The value that the sensor reported.
    Value,
    /// The activity of a person.
    Label,
    /// Which home or person the row belongs to.
    Home,
    /// The kind of the sensor.
    Kind,
    /// In which room the sensor is.
    Room,
    /// The unit of the value.
    Unit,
    /// The readings of one sensor, whose name is the heading.
    OneSensor,
    /// Nothing: the reader passes it over.
    Unused,
}

/// The clock of a log's instants.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Clock {
    /// The one on the wall, of a zone that the log does not tell.
    #[default]
    Local,
    /// The same everywhere on earth.
    Utc,
}

impl Clock {
    /// The time scale of a run of this length whose local time is that of this clock.
    pub fn scale(self, calendar: &Calendar, length: Span) -> TimeScale {
        let scale = calendar.scale(length);
        if self == Clock::Utc { scale.with_wall_of_utc() } else { scale }
    }
}

impl<T> Event<T> {
    /// The same row at an instant of another scale.
    pub fn map<U>(self, change: impl FnOnce(T) -> U) -> Event<U> {
        Event { at: change(self.at), sensor: self.sensor, value: self.value }
    }
}

impl<T> Log<T> {
    /// The same log with these rows, activities and gaps, as on another scale.
    pub fn with<U>(self, events: Vec<Event<U>>, activities: Vec<Episode<U>>, gaps: Vec<Interval<U>>) -> Log<U> {
        Log {
            sensors: self.sensors,
            known: self.known,
            values: self.values,
            pairs: self.pairs,
            events,
            rows: self.rows,
            clock: self.clock,
            activities,
            columns: self.columns,
            offsets: self.offsets,
            zone: self.zone,
            gaps,
            remarks: self.remarks,
            problems: self.problems,
            skipped: self.skipped,
        }
    }

    /// The sensor's name.
    pub fn sensor(&self, event: &Event<T>) -> &str {
        &self.sensors[event.sensor as usize]
    }

    /// Its rows in order of time, at equal instants in reading order. Real logs are not always in order.
    pub fn in_order(&self) -> Vec<&Event<T>>
    where
        T: Copy + Ord,
    {
        let mut events: Vec<&Event<T>> = self.events.iter().collect();
        events.sort_by_key(|event| event.at);
        events
    }

    /// The names of its sensors, in their order: room and name if they are known, else the ids.
    pub fn called(&self) -> Vec<String> {
        let called = |id: &String| {
            let known = self.known.iter().find(|known| known.id == *id)?;
            Some(known.room.iter().chain([&known.name]).map(String::as_str).collect::<Vec<_>>().join(" "))
        };
        self.sensors.iter().map(|id| called(id).unwrap_or_else(|| id.clone())).collect()
    }

    /// The value of a row.
    pub fn value(&self, event: &Event<T>) -> &str {
        &self.values[event.value as usize]
    }
}
