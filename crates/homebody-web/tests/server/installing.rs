//! The view for installers, and compressed responses.

use super::served::{Answer, Served};
use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::{Value, json};

/// A draft that changes nothing.
fn as_it_is() -> Value {
    json!({ "texts": {} })
}

/// The parts of two layouts that these tests check.
#[derive(Deserialize)]
struct Layouts {
    layouts: Vec<Layout>,
    differences: Vec<Differs>,
}

#[derive(Deserialize)]
struct Layout {
    home: Home,
    coverage: Coverage,
}

#[derive(Deserialize)]
struct Home {
    sensors: Vec<IgnoredAny>,
}

#[derive(Deserialize)]
struct Coverage {
    whole: Floor,
}

#[derive(Deserialize)]
struct Floor {
    seen_by: [f64; 4],
}

#[derive(Deserialize)]
struct Differs {
    sensor: String,
}

fn besides(served: &Served, asked: &Value) -> Layouts {
    rmp_serde::from_slice(&served.post("/api/beside", asked).body).unwrap()
}

fn home(served: &Served) -> Value {
    serde_json::from_str(&std::fs::read_to_string(served.file("studio", "home.json")).unwrap()).unwrap()
}

#[test]
fn makes_install_sheets_of_drafts() {
    let served = Served::scenario("studio");
    let parts = served.told("/api/parts", &as_it_is());
    let listed = parts["parts"].as_array().unwrap();
    assert_eq!(listed.len(), home(&served)["sensors"].as_array().unwrap().len());
    let of_wall = listed.iter().find(|part| part["kind"] == "motion").expect("a sensor on a wall");
    assert!(of_wall["place"].as_str().unwrap().contains("wall"), "{of_wall}");
    assert!(of_wall["aim"].as_str().unwrap().contains("m high, looks "), "{of_wall}");
    assert_eq!(parts["csv"].as_str().unwrap().lines().count(), listed.len() + 1);

    let sheet = served.post("/api/sheet", &as_it_is());
    assert!(sheet.code == 200 && sheet.body.starts_with(b"%PDF-") && sheet.head.contains("application/pdf"));
    // The sheet is that of the draft; a draft with problems has none.
    let wrong = json!({ "texts": { "home.json": "{" } });
    assert_eq!(served.post("/api/sheet", &wrong).code, 422);
    assert_eq!(served.told("/api/parts", &wrong)["problems"].as_array().unwrap().len(), 1);
}

#[test]
fn compares_two_layouts() {
    let served = Served::scenario("studio");
    let mut fewer = home(&served);
    let gone = fewer["sensors"].as_array_mut().unwrap().remove(0);
    let fewer_by = gone["name"].as_str().unwrap().to_owned();
    let fewer = json!({ "texts": { "home.json": fewer.to_string() } });
    let asked = json!({ "one": { "name": "a", "draft": as_it_is() }, "other": { "name": "b", "draft": fewer } });
    let told = besides(&served, &asked);
    let sensors = |layout: usize| told.layouts[layout].home.sensors.len();
    assert_eq!(sensors(0), sensors(1) + 1);
    let gone: Vec<&str> = told.differences.iter().map(|differs| &*differs.sensor).collect();
    assert_eq!(gone, [fewer_by.as_str()]);
    let unseen = |layout: usize| told.layouts[layout].coverage.whole.seen_by[0];
    assert!(unseen(0) <= unseen(1), "fewer sensors see no more");
    // The control: a layout compared with itself.
    let same = json!({ "one": { "name": "a", "draft": as_it_is() }, "other": { "name": "b", "draft": as_it_is() } });
    assert!(besides(&served, &same).differences.is_empty());
}

