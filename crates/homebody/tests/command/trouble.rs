//! Files that cannot be written: the command reports which and why, and leaves nothing half done.

use crate::flat::flat;
use crate::folder::{Done, Folder};
use rusqlite::Connection;
use std::fs::{self, Permissions};
use std::os::unix::fs::PermissionsExt;
use std::process::Command;

const SCHEMES: [&str; 3] = ["sqlite", "csv", "casas"];

#[test]
fn proposes_another_place_if_runs_cannot_be_stored() {
    let folder = flat();
    folder.write("runs", "no folder");
    let said = "hint: run in a folder that you can write to, or pass --out to write elsewhere";
    folder.run("run flat --for 5000w").fails(1, said);
    assert_eq!(folder.read("runs"), "no folder");
    folder.run("run flat --for 1m --out csv:a.csv").ok();
}

#[test]
fn a_place_that_cannot_be_is_told_before_the_run() {
    let folder = flat();
    folder.write("file", "precious");
    let given = folder.files();
    for scheme in SCHEMES {
        for (place, code, said) in [
            ("none/log", 1, "[log::no-folder]: the folder of none/log"),
            ("file/log", 1, "[log::no-folder]: the folder of file/log"),
            ("flat", 1, "flat is a folder\n  hint: name a file in it"),
            ("new", 2, "[log::same-file]: two destinations are the same file: ./new"),
        ] {
            let also = if place == "new" { "--recording ./new" } else { "--recording new" };
            // A century, had it begun.
            let words = format!("run flat --for 5000w --out {scheme}:{place} {also} --force");
            folder.run(&words).fails(code, said);
            assert_eq!(folder.files(), given, "{words}");
        }
    }
    for (words, said) in [
        ("--out csv:a.csv --truth none/truth.db", "[log::no-folder]: the folder of none/truth.db"),
        ("--out csv:a.csv --record none/r.json", "[log::no-folder]: the folder of none/r.json"),
        ("--out csv:a.csv --truth flat", "flat is a folder"),
        ("--truth none/truth.db", "[log::no-folder]: the folder of none/truth.db"),
    ] {
        folder.run(&format!("run flat --for 5000w {words}")).fails(1, said);
        assert_eq!(folder.files(), given, "{words}");
    }
    folder
        .run("coverage flat --svg map.svg --json=none/a.json")
        .fails(1, "[log::no-folder]: the folder of none/a.json");
    folder.run("new none/home").ok();
    folder.run("new file/home").fails(1, "file/home");
    folder.run("schema file").fails(1, "file: ");
    folder.run("convert file --out csv:none2/log").fails(2, "cannot read file");
    assert_eq!(folder.read("file"), "precious");
}

#[test]
fn a_folder_that_may_not_be_written_says_so() {
    let folder = flat();
    fs::create_dir(folder.path("closed")).unwrap();
    fs::set_permissions(folder.path("closed"), Permissions::from_mode(0o555)).unwrap();
    let may_all = fs::write(folder.path("closed/probe"), "").is_ok();
    // Nobody may make a file here, not even who may all.
    let (place, said) =
        if may_all { ("/proc", "/proc/log") } else { ("closed", "[log::write-denied]: cannot write closed/log") };
    for scheme in SCHEMES {
        folder.run(&format!("run flat --for 1m --out {scheme}:{place}/log")).fails(1, said);
    }
    folder.run(&format!("run flat --for 1m --out csv:log.csv --truth {place}/log")).fails(1, said);
    folder.run(&format!("run flat --for 1m --out csv:log.csv --recording {place}/log")).fails(1, said);
    folder.run(&format!("coverage flat --svg {place}/log")).fails(1, said);
    folder.run(&format!("new {place}/log")).fails(1, &format!("{place}/log"));
    fs::set_permissions(folder.path("closed"), Permissions::from_mode(0o755)).unwrap();
    assert!(!folder.files().contains(&"log.csv".into()));
}

/// Runs the command where no file can grow beyond so many KiB. The system's signal for that has its usual meaning.
fn cramped(folder: &Folder, kib: u32, words: &str) -> Done {
    let limit = format!("ulimit -f {kib}; exec \"$0\" \"$@\"");
    let mut command = Command::new("bash");
    command.args(["-c", &limit, env!("CARGO_BIN_EXE_homebody")]).args(words.split_whitespace());
    Done::new(words, command.current_dir(folder.path("")).output().unwrap())
}

