//! What a log and a table of its sensors tell of a home, for a schematic one to be made.

use super::inhabited::{Begun, Inhabited, inhabited};
use super::messages::NewMessage;
use super::sensor_table::Row;
use super::traced::Traced;
use crate::error::Error;
use crate::log_with_run::LogWithRun;
use homebody_analysis::dates::written;
use homebody_analysis::signs::Kind;
use homebody_analysis::walks::{Speaker, Walks, walks};
use homebody_core::geometry::Point;
use homebody_core::problem::{Problem, Problems, counted};
use homebody_core::time::DAY;
use homebody_import::from_log::{LogSensor, LogWay, Schematic, Speaks, schematic};
use homebody_log::SensorInfo;
use serde_json::json;
use std::collections::BTreeMap;

/// A log of whose home nobody has a plan, and what somebody knows of it besides.
pub struct GivenLog<'a> {
    /// As it was named.
    pub named: &'a str,
    /// What its file is called.
    pub file: &'a str,
    /// Its rows.
    pub read: &'a LogWithRun,
    /// The home's time zone, where it is told.
    pub time_zone: Option<&'a str>,
    /// What a table says of its sensors.
    pub table: BTreeMap<String, Row>,
    /// A picture of the plan.
    pub picture: Option<&'a Traced>,
}

/// A scenario in a home that was made of a log.
pub struct OfLog {
    /// Its files, who lives there, and what an ordinary life lacks.
    pub lived: Inhabited,
    /// What was left out or guessed, in sentences.
    pub remarks: Vec<String>,
}

/// What a schematic home says of itself.
const ABOUT: &str = "Which rooms and things there are is from names and from what was done; which are beside each other is from \
                     who follows whom and how soon. Sizes, shapes, walls and the places of doors are guesses.";

/// Longest new scenario, in days (our choice).
const MOST_DAYS: i64 = 365;

/// A scenario in a home that nobody has drawn: a scheme of rooms, things and places by what a log tells. Its days are those of the
/// log.
///
/// # Errors
///
/// [`Error::Unbeginnable`] where no home can be made of it, [`Error::Problems`] where somebody's words make none.
pub fn of_log(name: &str, given: &GivenLog) -> Result<OfLog, Error> {
    let log = &given.read.log;
    let Told { sensors, ways, mut remarks } = told(&walks(log), &given.table, &log.known, given.picture)?;
    let about =
        format!("Schematic: made of what the log {} tells, and of what its sensors are called. {ABOUT}", given.file);
    let home = schematic(name, &about, &sensors, &ways);
    let home = home.map_err(|error| Error::Unbeginnable(Problems(vec![Problem::of_file(given.named, error, None)])))?;
    let lived = inhabit(name, given, &home)?;
    remarks.extend(home.remarks);
    Ok(OfLog { lived, remarks })
}

fn inhabit(name: &str, given: &GivenLog, home: &Schematic) -> Result<Inhabited, Error> {
    let times = || given.read.log.events.iter().map(|event| event.at);
    let first = times().min().unwrap_or(0).div_euclid(DAY);
    let days = times().max().unwrap_or(0).div_euclid(DAY) - first + 1;
    let mut logger = json!({
        "$schema": "./schemas/logger.schema.json",
        "to": ["casas:log.txt"],
        "ids": home.ids,
        "time": "local",
    });
    if let Some(hold_s) = home.hold_s.filter(|hold_s| *hold_s > 0.0) {
        logger["messages"] = json!({ "on_off": { "hold_s": hold_s, "lumps": [] } });
    }
    let start = written(first * DAY);
    inhabited(&Begun {
        name,
        about: &format!("A home that the log {} tells of, drawn as a scheme. {ABOUT}", given.file),
        start: &start[..19].replace(' ', "T"),
        time_zone: given.time_zone.unwrap_or("UTC"),
        days: days.clamp(1, MOST_DAYS) as f64,
        home: home.home_json.clone(),
        logger: Some(format!("{logger:#}\n")),
    })
}

/// A log's sensors and ways as a home is made of them, and what is left out, a sentence each.
struct Told {
    sensors: Vec<LogSensor>,
    ways: Vec<LogWay>,
    remarks: Vec<String>,
}

/// Joins what a log tells with what a table says, where there is one. `known` are the sensors as a table beside the log has them.
fn told(
    walks: &Walks,
    table: &BTreeMap<String, Row>,
    known: &[SensorInfo],
    picture: Option<&Traced>,
) -> Result<Told, Error> {
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
                let sensor = speaker.id.clone();
                problems.push(NewMessage::OffPicture { sensor, x_px: pixel[0], y_px: pixel[1] }.into());
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
        problems.push(NewMessage::NothingOnPicture.into());
    }
    let is_heard = |id: &String| walks.sensors.iter().any(|speaker| speaker.id == *id);
    let unheard: Vec<&str> = table.keys().filter(|id| !is_heard(id)).map(String::as_str).collect();
    if !table.is_empty() && unheard.len() == table.len() {
        let ids = walks.sensors.iter().take(5).map(|speaker| speaker.id.clone()).collect();
        problems.push(NewMessage::OtherLog { ids }.into());
    }
    if !problems.is_empty() {
        return Err(Error::Unbeginnable(Problems(problems)));
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
    /// Largest number of items in a report (our choice).
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
