//! The experiment: each recording is simulated in the house, and the sensors are compared with the real ones.

use super::located::{LocatedRecording, locate_recording};
use super::{
    AnnotatedRun, Comparison, Interval, PlacementError, ShortStay, SphereHouse, compare_run, compare_runs, hold,
    path_of, without_short_stays,
};
use crate::simulated::each_step;
use homebody_core::drivers::error::DriverError;
use homebody_core::drivers::path::form::PathFile;
use homebody_core::event::Firing;
use homebody_core::problem::{Problem, Problems};
use homebody_core::resident::DriverFile;
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::logger::MessagesFile;
use homebody_core::time::{MINUTE, Span};
use homebody_infer::{ResponseError, Senses};
use serde::Serialize;
use std::fmt;

/// Part of the run between two reads of its firings.
const STEP: Span = MINUTE.times(10);

#[derive(Clone, Debug, Serialize)]
pub struct SphereExperiment {
    pub seed: u64,
    #[serde(flatten)]
    pub comparison: Comparison,
    pub by_recording: Vec<RecordingResult>,
}

#[derive(Clone, Debug, Serialize)]
pub struct RecordingResult {
    pub name: String,
    pub begin_s: f64,
    pub end_s: f64,
    pub comparison: Comparison,
    /// Annotated stays that are too short for a person; they count to the room before or after.
    pub short_stays: Vec<ShortStay>,
    pub rooms: Vec<Interval>,
    pub real: Vec<Interval>,
    pub simulated: Vec<Interval>,
    /// The location of the person by the real sensors alone.
    pub walked_back: LocatedRecording,
}

homebody_core::messages! {
    /// Reasons why the experiment is not possible.
    pub enum SphereError in "sphere" {
        /// A recording names a room, a way or a movement that the house does not have.
        Unplaced { recording: String, why: PlacementError } error "not-placed" ("{recording}: {why}");
        /// Homebody makes a path from the annotations of a recording, and checks it as each path. A person cannot walk this one.
        Unwalkable { recording: String, problems: Vec<String> } error "not-walkable" (
            "{recording}: a person cannot walk the path of its annotations: {}",
            problems.join("; ")
        );
        /// One person acts out the recordings.
        OneResident error "one-resident" ("the house must have one resident, who acts out the recordings")
            hint ("keep only one file under \"residents\" in scenario.json");
        /// The recordings have a sensor for each room, with the name of the room. The experiment compares the sensors of the house with them.
        SensorRoom(sensor: String) error "sensor-name" ("no room of the house has the name of the sensor {sensor:?}")
            hint ("give each sensor the name of its room");
        /// The real sensors write ON and OFF. The experiment compares the times between the two.
        Messages error "messages" ("the logger of the house must write ON and OFF, as the real one does")
            hint ("write \"messages\": \"on_off\" in the file of the logger");
        /// The recordings replace the path of the resident.
        NoPath error "no-path" ("the resident of the house must follow a path, which the recordings replace")
            hint ("name a path as the driver in the file of the resident");
        => inner {
            /// A simulation failed.
            Run(DriverError);
            /// Homebody cannot compute how the sensors of the house respond.
            Senses(ResponseError);
        }
    }
}

from_errors!(SphereError: Senses(ResponseError));

impl SphereExperiment {
    /// Simulates the recordings in a house with one resident who follows a path, one sensor per room with the name of its room,
    /// and a logger that writes ON and OFF.
    pub fn run(
        recordings: &[(String, AnnotatedRun)],
        house: &Scenario,
        seed: u64,
    ) -> Result<SphereExperiment, SphereError> {
        let rooms = sensed_rooms(house)?;
        let [resident] = &house.residents[..] else {
            return Err(SphereError::OneResident);
        };
        let senses = Senses::learn(house, 0)?;
        let bodies = [senses];
        let mut ways = SphereHouse::new(house.home.plan(), resident.file.radius_m);
        let (mut runs, mut by_recording) = (Vec::new(), Vec::new());
        for (name, run) in recordings {
            let unplaced = |why| SphereError::Unplaced { recording: name.clone(), why };
            let (run, short_stays) = without_short_stays(run, &mut ways).map_err(unplaced)?;
            let path = path_of(&run, &mut ways).map_err(unplaced)?;
            let simulated = simulate_path(name, &run, &path, house, &rooms, seed)?;
            by_recording.push(RecordingResult {
                name: name.clone(),
                begin_s: run.begin_s(),
                end_s: run.end_s(),
                comparison: compare_run(&run, &simulated, &rooms),
                short_stays,
                rooms: run.rooms.clone(),
                real: run.pir.clone(),
                simulated,
                walked_back: locate_recording(&run, house, &bodies, &rooms),
            });
            runs.push(run);
        }
        let acted = runs.iter().zip(&by_recording);
        let acted: Vec<(&AnnotatedRun, &[Interval])> =
            acted.map(|(run, recording)| (run, &recording.simulated[..])).collect();
        Ok(SphereExperiment { seed, comparison: compare_runs(&acted, &rooms), by_recording })
    }
}

