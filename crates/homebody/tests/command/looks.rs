//! Inspecting a log, converting its activities, and anonymising it.

use crate::flat::flat;
use crate::folder::Folder;
use serde_json::json;

/// A log of two days with a clock that is set back, and with an invalid line.
const LOG: &str = "2009-03-02 07:00:00 M1 ON Cook begin\n2009-03-02 07:00:04 M1 OFF\nnonsense\n\
    2009-03-02 07:01:00 D1 OPEN\n2009-03-02 07:00:30 D1 CLOSE Cook end\n2009-03-03 21:00:00 T1 21.5\n\
    2009-03-03 21:00:00 T1 unavailable\n2009-03-03 21:00:05 M1 OFF\n";

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("log.txt", LOG);
    folder
}

#[test]
fn inspects_a_log_in_figures_words_and_pictures() {
    let folder = folder();
    folder.run("inspect log.txt --json look.json --html look.html --png look.png --svg look.svg").ok().prints(&[
        "7 rows of 3 sensors, 2009-03-02 07:00:00 to 2009-03-03 21:00:05",
        "line 3: there are no date, time, sensor and value",
    ]);
    let look = folder.json("look.json");
    assert_eq!((&look["rows"], &look["refused"], &look["set_back"]), (&json!(7), &json!([3]), &json!(1)));
    assert_eq!((&look["first"], &look["last"]), (&json!("2009-03-02 07:00:00"), &json!("2009-03-03 21:00:05")));
    assert_eq!((&look["missing"], look["silences"].as_array().unwrap().len()), (&json!(1), 1));
    let sensors: Vec<_> =
        look["sensors"].as_array().unwrap().iter().map(|of| (&of["id"], &of["kind"], &of["rows"])).collect();
    let wanted = [("D1", "contact", 2), ("M1", "motion", 3), ("T1", "reading", 2)]
        .map(|(id, kind, rows)| (json!(id), json!(kind), json!(rows)));
    assert_eq!(sensors, wanted.each_ref().map(|(id, kind, rows)| (id, kind, rows)));
    assert_eq!(look["activities"][0]["label"], "Cook");
    assert!(
        folder.read("look.html").contains("<figure><svg")
            && folder.read("look.svg").contains("Rows of each sensor by day")
    );
    // Nothing is replaced that is there, and nothing is written then.
    folder.run("inspect log.txt --html look.html").fails(1, "[log::exists]: look.html");
    folder.write("empty.txt", "");
    folder.run("inspect empty.txt").fails(2, "error[log-form::empty]");
    assert!(folder.run("inspect casas:empty.txt").ok().out.contains("0 rows of 0 sensors"));
    folder.run("inspect casas:empty.txt --svg empty.svg").ok();
    assert!(folder.read("empty.svg").contains("There is no row."));
    folder.run("inspect none.txt").fails(1, "[log::not-found]: none.txt");
    folder.write("junk.bin", "\u{0}\u{1},\u{2}\n");
    folder.run("inspect junk.bin").fails(2, "error[log-form::binary]");
    folder.run("convert junk.bin --out csv:junk.csv").fails(2, "error[log-form::binary]");
    assert!(!folder.path("junk.csv").exists());
}

#[test]
fn a_home_and_a_map_say_what_fits() {
    let folder = flat();
    folder.write("log.txt", LOG);
    folder.write("map.csv", "id,name\nM1,KitchenWall\nD1,BedroomWall\n");
    let look = folder.run("inspect log.txt --home flat --sensors map.csv --json").ok().json();
    let home = &look["home"];
    assert_eq!((&home["known"], &home["unknown"][0]["id"]), (&json!(2), &json!("T1")));
    assert!((home["known_share"].as_f64().unwrap() - 5.0 / 7.0).abs() < 1e-9, "{home}");
    assert_eq!(home["misfits"][0]["name"], "BedroomWall");
    assert!(home["unheard"].as_array().unwrap().contains(&json!("StudyFloor")), "{home}");
    folder.write("twice.csv", "id,name\nM1,a\nM2,a\nM1,b\n,c\n");
    let said = folder
        .run("inspect log.txt --sensors twice.csv")
        .fails(2, "twice.csv:3:1: error[sensor-table::duplicate-name]");
    assert!(
        said.err.contains("twice.csv:4:1: error[sensor-table::duplicate-id]") && said.err.contains("twice.csv:5:"),
        "{}",
        said.err
    );
    folder.write("other.csv", "what,name\n");
    folder.run("inspect log.txt --sensors other.csv").fails(2, "other.csv:1:1: error[sensor-table::no-heading]");
    // One log by its ids, the other by names: the map ties them.
    folder.write("named.txt", "2009-03-02 07:00:00 KitchenWall ON\n2009-03-02 07:00:09 KitchenWall ON\n");
    let compared = folder.run("compare log.txt named.txt --sensors map.csv --json").ok().json();
    assert_eq!(compared["sensors_in_common"], 1);
    assert_eq!(folder.run("compare log.txt named.txt --json").ok().json()["sensors_in_common"], 0);
}

