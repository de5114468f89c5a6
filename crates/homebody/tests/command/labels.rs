//! Labelling logs by the ground truth of their run, for any clocks of both, and errors.

use crate::flat::flat;
use crate::folder::Folder;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::TimeScale;
use homebody_log::label;
use homebody_log::{LogSource, Transfer, Url, WriteMode, survey};
use rusqlite::Connection;
use std::fs;

/// The content of a labelled file, without the number and the instant of each row.
fn labels(folder: &Folder, name: &str) -> Vec<String> {
    let rest = |line: &str| line.splitn(3, ',').nth(2).unwrap().to_owned();
    folder.read(name).lines().skip(1).map(rest).collect()
}

fn differing(one: &[String], other: &[String]) -> usize {
    assert_eq!(one.len(), other.len());
    one.iter().zip(other).filter(|(one, other)| one != other).count()
}

/// A day and night of November in which clocks go back, by the clock on the wall and by the world's.
#[test]
fn the_hour_that_clocks_tell_twice_is_labelled_as_two() {
    let folder = Folder::with("tigerplace");
    folder.edit_json("tigerplace/scenario.json", |scenario| scenario["start"] = "2009-10-31T12:00:00".into());
    for (number, time) in ["utc", "local"].into_iter().enumerate() {
        folder.edit_json("tigerplace/logger.json", |logger| logger["time"] = time.into());
        folder.run("run tigerplace --for 24h --quiet").ok();
        folder.run(&format!("label runs/tigerplace-{} --out csv:{time}.csv", number + 1)).ok();
    }
    let reference = labels(&folder, "utc.csv");
    assert!(reference.len() > 3000);
    assert_eq!(differing(&labels(&folder, "local.csv"), &reference), 0);

    // The control: by what the files tell alone, the two hours are one.
    let [from, truth, to] = ["sqlite:runs/tigerplace-2/log.db", "sqlite:runs/tigerplace-2/truth.db", "csv:told.csv"]
        .map(|url| url.parse::<Url>().unwrap().within(&folder.path("")));
    let mapping = LoggerFile::default();
    let about = survey(&from, &mapping).unwrap();
    let transfer = Transfer {
        from: &LogSource::from(&from),
        mapping: &mapping,
        to: &to,
        name: "told",
        zone: "UTC",
        how: WriteMode::Create,
    };
    label(&transfer, &about, &truth, &TimeScale::one(), |_| ()).unwrap();
    let wrong = differing(&labels(&folder, "told.csv"), &reference);
    println!("{} rows, {wrong} wrong by what is told alone", reference.len());
    assert!(wrong > 0);
}

#[test]
fn a_truth_of_texts_is_found_next_to_its_log_and_checked() {
    let folder = flat();
    folder.run("run flat --for 20m --quiet --out csv:log.csv --truth csv:texts.csv").ok();
    folder.run("label log.csv csv:texts.csv --out csv:wanted.csv").ok();
    let wanted = folder.read("wanted.csv");
    assert!(wanted.lines().count() > 300 && wanted.contains(",movement,"));
    folder.run("run flat --for 20m --quiet --out csv:beside/log.csv --truth csv:beside/truth.csv").fails(1, "folder");
    fs::create_dir(folder.path("beside")).unwrap();
    folder.run("run flat --for 20m --quiet --out csv:beside/log.csv --truth csv:beside/truth.csv").ok();
    folder.run("label beside/log.csv --out csv:found.csv --force").ok();
    assert_eq!(folder.read("found.csv"), wanted);
    // Missing and invalid rows are reported.
    folder.run("label log.csv csv:texts.csv --out csv:texts.room.csv --force").fails(1, "error[log::is-source]");
    folder.edit("texts.room.csv", "resident,at,room", "resident,at,place");
    folder.run("label log.csv csv:texts.csv --out csv:x.csv").fails(1, "error[truth::no-column]");
    fs::remove_file(folder.path("texts.off.csv")).unwrap();
    folder.run("label log.csv csv:texts.csv --out csv:x.csv").fails(1, "it has no file texts.off.csv");
    assert!(!folder.path("x.csv").exists());
}

#[test]
fn does_not_blame_the_truth_for_faults_of_a_log() {
    let folder = flat();
    folder.run("run flat --for 10m --quiet --out csv:log.csv --truth truth.db").ok();
    let text = folder.read("log.csv");
    let lines: Vec<&str> = text.lines().collect();
    let dirty = [&lines[..3], &["3,never,Fridge,ON", "nonsense"], &lines[3..]].concat().join("\n");
    folder.write("dirty.csv", dirty);
    let said = folder
        .run("label dirty.csv truth.db --out csv:x.csv")
        .fails(1, "error[log::unreadable-rows]: cannot read 2 lines")
        .err;
    assert!(said.contains("dirty.csv:4: ") && said.contains("hint: ") && !said.contains("truth.db"), "{said}");

    folder.write("empty.db", "");
    Connection::open(folder.path("other.db")).unwrap().execute_batch("CREATE TABLE cause (row)").unwrap();
    folder.write("text.txt", "no truth at all, but a text that is long enough to be looked at");
    for (truth, said) in [
        ("empty.db", "error[truth::missing-parts]"),
        ("other.db", "it has no column \"firing\" of \"cause\""),
        ("text.txt", "error[truth::not-a-database]"),
        ("none.db", "[log::not-found]: none.db"),
        ("casas:log.csv", "error[truth::casas]"),
    ] {
        folder.run(&format!("label log.csv {truth} --out csv:x.csv")).fails(1, said).says(&["\n  hint: "]);
    }
    fs::rename(folder.path("truth.db"), folder.path("moved.db")).unwrap();
    folder.run("label log.csv --out csv:x.csv").fails(1, "error[log-content::no-truth]: csv:log.csv");
    assert!(!folder.path("x.csv").exists());
    // The hints lead to a labelled log.
    folder.run("label log.csv moved.db --out csv:x.csv").ok();
}

