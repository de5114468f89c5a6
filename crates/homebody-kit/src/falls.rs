//! Falls in the silhouettes that a run's cameras have kept.

use crate::error::Error;
use crate::log_with_run::NamedLog;
use homebody_analysis::falls::rules::FallRules;
use homebody_analysis::falls::scenes::{Scenes, Seen};
use homebody_analysis::falls::watch::Fall;
use homebody_core::camera::lens::Lens;
use homebody_core::geometry::point;
use homebody_core::home::plan::Plan;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{Micros, seconds};
use homebody_log::places::SILHOUETTES;
use homebody_log::silhouettes::{Kept, Silhouettes};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// What was found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FallsFound {
    /// The log's name.
    pub name: String,
    /// How many cameras there are.
    pub cameras: usize,
    /// How many pictures with somebody they have kept.
    pub pictures: u64,
    /// How many instants two cameras or more agreed on.
    pub voxel_persons: u64,
    /// The falls, in order of time.
    pub falls: Vec<Fallen>,
}

/// A fall.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fallen {
    /// When it was, on the clock on the wall.
    pub at: String,
    /// When it was told.
    pub alarm_at: String,
    /// How long that took, in seconds.
    pub seconds_to_alarm: f64,
    /// The room, if it is in one.
    pub room: Option<String>,
    /// Where, in metres.
    pub at_m: [f64; 2],
    /// The rule that says so.
    pub rule: String,
    /// How sure it is, from 0 to 1.
    pub confidence: f64,
    /// The same in words.
    pub words: &'static str,
}

/// The silhouettes that a run has left beside its log.
pub struct LogWithSilhouettes<'a> {
    /// The file.
    pub silhouettes: Silhouettes,
    /// The scenario of the run.
    pub scenario: &'a Scenario,
}

impl<'a> LogWithSilhouettes<'a> {
    /// Opens those beside a log.
    ///
    /// # Errors
    ///
    /// [`Error::NoSilhouettes`] if the log is of no run with cameras, [`Error::Log`] if their file cannot be read.
    pub fn beside(named: &'a NamedLog) -> Result<LogWithSilhouettes<'a>, Error> {
        let missing = || Error::NoSilhouettes { log: named.name.clone() };
        let path = silhouettes_of(named.place.path()).ok_or_else(missing)?;
        LogWithSilhouettes::of(&path, named.scenario().ok_or_else(missing)?)
    }

    /// Opens a file of the run of a scenario.
    ///
    /// # Errors
    ///
    /// [`Error::Log`] if it cannot be read.
    pub fn of(path: &Path, scenario: &'a Scenario) -> Result<LogWithSilhouettes<'a>, Error> {
        let silhouettes = Silhouettes::open(path, scenario.calendar.timestamp(0).as_microsecond())?;
        Ok(LogWithSilhouettes { silhouettes, scenario })
    }

    /// How each camera projects.
    pub fn lenses(&self) -> Vec<Lens> {
        self.silhouettes.cameras.iter().map(|camera| camera.file.lens()).collect()
    }

    /// Looks for falls in all of them. `go_on` hears the instant that it has come to, and says whether anybody still waits.
    ///
    /// # Errors
    ///
    /// [`Error::Log`] if they cannot be read, [`Error::Cancelled`] if nobody waits any more.
    pub fn falls(&self, rules: &FallRules, mut go_on: impl FnMut(Micros) -> bool) -> Result<Looked, Error> {
        let lenses = self.lenses();
        let mut scenes = Scenes::new(self.scenario.home.plan(), &lenses, rules);
        let (mut pictures, mut falls) = (0, Vec::new());
        self.silhouettes.for_each::<Error>(|Kept { at, camera, silhouette, .. }| {
            pictures += 1;
            falls.extend(scenes.next(Seen { at, camera, silhouette }));
            if go_on(at) { Ok(()) } else { Err(Error::Cancelled) }
        })?;
        falls.extend(scenes.look());
        falls.sort_by_key(|fall| fall.at);
        Ok(Looked { falls, pictures, voxel_persons: scenes.voxel_persons })
    }

    /// What is said of a fall in a line.
    pub fn words(&self, fall: &Fall) -> String {
        let Fallen { seconds_to_alarm, room, rule, confidence, words, .. } =
            fallen(fall, self.scenario.home.plan(), |_| String::new());
        let place = room.map_or(String::new(), |room| format!(", {room}"));
        format!("by cameras: {words}{place} ({confidence:.2}; {rule}), told after {seconds_to_alarm:.1} s")
    }
}

/// What was found in silhouettes.
#[derive(Clone, Debug, PartialEq)]
pub struct Looked {
    /// The falls, in order of time.
    pub falls: Vec<Fall>,
    /// How many pictures there were.
    pub pictures: u64,
    /// How many instants two cameras or more agreed on.
    pub voxel_persons: u64,
}

/// The file of the silhouettes beside a log, if there is one.
pub fn silhouettes_of(log: &Path) -> Option<PathBuf> {
    Some(log.with_file_name(SILHOUETTES)).filter(|path| path.is_file())
}

/// Looks for falls in the silhouettes beside a log.
///
/// # Errors
///
/// Those of [`LogWithSilhouettes::beside`] and [`LogWithSilhouettes::falls`].
pub fn falls_in(named: &NamedLog, rules: &FallRules, go_on: impl FnMut(Micros) -> bool) -> Result<FallsFound, Error> {
    let kept = LogWithSilhouettes::beside(named)?;
    let Looked { falls, pictures, voxel_persons } = kept.falls(rules, go_on)?;
    let calendar = &kept.scenario.calendar;
    let clock = |at| calendar.local(at).strftime("%Y-%m-%d %H:%M:%S%.3f").to_string();
    let falls = falls.iter().map(|fall| fallen(fall, kept.scenario.home.plan(), clock)).collect();
    Ok(FallsFound { name: named.name.clone(), cameras: kept.silhouettes.cameras.len(), pictures, voxel_persons, falls })
}

fn fallen(fall: &Fall, plan: &Plan, clock: impl Fn(Micros) -> String) -> Fallen {
    let room = plan.room_at(point(fall.at_m)).map(|room| plan.rooms[room].name.clone());
    Fallen {
        at: clock(fall.at),
        alarm_at: clock(fall.alarm_at),
        seconds_to_alarm: seconds(fall.alarm_at - fall.at),
        room,
        at_m: fall.at_m,
        rule: fall.rule.clone(),
        confidence: fall.confidence,
        words: fall.words(),
    }
}
