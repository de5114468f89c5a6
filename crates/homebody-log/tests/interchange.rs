//! Logs as servers and gateways give them: JSON in one piece, messages of MQTT, tables of InfluxDB, logs of gateways. Their beginning
//! identifies each, and no row is lost. The texts are invented.

mod gateways;

use crate::stage::Folder;
use crate::stage::texts::{from_text as log, known, minutes, skipped, written};
use homebody_core::messages::Diagnose;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::{Interval, MINUTE, SECOND, WallTime};
use homebody_log::log::{Clock, ColumnRole};
use homebody_log::source::{HomeColumn, TableOptions};
use homebody_log::{Log, LogError, LogSource, read};
use std::fs;

/// 2 February 2026, 06:00.
const SIX: WallTime = WallTime::from_micros(1_770_012_000_000_000);

fn result(folder: &Folder, form: &str, name: &str, text: &str) -> Result<Log, LogError> {
    let source = LogSource::recognise(&written(folder, name, text)).unwrap();
    assert_eq!(source.form().name, form, "{text}");
    read(&source, &LoggerFile::default())
}

/// Rows as minutes since six, sensor, value.
fn told(log: &Log) -> Vec<(f64, &str, &str)> {
    minutes(log, SIX)
}

/// A sensor as the log describes it: name, kind, unit, room.
fn about<'l>(log: &'l Log, sensor: &str) -> [&'l str; 4] {
    let known = known(log, sensor);
    [&known.name, &known.kind, known.unit.as_deref().unwrap_or_default(), known.room.as_deref().unwrap_or_default()]
}

fn has_remark(log: &Log, part: &str) -> bool {
    log.remarks.iter().any(|remark| remark.contains(part))
}

fn is_used(log: &Log, column: &str, role: ColumnRole) -> bool {
    log.columns.iter().any(|used| used.column == column && used.used_as == role)
}

const HALL: &str = "binary_sensor.hall";
const TEMPERATURE: &str = "sensor.hall_temperature";

#[test]
fn the_history_of_home_assistant_is_put_into_the_order_of_time() {
    let folder = Folder::new("history");
    let all = r#"[[{"entity_id": "binary_sensor.hall", "state": "unavailable", "attributes": {"restored": true}, "last_changed": "2026-02-02T05:59:00+00:00", "last_updated": "2026-02-02T05:59:00+00:00"},
        {"entity_id": "binary_sensor.hall", "state": "on", "attributes": {"device_class": "motion", "friendly_name": "Hall", "area": "hall"}, "last_changed": "2026-02-02T06:00:00.250000+00:00", "last_updated": "2026-02-02T06:00:00.250000+00:00"},
        {"entity_id": "binary_sensor.hall", "state": "on", "attributes": {"device_class": "motion", "battery": 3}, "last_changed": "2026-02-02T06:00:00.250000+00:00", "last_updated": "2026-02-02T06:01:30+00:00"},
        {"entity_id": "binary_sensor.hall", "state": "off", "attributes": {}, "last_changed": "2026-02-02T07:02:00+01:00", "last_updated": "2026-02-02T06:02:00+00:00"}],
        [{"entity_id": "sensor.hall_temperature", "state": "21.5", "attributes": {"device_class": "temperature", "unit_of_measurement": "°C"}, "last_changed": "2026-02-02T06:01:00+00:00", "last_updated": "2026-02-02T06:01:00+00:00"}]]"#;
    let wanted =
        [(-1.0, HALL, "unavailable"), (0.25 / 60.0, HALL, "on"), (1.0, TEMPERATURE, "21.5"), (2.0, HALL, "off")];
    let whole = log(&folder, "json", "history.json", all);
    assert_eq!((told(&whole), whole.clock, whole.skipped), (wanted.to_vec(), Clock::Utc, 0));
    assert_eq!(about(&whole, HALL), ["Hall", "motion", "", "hall"]);
    assert_eq!(about(&whole, TEMPERATURE), [TEMPERATURE, "temperature", "°C", ""]);
    assert!(has_remark(&whole, "only attributes changed, passed over: 1"), "{:?}", whole.remarks);
    assert!(is_used(&whole, "last_changed", ColumnRole::Time) && is_used(&whole, "state", ColumnRole::Value));
    // The same in a line a value, and in one line alone.
    for (name, text) in [("pretty.json", all.replace(", ", ",\n")), ("line.json", all.replace('\n', ""))] {
        assert_eq!(told(&log(&folder, "json", name, &text)), wanted, "{name}");
    }
    // Later rows leave out the entity and attributes.
    let minimal = r#"[[{"entity_id": "binary_sensor.hall", "state": "on", "attributes": {"device_class": "door"}, "last_changed": "2026-02-02T06:00:00+00:00", "last_updated": "2026-02-02T06:00:00+00:00"},
        {"state": "off", "last_changed": "2026-02-02T06:01:00+00:00"}, {"state": "on", "last_changed": "2026-02-02T06:02:00+00:00"}],
        [{"entity_id": "light.stair", "state": "on", "last_changed": "2026-02-02T06:00:30+00:00", "last_updated": "2026-02-02T06:00:30+00:00"}, {"state": "off", "last_changed": "2026-02-02T06:01:00+00:00"}]]"#;
    let minimal = log(&folder, "json", "minimal.json", minimal);
    let rows = [
        (0.0, HALL, "on"),
        (0.5, "light.stair", "on"),
        (1.0, HALL, "off"),
        (1.0, "light.stair", "off"),
        (2.0, HALL, "on"),
    ];
    assert_eq!(told(&minimal), rows);
    assert_eq!((about(&minimal, HALL)[1], about(&minimal, "light.stair")[1]), ("door", "light"));
}

