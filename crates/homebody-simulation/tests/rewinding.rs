//! Going back to a snapshot.

use homebody_core::event::Firing;
use homebody_core::time::{DAY, HOUR, RunTime};
use homebody_log::{RunPlaces, WriteMode};
use homebody_simulation::{RecordedRun, Simulation, template};

fn studio() -> Simulation {
    template("studio").unwrap().run().seed(3).days(2).start().unwrap().with_snapshots(6 * HOUR)
}

fn firings(run: &mut Simulation) -> Vec<Firing> {
    let mut firings = Vec::new();
    while !run.is_over() {
        run.step(run.end()).unwrap();
        firings.extend_from_slice(&run.events().firings);
    }
    firings
}

#[test]
fn a_run_continues_from_a_snapshot_as_before_and_stores_each_row_once() {
    let folder = tempfile::tempdir().unwrap();
    let mut run = studio();
    let places = RunPlaces::run(folder.path(), run.scenario()).unwrap();
    let recording = places.recording.clone().unwrap();
    run.open_output(places, WriteMode::Create).unwrap();
    let whole = firings(&mut run);
    let snapshot = run.rewind(RunTime::START + DAY).unwrap();
    assert!(snapshot <= RunTime::START + DAY && snapshot > RunTime::START + DAY - 12 * HOUR);
    let again = firings(&mut run);
    let later: Vec<Firing> =
        whole.iter().copied().filter(|firing| again.first().is_some_and(|first| firing.seq >= first.seq)).collect();
    assert_eq!(again, later);
    assert!(run.finish().unwrap().is_some_and(|stored| stored.rows > 0));
    assert_eq!(run.recording().firings, whole.len() as u64);
    // A stopped or complete output does not grow, and a complete run goes back.
    assert!(run.rewind(RunTime::START).is_some() && !run.is_recording());
    // The recording replays, also after going back.
    let mut replay = RecordedRun::open(recording).unwrap().start().with_snapshots(6 * HOUR);
    assert_eq!(firings(&mut replay), whole);
    assert_eq!(replay.matches_recording(), Some(true));
    replay.rewind(RunTime::START + DAY).unwrap();
    assert_eq!(replay.matches_recording(), None);
    firings(&mut replay);
    assert_eq!(replay.matches_recording(), Some(true));
}

#[test]
fn a_run_without_output_goes_back_at_any_time() {
    let mut run = studio();
    assert_eq!(run.rewind(RunTime::START), None, "it has no snapshot yet");
    run.step(RunTime::START + HOUR).unwrap();
    assert_eq!(run.rewind(RunTime::START), Some(RunTime::START));
    let whole = firings(&mut run);
    assert_eq!(run.rewind(RunTime::START), Some(RunTime::START));
    assert_eq!(firings(&mut run), whole);
}