/// The rooms that have a sensor, in the order of the sensors.
fn sensed_rooms(house: &Scenario) -> Result<Vec<String>, SphereError> {
    let sensed = |name: &str| match house.home.rooms.iter().any(|room| room.name == name) {
        true => Ok(name.to_owned()),
        false => Err(SphereError::SensorRoom(name.to_owned())),
    };
    house.home.sensors.iter().map(|sensor| sensed(sensor.name())).collect()
}

/// The ON times of the sensors of the house while a person walks the path of a recording, in seconds of the recording.
fn simulate_path(
    name: &str,
    run: &AnnotatedRun,
    path: &PathFile,
    house: &Scenario,
    rooms: &[String],
    seed: u64,
) -> Result<Vec<Interval>, SphereError> {
    let MessagesFile::OnOff(messages) = &house.logger.messages else {
        return Err(SphereError::Messages);
    };
    let Some(DriverFile::Path(path_name)) = house.residents.first().map(|resident| &resident.file.driver) else {
        return Err(SphereError::NoPath);
    };
    // The annotated path takes the place of the house's own, and passes the same checks.
    let scenario = house.edit().path(0, path_name, path).load();
    let unwalkable = |Problems(problems)| SphereError::Unwalkable {
        recording: name.to_owned(),
        problems: problems.iter().map(Problem::to_string).collect(),
    };
    let scenario = scenario.map_err(unwalkable)?;

    let mut simulated = Run::new(&scenario, &(), seed, Span::from_seconds(run.end_s() - run.begin_s()));
    let mut firings = Vec::new();
    let firing = |firing: &Firing| (run.begin_s() + firing.at.seconds(), firing.sensor.index());
    each_step(&mut simulated, STEP, |events| firings.extend(events.firings.iter().map(firing)))
        .map_err(SphereError::Run)?;
    Ok(hold(firings, rooms, messages.hold_s))
}

impl fmt::Display for SphereExperiment {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "The recordings of a real house, and the same walks simulated (seed {})\n", self.seed)?;
        write!(f, "{}", self.comparison)?;
        writeln!(f, "\nBy recording, all rooms together, real | simulated:")?;
        for RecordingResult { name, comparison, .. } in &self.by_recording {
            let overall = &comparison.overall;
            writeln!(
                f,
                "  {name}  {:>3} | {:<3} intervals  ON {:>4.0} | {:<4.0} s  {:>3} | {:<3} of {:>3} visits seen  kappa {}",
                overall.real.intervals,
                overall.simulated.intervals,
                overall.real.on_s,
                overall.simulated.on_s,
                overall.real.visits_seen,
                overall.simulated.visits_seen,
                overall.visits,
                overall.kappa.map_or("-".into(), |kappa| format!("{kappa:.2}")),
            )?;
        }
        writeln!(f, "\nThe right room by the real sensors alone, share of the annotated time:")?;
        for RecordingResult { name, walked_back: found, .. } in &self.by_recording {
            writeln!(
                f,
                "  {name}  located {:.3}  by the last firing {:.3}  by rooms alone {:.3}  visits found {:.3}  messages \
                 from other rooms {:.3}",
                found.room_right,
                found.last_firing_right,
                found.rooms_only_right,
                found.visits_found,
                found.said_elsewhere
            )?;
        }
        let named = |recording: &RecordingResult| {
            let name = recording.name.clone();
            recording.short_stays.clone().into_iter().map(move |stay| format!("  {name}/{stay}"))
        };
        let short_stays: Vec<String> = self.by_recording.iter().flat_map(named).collect();
        if !short_stays.is_empty() {
            writeln!(f, "\nAnnotated, but too short to be lived, and counted to the room beside:")?;
            writeln!(f, "{}", short_stays.join("\n"))?;
        }
        Ok(())
    }
}

#[cfg(test)]
pub mod tests {
    use super::super::{RecordingTexts, parse};
    use super::*;
    use homebody_core::home::form::HomeFile;
    use std::collections::BTreeMap;
    use std::fs;

    const ENTRY: &str = "scenario.json";

