//! What a destination is told of a sensor, and what a source may know of one.

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
