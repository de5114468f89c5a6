//! Opening scenarios, simulating and storing runs and cohorts, and errors.

use homebody_core::drivers::{Driver, Next, Surroundings};
use homebody_core::event::{Events, Fact, Firing, ThingUse};
use homebody_core::geometry::Point;
use homebody_core::home::Home;
use homebody_core::ids::ThingId;
use homebody_core::messages::Diagnose;
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::posture::Posture;
use homebody_core::run::Run;
use homebody_core::time::{DAY, HOUR, MINUTE, RunTime, SECOND, Span};
use homebody_simulation::destination::{self, Begin, Cell, Destination, LogError, Policy, Sink, Watermark, WriteMode};
use homebody_simulation::pace::{Pace, RunCommand, Speed};
use homebody_simulation::{
    BoxError, Cancel, Destinations, IncompleteCohort, IncompleteRun, OpenScenario, RecordedRun, Simulation,
    SimulationError, template,
};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::mpsc::channel;
use std::sync::{Arc, Mutex};

fn tigerplace() -> OpenScenario {
    template("tigerplace").unwrap()
}

fn firings(mut run: Simulation) -> Vec<Firing> {
    let mut firings = Vec::new();
    while let Some(batch) = run.next_batch().unwrap() {
        assert!(batch.begin < batch.end && batch.settled <= batch.end);
        firings.extend_from_slice(batch.firings);
    }
    firings
}

#[test]
fn batches_are_the_run_cut_into_pieces() {
    let opened = tigerplace();
    let mut run = Run::new(opened.scenario(), opened.household(), 3, DAY);
    let mut events = Events::default();
    run.advance(RunTime::START + DAY, &mut events).unwrap();
    assert_eq!(firings(opened.run().seed(3).length(DAY).start().unwrap()), events.firings);
    assert_ne!(firings(opened.run().seed(4).length(DAY).start().unwrap()), events.firings);
}

#[test]
fn a_scenario_is_opened_by_its_folder_and_by_its_own_file() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/tigerplace");
    let (opened, by_file) =
        (homebody_simulation::open(&folder).unwrap(), homebody_simulation::open(folder.join("scenario.json")).unwrap());
    assert_eq!((opened.scenario(), opened.paths()), (by_file.scenario(), by_file.paths()));
    assert_eq!(opened.scenario(), tigerplace().scenario());
    assert!(opened.paths().contains(&folder.join("home.json")) && tigerplace().paths().is_empty());
    assert!(matches!(homebody_simulation::open(folder.join("nothing")), Err(SimulationError::Unreadable(_))));
    assert!(matches!(homebody_simulation::open(folder.join("home.json")), Err(SimulationError::Problems(_))));
}

#[test]
fn refuses_nonsense_before_the_run() {
    let opened = tigerplace();
    for days in [0.0, -1.0, f64::NAN, f64::INFINITY, 36_526.0, 1e-12] {
        assert!(matches!(opened.run().days(days).start(), Err(SimulationError::Length { .. })), "{days}");
    }
    let wrong = opened.run().without(["grief"]).start().err().unwrap();
    assert!(matches!(&wrong, SimulationError::Problems(_)) && wrong.to_string().contains("shows \"grief\""), "{wrong}");
    let nobody = opened.run().driver("Margaret", |_, _| Odd(|_| Next::Activity(None))).start().err().unwrap();
    assert_eq!(nobody.diagnostic().code, "kit::no-resident");
    let folder = tempfile::tempdir().unwrap();
    let place = format!("sqlite:{}", folder.path().join("none/log.db").display());
    let run = opened.run().days(1).start().unwrap();
    assert!(matches!(run.store(&Destinations::log(&place).unwrap(), |_| ()), Err(SimulationError::Log(_))));
    assert!(matches!(Destinations::log("mysql:log"), Err(SimulationError::Log(_))));
}