#[test]
fn a_mapping_names_another_networks_table() {
    let folder = Folder::new();
    folder.write("odd.csv", "what,when,who,code\nx,2009-03-02 07:00:00,M1,5\nx,2009-03-02 07:00:09,M1,0\n");
    folder.write("logger.json", r#"{ "columns": { "time": "when", "sensor": "who", "value": "code" } }"#);
    folder.run("convert odd.csv --mapping logger.json --out casas:log.txt").ok();
    assert_eq!(folder.read("log.txt"), "2009-03-02 07:00:00.000000\tM1\t5\n2009-03-02 07:00:09.000000\tM1\t0\n");
    folder.write("wrong.json", r#"{ "colums": {} }"#);
    folder.run("inspect odd.csv --mapping wrong.json").fails(2, "wrong.json: error[mapping::invalid]: ");
}

#[test]
fn the_truth_goes_along_as_notes_where_it_is_asked_for() {
    let folder = Folder::with("tigerplace");
    folder.run("run tigerplace --for 1d --quiet --out csv:log.csv --truth truth.db").ok();
    folder.run("convert log.csv --out casas:plain.txt").ok();
    folder.run("convert log.csv --out casas:noted.txt --activities").ok();
    let (plain, noted) = (folder.read("plain.txt"), folder.read("noted.txt"));
    let rows: Vec<String> = noted.lines().map(|line| line.split('\t').take(3).collect::<Vec<_>>().join("\t")).collect();
    assert_eq!(rows, plain.lines().collect::<Vec<_>>());
    let notes = |end: &str| noted.lines().filter(|line| line.ends_with(end)).count();
    let told = folder.query("truth.db", "SELECT count(*) FROM activity WHERE name IS NOT NULL");
    assert!(notes(" begin") > 10 && notes(" begin") == notes(" end"), "{noted}");
    assert_eq!(told, [notes(" begin").to_string()]);
    folder.write("alone/log.csv", folder.read("log.csv"));
    folder
        .run("convert alone/log.csv --out casas:x.txt --activities")
        .fails(1, "error[log-content::no-truth]: alone/log.csv");
}

#[test]
fn a_log_becomes_nobodys() {
    let folder = folder();
    let said = folder.run("anonymise log.txt --out csv:nobodys.csv --key key.csv").ok();
    let rows = "seq,fired_at,sensor,value\n0,2001-01-01 07:00:00.000000,motion1,ON\n1,2001-01-01 07:00:04.000000,motion1,OFF\n\
        2,2001-01-01 07:01:00.000000,contact1,OPEN\n3,2001-01-01 07:00:30.000000,contact1,CLOSE\n\
        4,2001-01-02 21:00:00.000000,reading1,21.5\n5,2001-01-02 21:00:00.000000,reading1,unavailable\n\
        6,2001-01-02 21:00:05.000000,motion1,OFF\n";
    assert_eq!(folder.read("nobodys.csv"), rows, "{}", said.err);
    assert!(!said.err.contains("with other text"), "{}", said.err);
    assert_eq!(folder.read("key.csv"), "id,name\nmotion1,M1\ncontact1,D1\nreading1,T1\n");
    assert!(folder.run("inspect nobodys.csv --sensors key.csv").ok().out.contains("motion1 (M1)"));
    folder.run("anonymise log.txt --out sqlite:kept.db --activities --weeks -1").ok();
    let spans = folder.query("kept.db", "SELECT start_time || ' ' || end_time || ' ' || activity FROM activity");
    assert_eq!(spans, ["2009-02-23 07:00:00.000000 2009-02-23 07:00:30.000000 Cook"]);
    let everything = folder.dump("kept.db");
    assert!(!everything.contains("M1") && !everything.contains("log.txt"), "{everything}");
    folder.run("anonymise log.txt --out casas:log.txt --force").fails(1, "error[log::is-source]");
}