#[test]
fn where_no_room_is_left_nothing_is_half_written() {
    let folder = flat();
    folder.run("run flat --quiet --for 1h --out csv:given.csv").ok();
    let given = folder.files();
    for (kib, words, said) in [
        (24, "run flat --for 10d --out sqlite:log.db", "[log::write-failed]: cannot write to the database log.db"),
        (64, "run flat --for 10d --out csv:log.csv", "log.csv: "),
        (64, "run flat --for 10d --out casas:log.txt", "log.txt: "),
        (
            24,
            "run flat --for 10d --out csv:log.csv --out sqlite:log.db --truth truth.db --recording r.json",
            "error[log::",
        ),
        (24, "run flat --for 10d", "runs/flat-1/"),
        (4, "coverage flat --svg map.svg", "map.svg: "),
        (1, "plan flat --svg plan.svg", "plan.svg: "),
        (4, "coverage flat --png map.png", "map.png: "),
        (1, "coverage flat --json=figures.json", "figures.json: "),
        (4, "convert given.csv --out sqlite:log.db", "log.db.part"),
        (4, "convert given.csv --out csv:log.csv", "log.csv: "),
        (4, "new home", ".home.part/"),
    ] {
        cramped(&folder, kib, words).fails(1, said);
        let left: Vec<String> = folder.files().into_iter().filter(|name| !given.contains(name)).collect();
        assert!(left.is_empty(), "homebody {words} leaves {left:?}");
    }
    // A schema is whole or not there.
    cramped(&folder, 4, "schema schemas").fails(1, "schemas/");
    for name in folder.files().into_iter().filter(|name| name.starts_with("schemas/") && !name.ends_with('/')) {
        let schema = folder.json(&name);
        assert!(schema["$schema"].is_string(), "{name}");
    }
    // Without room for the recording, no run starts.
    cramped(&folder, 1, "run flat --for 1s --out casas:log.txt --recording r.json").fails(1, "r.json: ");
    assert!(!folder.path("log.txt").exists());
    assert!(!folder.files().iter().any(|name| name.starts_with("r.json")), "{:?}", folder.files());
    // Given room, all of it can be done.
    cramped(&folder, 100_000, "run flat --for 1h --out sqlite:log.db --truth truth.db --recording r.json --quiet").ok();
}

#[test]
fn reports_that_there_are_no_threads() {
    let folder = flat();
    let given = folder.files();
    for words in [
        "run flat --for 1s",
        "run flat --for 1s --members 2",
        "run --resume flat",
        "replay r.json",
        "serve flat --no-open",
    ] {
        // A stack for which no machine has room.
        let output = folder.command(words).env("RUST_MIN_STACK", (1_u64 << 46).to_string()).output().unwrap();
        Done::new(words, output).fails(1, "error[thread::unavailable]");
        assert_eq!(folder.files(), given, "{words}");
    }
}

