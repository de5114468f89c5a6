//! The experiments from end to end, as people and scripts run them.
#![cfg(unix)]
#![allow(dead_code, reason = "what tests of several programs share is used in part by each")]

#[path = "../../homebody/tests/command/folder.rs"]
mod folder;
#[path = "../../homebody/tests/command/noted_log.rs"]
mod noted_log;

use folder::{Done, Folder};
use noted_log::noted;
use serde_json::{Value, json};

#[test]
fn the_experiment_of_the_paper_loses_nothing_at_any_speed() {
    let folder = Folder::new();
    let done = folder.run("godsey2009 --json --svg figure.svg").ok();
    let json = done.json();
    let activities = json["activities"].as_array().unwrap();
    let of = |key: &str| activities.iter().map(|activity| activity[key].as_f64().unwrap()).collect::<Vec<_>>();
    assert_eq!(of("distance_m"), [1.524, 3.048, 1.524, 3.048, 1.524, 3.048]);
    assert_eq!(of("speed_mps"), [0.5, 0.5, 1.0, 1.0, 2.0, 2.0]);
    let firings: f64 = of("firings").iter().sum();
    assert_eq!(json["firings"].as_f64(), Some(firings));
    // The paper counted 230 in the real room.
    assert_eq!(json["published"]["firings"], json!(230));
    let agreement = 1.0 - (firings - 230.0).abs() / 230.0;
    assert!((json["agreement"].as_f64().unwrap() - agreement).abs() < 1e-9, "{json}");
    let by_seed = &json["firings_by_seed"];
    assert!(by_seed[0].as_f64() <= Some(firings) && by_seed[1].as_f64() >= Some(firings), "{by_seed}");
    let speeds = json["speeds"].as_array().unwrap();
    let speeds_of = |key: &str| speeds.iter().map(|speed| speed[key].as_u64().unwrap()).collect::<Vec<_>>();
    assert_eq!(speeds_of("speed"), [1, 5, 10, 50, 100]);
    assert!(speeds_of("lost").iter().chain(&speeds_of("gained")).all(|&count| count == 0), "{speeds:?}");
    // The paper's own loop does not manage that.
    assert!(speeds_of("paper_loop_lost").iter().chain(&speeds_of("paper_loop_gained")).any(|&count| count > 0));
    assert!(folder.read("figure.svg").starts_with("<svg") && folder.read("figure-totals.svg").starts_with("<svg"));
}

#[test]
fn simulated_people_are_compared_with_published_figures() {
    let folder = Folder::new();
    let words = "daily-life --people 3 --days 3 --seed 7";
    let done = folder.run(&format!("{words} --json=figures.json --svg people.svg")).ok();
    let text = folder.read("figures.json");
    let json: Value = serde_json::from_str(&text).unwrap();
    assert_eq!((&json["people"], &json["days"], &json["seed"]), (&json!(3), &json!(2), &json!(7)));
    let lines = json["lines"].as_array().unwrap();
    let (_, outside) =
        done.out.split_once("Outside, and why that may be").expect("three days are too few for all norms");
    for line in lines {
        let named = outside.contains(&format!("  {}: ", line["what"].as_str().unwrap()));
        assert_eq!(named, line["inside"] == json!(false), "{line}");
        if let (Some(range), Some(ours)) = (line["range"].as_array(), line["ours"].as_f64()) {
            let is_inside = (range[0].as_f64()..=range[1].as_f64()).contains(&Some(ours));
            assert_eq!(line["inside"], json!(is_inside), "{line}");
        }
    }
    for person in json["persons"].as_array().unwrap() {
        let hours: f64 = person["days"]["hours"].as_array().unwrap().iter().map(|hours| hours.as_f64().unwrap()).sum();
        assert!((hours - 24.0).abs() < 1e-6, "{person}");
    }
    assert!(folder.read("people.svg").starts_with("<svg") && folder.read("people-hours.svg").starts_with("<svg"));

    // However many threads there are, the same people live the same days; the first two do among fewer, too.
    folder.run(&format!("{words} --json=again.json")).ok();
    assert_eq!(folder.read("again.json"), text);
    let fewer = folder.run("daily-life --people 2 --days 3 --seed 7 --json").ok().json();
    assert_eq!(fewer["persons"].as_array().unwrap()[..], json["persons"].as_array().unwrap()[..2]);
    let others = folder.run("daily-life --people 2 --days 3 --seed 8 --json").ok().json();
    assert_ne!(fewer["persons"], others["persons"]);
}

/// A minute in the kitchen, as the SPHERE challenge has it.
fn record(folder: &Folder, name: &str) {
    for (file, what) in [("location_0", "kitchen"), ("annotations_0", "a_walk"), ("pir", "kitchen")] {
        folder.write(&format!("data/{name}/{file}.csv"), format!("start,end,name,index\n10,70,{what},0\n"));
    }
}

