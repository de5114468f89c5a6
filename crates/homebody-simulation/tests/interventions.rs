//! Interventions from outside: they happen, the ground truth has them, and a replay repeats them.

use homebody_core::time::{HOUR, MINUTE, RunTime, Span};
use homebody_simulation::interventions::{InterventionRequest, OrderedIntervention, Refusal, SensorFailure};
use homebody_simulation::{Cancel, Destinations, IncompleteRun, RecordedRun, RunProgress, RunSummary, SimulationError};
use rusqlite::Connection;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, channel};
use tempfile::TempDir;

type Outcome = Result<RunTime, Refusal>;

fn on(thing: &str, on: bool) -> OrderedIntervention {
    OrderedIntervention::Use { thing: thing.into(), on }
}

fn fall(minutes: i64) -> OrderedIntervention {
    OrderedIntervention::Fall { resident: "margaret".into(), lies: Some(minutes * MINUTE) }
}

fn fails(sensor: &str, failure: SensorFailure, lasts: Option<Span>) -> OrderedIntervention {
    OrderedIntervention::Fail { sensor: sensor.into(), failure, lasts }
}

/// Simulates days into a folder, and requests each intervention at its hour. The run is cancelled at an hour, if there is one.
fn simulate(
    runs: &Path,
    days: f64,
    requests: &[(i64, OrderedIntervention)],
    stops_at: Option<i64>,
) -> (RunSummary, Vec<Outcome>) {
    let (ask, asked) = channel();
    let (tell, told) = channel();
    let cancel = Cancel::new();
    let scenario = homebody_simulation::template("tigerplace").unwrap();
    let run = scenario.run().seed(5).days(days).interventions(asked).cancel(&cancel).start().unwrap();
    let mut left = requests.to_vec();
    let says = |RunProgress { done, .. }: RunProgress| {
        for (_, wish) in left.extract_if(.., |(hour, _)| *hour * HOUR <= done) {
            let tell = tell.clone();
            let answer = Box::new(move |outcome: Outcome| tell.send(outcome).unwrap());
            ask.send(InterventionRequest { intervention: wish, answer }).unwrap();
        }
        if stops_at.is_some_and(|hour| hour * HOUR <= done) {
            cancel.cancel();
        }
    };
    let lived = run.store(&Destinations::new_folder_in(runs), says).unwrap();
    (lived, all(&told))
}

fn all(told: &Receiver<Outcome>) -> Vec<Outcome> {
    told.try_iter().collect()
}

fn folder(lived: &RunSummary) -> PathBuf {
    lived.recorded.as_ref().unwrap().parent().unwrap().to_owned()
}

fn bytes(folder: &Path) -> [Vec<u8>; 2] {
    ["log.db", "truth.db"].map(|file| fs::read(folder.join(file)).unwrap())
}

/// Replays a recording into other files in its folder.
fn replay(recording: &Path, into: &Path) -> RunSummary {
    fs::create_dir_all(into).unwrap();
    let to = Destinations {
        log: vec![format!("sqlite:{}", into.join("log.db").display()).parse().unwrap()],
        truth: Some(format!("sqlite:{}", into.join("truth.db").display()).parse().unwrap()),
        ..Destinations::default()
    };
    RecordedRun::open(recording).unwrap().start().store(&to, |_| ()).unwrap()
}

fn without_interventions(recording: &Path) -> String {
    let mut read: serde_json::Value = serde_json::from_str(&fs::read_to_string(recording).unwrap()).unwrap();
    assert!(read.as_object_mut().unwrap().remove("outside").is_some(), "nothing was noted");
    read.to_string()
}

fn texts(database: &Path, query: &str) -> Vec<String> {
    let database = Connection::open(database).unwrap();
    let mut query = database.prepare(query).unwrap();
    let rows = query.query_map([], |row| row.get::<_, Option<String>>(0)).unwrap();
    rows.map(|row| row.unwrap().unwrap_or_default()).collect()
}

fn count(database: &Path, query: &str) -> i64 {
    Connection::open(database).unwrap().query_row(query, [], |row| row.get(0)).unwrap()
}

/// All kinds at once, over a day and a half.
fn all_interventions() -> Vec<(i64, OrderedIntervention)> {
    vec![
        (2, on("front door", true)),
        (3, on("front door", false)),
        (4, fall(15)),
        (6, fails("bedroom motion", SensorFailure::Stuck { every_us: Some(7 * MINUTE) }, Some(3 * HOUR))),
        (8, fails("living room motion", SensorFailure::Battery { fades_us: Span::ZERO }, Some(4 * HOUR))),
        (20, fall(40)),
        (21, fails("bed sensor", SensorFailure::BadLink { lost_ppm: 500_000 }, None)),
        (26, on("stove", true)),
    ]
}

