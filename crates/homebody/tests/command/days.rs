//! Density maps and single days of logs, as text and as pictures.

use crate::flat::flat;
use crate::folder::{Files, Folder, says};
use serde_json::{Value, json};
use std::sync::OnceLock;

/// Two days of the apartment of the README, in its run's folder.
fn two_days() -> Folder {
    static FILES: OnceLock<Files> = OnceLock::new();
    Folder::filled_once(&FILES, |folder| {
        folder.copy_hand_written_day();
        folder.run("run tigerplace --quiet --for 2d").ok();
    })
}

#[test]
fn a_density_map_is_told_drawn_and_tabled() {
    let folder = two_days();
    let words = "density runs/tigerplace-1 --json figures.json --svg map.svg --png map.png --csv hours.csv --width 400";
    let done = folder.run(words).ok();
    says(
        &done.out,
        &["2 days, 2009-03-02 to 2009-03-03", "Entrance: front door motion, by name", "2009-03-02 09:56", "Texture"],
    );
    let figures = folder.json("figures.json");
    assert_eq!(figures, folder.run("density runs/tigerplace-1 --json").ok().json());
    // The run's own truth: she is out from 09:56 to 12:05.
    let absences = figures["absences"].as_array().unwrap();
    let hour = |absence: &Value, key: &str| absence[key].as_str().unwrap()[11..16].to_owned();
    let told: Vec<_> = absences.iter().map(|absence| (hour(absence, "begin"), hour(absence, "end"))).collect();
    assert_eq!(told, [("09:56".into(), "12:05".into()), ("09:56".into(), "12:05".into())]);
    assert_eq!((&figures["recorded_h"], figures["days"].as_array().unwrap().len()), (&json!(48.0), 2));

    let rows: Vec<Vec<String>> =
        folder.read("hours.csv").lines().map(|line| line.split(',').map(String::from).collect()).collect();
    assert_eq!((rows[0].join(","), rows.len()), ("date,hour,events,athome_h,density".into(), 49));
    let events: u64 = rows[1..].iter().map(|row| row[2].parse::<u64>().unwrap()).sum();
    let firings = folder.query("runs/tigerplace-1/log.db", "SELECT count(*) FROM event WHERE sensor_id < 'C'");
    assert_eq!((events.to_string(), figures["events"].to_string()), (firings[0].clone(), firings[0].clone()));
    assert_eq!(rows[12], ["2009-03-02", "11", "0", "0.0000", ""], "an hour away has no density");

    assert!(folder.read("map.svg").starts_with("<svg"));
    let png = std::fs::read(folder.path("map.png")).unwrap();
    assert!(png.starts_with(b"\x89PNG") && png[16..20] == 400_u32.to_be_bytes());
}

#[test]
fn two_maps_are_held_against_each_other() {
    let folder = two_days();
    let same = folder.run("density runs/tigerplace-1 --compare runs/tigerplace-1 --json").ok().json();
    assert_eq!(same["against"]["distance"], json!(0.0));
    folder.run("run tigerplace --quiet --for 14d --seed 3 --out csv:other.csv").ok();
    let words = "density runs/tigerplace-1 --compare other.csv --door A11 --json=both.json --svg both.svg";
    folder.run(words).ok().prints(&["apart: 0 is alike", "the weeks of other.csv"]);
    let both = folder.json("both.json");
    let distance = both["against"]["distance"].as_f64().unwrap();
    assert!(distance > 0.0 && distance < 1.0, "{distance}");
    // Fourteen days, on one of which clocks go forward.
    assert!(folder.read("both.svg").contains("other.csv, 2009-03-02 to 2009-03-15"));
}

#[test]
fn a_part_of_a_log_is_asked_for() {
    let folder = two_days();
    let part = folder.run("density runs/tigerplace-1 --from 2009-03-03 --days 5 --json").ok().json();
    assert_eq!((&part["from"], part["days"].as_array().unwrap().len()), (&json!("2009-03-03"), 1));
    // Three hours are longer than any absence.
    let none = folder.run("density runs/tigerplace-1 --from first --away-after 3h --json").ok().json();
    assert_eq!(none["absences"], json!([]));
    let said = folder
        .run("density runs/tigerplace-1 --door hall --door 'kitchen --from 2012-01-01")
        .fails(2, "error[density::no-door]: --door \"hall\"")
        .err;
    says(
        &said,
        &[
            "error[density::no-door]: --door \"'kitchen\"",
            "error[log-content::no-day]",
            "from 2009-03-02 to 2009-03-03",
            "3 problems",
        ],
    );
}