#[test]
fn a_stored_run_replays_and_a_changed_recording_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let to = Destinations::new_folder_in(folder.path().join("runs"));
    let mut progress = Vec::new();
    let run = tigerplace().run().seed(5).days(1.5).start().unwrap();
    let lived = run.store(&to, |now| progress.push(now)).unwrap();
    assert_eq!(progress.last(), Some(&lived.progress));
    assert!(progress.is_sorted_by_key(|now| now.done) && progress.len() >= 36);
    assert_eq!((lived.agrees, lived.is_stopped()), (None, false));
    assert_eq!(lived.rows_by_sensor().map(|(_, rows)| rows).sum::<u64>(), lived.stored.rows);
    let path = lived.recorded.clone().unwrap();
    let again = |path: &Path| {
        let to = Destinations::log(&format!("csv:{}", folder.path().join("again.csv").display())).unwrap();
        RecordedRun::open(path).unwrap().start().store(&Destinations { replace: true, ..to }, |_| ()).unwrap()
    };
    assert_eq!(again(&path).agrees, Some(true));
    let other = folder.path().join("other.json");
    fs::write(&other, fs::read_to_string(&path).unwrap().replace("\"seed\": 5", "\"seed\": 6")).unwrap();
    assert_eq!(again(&other).agrees, Some(false));
    assert!(matches!(RecordedRun::open(folder.path().join("none.json")), Err(SimulationError::NoRecording { .. })));
    fs::write(&other, "{}").unwrap();
    assert!(matches!(RecordedRun::open(&other), Err(SimulationError::Recording { .. })));
    for entry in ["", "none.json", &"long".repeat(1000)] {
        let text = fs::read_to_string(&path).unwrap();
        let entry = format!("\"entry\": {entry:?}");
        assert!(text.contains("\"entry\": \"scenario.json\""));
        fs::write(&other, text.replace("\"entry\": \"scenario.json\"", &entry)).unwrap();
        let why = RecordedRun::open(&other).err().unwrap().to_string();
        assert!(why.contains("is not among its files") && why.len() < 1000, "{why}");
    }
}

#[test]
fn a_cancelled_run_stops_between_batches_with_complete_files() {
    let folder = tempfile::tempdir().unwrap();
    let cancel = Cancel::new();
    let run = tigerplace().run().days(30).cancel(&cancel).start().unwrap();
    let lived = run.store(&Destinations::new_folder_in(folder.path()), |now| {
        if now.done >= DAY {
            cancel.cancel();
        }
    });
    let lived = lived.unwrap();
    let length = lived.recording.length_us;
    assert!(lived.is_stopped() && (DAY..DAY + HOUR).contains(&length));
    assert_eq!(lived.recording.firings, firings(tigerplace().run().length(length).start().unwrap()).len() as u64);
}

/// Keeps the numbers of the rows that it gets, as many as it says to hold already left out.
struct Kept {
    rows: Arc<Mutex<Vec<i64>>>,
    how: Arc<Mutex<Option<WriteMode>>>,
}

impl Sink for Kept {
    fn begin(&mut self, begin: &Begin) -> Result<Watermark, LogError> {
        *self.how.lock().unwrap() = Some(begin.how);
        Ok(Watermark(vec![self.rows.lock().unwrap().len() as u64]))
    }

    fn write(&mut self, batch: &destination::Batch) -> Result<(), LogError> {
        let number =
            |cell: Cell| if let Cell::Integer(number) = cell { number } else { panic!("{cell:?} numbers no row") };
        self.rows.lock().unwrap().extend(batch.rows().map(|row| number(row.cells[0])));
        Ok(())
    }

    fn make_durable(&mut self) -> Result<Watermark, LogError> {
        Ok(Watermark(vec![self.rows.lock().unwrap().len() as u64]))
    }

    fn finish(&mut self, _: RunTime) -> Result<(), LogError> {
        Ok(())
    }
}

#[test]
fn a_custom_destination_resumes() {
    let folder = tempfile::tempdir().unwrap();
    let rows: Arc<Mutex<Vec<i64>>> = Arc::default();
    let how: Arc<Mutex<Option<WriteMode>>> = Arc::default();
    let own = || Destination::own("kept", Kept { rows: rows.clone(), how: how.clone() }, Policy::default());
    let cancel = Cancel::new();
    let run = tigerplace().run().days(2).cancel(&cancel).start().unwrap();
    let to = Destinations::new_folder_in(folder.path());
    let stopped = run.store_with(&to, vec![own()], |now| {
        if now.done >= DAY {
            cancel.cancel();
        }
    });
    let stopped = stopped.unwrap();
    let before = rows.lock().unwrap().len() as u64;
    assert_eq!((before, *how.lock().unwrap()), (stopped.stored.rows, Some(WriteMode::Create)));
    let unfinished = IncompleteRun::open(stopped.folder.unwrap()).unwrap();
    let whole = unfinished.resume_with(vec![own()], |_| ()).unwrap();
    assert_eq!(*how.lock().unwrap(), Some(WriteMode::Resume));
    let rows = rows.lock().unwrap();
    assert!(whole.stored.rows > before && rows.iter().copied().eq(0..whole.stored.rows as i64), "each row once");
}

