//! Measures of days and alerts, as text, pictures and tables.

use crate::folder::{Files, Folder};
use crate::noted_log::noted;
use serde_json::Value;
use std::sync::OnceLock;

/// Three weeks of the apartment of the README, in its run's folder.
fn three_weeks() -> Folder {
    static FILES: OnceLock<Files> = OnceLock::new();
    Folder::filled_once(&FILES, |folder| {
        folder.copy_scenario("tigerplace");
        folder.run("run tigerplace --quiet --for 21d").ok();
    })
}

#[test]
fn days_are_measured_by_the_log_and_by_the_truth() {
    let folder = three_weeks();
    let words = "measures runs/tigerplace-1 --json=heard.json --csv days.csv --svg days.svg";
    let done = folder.run(words).ok();
    assert!(done.out.contains("21 days from 2009-03-02") && done.out.contains("time_in_bed"), "{}", done.out);
    let heard = folder.json("heard.json");
    let lived = folder.run("measures runs/tigerplace-1 --resident margaret --json").ok().json();
    let values = |of: &Value, name: &str| -> Vec<f64> {
        of["days"].as_array().unwrap().iter().filter_map(|day| day["values"][name].as_f64()).collect()
    };
    let mean = |values: Vec<f64>| values.iter().sum::<f64>() / values.len() as f64;
    for (name, apart) in [("time_out", 0.2), ("bedtime", 0.75), ("rising", 0.5)] {
        assert!(values(&heard, name).len() >= 18, "{name}: {}", done.out);
        let (heard, lived) = (mean(values(&heard, name)), mean(values(&lived, name)));
        assert!((heard - lived).abs() < apart, "{name}: {heard} by the log, {lived} by the truth");
    }
    assert!(values(&lived, "density_morning").is_empty(), "a truth has no firings");
    let table = folder.read("days.csv");
    assert_eq!((table.lines().count(), table.starts_with("date,time_in_bed,bedtime,")), (22, true));
    assert!(folder.read("days.svg").contains("Time in bed"));
}

#[test]
fn reports_what_it_cannot_measure() {
    let folder = three_weeks();
    folder.run("measures runs/tigerplace-1 --resident rose").fails(2, "error[measures::no-resident]");
    folder.write("names.csv", "time,sensor,value\n2024-01-01 10:00:00,M001,ON\n2024-01-01 10:00:09,M002,ON\n");
    folder.run("measures names.csv").ok().prints(&["no sensor name contains a room"]);
    folder.run("measures names.csv --home tigerplace").fails(2, "error[measures::other-home]");
    let eats = r#"<log><trace><event><string key="concept:name" value="Eat"/>
        <date key="time:timestamp" value="2024-01-01T07:00:00Z"/></event></trace></log>"#;
    folder.write("events.xes", format!("{eats}\n"));
    for command in ["measures", "density"] {
        folder
            .run(&format!("{command} events.xes"))
            .fails(2, "error[density::only-activities]")
            .says(&["homebody inspect events.xes lists them"]);
    }
    assert!(folder.run("inspect events.xes").ok().out.contains("Eat"));
}

