//! The forms of recordings of real homes: their beginning identifies each, and no row or activity is lost.
//!
//! Texts here are ours. The recordings themselves are read if HOMEBODY_DATA names their folder, and their counts are compared with those
//! of a few lines of Python.

use crate::stage::Folder;
use crate::stage::texts::{SEVEN, carry, content, done, from_file, from_text, minutes, skipped, written};
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::{DAY, MINUTE, SECOND};
use homebody_log::log::Clock;
use homebody_log::registry::FORMS;
use homebody_log::{Log, LogError, LogSource, WriteMode, read};
use rusqlite::Connection;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Rows as minutes since seven, sensor, value.
fn told(log: &Log) -> Vec<(f64, &str, &str)> {
    minutes(log, SEVEN)
}

#[test]
fn intervals_become_rows_in_the_order_of_time() {
    let folder = Folder::new("intervals");
    let sensors = "Start time: when it fired\r\nSensor IDs are:\r\n    [ 1]    'Fridge'   \r\n    [24]    'Front door'\r\n\r\n\
                   Start time          \tEnd time            \tID\tVal\r\n--------\t-------\t--\t---\r\n\
                   02-Mar-2009 07:00:00\t02-Mar-2009 07:10:00\t24\t1\r\n\
                   02-Mar-2009 07:02:00\t02-Mar-2009 07:03:00\t1\t1\r\n\
                   02-Mar-2009 07:09:00\t02-Mar-2009 07:08:00\t1\t1\r\n\
                   02-Mar-2009 07:01:00\t02-Mar-2009 07:01:00\t7\t1\r\nnonsense\r\n";
    let log = from_text(&folder, "intervals", "homeSenseData.txt", sensors);
    let rows = [
        (0.0, "Front door", "ON"),
        (1.0, "7", "ON"),
        (1.0, "7", "OFF"),
        (2.0, "Fridge", "ON"),
        (3.0, "Fridge", "OFF"),
        (10.0, "Front door", "OFF"),
    ];
    assert_eq!(told(&log), rows);
    let refused: Vec<_> = log.problems.iter().map(|problem| (problem.line, problem.why.as_str())).collect();
    assert_eq!(refused, [(10, "it ends before it begins"), (12, "\"nonsense\" does not begin with start and end")]);
    let activities = "activity id list:\r\n10:'go to bed'\r\n\r\nStart time\tEnd time\tID\r\n---\t---\t--\r\n\
                      02-Mar-2009 07:20:00\t02-Mar-2009 07:50:00\t10\r\n02-Mar-2009 07:01:00\t02-Mar-2009 07:02:00\t11\r\n";
    let alone = from_text(&folder, "intervals", "homeActData.txt", activities);
    assert_eq!((alone.rows, done(&alone)), (0, vec![("11", 1.0, 2.0), ("go to bed", 20.0, 50.0)]));
    // Both are one log, be it named by its sensors or by its folder.
    for path in ["homeSenseData.txt", "."] {
        let (_, log) = from_file(&folder.path().join(path));
        assert_eq!((told(&log).len(), done(&log)), (6, done(&alone)), "{path}");
    }
}

#[test]
fn intervals_of_uci_are_named_by_all_their_words() {
    let folder = Folder::new("uci");
    let sensors = "Start time          \tEnd time            \tLocation\tType\t\tPlace\n--------\t----\t---\t---\t---\n\
                   2009-03-02 07:00:00\t\t2009-03-02 07:10:00\t\tBed\t\t\tPressure\tBedroom\n";
    fs::write(
        folder.path().join("A_ADLs.txt"),
        "Start time          \tEnd time            \tActivity\t\n-----\t----\t---\n\
         2009-03-02 07:00:00\t\t2009-03-02 07:09:00\t\tSpare_Time/TV\t\t\n2009-03-02 07:12:00\t\tnever\t\tEating\n",
    )
    .unwrap();
    let log = from_text(&folder, "intervals", "A_Sensors.txt", sensors);
    assert_eq!(told(&log), [(0.0, "Bed Pressure Bedroom", "ON"), (10.0, "Bed Pressure Bedroom", "OFF")]);
    assert_eq!(done(&log), [("Spare_Time/TV", 0.0, 9.0)]);
    let place = log.problems[0].place("A_Sensors.txt");
    assert!(place.ends_with("A_ADLs.txt:4"), "{place}");
}

