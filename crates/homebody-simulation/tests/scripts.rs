//! Residents with scripts: the shipped scripts, checked by their ground truth, and rules for all scripts.

use homebody_core::event::{Events, Fact};
use homebody_core::ids::ResidentId;
use homebody_core::motion::MotionState;
use homebody_core::posture::Posture;
use homebody_core::run::Run;
use homebody_core::time::{HOUR, MINUTE, RunTime, SECOND, Span};
use homebody_simulation::{
    Destinations, IncompleteRun, RecordedRun, ScenarioSource, SimulationError, Template, template,
};
use std::collections::BTreeMap;

/// The truth of a shipped scenario, and the names of its rooms and things.
struct Truth {
    facts: Vec<Fact>,
    rooms: Vec<String>,
    things: Vec<String>,
}

fn truth_of(name: &str) -> Truth {
    let mut run = template(name).unwrap().run().start().unwrap();
    let plan = run.home().plan.clone();
    let mut facts = Vec::new();
    while let Some(batch) = run.next_batch().unwrap() {
        facts.extend_from_slice(batch.facts);
    }
    let rooms = plan.rooms.iter().map(|room| room.name.clone()).collect();
    Truth { facts, rooms, things: plan.things.iter().map(|thing| thing.name.clone()).collect() }
}

impl Truth {
    /// The stays of a resident in a room.
    fn stays(&self, who: u32, room: &str) -> Vec<(RunTime, RunTime)> {
        let rooms: Vec<(RunTime, Option<&str>)> = self
            .facts
            .iter()
            .filter_map(|fact| match fact {
                Fact::Room { resident: ResidentId(id), at, room } if *id == who => {
                    Some((*at, room.map(|room| self.rooms[room.index()].as_str())))
                }
                _ => None,
            })
            .collect();
        let stays = rooms.windows(2).filter(|pair| pair[0].1 == Some(room));
        stays.map(|pair| (pair[0].0, pair[1].0)).collect()
    }

    /// The times at which a resident turned a thing on or off.
    fn uses(&self, who: u32, thing: &str, on: bool) -> Vec<RunTime> {
        let uses = self.facts.iter().filter_map(|fact| match fact {
            Fact::Use { resident: Some(ResidentId(id)), at, act }
                if *id == who && act.on == on && self.things[act.thing.index()] == thing =>
            {
                Some(*at)
            }
            _ => None,
        });
        uses.collect()
    }

    /// The activities of a resident, with their starts.
    fn activities(&self, who: u32) -> Vec<(RunTime, &str)> {
        let named = self.facts.iter().filter_map(|fact| match fact {
            Fact::Activity { resident: ResidentId(id), at, name: Some(name) } if *id == who => {
                Some((*at, name.as_str()))
            }
            _ => None,
        });
        named.collect()
    }

    fn movements(&self, who: u32) -> impl Iterator<Item = (RunTime, RunTime, MotionState, Posture)> {
        self.facts.iter().filter_map(move |fact| match fact {
            Fact::Movement { resident: ResidentId(id), begin, end, doing, posture } if *id == who => {
                Some((*begin, *end, *doing, *posture))
            }
            _ => None,
        })
    }
}

#[test]
fn the_lamp_is_on_exactly_while_she_is_in_the_dark_hall() {
    let truth = truth_of("dark-hall");
    let (on, off) = (truth.uses(0, "hall", true), truth.uses(0, "hall", false));
    let stays = truth.stays(0, "hall");
    assert!(stays.len() >= 4, "{} ways through the hall", stays.len());
    assert_eq!((on.len(), off.len()), (stays.len(), stays.len()));
    for ((begin, end), (on, off)) in stays.into_iter().zip(on.into_iter().zip(off)) {
        // She looks around each half second, and a room ends in its doorway.
        for (late, what) in [(on - begin, "on after she came"), (off - end, "off after she left")] {
            assert!((Span::ZERO..=SECOND).contains(&late), "{what}: {} s", late.seconds());
        }
    }
}

