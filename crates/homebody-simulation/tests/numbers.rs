//! Parameters of the models: their effects, and the values that are refused.

use homebody_core::event::Firing;
use homebody_core::numbers::Number;
use homebody_core::time::DAY;
use homebody_simulation::{
    Cancel, Destinations, IncompleteRun, OpenScenario, RecordedRun, RunSetup, ScenarioSource, SimulationError, numbers,
    template,
};
use std::fs;

/// Together they have homes of one person and of several, guests, a cat, wandering, all kinds of sensors and links.
const TEMPLATES: [&str; 3] = ["couple-with-cat", "tigerplace-decline", "tigerplace-depression"];

/// The firings of residents who differ from their routines as people do.
fn varied_firings(scenario: &OpenScenario, days: i64) -> Vec<Firing> {
    firings(scenario.run().length(days * DAY).one_of_many())
}

fn firings(run: RunSetup) -> Vec<Firing> {
    let mut run = run.start().unwrap();
    let mut firings = Vec::new();
    while let Some(batch) = run.next_batch().unwrap() {
        firings.extend_from_slice(batch.firings);
    }
    firings
}

fn set(scenario: &OpenScenario, name: &str, value: f64) -> OpenScenario {
    scenario.with_numbers([(name, value)]).unwrap()
}

#[test]
fn every_number_set_to_what_it_is_changes_nothing() {
    let all = || numbers().into_iter().map(|number| (number.name.into_owned(), number.value));
    for name in TEMPLATES {
        let scenario = template(name).unwrap();
        let usual = varied_firings(&scenario, 4);
        assert!(usual.len() > 1_000, "{name}: {}", usual.len());
        assert!(varied_firings(&scenario.with_numbers(all()).unwrap(), 4) == usual, "{name}");
        // The control: one of them is a little higher.
        let more = all().map(|(name, value)| if name == "gait.spread" { (name, value * 1.01) } else { (name, value) });
        assert!(varied_firings(&scenario.with_numbers(more).unwrap(), 4) != usual, "{name}");
    }
}

/// An apartment with a routine that mentions few habits.
fn unsaid() -> OpenScenario {
    let scenario = template("tigerplace").unwrap();
    let routine = "Margaret is 82.\nSometimes she gets up at 8:00.\nSometimes she goes to bed at 22:00.\n\
        Every day\n  she eats lunch\n  she eats dinner\n  she takes a nap\n";
    let texts = scenario.scenario().edit().routine(0, "unsaid.routine", routine).into_texts();
    ScenarioSource::from_texts(texts, "scenario.json").open().unwrap()
}

#[test]
fn a_parameter_changes_its_own_model() {
    let (unsaid, couple) = (unsaid(), template("couple-with-cat").unwrap());
    let of_couple = [
        ("gait.half_turn", 4.0),
        ("mesh.into_seat", 1.0),
        ("stay.busy.gap", 80.0),
        ("filler.reading.weight", 3.0),
        ("need.thirst", 2.0),
        ("night.latency", 60.0),
        ("person.pace", 0.9),
        ("life.day_spread", 1.0),
        ("pet.sleep", 10.0),
    ];
    let of_unsaid = [
        ("posture.sitting", 0.5),
        ("activity.eating_lunch.minutes", 40.0),
        ("activity.eating_dinner.clock", 19.0),
        ("activity.napping.clock_spread", 120.0),
        ("day.bed", 21.5),
        ("day.up", 9.0),
        ("constitution.toilet_by_day", 8.0),
    ];
    let usual = varied_firings(&couple, 3);
    for (name, value) in of_couple {
        assert!(varied_firings(&set(&couple, name, value), 3) != usual, "{name}");
    }
    let usual = firings(unsaid.run().days(3));
    for (name, value) in of_unsaid {
        assert!(firings(unsaid.run().days(3).number(name, value)) != usual, "{name}");
    }
}

#[test]
fn no_value_in_range_stops_a_run() {
    let scenarios = TEMPLATES.map(|name| template(name).unwrap());
    let all: Vec<Number> = numbers();
    // Several at once, each apart from its neighbours, to save time.
    for (first, scenario) in (0..27).flat_map(|first| scenarios.iter().map(move |scenario| (first, scenario))) {
        for end in [|number: &Number| number.least, |number: &Number| number.most] {
            let some = all.iter().skip(first).step_by(27).map(|number| (number.name.to_string(), end(number)));
            let some: Vec<(String, f64)> = some.collect();
            // In some homes no path is left, which loading reports.
            let Ok(scenario) = scenario.with_numbers(some.clone()) else {
                assert!(some.iter().any(|(name, _)| name.starts_with("mesh.")), "{some:?}");
                continue;
            };
            let mut run = scenario.run().length(DAY).one_of_many().start().unwrap();
            while run.next_batch().unwrap_or_else(|error| panic!("{some:?}: {error}")).is_some() {}
        }
    }
}