#[test]
fn records_of_five_lines() {
    let folder = Folder::new("mit");
    let table = "100,Bathroom,Toilet Flush \r\n68,Kitchen,Burner\r\n";
    fs::write(folder.path().join("sensors.csv"), table).unwrap();
    let text = "Bathing,3/2/2009,7:0:0,7:30:0\r\n100,68\r\nToilet Flush,Burner\r\n7:5:30,7:1:0\r\n7:6:0,7:2:0\r\n\
                Toileting,3/2/2009,23:50:0,0:10:0\r\n100\r\nToilet Flush\r\n23:59:0\r\n0:1:0\r\n\
                Cooking,3/2/2009,8:0:0,8:10:0\r\n68,100\r\nBurner\r\n8:1:0\r\n8:2:0\r\n\
                Eating,3/2/2009,9:0:0,9:10:0\r\n68\r\n";
    let log = from_text(&folder, "mit", "activities_data.csv", text);
    let day = 17.0 * 60.0;
    let rows = [
        (1.0, "68", "ON"),
        (2.0, "68", "OFF"),
        (5.5, "100", "ON"),
        (6.0, "100", "OFF"),
        (day - 1.0, "100", "ON"),
        (day + 1.0, "100", "OFF"),
    ];
    assert_eq!(told(&log), rows);
    let names: Vec<_> = done(&log);
    assert_eq!(
        names,
        [
            ("Bathing", 0.0, 30.0),
            ("Cooking", 60.0, 70.0),
            ("Eating", 120.0, 130.0),
            ("Toileting", day - 10.0, day + 10.0)
        ]
    );
    assert_eq!(skipped(&log), [12, 16]);
    let known: Vec<_> = log.known.iter().map(|one| (&*one.id, &*one.name, one.room.as_deref())).collect();
    assert_eq!(known, [("100", "Toilet Flush", Some("Bathroom")), ("68", "Burner", Some("Kitchen"))]);
}

#[test]
fn frames_of_devices_and_activities_are_one_log() {
    let folder = Folder::new("frames");
    let devices =
        "time,device,value\n2009-03-02 07:00:00.000,fridge door,True\n2009-03-02 07:00:30.000,fridge door,False\n";
    let activities = "start_time,end_time,activity\n2009-03-02 07:00:00,2009-03-02 07:05:00,\"eat, alone\"\n\
                      x,2009-03-02 07:05:00,sleep\n2009-03-02 07:06:00,2009-03-02 07:05:00,sleep\n";
    fs::write(folder.path().join("activities.csv"), activities).unwrap();
    fs::write(folder.path().join("devices.csv"), devices).unwrap();
    let (source, log) = from_file(folder.path());
    assert_eq!(
        (source.form().name, told(&log)[1], done(&log)),
        ("csv", (0.5, "fridge door", "False"), vec![("eat, alone", 0.0, 5.0)])
    );
    assert_eq!((log.problems[0].line, log.problems[1].line, log.skipped), (3, 4, 2));
    let (source, log) = from_file(&folder.path().join("activities.csv"));
    assert_eq!((source.form().name, log.rows, log.activities.len()), ("pyadlml", 0, 1));
    let older = "start_time,end_time,device,val\n2009-03-02 07:00:00,2009-03-02 07:10:00,a,1\n2009-03-02 07:01:00,2009-03-02 07:02:00,b,1\n";
    let log = from_text(&folder, "pyadlml", "older.csv", older);
    assert_eq!(told(&log), [(0.0, "a", "ON"), (1.0, "b", "ON"), (2.0, "b", "OFF"), (10.0, "a", "OFF")]);
    // It is unclear which of several logs is meant.
    let error = LogSource::recognise(folder.path()).unwrap_err().to_string();
    assert!(error.contains("name one of devices.csv, older.csv"), "{error}");
}