#[test]
fn the_door_is_answered_and_the_book_read_on() {
    let truth = truth_of("door-bell");
    let rings = truth.uses(1, "door bell", true);
    let opened = truth.uses(0, "front door", true);
    assert_eq!((rings.len(), opened.len()), (2, 2));
    for (ring, opened) in rings.iter().zip(&opened) {
        let late = *opened - *ring;
        assert!((5 * SECOND..MINUTE).contains(&late), "opened after {} s", late.seconds());
    }
    let (_, first) = truth.movements(0).next().map(|(begin, _, doing, _)| (begin, doing)).unwrap();
    let seat = |doing: MotionState| match doing {
        MotionState::Rest { at } | MotionState::InPlace { at, .. } => Some(at),
        _ => None,
    };
    for opened in opened {
        let later = truth.movements(0).find(|(begin, _, _, posture)| *begin > opened && *posture == Posture::Sitting);
        let (begin, _, doing, _) = later.unwrap();
        assert!(begin - opened < 90 * SECOND, "back after {} s", (begin - opened).seconds());
        assert!(seat(doing).unwrap().distance(seat(first).unwrap()) < 0.01, "in the same seat");
    }
    let labels: Vec<&str> = truth.activities(0).into_iter().map(|(_, label)| label).collect();
    assert_eq!(labels, ["reading", "answering_door", "reading", "answering_door", "reading"]);
}

#[test]
fn a_higher_layer_suppresses_the_lower_ones_and_releases_them() {
    let truth = truth_of("robot");
    let activities = truth.activities(0);
    let charged: Vec<RunTime> =
        activities.iter().filter(|(_, label)| *label == "charging").map(|(at, _)| *at).collect();
    assert!(charged.len() >= 3, "charged {} times", charged.len());
    // It begins at its dock.
    let mut full = RunTime::START + 5 * MINUTE;
    for &charging in &charged[1..] {
        // The lower layers move it until the battery is low, and not afterwards.
        let low = full + 20 * MINUTE;
        let between = |from: RunTime, to: RunTime| -> Vec<&str> {
            activities.iter().filter(|(at, _)| (from..to).contains(at)).map(|(_, label)| *label).collect()
        };
        let (before, after) = (between(full, low), between(low, charging));
        assert!(before.contains(&"wandering") && before.contains(&"avoiding"), "{before:?}");
        assert!(!before.contains(&"going_home") && after.contains(&"going_home"), "{after:?}");
        assert!(!after.contains(&"wandering"), "{after:?}");
        full = charging + 5 * MINUTE;
    }
    let last = activities.last().unwrap();
    assert!(last.0 > charged[0] && activities.iter().any(|(at, label)| *at > charged[0] && *label == "wandering"));
    // Avoiding is never suppressed, so it hits nothing.
    let home = template("robot").unwrap();
    let plan = home.scenario().home.plan().clone();
    for (_, _, doing, _) in truth.movements(0) {
        if let MotionState::Stride { from, to } = doing {
            for part in 0..=10 {
                let at = from + (to - from) * (f64::from(part) / 10.0);
                assert!(plan.is_walkable(at, 0.08), "it is at {at}");
            }
        }
    }
}

/// A scenario as `dark-hall` with another script.
fn with(script: &str) -> ScenarioSource {
    let mut files: BTreeMap<String, String> = Template::named("dark-hall").unwrap().files().collect();
    files.insert("clara.rhai".into(), script.into());
    ScenarioSource::from_texts(files, "scenario.json")
}

fn problems(script: &str) -> String {
    match with(script).open() {
        Err(SimulationError::Problems(problems)) => problems.render(),
        Err(other) => panic!("{other}"),
        Ok(_) => String::new(),
    }
}