#[test]
fn refuses_all_wrong_parameters_at_once() {
    let scenario = template("tigerplace").unwrap();
    let wrong = scenario.run().number("gait.slowst", 0.3).number("need.thirst", 100.0).start().err().unwrap();
    assert!(matches!(&wrong, SimulationError::Problems(problems) if problems.0.len() == 2), "{wrong}");
    let SimulationError::Problems(problems) = wrong else { unreachable!("matched above") };
    let [unknown, large] = [&problems.0[0], &problems.0[1]];
    assert_eq!((unknown.code, &unknown.data["nearest"]), ("parameter::unknown", &"gait.slowest".into()));
    assert_eq!(
        (large.code, &large.data["most"], &large.data["usual"]),
        ("parameter::out-of-range", &48.0.into(), &4.0.into())
    );
    assert!(scenario.cohort(2).number("need.thirst", f64::NAN).start().is_err());
    assert!(scenario.run().number("gait.slowest", 0.3).start().is_ok());
}

#[test]
fn a_recording_has_its_parameters_and_replays_to_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let into = |name: &str| Destinations::new_folder_in(folder.path().join(name));
    let lived = template("tigerplace").unwrap().run().days(2).number("gait.half_turn", 5.0).start().unwrap();
    let lived = lived.store(&into("first"), |_| ()).unwrap();
    assert!(lived.recording.files["scenario.json"].contains("\"gait.half_turn\": 5"));
    let path = folder.path().join("recording.json");
    fs::write(&path, serde_json::to_string(&lived.recording).unwrap()).unwrap();
    let again = RecordedRun::open(&path).unwrap().start().store(&into("again"), |_| ()).unwrap();
    assert_eq!(again.agrees, Some(true));
    // The control: without it, the run differs.
    let text = fs::read_to_string(&path).unwrap();
    let other = text.replace("\\\"gait.half_turn\\\": 5", "\\\"gait.half_turn\\\": 2");
    assert_ne!(other, text);
    fs::write(&path, other).unwrap();
    let other = RecordedRun::open(&path).unwrap().start().store(&into("other"), |_| ()).unwrap();
    assert_eq!(other.agrees, Some(false));
}

#[test]
fn a_stopped_run_with_a_parameter_resumes() {
    let folder = tempfile::tempdir().unwrap();
    let scenario = template("tigerplace").unwrap();
    let begun = |cancel: &Cancel| scenario.run().days(3).number("gait.half_turn", 5.0).cancel(cancel).start().unwrap();
    let cancel = Cancel::new();
    let stopped = begun(&cancel).store(&Destinations::new_folder_in(folder.path()), |now| {
        if now.done >= DAY {
            cancel.cancel();
        }
    });
    assert!(stopped.unwrap().is_stopped());
    let left = fs::read_dir(folder.path()).unwrap().next().unwrap().unwrap().path();
    let done = IncompleteRun::open(&left).unwrap().resume(|_| ()).unwrap();
    let whole = begun(&Cancel::new()).store(&Destinations::new_folder_in(folder.path().join("whole")), |_| ()).unwrap();
    assert_eq!(done.recording, whole.recording);
}

#[test]
fn a_cohort_has_parameters_too() {
    let scenario = template("tigerplace").unwrap();
    let firings = |cohort: homebody_simulation::CohortSetup| {
        let lived = cohort.days(1).start().unwrap().run_each(|_, mut run| {
            let mut firings = Vec::new();
            while let Some(batch) = run.next_batch()? {
                firings.extend_from_slice(batch.firings);
            }
            Ok::<_, SimulationError>(firings)
        });
        lived.unwrap()
    };
    let usual = firings(scenario.cohort(2));
    assert!(firings(scenario.cohort(2).number("gait.half_turn", 2.0)) == usual);
    let slow = firings(scenario.cohort(2).number("gait.half_turn", 6.0));
    assert!(slow.iter().zip(&usual).all(|(slow, usual)| slow != usual));
}
