//! Files that may be anybody's: nothing that they name is read or written outside their folder, and what is read is bounded.

use crate::flat::flat;
use crate::folder::Folder;
use std::fs;
use std::os::unix::fs::symlink;
use std::process::Command;

/// A folder with a small scenario, and a file beside it that is none of its business.
fn beside_a_secret() -> Folder {
    let folder = flat();
    folder.write("secret.json", "{ \"secret\": \"hunter2\" }");
    folder
}

#[test]
fn a_scenario_and_a_recording_write_nothing_outside_the_runs_folder() {
    let folder = beside_a_secret();
    folder.run("run flat --for 2m --quiet").ok();
    let whole = folder.read("runs/flat-1/recording.json");
    let logger = folder.read("flat/logger.json");
    let before = folder.files();
    for to in ["csv:../../../start.sh", "sqlite:/srv/start.db", "casas:a/../../start.sh"] {
        let recording: serde_json::Value = serde_json::from_str(&whole).unwrap();
        let mut lured = recording;
        let entry = lured["entry"].as_str().unwrap().to_owned();
        let mut scenario: serde_json::Value = serde_json::from_str(lured["files"][&entry].as_str().unwrap()).unwrap();
        scenario["logger"] = "logger.json".into();
        lured["files"][&entry] = scenario.to_string().into();
        lured["files"]["logger.json"] = serde_json::json!({ "to": [to] }).to_string().into();
        folder.write("sent.json", lured.to_string());
        folder.run("replay sent.json").fails(2, "is no file name inside the run's folder");
        folder.write("flat/logger.json", serde_json::json!({ "to": [to] }).to_string());
        for words in ["check flat", "run flat --for 2m", "run flat --for 2m --out csv:mine.csv"] {
            folder.run(words).fails(2, "is no file name inside the run's folder");
        }
        folder.write("flat/logger.json", &logger);
        fs::remove_file(folder.path("sent.json")).unwrap();
    }
    assert_eq!(folder.files(), before);
}

#[test]
fn a_link_that_leads_out_is_not_read_unless_it_is_trusted() {
    let folder = beside_a_secret();
    fs::rename(folder.path("flat/home.json"), folder.path("home.json")).unwrap();
    symlink("../secret.json", folder.path("flat/home.json")).unwrap();
    let done = folder.run("check flat");
    assert!(!done.err.contains("hunter2"), "{}", done.err);
    done.fails(2, "it is a link that leads out of the scenario's folder");
    fs::remove_file(folder.path("flat/home.json")).unwrap();
    symlink("../home.json", folder.path("flat/home.json")).unwrap();
    folder.run("check flat").fails(2, "it is a link that leads out");
    folder.run("check flat --trust").ok();
    folder.run("run flat --for 1m --quiet --trust").ok();
    // A link that stays inside is read.
    fs::remove_file(folder.path("flat/home.json")).unwrap();
    fs::rename(folder.path("home.json"), folder.path("flat/the-home.json")).unwrap();
    symlink("the-home.json", folder.path("flat/home.json")).unwrap();
    folder.run("check flat").ok();
}

#[test]
fn only_plain_files_of_a_named_size_are_read() {
    let folder = beside_a_secret();
    let pipe = folder.path("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    folder.run("check pipe").fails(1, "there is no such file\n  hint: a scenario folder holds a scenario.json");
    for words in ["replay pipe", "import pipe new", "convert pipe --to csv:a.csv", "compare pipe pipe"] {
        folder.run(words).fails(1, "it is no plain file, but a device or a pipe");
    }
    fs::remove_file(folder.path("flat/home.json")).unwrap();
    symlink("/dev/zero", folder.path("flat/home.json")).unwrap();
    folder.run("check flat").fails(2, "it is a link that leads out of the scenario's folder");
    folder.run("check flat --trust").fails(2, "it is no plain file, but a device or a pipe");
    fs::remove_file(folder.path("flat/home.json")).unwrap();
    folder.write("flat/home.json", vec![b' '; (8 << 20) + 1]);
    folder.run("check flat").fails(2, "it is larger than 8 MB");
    folder.run("check flat --trust").fails(2, "the file is empty");
}

#[test]
fn who_goes_on_with_somebody_elses_run_writes_nowhere_else() {
    let folder = beside_a_secret();
    folder.run("run flat --for 2m --quiet").ok();
    let recording = folder.read("runs/flat-1/recording.json");
    let mut unfinished: serde_json::Value = serde_json::from_str(&recording).unwrap();
    unfinished["sha256"] = "".into();
    folder.write("runs/flat-1/recording.json", unfinished.to_string());
    let secret = folder.sha256("secret.json");
    fs::remove_file(folder.path("runs/flat-1/log.db")).unwrap();
    symlink("../../secret.json", folder.path("runs/flat-1/log.db")).unwrap();
    folder.run("run --resume runs/flat-1").fails(1, "leads out of the run's folder");
    assert_eq!(folder.sha256("secret.json"), secret);
}

#[test]
fn who_goes_on_with_somebody_elses_cohort_writes_nowhere_else() {
    let folder = beside_a_secret();
    folder.run("run flat --for 2m --residents 2 --quiet").ok();
    let list = folder.read("runs/flat-1/cohort.json");
    let member = |unfinished: bool| {
        let mut recording: serde_json::Value =
            serde_json::from_str(&folder.read("runs/flat-1/0001/recording.json")).unwrap();
        if unfinished {
            recording["sha256"] = "".into();
        }
        recording.to_string()
    };
    let unfinished = member(true);
    let secret = folder.sha256("secret.json");
    // A file of a member that is a link.
    folder.write("runs/flat-1/0001/recording.json", &unfinished);
    fs::remove_file(folder.path("runs/flat-1/0001/log.db")).unwrap();
    symlink("../../../secret.json", folder.path("runs/flat-1/0001/log.db")).unwrap();
    folder.run("run --resume runs/flat-1").fails(1, "leads out of the run's folder");
    // A member that is a link.
    fs::rename(folder.path("runs/flat-1/0001"), folder.path("elsewhere")).unwrap();
    fs::remove_file(folder.path("elsewhere/log.db")).unwrap();
    symlink("../../elsewhere", folder.path("runs/flat-1/0001")).unwrap();
    folder.run("run --resume runs/flat-1").fails(1, "leads out of the run's folder");
    assert_eq!(folder.sha256("secret.json"), secret);
    assert!(!folder.path("elsewhere/log.db").exists());
    assert_eq!(folder.read("runs/flat-1/cohort.json"), list);
}