/// The error that ends a run of a script.
fn end(script: &str) -> String {
    let mut run = with(script).open().unwrap().run().start().unwrap();
    loop {
        match run.next_batch() {
            Ok(Some(_)) => {}
            Ok(None) => return String::new(),
            Err(error) => return error.to_string(),
        }
    }
}

#[test]
fn reports_all_problems_before_the_run() {
    let said = problems(
        r#"const Seat = "armchiar";
fn next(around) {
    if around.is_on("stoove") { return go("hall"); }
    if around.roon == "hall" { return wate(3); }
    let a = [sit(Seat), wait("long"), wait(-1), turn_on("hal"), wait(5, "readin"), sit("table")];
    a.push(go());
    around.who("cellar");
    count = 3;
    a
}
"#,
    );
    for (place, what, hint) in [
        ("clara.rhai:3:21", "error[script::unknown-name]: the home has no thing \"stoove\"", "there are"),
        (
            "clara.rhai:4:15",
            "error[script::unknown-property]: there is no property around.roon",
            "did you mean around.room?",
        ),
        ("clara.rhai:4:39", "error[script::unknown-function]: there is no function wate", "docs/reference/scripts.md"),
        (
            "clara.rhai:5:18",
            "error[script::unknown-name]: the home has no seat \"armchiar\"",
            "did you mean \"armchair\"?",
        ),
        ("clara.rhai:5:30", "error[script::value-type]: wait needs a number as seconds, and this is text", ""),
        ("clara.rhai:5:57", "error[script::unknown-name]: the home has no thing \"hal\"", "did you mean \"hall\"?"),
        (
            "clara.rhai:5:73",
            "error[script::unknown-manner]: there is no manner \"readin\"",
            "did you mean \"reading\"?",
        ),
        ("clara.rhai:5:88", "error[script::unknown-name]: the home has no seat \"table\"", ""),
        ("clara.rhai:6:12", "error[script::value-count]: go does not take 0 values", "write go(place)"),
        (
            "clara.rhai:7:16",
            "error[script::unknown-name]: the home has no room \"cellar\"",
            "there are living room, hall",
        ),
        ("clara.rhai:8:5", "error[script::unknown-variable]: there is no variable count", "this.name"),
    ] {
        let lines = said.lines().skip_while(|line| !line.starts_with(&format!("{place}: {what}")));
        let told: Vec<&str> = lines.take(4).collect();
        assert!(!told.is_empty() && told.concat().contains(hint), "{place} {what} {hint}, in\n{said}");
    }
    assert!(problems("fn nxt(around) { wait(1) }").contains("error[script::no-next]"));
    assert!(problems("fn next() { wait(1) }").contains("write fn next(around)"));
    assert!(
        problems("let x = 1; fn next(around) { wait(1) }").contains("clara.rhai:1:1: error[script::outside-function]")
    );
    assert!(problems("fn next(around) {\n    wait(1\n}").contains("clara.rhai:3:1: error[script::syntax]"));
    assert!(problems("fn next(around) { eval(\"wait(1)\") }").contains("clara.rhai:1:19"));
}

#[test]
fn scripts_have_no_access_to_the_outside() {
    for call in ["sleep(1)", "timestamp()", "import \"x\" as y", "eval(\"1\")", "open_file(\"x\")", "exit()", "rand()"]
    {
        assert!(!problems(&format!("fn next(around) {{ {call}; wait(1) }}")).is_empty(), "{call}");
    }
}