#[test]
fn a_resumed_cohort_counts_only_the_new_part() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().join("cohort");
    let lived = tigerplace().cohort(3).days(1).start().unwrap().store_in(&place, |_| ()).unwrap();
    assert_eq!((lived.done, lived.found, lived.is_stopped()), (3 * DAY, 0, false));
    assert!(matches!(IncompleteCohort::open(&place), Err(SimulationError::Complete { what: "cohort", .. })));
    fs::remove_dir_all(place.join("0002")).unwrap();
    let unfinished = IncompleteCohort::open(&place).unwrap();
    assert_eq!(unfinished.progress().done, 2 * DAY);
    let again = unfinished.resume(|now| assert!(now.done > 2 * DAY && now.done <= 3 * DAY)).unwrap();
    assert_eq!((again.done, again.found, again.list), (DAY, 2, lived.list));

    // The list names members that ended early, too.
    let cancel = Cancel::new();
    let stop = |now: homebody_simulation::RunProgress| {
        if now.done > Span::ZERO {
            cancel.cancel();
        }
    };
    let cohort = tigerplace().cohort(2).days(400).cancel(&cancel).start().unwrap();
    let lived = cohort.store_in(folder.path().join("stopped"), stop).unwrap();
    assert!(lived.is_stopped() && lived.ended_early == lived.list.members.len(), "{:?}", lived.list);
}

#[test]
fn commands_change_the_pace_of_a_run_and_not_its_events() {
    let (say, commands) = channel();
    for command in [RunCommand::Step(90 * SECOND), RunCommand::Speed(Speed::Max), RunCommand::Resume] {
        say.send(command).unwrap();
    }
    let setup = || tigerplace().run().length(DAY / 2);
    let paused = setup().pace(Pace::paused(Speed::times(1000.0).unwrap())).commands(commands).start().unwrap();
    let mut firings_of_paused = Vec::new();
    let sink = &mut |_: &Simulation, batch: homebody_simulation::EventBatch| {
        firings_of_paused.extend_from_slice(batch.firings);
        Ok::<(), BoxError>(())
    };
    paused.run_into(sink, |_| ()).unwrap();
    assert_eq!(firings_of_paused, firings(setup().start().unwrap()));
}

#[test]
fn a_sink_that_fails_ends_the_run() {
    let mut taken = 0;
    let sink = &mut |_: &Simulation, _: homebody_simulation::EventBatch| {
        taken += 1;
        if taken == 3 { Err("the third is too many".into()) } else { Ok::<(), BoxError>(()) }
    };
    let error = tigerplace().run().days(1).start().unwrap().run_into(sink, |_| ()).unwrap_err();
    assert_eq!((taken, error.diagnostic().code), (3, "kit::sink"));
}

/// A driver with a function for its answers.
#[derive(Clone, Debug)]
struct Odd(fn(RunTime) -> Next);

impl Driver for Odd {
    fn next(&mut self, around: &Surroundings) -> Next {
        self.0(around.now())
    }

    fn copy(&self) -> Box<dyn Driver> {
        Box::new(self.clone())
    }
}

fn segment(begin: RunTime, end: RunTime, doing: MotionState) -> Next {
    Next::Segment(MotionSegment { begin, end, doing, posture: Posture::Standing })
}

#[test]
fn names_a_driver_with_an_impossible_step() {
    assert!(
        run_with(move |_: &Home| Odd(|now| segment(now, now + SECOND, MotionState::Rest { at: Point::new(6.0, 4.0) })))
            .is_ok()
    );
    type Answer = fn(RunTime) -> Next;
    let odd: [(Answer, &str); 8] = [
        (|now| segment(now, now, MotionState::Away), "its segment ends at 0 s"),
        (|now| segment(now, now - SECOND, MotionState::Away), "its segment ends at -1 s"),
        (|now| segment(now + Span::MICROSECOND, now + SECOND, MotionState::Away), "its segment of movement begins at"),
        (|now| segment(now, now + SECOND, MotionState::Rest { at: Point::new(60.0, 4.0) }), "outside the home"),
        (
            |now| segment(now, now + SECOND, MotionState::Rest { at: Point::new(f64::NAN, 4.0) }),
            "an invalid number for the place",
        ),
        (
            |now| segment(now, now + SECOND, MotionState::InPlace { at: Point::new(6.0, 4.0), amplitude_m: -1.0 }),
            "an invalid number for the amplitude",
        ),
        (|_| Next::Use(ThingUse { thing: ThingId(1000), on: true }), "it uses the thing 1000"),
        (|_| Next::Activity(None), "answers in a row that take no time"),
    ];
    for (answer, told) in odd {
        let error = run_with(move |_: &Home| Odd(answer)).unwrap_err().to_string();
        assert!(error.starts_with("the driver of \"margaret\"") && error.contains(told), "{error}");
    }
}