#[test]
fn states_over_a_websocket_are_named_by_their_keys() {
    let folder = Folder::new("websocket");
    let text = r#"{"id": 5, "type": "result", "success": true, "result": {"binary_sensor.hall": [
        {"s": "off", "a": {"device_class": "occupancy", "friendly_name": "Hall"}, "lu": 1770012000.5},
        {"s": "on", "a": {"device_class": "occupancy"}, "lu": 1770012090.0, "lc": 1770012060.25}, {"s": "off", "lu": 1770012120}],
        "sensor.hall_temperature": [{"s": "20", "lu": 1770011940.0}]}}"#;
    let log = log(&folder, "json", "answer.json", text);
    let rows = [(-1.0, TEMPERATURE, "20"), (0.5 / 60.0, HALL, "off"), (60.25 / 60.0, HALL, "on"), (2.0, HALL, "off")];
    assert_eq!((told(&log), log.skipped), (rows.to_vec(), 0));
    assert_eq!(about(&log, HALL), ["Hall", "occupancy", "", ""]);
}

#[test]
fn a_logbook_says_when_its_recorder_was_stopped() {
    let folder = Folder::new("logbook");
    let text = r#"[{"when": "2026-02-02T06:00:00.000000+00:00", "name": "Hall", "state": "on", "entity_id": "binary_sensor.hall", "context_user_id": null},
        {"when": "2026-02-02T06:01:00+00:00", "name": "Home Assistant", "message": "stopped", "domain": "homeassistant"},
        {"when": "2026-02-02T06:05:00+00:00", "name": "Home Assistant", "message": "started", "domain": "homeassistant"},
        {"when": "2026-02-02T06:06:00+00:00", "name": "Night", "message": "triggered by state of Hall", "entity_id": "automation.night", "domain": "automation"}]"#;
    let log = log(&folder, "json", "logbook.json", text);
    assert_eq!(told(&log), [(0.0, HALL, "on"), (6.0, "automation.night", "triggered by state of Hall")]);
    assert_eq!(log.gaps, [Interval::new(SIX + MINUTE, SIX + 5 * MINUTE)]);
    assert_eq!(about(&log, "automation.night")[1], "automation");
}

