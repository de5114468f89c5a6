//! Killed and stopped runs resume to the bytes of an undisturbed run.

use crate::flat::flat;
use crate::folder::Folder;
use rusqlite::Connection;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::thread;
use std::time::{Duration, Instant};

/// Number of kills of each kind of log, unless `HOMEBODY_KILLS` sets it.
const KILLS: u64 = 3;

/// The kinds of logs, each with its name in the folder of a run.
const KINDS: &[(&str, &str)] = &[
    ("sqlite", "log.db"),
    ("csv", "log.csv"),
    ("casas", "log.txt"),
    ("jsonl", "log.jsonl"),
    ("csv", "log.csv.gz"),
    #[cfg(feature = "parquet")]
    ("casas", "log.txt.zst"),
    #[cfg(feature = "parquet")]
    ("parquet", "log.parquet"),
    #[cfg(feature = "parquet")]
    ("parquet", "lives"),
    #[cfg(feature = "parquet")]
    ("arrow", "log.arrow"),
];

/// Until after midnight: a data set has files of two days.
const SPAN: &str = "3h";

/// A scenario whose log goes to one place, and how long a run of it takes that nothing disturbs: it is `runs/flat-1`.
fn undisturbed(scheme: &str, log: &str) -> (Folder, Duration) {
    let folder = flat();
    folder.edit("flat/scenario.json", "T08:00", "T22:00");
    folder.edit_json("flat/logger.json", |logger| logger["to"] = serde_json::json!([format!("{scheme}:{log}")]));
    let begun = Instant::now();
    folder.run(&format!("run flat --for {SPAN} --quiet")).ok();
    (folder, begun.elapsed())
}

/// The files in the folder of a run.
fn left(folder: &Folder, run: &str) -> Vec<(String, Vec<u8>)> {
    let begins = format!("runs/{run}/");
    let names = folder.files().into_iter().filter_map(|name| name.strip_prefix(&begins).map(str::to_owned));
    names.map(|name| (name.clone(), fs::read(folder.path(&(begins.clone() + name.as_str()))).unwrap())).collect()
}

fn differ(folder: &Folder, run: &str, whole: &[(String, Vec<u8>)]) -> Vec<String> {
    let found = left(folder, run);
    // A data set has a file for each day, so that files may be missing, too.
    let only = |some: &[(String, Vec<u8>)], others: &[(String, Vec<u8>)]| -> Vec<String> {
        some.iter().filter(|file| !others.contains(file)).map(|(name, _)| name.clone()).collect()
    };
    let mut differ = [only(&found, whole), only(whole, &found)].concat();
    differ.sort();
    differ.dedup();
    differ
}

/// Kills a run so long after its recording stands; whether it was on its way.
fn killed(folder: &Folder, after: Duration) -> bool {
    let running = folder.start(&format!("run flat --for {SPAN} --quiet"));
    folder.until("the run is begun", |folder| folder.path("runs/flat-2/recording.json").exists());
    thread::sleep(after);
    running.kill();
    folder.read("runs/flat-2/recording.json").contains("\"sha256\": \"\"")
}

/// Lives the same run anew in `runs/flat-2`, and stops it early.
fn stopped(folder: &Folder) {
    let _ = fs::remove_dir_all(folder.path("runs/flat-2"));
    let mut running = folder.start(&format!("run flat --for {SPAN} --quiet --control --paused"));
    running.say("step 4000\nstop\n");
    running.finish().ok();
}

/// Goes on with `runs/flat-2` to its end, where it has the bytes of the whole run.
fn goes_on_to(folder: &Folder, whole: &[(String, Vec<u8>)], what: &str) {
    folder.run("run --resume runs/flat-2 --quiet").ok();
    assert_eq!(differ(folder, "flat-2", whole), Vec::<String>::new(), "{what}");
}

/// Number of kills.
pub fn kills() -> u64 {
    std::env::var("HOMEBODY_KILLS").ok().and_then(|kills| kills.parse().ok()).unwrap_or(KILLS)
}