#[test]
fn what_is_done_from_outside_happens_and_replays_to_the_same_bytes() {
    let temporary = TempDir::new().unwrap();
    let (lived, told) = simulate(temporary.path(), 1.5, &all_interventions(), None);
    assert!(told.iter().all(Result::is_ok) && told.len() == 8, "{told:?}");
    let folder = folder(&lived);
    let (log, truth) = (folder.join("log.db"), folder.join("truth.db"));
    assert_eq!(
        texts(&truth, "SELECT what FROM outside ORDER BY at"),
        ["on", "off", "fall", "stuck", "battery", "fall", "bad_link", "on"]
    );
    // No resident used the door and the stove.
    let nobodys = "SELECT thing FROM act WHERE resident IS NULL ORDER BY at";
    assert_eq!(texts(&truth, nobodys), ["front door", "front door", "stove"]);
    let caused = "SELECT count(*) FROM cause WHERE why = 'act' AND resident IS NULL AND thing = 'stove'";
    assert!(count(&truth, caused) > 0, "its sensor says so, and that it was nobody's doing");
    assert!(count(&log, "SELECT count(*) FROM event") > 100);
    // They fell, and stayed on the floor for the requested time.
    let fallen = "SELECT count(*) FROM activity WHERE name = 'fallen'";
    assert_eq!(count(&truth, fallen), 2);
    let lost = |loss: &str| count(&truth, &format!("SELECT count(*) FROM lost WHERE loss = '{loss}'"));
    assert!(lost("battery") > 0 && lost("stuck") > 0, "{} {}", lost("battery"), lost("stuck"));

    let lived_again = replay(&folder.join("recording.json"), &temporary.path().join("again"));
    assert_eq!(lived_again.agrees, Some(true));
    assert!(bytes(&folder) == bytes(&temporary.path().join("again")), "another log, or another truth");

    // The control: without the interventions in its recording, the run differs.
    let forgotten = temporary.path().join("forgotten.json");
    fs::write(&forgotten, without_interventions(&folder.join("recording.json"))).unwrap();
    assert_eq!(replay(&forgotten, &temporary.path().join("forgotten")).agrees, Some(false));
}

#[test]
fn a_stopped_run_with_interventions_resumes_to_the_same_bytes() {
    let temporary = TempDir::new().unwrap();
    let (stopped, told) = simulate(&temporary.path().join("runs"), 1.5, &all_interventions(), Some(22));
    assert!(stopped.is_stopped() && told.len() == 7, "{told:?}");
    let folder = folder(&stopped);
    // The control: the stored rows are not the beginning of a run without interventions.
    let recording = folder.join("recording.json");
    let noted = fs::read_to_string(&recording).unwrap();
    fs::write(&recording, without_interventions(&recording)).unwrap();
    let refused = IncompleteRun::open(&folder).unwrap().resume(|_| ());
    assert!(matches!(refused, Err(SimulationError::Log(_))), "{:?}", refused.map(|_| ()));
    fs::write(&recording, noted).unwrap();
    let whole = IncompleteRun::open(&folder).unwrap().resume(|_| ()).unwrap();
    assert!(!whole.is_stopped());
    let lived_again = replay(&recording, &temporary.path().join("again"));
    assert_eq!(lived_again.agrees, Some(true));
    assert!(bytes(&folder) == bytes(&temporary.path().join("again")), "another log, or another truth");
}

/// A stopped run is resumed, gets an intervention and is killed. Resuming it repeats the interventions.
#[test]
fn a_run_that_was_stopped_changed_and_killed_resumes() {
    let temporary = TempDir::new().unwrap();
    let (stopped, _) = simulate(&temporary.path().join("runs"), 1.5, &all_interventions(), Some(22));
    let folder = folder(&stopped);
    let (ask, asked) = channel();
    let (tell, told) = channel();
    let mut left = Some(on("bedroom door", false));
    let says = |RunProgress { done, .. }: RunProgress| {
        if done > 26 * HOUR
            && let Some(wish) = left.take()
        {
            let tell = tell.clone();
            ask.send(InterventionRequest {
                intervention: wish,
                answer: Box::new(move |outcome| tell.send(outcome).unwrap()),
            })
            .unwrap();
        }
        assert!(done < 30 * HOUR, "it dies here");
    };
    let unfinished = IncompleteRun::open(&folder).unwrap().interventions(asked);
    let died = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| unfinished.resume(says).map(|_| ())));
    assert!(died.is_err() && all(&told).iter().all(Result::is_ok), "it has done it, and died");
    let whole = IncompleteRun::open(&folder).unwrap().resume(|_| ()).unwrap();
    assert!(!whole.is_stopped() && whole.recording.outside.len() == 8, "{:?}", whole.recording.outside);
    let lived_again = replay(&folder.join("recording.json"), &temporary.path().join("again"));
    assert_eq!(lived_again.agrees, Some(true));
    assert!(bytes(&folder) == bytes(&temporary.path().join("again")), "another log, or another truth");
}

