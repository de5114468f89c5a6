//! A link between the sensors and the log, from its file to the rows.

use crate::flat::flat;
use crate::folder::Folder;
use serde_json::json;

/// Everything that can go wrong, within ten minutes from eight in the morning.
const LINK: &str = r#"{
  "preset": "x10",
  "delay_s": [0, 0.4],
  "loss": 0.05,
  "duplicates": 0.05,
  "corruption": 0.02,
  "misses": 0.05,
  "false_fires_per_h": 60,
  "radio": { "copies": 2, "frame_s": 0.02, "gap_s": 0.01 },
  "sensors": { "BedroomFloor": { "loss": 0.2 } },
  "faults": [
    { "kind": "outage", "at": "08:05", "hours": 0.02 },
    { "kind": "drift", "sensor": "BedroomFloor", "ppm": -800, "offset_s": -1.25 },
    { "kind": "moved", "sensor": "KitchenWall", "from_day": 0.003, "at": [3.9, 0.1], "facing_deg": 135 },
    { "kind": "stuck", "sensor": "StudyFloor", "from_day": 0.001, "every_s": 7 },
    { "kind": "battery", "sensor": "BedroomWall", "fading_days": 0.006 },
    { "kind": "falls_off", "sensor": "KitchenFloor", "from_day": 0.006 },
    { "kind": "false_fires", "sensor": "KitchenFloor", "per_h": 200, "between": ["08:02", "08:03"] }
  ]
}
"#;

/// The flat with this link.
fn linked(link: &str) -> Folder {
    let folder = flat();
    folder.edit("flat/scenario.json", "\"logger.json\",", "\"logger.json\", \"link\": \"link.json\",");
    folder.write("flat/link.json", link);
    folder
}

#[test]
fn while_the_logger_is_down_nothing_is_stored_and_the_truth_says_why() {
    let folder = linked(r#"{ "preset": "zigbee", "faults": [{ "kind": "outage", "at": "08:05", "hours": 0.05 }] }"#);
    folder.run("run flat --for 10m --quiet --out sqlite:log.db --truth truth.db").ok();
    let minutes = |name: &str, column: &str, table: &str| {
        folder.query(name, &format!("SELECT DISTINCT substr({column}, 15, 2) AS minute FROM {table} ORDER BY minute"))
    };
    let stored = minutes("log.db", "fired_at", "firing");
    assert_eq!(stored, ["00", "01", "02", "03", "04", "08", "09"]);
    let lost = minutes("truth.db", "sent_at", "lost WHERE loss = 'outage'");
    assert!(["05", "06", "07"].iter().all(|minute| lost.contains(&(*minute).into())), "{lost:?}");
    let reasons = folder.query("truth.db", "SELECT DISTINCT loss FROM lost ORDER BY loss");
    assert_eq!(reasons, ["miss", "outage", "radio"]);
}

#[test]
fn causes_are_those_of_the_rows() {
    let folder = linked(LINK);
    folder.run("run flat --for 10m --quiet --out sqlite:log.db --truth truth.db").ok();
    let rows = folder.query("log.db", "SELECT seq, fired_at, sensor FROM firing ORDER BY seq");
    let causes = folder.query("truth.db", "SELECT firing, fired_at, sensor FROM cause ORDER BY firing");
    assert!(rows.len() > 300);
    assert_eq!(rows, causes);
    let times = folder.query("log.db", "SELECT fired_at FROM firing ORDER BY seq");
    assert!(times.is_sorted());
    // Whatever is nobody's doing has nobody.
    let whose = folder.query("truth.db", "SELECT DISTINCT why, resident IS NULL FROM cause ORDER BY why, 2");
    assert_eq!(whose, ["duplicate|0", "duplicate|1", "false|1", "movement|0"]);
    let reasons = folder.query("truth.db", "SELECT DISTINCT loss FROM lost ORDER BY loss");
    assert_eq!(reasons, ["battery", "collision", "garbled", "miss", "outage", "place", "radio"]);
}

#[test]
fn with_a_link_speed_changes_nothing_either() {
    let folder = linked(LINK);
    let messages = r#"{ "messages": { "on_off": { "hold_s": 0.3 } } }"#;
    folder.write("flat/logger.json", messages);
    let words = |prefix: &str| format!("run flat --for 10m --quiet --out csv:{prefix}.csv --truth {prefix}.db");
    folder.run(&words("max")).ok();
    folder.run(&format!("{} --speed 1000", words("paced"))).ok();
    let steps = "step 0.2\nstep 33.3\nstep 0.000001\nstep 280\nstep 1000\n";
    folder.say(&format!("{} --control --paused", words("stepped")), steps).ok();
    assert!(folder.read("max.csv").lines().count() > 600);
    for prefix in ["paced", "stepped"] {
        assert_eq!(folder.sha256(&format!("{prefix}.csv")), folder.sha256("max.csv"), "{prefix}");
        assert_eq!(folder.truth_sha256(&format!("{prefix}.db")), folder.truth_sha256("max.db"), "{prefix}");
    }
}

#[test]
fn a_recording_holds_the_link() {
    let folder = linked(LINK);
    folder.run("run flat --for 10m --quiet --out csv:log.csv --truth truth.db --record whole.json").ok();
    let words = "run flat --control --paused --quiet --out csv:part.csv --record part.json";
    folder.say(words, "step 333.3\nstop\n").ok();
    std::fs::remove_dir_all(folder.path("flat")).unwrap();
    for (recording, log) in [("whole.json", "log.csv"), ("part.json", "part.csv")] {
        let json = folder.run(&format!("replay {recording} --json --force --out csv:again.csv --truth again.db")).ok();
        assert_eq!(json.json()["agrees_with_recording"], json!(true), "{recording}");
        assert_eq!(folder.sha256("again.csv"), folder.sha256(log), "{recording}");
    }
}

#[test]
fn a_sensor_that_is_moved_stays_one_sensor() {
    let folder = linked(LINK);
    let json = folder.run("run flat --for 10m --json --out csv:log.csv").ok().json();
    let names: Vec<_> = json["rows_by_sensor"].as_object().unwrap().keys().cloned().collect();
    assert_eq!(names, ["KitchenWall", "KitchenFloor", "BedroomWall", "BedroomFloor", "StudyFloor"]);
    let log = folder.read("log.csv");
    let late = log.lines().filter(|line| line.contains("KitchenWall") && line.contains(" 08:04:")).count();
    assert!(late > 3, "{late} firings from its new place");
}

#[test]
fn a_wrong_link_is_refused() {
    let folder = linked(&LINK.replace("StudyFloor", "StudyFlor"));
    let done = folder.run("check flat");
    assert!(done.err.contains("hint: did you mean \"StudyFloor\"?"), "{}", done.err);
    done.fails(2, "link.json:15:34: the home has no sensor \"StudyFlor\"");
}