#[test]
fn suggests_places_for_a_number_of_sensors_and_a_device() {
    let served = Served::scenario("studio");
    let ask = |sensors: u16, to_see: &[&str], device: Option<&str>| {
        let asked = json!({ "draft": as_it_is(), "sensors": sensors, "to_see": to_see, "people": 4, "device": device });
        served.told("/api/suggest", &asked)
    };
    let told = ask(2, &["falls"], Some("fibaro"));
    let steps = told["steps"].as_array().unwrap();
    assert_eq!(steps.len(), 2, "{told}");
    assert!(steps[0]["score"].as_f64() <= steps[1]["score"].as_f64(), "two tell no less than one");
    let sensors: Vec<Value> = serde_json::from_str(told["sensors"].as_str().unwrap()).unwrap();
    let motion: Vec<&Value> = sensors.iter().filter(|sensor| sensor["kind"] == "motion").collect();
    assert!(!motion.is_empty() && motion.iter().all(|sensor| sensor["preset"] == "fibaro"), "{sensors:?}");
    assert!(motion.iter().all(|sensor| sensor["height_m"] == json!(2.4)), "{sensors:?}");

    // Once sensors see the whole floor, no further sensor is suggested.
    let many = ask(30, &["falls"], None);
    let scores: Vec<f64> = many["steps"].as_array().unwrap().iter().filter_map(|step| step["score"].as_f64()).collect();
    assert!((1..30).contains(&scores.len()), "{scores:?}");
    assert!(scores.windows(2).all(|two| two[0] < two[1]), "{scores:?}");

    // By simulated logs.
    let lived = ask(4, &["night-bathroom"], None);
    let last = lived["steps"].as_array().unwrap().last().unwrap();
    assert!(lived["refused"].is_null() && last["score"].as_f64() > Some(0.0), "{lived}");
    assert_eq!(last["reached"][0]["goal"], "bathroom_night");
    let unknown = ask(1, &["yesterday"], None);
    assert_eq!(
        (&unknown["refused"], &unknown["code"]),
        (&json!("Unknown goals: yesterday."), &json!("desk::unknown-goals"))
    );
    let unmade = ask(1, &["falls"], Some("abacus"));
    assert_eq!(unmade["code"], "desk::unknown-device");
}

#[test]
fn compresses_large_answers_without_loss() {
    let served = Served::scenario("tigerplace");
    let token = format!("x-homebody-token: {}\r\n", served.token);
    for path in ["/api/files", &script(&served)] {
        let plain = served.get(path, &token);
        let packed = served.get(path, &format!("{token}Accept-Encoding: gzip\r\n"));
        assert!(!plain.head.to_lowercase().contains("content-encoding"), "{path}: {}", plain.head);
        assert!(packed.head.to_lowercase().contains("content-encoding: gzip"), "{path}: {}", packed.head);
        let (plain, packed) = (whole(&plain), whole(&packed));
        assert!(packed.len() * 2 < plain.len(), "{path}: {} of {} bytes", packed.len(), plain.len());
        assert_eq!(unpacked(&packed), plain, "{path}");
    }
    // Short answers are sent uncompressed.
    let short = served.get("/api/growth", &format!("{token}Accept-Encoding: gzip\r\n"));
    assert!(!short.head.to_lowercase().contains("content-encoding"), "{}", short.head);
}

/// The largest script of the page, or the substitute page.
fn script(served: &Served) -> String {
    let page = String::from_utf8(whole(&served.get("/", ""))).unwrap();
    let named = page.split("src=\"").nth(1).and_then(|rest| rest.split('"').next());
    named.map_or("/".into(), |path| format!("/{}", path.trim_start_matches(['.', '/'])))
}

/// The body of an answer, joined from its chunks.
fn whole(answer: &Answer) -> Vec<u8> {
    if !answer.head.to_lowercase().contains("transfer-encoding: chunked") {
        return answer.body.clone();
    }
    let (mut rest, mut body) = (&answer.body[..], Vec::new());
    loop {
        let end = rest.windows(2).position(|bytes| bytes == b"\r\n").expect("the length of a chunk");
        let length = usize::from_str_radix(std::str::from_utf8(&rest[..end]).unwrap().trim(), 16).unwrap();
        if length == 0 {
            return body;
        }
        body.extend_from_slice(&rest[end + 2..end + 2 + length]);
        rest = &rest[end + 4 + length..];
    }
}

/// Unpacks gzip without a name or other extras in its head.
fn unpacked(gzip: &[u8]) -> Vec<u8> {
    const HEAD: usize = 10;
    assert_eq!(gzip[..4], [0x1f, 0x8b, 8, 0], "a head without extras");
    miniz_oxide::inflate::decompress_to_vec(&gzip[HEAD..gzip.len() - 8]).unwrap()
}
