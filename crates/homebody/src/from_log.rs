//! What a log and a table of its sensors tell of a home, for a schematic one to be made.

use crate::failure::Failure;
use crate::sensor_table::Row;
use crate::traced::Traced;
use homebody_analysis::signs::Kind;
use homebody_analysis::walks::{Speaker, Walks};
use homebody_core::geometry::Point;
use homebody_core::problem::counted;
use homebody_import::from_log::{LogSensor, LogWay, Speaks};
use homebody_log::SensorInfo;
use std::collections::BTreeMap;

/// A log's sensors and ways as a home is made of them, and what is left out, a sentence each.
pub struct Told {
    pub sensors: Vec<LogSensor>,
    pub ways: Vec<LogWay>,
    pub remarks: Vec<String>,
}

/// Joins what a log tells with what a table says, where there is one. `known` are the sensors as a table beside the log has them.
pub fn told(
    walks: &Walks,
    table: &BTreeMap<String, Row>,
    known: &[SensorInfo],
    picture: Option<&Traced>,
) -> Result<Told, Failure> {
    let (mut sensors, mut problems, mut left_out) = (Vec::new(), Vec::new(), Vec::new());
    let mut numbers = vec![None; walks.sensors.len()];
    for (number, speaker) in walks.sensors.iter().enumerate() {
        let row = table.get(&speaker.id);
        let Some(speaks) = speaks(speaker, row) else {
            left_out.push(speaker.id.as_str());
            continue;
        };
        let at = match (row.and_then(|row| row.at), picture) {
            (Some(pixel), Some(picture)) if !picture.has(pixel) => {
                problems.push(format!("the sensor {:?} is not on the picture: {}, {}", speaker.id, pixel[0], pixel[1]));
                None
            }
            (Some(pixel), Some(picture)) => Some(picture.at(pixel)),
            (Some(at), None) => Some(Point::from(at)),
            (None, _) => None,
        };
        let known = known.iter().find(|known| known.id == speaker.id);
        numbers[number] = Some(sensors.len());
        sensors.push(LogSensor {
            room: row.and_then(|row| row.room.clone()).or_else(|| known?.room.clone()),
            place: row.and_then(|row| row.place.clone()).or_else(|| Some(known?.name.clone())),
            at,
            done: speaker.done.iter().map(|(label, count)| (label.clone(), *count)).collect(),
            at_silence: speaker.at_silence,
            on_s: speaker.on_s,
            ..LogSensor::new(&speaker.id, speaks, speaker.firings)
        });
    }
    if picture.is_some() && sensors.iter().all(|sensor| sensor.at.is_none()) {
        problems.push(
            "no sensor has a place on the picture\n  hint: give x and y of each, in pixels: --sensors FILE".into(),
        );
    }
    let is_heard = |id: &String| walks.sensors.iter().any(|speaker| speaker.id == *id);
    let unheard: Vec<&str> = table.keys().filter(|id| !is_heard(id)).map(String::as_str).collect();
    if !table.is_empty() && unheard.len() == table.len() {
        let ids: Vec<&str> = walks.sensors.iter().take(5).map(|speaker| speaker.id.as_str()).collect();
        problems.push(format!("none of the table's sensors is in the log\n  hint: the log has {}", ids.join(", ")));
    }
    if !problems.is_empty() {
        return Err(Failure::Usage(problems.join("\nerror: ")));
    }
    let mut remarks = Vec::new();
    if !left_out.is_empty() {
        let sensors = counted(left_out.len(), "sensor tells", "sensors tell");
        remarks.push(format!("left out: {sensors} neither of movement nor of doors: {}", first(&left_out)));
    }
    if !unheard.is_empty() {
        remarks.push(format!("left out: the log has nothing of {}", first(&unheard)));
    }
    let ways = walks.ways.iter().filter_map(|way| {
        let [a, b] = way.between.map(|end| numbers[end]);
        Some(LogWay { between: [a?, b?], times: way.times, soon_s: way.soon_s })
    });
    Ok(Told { ways: ways.collect(), sensors, remarks })
}

/// The first of some names.
fn first(names: &[&str]) -> String {
    /// So many are told (ours).
    const MOST: usize = 8;
    let more = if names.len() > MOST { " and others" } else { "" };
    names.iter().take(MOST).copied().collect::<Vec<_>>().join(", ") + more
}

/// What a sensor says of where somebody is, if anything.
fn speaks(speaker: &Speaker, row: Option<&Row>) -> Option<Speaks> {
    match (row.and_then(|row| row.kind.as_deref()), speaker.kind) {
        (Some("motion"), _) | (None, Kind::Motion) => Some(Speaks::Motion),
        (Some("contact"), _) | (None, Kind::Contact) => Some(Speaks::Contact),
        _ => None,
    }
}
