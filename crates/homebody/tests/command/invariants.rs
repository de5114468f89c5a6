//! Invariants of every run, whatever the options.

use crate::flat::flat;
use crate::folder::Folder;
use std::thread::sleep;
use std::time::Duration;

const OUT: [&str; 4] = ["log.db", "log.csv", "log.txt", "truth.db"];

/// The words that make a run write `OUT`, each under a prefix.
fn out(prefix: &str) -> String {
    let [db, csv, txt, truth] = OUT.map(|name| format!("{prefix}-{name}"));
    format!("--quiet --out sqlite:{db} --out csv:{csv} --out casas:{txt} --truth {truth}")
}

fn signs(folder: &Folder, prefix: &str) -> [String; 4] {
    OUT.map(|name| {
        let file = format!("{prefix}-{name}");
        if name == "truth.db" { folder.truth_sha256(&file) } else { folder.sha256(&file) }
    })
}

fn rows(folder: &Folder, prefix: &str) -> usize {
    folder.read(&format!("{prefix}-log.csv")).lines().count() - 1
}

#[test]
fn speed_changes_nothing() {
    let folder = flat();
    let speeds = ["0.5", "1", "5", "10", "50", "100", "1000", "max"];
    // A short span, and one that takes two seconds at the speed.
    let spans = |speed: &str| [2.0, speed.parse().map_or(2.0, |times: f64| times * 2.0)];
    let mut running = Vec::new();
    for speed in speeds {
        for (index, span) in spans(speed).into_iter().enumerate() {
            let words = |speed: &str, prefix: &str| format!("run flat --for {span}s --speed {speed} {}", out(prefix));
            folder.run(&words("max", &format!("{speed}-{index}-unpaced"))).ok();
            running.push(folder.start(&words(speed, &format!("{speed}-{index}"))));
        }
    }
    for running in running {
        running.finish().ok();
    }
    for speed in speeds {
        for index in 0..spans(speed).len() {
            let prefix = format!("{speed}-{index}");
            assert!(rows(&folder, &prefix) > 5, "{prefix}");
            assert_eq!(signs(&folder, &prefix), signs(&folder, &format!("{prefix}-unpaced")), "at speed {prefix}");
        }
        assert_eq!(signs(&folder, &format!("{speed}-0")), signs(&folder, "max-0"), "at speed {speed}");
    }
    // The signs tell runs apart.
    folder.run(&format!("run flat --for 2s --seed 8 {}", out("other-seed"))).ok();
    for (one, other) in signs(&folder, "other-seed").iter().zip(signs(&folder, "max-0")) {
        assert_ne!(*one, other);
    }
}

#[test]
fn what_a_watcher_says_changes_nothing() {
    let folder = flat();
    folder.run(&format!("run flat --for 60s {}", out("unwatched"))).ok();
    let words = |prefix: &str| format!("run flat --for 60s --speed 20 --control --paused {}", out(prefix));
    let input = "step 0.123456\nstep\nspeed 100\nstep 7.5\nnonsense\nspeed 0\nresume\npause\nspeed 1000\nresume\n";
    folder.say(&words("watched"), input).ok().says(&["there is no command \"nonsense\"", "from 0.1 to 1000"]);
    assert_eq!(signs(&folder, "watched"), signs(&folder, "unwatched"));

    // In the midst of a run, too.
    let mut running = folder.start(&words("interrupted").replace("--paused", ""));
    for say in ["pause\n", "step 0.7\n", "resume\n", "speed 5\npause\n", "speed max\nresume\n"] {
        sleep(Duration::from_millis(70));
        running.say(say);
    }
    running.finish().ok();
    assert_eq!(signs(&folder, "interrupted"), signs(&folder, "unwatched"));

    // The command does listen.
    folder.say(&words("stopped"), "step 20\nstop\n").ok();
    assert_ne!(signs(&folder, "stopped"), signs(&folder, "unwatched"));
}

#[test]
fn a_stopped_run_is_the_beginning_of_the_whole() {
    let folder = flat();
    folder.run(&format!("run flat --for 60s {}", out("whole"))).ok();
    let mut running = folder.start("run flat --for 60s --control --paused --out csv:part.csv --json");
    running.say(b"st\xff\n\nstep 20\n");
    sleep(Duration::from_millis(200));
    assert!(running.is_alive(), "a paused run waits");
    running.say("step 5\nstop\n");
    let done = running.finish().ok();
    assert!(
        done.err.starts_with("error[pace::command]: there is no command \"st\u{fffd}\""),
        "what is no text ends nothing: {}",
        done.err
    );
    let json = done.json();
    assert_eq!((json["stopped"].as_bool(), json["simulated_s"].as_f64()), (Some(true), Some(25.0)));
    let (whole, part) = (folder.read("whole-log.csv"), folder.read("part.csv"));
    assert!(whole.starts_with(&part));
    // All of it: the next row is later.
    let next = whole[part.len()..].lines().next().unwrap();
    assert!(next.split(',').nth(1).unwrap() >= "2009-03-02 08:00:25", "{next}");
    assert!(part.lines().last().unwrap().contains("08:00:2"), "{part}");
}