#[test]
fn a_day_is_told_and_drawn() {
    let folder = two_days();
    let done = folder.run("day runs/tigerplace-1 last --json day.json --svg day.svg --png day.png").ok();
    says(
        &done.out,
        &["tigerplace-1: Tuesday 2009-03-03", "First:", "margaret", "09:56-12:05  away", "front door motion", "hour"],
    );
    let day = folder.json("day.json");
    assert_eq!(day, folder.run("day runs/tigerplace-1 2009-03-03 --json").ok().json());
    let sql = "SELECT count(*) FROM event WHERE ts_local >= '2009-03-03' AND ts_local < '2009-03-04' AND event_code IN ('ON', 'IN')";
    assert_eq!(day["firings"].to_string(), folder.query("runs/tigerplace-1/log.db", sql)[0]);
    let margaret = &day["residents"][0];
    let bedroom = &margaret["rooms"][0];
    assert_eq!((&bedroom["what"], &bedroom["begin_s"]), (&json!("bedroom"), &json!(0.0)), "she sleeps at midnight");
    let svg = folder.read("day.svg");
    assert!(svg.starts_with("<svg") && svg.contains("television") && svg.contains("laundry closet motion"));
}

#[test]
fn a_day_of_a_run_on_which_nothing_was_said_is_one_of_its_days() {
    let folder = Folder::with("by-hand");
    folder.run("run by-hand --quiet --for 2d").ok();
    folder.run("day runs/by-hand-1 last").ok().prints(&["Wednesday 2026-01-07, 0 firings of 3 sensors"]);
    let part = folder.run("density runs/by-hand-1 --from 2026-01-06 --json").ok().json();
    assert_eq!((&part["days"][0]["date"], &part["days"][0]["recorded_h"]), (&json!("2026-01-06"), &json!(24.0)));
}

#[test]
fn a_log_alone_is_enough() {
    let folder = Folder::new();
    folder.write(
        "home.txt",
        "2009-03-02 07:12:03 M1 ON Cook begin\n2009-03-02 07:12:09 M1 OFF\n2009-03-02 08:00:00 D1 OPEN Cook end\n",
    );
    let done = folder.run("day home.txt first").ok();
    says(&done.out, &["home.txt: Monday 2009-03-02, 2 firings of 2 sensors", "07:12-08:00  Cook"]);
    assert!(folder.run("density home.txt").ok().out.contains("Entrance: D1"));
    // UTC is put on the wall of the home.
    folder.write("utc.csv", "time,sensor,value\n2009-03-02T03:00:00Z,M1,ON\n2009-03-02T03:00:05Z,M1,OFF\n");
    let there = folder.run("day utc.csv first --time-zone America/Chicago --json").ok();
    assert_eq!((&there.json()["date"], &there.json()["first"]["at"]), (&json!("2009-03-01"), &json!("21:00:00")));
    assert!(folder.run("day utc.csv first").ok().err.contains("--time-zone sets the home's own"));
}