#[test]
fn rows_of_each_second_become_changes() {
    let folder = Folder::new("openshs");
    let text = "wardrobe,tv,Activity,timestamp\n1,0,sleep,2009-03-02 07:00:00\n1,0,sleep,2009-03-02 07:00:01\n\
                0,1,eat,2009-03-02 07:00:02\n0,2,eat,2009-03-02 07:00:03\n0,0,eat,2009-03-02 07:00:04\n";
    let log = from_text(&folder, "openshs", "openshs.csv", text);
    let second = 1.0 / 60.0;
    let rows = [
        (0.0, "wardrobe", "ON"),
        (2.0 * second, "wardrobe", "OFF"),
        (2.0 * second, "tv", "ON"),
        (4.0 * second, "tv", "OFF"),
    ];
    assert_eq!(told(&log), rows);
    assert_eq!(done(&log), [("sleep", 0.0, 0.033), ("eat", 0.033, 0.083)]);
    assert_eq!((log.skipped, log.problems[0].line), (1, 5));

    // A row on another clock says nothing, though which clock it is is not known yet.
    let text = "wardrobe,tv,Activity,timestamp\n1,0,sleep,2009-03-02 07:00:00\n0,1,sleep,2009-03-02T07:00:01Z\n\
                0,0,sleep,2009-03-02 07:00:02\n";
    let log = from_text(&folder, "openshs", "clocks.csv", text);
    assert_eq!(told(&log), [(0.0, "wardrobe", "ON"), (2.0 * second, "wardrobe", "OFF")]);
    assert_eq!(skipped(&log), [3]);

    let row = |first: u8, activity: u8| format!("{first} {}{activity} 2\n", "0 ".repeat(19));
    let text = [row(0, 11), row(1, 11), "0 1\n".to_owned(), row(0, 12)].concat();
    let log = from_text(&folder, "aras", "DAY_3.txt", &text);
    let at = |event: usize| log.events[event].at.since_zero() - 2 * DAY;
    assert_eq!((at(0), at(1), log.rows, log.sensors.len()), (SECOND, 3 * SECOND, 2, 1));
    let names: Vec<_> = log.activities.iter().map(|of| (of.label.as_str(), of.length() / SECOND)).collect();
    assert_eq!(names, [("R1 activity 11", 3), ("R2 activity 2", 4), ("R1 activity 12", 1)]);
    assert_eq!(log.problems[0].line, 3);
    assert!(log.remarks[0].contains("dates are not known"), "{:?}", log.remarks);
}

#[test]
fn an_event_log_has_activities_alone() {
    let folder = Folder::new("xes");
    let event = |name: &str, transition: &str, at: &str| {
        format!(
            "<event><string key=\"concept:name\" value=\"{name}\"/><string key='lifecycle:transition' value='{transition}'/>\n\
             <date key=\"time:timestamp\" value=\"2009-03-02T{at}.000+01:00\"/></event>\n"
        )
    };
    let text = [
        "<?xml version=\"1.0\"?>\n<!-- <event> is > what follows -->\n<log xes.version=\"1.0\"><trace>\n".to_owned(),
        event("cook &amp; eat", "start", "08:00:00"),
        event("a > b", "complete", "08:01:00"),
        event("cook &amp; eat", "complete", "08:10:00"),
        event("sleep", "start", "08:20:00"),
        event("sleep", "start", "never"),
        "</trace></log>\n".into(),
    ]
    .concat();
    let log = from_text(&folder, "xes", "log.xes", &text);
    assert_eq!(done(&log), [("cook & eat", 0.0, 10.0), ("a > b", 1.0, 1.0), ("sleep", 20.0, 20.0)]);
    assert_eq!((log.rows, log.clock, log.problems[0].line, log.skipped), (0, Clock::Utc, 12, 1));
    // Without rows, there is no place for notes; tables hold activities alone.
    let to = |to: &str| carry(from_file(&folder.path().join("log.xes")).0, &folder.url(to), "UTC", WriteMode::Create);
    assert!(to("casas:log.txt").unwrap_err().to_string().contains("cannot hold 3 activities"));
    to("csv:carried.csv").unwrap();
    assert_eq!(from_file(&folder.path().join("carried.csv")).1.activities, log.activities);
}

