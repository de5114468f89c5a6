//! A link between the sensors and the log, from its file to the rows.

use crate::flat::flat;
use crate::folder::{Folder, says};
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
    // A row without a resident has an empty label.
    let whose = folder.query("truth.db", "SELECT DISTINCT why, resident IS NULL FROM cause ORDER BY why, 2");
    assert_eq!(whose, ["duplicate|0", "duplicate|1", "false|1", "movement|0"]);
    let reasons = folder.query("truth.db", "SELECT DISTINCT loss FROM lost ORDER BY loss");
    assert_eq!(reasons, ["battery", "collision", "garbled", "miss", "outage", "place", "radio"]);
}

#[test]
fn speed_changes_nothing_with_a_link() {
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
    folder.run("run flat --for 10m --quiet --out csv:log.csv --truth truth.db --recording whole.json").ok();
    let words = "run flat --control --paused --quiet --out csv:part.csv --recording part.json";
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
    done.fails(2, "link.json:15:34: error[sensor::unknown]");
}

#[test]
fn faults_that_come_when_the_run_is_over_are_warned_of() {
    let link = r#"{ "faults": [
  { "kind": "outage", "at": "08:05", "hours": 1 },
  { "kind": "outage", "at": "07:00", "hours": 1 },
  { "kind": "battery", "sensor": "BedroomWall", "from_day": 0.01 },
  { "kind": "stuck", "sensor": "KitchenWall", "from_day": 0.009 }
] }"#;
    let folder = linked(link);
    let said = folder.run("check flat").ok().err;
    // The run is of 0.01 days from eight o'clock.
    says(
        &said,
        &[
            "warning[link::fault-after-end]: link.json:3:3: ",
            "warning[link::fault-after-end]: link.json:4:3: ",
            "no problems",
        ],
    );
    assert_eq!(said.matches("warning").count(), 2, "{said}");
    let json = folder.run("check flat --json").ok().json();
    assert_eq!(json["problems"], json!([]));
    let codes: Vec<_> = json["warnings"].as_array().unwrap().iter().map(|warning| warning["code"].clone()).collect();
    assert_eq!(codes, ["link::fault-after-end"; 2]);
    // Routines have nothing to do with radios.
    let routines = folder.run("routine check flat --json").ok();
    assert_eq!((routines.json()["warnings"].clone(), routines.err.matches("warning").count()), (json!([]), 0));
    // The options count, not the file.
    assert_eq!(folder.run("run flat --for 2d --out csv:a.csv").ok().err.matches("warning").count(), 0);
    assert_eq!(folder.run("run flat --for 1m --out csv:b.csv").ok().err.matches("warning").count(), 4);
    let quiet = folder.run("run flat --for 1m --out csv:c.csv --quiet").ok();
    assert_eq!((quiet.err.matches("warning").count(), quiet.out.as_str()), (4, ""), "quiet hides no warning");
}

#[test]
fn sensors_that_always_speak_at_once_on_one_channel_are_warned_of() {
    let folder = linked(r#"{ "preset": "x10" }"#);
    let pads = |pads: &str| {
        let folder = linked(r#"{ "preset": "x10" }"#);
        let furniture = r#""furniture": [
    { "name": "bed", "at": [5, 0.2], "size_m": [2, 0.9], "height_m": 0.5, "enterable": true }
  ],
  "sensors": ["#;
        folder.edit("flat/home.json", "\"sensors\": [", &format!("{furniture}{pads},"));
        folder
    };
    assert!(!folder.run("check flat").ok().err.contains("warning"));
    let two = r#"{ "kind": "bed", "name": "left", "on": "bed" }, { "kind": "bed", "name": "right", "on": "bed" }"#;
    let said = pads(two).run("check flat").ok().err;
    let warning = "warning[link::simultaneous-messages]: link.json:1:13: ";
    assert!(said.contains(warning), "{said}");
    // A waiting pad sends at instants of its own, and so does a sensor without a channel.
    let later = r#"{ "kind": "bed", "name": "left", "on": "bed" },
    { "kind": "pressure", "name": "pad", "on": "bed", "delay_s": 2 }"#;
    assert!(!pads(later).run("check flat").ok().err.contains("warning"));
    let folder = pads(two);
    folder.write("flat/link.json", r#"{ "preset": "zigbee" }"#);
    assert!(!folder.run("check flat").ok().err.contains("warning"));
}

#[test]
fn an_id_of_a_sensor_that_is_not_there_is_refused() {
    let folder = flat();
    folder.write("flat/logger.json", r#"{ "ids": { "KitchenWal": "A1" } }"#);
    let said = "logger.json:1:12: error[sensor::unknown]";
    assert!(folder.run("check flat").fails(2, said).err.contains("did you mean \"KitchenWall\"?"));
}