#[test]
fn whatever_kills_a_run_it_is_gone_on_with_to_the_same_bytes() {
    let kills = kills();
    for &(scheme, log) in KINDS {
        let (folder, took) = undisturbed(scheme, log);
        let whole = left(&folder, "flat-1");
        for kill in 0..kills {
            // Anywhere from before the first row on. On a machine that has become faster meanwhile the run may be over.
            let mut after = took.mul_f64((kill * 7919 % 1000) as f64 / 1000.0);
            while !killed(&folder, after) {
                fs::remove_dir_all(folder.path("runs/flat-2")).unwrap();
                after /= 2;
            }
            goes_on_to(&folder, &whole, &format!("{scheme}, kill {kill} after {after:?}"));
            fs::remove_dir_all(folder.path("runs/flat-2")).unwrap();
        }
        println!("{scheme}: {kills} were gone on with");
    }
}

/// A second stop at an earlier moment loses nothing, and the run writes again what is missing of it.
#[test]
fn a_stopped_run_resumes_to_the_same_bytes() {
    for &(scheme, log) in KINDS {
        let (folder, _) = undisturbed(scheme, log);
        let whole = left(&folder, "flat-1");
        stopped(&folder);
        let before = left(&folder, "flat-2");
        assert!(!differ(&folder, "flat-2", &whole).is_empty());
        let mut again = folder.start("run --resume runs/flat-2 --quiet --control --paused");
        again.say("step 1000\nstop\n");
        again.finish().fails(1, "log::not-yet");
        assert_eq!(differ(&folder, "flat-2", &before), Vec::<String>::new(), "{scheme}");
        goes_on_to(&folder, &whole, scheme);
        folder.run("run --resume runs/flat-2").fails(2, "kit::complete");
        for missing in [log, "truth.db", "sensors.csv"] {
            let path = folder.path(&format!("runs/flat-2/{missing}"));
            if path.is_dir() { fs::remove_dir_all(path) } else { fs::remove_file(path) }.unwrap();
            goes_on_to(&folder, &whole, &format!("{scheme} without {missing}"));
        }
        folder.run("run --resume runs/flat-2").fails(2, "kit::complete");
    }
}

/// Commands that read an incomplete run warn of it, and name the command that resumes it.
#[test]
fn a_run_that_has_not_come_to_its_end_is_told_as_such() {
    let (folder, _) = undisturbed("sqlite", "log.db");
    let warning = "warning[log-content::incomplete-run]: runs/flat-2";
    let reads = ["day runs/flat-2 first", "compare runs/flat-2 runs/flat-1", "density runs/flat-2"];
    stopped(&folder);
    for read in reads.into_iter().chain(["label runs/flat-2 --out csv:labelled.csv"]) {
        let said = folder.run(read).err;
        assert!(said.contains(warning), "{read}: {said}");
    }
    let _ = fs::remove_dir_all(folder.path("runs/flat-2"));
    folder.unfinish("runs/flat-1");
    folder.run("label runs/flat-1 --out csv:killed.csv").fails(1, "error[log-content::unequal-ends]");
    folder.run("run --resume runs/flat-1 --quiet").ok();
    for read in ["day runs/flat-1 first", "label runs/flat-1 --out csv:killed.csv"] {
        assert!(!folder.run(read).ok().err.contains("warning"), "{read}");
    }
}

#[test]
fn a_cohort_writes_again_what_is_missing_of_a_member() {
    let folder = flat();
    folder.run("run flat --for 1h --members 2 --quiet").ok();
    let whole = left(&folder, "flat-1");
    for missing in ["log.db", "truth.db"] {
        fs::remove_file(folder.path(&format!("runs/flat-1/0002/{missing}"))).unwrap();
        folder.run("run --resume runs/flat-1 --quiet").ok();
        assert_eq!(differ(&folder, "flat-1", &whole), Vec::<String>::new(), "{missing}");
    }
    folder.run("run --resume runs/flat-1").fails(2, "kit::complete");
}

