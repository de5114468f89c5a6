//! What the command finds out about homes and sensors, as figures and as pictures.

use crate::flat::flat;
use crate::folder::{Folder, ROOT};
use serde_json::{Value, json};

#[test]
fn coverage_is_told_and_drawn() {
    let folder = flat();
    let done = folder.run("coverage flat --json figures.json --svg map.svg --png map.png --width 400").ok();
    assert!(done.out.contains("kitchen") && done.out.contains("study"), "{}", done.out);
    let figures: Value = serde_json::from_str(&folder.read("figures.json")).unwrap();
    assert_eq!(figures, folder.run("coverage flat --json").ok().json());
    let names = |key: &str| {
        let all = figures[key].as_array().unwrap();
        all.iter().map(|one| one["name"].as_str().unwrap().to_string()).collect::<Vec<_>>()
    };
    assert_eq!(names("rooms"), ["kitchen", "bedroom", "study"]);
    assert_eq!(names("sensors"), ["KitchenWall", "KitchenFloor", "BedroomWall", "BedroomFloor", "StudyFloor"]);
    for floor in figures["rooms"].as_array().unwrap().iter().chain([&figures["whole"]]) {
        let shares: f64 = floor["seen_by"].as_object().unwrap().values().map(|share| share.as_f64().unwrap()).sum();
        assert!((shares - 1.0).abs() < 1e-9 && floor["floor_m2"].as_f64().unwrap() > 5.0, "{floor}");
    }
    assert!(folder.read("map.svg").starts_with("<svg"));
    let png = std::fs::read(folder.path("map.png")).unwrap();
    // The width is in the header's first chunk.
    assert!(png.starts_with(b"\x89PNG") && png[16..20] == 400_u32.to_be_bytes());

    // With its sensor moved out of it, the study goes dark.
    assert!(figures["rooms"][2]["seen_by"]["none"].as_f64().unwrap() < 0.5);
    folder.edit(
        "flat/home.json",
        "[[8.5, 0.5], [10.5, 0.5], [10.5, 2.5], [8.5, 2.5]]",
        "[[6.5, 0.5], [7.5, 0.5], [7.5, 2.5], [6.5, 2.5]]",
    );
    let dark = folder.run("coverage flat --json").ok().json();
    assert_eq!(dark["rooms"][2]["seen_by"]["none"], json!(1.0));
    assert_eq!(dark["dead_zones"][0]["room"], json!("study"));
}

#[test]
fn a_home_is_drawn() {
    let folder = flat();
    let done = folder.run("plan flat --svg plan.svg --png plan.png --width 300").ok();
    assert_eq!(done.out, "");
    let svg = folder.read("plan.svg");
    assert!(svg.starts_with("<svg") && svg.contains("kitchen") && svg.contains("study"));
    let png = std::fs::read(folder.path("plan.png")).unwrap();
    assert!(png.starts_with(b"\x89PNG") && png[16..20] == 300_u32.to_be_bytes());
}

#[test]
fn the_shipped_homes_are_covered() {
    let folder = Folder::new();
    // The hall's sensor of the house hangs beyond a door that is shut.
    for (name, rooms, sensors, unseen) in [("tigerplace", 6, 16, 0.1), ("sphere-house", 9, 9, 0.15)] {
        let json = folder.run(&format!("coverage {ROOT}/scenarios/{name} --json")).ok().json();
        let count = |key: &str| json[key].as_array().unwrap().len();
        assert_eq!((count("rooms"), count("sensors")), (rooms, sensors), "{name}");
        assert!(json["whole"]["seen_by"]["none"].as_f64().unwrap() < unseen, "{name}");
    }
}

