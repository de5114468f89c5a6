//! Runs that are ended from outside, their files, and the memory of runs.

use crate::flat::flat;
use crate::folder::Folder;
use rusqlite::Connection;
use std::fs::{self, File};
use std::net::{TcpListener, TcpStream};
use std::process::Command;
use std::thread;
use std::time::Duration;

/// The rows of a database's log, as lines of a CSV file.
fn rows(folder: &Folder, name: &str) -> Vec<String> {
    folder.query(name, "SELECT seq || ',' || fired_at || ',' || sensor || ',' || value FROM firing ORDER BY seq")
}

/// The same rows, of a run that nobody stopped.
fn undisturbed(folder: &Folder, span: &str) -> Vec<String> {
    folder.run(&format!("run flat --for {span} --quiet --force --out csv:undisturbed.csv")).ok();
    folder.read("undisturbed.csv").lines().skip(1).map(String::from).collect()
}

/// Kills a run some milliseconds after it has stored something; what it leaves is a beginning of the whole.
fn killed(speed: &str, span: &str, after_ms: u64, whole: &[String]) {
    let folder = flat();
    let words = format!("run flat --for {span} --speed {speed} --out sqlite:log.db --truth truth.db");
    let mut running = folder.start(&format!("{words} --out csv:log.csv --recording r.json"));
    folder.until("something is stored", |folder| folder.stored_rows("log.db") > 0);
    thread::sleep(Duration::from_millis(after_ms));
    assert!(running.is_alive(), "the run is too short");
    running.kill();

    assert!(!folder.path("log.csv").exists(), "only what is whole has its name");
    assert!(
        folder.read("r.json").contains("\"sha256\": \"\""),
        "the recording stands, and says that it is not complete"
    );
    // Our own readers take what is there, before anything else has put it in order.
    folder.run("convert log.db --out csv:converted.csv").ok();
    assert_eq!(folder.query("log.db", "PRAGMA integrity_check"), ["ok"]);
    assert_eq!(folder.query("truth.db", "PRAGMA integrity_check"), ["ok"]);
    let stored = rows(&folder, "log.db");
    assert!(!stored.is_empty());
    // Neither gaps nor doubles.
    let numbers = folder.query("log.db", "SELECT count(DISTINCT seq), min(seq), max(seq) + 1 FROM firing");
    assert_eq!(numbers, [format!("{0}|0|{0}", stored.len())]);
    let known = stored.len().min(whole.len());
    assert!(stored[..known] == whole[..known], "the rows are the first of the whole");
    assert_eq!(folder.query("log.db", "SELECT ended_at FROM run"), ["NULL"]);
    assert_eq!(folder.read("converted.csv").lines().count() - 1, stored.len());

    // The remains are replaced only on request, and then completely.
    folder.run("run flat --for 5m --out sqlite:log.db").fails(1, "[log::exists]: log.db");
    assert_eq!(rows(&folder, "log.db"), stored);
    folder.run("run flat --for 5m --quiet --force --out sqlite:log.db --truth truth.db").ok();
    let again = rows(&folder, "log.db");
    assert!(again == whole[..again.len()] && folder.query("log.db", "SELECT ended_at FROM run") != ["NULL"]);
}

#[test]
fn a_killed_live_run_leaves_a_beginning() {
    let folder = flat();
    let whole = undisturbed(&folder, "20m");
    thread::scope(|scope| {
        for after_ms in [0, 450, 1300] {
            let whole = &whole;
            scope.spawn(move || killed("100", "20m", after_ms, whole));
        }
    });
}

#[test]
fn a_killed_fast_run_leaves_a_beginning() {
    let folder = flat();
    let whole = undisturbed(&folder, "6h");
    for after_ms in [0, 80, 210] {
        killed("max", "1000d", after_ms, &whole);
    }
}