/// Both kinds of cohorts, the listed one with texts that only its rows name.
#[test]
fn a_cohort_goes_on_with_the_members_that_are_missing() {
    let folder = Folder::with("tigerplace");
    folder.write("tigerplace/late.routine", "The person gets up at 09:00.\n");
    folder.write("tigerplace/conditions/low-mood.routine", "The person goes to bed 1 hour earlier.\n");
    let list = "name;routine;conditions;seed\nbea;late.routine;;\ncarl, or c;;low mood;7\ndora;;;\nemil;;;\n";
    folder.write("people.csv", list);
    for who in ["--members 4", "--profiles people.csv"] {
        let live = format!("run tigerplace {who} --for 2d --quiet");
        let begun = Instant::now();
        folder.run(&live).ok();
        let (whole, took) = (left(&folder, "tigerplace-1"), begun.elapsed());
        assert!(whole.len() > 4 * 4);
        folder.run("run --resume runs/tigerplace-1").fails(2, "kit::complete");
        // Half of the kills for each kind, evenly from before the first member on.
        let count = kills().div_ceil(2).max(4);
        let mut on_their_way = 0;
        for share in (0..count).map(|kill| kill as f64 / count as f64) {
            let running = folder.start(&live);
            folder.until("the cohort is begun", |folder| folder.path("runs/tigerplace-2/cohort.json").exists());
            thread::sleep(took.mul_f64(share));
            running.kill();
            let members = folder.json("runs/tigerplace-2/cohort.json");
            let is_over = !members["members"].as_array().unwrap().is_empty();
            // On a machine that has become faster meanwhile it may be over.
            if !is_over {
                on_their_way += 1;
                folder.run("run --resume runs/tigerplace-2 --quiet").ok();
            }
            assert_eq!(differ(&folder, "tigerplace-2", &whole), Vec::<String>::new(), "{who}, killed after {share}");
            fs::remove_dir_all(folder.path("runs/tigerplace-2")).unwrap();
        }
        assert!(on_their_way > 0, "some were killed on their way");
        // One who is lost is lived again; all others stay.
        let one = whole.iter().find_map(|(name, _)| name.strip_suffix("/recording.json")).unwrap();
        fs::remove_dir_all(folder.path(&format!("runs/tigerplace-1/{one}"))).unwrap();
        folder.run("run --resume runs/tigerplace-1 --quiet").ok();
        assert_eq!(differ(&folder, "tigerplace-1", &whole), Vec::<String>::new(), "{who}, without {one}");
        // Nor is one complete that was killed as it wrote its list.
        let list = folder.read("runs/tigerplace-1/cohort.json");
        let mut without: Value = serde_json::from_str(&list).unwrap();
        without["members"] = serde_json::json!([]);
        folder.write("runs/tigerplace-1/cohort.json", without.to_string());
        folder.run("run --resume runs/tigerplace-1 --speed 10").fails(2, "error[run::cohort-option]");
        folder.run("run --resume runs/tigerplace-1 --quiet").ok();
        assert_eq!(folder.read("runs/tigerplace-1/cohort.json"), list);
        // The control: a member of another cohort is not passed off as one of this.
        let recording = folder.read(&format!("runs/tigerplace-1/{one}/recording.json"));
        let mut other: Value = serde_json::from_str(&recording).unwrap();
        (other["run_id"], other["sha256"]) = (7.into(), "".into());
        folder.write(&format!("runs/tigerplace-1/{one}/recording.json"), other.to_string());
        folder.run("run --resume runs/tigerplace-1").fails(2, "it is of another cohort");
        fs::remove_dir_all(folder.path("runs/tigerplace-1")).unwrap();
    }
}

#[test]
fn one_program_at_a_time_lives_a_run() {
    let (folder, _) = undisturbed("csv", "log.csv");
    let whole = left(&folder, "flat-1");
    let mut running = folder.start(&format!("run flat --for {SPAN} --quiet --control --paused"));
    folder.until("the run is begun", |folder| folder.path("runs/flat-2/recording.json").exists());
    folder.run("run --resume runs/flat-2").fails(1, "log::busy");
    running.say("step 4000\nstop\n");
    running.finish().ok();
    goes_on_to(&folder, &whole, "of two programs");
}

