//! Files from strangers: nothing that they name is read or written outside their folder, and their size is bounded.

use crate::flat::flat;
use crate::folder::Folder;
use std::fs;
use std::os::unix::fs::symlink;
use std::process::Command;

/// A folder with a small scenario, and a file outside the scenario.
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
        folder.run("replay sent.json").fails(2, "error[file::outside-folder]");
        folder.write("flat/logger.json", serde_json::json!({ "to": [to] }).to_string());
        for words in ["check flat", "run flat --for 2m", "run flat --for 2m --out csv:mine.csv"] {
            folder.run(words).fails(2, "error[file::outside-folder]");
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
    done.fails(2, "it is a link to a place outside of the scenario's folder");
    fs::remove_file(folder.path("flat/home.json")).unwrap();
    symlink("../home.json", folder.path("flat/home.json")).unwrap();
    folder
        .run("check flat")
        .fails(2, "\n  hint: if the scenario is your own, or you know who made it, trust it, by --trust\n");
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
    folder.run("check pipe").fails(1, "error[open::not-plain]: pipe: ");
    for words in ["replay pipe", "import pipe new", "convert pipe --out csv:a.csv", "compare pipe pipe"] {
        folder.run(words).fails(1, "it is no plain file, but a device or a pipe");
    }
    fs::remove_file(folder.path("flat/home.json")).unwrap();
    symlink("/dev/zero", folder.path("flat/home.json")).unwrap();
    folder.run("check flat").fails(2, "it is a link to a place outside of the scenario's folder");
    folder.run("check flat --trust").fails(2, "it is no plain file, but a device or a pipe");
    fs::remove_file(folder.path("flat/home.json")).unwrap();
    folder.write("flat/home.json", vec![b' '; (8 << 20) + 1]);
    folder.run("check flat").fails(2, "it is larger than 8 MB");
    folder.run("check flat --trust").fails(2, "the file is empty");
}

#[test]
fn resuming_a_strangers_run_writes_only_in_its_folder() {
    let folder = beside_a_secret();
    folder.run("run flat --for 2m --quiet").ok();
    folder.unfinish("runs/flat-1");
    let secret = folder.sha256("secret.json");
    fs::remove_file(folder.path("runs/flat-1/log.db")).unwrap();
    symlink("../../secret.json", folder.path("runs/flat-1/log.db")).unwrap();
    folder.run("run --resume runs/flat-1").fails(1, "log::leads-out");
    assert_eq!(folder.sha256("secret.json"), secret);
}

