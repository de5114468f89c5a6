//! A log that was walked back, as a folder: what was found out, and the path of everybody lived again.

use crate::error::Error;
use crate::log_with_run::LogWithRun;
use crate::open_messages::OpenMessage;
use crate::scenario::open;
use crate::store::Destinations;
use crate::translation::{Doubt, Place, Translation, Whereabouts, walk_back};
use crate::whole_folder::whole_folder;
use homebody_analysis::dates::date_of;
use homebody_analysis::explained::{Explained, SensorExplained, explained};
use homebody_core::home::plan::Plan;
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::scheme::Scheme;
use homebody_core::time::Micros;
use homebody_infer::Ill;
use homebody_log::fresh::FreshFile;
use homebody_log::places::{RECORDING, TRUTH};
use homebody_log::{Cancel, Event, Log, RunClock, Url, plain};
use jiff::civil::DateTime;
use serde::{Deserialize, Serialize};
use std::fs;
use std::path::Path;

/// The folder of the run in which the path is lived again.
pub const RELIVED: &str = "run";
/// The folder with a copy of the log as it was given.
pub const GIVEN: &str = "given";
/// The table of where everybody was.
pub const WHERE: &str = "where.csv";
/// The table of how likely everybody was in each room.
pub const ROOMS: &str = "rooms.csv";
/// What came of it, as JSON.
pub const REPORT: &str = "report.json";

/// What being out is called in the table of rooms.
const OUT: &str = "out";

/// Largest number of rows that are read of the table of rooms (our choice): those of some years.
const MOST_DOUBTS: usize = 10_000_000;

/// Share of the time that locating takes (our choice). Simulating the path takes the rest.
const WALKING: f64 = 0.7;

/// What came of walking a log back.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// As the log was named.
    pub log: String,
    /// How many rows the log has.
    pub rows: u64,
    /// How many of them say where somebody is.
    pub rows_taken: u64,
    /// Who is told of; last a guest where nobody else lives with the first.
    pub people: Vec<String>,
    /// Whether a guest was ever there.
    pub guest_seen: bool,
    /// Sensors that the home does not have.
    pub unknown_sensors: Vec<Stranger>,
    /// Sensors of the home that the log does not have.
    pub sensors_without_rows: Vec<String>,
    /// Sensors that could not be believed for a time.
    pub not_believed: Vec<NotBelieved>,
    /// What does not fit together, in sentences.
    pub remarks: Vec<String>,
    /// How likely the rooms are that were told, on average.
    pub mean_chance: f64,
    /// How well the path explains the log when it is lived again.
    pub explained: Explained,
}

/// A sensor that the home does not have.
#[derive(Clone, Debug, Serialize)]
pub struct Stranger {
    /// What the log calls it.
    pub id: String,
    /// How many rows it has.
    pub rows: u64,
}

/// A sensor that could not be believed for a time.
#[derive(Clone, Debug, Serialize)]
pub struct NotBelieved {
    /// Its name in the home.
    pub sensor: String,
    /// From when, on the clock on the wall.
    pub from: String,
    /// Until when.
    pub to: String,
    /// What was the matter with it.
    pub why: Ill,
}

/// What a report says that is wanted again when its folder is looked at.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub struct Reported {
    /// As the log was named.
    pub log: String,
    /// Who is told of in the tables.
    pub people: Vec<String>,
    /// What does not fit together, in sentences.
    pub remarks: Vec<String>,
}

/// Walks a log back through the home of a scenario, lives the path again, and writes all of it into a folder, which is made.
/// `name` is what the log was called; `progress` gets the share that is done, from 0 to 1.
///
/// # Errors
///
/// Those of [`walk_back`], of which nothing is written; [`Error::File`] and [`Error::Log`] where something cannot be written.
pub fn walk_into(
    to: &Path,
    (name, read): (&str, &LogWithRun),
    scenario: &Scenario,
    cancel: &Cancel,
    mut progress: impl FnMut(f64),
) -> Result<Report, Error> {
    let translation = walk_back(&read.log, scenario, cancel, |share| progress(share * WALKING))?;
    let mut written = |to: &Path| write_into(to, (name, read), scenario, &translation, cancel, &mut progress);
    // A folder with other files keeps them, so it cannot be replaced as a whole.
    match fs::read_dir(to).is_ok_and(|mut inner| inner.next().is_some()) {
        true => written(to),
        false => whole_folder(to, |part, _| written(part)),
    }
}