/// The negative control: where what is there was changed, it is not passed off as the run.
#[test]
fn what_was_changed_is_not_gone_on_with() {
    let (folder, _) = undisturbed("sqlite", "log.db");
    let change = |sql: &str| {
        let database = Connection::open(folder.path("runs/flat-2/log.db")).unwrap();
        assert_eq!(database.execute(sql, []).unwrap(), 1, "{sql}");
    };
    for (sql, said) in [
        ("UPDATE firing SET sensor = 'another' WHERE seq = 7", "error[resume::other-row]: "),
        ("UPDATE run SET run_id = 7", "error[resume::other-run]"),
    ] {
        stopped(&folder);
        change(sql);
        folder.run("run --resume runs/flat-2").fails(1, said);
    }
    stopped(&folder);
    let recording = folder.read("runs/flat-2/recording.json");
    folder.write("runs/flat-2/recording.json", recording.replace("\"version\": \"", "\"version\": \"9."));
    folder.run("run --resume runs/flat-2").fails(2, "error[kit::other-version]: version 9.");
    folder.run("run --resume runs/flat-9").fails(1, "kit::no-recording");
    folder.run("run flat --resume runs/flat-2").fails(2, "cannot be used with");
}

/// A resumed run does not change files of other origin in the places of its log and its truth.
#[test]
fn a_file_of_something_else_is_not_replaced() {
    let (folder, _) = undisturbed("sqlite", "log.db");
    let whole = left(&folder, "flat-1");
    let database =
        |sql: &'static str| move |path: &std::path::Path| Connection::open(path).unwrap().execute_batch(sql).unwrap();
    type Lay<'a> = &'a dyn Fn(&std::path::Path);
    let others: [(&str, Lay); 4] = [
        ("error[resume::foreign-database]", &database("CREATE TABLE photo (name TEXT)")),
        ("error[resume::foreign-database]", &database("CREATE TABLE run (name TEXT)")),
        ("error[resume::other-run]", &database("CREATE TABLE run (run_id TEXT); INSERT INTO run VALUES ('seven')")),
        ("error[log::not-a-database]", &|path| fs::write(path, "a diary").unwrap()),
    ];
    // One that was stopped, whose truth is written anew, and one that was killed.
    for is_killed in [false, true] {
        let mut running = folder.start(&format!("run flat --for {SPAN} --quiet --control --paused"));
        running.say("step 4000\n");
        folder.until("rows are stored", |folder| folder.stored_rows("runs/flat-2/log.db") > 100);
        if is_killed {
            running.kill();
        } else {
            running.say("stop\n");
            running.finish().ok();
        }
        for file in ["log.db", "truth.db"] {
            let path = folder.path(&format!("runs/flat-2/{file}"));
            let moved = |from: &str, to: &str, endings: &[&str]| {
                for ending in endings {
                    let [from, to] = [from, to].map(|place| folder.path(&format!("{place}/{file}{ending}")));
                    let _ = fs::rename(from, to);
                }
            };
            moved("runs/flat-2", "runs", &["", "-wal", "-shm", "-journal", ".lock"]);
            for (said, make) in &others {
                make(&path);
                let before = fs::read(&path).unwrap();
                folder.run("run --resume runs/flat-2").fails(1, said).says(&["hint: "]);
                assert!(fs::read(&path).unwrap() == before, "{file}: {said}");
                fs::remove_file(&path).unwrap();
            }
            moved("runs", "runs/flat-2", &["", "-wal", "-shm", "-journal"]);
            let _ = fs::remove_file(folder.path(&format!("runs/{file}.lock")));
        }
        // The hint is followed: what was there is put back.
        folder.run("run --resume runs/flat-2 --quiet").ok();
        assert_eq!(differ(&folder, "flat-2", &whole), Vec::<String>::new());
        fs::remove_dir_all(folder.path("runs/flat-2")).unwrap();
    }
}

/// Killed before its recording stood, a run has left nothing to go on with. The hint is followed, and works.
#[test]
fn a_run_killed_at_once_starts_again() {
    let folder = flat();
    for part in ["recording.json.4711-0.part", "cohort.json.4711-0.part", ""] {
        fs::create_dir_all(folder.path("runs/flat-1")).unwrap();
        if !part.is_empty() {
            folder.write(&format!("runs/flat-1/{part}"), "{ \"version\": ");
        }
        let said = "[kit::nothing-to-resume]: the run in runs/flat-1";
        let done = folder.run("run --resume runs/flat-1").fails(1, said);
        let hint = "hint: delete the folder, and start the run again";
        assert!(done.err.contains(hint), "{}", done.err);
        fs::remove_dir_all(folder.path("runs/flat-1")).unwrap();
        folder.run("run flat --for 1m --quiet").ok();
        fs::remove_dir_all(folder.path("runs/flat-1")).unwrap();
    }
    // The control: another folder has no run.
    folder.run("run --resume flat").fails(1, "kit::no-recording");
}

