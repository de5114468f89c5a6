//! Falls in the silhouettes that a run's cameras have kept.

use crate::error::QueryError;
use crate::log_ref::LogRef;
use homebody_analysis::falls::rules::FallRules;
use homebody_analysis::falls::scenes::{CameraPicture, Scenes};
use homebody_analysis::falls::watch::Fall;
use homebody_core::camera::lens::Lens;
use homebody_core::geometry::point;
use homebody_core::plan::Plan;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::RunTime;
use homebody_log::run::places::SILHOUETTES;
use homebody_log::silhouettes::{KeptSilhouettes, Silhouettes};
use homebody_simulation::SimulationError;
use serde::Serialize;
use std::path::{Path, PathBuf};

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FallReport {
    pub name: String,
    pub cameras: usize,
    /// The number of pictures with a body.
    pub pictures: u64,
    /// The number of instants that two cameras or more agreed on.
    pub voxel_persons: u64,
    pub falls: Vec<ReportedFall>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReportedFall {
    pub at: String,
    pub alarm_at: String,
    /// The delay of the alarm in seconds.
    pub seconds_to_alarm: f64,
    pub room: Option<String>,
    pub at_m: [f64; 2],
    pub rule: String,
    pub confidence: f64,
    pub words: &'static str,
}

/// The silhouettes of a run in the folder of its log.
pub struct RunSilhouettes<'a> {
    pub silhouettes: Silhouettes,
    pub scenario: &'a Scenario,
}

impl<'a> RunSilhouettes<'a> {
    /// Opens the silhouettes in the folder of a log.
    pub fn beside(named: &'a LogRef) -> Result<RunSilhouettes<'a>, QueryError> {
        let missing = || QueryError::NoSilhouettes { log: named.name.clone() };
        let path = silhouettes_of(named.place.path()).ok_or_else(missing)?;
        RunSilhouettes::open(&path, named.scenario().ok_or_else(missing)?)
    }

    /// Opens a file of the run of a scenario.
    pub fn open(path: &Path, scenario: &'a Scenario) -> Result<RunSilhouettes<'a>, QueryError> {
        let silhouettes = Silhouettes::open(path, scenario.calendar.timestamp(RunTime::START).into())?;
        Ok(RunSilhouettes { silhouettes, scenario })
    }

    pub fn lenses(&self) -> Vec<Lens> {
        self.silhouettes.cameras.iter().map(|camera| camera.file.lens()).collect()
    }

    /// Looks for falls in all of them. `go_on` gets the instant that the search has reached; the search ends if it returns false.
    pub fn falls(&self, rules: &FallRules, mut go_on: impl FnMut(RunTime) -> bool) -> Result<FallSearch, QueryError> {
        let lenses = self.lenses();
        let mut scenes = Scenes::new(self.scenario.home.plan(), &lenses, rules);
        let (mut pictures, mut falls) = (0, Vec::new());
        self.silhouettes.for_each::<QueryError>(|KeptSilhouettes { at, camera, silhouette, .. }| {
            pictures += 1;
            falls.extend(scenes.next(CameraPicture { at, camera, silhouette }));
            if go_on(at) { Ok(()) } else { Err(SimulationError::Cancelled.into()) }
        })?;
        falls.extend(scenes.look());
        falls.sort_by_key(|fall| fall.at);
        Ok(FallSearch { falls, pictures, voxel_persons: scenes.voxel_persons })
    }

    /// A fall, in a line.
    pub fn words(&self, fall: &Fall) -> String {
        let ReportedFall { seconds_to_alarm, room, rule, confidence, words, .. } =
            fallen(fall, self.scenario.home.plan(), |_| String::new());
        let place = room.map_or(String::new(), |room| format!(", {room}"));
        format!("by cameras: {words}{place} ({confidence:.2}; {rule}), told after {seconds_to_alarm:.1} s")
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct FallSearch {
    pub falls: Vec<Fall>,
    pub pictures: u64,
    /// The number of instants that two cameras or more agreed on.
    pub voxel_persons: u64,
}

pub fn silhouettes_of(log: &Path) -> Option<PathBuf> {
    Some(log.with_file_name(SILHOUETTES)).filter(|path| path.is_file())
}

/// Looks for falls in the silhouettes in the folder of a log.
pub fn falls_in(
    named: &LogRef,
    rules: &FallRules,
    go_on: impl FnMut(RunTime) -> bool,
) -> Result<FallReport, QueryError> {
    let kept = RunSilhouettes::beside(named)?;
    let FallSearch { falls, pictures, voxel_persons } = kept.falls(rules, go_on)?;
    let calendar = &kept.scenario.calendar;
    let clock = |at| calendar.local(at).strftime("%Y-%m-%d %H:%M:%S%.3f").to_string();
    let falls = falls.iter().map(|fall| fallen(fall, kept.scenario.home.plan(), clock)).collect();
    Ok(FallReport { name: named.name.clone(), cameras: kept.silhouettes.cameras.len(), pictures, voxel_persons, falls })
}

fn fallen(fall: &Fall, plan: &Plan, clock: impl Fn(RunTime) -> String) -> ReportedFall {
    let room = plan.room_at(point(fall.at_m)).map(|room| plan.rooms[room].name.clone());
    ReportedFall {
        at: clock(fall.at),
        alarm_at: clock(fall.alarm_at),
        seconds_to_alarm: (fall.alarm_at - fall.at).seconds(),
        room,
        at_m: fall.at_m,
        rule: fall.rule.clone(),
        confidence: fall.confidence,
        words: fall.words(),
    }
}
