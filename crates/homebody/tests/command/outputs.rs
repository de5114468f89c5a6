//! The destinations of a run, and its report.

use crate::flat::flat;
use crate::folder::{Folder, ROOT, says};
use std::fs::{self, File};
use std::io::pipe;
use std::os::unix::fs::{FileTypeExt, symlink};
use std::process::{Command, Stdio};
use std::thread;

#[test]
fn without_an_output_each_run_gets_a_folder_of_its_own() {
    let folder = flat();
    let said = folder.run("run flat --for 1m").ok().out;
    says(
        &said,
        &["log        sqlite:runs/flat-1/log.db", "truth      runs/flat-1/truth.db", "runs/flat-1/recording.json"],
    );
    let in_first = ["log.db", "recording.json", "sensors.csv", "truth.db"].map(|name| format!("runs/flat-1/{name}"));
    let runs = |folder: &Folder| folder.files().into_iter().filter(|name| name.starts_with("runs")).collect::<Vec<_>>();
    assert_eq!(runs(&folder), in_first);
    let before = in_first.each_ref().map(|name| fs::read(folder.path(name)).unwrap());

    folder.run("run flat --for 1m").ok();
    let at_once: Vec<_> = (0..4).map(|_| folder.start("run flat --for 2m")).collect();
    for running in at_once {
        running.finish().ok();
    }
    assert_eq!(runs(&folder).len(), 6 * 4, "{:?}", runs(&folder));
    assert_eq!(in_first.each_ref().map(|name| fs::read(folder.path(name)).unwrap()), before);
    assert_eq!(folder.sha256("runs/flat-2/log.db"), folder.sha256("runs/flat-1/log.db"));
    for number in 3..=6 {
        assert_eq!(folder.query(&format!("runs/flat-{number}/log.db"), "SELECT ended_at FROM run").len(), 1);
    }
}

#[test]
fn the_scenario_says_where_a_run_goes() {
    let folder = flat();
    folder.write(
        "flat/logger.json",
        r#"{ "to": ["sqlite:events/home.db", "csv:rows.csv"], "table": "event", "columns": { "sensor": "device" },
            "ids": { "KitchenWall": "A1" }, "messages": { "on_off": { "hold_s": 2 } }, "time": "utc" }"#,
    );
    folder.run("run flat --for 1m --quiet").ok();
    let rows = folder.query("runs/flat-1/events/home.db", "SELECT device || ',' || value FROM event ORDER BY seq");
    assert!(rows.contains(&"A1,ON".into()) && rows.contains(&"A1,OFF".into()), "{rows:?}");
    let csv = folder.read("runs/flat-1/rows.csv");
    assert!(csv.starts_with("seq,fired_at,device,value\n0,2009-03-02T14:00:0"), "{csv}");
    assert_eq!(csv.lines().count() - 1, rows.len());
}

#[test]
fn several_outputs_hold_the_same_rows() {
    let folder = flat();
    let words = "--out sqlite:log.db --out csv:log.csv --out casas:log.txt --out csv:second.csv";
    folder.run(&format!("run flat --for 5m --quiet {words}")).ok();
    let rows = |separator: &str, columns: &str| {
        let columns = columns.replace(' ', &format!(" || '{separator}' || "));
        folder.query("log.db", &format!("SELECT {columns} FROM firing ORDER BY seq"))
    };
    let lines = |name: &str| folder.read(name).lines().map(String::from).collect::<Vec<_>>();
    assert!(lines("log.txt").len() > 100);
    assert_eq!(lines("log.csv")[1..], rows(",", "seq fired_at sensor value"));
    assert_eq!(lines("log.txt"), rows("\t", "fired_at sensor value"));
    assert_eq!(lines("second.csv"), lines("log.csv"));
    assert_eq!(folder.files().iter().filter(|name| !name.starts_with("flat/")).count(), 6, "{:?}", folder.files());
}

