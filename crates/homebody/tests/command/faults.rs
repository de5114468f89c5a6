//! The system refuses a call: the run reports it and ends, or continues unchanged, and no complete file name holds half a file.
//!
//! strace refuses the n-th call of a kind. `HOMEBODY_FAULTS=all` refuses each of them, one per run, and a number refuses that many of each
//! kind.
#![cfg(target_os = "linux")]

use crate::flat::flat;
use crate::folder::{Done, Folder};
use std::collections::BTreeSet;
use std::fs;
use std::process::Command;

const USUAL: usize = 4;

/// The system calls of a run for its files, and their failures.
const REFUSED: [(&str, &str); 4] = [
    ("write,pwrite64", "ENOSPC"),
    ("fsync,fdatasync", "EIO"),
    ("openat", "EMFILE"),
    ("rename,renameat,renameat2", "EACCES"),
];

/// The run, with whatever strace is to do besides.
fn traced(folder: &Folder, strace: &[&str]) -> Done {
    let words =
        "run flat --for 20m --quiet --force --out sqlite:log.db --out csv:log.csv --truth truth.db --recording r.json";
    let mut command = Command::new("strace");
    command.args(["-f", "-qq"]).args(strace).arg(env!("CARGO_BIN_EXE_homebody")).args(words.split_whitespace());
    Done::new(words, command.current_dir(folder.path("")).output().unwrap())
}

/// Number of calls of one of these kinds after the run has started to make files, and before.
fn calls(folder: &Folder, kinds: &str) -> (usize, usize) {
    traced(folder, &["-o", "calls.trace", "-e", &format!("trace={kinds},openat")]).ok();
    let told = folder.read("calls.trace");
    fs::remove_file(folder.path("calls.trace")).unwrap();
    let names: BTreeSet<&str> = kinds.split(',').collect();
    let of_kind = |line: &str| {
        line.split_once(' ').is_some_and(|(_, call)| names.contains(call.trim_start().split('(').next().unwrap_or("")))
    };
    let begun = told.lines().position(|line| line.contains("flat/scenario.json")).unwrap_or(0);
    let before = told.lines().take(begun).filter(|line| of_kind(line)).count();
    (before, told.lines().filter(|line| of_kind(line)).count())
}

#[test]
fn whichever_call_is_refused_nothing_is_half_written() {
    let can =
        Command::new("strace").args(["-f", "-o", "/dev/null", "true"]).status().is_ok_and(|status| status.success());
    if !can {
        assert_ne!(std::env::var("HOMEBODY_STRACE").as_deref(), Ok("required"), "strace cannot be used here");
        println!("skipped: strace cannot be used here");
        return;
    }
    let asked = std::env::var("HOMEBODY_FAULTS").ok();
    let most = if asked.as_deref() == Some("all") {
        usize::MAX
    } else {
        asked.and_then(|text| text.parse().ok()).unwrap_or(USUAL)
    };
    let folder = flat();
    folder.run("run flat --for 20m --quiet --out csv:whole.csv --truth whole.db").ok();
    let whole = folder.read("whole.csv");
    let mut refused = 0;
    for (kinds, error) in REFUSED {
        let (before, all) = calls(&folder, kinds);
        let each = (all - before).div_ceil(most.min(all - before)).max(1);
        for number in (before + 1..=all).step_by(each) {
            for name in ["log.db", "log.csv", "truth.db", "r.json"] {
                let _ = fs::remove_file(folder.path(name));
            }
            let done = traced(
                &folder,
                &[
                    "-o",
                    "/dev/null",
                    "-e",
                    &format!("trace={kinds}"),
                    "-e",
                    &format!("inject={kinds}:error={error}:when={number}"),
                ],
            );
            let what = format!("{kinds} {number} of {all}: {error}, {:?}: {}", done.code, done.err);
            assert!(!done.err.contains("panicked") && matches!(done.code, Some(0 | 1)), "{what}");
            refused += usize::from(done.code != Some(0));
            if done.code == Some(0) {
                assert!(folder.read("log.csv") == whole, "{what}");
            } else {
                // The message explains the failure.
                assert!(done.err.contains("error: ") || done.err.contains("error["), "{what}");
                assert!(!folder.path("log.csv").exists() || folder.read("log.csv") == whole, "{what}");
            }
            for name in ["log.db", "truth.db"].into_iter().filter(|name| folder.path(name).exists()) {
                assert_eq!(folder.query(name, "PRAGMA integrity_check"), ["ok"], "{what}");
            }
            let left: Vec<String> = folder.files().into_iter().filter(|name| name.contains(".part")).collect();
            assert!(left.is_empty(), "{what} leaves {left:?}");
        }
    }
    println!("{refused} runs ended with an error");
    assert!(refused > 0, "what is refused is noticed");
}