#[test]
fn a_broken_part_of_an_event_log_costs_only_its_event() {
    let folder = Folder::new("broken-xes");
    let event = |name: &str, minute: u8| {
        format!(
            "<event><string key=\"concept:name\" value=\"{name}\"/>\n<date key=\"time:timestamp\" value=\"2009-03-02T07:{minute:02}:00\"/></event>\n"
        )
    };
    let text = [
        "<?xml version=\"1.0\"?>\n<log><trace>\n".to_owned(),
        // A quote that is never closed, an invalid beginning, and an invalid end.
        event("a", 1).replace("value=\"a\"", "value=\"a"),
        event("b", 2),
        event("c", 3).replace("<event>", "<evnt>"),
        event("d", 4).replace("</event>", ""),
        event("e", 5),
        "</trace></log>\n".into(),
    ]
    .concat();
    let log = from_text(&folder, "xes", "log.xes", &text);
    assert_eq!(done(&log), [("b", 2.0, 2.0), ("d", 4.0, 4.0), ("e", 5.0, 5.0)]);
    let refused: Vec<_> = log.problems.iter().map(|problem| (problem.line, problem.why.as_str())).collect();
    assert_eq!(refused, [(3, "the event has no name or no time"), (8, "an event ends that has not begun")]);
}

#[test]
fn a_log_of_one_sensor_and_hours_that_clocks_skip_or_tell_twice_are_read_whole() {
    let folder = Folder::new("one-sensor");
    // In the zone of the home, 2:30 was not there on the first of these days, and 1:30 was there twice on the second.
    let rows = ["2009-03-08 01:59:59", "2009-03-08 02:30:00", "2009-11-01 01:30:00", "2009-11-01 01:10:00"];
    let text: String = rows.iter().map(|at| format!("{at} M1 ON\n")).collect();
    let log = from_text(&folder, "casas", "log.txt", &text);
    assert_eq!((log.rows, log.sensors.len(), log.skipped), (4, 1, 0));
    assert_eq!(
        (log.events[3].at - log.events[2].at, log.events[1].at - log.events[0].at),
        (-20 * MINUTE, 1_801 * SECOND)
    );
}

/// As `sqlite3 -header` writes a table.
#[test]
fn cells_may_be_parted_by_bars() {
    let folder = Folder::new("bars");
    let rows: Vec<[String; 4]> = (0..30)
        .map(|row| {
            let (sensor, value) = (["hall_motion", "bath_motion"][row / 2 % 2], ["on", "off"][row % 2]);
            [
                row.to_string(),
                format!("binary_sensor.{sensor}"),
                value.into(),
                format!("{}.5", 1_708_914_495 + 20 * row),
            ]
        })
        .collect();
    let heading = ["state_id", "entity_id", "state", "last_updated_ts"].map(String::from);
    let table = |mark: &str, has_heading: bool| {
        let heading = has_heading.then_some(&heading);
        heading.into_iter().chain(&rows).map(|row| row.join(mark) + "\n").collect::<String>()
    };
    let read = |mark: &str, has_heading: bool| from_text(&folder, "csv", "log.csv", &table(mark, has_heading));
    let (bars, commas) = (read("|", true), read(",", true));
    assert_eq!((bars.rows, bars.sensors.len(), bars.skipped), (30, 2, 0));
    assert_eq!((&bars.events, &bars.values), (&commas.events, &commas.values));
    assert_eq!(read("|", false).events.len(), 30, "without a heading, too");
}

#[test]
fn tables_as_psql_prints_them() {
    let folder = Folder::new("psql");
    let text = "        mark         | zone | number | state | level | source | info \n\
                ---------------------+------+--------+-------+-------+--------+------\n \
                2009-03-02 07:00:00 | i    |      4 | on    |       | x10    |      \n \
                2009-03-02 07:01:00 | i    |      4 |       | 80    | x10    |      \n \
                2009-03-02 07:02:00 |      |      4 | off   |       | x10    |      \n(3 rows)\n";
    let log = from_text(&folder, "psql", "x10.txt", text);
    assert_eq!(told(&log), [(0.0, "i4", "on"), (1.0, "i4", "80")]);
    assert_eq!((log.skipped, log.problems[0].line), (1, 5));
    let text = " time | sensor | value | activity\n---+---+---+---\n 2009-03-02 07:00:00 | M1 | ON | cook\n";
    let log = from_text(&folder, "psql", "usual.txt", text);
    assert_eq!((told(&log), done(&log).len()), (vec![(0.0, "M1", "ON")], 1));
}