#[test]
fn datastreams_of_sensorthings_name_their_observations() {
    let folder = Folder::new("things");
    let text = r#"{"@iot.count": 3, "value": [
        {"@iot.id": 12, "name": "motion", "unitOfMeasurement": {"name": null, "symbol": null}, "ObservedProperty": {"name": "Occupancy"},
         "phenomenonTime": "2026-02-02T06:00:00Z/2026-02-02T06:02:00Z",
         "Observations": [{"@iot.id": 1, "phenomenonTime": "2026-02-02T06:02:00.000Z", "result": false, "resultTime": null},
                          {"@iot.id": 2, "phenomenonTime": "2026-02-02T06:00:00.000Z/2026-02-02T06:00:10.000Z", "result": true, "resultTime": null}]},
        {"@iot.id": 13, "name": "motion", "Observations": [{"phenomenonTime": "2026-02-02T06:01:00Z", "result": 1}]},
        {"Observations": [{"phenomenonTime": "2026-02-02T06:03:00Z", "result": 21.5}], "name": "warmth", "unitOfMeasurement": {"symbol": "°C"}, "@iot.id": 14}]}"#;
    let log = log(&folder, "json", "datastreams.json", text);
    let rows = [(0.0, "motion", "true"), (1.0, "motion (13)", "1"), (2.0, "motion", "false"), (3.0, "warmth", "21.5")];
    assert_eq!((told(&log), log.skipped), (rows.to_vec(), 0));
    assert_eq!((about(&log, "motion")[1], about(&log, "warmth")[2]), ("occupancy", "°C"));
    assert!(has_remark(&log, "earlier than the row of the same sensor before them"), "{:?}", log.remarks);
}

