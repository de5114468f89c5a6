//! The whole experiment: each recording acted out in the house, and its sensors held against the real ones.

use super::walked_back::{WalkedBack, walked_back};
use super::{
    AnnotatedRun, Comparison, House, Interval, ShortStay, Unplaced, compare_run, compare_runs, hold, path_of,
    without_short_stays,
};
use homebody_core::drivers::error::DriverError;
use homebody_core::drivers::path::form::PathFile;
use homebody_core::event::{Events, Firing};
use homebody_core::problem::{Problem, Problems};
use homebody_core::resident::DriverFile;
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::logger::MessagesFile;
use homebody_core::time::{MINUTE, Span};
use homebody_infer::{ResponseError, Senses};
use serde::Serialize;
use std::fmt;

/// How much is lived before its firings are fetched.
const STEP: Span = MINUTE.times(10);

/// Everything the experiment found.
#[derive(Clone, Debug, Serialize)]
pub struct Experiment {
    pub seed: u64,
    /// All recordings together.
    #[serde(flatten)]
    pub comparison: Comparison,
    pub by_recording: Vec<Recording>,
}

/// One recording beside its simulation.
#[derive(Clone, Debug, Serialize)]
pub struct Recording {
    pub name: String,
    pub begin_s: f64,
    pub end_s: f64,
    pub comparison: Comparison,
    /// Annotated, but too short to be lived: they count to the room before or after them.
    pub short_stays: Vec<ShortStay>,
    /// In which room the person was, and when each room's sensor was ON.
    pub rooms: Vec<Interval>,
    pub real: Vec<Interval>,
    pub simulated: Vec<Interval>,
    /// Where the person was by the real sensors alone.
    pub walked_back: WalkedBack,
}