/// Each hint is followed, and works.
#[test]
fn a_run_that_cannot_resume_reports_a_way_out() {
    let (folder, _) = undisturbed("sqlite", "log.db");
    let whole = left(&folder, "flat-1");
    let running = folder.start(&format!("run flat --for {SPAN} --quiet --control --paused"));
    folder.until("the run is begun", |folder| folder.path("runs/flat-2/recording.json").exists());
    running.kill();

    // A recording that is not complete is replayed once the run is; a file is in a folder.
    let hint = "hint: resume the run with homebody run --resume runs/flat-2, and then replay it";
    folder.run("replay runs/flat-2/recording.json").fails(2, hint);
    let hint = "runs/flat-2/recording.json is a file, and a folder was expected\n  hint: name its folder, runs/flat-2";
    folder.run("run --resume runs/flat-2/recording.json").fails(1, hint);
    folder.run("run --resume flat/home.json").fails(1, "[kit::not-a-folder]: flat/home.json");
    goes_on_to(&folder, &whole, "after a kill");
    folder.run("replay runs/flat-2/recording.json --quiet --out csv:again.csv").ok();

    // An empty recording, and that of another scenario's run, which is put back.
    let recording = folder.read("runs/flat-2/recording.json");
    folder.write("runs/flat-2/recording.json", "");
    let done = folder
        .run("run --resume runs/flat-2")
        .fails(2, "is not a recording: it is empty\n  hint: the run cannot be resumed");
    assert!(done.err.contains("are still readable"));
    folder.run("convert sqlite:runs/flat-2/log.db --out csv:read.csv").ok();
    let mut running = folder.start(&format!("run flat --for {SPAN} --seed 8 --quiet --control --paused"));
    running.say("step 4000\nstop\n");
    running.finish().ok();
    folder.write("runs/flat-2/recording.json", folder.read("runs/flat-3/recording.json"));
    let before = left(&folder, "flat-2");
    folder.run("run --resume runs/flat-2").fails(1, "error[resume::other-run]");
    assert_eq!(differ(&folder, "flat-2", &before), Vec::<String>::new(), "and no journal is left");
    folder.write("runs/flat-2/recording.json", &recording);
    folder.run("run --resume runs/flat-2").fails(2, "the run in runs/flat-2 is complete");
    assert_eq!(differ(&folder, "flat-2", &whole), Vec::<String>::new());
}

/// A refusal on the way, once rows have been added to other tables, leaves databases without journals.
#[test]
fn a_refused_run_leaves_no_journals() {
    let (folder, _) = undisturbed("sqlite", "log.db");
    let mut running = folder.start(&format!("run flat --for {SPAN} --quiet --control --paused"));
    running.say("step 4000\n");
    folder.until("rows are stored", |folder| folder.stored_rows("runs/flat-2/log.db") > 100);
    folder.until("the truth is stored", |folder| {
        folder.query("runs/flat-2/truth.db", "SELECT count(*) FROM movement") != ["0"]
    });
    running.kill();
    let companions = |folder: &Folder| {
        let is_one = |name: &String| ["-journal", "-wal", "-shm", ".lock"].iter().any(|end| name.ends_with(end));
        folder.files().into_iter().filter(is_one).collect::<Vec<_>>()
    };
    assert!(!companions(&folder).is_empty(), "the killed run has left some");
    let database = Connection::open(folder.path("runs/flat-2/truth.db")).unwrap();
    let last = "UPDATE movement SET kind = 'flight' WHERE rowid = (SELECT max(rowid) FROM movement)";
    assert_eq!(database.execute(last, []).unwrap(), 1);
    drop(database);
    folder.run("run --resume runs/flat-2").fails(1, "error[resume::other-row]");
    assert_eq!(companions(&folder), Vec::<String>::new());
    assert_eq!(folder.query("runs/flat-2/log.db", "PRAGMA integrity_check"), ["ok"]);
}

