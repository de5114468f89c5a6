//! Renaming and removing things in all files at once, and automatic repairs.

use super::served::Served;
use serde_json::{Value, json};
use std::fs;

fn text(served: &Served, name: &str) -> String {
    fs::read_to_string(served.file("tigerplace", name)).unwrap()
}

fn rename(served: &Served, kind: &str, from: &str, to: &str) -> Value {
    served.told("/api/rename", &json!({ "draft": { "texts": {} }, "kind": kind, "from": from, "to": to }))
}

fn files(view: &Value) -> Vec<&str> {
    view["texts"].as_object().unwrap().keys().map(String::as_str).collect()
}

fn problems(served: &Served, texts: &Value) -> usize {
    let check = served.told("/api/check", &json!({ "texts": texts }));
    check["problems"].as_array().unwrap().len()
}

/// Each kind of thing is renamed in each file, and the scenario stays valid.
#[test]
fn renames_a_thing_in_all_files() {
    let served = Served::scenario("tigerplace");
    for (kind, from, to, changed) in [
        ("sensor", "stove motion", "cooker \"motion\"", &["home.json", "logger.json"][..]),
        ("furniture", "armchair", "recliner", &["home.json", "margaret.routine"]),
        ("furniture", "stove", "cooker", &["home.json", "margaret.routine"]),
        ("furniture", "wardrobe", "closet", &["home.json"]),
        ("room", "kitchen", "galley", &["home.json"]),
        ("resident", "margaret", "joan", &["margaret.json", "margaret.routine"]),
    ] {
        let view = rename(&served, kind, from, to);
        assert_eq!(files(&view), changed, "{kind} {from}");
        assert_eq!(problems(&served, &view["texts"]), 0, "{kind} {from}");
    }
    let chair = rename(&served, "furniture", "armchair", "recliner");
    let routine = chair["texts"]["margaret.routine"].as_str().unwrap();
    assert_eq!(routine, text(&served, "margaret.routine").replace("the armchair", "the recliner"));
    let joan = rename(&served, "resident", "margaret", "joan");
    assert!(joan["texts"]["margaret.routine"].as_str().unwrap().contains("\nJoan is 82."));
    // "To bed" does not mean the piece of furniture.
    let bed = rename(&served, "furniture", "bed", "divan");
    assert_eq!(files(&bed), ["home.json"]);
    assert!(bed["texts"]["home.json"].as_str().unwrap().contains(r#""on": "divan""#));
    // The control: with the home's file only, the logger is wrong.
    let alone = text(&served, "home.json").replace("\"stove motion\"", "\"cooker motion\"");
    assert!(problems(&served, &json!({ "home.json": alone })) > 0);
}

#[test]
fn renames_nothing_if_a_name_is_ambiguous() {
    let served = Served::scenario("tigerplace");
    for (kind, from, to) in
        [("room", "bathroom", "kitchen"), ("room", "bathroom", "Kitchen"), ("sensor", "stove motion", "bedroom motion")]
    {
        assert_eq!(files(&rename(&served, kind, from, to)), [""; 0], "{kind} {from} {to}");
    }
    // And back again, as long as two things have the name.
    let home = text(&served, "home.json").replace("\"name\": \"bathroom\"", "\"name\": \"kitchen\"");
    assert_eq!(home.matches("\"name\": \"kitchen\"").count(), 2);
    let asked =
        json!({ "draft": { "texts": { "home.json": home } }, "kind": "room", "from": "kitchen", "to": "bathroom" });
    assert_eq!(files(&served.told("/api/rename", &asked)), [""; 0]);
    // The case of letters may change.
    assert_eq!(files(&rename(&served, "room", "kitchen", "Kitchen"))[0], "home.json");
}

#[test]
fn removing_a_thing_lists_and_removes_its_references() {
    let served = Served::scenario("tigerplace");
    let forget = |kind: &str, names: &[&str]| {
        served.told("/api/forget", &json!({ "draft": { "texts": {} }, "kind": kind, "names": names }))
    };
    let sensors = forget("sensor", &["stove motion", "bedroom motion", "stove temperature"]);
    assert_eq!(sensors["mentions"].as_array().unwrap().len(), 3);
    let logger: Value = serde_json::from_str(sensors["texts"]["logger.json"].as_str().unwrap()).unwrap();
    assert_eq!(logger["ids"].as_object().unwrap().len(), 15);
    assert!(sensors["texts"]["home.json"].is_null(), "the thing itself is left to the plan");

    let bed = forget("furniture", &["bed"]);
    assert_eq!(files(&bed), ["home.json", "logger.json"]);
    let home: Value = serde_json::from_str(bed["texts"]["home.json"].as_str().unwrap()).unwrap();
    assert_eq!(home["sensors"].as_array().unwrap().len(), 17, "the sensor on it goes as well, and its id");
    let logger: Value = serde_json::from_str(bed["texts"]["logger.json"].as_str().unwrap()).unwrap();
    assert!(logger["ids"].as_object().unwrap().len() == 17 && logger["ids"]["bed sensor"].is_null());
    assert!(home["furniture"].as_array().unwrap().iter().any(|piece| piece["name"] == "bed"));

    let chair = forget("furniture", &["armchair"]);
    let said = chair["mentions"][0]["said"].as_str().unwrap();
    assert!(said.starts_with("Often she naps in the armchair") && chair["mentions"][0]["goes"] == true);
    assert!(!chair["texts"]["margaret.routine"].as_str().unwrap().contains("armchair"));
    assert_eq!(forget("place", &["bedside"])["mentions"], json!([]));
}

/// Cameras name the sensors that wake them.
#[test]
fn renames_sensors_that_wake_cameras() {
    let served = Served::scenario("cameras");
    let wakers = |texts: &Value| -> Vec<usize> {
        let home: Value = serde_json::from_str(texts["home.json"].as_str().unwrap()).unwrap();
        let of = |sensor: &Value| sensor["woken_by"].as_array().map(Vec::len);
        home["sensors"].as_array().unwrap().iter().filter_map(of).collect()
    };
    let renamed = rename(&served, "sensor", "room motion", "corner motion");
    assert_eq!((problems(&served, &renamed["texts"]), wakers(&renamed["texts"])), (0, vec![5, 5, 1]));
    let asked = json!({ "draft": { "texts": {} }, "kind": "sensor", "names": ["room motion", "bathroom motion"] });
    let forgotten = served.told("/api/forget", &asked);
    assert_eq!(wakers(&forgotten["texts"]), [4, 4, 0]);
    let said = forgotten["mentions"].as_array().unwrap();
    assert!(said.iter().filter(|mention| mention["goes"] == true).count() >= 3, "{said:?}");
    // Without the other uses of a deleted sensor, one button solves the problem.
    let home = fs::read_to_string(served.file("cameras", "home.json")).unwrap();
    let alone = home.replace(r#""name": "room motion""#, r#""name": "corner motion""#);
    let mends = served.told("/api/mends", &json!({ "texts": { "home.json": alone } }));
    assert_eq!(mends[0]["what"], "Remove the 2 wake-ups by deleted sensors", "{mends}");
    assert_eq!(wakers(&mends[0]["texts"]), [4, 4, 1]);
}

#[test]
fn repairs_problems_with_one_solution() {
    let served = Served::scenario("tigerplace");
    let mends = |draft: &Value| served.told("/api/mends", &json!({ "texts": draft }));
    assert_eq!(mends(&json!({})), json!([]));
    let mut home: Value = serde_json::from_str(&text(&served, "home.json")).unwrap();
    home["sensors"].as_array_mut().unwrap().drain(..8);
    let mut texts = json!({ "home.json": home.to_string() });
    assert_eq!(problems(&served, &texts), 8);
    let found = mends(&texts);
    assert_eq!(found[0]["what"], "Remove the 8 ids of deleted sensors");
    texts["logger.json"] = found[0]["texts"]["logger.json"].clone();
    assert_eq!(problems(&served, &texts), 0);
    assert_eq!(mends(&json!({ "home.json": "{" })), json!([]), "what is no JSON has no one answer");
}