    fn files() -> BTreeMap<String, String> {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/sphere-house");
        let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
        entries
            .map(|entry| (entry.file_name().into_string().unwrap(), fs::read_to_string(entry.path()).unwrap()))
            .collect()
    }

    pub fn house() -> Scenario {
        Scenario::load(&files(), ENTRY).unwrap()
    }

    fn recording(room: &str) -> (String, AnnotatedRun) {
        let rows = |name: &str| format!("start,end,name,index\n10,70,{name},0\n");
        let (location, annotations, pir) = (rows(room), rows("a_walk"), rows("kitchen"));
        let texts = RecordingTexts { location: &location, annotations: &annotations, pir: &pir, second_location: None };
        ("a minute".into(), parse(&texts).unwrap())
    }

    #[test]
    fn a_walk_in_a_room_triggers_its_sensor() {
        let experiment = SphereExperiment::run(&[recording("kitchen")], &house(), 1).unwrap();
        let [recording] = &experiment.by_recording[..] else { panic!("one recording") };
        let room = |name: &str| recording.comparison.rooms.iter().find(|room| room.room == name).unwrap();
        assert_eq!(room("kitchen").simulated.visits_seen, 1);
        assert!(room("kitchen").simulated.recall.unwrap() > 0.9, "{:?}", room("kitchen").simulated);
        assert_eq!(room("bed2").simulated.intervals, 0);
        assert!(recording.simulated.iter().all(|on| on.start_s >= 10.0), "in seconds of the recording");
        assert_eq!(experiment.comparison.rooms, recording.comparison.rooms);
    }

    #[test]
    fn a_stay_of_85_ms_is_reported_and_does_not_stop_the_experiment() {
        let location = "start,end,name,index\n10,40,living,5\n40,40.085,hall,3\n40.085,70,stairs,8\n";
        let annotations = "start,end,name,index\n10,70,a_walk,0\n";
        let pir = "start,end,name,index\n12,16,living,5\n";
        let run = parse(&RecordingTexts { location, annotations, pir, second_location: None }).unwrap();
        let house = house();
        let experiment = SphereExperiment::run(&[("00009".into(), run.clone())], &house, 1).unwrap();
        let said = "00009/location_0.csv:3: 0.085 s in \"hall\" are too short to be there, and count as \"stairs\"";
        assert!(experiment.to_string().contains(said), "{experiment}");
        let visits = |room: &str| experiment.comparison.rooms.iter().find(|of| of.room == room).unwrap().visits;
        assert_eq!([visits("living"), visits("hall"), visits("stairs")], [1, 0, 1]);
        assert_eq!(experiment.by_recording[0].short_stays[0].line, 3);

        // The negative control: with that stay, no person can walk the path of the recording.
        let path = path_of(&run, &mut SphereHouse::new(house.home.plan(), 0.22)).unwrap();
        let rooms = sensed_rooms(&house).unwrap();
        let undone = simulate_path("00009", &run, &path, &house, &rooms, 1).unwrap_err();
        let SphereError::Unwalkable { recording, problems } = &undone else { panic!("{undone}") };
        assert_eq!(recording, "00009");
        assert!(problems[0].contains("m in 0.085 s"), "{problems:?}");
    }

    #[test]
    fn a_house_that_does_not_fit_is_named() {
        let undone = SphereExperiment::run(&[recording("attic")], &house(), 1).unwrap_err();
        let SphereError::Unplaced { recording: name, why } = &undone else { panic!("{undone}") };
        assert_eq!((name.as_str(), why), ("a minute", &PlacementError::Room("attic".into())));
        let mut silent = house();
        silent.logger.messages = MessagesFile::FireOnly;
        assert!(matches!(SphereExperiment::run(&[recording("kitchen")], &silent, 1), Err(SphereError::Messages)));
        let rename = |home: &mut HomeFile| {
            let room = home.rooms.iter_mut().find(|room| room.name == "kitchen");
            room.unwrap().name = "scullery".into();
        };
        let renamed = house().edit().home(rename).load().unwrap();
        let undone = SphereExperiment::run(&[recording("hall")], &renamed, 1).unwrap_err();
        assert!(matches!(&undone, SphereError::SensorRoom(sensor) if sensor == "kitchen"), "{undone}");
    }

    #[test]
    fn a_house_may_be_loaded_from_any_file() {
        let mut files = files();
        let scenario = files.remove(ENTRY).unwrap();
        files.insert("other.json".into(), scenario);
        let house = Scenario::load(&files, "other.json").unwrap();
        SphereExperiment::run(&[recording("kitchen")], &house, 1).unwrap();
    }
}