#[test]
fn a_day_or_a_log_that_is_not_there_is_refused() {
    let folder = flat();
    folder.run("run flat --quiet").ok();
    folder.write("room.txt", "2009-03-02 07:12:03 T1 21.5\n");
    folder.write("nonsense.txt", "nonsense\n");
    folder.write("empty.txt", "");
    let given = folder.files();
    for (words, code, said) in [
        ("day runs/flat-1 2009-03-05", 2, "error[log-content::no-day]"),
        ("day runs/flat-1 2009-02-30", 2, "write a date such as 2009-03-02, or the word first or last"),
        ("day runs/flat-1 monday", 2, "write a date such as 2009-03-02, or the word first or last"),
        ("day runs/flat-1", 2, "required arguments were not provided"),
        ("day nowhere first", 1, "[log::not-found]: nowhere"),
        ("day nonsense.txt first", 2, "error[log-form::unknown]"),
        ("day empty.txt first", 2, "error[log-form::empty]"),
        ("day runs/flat-1 first --time-zone Mars/Olympus", 2, "Mars/Olympus"),
        ("density nowhere", 1, "[log::not-found]: nowhere"),
        ("density room.txt", 2, "error[measure::no-motion-sensors]"),
        ("density empty.txt", 2, "error[log-form::empty]"),
        ("density runs/flat-1 --days 0", 2, "1..=3660"),
        ("density runs/flat-1 --away-after 30", 2, "write a number with its unit"),
        ("density runs/flat-1 --from 2", 2, "write a date"),
        ("density runs/flat-1 --compare nowhere", 1, "[log::not-found]: nowhere"),
        ("density runs/flat-1 --csv a.txt --svg a.txt", 2, "log::same-file"),
        ("density runs/flat-1 --csv runs/flat-1/log.db --force", 1, "log::is-source"),
        ("density room.txt --compare runs/flat-1 --csv runs/flat-1/log.db --force", 1, "log::is-source"),
        ("density runs/flat-1 --svg runs/flat-1/recording.json --force", 1, "log::is-source"),
        ("day runs/flat-1 first --png runs/flat-1/truth.db --force", 1, "log::is-source"),
    ] {
        folder.run(words).fails(code, said);
    }
    assert_eq!(folder.files(), given);
}

#[test]
fn days_that_were_asked_for_are_days_of_the_map() {
    let folder = flat();
    // A walk every quarter of an hour: only the days count here, not their rows.
    folder.edit("flat/ann.path.json", "\"for_s\": 5,", "\"for_s\": 900,");
    // Clocks go forward on 2009-03-08 in Chicago and back on 2009-11-01; Berlin is three weeks later, and a week earlier.
    for (begin, zone) in [
        ("2009-03-07", "America/Chicago"),
        ("2009-10-31", "America/Chicago"),
        ("2009-03-28", "Europe/Berlin"),
        ("2009-10-24", "Europe/Berlin"),
    ] {
        let scenario = folder.json("flat/scenario.json");
        let changed =
            json!({ "start": format!("{begin}T00:00:00"), "time_zone": zone, "days": 2, "residents": ["ann.json"] });
        let scenario = [scenario, changed].into_iter().flat_map(|part| part.as_object().unwrap().clone());
        folder.write("flat/scenario.json", Value::Object(scenario.collect()).to_string());
        for span in ["", "--for 2d", "--for 48h"] {
            let words = format!("run flat {span} --out csv:a.csv --recording recording.json --force --quiet");
            folder.run(&words).ok();
            let said = folder.run("density a.csv --json").ok().json();
            let from_march = begin.contains("-03-");
            // By the clock, 48 hours from midnight end at one o'clock or at eleven.
            let days = if span == "--for 48h" && from_march { 3 } else { 2 };
            assert_eq!(said["days"].as_array().map(Vec::len), Some(days), "{begin} in {zone}, {span}");
            let recording = folder.json("recording.json");
            let hours = recording["length_us"].as_i64().unwrap() / 3_600_000_000;
            let by_calendar = if from_march { 47 } else { 49 };
            assert_eq!(hours, if span == "--for 48h" { 48 } else { by_calendar });
        }
    }
}

#[test]
fn a_cohort_is_no_log_and_its_members_are() {
    let folder = flat();
    folder.run("run flat --members 2 --for 1m --quiet").ok();
    for command in ["density", "compare runs/flat-1/0001", "convert --out csv:a.csv"] {
        let hint = "each member has its own log\n  hint: name a member, such as runs/flat-1/0001";
        folder.run(&format!("{command} runs/flat-1")).fails(2, hint);
    }
    folder.run("day runs/flat-1 first").fails(2, "runs/flat-1 is a cohort");
    folder.run("day flat first").fails(1, "[kit::no-log]: the folder flat");
    folder.run("compare runs/flat-1/0001 runs/flat-1/0002").ok();
}