fn run_with(driver: impl Fn(&Home) -> Odd + Send + Sync + 'static) -> Result<Span, SimulationError> {
    let run = tigerplace().run().length(DAY / 4).driver("margaret", move |home, _| driver(home)).start()?;
    let sink = &mut |_: &Simulation, _: homebody_simulation::EventBatch| Ok::<(), BoxError>(());
    Ok(run.run_into(sink, |_| ())?.done)
}

#[test]
fn events_before_the_error_of_a_driver_are_kept() {
    let odd = |now: RunTime| match now {
        RunTime::START => {
            segment(now, now + 90 * MINUTE, MotionState::InPlace { at: Point::new(6.0, 4.0), amplitude_m: 0.3 })
        }
        _ => segment(now, now, MotionState::Away),
    };
    let run = tigerplace().run().days(1).driver("margaret", move |_, _| Odd(odd));
    let mut run = run.start().unwrap();
    let (mut firings, mut movements, mut end) = (0, 0, RunTime::START);
    let error = loop {
        match run.next_batch() {
            Ok(Some(batch)) => {
                firings += batch.firings.iter().filter(|firing| firing.at.since_zero() >= HOUR).count();
                movements += batch.facts.iter().filter(|fact| matches!(fact, Fact::Movement { .. })).count();
                end = batch.end;
            }
            Ok(None) => panic!("it has ended without an error"),
            Err(error) => break error,
        }
    };
    assert!(error.to_string().contains("failed at 5400 s"), "{error}");
    assert!(firings > 100 && movements == 2, "{firings} firings, {movements} movements");
    assert_eq!(end, RunTime::START + 90 * MINUTE);
}

#[test]
fn a_recording_with_a_custom_driver_names_the_resident_and_does_not_replay() {
    let folder = tempfile::tempdir().unwrap();
    let still = |_: &_, _| Odd(|now| segment(now, RunTime::NEVER, MotionState::Rest { at: Point::new(6.0, 4.0) }));
    let run = tigerplace().run().days(0.25).driver("margaret", still).start().unwrap();
    let lived = run.store(&Destinations::new_folder_in(folder.path()), |_| ()).unwrap();
    let recording = lived.recorded.unwrap();
    assert!(lived.folder.is_none(), "nobody can go on with it");
    assert_eq!(homebody_simulation::recording(&recording).unwrap().own_drivers, ["margaret"]);
    let told = RecordedRun::open(&recording).err().unwrap().to_string();
    assert!(told.contains("a driver of another program moved margaret"), "{told}");
}

#[test]
fn members_in_memory_equal_stored_ones() {
    let folder = tempfile::tempdir().unwrap();
    let cohort = tigerplace().cohort(5).seed(11).days(1).start().unwrap();
    let stored = cohort.store_in(folder.path().join("cohort"), |_| ()).unwrap();
    let in_memory: Vec<(String, u64)> = cohort
        .run_each(|member, run| Ok::<_, SimulationError>((member.name.clone(), firings(run).len() as u64)))
        .unwrap();
    let listed: Vec<(String, u64)> = stored.list.members.iter().map(|one| (one.name.clone(), one.firings)).collect();
    assert_eq!(listed, in_memory);
    assert_eq!((stored.asked, stored.done), (5, 5 * DAY));
    assert!(stored.folder.join("cohort.json").is_file() && stored.folder.join("0005/log.db").is_file());
    let alone = tigerplace().cohort(2).seed(11).days(1).start().unwrap();
    assert_eq!(
        alone.run_each(|_, run| Ok::<_, SimulationError>(firings(run).len() as u64)).unwrap(),
        [listed[0].1, listed[1].1]
    );
    assert!(listed.iter().any(|(_, firings)| *firings != listed[0].1), "members differ");
}

#[test]
fn members_of_a_list_have_its_conditions() {
    let opened = template("tigerplace-depression").unwrap();
    let table = "name,seed,pace_mps,conditions\nslow,1,0.4,none\nas she is,1,,\n";
    let profiles = opened.profiles_from_table("people.csv", table, &[]).unwrap();
    let cohort = opened.cohort_of(profiles).days(1).start().unwrap();
    let lived = cohort.run_each(|member, run| Ok::<_, SimulationError>((member.clone(), firings(run)))).unwrap();
    assert_eq!(lived[0].0.row.as_ref().unwrap()["pace_mps"], "0.4");
    assert_eq!((lived[0].0.seed, lived[1].0.seed), (1, 1));
    assert_ne!(lived[0].1, lived[1].1);
    let own = opened.run().seed(1).days(1).one_of_many().start().unwrap();
    assert_eq!(lived[1].1, firings(own));
    let wrong = opened.profiles_from_table("people.csv", "name,pace\nanna,1\nanna,2\n", &[]).unwrap_err();
    assert!(matches!(&wrong, SimulationError::Problems(problems) if problems.0.len() == 2), "{wrong}");
}