const READERS: [&str; 6] = [
    "label RUN --out csv:x.csv",
    "convert RUN --out csv:x.csv",
    "compare RUN RUN",
    "density RUN",
    "day RUN first",
    "convert RUN/LOG --out csv:x.csv",
];

#[test]
fn a_run_without_rows_yet_is_told_as_such() {
    for (log, without) in
        [("sqlite:log.db", true), ("sqlite:log.db", false), ("csv:log.csv", true), ("casas:log.txt", true)]
    {
        let folder = flat();
        folder.edit_json("flat/logger.json", |logger| {
            logger["to"] = serde_json::json!([log]);
            // Names that cannot be guessed.
            logger["table"] = "hits".into();
            logger["columns"] = serde_json::json!({ "time": "zeit", "sensor": "wer", "value": "was" });
        });
        folder.run("run flat --for 10m --quiet").ok();
        let name = log.split_once(':').unwrap().1;
        // A database that was emptied has other pages.
        let left = || match log.starts_with("sqlite") {
            true => folder.dump("runs/flat-1/log.db"),
            false => folder.read(&format!("runs/flat-1/{name}")),
        };
        let whole = left();
        // As a kill leaves it before the first rows.
        folder.unfinish("runs/flat-1");
        match (without, log) {
            (false, _) => {
                let database = Connection::open(folder.path("runs/flat-1/log.db")).unwrap();
                database.execute_batch("DELETE FROM hits; UPDATE run SET ended_at = NULL").unwrap();
            }
            (true, "sqlite:log.db") => folder.write("runs/flat-1/log.db", ""),
            (true, _) => fs::remove_file(folder.path(&format!("runs/flat-1/{name}"))).unwrap(),
        }
        for words in READERS
            .iter()
            .filter(|words| folder.path(&format!("runs/flat-1/{name}")).exists() || !words.contains("LOG"))
        {
            let words = words.replace("LOG", name).replace("RUN", "runs/flat-1");
            let said = "[kit::no-rows]: the run in runs/flat-1";
            folder.run(&words).fails(1, said);
        }
        fs::remove_file(folder.path("runs/flat-1/truth.db")).unwrap();
        folder.run("run --resume runs/flat-1 --quiet").ok();
        assert!(left() == whole, "{log}");
        folder.run("convert runs/flat-1 --out csv:x.csv").ok();
    }
}

fn all(folder: &Folder) -> Vec<(String, Vec<u8>)> {
    folder.files().into_iter().map(|name| (name.clone(), fs::read(folder.path(&name)).unwrap())).collect()
}

#[test]
fn no_file_of_a_run_is_replaced() {
    let folder = flat();
    folder.run("run flat --for 5m --quiet").ok();
    folder.run("convert runs/flat-1 --out csv:elsewhere.csv").ok();
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("runs/flat-1/truth.db", folder.path("link.db")).unwrap();
        std::os::unix::fs::symlink("runs/flat-1", folder.path("linked")).unwrap();
    }
    let before = all(&folder);
    let files = [
        "sqlite:runs/flat-1/truth.db",
        "csv:runs/flat-1/recording.json",
        "csv:runs/../runs/flat-1/sensors.csv",
        "sqlite:./runs/flat-1/x/../truth.db",
        "sqlite:link.db",
        "sqlite:linked/truth.db",
    ];
    fs::create_dir(folder.path("runs/flat-1/x")).unwrap();
    for to in if cfg!(unix) { &files[..] } else { &files[..4] } {
        folder.run(&format!("convert elsewhere.csv --out {to} --force")).fails(1, "log::file-of-run");
        let said = if to.ends_with(".db") { "error[log::is-source]" } else { "log::file-of-run" };
        folder.run(&format!("label runs/flat-1 --out {to} --force")).fails(1, said);
    }
    fs::remove_dir(folder.path("runs/flat-1/x")).unwrap();
    assert_eq!(all(&folder), before);
    // Files that the run did not write may be replaced.
    folder.run("convert elsewhere.csv --out csv:runs/flat-1/log.csv").ok();
    // A run that is under way is going to have its log.
    folder.edit_json("flat/logger.json", |logger| logger["to"] = serde_json::json!(["csv:own/name.csv"]));
    let mut running = folder.start("run flat --for 10m --quiet --control --paused");
    folder.until("the run is begun", |folder| folder.path("runs/flat-2/recording.json").exists());
    folder.run("convert elsewhere.csv --out csv:runs/flat-2/own/name.csv").fails(1, "log::file-of-run");
    running.say("stop\n");
    running.finish().ok();
    assert!(folder.path("runs/flat-2/own/name.csv").exists());
}

#[test]
fn a_log_and_the_tables_of_a_truth_have_files_of_their_own() {
    let folder = flat();
    let before = folder.files();
    folder.run("run flat --for 5m --quiet --out csv:t.room.csv --truth csv:./t.csv").fails(2, "log::same-file");
    assert_eq!(folder.files(), before);
    folder.write("t.cause.csv", "somebody's");
    folder.run("run flat --for 5m --quiet --out csv:t.csv --truth csv:t.csv").fails(1, "[log::exists]: t.cause.csv");
    assert_eq!(folder.read("t.cause.csv"), "somebody's");
    fs::remove_file(folder.path("t.cause.csv")).unwrap();
    // Of one name, but of files of their own.
    folder.run("run flat --for 5m --quiet --out csv:t.csv --truth csv:t.csv").ok();
    folder.run("label t.csv csv:t.csv --out csv:labelled.csv").ok();
}