/// Words, each with the files it writes.
const WRITES: [(&str, &[&str]); 13] = [
    ("run flat --for 1m --out sqlite:new.db --out csv:kept", &["kept", "kept.sensors.csv", "new.db"]),
    ("run flat --for 1m --out csv:new.csv --out sqlite:kept", &["kept", "new.csv", "new.sensors.csv"]),
    (
        "run flat --for 1m --out csv:new.csv --out casas:kept",
        &["kept", "kept.sensors.csv", "new.csv", "new.sensors.csv"],
    ),
    ("run flat --for 1m --out csv:new.csv --truth kept", &["kept", "new.csv", "new.sensors.csv"]),
    ("run flat --for 1m --out csv:new.csv --recording kept", &["kept", "new.csv", "new.sensors.csv"]),
    ("coverage flat --svg new.svg --png kept", &["kept", "new.svg"]),
    ("coverage flat --svg kept --png new.png", &["kept", "new.png"]),
    ("coverage flat --png new.png --json=kept", &["kept", "new.png"]),
    ("plan flat --svg new.svg --png kept", &["kept", "new.svg"]),
    ("convert given.csv --out sqlite:kept", &["kept"]),
    ("density given.csv --svg new.svg --csv kept", &["kept", "new.svg"]),
    ("density given.csv --csv new.csv --json=kept", &["kept", "new.csv"]),
    ("day given.csv first --svg new.svg --png kept", &["kept", "new.svg"]),
];

#[test]
fn nothing_is_overwritten_unasked() {
    let folder = flat();
    folder.write("given.csv", "time,sensor,value\n2009-03-02 07:12:03.25,M1,ON\n");
    let given = folder.files();
    for (words, written) in WRITES {
        for kept in ["precious", ""] {
            folder.write("kept", kept);
            folder.run(words).fails(1, "[log::exists]: kept");
            assert_eq!(folder.read("kept"), kept, "{words}");
            fs::remove_file(folder.path("kept")).unwrap();
            assert_eq!(folder.files(), given, "{words}");
        }
        // A link that leads nowhere is something, too.
        symlink("nowhere", folder.path("kept")).unwrap();
        folder.run(words).fails(1, "[log::exists]: kept");
        assert!(folder.path("kept").is_symlink() && !folder.path("nowhere").exists(), "{words}");
        fs::remove_file(folder.path("kept")).unwrap();

        folder.write("kept", "precious");
        folder.run(&format!("{words} --force")).ok();
        assert_ne!(fs::read(folder.path("kept")).unwrap(), b"precious", "{words}");
        let new: Vec<String> = folder.files().into_iter().filter(|name| !given.contains(name)).collect();
        assert_eq!(new, written, "{words}");
        for name in new {
            fs::remove_file(folder.path(&name)).unwrap();
        }
    }
}

#[test]
fn a_pipe_stays_a_pipe() {
    let folder = flat();
    assert!(Command::new("mkfifo").arg(folder.path("pipe")).status().unwrap().success());
    for words in
        ["run flat --for 1m --quiet --out csv:pipe", "coverage flat --svg pipe", "coverage flat --png pipe --force"]
    {
        let pipe = folder.path("pipe");
        let reader = thread::spawn(|| fs::read(pipe).unwrap());
        folder.run(words).ok();
        assert!(fs::metadata(folder.path("pipe")).unwrap().file_type().is_fifo(), "{words}");
        assert!(reader.join().unwrap().len() > 500, "{words}");
    }
}

