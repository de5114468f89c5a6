//! What a destination is told of a sensor, and what a source may know of one.

use homebody_core::sensors::kinds::KINDS;

/// What there is to know of a sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorInfo {
    /// Its name in the home.
    pub name: String,
    /// What the log calls it.
    pub id: String,
    /// Whether it senses motion, so that its messages may be held ON.
    pub is_motion: bool,
    /// What kind of sensor it is, as `home.json` writes it.
    pub kind: String,
    /// Of its readings, such as `°C`. None for one that gives no readings.
    pub unit: Option<String>,
    /// What it says besides readings, such as `OPEN` and `CLOSE`; the logger may translate it. Of a motion sensor whose messages are held,
    /// `OFF` too.
    pub values: Vec<String>,
    /// The room that it is in. None between rooms, as on a door.
    pub room: Option<String>,
    /// Where it is on the plan, in metres to the east and to the north.
    pub at_m: [f64; 2],
}

impl SensorInfo {
    /// A sensor of a kind, as `home.json` writes it, which says these besides readings; where it is is not known.
    pub fn of_kind(name: &str, kind: &str, values: &[&str]) -> SensorInfo {
        let values = values.iter().map(ToString::to_string).collect();
        SensorInfo { is_motion: kind.ends_with("motion"), kind: kind.to_owned(), values, ..SensorInfo::named(name) }
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
            kind,
            room: known(room),
            at_m: [0.0; 2],
            id,
        }
    }

    /// A sensor of which no more is known than what a log calls it.
    pub(crate) fn named(id: &str) -> SensorInfo {
        SensorInfo {
            name: id.to_owned(),
            id: id.to_owned(),
            is_motion: false,
            kind: String::new(),
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
