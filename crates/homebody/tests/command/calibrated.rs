//! `homebody fit`: scenarios fitted to the logs of their homes.

use crate::folder::{Files, Folder};
use serde_json::Value;
use std::sync::OnceLock;

/// The end of the line of the sensor in the hallway.
const HALLWAY: &str = r#"[3.6, 2.4], [2.95, 2.4]], "preset": "casas_pulse" }"#;
/// The field of the sensor in the middle of the hallway, half as wide and half as long.
const HALF_AS_FAR: &str = "[[4.425, 1.925], [4.875, 1.925], [4.875, 2.375], [4.425, 2.375]]";

/// A folder with the log of a home with known numbers: six days of units that hold their ONs for three seconds. One of them misses most
/// of the passing people, and one has half the reach. The resident gets up at eight and goes to bed at ten. The folder also has the same
/// home with other numbers.
fn known() -> Folder {
    static FILES: OnceLock<Files> = OnceLock::new();
    Folder::filled_once(&FILES, fill)
}

fn fill(folder: &Folder) {
    folder.run("new known --template older-adult").ok();
    let change = |file: &str, from: &str, to: &str| {
        let text = folder.read(file);
        assert!(text.contains(from), "{file}");
        folder.write(file, text.replace(from, to));
    };
    change("known/logger.json", "\"hold_s\": 4", "\"hold_s\": 3");
    let home = folder.read("known/home.json");
    change("known/home.json", HALLWAY, &HALLWAY.replace(" }", r#", "notice": { "chance": { "missed": 0.6 } } }"#));
    change("known/home.json", "[[4.2, 1.7], [5.1, 1.7], [5.1, 2.6], [4.2, 2.6]]", HALF_AS_FAR);
    folder.write(
        "known/ada.routine",
        "She gets up at 8:00.\nShe goes to bed at 22:00.\nShe leaves the apartment at 15:00 for 2 hours.\n",
    );
    folder.run("run known --for 6d --quiet --out casas:log.txt").ok();
    folder.write("known/home.json", home);
    change("known/logger.json", "\"hold_s\": 3", "\"hold_s\": 9");
    folder.write("known/ada.routine", "She gets up at 5:00.\nShe goes to bed at 20:00.\n");
}

/// The clock time behind some words of a text, in hours.
fn hour_after(text: &str, words: &str) -> f64 {
    let at = text.find(words).unwrap_or_else(|| panic!("{words:?} is not in {text}")) + words.len();
    let (hour, minute) = text[at..at + 5].split_once(':').unwrap();
    hour.parse::<f64>().unwrap() + minute.parse::<f64>().unwrap() / 60.0
}

#[test]
fn the_numbers_of_a_life_that_is_known_are_found_again() {
    let folder = known();
    folder
        .run("fit casas:log.txt --home known --training-days 2011-06-06..2011-06-09 --out fitted")
        .ok()
        .prints(&["test days against"]);
    let logger = folder.json("fitted/logger.json");
    let hold = logger["messages"]["on_off"]["hold_s"].as_f64().unwrap();
    assert!((hold - 3.0).abs() < 0.1, "{hold}");
    let routine = folder.read("fitted/fitted.routine");
    assert!((hour_after(&routine, "She gets up at about ") - 8.0).abs() < 0.75, "{routine}");
    assert!((hour_after(&routine, "She goes to bed at about ") - 22.0).abs() < 0.75, "{routine}");
    assert!(
        (hour_after(&routine, "she leaves the apartment at about ".trim_start_matches("she ")) - 15.0).abs() < 0.75,
        "{routine}"
    );
    let report = folder.json("fitted/report.json");
    let hours = report["measures"].as_array().unwrap().iter().find(|row| row["measure"] == "hours").unwrap();
    let [fitted, before] = ["fitted", "before"].map(|key| hours[key].as_f64().unwrap());
    assert!(fitted < before, "{hours}");
    let lengths = report["measures"].as_array().unwrap().iter().find(|row| row["measure"] == "ON lengths").unwrap();
    assert!(lengths["fitted"].as_f64().unwrap() < 0.3 && lengths["before"].as_f64().unwrap() > 0.6, "{lengths}");
    let sights = report["fitted"]["sights"].as_array().unwrap();
    let of = |name: &str| sights.iter().find(|sight| sight["sensor"] == name).unwrap();
    // With few days, misses and a short reach cannot be distinguished.
    let sees_less = |sight: &Value| sight["missed"].as_f64().unwrap() > 0.3 || sight["reach"].as_f64().unwrap() < 0.8;
    assert!(sees_less(of("hallway")), "{sights:?}");
    assert!(of("hallway middle")["reach"].as_f64().unwrap() < 0.8, "{sights:?}");
    let as_they_were = sights.iter().filter(|sight| sight["reach"] == 1.0 && sight["missed"] == 0.12).count();
    assert!(sights.len() > 10 && as_they_were * 2 > sights.len(), "{sights:?}");
    folder.run("check fitted").ok();
    folder.run("fit casas:log.txt --home known --out fitted").fails(1, "[kit::exists]: fitted");
}

#[test]
fn reports_what_it_cannot_fit_and_writes_nothing() {
    let folder = known();
    folder
        .run("fit casas:log.txt --home known --training-days 2011-06-06..2011-06-07 --out fitted")
        .fails(2, "error[training::few-days]");
    folder
        .run("fit casas:log.txt --home known --training-days 2011-06-06..2011-06-11 --out fitted")
        .fails(2, "error[training::few-days]");
    folder
        .run("fit casas:log.txt --home known --training-days yesterday --out fitted")
        .fails(2, "2016-07-01..2016-07-14");
    folder.run("new couple --template couple-with-cat").ok();
    folder.run("fit casas:log.txt --home couple --out fitted").fails(2, "error[fit::not-alone]");
    assert!(!folder.path("fitted").exists());
}