const META: &str = "CREATE TABLE states_meta (metadata_id INTEGER PRIMARY KEY, entity_id TEXT);
    INSERT INTO states_meta VALUES (1, 'binary_sensor.hall'), (2, 'sensor.heat');";

#[test]
fn home_assistants_states_are_read_and_its_database_is_left_as_it_was() {
    let folder = Folder::new("recorder");
    let now = "CREATE TABLE states (state_id INTEGER PRIMARY KEY, entity_id TEXT, state TEXT, attributes TEXT, last_changed TEXT,
        last_changed_ts REAL, last_updated TEXT, last_updated_ts REAL, metadata_id INTEGER);
        INSERT INTO states VALUES (1, NULL, 'on', NULL, NULL, NULL, NULL, 1235977200.25, 1),
        (2, NULL, '21.5', NULL, NULL, 1235977260, NULL, 1235977260, 2),
        (3, NULL, 'on', NULL, NULL, 1235977200.25, NULL, 1235977300, 1),
        (4, NULL, NULL, NULL, NULL, NULL, NULL, 1235977310, 1),
        (5, NULL, 'unavailable', NULL, NULL, NULL, NULL, 1235977320, 1);";
    let older = "CREATE TABLE states (state_id INTEGER PRIMARY KEY, domain TEXT, entity_id TEXT, state TEXT, attributes TEXT,
        last_changed DATETIME, last_updated DATETIME);
        INSERT INTO states VALUES (1, 'x', 'binary_sensor.hall', 'on', '{}', '2009-03-02 07:00:00.250000', '2009-03-02 07:00:00.250000'),
        (2, 'x', 'sensor.heat', '21.5', '{}', '2009-03-02 07:01:00.000000', '2009-03-02 07:01:00.000000'),
        (3, 'x', 'binary_sensor.hall', 'on', '{}', '2009-03-02 07:00:00.250000', '2009-03-02 07:02:00.000000'),
        (4, 'x', 'binary_sensor.hall', NULL, '{}', '2009-03-02 07:02:10.000000', '2009-03-02 07:02:10.000000'),
        (5, 'x', 'binary_sensor.hall', 'unavailable', '{}', '2009-03-02 07:02:00.000000', '2009-03-02 07:02:00.000000');";
    for (name, sql) in [
        ("now.db", format!("{META}{now}")),
        ("older.db", older.to_owned()),
        // The state in which Home Assistant leaves it: reading adds no files.
        ("my home #1?.db", format!("PRAGMA journal_mode = WAL; {META}{now}")),
    ] {
        let path = folder.path().join(name);
        Connection::open(&path).unwrap().execute_batch(&sql).unwrap();
        let before = (fs::read(&path).unwrap(), folder.files());
        let (source, log) = from_file(&path);
        assert_eq!(source.form().name, "home-assistant");
        let rows = [
            (0.25 / 60.0, "binary_sensor.hall", "on"),
            (1.0, "sensor.heat", "21.5"),
            (2.0, "binary_sensor.hall", "unavailable"),
        ];
        // An entity that is taken away has no state: it is not known.
        let (gone, told): (Vec<_>, Vec<_>) = told(&log).into_iter().partition(|row| row.2 == "unknown");
        assert_eq!((told, log.clock), (rows.to_vec(), Clock::Utc), "{name}");
        assert_eq!((gone.len(), gone[0].1, log.skipped), (1, "binary_sensor.hall", 0));
        assert_eq!(log.remarks, ["1 rows in which only attributes changed are passed over"]);
        assert_eq!((fs::read(&path).unwrap(), folder.files()), before);
    }
}