#[test]
fn a_failed_replacement_keeps_the_old_file() {
    let folder = flat();
    folder.write("log.csv", "precious");
    folder.write("map.svg", "precious");
    cramped(&folder, 4, "run flat --for 1h --out csv:log.csv --force").fails(1, "log.csv: ");
    cramped(&folder, 4, "coverage flat --svg map.svg --force").fails(1, "map.svg: ");
    assert_eq!((folder.read("log.csv"), folder.read("map.svg")), ("precious".into(), "precious".into()));

    folder.run("run flat --for 60s --out sqlite:log.db --truth truth.db --quiet").ok();
    let signs = || ["log.db", "truth.db"].map(|name| folder.sha256(name));
    let (before, files) = (signs(), folder.files());
    let over = "run flat --for 1h --out sqlite:log.db --truth truth.db --force --quiet";
    cramped(&folder, 4, over).fails(1, "log.db");
    folder.run(&format!("{over} --out csv:no/folder.csv")).fails(1, "folder.csv");
    folder.write("flat/logger.json", r#"{ "ids": { "KitchenWall": "a b", "BedroomWall": "AB" } }"#);
    folder.run(&format!("{over} --out casas:log.txt")).fails(2, "would both have the id");
    assert_eq!((signs(), folder.files()), (before, files));
}

#[test]
fn never_replaces_the_files_of_a_scenario() {
    let folder = flat();
    folder.run("run flat --for 60s --quiet --out csv:log.csv --recording r.json").ok();
    let given = ["flat/home.json", "r.json"].map(|name| folder.read(name));
    for words in [
        "run flat --out csv:flat/home.json",
        "run flat/scenario.json --out csv:a.csv --recording flat/../flat/home.json",
        "replay r.json --out casas:r.json",
        "replay r.json --truth r.json",
        "plan flat --png flat/home.json",
        "coverage flat --json=flat/home.json",
    ] {
        folder.run(&format!("{words} --force")).fails(1, "log::is-source");
    }
    assert_eq!(["flat/home.json", "r.json"].map(|name| folder.read(name)), given);
    folder.run("replay r.json --out csv:again.csv").ok().prints(&["identical to the recording"]);
}

#[test]
fn one_full_device_ends_the_run() {
    let folder = flat();
    let given = folder.files();
    for scheme in ["csv", "casas"] {
        let words = format!("run flat --for 5000w --out {scheme}:/dev/full --out csv:log.csv --recording r.json");
        folder.run(&words).fails(1, "[log::disk-full]: no space left to write /dev/full");
        assert_eq!(folder.files(), given);
    }
    folder.run("run flat --for 1s --out sqlite:/dev/full").fails(1, "log::not-a-file");
}

/// `--force` does not replace files that another program writes: neither logs, nor truths, nor recordings.
#[test]
fn two_programs_never_write_one_file() {
    for scheme in SCHEMES {
        let folder = flat();
        let words = format!("--out {scheme}:log --truth truth.db --record r.json --force");
        folder.run(&format!("run flat --for 30m --quiet {words}")).ok();
        let whole = ["log", "truth.db", "r.json"].map(|name| folder.sha256(name));
        let mut running = folder.start(&format!("run flat --for 30m --quiet --control --paused {words}"));
        running.say("step 60\n");
        // The truth that was there is put aside until the new one is whole.
        let is_begun = |folder: &Folder| {
            let is_aside = |name: &String| name.starts_with("truth.db.") && name.ends_with(".old");
            folder.files().iter().any(is_aside) && folder.path("truth.db").exists()
        };
        folder.until("it is begun", is_begun);
        // A database's journals come and go while it is written.
        let files = || {
            let is_journal = |name: &String| ["-wal", "-shm", "-journal"].iter().any(|end| name.ends_with(end));
            folder.files().into_iter().filter(|name| !is_journal(name)).collect::<Vec<_>>()
        };
        let begun = files();
        for other in [
            words.clone(),
            format!("--out {scheme}:flat/../log --force"),
            "--out csv:other --truth truth.db --force".into(),
            "--out csv:other --record r.json --force".into(),
        ] {
            let said = folder.run(&format!("run flat --for 1m --seed 9 {other}"));
            said.fails(1, "log::busy");
            assert_eq!(files(), begun, "{other}");
        }
        running.say("resume\n");
        running.finish().ok();
        assert_eq!(["log", "truth.db", "r.json"].map(|name| folder.sha256(name)), whole, "{scheme}");
        assert!(!folder.files().iter().any(|name| name.ends_with(".lock")), "{:?}", folder.files());
        // The control: once it is over, another may.
        folder.run(&format!("run flat --for 1m --seed 9 --quiet {words}")).ok();
    }
}

#[test]
fn a_database_in_use_is_left_alone() {
    let folder = flat();
    folder.run("run flat --for 1m --quiet --out sqlite:log.db").ok();
    let before = fs::read(folder.path("log.db")).unwrap();
    let files = folder.files();
    let user = Connection::open(folder.path("log.db")).unwrap();
    user.execute_batch("BEGIN IMMEDIATE").unwrap();
    let said = "[log::locked]: another program has locked log.db";
    folder.run("run flat --for 2m --quiet --out sqlite:log.db --force").fails(1, said);
    user.execute_batch("ROLLBACK").unwrap();
    drop(user);
    assert!(fs::read(folder.path("log.db")).unwrap() == before, "not a byte has changed");
    assert_eq!(folder.files(), files);
    folder.run("run flat --for 2m --quiet --out sqlite:log.db --force").ok();
}

#[test]
fn a_database_locked_midway_keeps_what_was_stored() {
    let folder = flat();
    let running = folder.start("run flat --speed 20 --out sqlite:log.db --out csv:log.csv");
    folder.until("there are rows", |folder| folder.stored_rows("log.db") > 0);
    let user = Connection::open(folder.path("log.db")).unwrap();
    user.busy_timeout(std::time::Duration::from_secs(5)).unwrap();
    user.execute_batch("BEGIN IMMEDIATE").unwrap();
    running.finish().fails(1, "[log::locked]: another program has locked log.db");
    user.execute_batch("ROLLBACK").unwrap();
    drop(user);
    assert!(folder.stored_rows("log.db") > 0);
    assert!(!folder.files().iter().any(|name| name.contains("csv")), "{:?}", folder.files());
}
