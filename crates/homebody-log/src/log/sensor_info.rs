//! Facts about a sensor, for destinations and from sources.

use homebody_core::sensors::kinds::KINDS;

/// Facts about a sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorInfo {
    /// Its name in the home.
    pub name: String,
    /// The id in the log.
    pub id: String,
    /// Whether it senses motion, so that its messages may be held ON.
    pub is_motion: bool,
    /// Its kind, as `home.json` or the log's source writes it; empty if nothing does.
    pub kind: String,
    /// The origin of the kind.
    pub said_by: SaidBy,
    /// Of its readings, such as `°C`. None for one that gives no readings.
    pub unit: Option<String>,
    /// Its values other than readings, such as `OPEN` and `CLOSE`; the logger may translate them. `OFF` too for a motion sensor whose
    /// messages are held.
    pub values: Vec<String>,
    /// The room that it is in. None between rooms, as on a door.
    pub room: Option<String>,
    /// Its place on the plan, in metres to the east and to the north.
    pub at_m: [f64; 2],
}

/// The origin of what is known of a kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SaidBy {
    /// The log's source: its columns, its attributes, its registry.
    #[default]
    Source,
    /// The table of the log's sensors.
    Table,
    /// The home that the log is of.
    Home,
}

impl SensorInfo {
    /// A sensor of a kind, as `home.json` writes it, which says these besides readings; where it is is not known.
    pub fn of_kind(name: &str, kind: &str, values: &[&str]) -> SensorInfo {
        let values = values.iter().map(ToString::to_string).collect();
        SensorInfo { is_motion: kind.ends_with("motion"), kind: kind.to_owned(), values, ..SensorInfo::named(name) }
    }

    /// Fills what is not known of it from what another source has of the same sensor.
    pub fn fill(&mut self, other: SensorInfo) {
        if self.name == self.id {
            self.name = other.name;
        }
        if self.kind.is_empty() {
            (self.kind, self.said_by, self.is_motion) = (other.kind, other.said_by, other.is_motion);
        }
        if self.values.is_empty() {
            self.values = other.values;
        }
        self.unit = self.unit.take().or(other.unit);
        self.room = self.room.take().or(other.room);
        if self.at_m == [0.0; 2] {
            self.at_m = other.at_m;
        }
    }

    /// The sensor of a row of a table: its id, name, kind, room and unit, each empty where it is not known.
    pub fn of_cells([id, name, kind, room, unit]: [String; 5]) -> SensorInfo {
        let row = KINDS.iter().find(|row| row.key == kind);
        let known = |text: String| Some(text).filter(|text| !text.is_empty());
        SensorInfo {
            name: known(name).unwrap_or_else(|| id.clone()),
            is_motion: row.is_some_and(|row| row.senses_motion()),
            unit: known(unit).or_else(|| Some(row?.unit?.symbol.to_owned())),
            values: row.map(|row| row.values.iter().map(ToString::to_string).collect()).unwrap_or_default(),
            said_by: if kind.is_empty() { SaidBy::Source } else { SaidBy::Table },
            kind,
            room: known(room),
            at_m: [0.0; 2],
            id,
        }
    }

    /// A sensor with nothing but its id.
    pub(crate) fn named(id: &str) -> SensorInfo {
        SensorInfo {
            name: id.to_owned(),
            id: id.to_owned(),
            is_motion: false,
            kind: String::new(),
            said_by: SaidBy::default(),
            unit: None,
            values: Vec::new(),
            room: None,
            at_m: [0.0; 2],
        }
    }
}

/// The table of sensors in a database.
pub(crate) const SENSOR: &str = "sensor";

/// Its columns, behind the run's id; all are texts.
pub const SENSOR_COLUMNS: [&str; 5] = ["id", "name", "kind", "room", "unit"];

/// The cells of a sensor, in the order of the columns; None for an unknown one.
pub fn sensor_cells(sensor: &SensorInfo) -> [Option<&str>; 5] {
    let kind = Some(sensor.kind.as_str()).filter(|kind| !kind.is_empty());
    [Some(&sensor.id), Some(&sensor.name), kind, sensor.room.as_deref(), sensor.unit.as_deref()]
}

/// Whether anything is known of sensors besides their ids.
pub fn says_more_of(sensors: &[SensorInfo]) -> bool {
    sensors.iter().any(|sensor| {
        sensor.name != sensor.id || !sensor.kind.is_empty() || sensor.room.is_some() || sensor.unit.is_some()
    })
}