#[test]
fn recordings_of_a_real_house_are_simulated() {
    let folder = Folder::new();
    folder.run("sphere --data .").fails(1, "error[experiment::no-recordings]");
    record(&folder, "00001");
    let done = folder.run("sphere --data data --json=figures.json --svg rooms.svg").ok();
    assert!(done.out.contains("1 recordings, 1 minutes annotated"), "{}", done.out);
    let json: Value = serde_json::from_str(&folder.read("figures.json")).unwrap();
    let kitchen = json["rooms"].as_array().unwrap().iter().find(|room| room["room"] == "kitchen").unwrap();
    assert_eq!((&kitchen["visits"], &kitchen["simulated"]["visits_seen"]), (&json!(1), &json!(1)), "{kitchen}");
    assert_eq!(json["by_recording"][0]["name"], json!("00001"));
    let svg = folder.read("rooms.svg");
    assert!(svg.starts_with("<svg") && svg.contains("recording 00001"));

    // Another model of the house, by the name of its file.
    folder.copy_scenario("sphere-house");
    std::fs::rename(folder.path("sphere-house/scenario.json"), folder.path("sphere-house/other.json")).unwrap();
    let words = "sphere --data data --house sphere-house/other.json";
    let same = folder.run(&format!("{words} --json")).ok().json();
    assert_eq!(same, json);
    folder.edit(
        "sphere-house/home.json",
        "\"kind\": \"motion\", \"name\": \"kitchen\"",
        "\"kind\": \"motion\", \"name\": \"K1\"",
    );
    folder.run(words).fails(2, "error[sphere::");

    folder.write("data/00001/pir.csv", "start,end,name,index\nx,70,kitchen,0\n");
    folder.run("sphere --data data").fails(2, "pir.csv:2:1: error[sphere::");
}

#[test]
fn a_picture_that_cannot_be_drawn_leaves_no_file() {
    let folder = Folder::new();
    (0..8).for_each(|number| record(&folder, &number.to_string()));
    let given = folder.files();
    let words = "sphere --data data --json=figures.json --svg rooms.svg --png rooms.png --width 8000";
    folder.run(words).fails(2, "error[picture::size]");
    assert_eq!(folder.files(), given);
}

#[test]
fn simulations_have_no_impossible_events() {
    let folder = Folder::new();
    let possible = |asked: &str| {
        let possible = folder.run(&format!("possible {asked} --json")).ok().json();
        let rows = possible["scenarios"].as_array().unwrap().clone();
        for row in &rows {
            assert!(row["impossible"].as_object().unwrap().is_empty(), "{row}");
        }
        rows
    };
    assert!(possible("--days 4").len() >= 6, "all templates");
    // Several meet where there are visits, of which some are rare.
    folder.copy_scenario("couple-with-cat");
    folder.copy_scenario("tigerplace");
    let visits: Vec<_> =
        possible("couple-with-cat tigerplace --days 40").iter().map(|row| row["visits"].as_u64()).collect();
    assert!(visits[0] >= Some(17) && visits[1] >= Some(1), "{visits:?}");
    folder.run("possible nowhere").fails(1, "nowhere: there is no such scenario");
}

#[test]
fn logs_of_real_homes_are_compared_with_noted_activities() {
    let folder = Folder::new();
    folder.write("noted.txt", noted("Leaving_home"));
    let real = folder.run("measures --data noted.txt --json").ok().json();
    let errors = real["logs"][0]["errors"].as_array().unwrap();
    for (measure, truly) in [("time_out", 3.0), ("time_in_bed", 8.0)] {
        let error = errors.iter().find(|error| error["measure"] == measure).unwrap();
        let [mean, apart] = ["mean_true", "mean_error"].map(|name| error[name].as_f64().unwrap());
        assert!((mean - truly).abs() < 0.01 && apart < 0.01, "{error}");
    }
    folder.write("noted.txt", noted("Gardening").replace("Sleep", "Reading"));
    folder.run("measures --data noted.txt").fails(2, "error[experiment::no-activities]");
    folder.run("measures --data noted.txt --homes 3").fails(2, "cannot be used with");
}

#[test]
fn no_experiment_begins_if_its_output_exists() {
    let folder = Folder::new();
    folder.write("figure-totals.svg", "precious");
    folder.run("godsey2009 --svg figure.svg").fails(1, "[log::exists]: figure-totals.svg");
    assert!(!folder.path("figure.svg").exists());
}

#[test]
fn an_experiment_without_threads_fails() {
    let folder = Folder::new();
    let mut experiment = folder.command("daily-life --people 2 --days 2");
    let output = experiment.env("RUST_MIN_STACK", (1_u64 << 46).to_string()).output().unwrap();
    Done::new("daily-life", output).fails(1, "::no-threads]");
}

#[test]
fn messages_of_experiments_are_explained() {
    let folder = Folder::new();
    assert!(folder.run("explain experiment::no-data").ok().out.contains("published data sets"));
    assert!(folder.run("explain sphere").ok().out.lines().count() > 3);
    folder.run("explain log::exists").fails(2, "error[explain::unknown-code]");
}