#[test]
fn the_papers_experiment_loses_nothing_at_any_speed() {
    let folder = Folder::new();
    let done = folder.run("experiment godsey2009 --json --svg figure.svg").ok();
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
fn generated_people_are_held_against_published_figures() {
    let folder = Folder::new();
    let words = "experiment daily-life --people 3 --days 3 --seed 7";
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
    let fewer = folder.run("experiment daily-life --people 2 --days 3 --seed 7 --json").ok().json();
    assert_eq!(fewer["persons"].as_array().unwrap()[..], json["persons"].as_array().unwrap()[..2]);
    let others = folder.run("experiment daily-life --people 2 --days 3 --seed 8 --json").ok().json();
    assert_ne!(fewer["persons"], others["persons"]);
}

/// A minute in the kitchen, as the SPHERE challenge has it.
fn record(folder: &Folder, name: &str) {
    for (file, what) in [("location_0", "kitchen"), ("annotations_0", "a_walk"), ("pir", "kitchen")] {
        folder.write(&format!("data/{name}/{file}.csv"), format!("start,end,name,index\n10,70,{what},0\n"));
    }
}

#[test]
fn recordings_of_a_real_house_are_walked_again() {
    let folder = Folder::new();
    folder.run("experiment sphere --data .").fails(1, "error[experiment::no-recordings]");
    record(&folder, "00001");
    let done = folder.run("experiment sphere --data data --json=figures.json --svg rooms.svg").ok();
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
    let words = "experiment sphere --data data --house sphere-house/other.json";
    let same = folder.run(&format!("{words} --json")).ok().json();
    assert_eq!(same, json);
    folder.edit(
        "sphere-house/home.json",
        "\"kind\": \"motion\", \"name\": \"kitchen\"",
        "\"kind\": \"motion\", \"name\": \"K1\"",
    );
    folder.run(words).fails(2, "error[sphere::");

    folder.write("data/00001/pir.csv", "start,end,name,index\nx,70,kitchen,0\n");
    folder.run("experiment sphere --data data").fails(2, "pir.csv:2:1: error[sphere::");
}

#[test]
fn a_picture_that_cannot_be_drawn_leaves_no_file() {
    let folder = Folder::new();
    (0..8).for_each(|number| record(&folder, &number.to_string()));
    let given = folder.files();
    let words = "experiment sphere --data data --json=figures.json --svg rooms.svg --png rooms.png --width 8000";
    folder.run(words).fails(2, "error[picture::size]");
    assert_eq!(folder.files(), given);
}

#[test]
fn a_log_is_held_against_another() {
    let folder = Folder::new();
    folder.copy_scenario("older-adult");
    for (seed, log) in [(1, "a.txt"), (2, "b.txt")] {
        folder.run(&format!("run older-adult --for 9d --seed {seed} --quiet --out casas:{log}")).ok();
    }
    let done = folder.run("realism a.txt b.txt --json figures.json --html page.html --svg hours.svg").ok();
    assert!(done.out.contains("gaps ") && done.out.contains("Hours are told apart by"), "{}", done.out);
    let figures: Value = serde_json::from_str(&folder.read("figures.json")).unwrap();
    assert_eq!(figures, folder.run("realism a.txt b.txt --json").ok().json(), "the same logs give the same figures");
    for name in ["gaps_ks", "on_ks", "hours_js", "shares_js", "firings_ks", "auc_days", "auc_hours"] {
        let of = |key: &str| figures[name][key].as_f64();
        assert!(of("value").is_some_and(|value| (0.0..=1.0).contains(&value)), "{name}: {}", figures[name]);
        assert!(of("floor").is_some() || name == "auc_days", "{name}: {}", figures[name]);
    }
    // Two seeds of one life are as near as its own halves, in what a few days can tell.
    assert!(figures["gaps_ks"]["value"].as_f64().unwrap() < 0.1, "{figures}");
    let page = folder.read("page.html");
    assert!(page.starts_with("<!doctype html>") && page.matches("<svg").count() == 3, "three pictures");
    assert!(!page.contains("src=") && !page.contains("href=\"http"), "the page needs no other file");
    assert!(folder.read("hours.svg").starts_with("<svg"));

    let refused = folder.run("realism a.txt b.txt --html page.html");
    assert!(refused.err.contains("--force"), "{}", refused.err);
    folder.write("door.csv", "time,sensor,value\n2011-06-06 08:00:00,door,OPEN\n2011-06-06 09:00:00,door,CLOSE\n");
    let wrong = folder.run("realism door.csv door.csv");
    assert_eq!((wrong.code, wrong.err.matches("[realism::no-motion-sensors]").count()), (Some(2), 2), "{}", wrong.err);
}

#[test]
fn what_is_lived_is_possible() {
    let folder = Folder::new();
    let possible = |asked: &str| {
        let possible = folder.run(&format!("experiment possible {asked} --json")).ok().json();
        let rows = possible["scenarios"].as_array().unwrap().clone();
        for row in &rows {
            let counts = ["on_one_spot", "through_somebody", "eaten_uncooked", "ends_before_it_begins"];
            assert!(counts.iter().all(|count| row[count] == 0) && row["visiting_nobody_s"] == 0.0, "{row}");
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
    folder.run("experiment possible nowhere").fails(1, "nowhere: there is no such scenario");
}
