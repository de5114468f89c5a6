//! The folder of a located log: the places of all people, and a simulation of their paths.

use crate::error::TrackingError;
use crate::translation::{PersonStay, PlaceChance, PossiblePlace, Translation, locate};
use homebody_analysis::explanation::{Explained, SensorExplained, explained};
use homebody_core::plan::Plan;
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::scheme::Scheme;
use homebody_core::time::{RunTime, Span, TimeScale, WallTime};
use homebody_infer::FaultIntervalKind;
use homebody_log::files::fresh::FreshFile;
use homebody_log::files::plain;
use homebody_log::run::places::{RECORDING, TRUTH};
use homebody_log::{Cancel, Event, Log, Url};
use homebody_query::LoadedLog;
use homebody_simulation::{Destinations, OpenMessage, SimulationError, new_folder, open};
use jiff::civil::DateTime;
use serde::{Deserialize, Serialize};
use std::fs;
use std::path::Path;

/// The folder of the run that simulates the paths.
pub const SIMULATED_RUN: &str = "run";
pub const GIVEN: &str = "given";
pub const WHERE: &str = "where.csv";
/// The table of the probabilities of the rooms of each person.
pub const ROOMS: &str = "rooms.csv";
/// The report as JSON.
pub const REPORT: &str = "report.json";

/// The word for being out in the table of rooms.
const OUT: &str = "out";

/// Largest number of rows that are read of the table of rooms (our choice): those of some years.
const MOST_DOUBTS: usize = 10_000_000;

/// Share of the time that locating takes (our choice). Simulating the path takes the rest.
const WALKING: f64 = 0.7;

#[derive(Clone, Debug, Serialize)]
pub struct LocatingReport {
    /// The name of the log, as the user gave it.
    pub log: String,
    pub rows: u64,
    /// The number of rows that locate a person.
    pub rows_taken: u64,
    /// The residents, and last a guest if there is one resident.
    pub people: Vec<String>,
    /// A guest was seen.
    pub guest_seen: bool,
    /// Sensors that the home lacks.
    pub unknown_sensors: Vec<UnknownSensor>,
    /// Sensors of the home that the log lacks.
    pub sensors_without_rows: Vec<String>,
    /// Sensors that could not be believed for a time.
    pub not_believed: Vec<DistrustedSensor>,
    /// The mismatches of the log and the home, in sentences.
    pub remarks: Vec<String>,
    /// The mean probability of the reported rooms.
    pub mean_chance: f64,
    /// The agreement of the log with a simulation of the path.
    pub explained: Explained,
}

#[derive(Clone, Debug, Serialize)]
pub struct UnknownSensor {
    pub id: String,
    pub rows: u64,
}

#[derive(Clone, Debug, Serialize)]
pub struct DistrustedSensor {
    pub sensor: String,
    pub from: String,
    pub to: String,
    pub why: FaultIntervalKind,
}

/// The part of a report that is read from its folder.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub struct LocatingSummary {
    /// The name of the log, as the user gave it.
    pub log: String,
    pub people: Vec<String>,
    /// The mismatches of the log and the home, in sentences.
    pub remarks: Vec<String>,
}

/// Locates the people of a log in the home of a scenario, simulates their paths, and writes all of it into a folder, which it creates.
/// `name` is the name of the log; `progress` gets the share that is done, from 0 to 1.
///
/// # Errors
///
/// Those of [`locate`], before anything is written; [`TrackingError::Simulation`] if something cannot be written.
pub fn locate_into(
    to: &Path,
    (name, read): (&str, &LoadedLog),
    scenario: &Scenario,
    cancel: &Cancel,
    mut progress: impl FnMut(f64),
) -> Result<LocatingReport, TrackingError> {
    let translation = locate(&read.log, scenario, cancel, |share| progress(share * WALKING))?;
    let mut written = |to: &Path| write_into(to, (name, read), scenario, &translation, cancel, &mut progress);
    // A folder with other files keeps them, so it cannot be replaced as a whole.
    match fs::read_dir(to).is_ok_and(|mut inner| inner.next().is_some()) {
        true => written(to),
        false => new_folder(to, |part, _| written(part)),
    }
}

