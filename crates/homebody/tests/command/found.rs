//! Searching a whole log.

use crate::folder::Folder;
use serde_json::Value;
use std::fs;

#[test]
fn finds_intervals_and_refuses_invalid_searches() {
    let folder = Folder::new();
    folder.copy_hand_written_day();
    folder.run("run tigerplace --quiet --for 3d").ok();
    let ask = |words: &str| folder.run(&format!("find runs/tigerplace-1 {words}"));
    let json = |words: &str| ask(&format!("{words} --json")).ok().json()["found"].as_array().unwrap().clone();

    let visits = json("room bathroom --between 0-6");
    let hour = |one: &Value, key: &str| one[key].as_str().unwrap()[11..13].parse::<u32>().unwrap();
    assert!(!visits.is_empty() && visits.iter().all(|one| hour(one, "begin") < 6 && one["words"] == "margaret"));
    let told = ask("room bathroom --between 0-6").ok().out;
    assert!(told.starts_with(&format!("tigerplace-1: room bathroom, between 00:00-06:00: {} times\n", visits.len())));
    let long = json("room bathroom --min-duration 10m");
    assert!(long.iter().all(|one| one["lasts_s"].as_f64().unwrap() >= 600.0));
    assert!(json("doing sleeping --between 12-13").is_empty() && !json("doing sleeping").is_empty());
    assert_eq!((json("fall").len(), json("lost").len()), (0, 0));

    // The log alone tells less, and says so.
    folder.run("convert runs/tigerplace-1 --out csv:alone.csv").ok();
    let alone = folder.run("find alone.csv still --min-duration 30m").ok().out;
    assert!(alone.contains("Nobody knows whether anybody was at home"), "{alone}");
    folder.run("find alone.csv fall").fails(2, "find::needs-truth");

    ask("room batroom").fails(2, "did you mean \"bathroom\"?");
    ask("on").fails(2, "find::no-name");
    ask("room bathroom --between 7-7").fails(2, "is not a range of hours");
    ask("room bathroom --min-duration long").fails(2, "write a number with its unit");
    ask("flying").fails(2, "invalid value");
}

#[test]
fn ignores_a_ground_truth_of_another_run() {
    let folder = Folder::with("tigerplace");
    folder.run("run tigerplace --quiet --for 2d").ok();
    folder.run("run tigerplace --quiet --for 2d --seed 8").ok();
    folder.run("convert runs/tigerplace-1 --out csv:whole.csv").ok();
    let whole = folder.read("whole.csv");
    let rows: Vec<&str> = whole.lines().collect();
    let part: Vec<&str> = rows[..1].iter().chain(&rows[rows.len() / 2..]).copied().collect();
    folder.write("runs/tigerplace-1/part.csv", part.join("\n") + "\n");
    folder.run("convert runs/tigerplace-1 --out casas:runs/tigerplace-1/casas.txt").ok();
    let own = folder.run("find runs/tigerplace-1/log.db doing sleeping").ok();
    for of_same_run in ["part.csv", "casas.txt"] {
        let found = folder.run(&format!("find runs/tigerplace-1/{of_same_run} doing sleeping")).ok();
        assert!(found.out.contains("margaret") && !found.err.contains("ignores"), "{}{}", found.out, found.err);
    }
    fs::copy(folder.path("runs/tigerplace-2/log.db"), folder.path("runs/tigerplace-1/other.db")).unwrap();
    for command in ["find runs/tigerplace-1/other.db room bathroom", "day runs/tigerplace-1/other.db first"] {
        folder.run(command).ok().says(&["it is the ground truth of another run"]);
    }
    assert!(own.out.contains("margaret") && !own.err.contains("ignores"), "{}{}", own.out, own.err);
    folder.run("find runs/tigerplace-1/other.db fall").fails(2, "find::needs-truth");
}