#[test]
fn an_interrupted_run_ends_well() {
    let folder = flat();
    let whole = undisturbed(&folder, "20m");
    for (signal, code, speed, more) in
        [("INT", 130, "50", ""), ("TERM", 143, "100", ""), ("INT", 130, "1", "--control --paused")]
    {
        let words = "--out sqlite:log.db --out csv:log.csv --truth truth.db --recording r.json --force";
        let _ = fs::remove_file(folder.path("log.db"));
        let mut running = folder.start(&format!("run flat --for 20m --speed {speed} {words} {more}"));
        // By what it has done itself, however long that takes: the other files are there from the run before.
        match more {
            "" => folder.until("rows are stored", |folder| folder.stored_rows("log.db") > 0),
            _ => folder.until("the log is open", |folder| folder.path("log.db").exists()),
        }
        assert!(running.is_alive());
        running.signal(signal);
        let done = running.finish_listening();
        assert_eq!((done.code, done.err.as_str()), (Some(code), ""), "{signal}");
        assert!(done.out.starts_with("flat: stopped after "), "{}", done.out);
        assert!(done.out.contains("of 20 minutes"), "{}", done.out);

        let stored = rows(&folder, "log.db");
        assert!(stored == whole[..stored.len()] && stored.is_empty() != more.is_empty(), "{} rows", stored.len());
        assert_eq!(folder.read("log.csv").lines().skip(1).collect::<Vec<_>>(), stored);
        // The log is complete up to where the run was stopped: nothing came between its last row and that.
        let ended = folder.query("log.db", "SELECT ended_at FROM run").concat();
        assert!(whole[stored.len()].split(',').nth(1).unwrap() >= ended.as_str(), "{ended}");
        assert_eq!(folder.query("truth.db", "SELECT ended_at FROM run").concat(), ended);
        let left = folder.files().into_iter().filter(|name| !name.starts_with("flat/"));
        let is_log = |name: &String| !name.ends_with(".sensors.csv");
        let left: Vec<String> = left.filter(is_log).collect();
        assert_eq!(left, ["log.csv", "log.db", "r.json", "truth.db", "undisturbed.csv"]);
        // And it can be lived again.
        let again = folder.run("replay r.json --json --force --out csv:again.csv").ok().json();
        assert_eq!(again["agrees_with_recording"].as_bool(), Some(true));
        assert_eq!(folder.sha256("again.csv"), folder.sha256("log.csv"));
        fs::remove_file(folder.path("again.csv")).unwrap();
    }
}

/// The last line of what a command has said.
fn last_line(out: &str) -> &str {
    out.lines().last().unwrap_or_default()
}

#[test]
fn the_last_line_of_an_interrupted_run_says_how_to_go_on() {
    let folder = flat();
    folder.run("run flat --for 20m --quiet").ok();
    let mut running = folder.start("run flat --for 20m --speed 50");
    folder.until("rows are stored", |folder| folder.stored_rows("runs/flat-2/log.db") > 0);
    assert!(running.is_alive());
    running.signal("TERM");
    let done = running.finish_listening();
    assert_eq!(done.code, Some(143), "{}", done.err);
    let (_, go_on) = last_line(&done.out).split_once("homebody ").unwrap();
    assert_eq!(go_on, "run --resume runs/flat-2");
    folder.run(&format!("{go_on} --quiet")).ok();
    assert_eq!(folder.sha256("runs/flat-2/log.db"), folder.sha256("runs/flat-1/log.db"));
    // One that was told to stop has done what it was asked, and says the same.
    let done = folder.say("run flat --for 20m --control --paused", "step 60\nstop\n").ok();
    assert!(last_line(&done.out).ends_with("homebody run --resume runs/flat-3"), "{}", done.out);
    let json = folder.say("run flat --for 20m --control --paused --json", "step 60\nstop\n").ok().json();
    assert_eq!((json["stopped"].as_bool(), json["folder"].as_str()), (Some(true), Some("runs/flat-4")));
    // The control: a whole run says nothing of that.
    let done = folder.run("run flat --for 1m").ok();
    assert!(!done.out.contains("--resume"), "{}", done.out);
}

/// Interrupted again before it has come as far as before, it changes nothing, and says how to go on.
#[test]
fn an_interrupted_run_that_is_gone_on_with_says_how_to_go_on() {
    let folder = flat();
    for who in ["", " --members 2"] {
        let run = if who.is_empty() { "flat-1" } else { "flat-2" };
        let log = if who.is_empty() { "flat-1/log.db" } else { "flat-2/0001/log.db" };
        let mut running = folder.start(&format!("run flat --for 1000d{who}"));
        let is_some = |log: fs::Metadata| log.len() > 4_000_000;
        folder.until("much is lived", |folder| fs::metadata(folder.path(&format!("runs/{log}"))).is_ok_and(is_some));
        assert!(running.is_alive());
        running.signal("TERM");
        assert_eq!(running.finish_listening().code, Some(143));
        let before = folder.sha256(&format!("runs/{log}"));
        for (signal, code) in [("INT", 130), ("TERM", 143)] {
            let mut running = folder.start(&format!("run --resume runs/{run}"));
            folder.until("it is lived again", |folder| folder.path(&format!("runs/{log}.lock")).exists());
            assert!(running.is_alive());
            running.signal(signal);
            let done = running.finish_listening();
            assert_eq!((done.code, done.err.as_str()), (Some(code), ""), "{signal}");
            let (_, go_on) = last_line(&done.out).split_once("homebody ").unwrap();
            assert_eq!(go_on, format!("run --resume runs/{run}"));
        }
        assert_eq!(folder.sha256(&format!("runs/{log}")), before);
    }
}