fn write_into(
    to: &Path,
    (name, read): (&str, &LoadedLog),
    scenario: &Scenario,
    translation: &Translation,
    cancel: &Cancel,
    progress: &mut impl FnMut(f64),
) -> Result<LocatingReport, TrackingError> {
    for (file, text) in &translation.files {
        let path = to.join(file);
        path.parent().map_or(Ok(()), fs::create_dir_all).map_err(|error| SimulationError::io(&path, error))?;
        write(&path, text.as_bytes())?;
    }
    let plan = scenario.home.plan();
    write(&to.join(WHERE), &whereabouts(translation, plan)?)?;
    write(&to.join(ROOMS), &rooms(translation, plan)?)?;
    keep(&to.join(GIVEN), read)?;
    let relived = simulate_path(to, &translation.entry, cancel, |share| progress(WALKING + share * (1.0 - WALKING)))?;
    let mut report = report(name, read, &relived, translation);
    report.remarks.extend(unexplained_uses(&report.explained, scenario));
    let text = serde_json::to_string_pretty(&report).map_err(|error| SimulationError::file(to, error.to_string()))?;
    write(&to.join(REPORT), (text + "\n").as_bytes())?;
    Ok(report)
}

fn keep(given: &Path, read: &LoadedLog) -> Result<(), TrackingError> {
    fs::create_dir_all(given).map_err(|error| SimulationError::io(given, error))?;
    for file in &read.files {
        let to = given.join(file.file_name().unwrap_or_default());
        fs::copy(file, &to).map_err(|error| SimulationError::io(file, error))?;
    }
    Ok(())
}

/// Simulates the path, and returns its log.
fn simulate_path(
    to: &Path,
    entry: &str,
    cancel: &Cancel,
    mut progress: impl FnMut(f64),
) -> Result<LoadedLog, TrackingError> {
    let run = to.join(SIMULATED_RUN);
    fs::create_dir_all(&run).map_err(|error| SimulationError::io(&run, error))?;
    let destinations = Destinations {
        log: vec![Url::new(Scheme::Sqlite, run.join("log.db"))],
        truth: Some(Url::new(Scheme::Sqlite, run.join(TRUTH))),
        recording: Some(run.join(RECORDING)),
        ..Destinations::default()
    };
    let started = open(to.join(entry))?.run().cancel(cancel).start()?;
    let summary = started.store(&destinations, |now| progress(now.done.ratio(now.length.max(Span::MICROSECOND))))?;
    match summary.is_stopped() {
        true => Err(SimulationError::Cancelled.into()),
        false => Ok(LoadedLog::read(&run.to_string_lossy(), None)?),
    }
}

