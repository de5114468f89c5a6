//! Figures and pictures of homes and sensors.

use crate::flat::flat;
use crate::folder::{Folder, ROOT};
use serde_json::json;

#[test]
fn coverage_is_told_and_drawn() {
    let folder = flat();
    folder
        .run("coverage flat --json figures.json --svg map.svg --png map.png --width 400")
        .ok()
        .prints(&["kitchen", "study"]);
    let figures = folder.json("figures.json");
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
fn a_log_is_held_against_another() {
    let folder = Folder::with("older-adult");
    for (seed, log) in [(1, "a.txt"), (2, "b.txt")] {
        folder.run(&format!("run older-adult --for 9d --seed {seed} --quiet --out casas:{log}")).ok();
    }
    folder
        .run("realism a.txt b.txt --json figures.json --html page.html --svg hours.svg")
        .ok()
        .prints(&["gaps ", "Hours are told apart by"]);
    let figures = folder.json("figures.json");
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
