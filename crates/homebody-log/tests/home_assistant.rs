//! Databases of Home Assistant's recorder in four schemas: kinds of entities, gaps, registries.
//!
//! The four tables are those of Home Assistant 0.60, 2022.4, 2023.3 and 2024.3, with the columns that a reader may meet.

use crate::stage::Folder;
use crate::stage::texts::{from_file, known};
use homebody_core::time::{Interval, SECOND, WallTime};
use homebody_log::Log;
use homebody_log::log::Clock;
use jiff::Timestamp;
use rusqlite::{Connection, params};
use std::fs;
use std::path::Path;

/// 2 March 2009, 07:00.
const SEVEN: i64 = 1_235_977_200;

/// The form of states in a year of the recorder.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Year {
    /// The entity, its attributes and times as text in each row.
    Old,
    /// Attributes in a table of their own.
    Attributes,
    /// Times as numbers.
    Numbers,
    /// Entities in a table of their own.
    Entities,
}

const YEARS: [Year; 4] = [Year::Old, Year::Attributes, Year::Numbers, Year::Entities];

const RUNS: &str = "CREATE TABLE recorder_runs (run_id INTEGER PRIMARY KEY, start DATETIME, \"end\" DATETIME,
    closed_incorrect BOOLEAN, created DATETIME);";

/// A database with these entities, by id and attributes, and their states, by seconds after seven.
fn database(path: &Path, year: Year, entities: &[(&str, &str)], states: &[(i64, &str, &str)]) -> Connection {
    let database = Connection::open(path).unwrap();
    let columns = match year {
        Year::Old => "domain VARCHAR(64), entity_id VARCHAR(255), attributes TEXT, event_id INTEGER, last_changed DATETIME,
            last_updated DATETIME, created DATETIME",
        Year::Attributes => "entity_id VARCHAR(255), attributes TEXT, event_id INTEGER, last_changed DATETIME,
            last_updated DATETIME, old_state_id INTEGER, attributes_id INTEGER",
        Year::Numbers => "entity_id VARCHAR(255), attributes TEXT, event_id INTEGER, last_changed DATETIME,
            last_changed_ts FLOAT, last_updated DATETIME, last_updated_ts FLOAT, old_state_id INTEGER, attributes_id INTEGER",
        Year::Entities => "entity_id CHAR(0), attributes CHAR(0), event_id SMALLINT, last_changed CHAR(0), last_changed_ts FLOAT,
            last_updated CHAR(0), last_updated_ts FLOAT, old_state_id INTEGER, attributes_id INTEGER, metadata_id INTEGER",
    };
    let tables = format!(
        "CREATE TABLE states (state_id INTEGER PRIMARY KEY, state VARCHAR(255), {columns});
         CREATE TABLE state_attributes (attributes_id INTEGER PRIMARY KEY, hash BIGINT, shared_attrs TEXT);
         CREATE TABLE states_meta (metadata_id INTEGER PRIMARY KEY, entity_id VARCHAR(255)); {RUNS}"
    );
    database.execute_batch(&tables).unwrap();
    for (id, attributes) in entities {
        database.execute("INSERT INTO state_attributes (shared_attrs) VALUES (?)", [attributes]).unwrap();
        database.execute("INSERT INTO states_meta (entity_id) VALUES (?)", [id]).unwrap();
    }
    if year == Year::Old {
        database.execute_batch("DROP TABLE state_attributes; DROP TABLE states_meta").unwrap();
    }
    for &(after, id, state) in states {
        let number = entities.iter().position(|entity| entity.0 == id).unwrap();
        let (key, text) = (number as i64 + 1, text(SEVEN + after));
        let at = (SEVEN + after) as f64;
        let insert = |sql: &str, values: &[&dyn rusqlite::ToSql]| database.execute(sql, values).unwrap();
        match year {
            Year::Old => insert(
                "INSERT INTO states (state, entity_id, attributes, last_changed, last_updated) VALUES (?, ?, ?, ?, ?)",
                params![state, id, entities[number].1, text, text],
            ),
            Year::Attributes => insert(
                "INSERT INTO states (state, entity_id, attributes_id, last_changed, last_updated) VALUES (?, ?, ?, ?, ?)",
                params![state, id, key, text, text],
            ),
            Year::Numbers => insert(
                "INSERT INTO states (state, entity_id, attributes_id, last_changed_ts, last_updated_ts) VALUES (?, ?, ?, ?, ?)",
                params![state, id, key, at, at],
            ),
            Year::Entities => insert(
                "INSERT INTO states (state, metadata_id, attributes_id, last_updated_ts) VALUES (?, ?, ?, ?)",
                params![state, key, key, at],
            ),
        };
    }
    database
}