/// From a text with notes to a table and back, activities are what they were.
#[test]
fn activities_go_with_their_log_into_each_form() {
    let folder = Folder::new("carried");
    let text = "2009-03-02 07:00:00.000000\tM1\tON\tCook begin\n2009-03-02 07:01:00.000000\tM1\tOFF\n\
                2009-03-02 07:02:00.000000\tM1\tON\tR1_Work begin\n2009-03-02 07:03:00.000000\tM1\tOFF\tCook end\n\
                2009-03-02 07:04:00.000000\tM1\tON\tR1_Work end\n";
    let first = from_text(&folder, "casas", "first.txt", text);
    assert_eq!(done(&first), [("Cook", 0.0, 3.0), ("R1_Work", 2.0, 4.0)]);
    let mut from = LogSource::recognise(&folder.path().join("first.txt")).unwrap();
    for to in ["csv:second.csv", "sqlite:third.db", "csv:fourth.csv", "casas:last.txt"] {
        carry(from, &folder.url(to), "UTC", WriteMode::Create).unwrap();
        from = LogSource::from(&folder.url(to));
        assert_eq!(content(read(&from, &LoggerFile::default()).unwrap()), content(first.clone()), "{to}");
    }
    assert_eq!(folder.text("last.txt"), text);
    let labels: Vec<String> =
        folder.text("second.csv").lines().map(|row| row.rsplit(',').next().unwrap().to_owned()).collect();
    assert_eq!(labels, ["activity", "Cook", "Cook", "Cook|R1_Work", "R1_Work", ""]);
    let beside = "start_time,end_time,activity\n2009-03-02 07:00:00.000000,2009-03-02 07:03:00.000000,Cook\n";
    assert!(folder.text("second.activity.csv").starts_with(beside), "{}", folder.text("second.activity.csv"));
    // A log without activities does not get those of another that was there before.
    let plain = from_text(&folder, "casas", "plain.txt", "2009-03-02 07:00:00 M1 ON\n");
    let to = folder.url("csv:second.csv");
    carry(from_file(&folder.path().join("plain.txt")).0, &to, "UTC", WriteMode::Overwrite).unwrap();
    assert_eq!(content(read(&to, &LoggerFile::default()).unwrap()), content(plain));
}

#[test]
fn a_file_without_rows_yet_is_an_empty_log_of_a_form_that_is_named() {
    let folder = Folder::new("empty");
    for text in ["", " \n\n", "\u{feff}"] {
        let path = written(&folder, "log.txt", text);
        assert_eq!(LogSource::recognise(&path).unwrap_err().code(), "log-form::empty", "{text:?}");
    }
    for form in FORMS {
        let path = written(&folder, "nothing", "");
        match read(LogSource::new(form, &path), &LoggerFile::default()) {
            Ok(log) => assert_eq!((log.rows, log.activities.len()), (0, 0), "{form:?}"),
            Err(error) => assert!(error.to_string().contains("nothing"), "{form:?}: {error}"),
        }
        assert!(matches!(
            read(LogSource::new(form, folder.path().join("none")), &LoggerFile::default()),
            Err(LogError::Missing { .. })
        ));
    }
}

#[test]
fn a_form_is_named_before_a_colon() {
    let source: LogSource = "mit:activities_data.csv".parse().unwrap();
    assert_eq!((source.form().name, source.to_string().as_str()), ("mit", "mit:activities_data.csv"));
    for (text, said) in
        [("mitt:a.csv", "did you mean \"mit:a.csv\"?"), ("mit:", "write mit:FILE"), ("a.csv", "openshs")]
    {
        let error = text.parse::<LogSource>().unwrap_err().to_string();
        assert!(error.contains(said), "{error}");
    }
}

/// A recording of a real home, and Python to count in it; said where one of them is absent.
fn real(name: &str) -> Option<PathBuf> {
    let path =
        std::env::var_os("HOMEBODY_DATA").map(|data| PathBuf::from(data).join(name)).filter(|path| path.exists());
    if path.is_none() {
        eprintln!("skipped: HOMEBODY_DATA does not name a folder that holds {name}");
    }
    let has_python = Command::new("python3").arg("--version").output().is_ok();
    if !has_python {
        eprintln!("skipped: there is no python3 to count what is in {name}");
    }
    path.filter(|_| has_python)
}

