//! Cameras in a home: the steps of a run do not change their pictures, a sleeping camera costs nothing, and problems of a camera are
//! reported.

use homebody_core::event::{Events, Value};
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{RunTime, SECOND, Span};
use serde_json::json;
use std::collections::BTreeMap;

const LENGTH: Span = SECOND.times(120);

/// A room with two cameras, in which a body walks and falls.
fn texts(camera: &serde_json::Value) -> BTreeMap<String, String> {
    let home = json!({ "name": "one room",
        "rooms": [{ "name": "room", "outline": [[0, 0], [5, 0], [5, 4], [0, 4]] }],
        "walls": [{ "from": [0, 0], "to": [5, 0] }, { "from": [5, 0], "to": [5, 4] },
            { "from": [5, 4], "to": [0, 4] }, { "from": [0, 4], "to": [0, 0] }],
        "furniture": [{ "name": "bed", "at": [1.1, 3.4], "size_m": [2.0, 0.9], "height_m": 0.55, "enterable": true }],
        "sensors": [{ "kind": "motion", "name": "motion", "at": [4.95, 0.6], "facing_deg": 160 }, camera,
            { "kind": "camera", "name": "second", "at": [4.85, 0.15], "facing_deg": 140, "woken_by": ["motion"] }] });
    let entry = json!({ "name": "cameras", "start": "2026-03-02T09:00:00", "time_zone": "UTC", "days": 1,
        "home": "home.json", "residents": ["somebody.json"] });
    let somebody = json!({ "name": "somebody", "driver": { "path": "path.json" } });
    let path = json!({ "start": [4.4, 1.2], "steps": [
        { "go": { "to": [[2.4, 2.0]], "pace_mps": 0.8 } }, { "wait": { "for_s": 30, "posture": "down" } },
        { "go": { "to": [[4.0, 2.4]], "pace_mps": 0.8 } }, { "wait": { "for_s": 8, "posture": "bending" } } ] });
    [("scenario.json", entry), ("home.json", home), ("somebody.json", somebody), ("path.json", path)]
        .into_iter()
        .map(|(name, text)| (name.to_owned(), text.to_string()))
        .collect()
}

fn first(woken_by: &[&str]) -> serde_json::Value {
    json!({ "kind": "camera", "name": "first", "at": [0.15, 0.15], "facing_deg": 40, "woken_by": woken_by })
}

fn lived(step: Span) -> Events {
    let scenario = Scenario::load(&texts(&first(&["motion"])), "scenario.json").unwrap();
    let mut run = Run::new(&scenario, &(), 7, LENGTH);
    let mut events = Events::default();
    while run.now() < RunTime::START + LENGTH {
        run.advance(run.now() + step, &mut events).unwrap();
    }
    events
}

#[test]
fn the_steps_of_a_run_change_no_silhouette() {
    let whole = lived(LENGTH);
    assert!(whole.frames.len() > 50, "{}", whole.frames.len());
    for step in [Span::from_millis(1), Span::from_micros(137_731), SECOND] {
        let pieces = lived(step);
        assert_eq!(pieces.firings, whole.firings);
        assert!(pieces.frames == whole.frames, "in steps of {step}");
    }
}

#[test]
fn a_camera_wakes_with_its_sensor_and_sleeps_after_it() {
    let events = lived(LENGTH);
    let of = |sensor: usize, value: Value| {
        events.firings.iter().filter(move |firing| firing.sensor.index() == sensor && firing.value == value)
    };
    let motion: Vec<RunTime> = of(0, Value::Fire).map(|firing| firing.at).collect();
    for camera in [1, 2] {
        let (woke, slept) = (of(camera, Value::Woke).count(), of(camera, Value::Slept).count());
        assert!(woke > 0 && (slept == woke || slept + 1 == woke), "{woke} {slept}");
        for firing in of(camera, Value::Woke) {
            assert!(motion.contains(&firing.at));
        }
        // A picture is taken only within ten seconds of a word of the sensor, to one period.
        for frame in events.frames.iter().filter(|frame| frame.sensor.index() == camera) {
            assert!(motion.iter().any(|&at| (Span::ZERO..=10 * SECOND + SECOND / 5).contains(&(frame.at - at))));
        }
    }
}

#[test]
fn rejects_cameras_that_see_nothing_or_never_wake() {
    let told = |camera: serde_json::Value| {
        let problems = Scenario::load(&texts(&camera), "scenario.json").err().map(|problems| problems.render());
        problems.unwrap_or_default()
    };
    assert_eq!(told(first(&["motion"])), "");
    assert!(told(first(&[])).contains("error[sensor::camera-never-wakes]"));
    assert!(told(first(&["moton"])).contains("did you mean \"motion\"?"), "{}", told(first(&["moton"])));
    assert!(told(first(&["second"])).contains("error[sensor::unknown-part]"));
    let with = |key: &str, value: serde_json::Value| {
        let mut camera = first(&["motion"]);
        camera[key] = value;
        told(camera)
    };
    assert!(with("at", json!([9, 9])).contains("error[sensor::camera-outside]"));
    assert!(with("at", json!([0.02, 2])).contains("error[sensor::camera-inside-solid]"));
    assert!(with("facing_deg", json!(225)).contains("error[sensor::camera-sees-nothing]"));
    assert!(with("pixels", json!([0, 120])).contains("pixels"));
    assert!(with("frames_per_s", json!(10_000)).contains("frames_per_s"));
    assert!(with("height_m", json!(0)).contains("height_m"));
    assert!(with("field_deg", json!(200)).contains("field_deg"));
}

#[test]
fn rejects_bodies_and_cameras_above_the_ceiling() {
    let told = |ceiling_m: f64| {
        let mut texts = texts(&first(&["motion"]));
        let mut home: serde_json::Value = serde_json::from_str(&texts["home.json"]).unwrap();
        home["rooms"][0]["ceiling_m"] = json!(ceiling_m);
        texts.insert("home.json".into(), home.to_string());
        Scenario::load(&texts, "scenario.json").err().map(|problems| problems.render()).unwrap_or_default()
    };
    assert_eq!(told(2.4), "");
    let low = told(1.5);
    assert!(low.contains("error[resident::too-tall]"), "{low}");
    assert!(low.contains("error[sensor::camera-above-ceiling]"), "{low}");
    assert!(told(0.1).contains("ceiling_m"));
}