/// The hint to move a wrong file away works; then the member is simulated again.
#[test]
fn a_member_that_is_none_is_moved_away() {
    let folder = Folder::with("tigerplace");
    folder.write("people.csv", "name,age\nanna,75\nbea,88\ncarl,\n");
    for (who, member, other) in [("--members 3", "0002", "0001"), ("--profiles people.csv", "bea", "anna")] {
        folder.run(&format!("run tigerplace {who} --for 1d --quiet")).ok();
        let whole = left(&folder, "tigerplace-1");
        let place = format!("runs/tigerplace-1/{member}");
        let recording = format!("{place}/recording.json");
        let others: [(&str, &dyn Fn()); 4] = [
            ("is a file, and a member's folder is to be there", &|| {
                fs::remove_dir_all(folder.path(&place)).unwrap();
                folder.write(&place, "a file");
            }),
            ("is not a recording: it is empty", &|| folder.write(&recording, "")),
            ("it is of another cohort", &|| {
                folder.write(&recording, folder.read(&format!("runs/tigerplace-1/{other}/recording.json")));
            }),
            ("it is of another cohort", &|| {
                // Whole, of the same name and seed, but of another life.
                let text = folder.read(&recording);
                let mut changed: Value = serde_json::from_str(&text).unwrap();
                let files = changed["files"].as_object_mut().unwrap();
                for (_, text) in files.iter_mut().filter(|(name, _)| name.ends_with("margaret.routine")) {
                    *text = (text.as_str().unwrap().to_owned() + "\nThe person is 99.\n").into();
                }
                folder.write(&recording, changed.to_string());
            }),
        ];
        for (said, spoil) in others {
            spoil();
            let done = folder.run("run --resume runs/tigerplace-1").fails(2, said);
            let hint = format!("hint: move {place} away");
            assert!(done.err.contains(&hint), "{}", done.err);
            fs::rename(folder.path(&place), folder.path("away")).unwrap();
            let told = folder.run("run --resume runs/tigerplace-1").ok().out;
            assert!(
                told.starts_with("tigerplace: simulated 3 members, 2 of them complete before this run in "),
                "{told}"
            );
            assert_eq!(differ(&folder, "tigerplace-1", &whole), Vec::<String>::new(), "{who}, {said}");
            let _ = fs::remove_dir_all(folder.path("away"));
            let _ = fs::remove_file(folder.path("away"));
        }
        folder.run("run --resume runs/tigerplace-1").fails(2, "the cohort in runs/tigerplace-1 is complete");
        folder.run(&format!("run --resume {recording}")).fails(1, "hint: name its folder, runs/tigerplace-1\n");
        folder.run("run --resume runs/tigerplace-1/cohort.json").fails(1, "hint: name its folder, runs/tigerplace-1\n");
        fs::remove_dir_all(folder.path("runs")).unwrap();
    }
}

/// A row as SQL tells it, cut into its cells.
fn cells(rows: Vec<String>) -> Vec<Vec<String>> {
    rows.iter().map(|row| row.split('|').map(str::to_owned).collect()).collect()
}

/// The text of an empty cell.
const NOTHING: &str = "NULL";

/// The label of the first span of a resident that contains an instant.
fn said_at(spans: &[Vec<String>], who: &str, at: &str) -> String {
    let found = spans.iter().find(|span| span[0] == who && span[1].as_str() <= at && at < span[2].as_str());
    found.map_or(NOTHING, |span| &span[3]).to_owned()
}

