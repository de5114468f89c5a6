//! Installation lists: devices, parts, sheets, comparison of layouts.

use crate::flat::flat;
use crate::folder::{Folder, ROOT};
use serde_json::json;

#[test]
fn parts_are_listed_in_words_in_figures_and_on_sheets() {
    let folder = flat();
    folder
        .run("install-sheet flat --json parts.json --csv parts.csv --pdf sheet.pdf --svg map.svg")
        .ok()
        .prints(&["KitchenWall", "on the west wall"]);
    let figures = folder.json("parts.json");
    assert_eq!(figures, folder.run("install-sheet flat --json").ok().json());
    assert_eq!(figures["parts"].as_array().unwrap().len(), 5);
    assert_eq!(figures["parts"][0]["looks"], json!("east, straight out from the wall"));
    assert_eq!(folder.read("parts.csv").lines().count(), 6);
    assert!(std::fs::read(folder.path("sheet.pdf")).unwrap().starts_with(b"%PDF-"));
    assert!(folder.read("map.svg").starts_with("<svg"));

    // Nothing is replaced that is there, and nothing is half written.
    folder.run("install-sheet flat --pdf sheet.pdf --csv fresh.csv").fails(1, "sheet.pdf");
    assert!(!folder.path("fresh.csv").exists());
    folder.run("install-sheet flat --pdf flat/home.json --force").fails(1, "home.json");
}

#[test]
fn two_layouts_are_compared() {
    let folder = flat();
    for file in folder.files().into_iter().filter(|file| file.starts_with("flat/")) {
        folder.write(&file.replacen("flat", "other", 1), folder.read(&file));
    }
    folder.edit("other/home.json", "\"at\": [0.05, 1.5]", "\"at\": [0.05, 2.0]");
    folder.run("install-sheet flat --compare other").ok().prints(&["KitchenWall: hangs 0.50 m away"]);
    let figures = folder.run("install-sheet flat --compare other --json").ok().json();
    assert_eq!(figures["differences"].as_array().unwrap().len(), 1);
    assert_eq!(figures["layouts"][1]["name"], json!("other"));
    // The control: a home compared with itself.
    assert_eq!(folder.run("install-sheet flat --compare flat --json").ok().json()["differences"], json!([]));
    folder.run("install-sheet flat --compare nowhere").fails(1, "nowhere");
}

#[test]
fn devices_are_listed_and_placed() {
    let folder = Folder::new();
    let listed = folder.run("devices --json").ok().json();
    let names: Vec<&str> =
        listed["devices"].as_array().unwrap().iter().map(|row| row["name"].as_str().unwrap()).collect();
    assert!(names.contains(&"fibaro") && names.contains(&"paper"), "{names:?}");
    assert!(folder.run("devices fibaro").ok().out.contains("operating manual"));
    folder.run("devices fibro").fails(2, "error[device::unknown]");

    let placed = folder.run(&format!(
        "suggest-sensors {ROOT}/scenarios/studio --goals falls --count 2 --people 4 --device fibaro --json"
    ));
    let sensors = placed.ok().json()["sensors"].clone();
    let motion: Vec<_> = sensors.as_array().unwrap().iter().filter(|sensor| sensor["kind"] == "motion").collect();
    assert!(!motion.is_empty() && motion.iter().all(|sensor| sensor["preset"] == "fibaro"), "{sensors}");
}
