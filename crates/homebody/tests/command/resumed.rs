//! Runs that are killed or stopped are gone on with, and end with the bytes of a run that nothing has disturbed.

use crate::flat::flat;
use crate::folder::Folder;
use rusqlite::Connection;
use std::fs;
use std::thread;
use std::time::{Duration, Instant};

/// How often each kind of log is killed; `HOMEBODY_KILLS` says otherwise.
const KILLS: u64 = 5;

/// What a run leaves in its folder for one kind of log.
const KINDS: [(&str, &str); 3] = [("sqlite", "log.db"), ("csv", "log.csv"), ("casas", "log.txt")];

const SPAN: &str = "3d";

/// A scenario whose log goes to one place, and how long a run of it takes that nothing disturbs: it is `runs/flat-1`.
fn undisturbed(scheme: &str, log: &str) -> (Folder, Duration) {
    let folder = flat();
    let mut logger: serde_json::Value = serde_json::from_str(&folder.read("flat/logger.json")).unwrap();
    logger["to"] = serde_json::json!([format!("{scheme}:{log}")]);
    folder.write("flat/logger.json", logger.to_string());
    let begun = Instant::now();
    folder.run(&format!("run flat --for {SPAN} --quiet")).ok();
    (folder, begun.elapsed())
}

/// What is in a run's folder, file by file.
fn left(folder: &Folder, run: &str) -> Vec<(String, Vec<u8>)> {
    let begins = format!("runs/{run}/");
    let names = folder.files().into_iter().filter_map(|name| name.strip_prefix(&begins).map(str::to_owned));
    names.map(|name| (name.clone(), fs::read(folder.path(&(begins.clone() + &name))).unwrap())).collect()
}

fn differ(folder: &Folder, run: &str, whole: &[(String, Vec<u8>)]) -> Vec<String> {
    let found = left(folder, run);
    let names: Vec<&String> = found.iter().map(|(name, _)| name).collect();
    assert_eq!(names, whole.iter().map(|(name, _)| name).collect::<Vec<_>>());
    found.iter().zip(whole).filter(|(one, other)| one != other).map(|(one, _)| one.0.clone()).collect()
}

/// Kills a run so long after its recording stands; whether it was on its way.
fn killed(folder: &Folder, after: Duration) -> bool {
    let running = folder.start(&format!("run flat --for {SPAN} --quiet"));
    folder.until("the run is begun", |folder| folder.path("runs/flat-2/recording.json").exists());
    thread::sleep(after);
    running.kill();
    folder.read("runs/flat-2/recording.json").contains("\"sha256\": \"\"")
}

#[test]
fn whatever_kills_a_run_it_is_gone_on_with_to_the_same_bytes() {
    let kills = std::env::var("HOMEBODY_KILLS").ok().and_then(|kills| kills.parse().ok()).unwrap_or(KILLS);
    for (scheme, log) in KINDS {
        let (folder, took) = undisturbed(scheme, log);
        let whole = left(&folder, "flat-1");
        for kill in 0..kills {
            // Anywhere from before the first row on. On a machine that has become faster meanwhile the run may be over.
            let mut after = took.mul_f64((kill * 7919 % 1000) as f64 / 1000.0);
            while !killed(&folder, after) {
                fs::remove_dir_all(folder.path("runs/flat-2")).unwrap();
                after /= 2;
            }
            folder.run("run --resume runs/flat-2 --quiet").ok();
            assert_eq!(
                differ(&folder, "flat-2", &whole),
                Vec::<String>::new(),
                "{scheme}, kill {kill} after {after:?}"
            );
            fs::remove_dir_all(folder.path("runs/flat-2")).unwrap();
        }
        println!("{scheme}: {kills} were gone on with");
    }
}