/// Writes what a log was walked back to into a folder that is there.
fn write_into(
    to: &Path,
    (name, read): (&str, &LogWithRun),
    scenario: &Scenario,
    translation: &Translation,
    cancel: &Cancel,
    progress: &mut impl FnMut(f64),
) -> Result<Report, Error> {
    for (file, text) in &translation.files {
        let path = to.join(file);
        path.parent().map_or(Ok(()), fs::create_dir_all).map_err(|error| Error::io(&path, error))?;
        write(&path, text.as_bytes())?;
    }
    let plan = scenario.home.plan();
    write(&to.join(WHERE), &whereabouts(translation, plan)?)?;
    write(&to.join(ROOMS), &rooms(translation, plan)?)?;
    keep(&to.join(GIVEN), read)?;
    let relived = relive(to, &translation.entry, cancel, |share| progress(WALKING + share * (1.0 - WALKING)))?;
    let mut report = report(name, read, &relived, translation);
    report.remarks.extend(unexplained_uses(&report.explained, scenario));
    let text = serde_json::to_string_pretty(&report).map_err(|error| Error::file(to, error.to_string()))?;
    write(&to.join(REPORT), (text + "\n").as_bytes())?;
    Ok(report)
}

/// Copies the files of a log.
fn keep(given: &Path, read: &LogWithRun) -> Result<(), Error> {
    fs::create_dir_all(given).map_err(|error| Error::io(given, error))?;
    for file in &read.files {
        let to = given.join(file.file_name().unwrap_or_default());
        fs::copy(file, &to).map_err(|error| Error::io(file, error))?;
    }
    Ok(())
}

/// Lives the path again; its log.
fn relive(to: &Path, entry: &str, cancel: &Cancel, mut progress: impl FnMut(f64)) -> Result<LogWithRun, Error> {
    let run = to.join(RELIVED);
    fs::create_dir_all(&run).map_err(|error| Error::io(&run, error))?;
    let destinations = Destinations {
        log: vec![Url::new(Scheme::Sqlite, run.join("log.db"))],
        truth: Some(Url::new(Scheme::Sqlite, run.join(TRUTH))),
        recording: Some(run.join(RECORDING)),
        ..Destinations::default()
    };
    let started = open(to.join(entry))?.run().cancel(cancel).start()?;
    let lived = started.store(&destinations, |now| progress(now.lived as f64 / now.length.max(1) as f64))?;
    match lived.is_stopped() {
        true => Err(Error::Cancelled),
        false => LogWithRun::read(&run.to_string_lossy(), None),
    }
}

fn report(name: &str, read: &LogWithRun, relived: &LogWithRun, translation: &Translation) -> Report {
    let chances: Vec<f64> = translation.whereabouts.iter().map(|one| one.chance).collect();
    let not_believed = translation.spells.iter().map(|(sensor, spell)| NotBelieved {
        sensor: sensor.clone(),
        from: translation.wall_clock(spell.from),
        to: translation.wall_clock(spell.to),
        why: spell.ill,
    });
    let strangers = translation.strangers.iter().map(|(id, rows)| Stranger { id: id.clone(), rows: *rows });
    Report {
        log: name.into(),
        rows: translation.rows[1],
        rows_taken: translation.rows[0],
        people: translation.people.clone(),
        guest_seen: translation.has_guest,
        unknown_sensors: strangers.collect(),
        sensors_without_rows: translation.unheard.clone(),
        not_believed: not_believed.collect(),
        remarks: translation.misfits(),
        mean_chance: chances.iter().sum::<f64>() / chances.len().max(1) as f64,
        explained: explained(&beginning(&read.log, translation), &relived.log),
    }
}

/// Says that a path uses no things, where the log has firings of sensors that report such use.
fn unexplained_uses(explained: &Explained, scenario: &Scenario) -> Option<String> {
    let sensors = scenario.home.placed_sensors();
    let reports_use = |name: &str| sensors.iter().any(|sensor| sensor.name == name && !sensor.senses_motion());
    let silent = |one: &&SensorExplained| one.counts.real > 0 && one.counts.relived == 0 && reports_use(&one.sensor);
    let uses: Vec<&SensorExplained> = explained.sensors.iter().filter(silent).collect();
    let firings: u64 = uses.iter().map(|one| one.counts.real).sum();
    let names: Vec<&str> = uses.iter().map(|one| one.sensor.as_str()).take(MOST_NAMED).collect();
    let more = if uses.len() > names.len() { " and others" } else { "" };
    (firings > 0).then(|| {
        format!(
            "{firings} of {} firings report that somebody used a thing ({}{more}): a located path uses nothing, \
             so it explains none of them",
            explained.all.real,
            names.join(", ")
        )
    })
}

/// Largest number of sensors in a sentence.
const MOST_NAMED: usize = 5;