#[test]
fn stops_a_script_that_runs_away_with_its_line() {
    for (script, what) in [
        ("fn next(around) {\n    loop { }\n}", "clara.rhai:1"),
        (
            "fn next(around) {\n    loop { }\n}",
            "error[script::slow-decision]: the script takes more than 50000 operations for one decision",
        ),
        (
            "// idle\nfn next(around) { turn_on(\"hall\") }",
            "clara.rhai:2:1: error[script::no-time]: the script made 100 decisions in a row that take no time",
        ),
        (
            "fn next(around) {\n    let n = 0;\n    while n < 5000 { n += 1; }\n    rest(0.1)\n}",
            "error[script::slow-hour]: the script takes more than 5000000 operations in one hour of the run",
        ),
        (
            "fn next(around) {\n    this.more += 1;\n    rest(1)\n}",
            "clara.rhai:2:15: error[script::missing-value]: a value is missing in + ((), i64)",
        ),
        ("fn next(around) { go(\"hal\" + \"k\") }", "error[script::unknown-name]: the home has no place \"halk\""),
        ("fn next(around) { 5 }", "error[script::not-a-step]: the script returned number"),
        ("fn next(around) { deep(1) }\nfn deep(n) { deep(n + 1) }", "error[script::deep-calls]"),
        ("fn next(around) { let a = []; loop { a.push(\"xxxxxxxxxxxxxxxx\"); } }", "clara.rhai:1"),
        ("fn next(around) { let a = \"x\"; loop { a += a; } }", "clara.rhai:1"),
        ("fn next(around) { throw \"enough\" }", "clara.rhai:1:19: error[script::failed]: the script failed: enough"),
    ] {
        let said = end(script);
        assert!(said.contains(what) && said.contains("the driver of \"clara\""), "{script}\n{said}");
    }
    // The control: a loop with an end is allowed.
    assert_eq!(end("fn next(around) { let n = 0; while n < 5000 { n += 1; } rest(600) }"), "");
}

/// All events of a run from now to its end.
fn rest(mut run: Run) -> Events {
    let mut events = Events::default();
    run.advance(RunTime::MAX, &mut events).unwrap();
    events
}

#[test]
fn a_seed_decides_the_run_and_a_copy_continues_as_the_original() {
    for name in ["dark-hall", "door-bell", "robot"] {
        let open = template(name).unwrap();
        let run = |seed| Run::new(open.scenario(), open.household(), seed, 2 * HOUR);
        assert_eq!(rest(run(1)), rest(run(1)), "{name}");
        if name != "door-bell" {
            assert_ne!(rest(run(1)).facts, rest(run(2)).facts, "{name}: another seed is another life");
        }
        let mut original = run(1);
        original.advance(RunTime::START + 1900 * SECOND + Span::MICROSECOND, &mut Events::default()).unwrap();
        let copy = original.clone();
        let first = rest(original);
        assert_eq!(first, rest(copy), "{name}");
        assert!(!first.facts.is_empty());
    }
}

#[test]
fn a_run_with_a_script_is_recorded_replayed_and_resumed() {
    let folder = tempfile::tempdir().unwrap();
    let open = template("robot").unwrap();
    let path = folder.path().join("recording.json");
    let to = Destinations { recording: Some(path.clone()), runs: None, log: Vec::new(), ..Destinations::default() };
    let lived = open.run().length(HOUR).start().unwrap().store(&to, |_| ()).unwrap();
    assert!(lived.recording.files["robot.rhai"].contains("fn go_home"), "the recording has the script");
    let again = RecordedRun::open(&path).unwrap().start().store(&Destinations::own(), |_| ()).unwrap();
    assert_eq!(again.agrees, Some(true));

    let runs = Destinations { runs: Some(folder.path().join("runs")), ..Destinations::default() };
    let cancel = homebody_simulation::Cancel::new();
    let stopped = open.run().length(2 * HOUR).cancel(&cancel).start().unwrap().store(&runs, |progress| {
        if progress.done >= HOUR {
            cancel.cancel();
        }
    });
    let stopped = stopped.unwrap();
    let whole = IncompleteRun::open(stopped.folder.unwrap()).unwrap().resume(|_| ()).unwrap();
    let undisturbed = open.run().length(2 * HOUR).start().unwrap().store(&Destinations::own(), |_| ()).unwrap();
    assert_eq!(whole.recording.sha256, undisturbed.recording.sha256);
    assert!(whole.recording.firings > 100);
}