/// Labels a run and joins it by hand, row by row. The numbers of rows, and of rows that a resident caused.
fn labelled_by_hand(folder: &Folder, run: &str) -> (usize, usize) {
    folder.run(&format!("label runs/{run} --out sqlite:{run}.db")).ok();
    let truth = |sql: &str| cells(folder.query(&format!("runs/{run}/truth.db"), sql));
    let labelled =
        "SELECT seq, fired_at, sensor, value, resident, room, activity, cause, thing FROM labelled ORDER BY seq";
    let labelled = cells(folder.query(&format!("{run}.db"), labelled));
    let log = "SELECT seq, fired_at, sensor, value FROM firing ORDER BY seq";
    let rows = cells(folder.query(&format!("runs/{run}/log.db"), log));
    let mut causes: BTreeMap<String, Vec<Vec<String>>> = BTreeMap::new();
    for cause in truth("SELECT sensor, fired_at, resident, why, thing, seen_at FROM cause ORDER BY firing") {
        causes.entry(cause[0].clone()).or_default().push(cause);
    }
    let rooms = truth(
        "SELECT resident, at, coalesce(lead(at) OVER (PARTITION BY resident ORDER BY at, rowid), '9'), room FROM room",
    );
    let activities = truth("SELECT resident, begin_at, end_at, name FROM activity WHERE name IS NOT NULL");
    assert_eq!(rows.len(), labelled.len());
    let mut caused = 0;
    for (row, labelled) in rows.iter().zip(&labelled) {
        assert_eq!(row[..], labelled[..4]);
        // By hand: an ON is of the firing that was stored at its instant, an OFF of the sensor's last firing before it.
        let of_sensor = &causes[&row[2]];
        let cause = match row[3].as_str() {
            "OFF" | "false" if row[2].ends_with("motion") => of_sensor.iter().rfind(|cause| cause[1] < row[1]),
            _ => of_sensor.iter().find(|cause| cause[1] == row[1]),
        };
        let cause = cause.unwrap_or_else(|| panic!("{row:?} has a cause"));
        let [who, why, thing, seen_at] = [&cause[2], &cause[3], &cause[4], &cause[5]];
        let [room, activity] = match who.as_str() {
            NOTHING => [NOTHING.to_owned(), NOTHING.to_owned()],
            who => [said_at(&rooms, who, seen_at), said_at(&activities, who, seen_at)],
        };
        assert_eq!(labelled[4..], [who.clone(), room, activity, why.clone(), thing.clone()], "{row:?}");
        caused += usize::from(who != NOTHING);
    }
    (rows.len(), caused)
}

#[test]
fn labels_are_those_of_a_join_by_hand() {
    let modes = [r#"{ "on_off": { "hold_s": 4 } }"#, r#"{ "occupancy": { "timeout_s": 90 } }"#, r#""fire_only""#];
    // A link that loses, delays, doubles and invents messages.
    let link =
        r#"{ "preset": "zigbee", "loss": 0.05, "delay_s": [0, 0.4], "duplicates": 0.05, "false_fires_per_h": 2 }"#;
    for (messages, linked) in modes.into_iter().flat_map(|messages| [(messages, false), (messages, true)]) {
        let folder = Folder::with("tigerplace");
        folder.edit_json("tigerplace/logger.json", |logger| {
            logger["messages"] = serde_json::from_str(messages).unwrap();
            // Under our own names, which are easier to ask for.
            for own in ["table", "columns", "ids", "values"] {
                logger.as_object_mut().unwrap().remove(own);
            }
        });
        if linked {
            folder.write("tigerplace/link.json", link);
            folder.edit_json("tigerplace/scenario.json", |scenario| scenario["link"] = "link.json".into());
        }
        folder.run("run tigerplace --for 2d --quiet").ok();
        let (rows, caused) = labelled_by_hand(&folder, "tigerplace-1");
        println!("{messages}, {}: {rows} rows, {caused} caused", if linked { "a bad link" } else { "no link" });
        assert!(rows > 1000 && caused * 2 > rows && (caused < rows || !linked));
    }
}

/// The control: the truth of another run is refused, before anything is written.
#[test]
fn labels_of_another_run_are_refused() {
    let folder = flat();
    folder.run("run flat --for 30m --quiet").ok();
    folder.run("run flat --for 20m --quiet").ok();
    folder
        .run("label runs/flat-2 runs/flat-1/truth.db --out csv:labelled.csv")
        .fails(1, "error[other-run::fewer-rows]");
    folder.edit("flat/home.json", "KitchenWall", "OtherWall");
    folder.run("run flat --for 30m --quiet").ok();
    folder
        .run("label runs/flat-1 runs/flat-3/truth.db --out csv:labelled.csv")
        .fails(1, "error[other-run::other-sensor]");
    for source in ["sqlite:runs/flat-1/log.db", "csv:runs/flat-1/log.db", "csv:runs/flat-1/truth.db"] {
        folder.run(&format!("label runs/flat-1 --force --out {source}")).fails(1, "error[log::is-source]");
    }
    assert!(!folder.path("labelled.csv").exists());
}
