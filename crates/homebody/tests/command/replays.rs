//! A recording suffices to repeat a run; a recording that differs is reported.

use crate::flat::flat;
use crate::folder::Folder;
use serde_json::{Value, json};

fn recorded() -> Folder {
    let folder = flat();
    folder.run("run flat --for 10m --quiet --out csv:log.csv --truth truth.db --recording recording.json").ok();
    folder
}

#[test]
fn a_recording_replays_to_the_same_bytes() {
    let folder = recorded();
    let recording = folder.json("recording.json");
    // Keys held by hand are in it.
    assert!(recording["files"]["bob.keys.json"].as_str().unwrap().contains("held"));
    // The scenario is needed no more.
    std::fs::remove_dir_all(folder.path("flat")).unwrap();
    let done = folder.run("replay recording.json --json --out csv:again.csv --truth again.db").ok();
    assert_eq!(folder.sha256("again.csv"), folder.sha256("log.csv"));
    assert_eq!(folder.truth_sha256("again.db"), folder.truth_sha256("truth.db"));
    let json = done.json();
    assert_eq!((&json["agrees_with_recording"], &json["sha256"]), (&json!(true), &recording["sha256"]));
    assert!(json["firings"].as_u64().unwrap() > 500, "{json}");

    // Without a destination it goes into a new folder.
    folder.run("replay recording.json").ok();
    for name in ["log.db", "truth.db", "recording.json"] {
        assert!(folder.path("runs/flat-1").join(name).is_file(), "{name}");
    }
    assert_eq!(folder.truth_sha256("runs/flat-1/truth.db"), folder.truth_sha256("truth.db"));

    // At a pace, too, and into other forms.
    folder.run("replay recording.json --quiet --speed 1000 --out casas:again.txt --out sqlite:log2.db").ok();
    let rows = folder.query("log2.db", "SELECT seq || ',' || fired_at || ',' || sensor || ',' || value FROM firing");
    assert_eq!(rows, folder.read("log.csv").lines().skip(1).collect::<Vec<_>>());
}

#[test]
fn a_stopped_run_replays_as_far_as_it_came() {
    let folder = flat();
    let words = "run flat --control --paused --quiet --out csv:log.csv --recording recording.json";
    folder.say(words, "step 33.3\nstop\n").ok();
    let json = folder.run("replay recording.json --json --out csv:again.csv").ok().json();
    assert_eq!((&json["agrees_with_recording"], &json["simulated_s"]), (&json!(true), &json!(33.3)));
    assert_eq!(folder.sha256("again.csv"), folder.sha256("log.csv"));
}

#[test]
fn a_changed_recording_is_refused() {
    let folder = recorded();
    let recording = folder.json("recording.json");
    let file = |name: &str, old: &str, new: &str| {
        let text = recording["files"][name].as_str().unwrap();
        assert!(text.contains(old), "{old:?} must be in {name}");
        json!(text.replacen(old, new, 1))
    };
    let cases: [(&str, Value, &str); 14] = [
        // It can be simulated, with a different result.
        ("/seed", json!(8), "the replay differs from the recording"),
        ("/length_us", json!(300_000_000), "the replay differs from the recording"),
        ("/sha256", json!("0".repeat(64)), "the replay differs from the recording"),
        ("/firings", json!(1), "the replay differs from the recording"),
        ("/files/ann.json", file("ann.json", "0.8", "0.81"), "the replay differs from the recording"),
        ("/files/bob.keys.json", file("bob.keys.json", "right", "down"), "the replay differs from the recording"),
        ("/files/home.json", file("home.json", "0.05, 1.5", "0.05, 1.0"), "the replay differs from the recording"),
        // It cannot be simulated.
        ("/sha256", json!(""), "kit::incomplete-run"),
        ("/length_us", json!(-1), "kit::not-a-recording"),
        ("/length_us", json!(i64::MAX), "a run is at most 100 years long"),
        ("/seed", json!("seven"), "kit::not-a-recording"),
        ("/entry", json!("other.json"), "its scenario \"other.json\" is not among its files"),
        ("/files/home.json", json!("{"), "home.json:1:"),
        ("/files", json!({}), "its scenario \"scenario.json\" is not among its files"),
    ];
    for (pointer, value, said) in cases {
        let mut changed = recording.clone();
        let what = format!("{pointer} {value}");
        *changed.pointer_mut(pointer).unwrap_or_else(|| panic!("no {pointer}")) = value;
        folder.write("changed.json", changed.to_string());
        let done = folder.run("replay changed.json --quiet --force --out csv:changed.csv");
        assert_eq!(done.code, Some(2), "{what}: {}", done.err);
        done.fails(2, said);
    }
    let text = folder.read("recording.json");
    for (text, said) in [
        (&text[..text.len() / 2], "kit::not-a-recording"),
        ("", "kit::not-a-recording"),
        ("[]", "kit::not-a-recording"),
        (&text.replacen('{', "{ \"other\": 1,", 1), "unknown field `other`"),
    ] {
        folder.write("changed.json", text);
        folder.run("replay changed.json --quiet --out csv:none.csv").fails(2, said);
    }
    assert!(!folder.path("none.csv").exists());
}