fn report(name: &str, read: &LoadedLog, relived: &LoadedLog, translation: &Translation) -> LocatingReport {
    let chances: Vec<f64> = translation.whereabouts.iter().map(|one| one.chance).collect();
    let not_believed = translation.spells.iter().map(|(sensor, spell)| DistrustedSensor {
        sensor: sensor.clone(),
        from: translation.wall_clock(spell.from),
        to: translation.wall_clock(spell.to),
        why: spell.ill,
    });
    let strangers = translation.strangers.iter().map(|(id, rows)| UnknownSensor { id: id.clone(), rows: *rows });
    LocatingReport {
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

/// A remark that a path uses no things, where the log has firings of sensors that report such use.
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

/// The part of a log that the paths cover, with the home's names of the sensors.
pub(crate) fn beginning(log: &Log, translation: &Translation) -> Log {
    let end = translation.calendar.local(RunTime::START + translation.acted_out).date();
    let is_strange = |name: &String| translation.strangers.iter().any(|(id, _)| id == name);
    let strange: Vec<bool> = translation.names.iter().map(is_strange).collect();
    let is_lived = |event: &Event| translation.acted_out == translation.length || event.at.date() < end;
    let is_told = |event: &&Event| is_lived(event) && !strange[event.sensor as usize];
    let events = log.events.iter().filter(is_told).copied().collect();
    Log { events, sensors: translation.names.clone(), ..log.clone() }
}

fn whereabouts(translation: &Translation, plan: &Plan) -> Result<Vec<u8>, SimulationError> {
    let header = ["time", "who", "room", "chance", "x_m", "y_m", "doing"];
    let row = |one: &PersonStay| {
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

fn rooms(translation: &Translation, plan: &Plan) -> Result<Vec<u8>, SimulationError> {
    let row = |one: &PlaceChance| {
        let place = match one.place {
            PossiblePlace::Out => OUT.to_owned(),
            PossiblePlace::Between => String::new(),
            PossiblePlace::Room(room) => plan.rooms[room].name.clone(),
        };
        let who = translation.people[one.who].clone();
        [translation.wall_clock(one.at), who, place, format!("{:.3}", one.chance)]
    };
    table(["time", "who", "room", "chance"], translation.doubts.iter().map(row))
}

/// Reads the table of rooms in a folder; `clock` reads its instants, and `people` are those of its report.
pub fn doubts(
    table: &Path,
    people: &[String],
    plan: &Plan,
    clock: &TimeScale,
) -> Result<Vec<PlaceChance>, SimulationError> {
    let wrong = |why: String| SimulationError::file(table, why);
    let file = plain::open(table).map_err(|error| SimulationError::io(table, error))?;
    let mut reader = csv::Reader::from_reader(file);
    let (mut doubts, mut last) = (Vec::new(), RunTime::MIN);
    for record in reader.records() {
        let record = record.map_err(|error| wrong(error.to_string()))?;
        if doubts.len() == MOST_DOUBTS {
            return Err(SimulationError::unreadable(table, OpenMessage::TooManyRows { most: MOST_DOUBTS }));
        }
        let row = || {
            let [time, who, place, chance] = [0, 1, 2, 3].map(|cell| record.get(cell));
            let told = time?.parse::<DateTime>().ok()?;
            let place = match place? {
                "" => PossiblePlace::Between,
                name => match plan.rooms.iter().position(|room| room.name == name) {
                    Some(room) => PossiblePlace::Room(room),
                    None if name == OUT => PossiblePlace::Out,
                    None => return None,
                },
            };
            let who = people.iter().position(|name| Some(name.as_str()) == who)?;
            let chance = chance?.parse().ok().filter(|chance| (0.0..=1.0).contains(chance))?;
            Some((told, PlaceChance { at: RunTime::START, who, place, chance }))
        };
        let line = record.position().map_or(0, csv::Position::line);
        let (told, doubt) =
            row().ok_or_else(|| SimulationError::unreadable(table, OpenMessage::BadRow { table_line: line }))?;
        last = clock.run_from_wall(WallTime::from(told), last);
        doubts.push(PlaceChance { at: last, ..doubt });
    }
    Ok(doubts)
}

fn table<const N: usize>(
    header: [&str; N],
    rows: impl Iterator<Item = [String; N]>,
) -> Result<Vec<u8>, SimulationError> {
    let failed = |error: csv::Error| SimulationError::file(Path::new(header[0]), error.to_string());
    let mut table = csv::Writer::from_writer(Vec::new());
    table.write_record(header).map_err(failed)?;
    for row in rows {
        table.write_record(row).map_err(failed)?;
    }
    table.into_inner().map_err(|error| failed(csv::Error::from(std::io::Error::other(error.to_string()))))
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), SimulationError> {
    Ok(FreshFile::write_whole(path, bytes, false)?)
}