#[test]
fn alerts_go_by_rules_that_may_be_changed() {
    let folder = three_weeks();
    let usual = folder.run("alerts runs/tigerplace-1 --json").ok().json();
    assert_eq!((usual["days"].as_u64(), usual["days_that_count"].as_u64()), (Some(21), Some(21)));
    folder.write(
        "rules.json",
        r#"{ "rules": [{ "name": "any change", "measure": "density_morning", "when": "either", "k_sd": 0.2 }] }"#,
    );
    folder.run("alerts runs/tigerplace-1 --rules rules.json").ok().prints(&["any change", "than usual"]);
    folder.write("rules.json", r#"{ "rules": [{ "name": "x", "measure": "meels", "when": "less", "k_sd": -3 }] }"#);
    folder.run("alerts runs/tigerplace-1 --rules rules.json").fails(2, "rules.json: error[alert-rule::");
    folder.run("alerts runs/tigerplace-1 --rules rules.json").fails(2, "2 problems");
    folder.run("alerts runs/tigerplace-1 --rules none.json").fails(2, "error[alerts::no-rules]");
}

#[test]
fn days_are_told_in_sentences() {
    let folder = three_weeks();
    folder
        .run("summary runs/tigerplace-1")
        .ok()
        .prints(&["\nMargaret went to bed between ", " of the last two weeks.\n"]);
    folder
        .run("summary runs/tigerplace-1 --resident margaret --audience experts --last 7")
        .ok()
        .prints(&[" of the last 7 days (truth ", "Margaret "]);
    let beside = folder.run("summary runs/tigerplace-1 --compare runs/tigerplace-1 --json").ok().json();
    assert_eq!(beside["distance"].as_f64(), Some(0.0));
}

#[test]
fn programs_get_rows() {
    let folder = three_weeks();
    folder.run("measures runs/tigerplace-1 --out sqlite:care.db --out fhir:care.json --out jsonl:care.jsonl").ok();
    let bundle = folder.json("care.json");
    let lines = folder.read("care.jsonl");
    let first: Value = serde_json::from_str(lines.lines().next().unwrap()).unwrap();
    assert_eq!((bundle["resourceType"].as_str(), first["kind"].as_str()), (Some("Bundle"), Some("measure")));
    assert_eq!(bundle["entry"].as_array().unwrap().len(), lines.lines().count());
    folder.run("measures runs/tigerplace-1 --out sqlite:care.db").fails(1, "[log::exists]: table measure of care.db");
    folder.run("alerts runs/tigerplace-1 --out sqlite:care.db").ok();
    let printed = folder.run("summary runs/tigerplace-1 --out jsonl:- --out sqlite:care.db").ok();
    let is_row = |line: &str| serde_json::from_str::<Value>(line).is_ok_and(|row| row["kind"] == "sentence");
    assert!(printed.out.lines().count() > 3 && printed.out.lines().all(is_row), "{}", printed.out);
    let database = rusqlite::Connection::open(folder.path("care.db")).unwrap();
    let count = |table: &str| -> u32 {
        database.query_row(&format!("select count(*) from {table}"), [], |row| row.get(0)).unwrap()
    };
    assert_eq!(count("measure") as usize, lines.lines().count());
    assert_eq!(count("sentence") as usize, printed.out.lines().count());
    folder.run("alerts runs/tigerplace-1 --out fhir:x.json").fails(2, "error[result::fhir]");
    folder.run("alerts runs/tigerplace-1 --out x.json").fails(2, "hint: write jsonl:FILE");
    folder.run("alerts runs/tigerplace-1 --follow --json").fails(2, "error[alerts::files-with-follow]");
    folder.run("alerts nowhere --follow").fails(1, "nowhere");
}

#[test]
fn sensors_are_placed() {
    let folder = Folder::with("studio");
    let words = "suggest-sensors studio --goals falls,outings --count 3 --people 4 --json=placed.json --svg placed.svg";
    folder.run(words).ok().prints(&["the home's own"]);
    let placed = folder.json("placed.json");
    let steps = placed["steps"].as_array().unwrap();
    let score = |step: &Value| step["score"].as_f64().unwrap();
    assert_eq!((steps.len(), placed["sensors"].as_array().unwrap().len()), (3, 3));
    assert!(score(&steps[2]) >= score(&steps[0]) && score(&steps[0]) > 0.0, "{placed}");
    // An exchange gives a better result.
    let swapped = placed["swapped"].as_array().unwrap();
    assert!(swapped.iter().all(|swap| score(swap) > score(&steps[2])), "{placed}");
    // The share of the floor is that of the coverage, for the home and for the suggested sensors.
    let seen = |layout: &Value| {
        let falls = layout["goals"].as_array().unwrap().iter().find(|goal| goal["goal"] == "falls").unwrap();
        falls["value"].as_f64().unwrap()
    };
    let covered =
        || 1.0 - folder.run("coverage studio --json").ok().json()["whole"]["seen_by"]["none"].as_f64().unwrap();
    let own = covered();
    assert!((seen(&placed["own"]) - own).abs() < 1e-4, "{own} of {}", placed["own"]);
    folder.edit_json("studio/home.json", |home| home["sensors"].clone_from(&placed["sensors"]));
    // Its logger speaks of sensors that are gone.
    let scenario = folder.read("studio/scenario.json");
    folder.write("studio/scenario.json", scenario.replace("\"logger\": \"logger.json\",", ""));
    let (last, taken) = (swapped.last().unwrap_or(&steps[2]), covered());
    assert!((seen(last) - taken).abs() < 1e-4, "{taken} of {last}");
    folder.run("suggest-sensors studio --goals luck,depression").fails(2, "error[goals::unknown]");
}

#[test]
fn names_the_resident_of_measures_in_a_home_of_two() {
    let folder = Folder::with("couple-with-cat");
    folder.run("run couple-with-cat --quiet --for 2d").ok();
    folder.run("measures runs/couple-with-cat-1").ok().prints(&["cannot tell residents apart", "--resident"]);
    folder.run("measures runs/couple-with-cat-1 --json").ok().prints(&["cannot tell residents apart"]);
    let of_one = folder.run("measures runs/couple-with-cat-1 --resident ruth --json").ok();
    assert!(!of_one.out.contains("cannot tell residents apart"), "{}", of_one.out);
}

/// The values of each day of a run, and of the run itself what it is called.
fn days_of(folder: &Folder, run: &str) -> Vec<Value> {
    let told = folder.run(&format!("measures {run} --json")).ok().json();
    told["days"].as_array().unwrap().clone()
}

#[test]
fn a_day_is_measured_alike_in_runs_of_any_length() {
    for scenario in ["tigerplace", "studio"] {
        let folder = Folder::with(scenario);
        let [short, long] = [(1, 30), (2, 40)].map(|(run, days)| {
            folder.run(&format!("run {scenario} --quiet --for {days}d")).ok();
            let measured = days_of(&folder, &format!("runs/{scenario}-{run}"));
            assert_eq!(measured.len(), days);
            measured
        });
        for (day, later) in short.iter().zip(&long) {
            assert_eq!(day, later, "{scenario}");
        }
        for measure in ["pace", "pace_slow", "density_distance"] {
            assert!(short[29]["values"][measure].is_number(), "{scenario}: {measure} of {}", short[29]);
        }
    }
}

#[test]
fn twins_are_measured_alike_until_the_condition_begins() {
    const ONSET: usize = 35;
    let folder = Folder::with("tigerplace-depression");
    folder.run("run tigerplace-depression --quiet --for 45d").ok();
    folder.run("run tigerplace-depression --quiet --for 45d --without depression").ok();
    let [ill, well] = [1, 2].map(|run| days_of(&folder, &format!("runs/tigerplace-depression-{run}")));
    for (ill, well) in ill.iter().zip(&well).take(ONSET) {
        assert_eq!(ill, well);
    }
    let differ = ill.iter().zip(&well).skip(ONSET).filter(|(ill, well)| ill != well).count();
    assert!(differ > 5, "{differ} days differ after the condition has begun");
}

#[test]
fn nothing_is_known_of_what_no_sensor_tells() {
    let folder = Folder::new();
    // A thermometer is all that the kitchen has.
    let mut log = String::from("time,sensor,value\n");
    for day in 1..=9 {
        for hour in 0..24 {
            log += &format!("2024-03-0{day} {hour:02}:10:00,bedroom motion,ON\n");
            log += &format!("2024-03-0{day} {hour:02}:20:00,living room motion,ON\n");
            log += &format!("2024-03-0{day} {hour:02}:30:00,kitchen temperature,2{}.5\n", hour % 3);
        }
    }
    folder.write("log.csv", log);
    let told = folder.run("measures log.csv --json").ok().json();
    let of_days =
        |name: &str| told["days"].as_array().unwrap().iter().filter(|day| day["values"][name].is_number()).count();
    assert_eq!((of_days("meals"), of_days("bathroom_day")), (0, 0));
    assert!(of_days("room_changes") >= 7, "{told}");
    assert!(
        told["remarks"].to_string().contains("no sensor in the kitchen detects the resident"),
        "{}",
        told["remarks"]
    );
    // Its rooms are those of names.
    assert_eq!(told["guessed_rooms"]["living room motion"], "living room");
}

#[test]
fn notes_of_a_log_stand_beside_what_its_sensors_tell() {
    let folder = Folder::new();
    // The resident leaves the bed an hour before the note. Only notes have meals.
    let meal = |day: u32| {
        format!(
            "2024-03-0{day} 08:00:00 FrontDoor CLOSE Sleep end\n2024-03-0{day} 18:00:00 FrontDoor CLOSE Eating begin\n\
             2024-03-0{day} 18:30:00 FrontDoor CLOSE Eating end\n"
        )
    };
    let meals: String = (1..=5).map(meal).collect();
    let log = noted("Leaving_home").replace("07:00:00 bed_pressure OFF Sleep end", "07:00:00 bed_pressure OFF")
        + meals.as_str();
    let mut rows: Vec<&str> = log.lines().collect();
    rows.sort_unstable();
    folder.write("log.txt", rows.join("\n") + "\n");
    let done = folder.run("measures log.txt --json=told.json").ok();
    let told = folder.json("told.json");
    let bed = told["noted"].as_array().unwrap().iter().find(|noted| noted["measure"] == "time_in_bed").unwrap();
    assert!((bed["by_notes"].as_f64().unwrap() - 9.0).abs() < 0.01, "{bed}");
    assert!((bed["by_sensors"].as_f64().unwrap() - 8.0).abs() < 0.01, "{bed}");
    assert!(done.out.contains("time_in_bed: 9.00 h by the log's notes, 8.00 h by the sensors"), "{}", done.out);
    assert_eq!(told["days"][2]["values"]["meals"], 1.0);
    assert!(told["from_notes"].to_string().contains("meals"), "{}", told["from_notes"]);
    assert!(done.out.contains("Taken from the log's notes"), "{}", done.out);
}