#[test]
fn a_fallen_resident_stays_on_the_floor_and_gets_up() {
    let temporary = TempDir::new().unwrap();
    let requests: Vec<(i64, OrderedIntervention)> =
        (1..14 * 24).step_by(5).map(|hour| (hour, fall(hour % 50 + 1))).collect();
    let (lived, told) = simulate(temporary.path(), 15.0, &requests, None);
    assert_eq!(told.len(), requests.len());
    let out = told.iter().filter(|told| told.is_err()).count();
    assert!(out < told.len() / 2, "{told:?}");
    assert!(told.iter().flat_map(|told| told.as_ref().err()).all(|refusal| refusal.code == "outside::not-at-home"));
    let truth = folder(&lived).join("truth.db");
    let fallen = count(&truth, "SELECT count(*) FROM activity WHERE name = 'fallen'");
    assert_eq!(fallen as usize, told.len() - out, "each fall is told");
    // Each stays on the floor until the time is over.
    let lying = "SELECT count(*) FROM outside o WHERE what = 'fall' AND NOT EXISTS (SELECT 1 FROM movement m
        WHERE m.posture = 'down' AND m.end_at > o.at AND m.begin_at <= o.until_at)";
    assert_eq!(count(&truth, lying), 0);
    let walks_on =
        "SELECT count(*) FROM movement WHERE kind = 'stride' AND begin_at > (SELECT max(until_at) FROM outside)";
    assert!(count(&truth, walks_on) > 100, "life goes on");
    // The truth has the room of the body: each stride begins at the end of the one before.
    let jumps = "SELECT count(*) FROM (SELECT from_x, from_y, lag(to_x) OVER w AS x, lag(to_y) OVER w AS y FROM movement
        WINDOW w AS (PARTITION BY resident ORDER BY begin_at)) WHERE abs(from_x - x) > 0.011 OR abs(from_y - y) > 0.011";
    assert_eq!(count(&truth, jumps), 0);
}

#[test]
fn refuses_impossible_actions_and_changes_nothing() {
    let temporary = TempDir::new().unwrap();
    let wrong = [
        (on("front dor", true), "outside::unknown-name", "front door"),
        (on("front door", false), "outside::already-so", ""),
        (fails("hall", SensorFailure::FallsOff, None), "outside::unknown-name", ""),
        (fails("bed sensor", SensorFailure::FallsOff, Some(Span::ZERO)), "outside::fault-ends-too-soon", ""),
        (
            fails("bed sensor", SensorFailure::Stuck { every_us: Some(Span::MICROSECOND) }, None),
            "outside::repeat-interval",
            "0.1 s",
        ),
        (OrderedIntervention::Fall { resident: "bob".into(), lies: None }, "outside::unknown-name", "margaret"),
        (
            OrderedIntervention::Fall { resident: "margaret".into(), lies: Some(Span::MICROSECOND) },
            "outside::lying-time",
            "",
        ),
    ];
    let requests: Vec<(i64, OrderedIntervention)> = wrong.iter().map(|(wish, ..)| (2, wish.clone())).collect();
    let (lived, told) = simulate(&temporary.path().join("a"), 0.5, &requests, None);
    for ((wish, code, hint), told) in wrong.iter().zip(&told) {
        let refusal = told.as_ref().expect_err("refused");
        assert_eq!(refusal.code, *code, "{wish:?}");
        assert!(refusal.hint.contains(hint), "{wish:?}: {refusal:?}");
    }
    let (plain, _) = simulate(&temporary.path().join("b"), 0.5, &[], None);
    assert_eq!(bytes(&folder(&lived)), bytes(&folder(&plain)));
}

#[test]
fn refuses_a_recording_with_impossible_actions() {
    let temporary = TempDir::new().unwrap();
    let (lived, _) = simulate(temporary.path(), 0.5, &[(2, on("front door", true))], None);
    let recording = folder(&lived).join("recording.json");
    let text = fs::read_to_string(&recording).unwrap();
    for (from, to, code) in [
        ("\"thing\": \"front door\"", "\"thing\": \"back door\"", "outside::unknown-name"),
        ("\"at_us\": ", "\"at_us\": -", "outside::not-in-run"),
    ] {
        assert!(text.contains(from), "{text}");
        fs::write(&recording, text.replacen(from, to, 1)).unwrap();
        let Err(SimulationError::Problems(problems)) = RecordedRun::open(&recording) else {
            panic!("{to} is accepted")
        };
        assert_eq!(problems.0[0].code, code, "{}", problems.render());
    }
}
