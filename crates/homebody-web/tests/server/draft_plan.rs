//! The plan in the page's editor, with its coverage and its problems.

use super::drafts::draft;
use super::served::Served;
use serde::Deserialize;
use serde_json::{Value, json};
use std::fs;

/// The parts of a plan that these tests check.
#[derive(Deserialize)]
struct Plan {
    problems: Vec<Value>,
    home: Value,
    coverage: Option<Coverage>,
}

#[derive(Deserialize)]
struct Coverage {
    columns: usize,
    #[serde(with = "serde_bytes")]
    cells: Vec<u8>,
    whole: Floor,
}

#[derive(Deserialize)]
struct Floor {
    seen_by: [f64; 4],
}

impl Served {
    fn plan(&self, draft: &Value) -> Plan {
        rmp_serde::from_slice(&self.post("/api/plan", draft).body).unwrap()
    }
}

#[test]
fn computes_the_coverage_of_drafts() {
    let served = Served::scenario("studio");
    let text = fs::read_to_string(served.file("studio", "home.json")).unwrap();
    let mut home: Value = serde_json::from_str(&text).unwrap();
    // One sensor alone, that reaches less far the second time.
    let sensors = home["sensors"].as_array().unwrap().clone();
    let one = sensors.iter().find(|sensor| sensor["kind"] == "motion").unwrap().clone();
    let mut short = one.clone();
    short["reach_m"] = json!(1.0);
    let mut seen = |sensor: &Value| {
        home["sensors"] = json!([sensor]);
        served.plan(&draft("home.json", &home.to_string()))
    };
    let (wide, narrow) = (seen(&one), seen(&short));
    let covered = narrow.coverage.unwrap();
    let none = covered.whole.seen_by[0];
    assert!(wide.coverage.unwrap().whole.seen_by[0] < none);
    // The figures are those of the cells.
    let count = |wanted: &dyn Fn(u8) -> bool| covered.cells.iter().filter(|&&cell| wanted(cell)).count() as f64;
    assert!((count(&|cell| cell == 0) / count(&|cell| cell < 255) - none).abs() < 1e-9);
    assert_eq!(covered.cells.len() % covered.columns, 0);
    assert_eq!(narrow.home["sensors"][0]["facing_deg"], one["facing_deg"].as_f64().unwrap());

    // Problems of other files do not count. A problem of this file is reported, without an invented picture.
    let told = served.plan(&json!({ "texts": { "walter.routine": "nonsense", "walter.json": "{" } }));
    assert!(told.problems.is_empty() && told.coverage.is_some());
    let told = served.plan(&draft("home.json", &text.replacen('{', "{ \"wals\": 1,", 1)));
    assert!(told.home.is_null() && told.coverage.is_none());
    assert_eq!(told.problems[0]["line"], 1);
}

#[test]
fn computes_coverage_despite_other_problems() {
    let served = Served::scenario("studio");
    let text = fs::read_to_string(served.file("studio", "home.json")).unwrap();
    let whole = served.plan(&draft("home.json", &text)).coverage.unwrap().whole.seen_by;
    let changed = |change: &dyn Fn(&mut Value)| {
        let mut home: Value = serde_json::from_str(&text).unwrap();
        change(&mut home);
        served.plan(&draft("home.json", &home.to_string()))
    };
    // Two pieces with one name, in the same place, and a place in the middle of a piece.
    let twice = changed(&|home| {
        let first = home["furniture"][0].clone();
        home["furniture"].as_array_mut().unwrap().push(first);
        home["places"] = json!([{ "name": "far away", "at": [900.0, 900.0] }]);
    });
    assert!(twice.problems.len() >= 2, "{:?}", twice.problems);
    assert_eq!(twice.coverage.unwrap().whole.seen_by, whole);
    // The control: a sensor outside.
    let outside = changed(&|home| {
        let sensors = home["sensors"].as_array_mut().unwrap();
        sensors.iter_mut().find(|sensor| sensor["kind"] == "motion").unwrap()["at"] = json!([900.0, 900.0]);
    });
    assert!(!outside.problems.is_empty() && outside.coverage.is_none());
}

#[test]
fn refuses_files_that_are_not_plans_and_takes_large_plans_whole() {
    let served = Served::scenario("studio");
    let (address, token) = (served.address, &served.token);
    let post = |body: &[u8]| {
        let head = format!(
            "POST /api/import HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\nx-homebody-token: {token}\r\n\
             Content-Type: application/octet-stream\r\nContent-Length: {}\r\n\r\n",
            body.len()
        );
        served.ask(&[head.as_bytes(), body].concat())
    };
    // Larger than texts may be, like plans with models and textures.
    for body in [&b"no archive"[..], &[0; 20 << 20]] {
        let answer = post(body);
        let told = answer.refusal();
        assert_eq!(answer.code, 422, "{told}");
        assert!(told["code"].as_str().unwrap().starts_with("import::"), "{told}");
        assert!(told["what"].as_str().unwrap().starts_with("This is not a Sweet Home 3D file"), "{told}");
    }
}
