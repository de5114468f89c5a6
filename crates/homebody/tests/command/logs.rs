//! Converting logs between forms, and comparing them.

use crate::flat::flat;
use crate::folder::Folder;
use serde_json::json;

/// The rows of a CSV file without their numbers.
fn rows(folder: &Folder, name: &str) -> Vec<String> {
    folder.read(name).lines().skip(1).map(|line| line.split_once(',').unwrap().1.into()).collect()
}

#[test]
fn a_log_goes_round_all_forms_and_stays_the_same() {
    let folder = flat();
    folder.run("run flat --for 10m --quiet --out csv:log.csv --out sqlite:log.db").ok();
    let whole = rows(&folder, "log.csv");
    assert!(whole.len() > 300);
    let mut from = String::from("log.db");
    for to in ["casas:1.txt", "sqlite:2.db", "csv:3.csv", "casas:4.txt", "csv:5.csv", "sqlite:6.db", "csv:7.csv"] {
        let done = folder.run(&format!("convert {from} --out {to}")).ok();
        assert_eq!(done.out, "");
        let said = done.err.replace(',', "");
        assert!(said.contains(&format!("{to}: {} rows from 4 sensors", whole.len())), "{said}");
        from = to.split_once(':').unwrap().1.into();
    }
    for name in ["3.csv", "5.csv", "7.csv"] {
        assert_eq!(rows(&folder, name), whole, "{name}");
    }
    assert_eq!(folder.read("1.txt"), folder.read("4.txt"));
    let sql = "SELECT fired_at || ',' || sensor || ',' || value FROM firing ORDER BY seq";
    assert_eq!(folder.query("6.db", sql), whole);
}

#[test]
fn a_log_with_names_of_its_own_goes_round_too() {
    let folder = Folder::with("tigerplace");
    let words = "run tigerplace --for 1d --quiet --out csv:log.csv --out sqlite:log.db --out casas:log.txt";
    folder.run(words).ok();
    assert!(folder.read("log.csv").starts_with("seq,ts_local,sensor_id,event_code\n"));
    for (number, from) in ["log.csv", "log.db", "log.txt", "csv:log.csv"].into_iter().enumerate() {
        folder.run(&format!("convert {from} --out csv:{number}.csv")).ok();
        assert_eq!(rows(&folder, &format!("{number}.csv")), rows(&folder, "log.csv"), "{from}");
    }
}

#[test]
fn reports_the_rows_left_out_of_a_log() {
    let folder = Folder::new();
    folder.write("dirty.txt", "2009-03-02 07:12:03 M1 ON\nnonsense\n2009-03-02 07:12:09 M1 OFF\n");
    folder.run("convert dirty.txt --out csv:clean.csv").ok().says(&["dirty.txt:2: skipped: "]);
    let clean = ["2009-03-02 07:12:03.000000,M1,ON", "2009-03-02 07:12:09.000000,M1,OFF"];
    assert_eq!(rows(&folder, "clean.csv"), clean);
    folder.run("compare dirty.txt clean.csv").ok().says(&["dirty.txt: skipped 1 line"]);
}

#[test]
fn no_log_is_carried_onto_itself() {
    let folder = flat();
    folder.run("run flat --for 1m --quiet --out csv:log.csv --out sqlite:log.db").ok();
    for (from, to) in [("log.csv", "csv:log.csv"), ("log.db", "sqlite:./flat/../log.db"), ("log.csv", "casas:log.csv")]
    {
        let before = folder.sha256(from);
        folder.run(&format!("convert {from} --out {to} --force")).fails(1, "error[log::is-source]");
        assert_eq!(folder.sha256(from), before);
    }
}

#[test]
fn no_file_makes_convert_break_down() {
    let folder = flat();
    folder.run("run flat --for 1m --quiet --out csv:log.csv --out sqlite:log.db --out casas:log.txt").ok();
    for name in ["log.csv", "log.db", "log.txt"] {
        let whole = std::fs::read(folder.path(name)).unwrap();
        for part in 0..4 {
            let mut bytes = whole[..whole.len() * part / 4].to_vec();
            folder.write("cut", &bytes);
            let cut = folder.run("convert cut --out csv:new.csv --force");
            bytes.extend(whole[bytes.len()..].iter().map(|byte| byte.wrapping_add(part as u8 * 7)));
            folder.write("cut", &bytes);
            let changed = folder.run("convert cut --out csv:new.csv --force");
            for done in [cut, changed] {
                assert!(matches!(done.code, Some(0..=2)) && !done.err.is_empty(), "{name}, {part}: {}", done.err);
            }
        }
    }
    assert!(!folder.files().iter().any(|name| name.contains(".part")), "{:?}", folder.files());
}

#[test]
fn logs_are_compared() {
    let folder = flat();
    folder.run("run flat --quiet").ok();
    folder.run("run flat --quiet").ok();
    folder.run("run flat --quiet --for 432s --out casas:half.txt").ok();
    let same = folder.run("compare runs/flat-2 runs/flat-1 --json").ok().json();
    let (a, b) = (&same["firings"]["a"], &same["firings"]["b"]);
    assert!(a.as_u64().unwrap() > 100 && a == b, "{same}");
    assert_eq!((&same["firings"]["agreement"], &same["agreement_by_sensor"]), (&json!(1.0), &json!(1.0)));
    assert_eq!((&same["gaps_pooled"], &same["gaps_anywhere"]), (&json!(0.0), &json!(0.0)));
    assert_eq!(same["sensors"].as_array().unwrap().len(), 4);

    let half = folder.run("compare half.txt runs/flat-1/log.db --json").ok().json();
    let agreement = half["firings"]["agreement"].as_f64().unwrap();
    assert!((0.4..0.6).contains(&agreement), "{half}");
    // A ground truth is not a log.
    folder.run("compare runs/flat-1/truth.db runs/flat-1").fails(2, "error[log-form::no-log-table]");

    // A log without firings is reported, because its agreement has no meaning.
    folder.write("room.txt", "2009-03-02 07:12:03 T1 21.5\n2009-03-02 07:13:03 T1 21.6\n");
    let said = folder.run("compare room.txt runs/flat-1").ok().err;
    assert_eq!(said, "room.txt: no row marks the start of an event; its values are \"21.5\", \"21.6\"\n");

    let words = folder.run("compare half.txt runs/flat-1").ok();
    assert!(words.out.contains("KitchenWall") && words.err.is_empty(), "{}", words.out);
}
