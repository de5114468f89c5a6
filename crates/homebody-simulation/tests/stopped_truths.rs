//! The truth of a stopped run has spans that end at the stop. Resuming the run writes each file of its tables again, compressed or not.

use homebody_core::event::Events;
use homebody_core::recording::Recording;
use homebody_core::time::{DAY, RunTime};
use homebody_log::{RunLog, RunPlaces};
use homebody_routine::household::Household;
use homebody_simulation::destination::WriteMode;
use homebody_simulation::{Url, template};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

fn places(folder: &Path, truth: &str) -> RunPlaces {
    let url =
        |scheme: &str, name: &str| -> Url { format!("{scheme}:{}", folder.join(name).display()).parse().unwrap() };
    let recording = Some(folder.join("recording.json"));
    RunPlaces::new(vec![url("csv", "log.csv")], Some(url("csv", truth)), recording, &[], false).unwrap()
}

/// Simulates the run to a day, and completes its files.
fn simulate(places: &RunPlaces, recording: &Recording, how: WriteMode, days: i64) -> Recording {
    let (scenario, household) = Household::recorded(recording).unwrap();
    let mut run = recording.run(&scenario, &household);
    let mut log = RunLog::open(places, &scenario, &run, recording, how).unwrap();
    let mut events = Events::default();
    run.advance(RunTime::START + days * DAY, &mut events).unwrap();
    log.store(&run, &events).unwrap();
    log.finish(&run, recording.clone()).unwrap().1
}

fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let name = |entry: &fs::DirEntry| entry.file_name().into_string().unwrap();
    let all = fs::read_dir(folder).unwrap().map(Result::unwrap);
    all.map(|entry| (name(&entry), fs::read(entry.path()).unwrap())).collect()
}

#[test]
fn resuming_writes_the_texts_of_a_stopped_truth_again() {
    let tigerplace = template("tigerplace").unwrap();
    for truth in ["truth.csv", "truth.csv.gz"] {
        let recording =
            Recording::new(tigerplace.scenario(), homebody_simulation::VERSION, "scenario.json", 3, 2 * DAY);
        let (stopped, whole) = (TempDir::new().unwrap(), TempDir::new().unwrap());
        simulate(&places(whole.path(), truth), &recording, WriteMode::Create, 2);
        let places = places(stopped.path(), truth);
        let first = simulate(&places, &recording, WriteMode::Create, 1);
        assert!(first.stopped_of_us.is_some());
        assert_ne!(files(stopped.path()), files(whole.path()));
        simulate(&places, &first.restarted(), WriteMode::Resume, 2);
        let (found, wanted) = (files(stopped.path()), files(whole.path()));
        assert_eq!(found.keys().collect::<Vec<_>>(), wanted.keys().collect::<Vec<_>>(), "{truth}");
        assert!(found == wanted, "{truth}: another truth");
        let room = truth.replace("truth", "truth.room");
        assert!(found.contains_key(&room), "{room} is among {:?}", found.keys());
    }
}