#[test]
fn a_recording_of_another_version_says_so() {
    let folder = recorded();
    let mut recording = folder.json("recording.json");
    recording["version"] = json!("0.0.1");
    folder.write("old.json", recording.to_string());
    // Equal firings are equal, whatever recorded them.
    folder.run("replay old.json --quiet --out csv:old.csv").ok();
    recording["seed"] = json!(8);
    folder.write("old.json", recording.to_string());
    folder.run("replay old.json --quiet --force --out csv:old.csv").fails(2, "error[replay::other-version]");
    // So is another build of the same version; the same build has made another recording.
    let version = folder.run("--version").ok().out;
    let version = version.trim().strip_prefix("homebody ").unwrap();
    let another = version.split('+').next().unwrap().to_owned() + "+00000000";
    for (version, said) in [(another.as_str(), "error[replay::other-version]"), (version, "error[replay::differs]")] {
        recording["version"] = json!(version);
        folder.write("old.json", recording.to_string());
        folder.run("replay old.json --quiet --force --out csv:old.csv").fails(2, said);
    }
}

#[test]
fn reports_why_a_path_is_not_a_recording() {
    let folder = flat();
    folder.run("replay nothing.json").fails(1, "kit::no-recording");
    folder.run("replay flat").fails(1, "error[open::recording-folder]");
    folder.write("noise", [0xff, 0xfe, 0x00]);
    folder.run("replay noise").fails(1, "noise: ");
    folder.run("replay flat/scenario.json").fails(2, "kit::not-a-recording");
    assert!(!folder.path("runs").exists());
}

#[test]
fn a_run_with_set_numbers_is_recorded_replayed_and_gone_on_with() {
    let folder = Folder::new();
    folder.run("new home --template studio").ok();
    let run = "run home --for 3d --quiet --set gait.half_turn=5 --set stay.reading.gap=60";
    folder.run(&format!("{run} --out csv:log.csv --record recording.json")).ok();
    folder.run("run home --for 3d --quiet --out csv:usual.csv").ok();
    assert_ne!(folder.sha256("log.csv"), folder.sha256("usual.csv"));
    let json = folder.run("replay recording.json --json --out csv:again.csv").ok().json();
    assert_eq!(json["agrees_with_recording"], json!(true));
    assert_eq!(folder.sha256("again.csv"), folder.sha256("log.csv"));

    folder.say(&format!("{run} --control --paused"), "step 1000\nstop\n").ok();
    let stopped = folder.files().into_iter().find(|name| name.ends_with("recording.json") && name.starts_with("runs/"));
    let stopped = stopped.unwrap().trim_end_matches("/recording.json").to_owned();
    folder.run(&format!("run --resume {stopped} --quiet")).ok();
    let went_on = folder.json(&format!("{stopped}/recording.json"));
    let whole = folder.json("recording.json");
    assert_eq!(went_on["sha256"], whole["sha256"]);
}

#[test]
fn a_number_that_cannot_be_set_is_refused_with_its_place() {
    let folder = Folder::new();
    folder.run("new home --template studio").ok();
    folder.run("run home --set gait.slowst=0.3").fails(2, "did you mean \"gait.slowest\"?");
    folder.run("run home --set gait.slowest=9").fails(2, "error[parameter::out-of-range]");
    folder.run("run home --set gait.slowest").fails(2, "write NAME=VALUE");
    folder.run("run home --set gait.slowest=slow").fails(2, "is not a number");
    let twice = "run home --set gait.slowest=0.25 --set need.thirst=3 --set gait.slowest=0.3 --set need.thirst=3";
    let done =
        folder.run(twice).fails(2, "error[run::parameter-twice]: --set gait.slowest=0.25 and --set gait.slowest=0.3");
    assert!(done.err.contains("--set need.thirst=3 and --set need.thirst=3") && !folder.path("runs").exists());
    let text = folder.read("home/scenario.json");
    let with = |numbers: &str| text.replacen('{', &format!("{{\n  \"numbers\": {numbers},"), 1);
    folder.write("home/scenario.json", with("{\n    \"gait.slowest\": 0.3,\n    \"gait.slowst\": 0.3\n  }"));
    folder.run("check home").fails(2, "scenario.json:4:5: error[parameter::unknown]");
    folder.write("home/scenario.json", with("{ \"gait.slowest\": 9, \"need.thirst\": -1 }"));
    let done = folder.run("check home");
    assert!(done.err.contains("error[parameter::out-of-range]") && done.err.contains("2 problems"), "{}", done.err);
    folder.write("home/scenario.json", with("{ \"gait.slowest\": \"slow\" }"));
    folder.run("check home").fails(2, "scenario.json:2:");
    folder.write("home/scenario.json", with("{ \"gait.slowest\": 0.3 }"));
    folder.run("check home").ok();
}

#[test]
fn numbers_are_listed() {
    let folder = Folder::new();
    let listed = folder.run("parameters gait").ok();
    assert!(listed.out.lines().all(|line| line.starts_with("gait.")), "{}", listed.out);
    assert!(listed.out.contains("gait.slowest "), "{}", listed.out);
    let json = folder.run("parameters --json").ok().json();
    let rows = json["numbers"].as_array().unwrap();
    let slowest = rows.iter().find(|row| row["name"] == "gait.slowest").unwrap();
    assert_eq!(
        (&slowest["value"], &slowest["unit"], &slowest["crate"]),
        (&json!(0.2), &json!("m/s"), &json!("homebody-walk"))
    );
    assert!(rows.len() > 200, "{}", rows.len());
    for (asked, said) in [
        ("gaitt", "hint: did you mean \"gait\"?"),
        ("slowest", "hint: there are gait.slowest"),
        ("xyzzy", "hint: names begin with "),
    ] {
        folder.run(&format!("parameters {asked}")).fails(2, said);
    }
}
