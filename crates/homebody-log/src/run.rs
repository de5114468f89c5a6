//! The description of a run, which destinations get before the first row.

pub mod places;
pub(crate) mod sensor_table;

use crate::log::{Log, SaidBy, SensorInfo};
use crate::text::one_word;
use homebody_core::calendar::Calendar;
use homebody_core::event::Value;
use homebody_core::recording::Recording;
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::logger::MessagesFile;
use homebody_core::sensors::Sensor;
pub(crate) use places::{RunPlaces, SILHOUETTES, TRUTH, not_of_a_run};
pub(crate) use sensor_table::SensorTable;

/// The identity of a run, and the sensors of its rows.
#[derive(Clone, Debug, PartialEq)]
pub struct RunInfo {
    /// The same for the same run, another for another: see [`Recording::run_id`].
    pub id: i64,
    /// Which home of several it is: the name of a member of a cohort. None for a run of its own.
    pub home: Option<String>,
    /// Whether it was simulated; false for a log that was only read, whose origin is unknown.
    pub is_simulated: bool,
    /// Its simulated home; None for a log that was only read.
    pub plan: Option<PlanInfo>,
    /// The scenario's name.
    pub scenario: String,
    /// The number that all randomness of the run comes from.
    pub seed: u64,
    /// The program's version, without what tells its builds apart.
    pub version: String,
    /// Its start and its time zone.
    pub calendar: Calendar,
    /// In the order of [`SensorId`](homebody_core::ids::SensorId).
    pub sensors: Vec<SensorInfo>,
    /// The names of residents and visitors, in the order of [`ResidentId`](homebody_core::ids::ResidentId).
    pub residents: Vec<String>,
    /// In the order of [`RoomId`](homebody_core::ids::RoomId).
    pub rooms: Vec<String>,
    /// In the order of [`ThingId`](homebody_core::ids::ThingId).
    pub things: Vec<String>,
}

/// The home of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanInfo {
    /// The name of its file in the scenario.
    pub file: String,
    /// The name in that file.
    pub name: String,
}

impl SensorInfo {
    /// A sensor of the home of a scenario.
    pub fn in_home(sensor: &Sensor, scenario: &Scenario) -> SensorInfo {
        let info = sensor.info(scenario.home.plan());
        let is_held = info.kind.senses_motion() && scenario.logger.messages != MessagesFile::FireOnly;
        SensorInfo {
            id: scenario.logger.ids.get(&info.name).unwrap_or(&info.name).clone(),
            name: info.name,
            is_motion: info.kind.senses_motion(),
            kind: info.kind.key.to_owned(),
            said_by: SaidBy::Home,
            unit: info.unit.map(|unit| unit.symbol.to_owned()),
            values: info.values.iter().chain(is_held.then_some(&Value::Off)).map(ToString::to_string).collect(),
            room: info.room,
            at_m: [info.at.x, info.at.y],
        }
    }
}

impl RunInfo {
    /// The description of a run before its start.
    pub fn of(scenario: &Scenario, run: &Run, recording: &Recording) -> RunInfo {
        let plan = &run.home().plan;
        RunInfo {
            id: recording.run_id(),
            home: recording.home.clone(),
            plan: Some(PlanInfo { file: scenario.file.home.clone(), name: scenario.home.name.clone() }),
            is_simulated: true,
            scenario: scenario.file.name.clone(),
            seed: recording.seed,
            version: recording.version.split('+').next().unwrap_or_default().to_owned(),
            calendar: scenario.calendar.clone(),
            sensors: run.sensors().iter().map(|sensor| SensorInfo::in_home(sensor, scenario)).collect(),
            residents: run.names(),
            rooms: plan.rooms.iter().map(|room| room.name.clone()).collect(),
            things: plan.things.iter().map(|thing| thing.name.clone()).collect(),
        }
    }

    /// The description of a run with nothing but a log, or a survey of it.
    pub fn of_log(name: &str, calendar: Calendar, log: &Log) -> RunInfo {
        let sensor = |id: &String| {
            let known = log.known.iter().find(|known| known.id == *id || one_word(&known.id) == *id);
            known.cloned().map_or_else(|| SensorInfo::named(id), |known| SensorInfo { id: id.clone(), ..known })
        };
        RunInfo {
            id: 1,
            home: None,
            plan: None,
            is_simulated: false,
            scenario: name.to_owned(),
            seed: 0,
            version: env!("CARGO_PKG_VERSION").into(),
            calendar,
            sensors: log.sensors.iter().map(sensor).collect(),
            residents: Vec::new(),
            rooms: Vec::new(),
            things: Vec::new(),
        }
    }

    /// The zone of its clock, as `America/Chicago`; None of a log that was only read, which does not say it.
    pub fn zone(&self) -> Option<&str> {
        self.is_simulated.then(|| self.calendar.zone_name())?
    }

    /// The names of the sensors in the home.
    pub fn sensor_names(&self) -> Vec<String> {
        self.sensors.iter().map(|sensor| sensor.name.clone()).collect()
    }
}