#[test]
fn a_run_that_was_stopped_is_gone_on_with() {
    for (scheme, log) in KINDS {
        let (folder, _) = undisturbed(scheme, log);
        let whole = left(&folder, "flat-1");
        let mut running = folder.start(&format!("run flat --for {SPAN} --quiet --control --paused"));
        running.say("step 20000\nstop\n");
        running.finish().ok();
        assert!(!differ(&folder, "flat-2", &whole).is_empty());
        folder.run("run --resume runs/flat-2 --quiet").ok();
        assert_eq!(differ(&folder, "flat-2", &whole), Vec::<String>::new(), "{scheme}");
        folder.run("run --resume runs/flat-2").fails(2, "is complete: there is nothing to go on with");
    }
}

/// The negative control: where what is there was changed, it is not passed off as the run.
#[test]
fn what_was_changed_is_not_gone_on_with() {
    let (folder, _) = undisturbed("sqlite", "log.db");
    let stopped = |folder: &Folder| {
        let _ = fs::remove_dir_all(folder.path("runs/flat-2"));
        let mut running = folder.start(&format!("run flat --for {SPAN} --quiet --control --paused"));
        running.say("step 20000\nstop\n");
        running.finish().ok();
    };
    let change = |sql: &str| {
        let database = Connection::open(folder.path("runs/flat-2/log.db")).unwrap();
        assert_eq!(database.execute(sql, []).unwrap(), 1, "{sql}");
    };
    for (sql, said) in [
        ("UPDATE firing SET sensor = 'another' WHERE seq = 7", "row 7 of \"firing\" is another"),
        ("UPDATE run SET run_id = 7", "it holds another run"),
    ] {
        stopped(&folder);
        change(sql);
        folder.run("run --resume runs/flat-2").fails(1, said);
    }
    stopped(&folder);
    let recording = folder.read("runs/flat-2/recording.json");
    folder.write("runs/flat-2/recording.json", recording.replace("\"version\": \"", "\"version\": \"9."));
    folder.run("run --resume runs/flat-2").fails(2, "was begun by version 9.");
    folder.run("run --resume runs/flat-9").fails(1, "there is no such recording");
    folder.run("run flat --resume runs/flat-2").fails(2, "cannot be used with");
}

#[test]
fn labels_are_those_of_a_join_by_hand() {
    for messages in [r#"{ "on_off": { "hold_s": 4 } }"#, r#""fire_only""#] {
        let folder = flat();
        let mut logger: serde_json::Value = serde_json::from_str(&folder.read("flat/logger.json")).unwrap();
        logger["messages"] = serde_json::from_str(messages).unwrap();
        folder.write("flat/logger.json", logger.to_string());
        folder.run("run flat --for 30m --quiet").ok();
        folder.run("label runs/flat-1 --to sqlite:labelled.db").ok();
        let labelled =
            folder.query("labelled.db", "SELECT seq, sensor, value, resident, cause FROM labelled ORDER BY seq");
        // By hand: an ON is of the first firing since the last OFF of its sensor, an OFF of the last firing before it.
        let rows = folder.query("runs/flat-1/log.db", "SELECT seq, fired_at, sensor, value FROM firing ORDER BY seq");
        let causes =
            folder.query("runs/flat-1/truth.db", "SELECT fired_at, sensor, resident, why FROM cause ORDER BY firing");
        let parts = |row: &String| row.split('|').map(str::to_owned).collect::<Vec<_>>();
        let causes: Vec<Vec<String>> = causes.iter().map(parts).collect();
        assert!(rows.len() > 100 && labelled.len() == rows.len());
        for (row, labelled) in rows.iter().map(parts).zip(labelled.iter().map(parts)) {
            let of_sensor = || causes.iter().filter(|cause| cause[1] == row[2]);
            let cause = match row[3].as_str() {
                "OFF" => of_sensor().rfind(|cause| cause[0] < row[1]),
                _ => of_sensor().find(|cause| cause[0] == row[1]),
            };
            let cause = cause.expect("each row has its cause");
            assert_eq!(labelled[3..], cause[2..], "{row:?}");
        }
    }
}
