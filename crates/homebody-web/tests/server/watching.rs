//! The effects of a page on a run.

use super::served::{LONGEST_WAIT, Page, Seen, Served};
use homebody_core::event::Events;
use homebody_core::recording::{Recording, RunDigest};
use homebody_core::run::Run;
use homebody_core::time::{HOUR, RunTime};
use rusqlite::Connection;
use serde_json::{Value, json};
use std::path::Path;
use std::time::{Duration, Instant};
use std::{fs, thread};

/// The rows of a run's log: time, sensor, message.
fn rows(run: &Path) -> Vec<Value> {
    let log = Connection::open(run.join("log.db")).unwrap();
    let mut rows = log.prepare("SELECT fired_at, sensor, value FROM firing ORDER BY seq").unwrap();
    let rows = rows
        .query_map([], |row| Ok(json!([row.get::<_, String>(0)?, row.get::<_, String>(1)?, row.get::<_, String>(2)?])));
    rows.unwrap().map(Result::unwrap).collect()
}

fn recording(run: &Path) -> Recording {
    serde_json::from_str(&fs::read_to_string(run.join("recording.json")).unwrap()).unwrap()
}

/// A page with a running run and its first resident under manual control.
fn driven(served: &Served) -> Page {
    let mut page = served.page();
    page.say(r#"{"say":"start","driven":0}"#);
    page.say(r#"{"say":"play"}"#);
    page
}

fn is(state: &'static str) -> impl Fn(&Value) -> bool {
    move |frame| frame["state"] == state
}

/// The places of a resident while keys are held, at real time.
fn drive(page: &mut Page, ways: &[(&[&str], f64)]) -> Seen {
    page.say(r#"{"say":"start","driven":0}"#);
    page.say(r#"{"say":"play"}"#);
    for (keys, s) in ways {
        page.say(&json!({ "say": "hold", "keys": keys }).to_string());
        thread::sleep(Duration::from_secs_f64(*s));
    }
    page.say(r#"{"say":"hold","keys":[]}"#);
    thread::sleep(Duration::from_secs_f64(0.5));
    page.say(r#"{"say":"stop"}"#);
    page.until(is("over"))
}

#[test]
fn a_controlled_resident_fires_sensors_and_the_page_shows_the_rows_of_the_log() {
    let served = Served::scenario("by-hand");
    let mut page = served.page();
    let before = page.until(|frame| frame["told"] == 0);
    assert_eq!(before.run["residents"][0]["name"], "visitor");
    let seen = drive(&mut page, &[(&["right"], 2.0), (&["up", "right"], 2.5)]);
    assert!(seen.notes.iter().any(|note| note.contains("rows in")), "{:?}", seen.notes);
    let run = served.only_run();
    let stored = rows(&run);
    assert!(stored.len() >= 2, "{stored:?}");
    assert_eq!(seen.rows, stored);
    // The replay of its recording is the same.
    let recording = recording(&run);
    assert!(recording.files["visitor.keys.json"].contains("\"held\": ["), "{:?}", recording.files.keys());
    let scenario = recording.scenario().unwrap();
    let mut run = recording.run(&scenario, &());
    let (mut events, mut digest) = (Events::default(), RunDigest::default());
    run.advance(RunTime::START + recording.length_us, &mut events).unwrap();
    digest.add(&events.firings);
    assert_eq!((digest.firings(), digest.hex()), (recording.firings, recording.sha256));
}

#[test]
fn replays_recordings_to_the_same_firings() {
    let served = Served::scenario("by-hand");
    let mut page = served.page();
    let first = drive(&mut page, &[(&["right", "fast"], 2.0), (&["up"], 1.0)]);
    let id = served.only_run().file_name().unwrap().to_str().unwrap().to_owned();
    page.say(r#"{"say":"speed","times":null}"#);
    page.say(&json!({ "say": "replay", "run": id }).to_string());
    assert_eq!(page.until_told("matches the recording").rows, first.rows);
    page.say(r#"{"say":"replay","run":"../by-hand"}"#);
    page.until_told("There is no run");
}

/// However many pages watch, and at any speed, the log is that of a run without pages.
#[test]
fn watching_pages_change_nothing() {
    let opened = homebody_simulation::template("tigerplace").unwrap();
    let (scenario, household) = (opened.scenario(), opened.household());
    for (speeds, hours) in [(&["null"][..], 30.0), (&["1000", "0.1", "300"], 9.0)] {
        let mut served = Served::scenario("tigerplace");
        let mut page = served.page();
        let mut idle = served.page();
        // The resident sleeps for the first hours.
        for (turn, speed) in speeds.iter().enumerate() {
            page.say(&format!(r#"{{"say":"speed","times":{speed}}}"#));
            page.say(r#"{"say":"play"}"#);
            let to = (hours * 3600.0 * (turn + 1) as f64 / speeds.len() as f64 * 1e6) as i64;
            if speeds.len() > 1 {
                thread::sleep(Duration::from_millis(300));
                page.say(&json!({ "say": "jump", "to_us": to }).to_string());
            }
            page.until(|frame| frame["now_us"].as_i64() >= Some(to));
        }
        page.say(r#"{"say":"stop"}"#);
        page.until(is("over"));
        idle.until(is("over"));
        served.close();
        let recording = recording(&served.only_run());
        let mut alone =
            Run::new(scenario, household, recording.seed, scenario.calendar.span_of_days(scenario.file.days));
        let (mut events, mut digest) = (Events::default(), RunDigest::default());
        let end = RunTime::START + recording.length_us;
        while alone.now() < end {
            alone.advance(end.min(alone.now() + HOUR), &mut events).unwrap();
            digest.add(&events.firings);
            events.clear();
        }
        assert!(recording.firings > 0);
        assert_eq!((digest.firings(), digest.hex()), (recording.firings, recording.sha256), "{speeds:?}");
    }
}

/// The keys of a page that closes are released, so that the resident stops.
#[test]
fn closing_a_page_releases_its_keys() {
    let served = Served::scenario("by-hand");
    let mut page = served.page();
    let mut other = served.page();
    page.say(r#"{"say":"start","driven":0}"#);
    page.say(r#"{"say":"play"}"#);
    page.say(r#"{"say":"hold","keys":["right"]}"#);
    thread::sleep(Duration::from_millis(500));
    drop(page);
    thread::sleep(Duration::from_millis(500));
    let place = |seen: Seen| seen.frame["bodies"][0]["at"].clone();
    let at = |us: i64| move |frame: &Value| frame["now_us"].as_i64() > Some(us);
    let first = place(other.until(at(1_500_000)));
    let later = place(other.until(at(2_500_000)));
    assert_eq!(first, later);
    assert!(first[0].as_f64() > Some(0.7), "nobody walked: {first}");
}

/// Doors that are open in the home are open at the start.
#[test]
fn the_page_shows_open_things_as_open() {
    let served = Served::scenario("tigerplace");
    let seen = served.page().until(|_| true);
    let home = &seen.run["home"];
    let things = home["things"].as_array().unwrap();
    let is_open = |door: &&Value| door["open"] == true && door["outside"] == false;
    let open = home["doors"].as_array().unwrap().iter().filter(is_open);
    let wanted: Vec<usize> =
        open.map(|door| things.iter().position(|thing| thing["name"] == door["name"]).unwrap()).collect();
    assert!(!wanted.is_empty());
    assert_eq!(seen.frame["on"], json!(wanted));
}

/// A jump back into a step under manual control takes no other step.
#[test]
fn releases_keys_on_a_jump_back() {
    let served = Served::scenario("by-hand");
    let mut page = driven(&served);
    page.say(r#"{"say":"hold","keys":["right"]}"#);
    page.until(|frame| frame["now_us"].as_i64() > Some(1_000_000));
    page.say(r#"{"say":"hold","keys":[]}"#);
    // Paused, so that the page gets the frame after the jump.
    page.say(r#"{"say":"pause"}"#);
    page.say(r#"{"say":"jump","to_us":500000}"#);
    let place = |seen: Seen| seen.frame["bodies"][0]["at"][0].as_f64().unwrap();
    let back = place(page.until(|frame| frame["now_us"] == 500_000));
    page.say(r#"{"say":"play"}"#);
    let later = place(page.until(|frame| frame["now_us"].as_i64() > Some(2_000_000)));
    assert!(back > 0.7 && later - back < 0.2, "from {back} to {later}");
}

/// A jump back simulates the run again with the same input.
#[test]
fn repeats_the_same_run_after_a_jump_back() {
    let served = Served::scenario("tigerplace");
    let mut page = served.page();
    page.say(r#"{"say":"jump","to_us":36000000000}"#);
    let there = page.until(|frame| frame["now_us"] == 36_000_000_000_i64).frame;
    page.say(r#"{"say":"jump","to_us":28800000000}"#);
    let back = page.until(|frame| frame["now_us"] == 28_800_000_000_i64).frame;
    assert!(back["told"].as_u64() < there["told"].as_u64());
    // Files that are saved meanwhile apply to the next run.
    let file = served.file("tigerplace", "scenario.json");
    let text = fs::read_to_string(&file).unwrap();
    fs::write(&file, text.replace("\"seed\": ", "\"seed\": 1")).unwrap();
    page.say(r#"{"say":"jump","to_us":25200000000}"#);
    page.until(|frame| frame["now_us"] == 25_200_000_000_i64);
    page.say(r#"{"say":"jump","to_us":36000000000}"#);
    let again = page.until(|frame| frame["now_us"] == 36_000_000_000_i64).frame;
    assert_eq!((&again["told"], &again["bodies"]), (&there["told"], &there["bodies"]));
}

/// The input survives the program: the recording has it while the run continues.
#[test]
fn acts_by_keys_are_soon_on_disk() {
    let served = Served::scenario("by-hand");
    let mut page = driven(&served);
    page.until(|frame| frame["now_us"].as_i64() > Some(100_000));
    for (number, key) in ["right", "up", "left"].into_iter().enumerate() {
        page.say(&format!(r#"{{"say":"hold","keys":["{key}"]}}"#));
        // Less than a second on an idle machine.
        let pressed = Instant::now();
        loop {
            let recording = recording(&served.only_run());
            let keys = &recording.files["visitor.keys.json"];
            assert!(!recording.is_complete(), "the run goes on");
            if keys.contains(&format!("\"{key}\"")) {
                assert_eq!(keys.matches("\"held\": [").count(), number + 1, "{keys}");
                break;
            }
            assert!(pressed.elapsed() < LONGEST_WAIT, "{key} is not on disk: {keys}");
            thread::sleep(Duration::from_millis(50));
        }
    }
    // With the resulting rows, and a complete recording at the end.
    page.say(r#"{"say":"stop"}"#);
    let seen = page.until(is("over"));
    let recording = recording(&served.only_run());
    assert!(recording.is_complete());
    assert_eq!(rows(&served.only_run()).len() as u64, recording.firings);
    assert_eq!(seen.frame["told"].as_u64(), Some(recording.firings));
}

/// A run that fails, here because of a damaged log, is reported to present and later pages, and another run starts on the same
/// socket.
#[test]
fn reports_a_failed_run_and_starts_another() {
    let served = Served::scenario("tigerplace");
    let mut page = served.page();
    page.say(r#"{"say":"play"}"#);
    page.until(|frame| frame["now_us"].as_i64() > Some(0));
    let log = served.only_run().join("log.db");
    let other = Connection::open(&log).unwrap();
    other.busy_timeout(Duration::from_secs(5)).unwrap();
    other.execute_batch("BEGIN IMMEDIATE").unwrap();
    page.say(r#"{"say":"speed","times":null}"#);
    let seen = page.until(is("over"));
    assert!(seen.frame["now_us"].as_i64() < seen.run["length_us"].as_i64().or(Some(i64::MAX)));
    let why = seen.notes.iter().find(|note| note.contains("log.db")).expect("words").clone();
    let late = served.page().until_told("log.db");
    assert_eq!(late.notes, [why]);
    drop(other);
    page.say(r#"{"say":"start","driven":null}"#);
    page.say(r#"{"say":"play"}"#);
    page.until(|frame| frame["state"] == "playing" && frame["now_us"].as_i64() > Some(3_600_000_000));
}