#[test]
fn an_interrupted_cohort_says_what_it_came_to() {
    let folder = Folder::with("tigerplace");
    let live = "run tigerplace --members 3 --for 2000d";
    for (words, signal, code) in [("", "INT", 130), (" --json", "TERM", 143)] {
        let mut running = folder.start(&format!("{live}{words}"));
        let run = if words.is_empty() { "tigerplace-1" } else { "tigerplace-2" };
        folder.until("a member is lived", |folder| {
            folder.stored_rows(&format!("runs/{run}/0001/log.db")) > 0
                || fs::metadata(folder.path(&format!("runs/{run}/0001/log.db"))).is_ok_and(|log| log.len() > 100_000)
        });
        assert!(running.is_alive());
        running.signal(signal);
        let done = running.finish_listening();
        assert_eq!(done.code, Some(code), "{}", done.err);
        if words.is_empty() {
            assert!(done.out.starts_with("tigerplace: simulated 3 members, stopped in "), "{}", done.out);
            assert!(last_line(&done.out).ends_with("homebody run --resume runs/tigerplace-1"), "{}", done.out);
        } else {
            let json = done.json();
            assert_eq!((json["stopped"].as_bool(), json["found_complete"].as_u64()), (Some(true), Some(0)), "{json}");
        }
    }
}

/// To interrupt it is how one stops it.
#[test]
fn an_interrupted_server_ends_well() {
    let folder = flat();
    for signal in ["INT", "TERM"] {
        let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
        let mut running = folder.start(&format!("serve flat --no-open --port {port}"));
        folder.until("the server listens", |_| TcpStream::connect(("127.0.0.1", port)).is_ok());
        assert!(running.is_alive());
        running.signal(signal);
        running.finish_listening().ok();
    }
}

#[test]
fn a_second_interrupt_ends_at_once() {
    let folder = flat();
    assert!(Command::new("mkfifo").arg(folder.path("pipe")).status().unwrap().success());
    let mut running = folder.start("run flat --for 5000w --quiet --out csv:pipe");
    // Somebody who opens the pipe, but never reads: the run fills it, then waits.
    let reader = File::open(folder.path("pipe")).unwrap();
    thread::sleep(Duration::from_millis(200));
    running.signal("INT");
    thread::sleep(Duration::from_millis(100));
    assert!(running.is_alive(), "the first interrupt waits until what there is has been written");
    running.signal("INT");
    assert_eq!(running.finish_listening().code, Some(130));
    drop(reader);
}

#[test]
fn somebody_may_look_at_a_live_run() {
    let folder = flat();
    let running = folder.start("run flat --for 5m --speed 100 --out sqlite:log.db");
    folder.until("there are rows", |folder| folder.stored_rows("log.db") > 0);
    let watcher = Connection::open(folder.path("log.db")).unwrap();
    watcher.busy_timeout(Duration::from_secs(5)).unwrap();
    watcher.execute_batch("BEGIN; SELECT count(*) FROM firing").unwrap();
    // The watcher holds on to what it sees, and is in nobody's way; what it keeps beside the log is told.
    let done = running.finish().ok();
    let told = "warning[run::open-database]: another program is reading log.db: until it closes the database, keep log.db-wal with the file\n";
    assert_eq!(done.err, told);
    watcher.execute_batch("COMMIT").unwrap();
    drop(watcher);
    assert!(!folder.path("log.db-wal").exists());
    // The control: one who ends within the time that is waited for leaves nothing to tell.
    let mut running = folder.start("run flat --for 5m --speed 100 --out sqlite:brief.db");
    folder.until("there are rows", |folder| folder.stored_rows("brief.db") > 0);
    let watcher = Connection::open(folder.path("brief.db")).unwrap();
    watcher.execute_batch("BEGIN; SELECT count(*) FROM firing").unwrap();
    let rows_of = |name: &str| folder.stored_rows(name);
    folder.until("all is stored", |_| rows_of("brief.db") == rows_of("log.db"));
    assert!(running.is_alive());
    drop(watcher);
    assert_eq!(running.finish().ok().err, "");
    assert!(!folder.path("brief.db-wal").exists());
    assert_eq!(rows(&folder, "log.db"), undisturbed(&folder, "5m"));
}

#[cfg(target_os = "linux")]
/// The most memory that a run had in use, in KiB.
fn peak_kib(folder: &Folder, span: &str) -> u64 {
    let out = format!("--out sqlite:{span}.db --out csv:{span}.csv --out casas:{span}.txt --truth {span}-truth.db");
    let mut running = folder.start(&format!("run tigerplace --for {span} --quiet {out}"));
    let status = format!("/proc/{}/status", running.id());
    let mut peak = 0;
    while running.is_alive() {
        let status = fs::read_to_string(&status).unwrap_or_default();
        let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        peak = line.map_or(peak, |line| line.trim().trim_end_matches(" kB").parse().unwrap());
        thread::sleep(Duration::from_millis(2));
    }
    running.finish().ok();
    peak
}

#[cfg(target_os = "linux")]
#[test]
fn memory_does_not_grow_with_the_span() {
    let folder = Folder::with("tigerplace");
    let (short, long) = (peak_kib(&folder, "15d"), peak_kib(&folder, "75d"));
    assert!(short > 1024 && long < 64 * 1024, "{short} KiB, then {long} KiB");
    assert!(long as f64 <= 1.2 * short as f64, "{short} KiB, then {long} KiB");
    let bytes = |name: &str| fs::metadata(folder.path(name)).unwrap().len();
    assert!(bytes("75d.db") > 4 * bytes("15d.db"), "the long run is the longer");
}
