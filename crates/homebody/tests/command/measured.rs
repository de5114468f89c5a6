//! Measures of days and alerts, told, drawn and tabled.

use crate::folder::Folder;
use serde_json::Value;

/// Three weeks of the apartment of the README, in its run's folder.
fn lived() -> Folder {
    let folder = Folder::new();
    folder.copy_scenario("tigerplace");
    folder.run("run tigerplace --quiet --for 21d").ok();
    folder
}

#[test]
fn days_are_measured_by_the_log_and_by_the_truth() {
    let folder = lived();
    let words = "measure runs/tigerplace-1 --json=heard.json --csv days.csv --svg days.svg";
    let done = folder.run(words).ok();
    assert!(done.out.contains("21 days from 2009-03-02") && done.out.contains("time_in_bed"), "{}", done.out);
    let heard: Value = serde_json::from_str(&folder.read("heard.json")).unwrap();
    let lived = folder.run("measure runs/tigerplace-1 --resident margaret --json").ok().json();
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
fn what_cannot_be_measured_is_said() {
    let folder = lived();
    folder.run("measure runs/tigerplace-1 --resident rose").fails(2, "hint: the residents are margaret");
    folder.write("names.csv", "time,sensor,value\n2024-01-01 10:00:00,M001,ON\n2024-01-01 10:00:09,M002,ON\n");
    let unplaced = folder.run("measure names.csv").ok();
    assert!(unplaced.out.contains("No sensor's name tells its room"), "{}", unplaced.out);
    folder.run("measure names.csv --home tigerplace").fails(2, "none of its sensors is one of this home");
}

#[test]
fn alerts_go_by_rules_that_may_be_changed() {
    let folder = lived();
    let usual = folder.run("alerts runs/tigerplace-1 --json").ok().json();
    assert_eq!((usual["days"].as_u64(), usual["days_that_count"].as_u64()), (Some(21), Some(21)));
    folder.write(
        "rules.json",
        r#"{ "rules": [{ "name": "any change", "measure": "density_morning", "when": "either", "k_sd": 0.2 }] }"#,
    );
    let eager = folder.run("alerts runs/tigerplace-1 --rules rules.json").ok();
    assert!(eager.out.contains("any change") && eager.out.contains("than the usual"), "{}", eager.out);
    folder.write("rules.json", r#"{ "rules": [{ "name": "x", "measure": "meels", "when": "less", "k_sd": -3 }] }"#);
    folder.run("alerts runs/tigerplace-1 --rules rules.json").fails(2, "no measure \"meels\"");
    folder.run("alerts runs/tigerplace-1 --rules rules.json").fails(2, "k_sd has to be");
}