/// An instant as the recorder writes it in UTC.
fn text(seconds: i64) -> String {
    Timestamp::from_second(seconds).unwrap().strftime("%Y-%m-%d %H:%M:%S%.6f").to_string()
}

fn run(database: &Connection, start: i64, end: Option<i64>, is_closed: bool) {
    let end = end.map(|end| text(SEVEN + end));
    database
        .execute(
            "INSERT INTO recorder_runs (start, \"end\", closed_incorrect) VALUES (?, ?, ?)",
            params![text(SEVEN + start), end, !is_closed],
        )
        .unwrap();
}

fn log_at(path: &Path) -> Log {
    let (source, log) = from_file(path);
    assert_eq!(source.form().name, "home-assistant");
    log
}

const ENTITIES: [(&str, &str); 4] = [
    ("binary_sensor.hall", r#"{"device_class": "motion", "friendly_name": "Flur Bewegung"}"#),
    ("sensor.heat", r#"{"device_class": "temperature", "unit_of_measurement": "°C"}"#),
    ("automation.light", "{}"),
    ("binary_sensor.bare", "no JSON"),
];

const STATES: [(i64, &str, &str); 6] = [
    (0, "binary_sensor.hall", "on"),
    (20, "binary_sensor.hall", "off"),
    (30, "sensor.heat", "21.5"),
    (40, "automation.light", "on"),
    (50, "binary_sensor.bare", "off"),
    (60, "binary_sensor.hall", "unavailable"),
];

#[test]
fn each_year_of_the_recorder_says_what_its_entities_are() {
    let folder = Folder::new("years");
    for year in YEARS {
        let path = folder.path().join(format!("{year:?}.db"));
        drop(database(&path, year, &ENTITIES, &STATES));
        let log = log_at(&path);
        let rows: Vec<(i64, &str, &str)> = log
            .events
            .iter()
            .map(|event| (event.at.since_zero() / SECOND - SEVEN, log.sensor(event), log.value(event)))
            .collect();
        assert_eq!((rows, log.clock, log.skipped), (STATES.to_vec(), Clock::Utc, 0), "{year:?}");
        let hall = known(&log, "binary_sensor.hall");
        assert_eq!((&*hall.kind, &*hall.name), ("motion", "Flur Bewegung"), "{year:?}");
        let heat = known(&log, "sensor.heat");
        assert_eq!((&*heat.kind, heat.unit.as_deref()), ("temperature", Some("°C")), "{year:?}");
        assert_eq!(known(&log, "automation.light").kind, "automation", "{year:?}");
        assert_eq!(known(&log, "binary_sensor.bare").kind, "binary_sensor", "{year:?}");
        assert_eq!(log.gaps, [], "{year:?}");
    }
}

#[test]
fn between_two_runs_of_the_recorder_is_a_gap() {
    let folder = Folder::new("runs");
    for year in YEARS {
        let path = folder.path().join(format!("{year:?}.db"));
        let database = database(&path, year, &ENTITIES, &STATES);
        run(&database, -100, Some(45), true);
        run(&database, 48, Some(300), false);
        run(&database, 300, Some(310), true);
        run(&database, 400, None, true);
        drop(database);
        let at = |after: i64| WallTime::EPOCH + (SEVEN + after) * SECOND;
        let gap = |from, to| Interval::new(at(from), at(to));
        // The second run lost its power: it ended with its last row, whatever the next one has written into it.
        assert_eq!(log_at(&path).gaps, [gap(45, 48), gap(60, 300), gap(310, 400)], "{year:?}");
    }
}

#[test]
fn registries_beside_the_database_say_rooms_and_classes() {
    let folder = Folder::new("registries");
    let path = folder.path().join("home-assistant_v2.db");
    let entities = [
        ("binary_sensor.hall", "{}"),
        ("binary_sensor.door", r#"{"device_class": "opening"}"#),
        ("switch.child_lock", "{}"),
        ("sensor.battery", r#"{"device_class": "battery"}"#),
    ];
    let states = [
        (0, "binary_sensor.hall", "on"),
        (1, "binary_sensor.door", "on"),
        (2, "switch.child_lock", "on"),
        (3, "sensor.battery", "99"),
    ];
    drop(database(&path, Year::Entities, &entities, &states));
    let storage = folder.path().join(".storage");
    fs::create_dir(&storage).unwrap();
    let write = |name: &str, data: &str| {
        let text = format!("{{\"version\": 1, \"key\": \"{name}\", \"data\": {data}}}");
        fs::write(storage.join(name), text).unwrap();
    };
    write(
        "core.entity_registry",
        r#"{"entities": [
            {"entity_id": "binary_sensor.hall", "original_device_class": "motion", "device_class": null, "area_id": null, "device_id": "d1"},
            {"entity_id": "binary_sensor.door", "original_device_class": "opening", "device_class": "window", "area_id": "kueche"},
            {"entity_id": "switch.child_lock", "entity_category": "config"},
            {"entity_id": "sensor.battery", "entity_category": "diagnostic", "original_device_class": "battery"}]}"#,
    );
    write("core.device_registry", r#"{"devices": [{"id": "d1", "area_id": "flur"}, {"id": "d2", "area_id": null}]}"#);
    write("core.area_registry", r#"{"areas": [{"id": "flur", "name": "Flur"}, {"id": "kueche", "name": "Küche"}]}"#);
    let log = log_at(&path);
    let of = |id: &str| (known(&log, id).kind.clone(), known(&log, id).room.clone());
    assert_eq!(of("binary_sensor.hall"), ("motion".into(), Some("Flur".into())));
    assert_eq!(of("binary_sensor.door"), ("window".into(), Some("Küche".into())));
    assert_eq!(of("switch.child_lock"), ("config".into(), None));
    assert_eq!(of("sensor.battery"), ("battery".into(), None));
    assert_eq!(log.remarks, Vec::<String>::new());
    // One that is broken is a remark, and the others are read.
    fs::write(storage.join("core.area_registry"), "{").unwrap();
    let log = log_at(&path);
    assert_eq!(known(&log, "binary_sensor.hall").room, None);
    assert!(log.remarks[0].starts_with("core.area_registry is not read: "), "{:?}", log.remarks);
}

#[test]
fn an_entity_that_is_taken_away_is_not_known_from_there_on() {
    let folder = Folder::new("taken away");
    let path = folder.path().join("home-assistant_v2.db");
    let database = database(&path, Year::Entities, &ENTITIES, &STATES[..1]);
    let row = "INSERT INTO states (state, metadata_id, last_updated_ts) VALUES (NULL, 1, ?)";
    database.execute(row, [(SEVEN + 10) as f64]).unwrap();
    drop(database);
    let log = log_at(&path);
    assert_eq!((log.value(&log.events[1]), log.skipped), ("unknown", 0));
    assert_eq!(known(&log, "binary_sensor.hall").kind, "motion", "by its last state that was known");
}