#[test]
fn a_cancelled_cohort_lists_its_simulated_members() {
    let folder = tempfile::tempdir().unwrap();
    let cancel = Cancel::new();
    let cohort = tigerplace().cohort(40).days(1).cancel(&cancel).start().unwrap();
    let lived = cohort.store_in(folder.path(), |_| assert!(cancel.cancel() || cancel.is_cancelled())).unwrap();
    assert!(lived.list.members.len() < 40 && lived.done < 40 * DAY);
    assert!(lived.folder.join("cohort.json").is_file());
}

#[test]
fn a_million_acts_a_second_need_time_and_no_memory() {
    const QUIET: RunTime = RunTime::START.saturating_add(HOUR.times(6));
    let restless = |now: RunTime| match now < QUIET {
        true => segment(now, QUIET, MotionState::Rest { at: Point::new(6.0, 4.0) }),
        false => {
            let amplitude_m = if now.micros() % 2 == 0 { 0.2 } else { 0.3 };
            segment(now, now + Span::MICROSECOND, MotionState::InPlace { at: Point::new(6.0, 4.0), amplitude_m })
        }
    };
    let opened = tigerplace();
    let run = opened.run().days(1).driver("margaret", move |_, _| Odd(restless));
    let mut run = run.start().unwrap();
    let mut largest = 0;
    let mut hasty = 0;
    while hasty < 20 {
        let batch = run.next_batch().unwrap().unwrap();
        let size = batch.firings.len() + batch.facts.len();
        assert!(size <= 200_100, "{} to {}", batch.begin, batch.end);
        assert!(batch.begin < batch.end, "a run always goes on");
        largest = largest.max(size);
        hasty += usize::from(batch.begin >= QUIET);
    }
    // The control: after a quiet night, a step takes an hour, and only the limit ends it.
    assert!(largest >= 200_000, "{largest}");
}

#[test]
fn changes_nothing_while_another_program_writes_a_table_of_the_truth() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let to = Destinations {
        log: vec![format!("csv:{}", at("log.csv").display()).parse().unwrap()],
        truth: Some(format!("csv:{}", at("truth.csv").display()).parse().unwrap()),
        recording: Some(at("recording.json")),
        replace: true,
        ..Destinations::default()
    };
    fs::write(at("recording.json"), "of another run").unwrap();
    let run = || tigerplace().run().length(SECOND).start().unwrap();
    let lock = homebody_log::files::lock::FileLock::take(&at("truth.cause.csv")).unwrap();
    let error = run().store(&to, |_| ()).unwrap_err().to_string();
    assert!(error.contains("another program is writing into") && error.contains("truth.cause.csv"), "{error}");
    assert_eq!(fs::read_to_string(at("recording.json")).unwrap(), "of another run");
    drop(lock);
    run().store(&to, |_| ()).unwrap();
}

#[test]
fn warns_about_sensors_that_never_fire() {
    let texts: BTreeMap<String, String> = homebody_simulation::Template::named("tigerplace").unwrap().files().collect();
    let with = |sensor: &str| {
        let mut texts = texts.clone();
        let home = texts["home.json"].replacen("\"sensors\": [", &format!("\"sensors\": [\n{sensor},"), 1);
        texts.insert("home.json".into(), home);
        let scenario = homebody_simulation::ScenarioSource::from_texts(texts, "scenario.json").open().unwrap();
        scenario
            .remarks(DAY)
            .into_iter()
            .map(|remark| (remark.code, remark.data["sensor"] == "new"))
            .collect::<Vec<_>>()
    };
    let contact = |on: &str| with(&format!(r#"{{ "kind": "contact", "name": "new", "on": "{on}" }}"#));
    assert_eq!(contact("bookcase"), [("life::unused-thing", true)]);
    for used in ["fridge", "wardrobe", "front door"] {
        assert_eq!(contact(used), [], "{used}");
    }
    let motion = |facing: u32| {
        let at = format!(r#""at": [3.8, 6.45], "height_m": 2.1, "facing_deg": {facing}"#);
        with(&format!(r#"{{ "kind": "motion", "name": "new", {at} }}"#))
    };
    assert_eq!(motion(45), [("life::blind-sensor", true)]);
    assert_eq!(motion(225), []);
}