homebody_core::messages! {
    /// Reasons why the experiment is not possible.
    pub enum Undone in "sphere" {
        /// A recording names a room, a way or a movement that the house does not have.
        Unplaced {
            /// The name of the recording.
            recording: String,
            /// The reason.
            why: Unplaced,
        } error "not-placed" ("{recording}: {why}");
        /// Homebody makes a path from the annotations of a recording, and checks it as each path. A person cannot walk this one.
        Unwalkable {
            /// The name of the recording.
            recording: String,
            /// The problems of the path.
            problems: Vec<String>,
        } error "not-walkable" (
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

impl From<ResponseError> for Undone {
    fn from(error: ResponseError) -> Undone {
        Undone::Senses(error)
    }
}

impl Experiment {
    /// Acts out the named recordings in a house with one resident who follows a path, one sensor per room, each
    /// of its room's name, and a logger that says ON and OFF.
    pub fn run(recordings: &[(String, AnnotatedRun)], house: &Scenario, seed: u64) -> Result<Experiment, Undone> {
        let rooms = sensed_rooms(house)?;
        let [resident] = &house.residents[..] else {
            return Err(Undone::OneResident);
        };
        let senses = Senses::learn(house, 0)?;
        let bodies = [senses];
        let mut ways = House::new(house.home.plan(), resident.file.radius_m);
        let (mut runs, mut by_recording) = (Vec::new(), Vec::new());
        for (name, run) in recordings {
            let unplaced = |why| Undone::Unplaced { recording: name.clone(), why };
            let (run, short_stays) = without_short_stays(run, &mut ways).map_err(unplaced)?;
            let path = path_of(&run, &mut ways).map_err(unplaced)?;
            let simulated = act(name, &run, &path, house, &rooms, seed)?;
            by_recording.push(Recording {
                name: name.clone(),
                begin_s: run.begin_s(),
                end_s: run.end_s(),
                comparison: compare_run(&run, &simulated, &rooms),
                short_stays,
                rooms: run.rooms.clone(),
                real: run.pir.clone(),
                simulated,
                walked_back: walked_back(&run, house, &bodies, &rooms),
            });
            runs.push(run);
        }
        let acted = runs.iter().zip(&by_recording);
        let acted: Vec<(&AnnotatedRun, &[Interval])> =
            acted.map(|(run, recording)| (run, &recording.simulated[..])).collect();
        Ok(Experiment { seed, comparison: compare_runs(&acted, &rooms), by_recording })
    }
}

/// The rooms that have a sensor, in the order of the sensors.
fn sensed_rooms(house: &Scenario) -> Result<Vec<String>, Undone> {
    let sensed = |name: &str| match house.home.rooms.iter().any(|room| room.name == name) {
        true => Ok(name.to_owned()),
        false => Err(Undone::SensorRoom(name.to_owned())),
    };
    house.home.sensors.iter().map(|sensor| sensed(sensor.name())).collect()
}

/// When the house's sensors are ON while the path of a recording is acted out, in seconds of the recording.
fn act(
    name: &str,
    run: &AnnotatedRun,
    path: &PathFile,
    house: &Scenario,
    rooms: &[String],
    seed: u64,
) -> Result<Vec<Interval>, Undone> {
    let MessagesFile::OnOff(messages) = &house.logger.messages else {
        return Err(Undone::Messages);
    };
    let Some(DriverFile::Path(path_name)) = house.residents.first().map(|resident| &resident.file.driver) else {
        return Err(Undone::NoPath);
    };
    // The annotated path takes the place of the house's own, and passes the same checks.
    let scenario = house.edit().path(0, path_name, path).load();
    let unwalkable = |Problems(problems)| Undone::Unwalkable {
        recording: name.to_owned(),
        problems: problems.iter().map(Problem::to_string).collect(),
    };
    let scenario = scenario.map_err(unwalkable)?;

    let mut lived = Run::new(&scenario, &(), seed, Span::from_seconds(run.end_s() - run.begin_s()));
    let (mut events, mut firings) = (Events::default(), Vec::new());
    while lived.now().since_zero() < lived.length() {
        lived.advance(lived.now() + STEP, &mut events).map_err(Undone::Run)?;
        let at_s = |firing: &Firing| run.begin_s() + firing.at.seconds();
        firings.extend(events.firings.iter().map(|firing| (at_s(firing), firing.sensor.index())));
        events.clear();
    }
    Ok(hold(firings, rooms, messages.hold_s))
}

impl fmt::Display for Experiment {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "The recordings of a real house, and the same walks simulated (seed {})\n", self.seed)?;
        write!(f, "{}", self.comparison)?;
        writeln!(f, "\nBy recording, all rooms together, real | simulated:")?;
        for Recording { name, comparison, .. } in &self.by_recording {
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
        for Recording { name, walked_back: told, .. } in &self.by_recording {
            writeln!(
                f,
                "  {name}  located {:.3}  by the last firing {:.3}  by rooms alone {:.3}  visits found {:.3}  messages \
                 from other rooms {:.3}",
                told.room_right, told.last_firing_right, told.rooms_only_right, told.visits_found, told.said_elsewhere
            )?;
        }
        let named = |recording: &Recording| {
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
    use super::super::{Texts, parse};
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
        let texts = Texts { location: &location, annotations: &annotations, pir: &pir, second_location: None };
        ("a minute".into(), parse(&texts).unwrap())
    }

    #[test]
    fn who_walks_in_a_room_is_seen_there() {
        let experiment = Experiment::run(&[recording("kitchen")], &house(), 1).unwrap();
        let [recording] = &experiment.by_recording[..] else { panic!("one recording") };
        let room = |name: &str| recording.comparison.rooms.iter().find(|room| room.room == name).unwrap();
        assert_eq!(room("kitchen").simulated.visits_seen, 1);
        assert!(room("kitchen").simulated.recall.unwrap() > 0.9, "{:?}", room("kitchen").simulated);
        assert_eq!(room("bed2").simulated.intervals, 0);
        assert!(recording.simulated.iter().all(|on| on.start_s >= 10.0), "in seconds of the recording");
        assert_eq!(experiment.comparison.rooms, recording.comparison.rooms);
    }

    #[test]
    fn a_stay_of_85_ms_is_told_and_does_not_stop_the_experiment() {
        let location = "start,end,name,index\n10,40,living,5\n40,40.085,hall,3\n40.085,70,stairs,8\n";
        let annotations = "start,end,name,index\n10,70,a_walk,0\n";
        let pir = "start,end,name,index\n12,16,living,5\n";
        let run = parse(&Texts { location, annotations, pir, second_location: None }).unwrap();
        let house = house();
        let experiment = Experiment::run(&[("00009".into(), run.clone())], &house, 1).unwrap();
        let said = "00009/location_0.csv:3: 0.085 s in \"hall\" are too short to be there, and count as \"stairs\"";
        assert!(experiment.to_string().contains(said), "{experiment}");
        let visits = |room: &str| experiment.comparison.rooms.iter().find(|of| of.room == room).unwrap().visits;
        assert_eq!([visits("living"), visits("hall"), visits("stairs")], [1, 0, 1]);
        assert_eq!(experiment.by_recording[0].short_stays[0].line, 3);

        // The negative control: with that stay, the path of the recording is one that nobody can walk.
        let path = path_of(&run, &mut House::new(house.home.plan(), 0.22)).unwrap();
        let rooms = sensed_rooms(&house).unwrap();
        let undone = act("00009", &run, &path, &house, &rooms, 1).unwrap_err();
        let Undone::Unwalkable { recording, problems } = &undone else { panic!("{undone}") };
        assert_eq!(recording, "00009");
        assert!(problems[0].contains("m in 0.085 s"), "{problems:?}");
    }

    #[test]
    fn a_house_that_does_not_fit_is_named() {
        let undone = Experiment::run(&[recording("attic")], &house(), 1).unwrap_err();
        let Undone::Unplaced { recording: name, why } = &undone else { panic!("{undone}") };
        assert_eq!((name.as_str(), why), ("a minute", &Unplaced::Room("attic".into())));
        let mut silent = house();
        silent.logger.messages = MessagesFile::FireOnly;
        assert!(matches!(Experiment::run(&[recording("kitchen")], &silent, 1), Err(Undone::Messages)));
        let rename = |home: &mut HomeFile| {
            let room = home.rooms.iter_mut().find(|room| room.name == "kitchen");
            room.unwrap().name = "scullery".into();
        };
        let renamed = house().edit().home(rename).load().unwrap();
        let undone = Experiment::run(&[recording("hall")], &renamed, 1).unwrap_err();
        assert!(matches!(&undone, Undone::SensorRoom(sensor) if sensor == "kitchen"), "{undone}");
    }

    #[test]
    fn a_house_may_be_loaded_from_any_file() {
        let mut files = files();
        let scenario = files.remove(ENTRY).unwrap();
        files.insert("other.json".into(), scenario);
        let house = Scenario::load(&files, "other.json").unwrap();
        Experiment::run(&[recording("kitchen")], &house, 1).unwrap();
    }
}