/// The part of a log that is lived again, by the home's own names of its sensors.
pub(crate) fn beginning(log: &Log, translation: &Translation) -> Log {
    let end = translation.calendar.local(translation.acted_out).date();
    let is_strange = |name: &String| translation.strangers.iter().any(|(id, _)| id == name);
    let strange: Vec<bool> = translation.names.iter().map(is_strange).collect();
    let is_lived = |event: &Event| translation.acted_out == translation.length || date_of(event.at) < end;
    let is_told = |event: &&Event| is_lived(event) && !strange[event.sensor as usize];
    let events = log.events.iter().filter(is_told).copied().collect();
    Log { events, sensors: translation.names.clone(), ..log.clone() }
}

/// Where everybody was, as a table.
fn whereabouts(translation: &Translation, plan: &Plan) -> Result<Vec<u8>, Error> {
    let header = ["time", "who", "room", "chance", "x_m", "y_m", "doing"];
    let row = |one: &Whereabouts| {
        let metres =
            |of: fn((f64, f64)) -> f64| one.place.map_or(String::new(), |at| format!("{:.2}", of((at.x, at.y))));
        [
            translation.wall_clock(one.at),
            translation.people[one.who].clone(),
            one.room.map_or(String::new(), |room| plan.rooms[room].name.clone()),
            format!("{:.3}", one.chance),
            metres(|at| at.0),
            metres(|at| at.1),
            format!("{:?}", one.kind).to_lowercase(),
        ]
    };
    table(header, translation.whereabouts.iter().map(row))
}

/// How likely everybody was in each room, as a table.
fn rooms(translation: &Translation, plan: &Plan) -> Result<Vec<u8>, Error> {
    let row = |one: &Doubt| {
        let place = match one.place {
            Place::Out => OUT.to_owned(),
            Place::Between => String::new(),
            Place::Room(room) => plan.rooms[room].name.clone(),
        };
        let who = translation.people[one.who].clone();
        [translation.wall_clock(one.at), who, place, format!("{:.3}", one.chance)]
    };
    table(["time", "who", "room", "chance"], translation.doubts.iter().map(row))
}

/// What the table of rooms in a folder says; `clock` reads its instants, and `people` are those of its report.
///
/// # Errors
///
/// [`Error::File`] where it cannot be read, or is none.
pub fn doubts(table: &Path, people: &[String], plan: &Plan, clock: &RunClock) -> Result<Vec<Doubt>, Error> {
    let wrong = |why: String| Error::file(table, why);
    let file = plain::open(table).map_err(|error| Error::io(table, error))?;
    let mut reader = csv::Reader::from_reader(file);
    let (mut doubts, mut last) = (Vec::new(), Micros::MIN);
    for record in reader.records() {
        let record = record.map_err(|error| wrong(error.to_string()))?;
        if doubts.len() == MOST_DOUBTS {
            return Err(Error::unreadable(table, OpenMessage::TooManyRows { most: MOST_DOUBTS }));
        }
        let row = || {
            let [time, who, place, chance] = [0, 1, 2, 3].map(|cell| record.get(cell));
            let told = time?.parse::<DateTime>().ok()?;
            let place = match place? {
                "" => Place::Between,
                name => match plan.rooms.iter().position(|room| room.name == name) {
                    Some(room) => Place::Room(room),
                    None if name == OUT => Place::Out,
                    None => return None,
                },
            };
            let who = people.iter().position(|name| Some(name.as_str()) == who)?;
            let chance = chance?.parse().ok().filter(|chance| (0.0..=1.0).contains(chance))?;
            Some((told, Doubt { at: 0, who, place, chance }))
        };
        let line = record.position().map_or(0, csv::Position::line);
        let (told, doubt) = row().ok_or_else(|| Error::unreadable(table, OpenMessage::BadRow { table_line: line }))?;
        let told = jiff::tz::TimeZone::UTC.to_timestamp(told).map_err(|error| wrong(error.to_string()))?;
        last = clock.instant(told.as_microsecond(), last);
        doubts.push(Doubt { at: last, ..doubt });
    }
    Ok(doubts)
}

fn table<const N: usize>(header: [&str; N], rows: impl Iterator<Item = [String; N]>) -> Result<Vec<u8>, Error> {
    let failed = |error: csv::Error| Error::file(Path::new(header[0]), error.to_string());
    let mut table = csv::Writer::from_writer(Vec::new());
    table.write_record(header).map_err(failed)?;
    for row in rows {
        table.write_record(row).map_err(failed)?;
    }
    table.into_inner().map_err(|error| failed(csv::Error::from(std::io::Error::other(error.to_string()))))
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    Ok(FreshFile::write_whole(path, bytes, false)?)
}