#[test]
fn observations_that_name_no_datastream_are_refused() {
    let folder = Folder::new("nameless");
    let row = |id: u32, link: &str| {
        format!(
            r#"{{"@iot.id": {id}, "phenomenonTime": "2026-02-02T06:0{id}:00Z", "result": 7, "Datastream@iot.navigationLink": "https://a/v1.1/{link}"}}"#
        )
    };
    let list = |links: [&str; 2]| format!(r#"{{"value": [{}, {}]}}"#, row(1, links[0]), row(2, links[1]));
    let linked = log(&folder, "json", "linked.json", &list(["Datastreams(4)", "Datastreams(5)"]));
    assert_eq!(told(&linked), [(1.0, "Datastreams(4)", "7"), (2.0, "Datastreams(5)", "7")]);
    let nameless = list(["Observations(1)/Datastream", "Observations(2)/Datastream"]);
    let error = result(&folder, "json", "nameless.json", &nameless).unwrap_err().to_string();
    assert!(error.contains("nothing names its sensor"), "{error}");
}

#[test]
fn lists_of_rows_are_read_whatever_is_around_them() {
    let folder = Folder::new("lists");
    let rows = r#"[
 {"time": "2026-02-02T06:00:00", "sensor": "hall", "value": "on", "room": {"floor": 1}},
 {"time": "2026-02-02T06:01:00", "sensor": "hall", "value": "off", "room": {"floor": 1}}
]"#;
    let wanted = [(0.0, "hall", "on"), (1.0, "hall", "off")];
    let others = [
        rows.to_owned(),
        rows.replace(['\n', ' '], ""),
        format!("\u{feff}{rows}\n"),
        format!(r#"{{"data": {rows}, "page": 1}}"#),
        format!(r#"{{"status": "ok", "results": {{"rows": {rows}}}}}"#),
        rows.trim_matches(['[', ']']).replace("},", "}").replace(", ", ",\n"),
rows.replace("\"2026-02-02T06:00:00\"", "1770012000").replace("\"2026-02-02T06:01:00\"", "1770012060.0"),
        r#"{"hall": [["2026-02-02T06:00:00", "on"], ["2026-02-02T06:01:00", "off"]]}"#.into(),
        r#"{"hall": [[1770012000, "on"], [1770012060000, "off"]]}"#.into(),
        r#"[["2026-02-02T06:00:00", "hall", "on"], ["2026-02-02T06:01:00", "hall", "off"]]"#.into(),
        r#"[{"target": "hall", "datapoints": [["on", 1770012000], ["off", 1770012060]]}]"#.into(),
        r#"{"status": "success", "data": {"resultType": "matrix", "result": [{"metric": {"room": "hall"}, "values": [[1770012000, "on"], [1770012060, "off"]]}]}}"#.into(),
        r#"{"results": [{"statement_id": 0, "series": [{"name": "hall", "columns": ["time", "value"], "values": [["2026-02-02T06:00:00", "on"], ["2026-02-02T06:01:00", "off"]]}]}]}"#.into(),
        r#"{"columns": ["time", "number", "device", "state"], "data": [["2026-02-02T06:00:00", 1, "hall", "on"], ["2026-02-02T06:01:00", 1, "hall", "off"]]}"#.into(),
        r#"{"name": "hall", "datapoints": "2", "data": [{"time": 1770012000000, "state": "on"}, {"time": 1770012060000, "state": "off"}]}"#.into(),
        r#"{"hall": [{"ts": 1770012000000, "value": "on"}, {"ts": 1770012060000, "value": "off"}]}"#.into(),
        r#"[{"Zeit": "2026-02-02T06:00:00", "Geraet": "hall", "Zustand": "on"}, {"Zeit": "2026-02-02T06:01:00", "Geraet": "hall", "Zustand": "off"}]"#.into(),
        r#"[{"date": "2026-02-02", "time": "06:00:00", "device": {"name": "hall"}, "state": "on"}, {"date": "2026-02-02", "time": "06:01:00", "device": {"name": "hall"}, "state": "off"}]"#.into(),
    ];
    for (number, text) in others.iter().enumerate() {
        let log = log(&folder, "json", &format!("{number}.json"), text);
        assert_eq!((told(&log), log.skipped), (wanted.to_vec(), 0), "{text}");
        assert!(!log.columns.is_empty(), "{text}");
    }
}

#[test]
fn rows_without_a_value_have_a_reading_under_each_other_key() {
    let folder = Folder::new("wide");
    let device = r#"[{"timestamp": 1770012000, "device": "hall", "occupancy": true, "battery": 97}, {"timestamp": 1770012060, "device": "hall", "occupancy": false, "battery": null}]"#;
    let device = log(&folder, "json", "device.json", device);
    assert_eq!(
        told(&device),
        [(0.0, "hall occupancy", "true"), (0.0, "hall battery", "97"), (1.0, "hall occupancy", "false")]
    );
    let wide = "[{\"time\": \"2026-02-02T06:00:00Z\", \"hall\": 1, \"stair\": 0}]";
    let wide = log(&folder, "json", "wide.json", wide);
    assert_eq!(told(&wide), [(0.0, "hall", "1"), (0.0, "stair", "0")]);
    assert!(is_used(&wide, "all other keys", ColumnRole::OneSensor));
}

#[test]
fn rows_of_two_homes_are_refused_and_those_of_one_are_read() {
    let folder = Folder::new("homes");
    let row = |home: &str, minute: u32| {
        format!(
            r#"{{"time": "2026-02-02T06:0{minute}:00Z", "home_id": "{home}", "sensor": "hall", "value": "on", "room": "hall", "kind": "motion"}}"#
        )
    };
    for (form, name, [open, between, close]) in
        [("json", "homes.json", ["[", ",", "]"]), ("jsonl", "homes.jsonl", ["", "\n", ""])]
    {
        let text = |homes: [&str; 2]| format!("{open}{}{between}{}{close}", row(homes[0], 0), row(homes[1], 1));
        let log = log(&folder, form, name, &text(["A", "A"]));
        assert_eq!(told(&log), [(0.0, "hall", "on"), (1.0, "hall", "on")]);
        assert!(is_used(&log, "home_id", ColumnRole::Home) && is_used(&log, "room", ColumnRole::Room));
        assert_eq!(about(&log, "hall"), ["hall", "motion", "", "hall"]);
        let error = result(&folder, form, name, &text(["A", "B"])).unwrap_err().diagnostic();
        assert_eq!((error.code, &error.data["first"]), ("log-table::several-homes", &"A".into()));
        assert!(error.hint.unwrap().contains("--home-column 'home_id=A'"));
        let of_home = |home: &str| {
            let home = Some(HomeColumn { column: "home_id".into(), home: Some(home.into()) });
            let place = LogSource::recognise(&folder.path().join(name)).unwrap();
            read(place.with_options(TableOptions { home, ..TableOptions::default() }), &LoggerFile::default())
        };
        assert_eq!((told(&of_home("B").unwrap()), of_home("*").unwrap().rows), (vec![(1.0, "hall", "on")], 2));
        let error = of_home("C").unwrap_err().diagnostic();
        let homes = ["\"A\"", "\"B\""].to_vec();
        assert_eq!((error.code, &error.data["homes"]), ("log-table::no-such-home", &homes.into()));
    }
    let above = r#"[{"home": "A", "rows": [{"time": 1770012000, "sensor": "hall", "value": 1}]}, {"home": "B", "rows": [{"time": 1770012000, "sensor": "hall", "value": 1}]}]"#;
    assert_eq!(result(&folder, "json", "above.json", above).unwrap_err().code(), "log-table::several-homes");
}

#[test]
fn a_row_that_is_no_json_costs_no_other_row() {
    let folder = Folder::new("broken");
    let row =
        |minute: usize| format!(r#"{{"time": "2026-02-02T06:0{minute}:00Z", "sensor": "hall", "value": "{minute}"}},"#);
    let good: Vec<String> = (0..6).map(row).collect();
    for (broken, what) in [
        (good[2].replacen('"', "", 1), "a quote less"),
        (good[2].replacen("hall", "ha\"ll", 1), "a quote more"),
        (good[2].replacen('}', "", 1), "no end"),
        (good[2].replacen('{', "", 1), "no beginning"),
        (good[2][..30].to_owned(), "cut"),
        (format!("\"{}", good[2]), "a quote first"),
        (good[2].replacen(':', "", 1), "no colon"),
        ("nonsense".into(), "a word"),
    ] {
        let mut lines = good.clone();
        lines[2] = broken;
        let text = format!("[\n{}\n]\n", lines.join("\n").trim_end_matches(','));
        let log = log(&folder, "json", "rows.json", &text);
        let values: Vec<&str> = told(&log).into_iter().map(|(.., value)| value).collect();
        assert_eq!(values, ["0", "1", "3", "4", "5"], "{what}");
        assert_eq!(skipped(&log), [4], "{what}: {:?}", log.problems);
    }
    // A text that is cut short says so.
    let cut = format!("[\n{}", good.join("\n"));
    let log = log(&folder, "json", "cut.json", &cut[..cut.len() - 10]);
    assert_eq!((log.rows, log.skipped > 0), (5, true));
}

#[test]
fn json_that_is_no_log_is_refused_with_what_would_do() {
    let folder = Folder::new("refused");
    assert_eq!(result(&folder, "json", "other.json", "[]").unwrap_err().code(), "log-form::empty-json");
    for text in [
        "{}",
        r#"{"name": "a home", "rooms": [{"name": "hall"}]}"#,
        r#"[{"a": 1}, {"a": 2}]"#,
        r#"{"time": ["2026-02-02T06:00:00Z"], "value": [1]}"#,
    ] {
        let error = result(&folder, "json", "other.json", text).unwrap_err().diagnostic();
        assert_eq!(error.code, "log-form::json-without-rows", "{text}");
        assert!(error.data["command"].as_str().unwrap().starts_with("jq -c"), "{text}: {error}");
    }
    // A folder with a log and another JSON has one log.
    let folder = Folder::new("beside");
    fs::write(folder.path().join("home.json"), r#"{"name": "a home", "sensors": [{"name": "hall", "room": "hall"}]}"#)
        .unwrap();
    fs::write(folder.path().join("log.csv"), "time,sensor,value\n2026-02-02 06:00:00,hall,ON\n").unwrap();
    assert_eq!(LogSource::recognise(folder.path()).unwrap().form().name, "csv");
    // Lists too deep in each other, and a text without an end.
    let deep = format!("[{}{{\"time\": 1770012000, \"sensor\": \"a\", \"value\": 1}}", "[".repeat(1000));
    assert!(matches!(result(&folder, "json", "deep.json", &deep), Err(LogError::TooLong { .. })));
    let long = format!("[\"{}\"]", "x".repeat(2 << 20));
    assert!(matches!(result(&folder, "json", "long.json", &long), Err(LogError::TooLong { .. })));
}

#[test]
fn a_json_of_any_size_is_gone_through_part_by_part() {
    let folder = Folder::new("large");
    let row = |number: usize| {
        format!(r#"{{"s": "{}", "a": {{"x": "{}"}}, "lu": {}}}"#, number % 2, "y".repeat(90), 1_770_012_000 + number)
    };
    let list = |from: usize| (from..from + 20_000).map(row).collect::<Vec<_>>().join(",\n");
    let text = format!("{{\"result\": {{\"binary_sensor.a\": [{}], \"binary_sensor.b\": [{}]}}}}", list(0), list(0));
    assert!(text.len() > 3 << 20);
    let log = log(&folder, "json", "large.json", &text);
    assert_eq!((log.rows, log.sensors.len(), log.skipped), (40_000, 2, 0));
    assert!(log.events.is_sorted_by_key(|event| event.at));
    assert_eq!(log.events.last().map(|event| event.at), Some(SIX + 19_999 * SECOND));
}

#[test]
fn line_protocol_is_read_in_any_precision() {
    let folder = Folder::new("lines");
    let text = |zeros: &str| {
        format!(
            "# DML\nbinary_sensor,entity_id=hall,domain=binary_sensor value=1,state=\"on\",device_class_str=\"motion\",friendly_name_str=\"The hall\" 1770012000{zeros}\n\
             binary_sensor,entity_id=hall,domain=binary_sensor value=0,state=\"off\" 1770012120{zeros}\n\
             °C,entity_id=warmth,domain=sensor value=21.5 1770012060{zeros}\n\
             air,room=living\\ room co2=400i,open=f 1770012180{zeros}\nair,room=hall co2=401i 1770012180{zeros}\nnonsense\n"
        )
    };
    for zeros in ["", "000", "000000", "000000000"] {
        let log = log(&folder, "influx-lines", "a.lp", &text(zeros));
        let rows = [
            (0.0, "binary_sensor.hall", "on"),
            (1.0, "sensor.warmth", "21.5"),
            (2.0, "binary_sensor.hall", "off"),
            (3.0, "air living room co2", "400"),
            (3.0, "air living room open", "false"),
            (3.0, "air hall co2", "401"),
        ];
        assert_eq!((told(&log), log.clock), (rows.to_vec(), Clock::Utc), "{zeros}");
        assert_eq!(skipped(&log), [7]);
        assert_eq!(about(&log, HALL), ["The hall", "motion", "", ""]);
        assert_eq!(about(&log, "sensor.warmth")[1..3], ["sensor", "°C"]);
        assert_eq!(about(&log, "air hall co2")[3], "hall");
    }
}

#[test]
fn tables_of_influx_are_read() {
    let folder = Folder::new("influx");
    let printed = "name,time,entity_id,value\nstate,1770012000000000000,hall,0\nstate,1770012060000000001,hall,1\n\n\
                   name,time,entity_id,value\n°C,1770012030000000000,warmth,21.5\n";
    let rows = [(0.0, "hall", "0"), (0.5, "warmth", "21.5"), (1.0, "hall", "1")];
    assert_eq!(told(&log(&folder, "influx-csv", "printed.csv", printed)), rows);
    let grouped = "name,tags,time,value\nstate,entity_id=hall,1770012000000000000,0\nstate,entity_id=hall,1770012060000000000,1\n\
                   °C,entity_id=warmth,1770012030000000000,21.5\n";
    assert_eq!(told(&log(&folder, "influx-csv", "grouped.csv", grouped)), rows);
    let head = "#group,false,false,true,true,false,false,true,true,true\r\n\
                #datatype,string,long,dateTime:RFC3339,dateTime:RFC3339,dateTime:RFC3339,double,string,string,string\r\n\
                #default,_result,,,,,,,,\r\n,result,table,_start,_stop,_time,_value,_field,_measurement,entity_id\r\n";
    let row = |table: u32, time: &str, value: &str, field: &str, measurement: &str, entity: &str| {
        format!(
            ",,{table},2026-02-02T00:00:00Z,2026-02-03T00:00:00Z,2026-02-02T{time}Z,{value},{field},{measurement},{entity}\r\n"
        )
    };
    let annotated = [
        head.to_owned(),
        row(0, "06:00:00", "0", "value", "state", "hall"),
        row(0, "06:01:00.000000001", "1", "value", "state", "hall"),
        "\r\n".into(),
        head.to_owned(),
        row(1, "06:00:30", "21.5", "value", "°C", "warmth"),
    ];
    let annotated = log(&folder, "influx-csv", "annotated.csv", &annotated.concat());
    assert_eq!((told(&annotated), annotated.skipped), (rows.to_vec(), 0));
    // A state in two fields is one sensor; one more measurement of that name is a sensor of its own.
    let both = [
        head.to_owned(),
        row(0, "06:00:00", "1", "value", "state", "hall"),
        row(1, "06:00:00", "on", "state", "state", "hall"),
        row(2, "06:01:00", "3", "value", "lx", "hall"),
    ];
    let both = log(&folder, "influx-csv", "both.csv", &both.concat());
    assert_eq!(told(&both), [(0.0, "hall", "on"), (1.0, "hall (lx, entity_id=hall)", "3")]);
    let pivoted = "#group,false,false,false,true,true,false,false\n#datatype,string,long,dateTime:RFC3339,string,string,double,boolean\n\
                   #default,_result,,,,,,\n,result,table,_time,_measurement,room,co2,open\n\
                   ,,0,2026-02-02T06:00:00Z,air,hall,400,true\n,,0,2026-02-02T06:01:00Z,air,hall,401,\n";
    let pivoted = log(&folder, "influx-csv", "pivoted.csv", pivoted);
    assert_eq!(
        told(&pivoted),
        [(0.0, "air hall co2", "400"), (0.0, "air hall open", "true"), (1.0, "air hall co2", "401")]
    );
    // A table with a column of that name is not one of Influx.
    assert_eq!(
        told(&log(&folder, "csv", "own.csv", "name,time,value\nhall,2026-02-02 06:00:00,ON\n")),
        [(0.0, "hall", "ON")]
    );
}

#[test]
fn refuses_settings_with_a_date() {
    let folder = Folder::new("interchange-settings");
    let path = folder.path().join("home.json");
    let rows = |text: &str| {
        fs::write(&path, text).unwrap();
        LogSource::recognise(&path).and_then(|source| read(&source, &LoggerFile::default())).map(|log| log.rows)
    };
    let settings = r#"{"name": "flat", "start": "2026-02-02T06:00:00", "days": 7, "seed": 1}"#;
    assert!(rows(settings).is_err());
    // The control: the same key is the time of a row with a sensor and a value.
    assert_eq!(rows(r#"{"start": "2026-02-02T06:00:00", "sensor": "hall", "value": "on"}"#).unwrap(), 1);
}