#[test]
fn scripts_get_one_object_and_people_their_words_apart() {
    let folder = flat();
    let run = folder.run("run flat --for 1m --json --out sqlite:log.db --truth truth.db --recording r.json").ok();
    assert_eq!(run.err, "");
    let json = run.json();
    assert_eq!(json["rows"].as_u64().unwrap(), folder.query("log.db", "SELECT 1 FROM firing").len() as u64);
    let by_sensor = json["rows_by_sensor"].as_object().unwrap();
    assert_eq!(
        by_sensor.keys().collect::<Vec<_>>(),
        ["KitchenWall", "KitchenFloor", "BedroomWall", "BedroomFloor", "StudyFloor"]
    );
    assert_eq!(by_sensor.values().map(|rows| rows.as_u64().unwrap()).sum::<u64>(), json["rows"].as_u64().unwrap());
    assert_eq!(json["log"][0], "sqlite:log.db");
    assert_eq!((json["truth"].as_str(), json["recording"].as_str()), (Some("truth.db"), Some("r.json")));
    assert_eq!((json["stopped"].as_bool(), json["simulated_s"].as_f64()), (Some(false), Some(60.0)));

    folder.run("replay r.json --json --out csv:again.csv").ok().json();
    folder.run("coverage flat --json").ok().json();
    folder.run("coverage flat --json --svg map.svg").ok().json();
    folder.run("compare log.db again.csv --json").ok().json();
    let check = folder.run("check flat --json").ok();
    assert_eq!(check.json()["problems"].as_array().unwrap().len(), 0);
    assert!(check.err.starts_with("flat: no problems. 3 rooms, 2 doors"), "{}", check.err);

    folder.edit("flat/scenario.json", "\"days\": 0.01", "\"days\": 0");
    let wrong = folder.run("check flat --json");
    assert_eq!((wrong.code, wrong.json()["problems"][0]["file"].as_str()), (Some(2), Some("scenario.json")));
    assert_eq!(wrong.json()["warnings"].as_array().map(Vec::len), Some(0));
    assert!(wrong.err.contains("scenario.json:5:11:") && wrong.err.contains("1 problem"), "{}", wrong.err);
    // Other failures give scripts only an exit code.
    folder.run("run flat --json").fails(2, "scenario.json:5:11:");
    folder.run("check nowhere --json").fails(1, "there is no such scenario");
    folder.run("compare log.db nowhere --json").fails(1, "[log::not-found]: nowhere");
}

#[test]
fn quiet_is_quiet() {
    let folder = flat();
    let done = folder.run("run flat --quiet").ok();
    assert_eq!((done.out.as_str(), done.err.as_str()), ("", ""));
    let done = folder.run("replay runs/flat-1/recording.json --quiet").ok();
    assert_eq!((done.out.as_str(), done.err.as_str()), ("", ""));
}

/// Words that print something, whatever is in the folder.
fn talkative(folder: &Folder) -> Vec<String> {
    folder.run("run flat --for 1m --quiet --out csv:log.csv --recording r.json").ok();
    // Some lines are left out, with a note on the other stream.
    folder.write("dirty.txt", "2009-03-02 07:12:03 M1 ON\nnonsense\n");
    let words = [
        "run flat --for 1m --out csv:a.csv --force",
        "run flat --for 1m --out csv:a.csv --force --json",
        "replay r.json --out csv:a.csv --force",
        "check flat",
        "check flat --json",
        "coverage flat",
        "coverage flat --json",
        "compare dirty.txt dirty.txt",
        "compare dirty.txt dirty.txt --json",
        "convert dirty.txt --out csv:a.csv --force",
        "density dirty.txt",
        "density dirty.txt --compare log.csv --json",
        "day dirty.txt first",
        "completions bash",
        "schema schemas",
        "help",
        "run --help",
        "--version",
    ];
    words.map(String::from).to_vec()
}

#[test]
fn a_reader_that_goes_away_is_no_fault() {
    let folder = flat();
    for words in talkative(&folder) {
        for streams in ["out", "err", "both"] {
            let (reader, writer) = pipe().unwrap();
            drop(reader);
            let mut command = folder.command(&words);
            command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
            if streams != "err" {
                command.stdout(writer.try_clone().unwrap());
            }
            if streams != "out" {
                command.stderr(writer);
            }
            assert_eq!(command.status().unwrap().code(), Some(0), "homebody {words}, without {streams}");
        }
    }
}

#[test]
fn failing_to_print_is_an_error() {
    let folder = flat();
    for words in ["run flat --json --for 1m --out csv:a.csv", "coverage flat", "check flat --json", "completions zsh"] {
        let mut command = folder.command(words);
        let full = File::options().write(true).open("/dev/full").unwrap();
        let output = command.stdin(Stdio::null()).stdout(full).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "homebody {words}: {said}");
        assert!(said.contains("standard output") && !said.contains("panicked"), "homebody {words}: {said}");
    }
}

#[test]
fn a_scenario_is_named_by_its_folder_or_its_file() {
    let folder = Folder::new();
    for scenario in ["tigerplace", "tigerplace/scenario.json"] {
        let words = format!("run {ROOT}/scenarios/{scenario} --for 3h --quiet --force --out csv:log.csv");
        folder.run(&words).ok();
        assert!(folder.read("log.csv").lines().count() > 10);
    }
}