/// The rows of a log without their numbers, but for those of some sensors.
fn rows_without(folder: &Folder, log: &str, sensors: &[&str]) -> Vec<String> {
    let text = folder.read(log);
    let rows = text.lines().skip(1).map(|line| line.split_once(',').unwrap().1.to_string());
    rows.filter(|row| !sensors.iter().any(|sensor| row.contains(sensor))).collect()
}

#[test]
fn adding_a_sensor_changes_no_other() {
    let folder = flat();
    folder.run("run flat --quiet --out csv:before.csv").ok();
    let first = "\"sensors\": [";
    let new = r#"{ "name": "Extra", "kind": "motion", "at": [3.9, 0.1], "facing_deg": 135 },"#;
    folder.edit("flat/home.json", first, &format!("{first}\n    {new}"));
    folder.run("run flat --quiet --out csv:after.csv").ok();
    assert_eq!(rows_without(&folder, "after.csv", &["Extra"]), rows_without(&folder, "before.csv", &[]));
    assert!(folder.read("after.csv").contains("Extra"));
    folder.run("run flat --quiet --seed 8 --out csv:other.csv").ok();
    assert_ne!(rows_without(&folder, "other.csv", &["Extra"]), rows_without(&folder, "before.csv", &[]));
}

#[test]
fn adding_a_resident_changes_no_other() {
    let folder = flat();
    folder.run("run flat --quiet --out csv:before.csv --truth before.db").ok();
    folder.write("flat/cleo.json", r#"{ "name": "Cleo", "driver": { "path": "cleo.path.json" } }"#);
    let path =
        r#"{ "start": [9, 1.5], "steps": [{ "repeat": { "steps": [{ "go": { "to": [[10, 1], [9, 1.5]] } }] } }] }"#;
    folder.write("flat/cleo.path.json", path);
    folder.edit("flat/scenario.json", "\"ann.json\", ", "\"cleo.json\", \"ann.json\", ");
    folder.run("run flat --quiet --out csv:after.csv --truth after.db").ok();
    let others = rows_without(&folder, "after.csv", &["StudyFloor"]);
    assert!(others.len() > 100 && folder.read("after.csv").contains("StudyFloor"));
    assert_eq!(others, rows_without(&folder, "before.csv", &[]));
    let moved = "SELECT resident, begin_at, end_at, kind, from_x, from_y, to_x, to_y, amplitude_m, posture FROM movement \
                 WHERE resident <> 'Cleo' ORDER BY resident, begin_at";
    assert_eq!(folder.query("after.db", moved), folder.query("before.db", moved));
}

#[test]
fn truth_never_leaks() {
    let folder = flat();
    folder.run(&format!("run flat --recording recording.json {}", out("a"))).ok();
    // Words that only the ground truth has.
    let secrets = ["Ann", "Bob", "strolling", "stride", "standing"];
    let truth = folder.dump("a-truth.db");
    for secret in secrets {
        assert!(truth.contains(secret), "{secret}");
        for log in ["a-log.db", "a-log.csv", "a-log.txt"] {
            let bytes = std::fs::read(folder.path(log)).unwrap();
            let found = bytes.windows(secret.len()).any(|bytes| bytes == secret.as_bytes());
            assert!(!found, "{secret} is in {log}");
        }
    }
    let columns = "SELECT m.name || '.' || p.name FROM sqlite_schema m, pragma_table_info(m.name) p ORDER BY 1";
    let expected = "firing.fired_at firing.run_id firing.sensor firing.seq firing.value run.ended_at run.home run.run_id \
        run.scenario run.seed run.started_at run.version run.zone sensor.id sensor.kind sensor.name sensor.room \
        sensor.run_id sensor.unit";
    assert_eq!(folder.query("a-log.db", columns).join(" "), expected);
    // One file cannot be both, however it is named.
    for truth in ["b.db", "./flat/../b.db"] {
        folder.run(&format!("run flat --out sqlite:b.db --truth {truth} --force")).fails(2, "log::same-file");
    }
    assert!(!folder.files().contains(&"b.db".into()));
}