/// A link next to the log of a stranger's run changes no file outside. An empty file is the easiest to attack: each log begins like it.
#[test]
fn no_link_beside_a_log_leads_what_is_written_elsewhere() {
    for to in ["csv:log.csv", "casas:log.txt", "jsonl:log.jsonl", "csv:logs/log.csv.gz", "sqlite:log.db"] {
        let log = to.split_once(':').unwrap().1;
        let folder = flat();
        folder.write("flat/logger.json", serde_json::json!({ "to": [to] }).to_string());
        folder.run("run flat --for 2m --quiet").ok();
        // A resumed run is complete, and is made incomplete again for the next link.
        for beside in [".77-0.part", ".lock", "-journal", "-wal"] {
            folder.unfinish("runs/flat-1");
            folder.write("mine", "");
            let link = folder.path(&format!("runs/flat-1/{log}{beside}"));
            fs::remove_file(folder.path(&format!("runs/flat-1/{log}"))).unwrap();
            // One leads to a file, one to none yet.
            symlink(folder.path(if beside == ".lock" { "absent" } else { "mine" }), &link).unwrap();
            let done = folder.run("run --resume runs/flat-1 --quiet");
            assert_eq!(folder.read("mine"), "", "{to}{beside}");
            assert!(!folder.path("absent").exists(), "{to}{beside}");
            // The control: without the link the run resumes.
            let _ = fs::remove_file(&link);
            if done.code != Some(0) {
                assert!(done.err.contains("it is a link"), "{to}{beside}: {}", done.err);
                folder.run("run --resume runs/flat-1 --quiet").ok();
            }
            assert!(folder.path(&format!("runs/flat-1/{log}")).metadata().unwrap().len() > 0, "{to}{beside}");
        }
    }
    // A folder on the way is one, too.
    let folder = flat();
    folder.write("flat/logger.json", r#"{ "to": ["csv:logs/log.csv"] }"#);
    folder.run("run flat --for 2m --quiet").ok();
    fs::remove_file(folder.path("runs/flat-1/logs/log.csv")).unwrap();
    fs::remove_dir(folder.path("runs/flat-1/logs")).unwrap();
    fs::create_dir(folder.path("elsewhere")).unwrap();
    symlink("../../elsewhere", folder.path("runs/flat-1/logs")).unwrap();
    folder.run("run --resume runs/flat-1").fails(1, "log::leads-out");
    assert!(!folder.files().iter().any(|file| file.starts_with("elsewhere/") && file != "elsewhere/"));
}

#[test]
fn resuming_a_strangers_cohort_writes_only_in_its_folder() {
    let folder = beside_a_secret();
    folder.run("run flat --for 2m --members 2 --quiet").ok();
    let list = folder.read("runs/flat-1/cohort.json");
    let secret = folder.sha256("secret.json");
    // A file of a member that is a link.
    folder.unfinish("runs/flat-1/0001");
    fs::remove_file(folder.path("runs/flat-1/0001/log.db")).unwrap();
    symlink("../../../secret.json", folder.path("runs/flat-1/0001/log.db")).unwrap();
    folder.run("run --resume runs/flat-1").fails(1, "log::leads-out");
    // A member that is a link.
    fs::rename(folder.path("runs/flat-1/0001"), folder.path("elsewhere")).unwrap();
    fs::remove_file(folder.path("elsewhere/log.db")).unwrap();
    symlink("../../elsewhere", folder.path("runs/flat-1/0001")).unwrap();
    folder.run("run --resume runs/flat-1").fails(1, "log::leads-out");
    assert_eq!(folder.sha256("secret.json"), secret);
    assert!(!folder.path("elsewhere/log.db").exists());
    assert_eq!(folder.read("runs/flat-1/cohort.json"), list);
}

/// A log cannot replace the run's own files or have an invalid place; the command reports it before the simulation.
#[test]
fn a_log_takes_no_place_of_its_run() {
    let folder = flat();
    let long = format!("casas:{}", "x".repeat(256));
    for to in [
        &["sqlite:truth.db"][..],
        &["csv:recording.json"],
        &["csv:./sensors.csv"],
        &["csv:truth.db-wal"],
        &["csv:recording.json.lock"],
        &["csv:about-run.json"],
        &["jsonl:care-notes.json"],
        &["csv:jsonl.confirmed.json"],
        &["csv:week.csv.part"],
        &["csv:anew.truth.db"],
        &["csv:x/"],
        &["csv:."],
        &[&long],
        &["csv:log", "sqlite:log/log.db"],
        &["sqlite:log.db", "csv:log.db-journal"],
    ] {
        folder.write("flat/logger.json", serde_json::json!({ "to": to }).to_string());
        for words in ["check flat", "run flat --for 2m --quiet"] {
            folder.run(words).fails(2, "logger.json:1:").says(&["error[file::"]);
        }
        assert!(!folder.path("runs").exists());
    }
    // The hint is followed, and works.
    folder.write("flat/logger.json", r#"{ "to": ["csv:logs/week.csv", "sqlite:logs/log.db"] }"#);
    folder.run("run flat --for 2m --quiet").ok();
}

/// A condition of a scenario's own that cannot be read does not give way to the one of its name that the program knows.
#[test]
fn a_condition_that_cannot_be_read_is_told() {
    let folder = Folder::with("tigerplace-depression");
    let own = "tigerplace-depression/conditions/depression.routine";
    folder.write("elsewhere.routine", "The person goes to bed 1 hour earlier.\n");
    fs::create_dir(folder.path("tigerplace-depression/conditions")).unwrap();
    let pipe = || assert!(Command::new("mkfifo").arg(folder.path(own)).status().unwrap().success());
    let others: [(&str, &dyn Fn()); 5] = [
        ("it is a link to a place outside of the scenario's folder", &|| {
            symlink("../../elsewhere.routine", folder.path(own)).unwrap();
        }),
        ("it is a link to a file that does not exist", &|| symlink("nowhere", folder.path(own)).unwrap()),
        ("it is no plain file, but a device or a pipe", &pipe),
        ("it is larger than 8 MB", &|| folder.write(own, vec![b' '; (8 << 20) + 1])),
        ("is too long: a routine has at most 256 KB", &|| folder.write(own, vec![b' '; (256 << 10) + 1])),
    ];
    for (why, make) in others {
        make();
        folder
            .run("check tigerplace-depression")
            .fails(2, why)
            .says(&["\"conditions/depression.routine\"", "file, or remove it"]);
        fs::remove_file(folder.path(own)).unwrap();
    }
    folder.run("check tigerplace-depression").ok();
}

/// A pipe is reported as a pipe, at any place.
#[test]
fn a_pipe_is_told_as_a_pipe() {
    let folder = flat();
    let pipe = |name: &str| assert!(Command::new("mkfifo").arg(folder.path(name)).status().unwrap().success());
    folder.run("run flat --for 2m --quiet").ok();
    folder.unfinish("runs/flat-1");
    fs::remove_file(folder.path("runs/flat-1/log.db")).unwrap();
    pipe("runs/flat-1/log.db");
    folder.run("run --resume runs/flat-1").fails(1, "[log::not-regular]: runs/flat-1/log.db");
    fs::remove_file(folder.path("flat/home.json")).unwrap();
    pipe("flat/home.json");
    folder.run("check flat").fails(2, "it is no plain file, but a device or a pipe");
    fs::remove_file(folder.path("flat/scenario.json")).unwrap();
    pipe("flat/scenario.json");
    folder.run("check flat").fails(1, "error[open::not-plain]: flat/scenario.json: ");
}

/// The refusal of a large file costs little.
#[cfg(target_os = "linux")]
#[test]
fn a_scenario_that_is_too_large_as_a_whole_is_refused_at_once() {
    let folder = Folder::new();
    let check = |said: &str| {
        let mut command = Command::new("sh");
        // KiB of memory, and seconds on the clock of the processor.
        let line = format!("ulimit -v 1048576; ulimit -t 5; exec {} check tigerplace", env!("CARGO_BIN_EXE_homebody"));
        command.args(["-c", &line]).current_dir(folder.path(""));
        let begun = std::time::Instant::now();
        let done = crate::folder::Done::new("check tigerplace", command.output().unwrap()).fails(2, said);
        println!("{said}: {:?}", begun.elapsed());
        done
    };
    let scenario = |residents: usize, driver: &dyn Fn(usize) -> serde_json::Value| {
        let _ = fs::remove_dir_all(folder.path("tigerplace"));
        folder.copy_scenario("tigerplace");
        folder.edit_json("tigerplace/scenario.json", |scenario| {
            scenario["residents"] = (0..residents).map(|index| format!("r{index}.json")).collect::<Vec<_>>().into()
        });
        for index in 0..residents {
            let resident = serde_json::json!({ "name": format!("R{index}"), "driver": driver(index) });
            folder.write(&format!("tigerplace/r{index}.json"), resident.to_string());
        }
    };
    scenario(1, &|_| serde_json::json!({ "routine": "long.routine" }));
    folder.write("tigerplace/long.routine", vec![b'\n'; 8_000_000]);
    check("\"long.routine\" is too long: a routine has at most 256 KB");
    folder.write("tigerplace/long.routine", vec![b'\n'; 10_001]);
    check("\"long.routine\" is too long: a routine has at most 10000 lines");
    scenario(30, &|_| serde_json::json!({ "routine": "long.routine" }));
    folder.write("tigerplace/long.routine", "The person gets up at 07:00.\n".repeat(8_000_000 / 29));
    check("\"long.routine\" is too long: a routine has at most 256 KB");
    scenario(3, &|index| serde_json::json!({ "path": format!("p{index}.json") }));
    for index in 0..3 {
        folder.write(&format!("tigerplace/p{index}.json"), format!("[{}]", " ".repeat(8_000_000)));
    }
    check("cannot read \"p2.json\": with it, the files of the scenario have more than 16 MB");
}