/// The counts that a few lines of Python print for a file.
fn counted(script: &str, file: &Path) -> Vec<u64> {
    let done = Command::new("python3").args(["-c", script]).arg(file).output().unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    String::from_utf8(done.stdout).unwrap().split_whitespace().map(|number| number.parse().unwrap()).collect()
}

fn counts(log: &Log) -> Vec<u64> {
    vec![log.rows, log.sensors.len() as u64, log.activities.len() as u64, log.skipped]
}

#[test]
fn real_texts_have_as_many_rows_as_python_counts() {
    for (name, form, script) in [
        (
            "casas_tm000/tm000.multiday_absence.txt",
            "casas",
            "import sys\nrows=[l.split() for l in open(sys.argv[1])]\nprint(len(rows), len({r[2] for r in rows}), 0, 0)",
        ),
        (
            "casas_hh111_week1/hh111week1.csv",
            "csv",
            "import sys,itertools\nrows=[l.strip().split(',') for l in open(sys.argv[1])]\n\
             print(len(rows), len({r[1] for r in rows}), len(list(itertools.groupby(r[3] for r in rows))), 0)",
        ),
        (
            "kasteren_a/kasterenSenseData.txt",
            "intervals",
            "import re,sys\nr=r'(\\d+-\\w+-\\d+ [\\d:]+)\\s+(\\d+-\\w+-\\d+ [\\d:]+)\\s+(\\d+)'\n\
             f=lambda p:[m for m in (re.match(r,l) for l in open(p)) if m]\n\
             rows=f(sys.argv[1]);print(2*len(rows),len({m[3] for m in rows}),len(f(sys.argv[1].replace('Sense','Act'))),0)",
        ),
        (
            "uci_adl_ordonez/OrdonezA_Sensors.txt",
            "intervals",
            "import re,sys\nf=lambda p:[l.split() for l in open(p) if re.match(r'\\d{4}-',l)]\n\
             rows,adls=f(sys.argv[1]),f(sys.argv[1].replace('Sensors','ADLs'))\n\
             back=[r for r in adls if r[:2]>r[2:4]]\n\
             print(2*len(rows),len({tuple(r[4:]) for r in rows}),len(adls)-len(back),len(back))",
        ),
        (
            "mit_s1/activities_data.csv",
            "mit",
            "import sys\nl=[l.strip().split(',') for l in open(sys.argv[1],encoding='latin1') if l.strip()]\n\
             print(2*sum(len(r) for r in l[1::5]),len({i for r in l[1::5] for i in r}),len(l[0::5]),0)",
        ),
        (
            "xes_hh104/edited_hh104_weekends.xes",
            "xes",
            "import sys,xml.etree.ElementTree as E\nx='{http://www.xes-standard.org}'\n\
             e=[{a.get('key'):a.get('value') for a in v} for v in E.parse(sys.argv[1]).iter(x+'event')]\n\
             print(0,0,sum(a['lifecycle:transition']=='complete' for a in e),0)",
        ),
    ] {
        let Some(path) = real(name) else { continue };
        let (source, log) = from_file(&path);
        assert_eq!((source.form().name, counts(&log)), (form, counted(script, &path)), "{name}");
        let is_in_order = log.events.windows(2).all(|pair| pair[0].at <= pair[1].at);
        assert!(is_in_order || form == "csv" || form == "casas", "{name}");
        // A converted log keeps its activities.
        let folder = Folder::new(&format!("real-{form}-{}", log.rows));
        for to in ["csv:log.csv", "sqlite:log.db"] {
            carry(&source, &folder.url(to), "UTC", WriteMode::Create).unwrap();
            let again = read(LogSource::from(&folder.url(to)), &LoggerFile::default()).unwrap();
            assert!(again.rows == log.rows && again.activities == log.activities, "{name} to {to}");
        }
        if form == "casas" {
            carry(&folder.url("sqlite:log.db"), &folder.url("casas:log.txt"), "UTC", WriteMode::Create).unwrap();
            assert_eq!(from_file(&folder.path().join("log.txt")).1, log);
        }
    }
}
