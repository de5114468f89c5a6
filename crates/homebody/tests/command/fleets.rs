//! Fleets: a home has the same rows as alone, reports count right, and impossible fleets are refused at once.

use crate::folder::{Folder, says};
use serde_json::Value;
use std::collections::BTreeMap;

/// The rows of each home, without the home.
fn by_home(lines: &str) -> BTreeMap<String, Vec<Value>> {
    let mut homes: BTreeMap<String, Vec<Value>> = BTreeMap::new();
    for line in lines.lines() {
        let mut row: Value = serde_json::from_str(line).unwrap();
        let home = row.as_object_mut().unwrap().remove("home").unwrap();
        homes.entry(home.as_str().unwrap().into()).or_default().push(row);
    }
    homes
}

#[test]
fn each_home_says_what_it_says_alone_and_the_report_counts_it() {
    let folder = Folder::with("studio");
    folder.copy_scenario("tigerplace");
    // At 1000 times the speed of real time, more than an hour.
    let fast = "--start 2026-11-01T08:00 --speed 1000";
    let all = folder.run(&format!(
        "fleet studio tigerplace --homes 4 {fast} --for 6s --out jsonl:all.jsonl --report report.jsonl --report-every 1s --list homes.csv --json"
    ));
    let report: Value = serde_json::from_str(&all.ok().out).unwrap();
    let alone =
        folder.run(&format!("fleet studio tigerplace --homes 1 --first-home 3 {fast} --for 5s --out jsonl:- --quiet"));
    let (all, alone) = (by_home(&folder.read("all.jsonl")), by_home(&alone.ok().out));
    assert_eq!(all.keys().collect::<Vec<_>>(), ["home00001", "home00002", "home00003", "home00004"]);
    let (here, there) = (&all["home00003"], &alone["home00003"]);
    let both = here.len().min(there.len());
    assert!(both > 10 && alone.len() == 1);
    assert_eq!(here[..both], there[..both]);
    // The control: its neighbour of the same scenario lives otherwise.
    assert_ne!(all["home00001"][..10], there[..10]);
    assert!(here.iter().zip(0..).all(|(row, seq)| row["seq"] == seq));

    let rows: usize = all.values().map(Vec::len).sum();
    assert_eq!((&report["messages"], &report["timed"]), (&rows.into(), &rows.into()));
    assert_eq!((&report["is_last"], &report["homes_in_all"]), (&true.into(), &4.into()));
    let reports: Vec<Value> =
        folder.read("report.jsonl").lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert!(reports.len() >= 3 && reports.last() == Some(&report));
    let list = folder.read("homes.csv");
    assert_eq!(list.lines().count(), 5);
    assert!(list.lines().nth(2).unwrap().starts_with("home00002,tigerplace,"), "{list}");
}

/// The same command completes the file of a killed fleet. Another fleet leaves that file alone.
#[test]
fn the_same_command_adds_to_the_rows_of_a_fleet() {
    let folder = Folder::with("tigerplace");
    let fleet = |seconds: u32, more: &str| {
        folder.run(&format!(
            "fleet tigerplace --homes 2 --start 2026-11-01T08:00 --speed 1000 --for {seconds}s --out jsonl:all.jsonl --quiet{more}"
        ))
    };
    fleet(3, "").ok();
    let whole = folder.read("all.jsonl");
    // Cut in the middle of a line, as a kill leaves it.
    let cut = whole.len() / 2;
    assert!(whole.as_bytes()[cut - 1] != b'\n' && whole.lines().count() > 100);
    folder.write("all.jsonl", &whole[..cut]);
    let other = fleet(3, " --seed 7");
    assert!(other.code == Some(1) && other.err.contains("error[destination::other-homes]"), "{}", other.err);
    assert!(other.err.contains("hint: pass --force to replace the file"), "{}", other.err);
    assert_eq!(folder.read("all.jsonl"), &whole[..cut]);
    fleet(4, "").ok();
    let after = folder.read("all.jsonl");
    assert!(after.len() >= whole.len() && after.starts_with(&whole), "{} of {}", after.len(), whole.len());
    // A fleet that ends before it has made all rows again leaves the rest.
    fleet(1, "").ok();
    assert_eq!(folder.read("all.jsonl"), after);
    fleet(1, " --seed 7 --force").ok();
    assert_ne!(folder.read("all.jsonl")[..300], after[..300]);
}

#[test]
fn refuses_impossible_fleets_before_they_begin() {
    let folder = Folder::with("studio");
    let done = folder.run("fleet studio --homes 3 --out csv:a.csv --out sqlite:b.db --out jsonl:c.jsonl");
    assert_eq!(done.code, Some(2));
    says(&done.err, &["csv:a.csv has no room", "sqlite:b.db has no room", "jsonl:FILE", "postgresql://"]);
    folder.write("c.jsonl", "mine");
    let done = folder.run("fleet studio --homes 3 --out jsonl:c.jsonl");
    assert!(done.code == Some(1) && done.err.contains("--force"), "{}", done.err);
    assert_eq!(folder.read("c.jsonl"), "mine");
    for (words, why) in [
        ("--homes 0 --out jsonl:-", "0"),
        ("--homes 100000 --out jsonl:-", "99999"),
        ("--homes 3", "--out"),
        ("--homes 3 --out jsonl:- --json", "standard output"),
        ("--homes 3 --out jsonl:- --outages often", "every 5min for 30s"),
        ("--homes 3 --out jsonl:- --churn much", "stay 30min gone 5min"),
        ("--homes 2 --first 99999 --out jsonl:-", "from 1 to 99999"),
        ("--homes 2 --without gout --out jsonl:-", "gout"),
    ] {
        let done = folder.run(&format!("fleet studio {words}"));
        assert!(done.code == Some(2) && done.err.contains(why), "{words}: {}", done.err);
    }
    let files = folder.files();
    assert!(files.iter().all(|file| file.starts_with("studio/") || file == "c.jsonl"), "{files:?}");
}

#[test]
fn a_signal_ends_a_fleet_with_its_report() {
    let folder = Folder::with("studio");
    let fleet = folder.start("fleet studio --homes 20 --out jsonl:a.jsonl --report report.jsonl --report-every 1s");
    folder.until("it reports", |folder| folder.path("report.jsonl").is_file());
    fleet.signal("INT");
    let done = fleet.finish();
    assert_eq!(done.code, Some(130), "{}", done.err);
    assert!(done.err.contains("total "), "{}", done.err);
    assert!(folder.read("report.jsonl").lines().last().unwrap().contains("\"is_last\":true"));
}
