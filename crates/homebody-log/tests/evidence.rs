//! A form of log is accepted on evidence, and an error says what another file is.

use crate::stage::Folder;
use crate::stage::texts::{SEVEN, done, from_file, from_text, known, written};
use homebody_core::time::{DAY, Interval, SECOND, WallTime};
use homebody_log::log::ColumnRole;
use homebody_log::{Log, LogError, LogSource};
use rusqlite::Connection;
use std::path::Path;

fn refused(path: &Path) -> LogError {
    match LogSource::recognise(path) {
        Ok(source) => panic!("{} is read as {source}", path.display()),
        Err(error) => error,
    }
}

fn told(log: &Log) -> Vec<(&str, &str)> {
    log.events.iter().map(|event| (log.sensor(event), log.value(event))).collect()
}

fn time(minute: usize) -> String {
    format!("2009-03-02 {:02}:{:02}:00", 7 + minute / 60, minute % 60)
}

/// A text of so many rows, each what is behind the time.
fn lines(count: usize, behind: impl Fn(usize) -> String) -> String {
    (0..count).map(|row| format!("{} {}\n", time(row), behind(row))).collect()
}

#[test]
fn the_log_of_a_program_is_no_log_of_sensors() {
    let folder = Folder::new("program");
    let words = ["opened", "closed", "retried", "dropped", "checked", "moved", "read"];
    let word = |row: usize| words[row * row % words.len()];
    for (number, text) in [
        lines(40, |row| format!("[main] INFO app.Server - request {row} {} in {} ms", word(row), row * 7)),
        lines(40, |row| format!("INFO (MainThread) [core.loader] Setting up {} {row}", word(row))),
        lines(40, |row| format!("-05:00 [INF] Job {row} {} the queue", word(row))),
        lines(40, |row| format!("host sshd[{row}]: connection {} by peer", word(row))),
        lines(40, |row| format!("GET /page/{row} 200 {}", row * 31)),
        lines(40, |row| format!("worker {row} {} the file a/{row}", word(row))),
        lines(40, |row| format!("The user {row} has {} a file again", word(row))),
        lines(3, |row| format!("Started job number {row} again")),
        lines(40, |row| format!("21.{row} 40.1 1013 0.{row}")),
    ]
    .iter()
    .enumerate()
    {
        let error = refused(&written(&folder, &format!("{number}.txt"), text));
        assert!(["log-form::program-log", "log-form::unnamed-columns"].contains(&error.code()), "{error}");
    }
}

#[test]
fn sensors_of_any_name_with_few_values_are_a_log() {
    let folder = Folder::new("casas-any");
    for (number, (text, sensors)) in [
        (lines(40, |row| format!("M0{} {}", row % 3, ["ON", "OFF"][row % 2])), 3),
        (lines(40, |row| format!("door_{} {}", row % 2, ["ajar", "shut"][row / 2 % 2])), 2),
        (lines(40, |row| format!("T1 {}.{}", 20 + row / 10, row % 10)), 1),
        (lines(1, |_| "M1 ON".into()), 1),
        (lines(40, |row| format!("-05:00 M0{} {}", row % 3, ["ON", "OFF"][row % 2])), 3),
        (lines(40, |row| format!("M0{} ON {} {}", row % 3, 1 + row % 2, 3)), 3),
    ]
    .iter()
    .enumerate()
    {
        let log = from_text(&folder, "casas", &format!("{number}.txt"), text);
        assert_eq!((log.sensors.len(), log.skipped), (*sensors, 0), "{text}");
    }
}

#[test]
fn a_word_that_belongs_to_the_sensor_is_its_room_and_no_value() {
    let folder = Folder::new("places");
    let sensors = [("Chair", "Lounge"), ("Bed", "Bedroom"), ("Door", "Entry")];
    let text = lines(30, |row| {
        let (sensor, place) = sensors[row % 3];
        format!("{sensor} {place} {} {}", ["ON", "OFF"][row / 3 % 2], ["Relax", "Sleep"][row / 15])
    });
    let log = from_text(&folder, "casas", "al.txt", &text);
    assert_eq!((log.sensors.len(), &log.values[..]), (3, &["ON".to_owned(), "OFF".into()][..]));
    assert_eq!(done(&log), [("Relax", 0.0, 15.0), ("Sleep", 15.0, 29.0)]);
    let rooms: Vec<_> = log.known.iter().map(|known| (&*known.id, known.room.as_deref().unwrap())).collect();
    assert_eq!(rooms, sensors);
    let roles: Vec<_> = log.columns.iter().map(|column| (&*column.column, column.used_as)).collect();
    assert_eq!(
        roles,
        [
            ("column 1", ColumnRole::Time),
            ("column 2", ColumnRole::Time),
            ("column 3", ColumnRole::Sensor),
            ("column 4", ColumnRole::Room),
            ("column 5", ColumnRole::Value),
            ("column 6", ColumnRole::Label)
        ]
    );
    // A word that changes with the row does not belong to the sensor.
    let text = lines(30, |row| format!("M1 {} {}", ["ON", "OFF"][row % 2], ["Cook", "Eat"][row / 15]));
    let log = from_text(&folder, "casas", "labels.txt", &text);
    assert_eq!((log.known.len(), log.values.len(), done(&log).len()), (0, 2, 2));
}

#[test]
fn rooms_places_and_kinds_in_columns_are_known_of_sensors() {
    let folder = Folder::new("translated");
    let heading = "DateTime\tSensor\tTranslate01\tTranslate02\tMessage\tSensorType\tActivity\n";
    let row = |minute: usize, rest: &str| format!("{}\t{rest}\n", time(minute));
    let text = [
        heading.to_owned(),
        row(0, "M1\tLiving Room\tArm Chair\tON\tControl4-Motion\tRelax"),
        row(1, "M1\tLiving Room\tArm Chair\tOFF\tControl4-Motion\tRelax"),
        row(2, "D1\tOutsideDoor\tFrontDoor\tOPEN\tControl4-Door\tLeave"),
        row(3, "T1\tKitchen\tKitchen\t21.5\tControl4-Temperature\tLeave"),
    ]
    .concat();
    let log = from_text(&folder, "casas", "ann.txt", &text);
    assert_eq!(told(&log), [("M1", "ON"), ("M1", "OFF"), ("D1", "OPEN"), ("T1", "21.5")]);
    assert_eq!(log.skipped, 0);
    let known: Vec<_> =
        log.known.iter().map(|known| (&*known.id, &*known.name, &*known.kind, known.room.as_deref())).collect();
    assert_eq!(
        known,
        [
            ("M1", "Arm Chair", "motion", Some("Living Room")),
            ("D1", "FrontDoor", "contact", None),
            ("T1", "Kitchen", "temperature", Some("Kitchen"))
        ]
    );
    assert_eq!(done(&log), [("Relax", 0.0, 2.0), ("Leave", 2.0, 3.0)]);
    assert_eq!(log.columns[2].column, "Translate01");
    // A table of sensors in the same folder outranks it.
    written(&folder, "sensors.csv", "id,name,kind,room,x_m,y_m\nM1,my chair,motion,parlour,0,0\n");
    let log = from_file(&folder.path().join("ann.txt")).1;
    assert_eq!((log.known[0].room.as_deref(), log.known.len()), (Some("parlour"), 3));
}

#[test]
fn notes_of_many_makes_are_activities() {
    let folder = Folder::new("notes");
    for (number, [begin, end]) in [
        ["1-begin", "1-end"],
        ["Work_Begin", "Work_End"],
        ["begin Cook", "end Cook"],
        ["R1_Work begin", "R1_Work end"],
        ["R2_Sleep_begin", "R2_Sleep_end"],
        ["Meal start", "Meal stop"],
    ]
    .iter()
    .enumerate()
    {
        let text = lines(30, |row| match row {
            3 => format!("M1 ON {begin}"),
            9 => format!("M1 OFF {end}"),
            _ => format!("M1 {}", ["ON", "OFF"][row % 2]),
        });
        let log = from_text(&folder, "casas", &format!("{number}.txt"), &text);
        let [activity] = &done(&log)[..] else { panic!("{begin}: {:?}", log.activities) };
        assert_eq!((activity.1, activity.2), (3.0, 9.0), "{begin}");
        assert!(!activity.0.to_lowercase().contains("begin") && !activity.0.contains("start"), "{}", activity.0);
    }
    // A label on each row is one, whatever it ends in.
    let text = lines(30, |row| format!("M1 {} {}", ["ON", "OFF"][row % 2], ["week-end", "Work"][row / 15]));
    assert_eq!(
        done(&from_text(&folder, "casas", "labels.txt", &text)),
        [("week-end", 0.0, 15.0), ("Work", 15.0, 29.0)]
    );
}

#[test]
fn people_by_number_do_things_of_their_own() {
    let folder = Folder::new("people");
    let text = lines(30, |row| match row % 2 {
        0 => format!("M1 ON 1 {}", 2 + row / 15),
        _ => "M2 ON 2 7".into(),
    });
    let log = from_text(&folder, "casas", "log.txt", &text);
    assert_eq!(done(&log), [("R1 activity 2", 0.0, 16.0), ("R2 activity 7", 1.0, 29.0), ("R1 activity 3", 16.0, 29.0)]);
    assert!(log.remarks.is_empty(), "{:?}", log.remarks);
}

#[test]
fn an_activity_that_begins_twice_lasts_to_its_second_end() {
    let folder = Folder::new("twice");
    let note = |row: usize| match row {
        1 | 3 => " Cook begin",
        5 | 8 => " Cook end",
        10 | 12 => " Eat begin",
        14 => " Eat end",
        20 => " Eat begin",
        22 => " Eat end",
        _ => "",
    };
    let text = lines(30, |row| format!("M1 {}{}", ["ON", "OFF"][row % 2], note(row)));
    let log = from_text(&folder, "casas", "log.txt", &text);
    // The second lacks one end.
    assert_eq!(done(&log), [("Cook", 1.0, 8.0), ("Eat", 10.0, 14.0), ("Eat", 20.0, 22.0)]);
    assert_eq!(log.remarks, ["1 notes that an activity begins or ends have no other end"]);
}

#[test]
fn damaged_states_are_left_out_and_named() {
    let folder = Folder::new("dirty");
    let odd = ["ONc", "OFFF", "OF", "ON0"];
    let text = lines(60, |row| match row {
        12..16 => format!("M1 {}", odd[row - 12]),
        20 => "M1 ON ON".into(),
        _ => format!("M1 {}", ["ON", "OFF"][row % 2]),
    });
    let log = from_text(&folder, "casas", "log.txt", &text);
    assert_eq!((&log.values[..], log.rows, log.skipped), (&["ON".to_owned(), "OFF".into()][..], 55, 5));
    assert_eq!(log.problems[0].why, "\"ONc\" looks like a damaged ON");
    assert!(log.activities.is_empty(), "{:?}", log.activities);
    // A frequent value cannot be damage.
    let text = lines(60, |row| format!("M1 {}", ["ONX", "OFF"][row % 2]));
    let log = from_text(&folder, "casas", "other.txt", &text);
    assert_eq!((log.rows, log.skipped), (60, 0));
}

#[test]
fn openhab_tells_of_items() {
    let folder = Folder::new("openhab");
    let text = lines(20, |row| match row {
        4 => "[INFO ] [openhab.event.ItemCommandEvent       ] - Item 'Lamp' received command ON".into(),
        5 => "[INFO ] [hab.event.ThingStatusInfoChangedEvent] - Thing 'a:b:c' changed from ONLINE to OFFLINE".into(),
        6 => {
            "[INFO ] [penhab.event.GroupItemStateChangedEvent] - Item 'gAll' changed from OFF to ON through Hall".into()
        }
        7 => "[INFO ] [openhab.event.ItemStateChangedEvent  ] - Item 'Heat' changed from 21.4 °C to 21.5 °C".into(),
        8 => "[INFO ] [openhab.event.ItemStateChangedEvent  ] - Item 'Hall' changed from ON to UNDEF".into(),
        _ => format!(
            "[INFO ] [openhab.event.ItemStateChangedEvent  ] - Item 'Hall' changed from {} to {}",
            ["ON", "OFF"][row % 2],
            ["OFF", "ON"][row % 2]
        ),
    });
    let log = from_text(&folder, "openhab", "events.log", &text);
    assert_eq!((log.sensors.clone(), log.rows, log.skipped), (vec!["Hall".to_owned(), "Heat".into()], 17, 0));
    assert_eq!(told(&log)[4..6], [("Heat", "21.5"), ("Hall", "unavailable")]);
    assert_eq!(known(&log, "Heat").unit.as_deref(), Some("°C"));
    assert_eq!(log.remarks.len(), 2, "{:?}", log.remarks);
    let older =
        lines(4, |row| format!("[vent.ItemStateChangedEvent] - Hall changed from A to {}", ["OFF", "ON"][row % 2]));
    assert_eq!(told(&from_text(&folder, "openhab", "older.log", &older))[..2], [("Hall", "OFF"), ("Hall", "ON")]);
    // Its other log has no items.
    let own = lines(30, |row| format!("[INFO ] [g.core.internal.Activator{row}] - The bundle {row} has been started"));
    let error = refused(&written(&folder, "openhab.log", own));
    assert_eq!(error.code(), "log-form::program-log", "{error}");
}

#[test]
fn a_record_of_an_impossible_day_is_named_and_decides_nothing() {
    let folder = Folder::new("impossible");
    let record = |day: &str| format!("Cooking,{day},8:0:0,8:10:0\r\n68\r\nBurner\r\n8:1:0\r\n8:2:0\r\n");
    let text =
        [record("2/30/2009"), record("3/2/2009"), record("13/2/2009"), record("3/3/2009"), record("-32768/1/2009")]
            .concat();
    let log = from_text(&folder, "mit", "activities_data.csv", &text);
    assert_eq!((log.rows, log.activities.len(), log.skipped), (4, 2, 3));
    let why: Vec<_> = log.problems.iter().map(|problem| (problem.line, problem.why.as_str())).collect();
    assert_eq!(why[0], (1, "there is no 30 February 2009: its record is left out, which has 5 lines"));
    assert!(why[1].0 == 11 && why[1].1.starts_with("there is no month 13"), "{why:?}");
}

#[test]
fn a_gap_between_rows_of_each_second_ends_what_is_on() {
    let folder = Folder::new("gaps");
    let row = |at: &str, bed: u8, heat: &str| format!("{bed},0,{heat},sleep,{at}\n");
    let text = [
        "bed,tv,heat,Activity,timestamp\n".to_owned(),
        row("2009-03-02 07:00:00", 1, "20.5"),
        row("2009-03-02 07:00:01", 1, "20.5"),
        row("2009-03-03 07:00:00", 1, "20.5"),
        row("2009-03-03 07:00:01", 1, "20.6"),
    ]
    .concat();
    let log = from_text(&folder, "openshs", "openshs.csv", &text);
    let rows: Vec<_> =
        log.events.iter().map(|event| ((event.at - SEVEN) / SECOND, log.sensor(event), log.value(event))).collect();
    let day = DAY / SECOND;
    assert_eq!(
        rows,
        [(0, "bed", "ON"), (0, "heat", "20.5"), (day, "bed", "ON"), (day, "heat", "20.5"), (day + 1, "heat", "20.6")]
    );
    assert_eq!(log.gaps, [Interval::new(SEVEN + 2 * SECOND, SEVEN + DAY)]);
    let spans: Vec<_> = log.activities.iter().map(|of| of.length() / SECOND).collect();
    assert_eq!((spans, log.skipped), (vec![2, 2], 0));
}

#[test]
fn a_file_a_day_is_one_log() {
    let folder = Folder::new("days");
    let row = |on: u8| format!("{on} {}11 2\n", "0 ".repeat(19));
    for day in [1, 2, 10] {
        // The last second of the first day and the first of the next are of one activity.
        let text = if day == 1 { row(0).repeat(86_399) + &row(1) } else { row(1) + &row(0) };
        written(&folder, &format!("DAY_{day}.txt"), text);
    }
    written(&folder, "README.txt", "What is in here.\n");
    let (source, log) = from_file(folder.path());
    assert_eq!(source.form().name, "aras");
    let rows: Vec<_> = log.events.iter().map(|event| (event.at.since_zero() / SECOND, log.value(event))).collect();
    let day = DAY / SECOND;
    assert_eq!(rows, [(day - 1, "ON"), (day + 1, "OFF"), (9 * day, "ON"), (9 * day + 1, "OFF")]);
    assert_eq!(log.gaps, [Interval::new(WallTime::EPOCH + DAY + 2 * SECOND, WallTime::EPOCH + 9 * DAY)]);
    let first = log.activities.iter().find(|of| of.label == "R1 activity 11").unwrap();
    assert_eq!(first.time, Interval::new(WallTime::EPOCH, WallTime::EPOCH + DAY + 2 * SECOND));
    assert!(log.remarks.iter().any(|remark| remark == "it is one log in 3 files, DAY_1.txt to DAY_10.txt"), "{log:?}");
    assert_eq!(LogSource::recognise(folder.path()).unwrap().files().len(), 3);

    let folder = Folder::new("dates");
    let text = |day: u8| format!("2009-03-{day:02} 07:00:00 M1 ON\n2009-03-{day:02} 23:00:00 M1 OFF\nodd\n");
    for day in [9, 10, 12] {
        written(&folder, &format!("2009-03-{day}.txt"), text(day));
    }
    let (_, log) = from_file(folder.path());
    assert_eq!((log.rows, log.skipped, log.gaps.len()), (6, 3, 1));
    assert!(log.problems[1].beside.as_deref().unwrap().ends_with("2009-03-10.txt"), "{:?}", log.problems);
}

#[test]
fn logs_at_the_same_time_or_of_several_homes_are_not_one() {
    for (names, days) in [
        (["log-1.txt", "log-2.txt"], [1, 1]),
        (["home1.txt", "home2.txt"], [1, 5]),
        (["hall.txt", "kitchen.txt"], [1, 5]),
    ] {
        let folder = Folder::new(&format!("unlike-{}", names[0]));
        for (name, day) in names.iter().zip(days) {
            let text = format!("2009-03-{day:02} 07:00:00 M1 ON\n2009-03-{day:02} 08:00:00 M1 OFF\n");
            written(&folder, name, text);
        }
        let error = refused(folder.path());
        let LogError::NoLog(reason) = &error else { panic!("{error}") };
        assert_eq!((error.code(), &reason.why.data["names"]), ("log-form::several-logs", &names.to_vec().into()));
    }
}

const DEVICES: &str = "time,device,value\n2009-03-02 07:00:00,hall,1\n2009-03-02 07:30:00,hall,0\n";

#[test]
fn labels_beside_a_log_are_known_by_what_they_hold() {
    for (name, text) in [
        ("activities_subject_ann.csv", "start_time,end_time,activity\n2009-03-02 07:00:00,2009-03-02 07:05:00,eat\n"),
        ("ground_truth.csv", "from;to;adl\n2009-03-02 07:00:00;2009-03-02 07:05:00;eat\n"),
        ("home.ann.txt", "2009-03-02 07:00:00\t2009-03-02 07:05:00\teat\n"),
        (
            "diary.csv",
            "from,until,who,what\n2009-03-02 07:00:00,2009-03-02 07:05:00,Anna,eat\n2009-03-02 07:06:00,2009-03-02 07:09:00,Anna,read\n",
        ),
        ("what.csv", "Label,Begin,End\neat,2009-03-02 07:00:00,2009-03-02 07:05:00\n"),
    ] {
        let folder = Folder::new(&format!("beside-{name}"));
        let log = written(&folder, "devices.csv", DEVICES);
        written(&folder, name, text);
        for path in [&log, folder.path()] {
            let log = from_file(path).1;
            assert_eq!((log.rows, done(&log)[0]), (2, ("eat", 0.0, 5.0)), "{name}");
            assert_eq!(log.remarks, [format!("its activities are those of {name} beside it")]);
        }
    }
}

#[test]
fn other_tables_beside_a_log_are_no_labels() {
    for (name, text) in [
        ("next.csv", "start_time,end_time,activity\n2019-03-02 07:00:00,2019-03-02 07:05:00,eat\n"),
        ("sensed.txt", "Start time\tEnd time\tID\tVal\n2009-03-02 07:00:00\t2009-03-02 07:05:00\t24\t1\n"),
        ("older.csv", "start_time,end_time,device,val\n2009-03-02 07:00:00,2009-03-02 07:10:00,a,1\n"),
        ("notes.txt", "Anna was here.\n"),
    ] {
        let folder = Folder::new(&format!("not-beside-{name}"));
        let log = written(&folder, "log.csv", DEVICES);
        written(&folder, name, text);
        let log = from_file(&log).1;
        assert_eq!((log.rows, done(&log).len(), log.remarks.len()), (2, 0, 0), "{name}");
    }
    // Of another log by its name.
    let folder = Folder::new("of-another");
    let log = written(&folder, "log.csv", DEVICES);
    written(&folder, "other.csv", DEVICES);
    let labels = "start_time,end_time,activity\n2009-03-02 07:00:00,2009-03-02 07:05:00,eat\n";
    written(&folder, "other.activity.csv", labels);
    assert_eq!(done(&from_file(&log).1), []);
    // If several fit, the remark names them and reads none.
    written(&folder, "a.csv", labels);
    written(&folder, "b.csv", labels);
    let log = from_file(&log).1;
    assert!(done(&log).is_empty() && log.remarks[0].contains("a.csv and b.csv beside it"), "{:?}", log.remarks);
}

#[test]
fn a_file_that_is_no_log_is_called_what_it_is() {
    let folder = Folder::new("foreign");
    for (bytes, said) in [
        (&b"version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n"[..], "git lfs pull"),
        (b"MATLAB 5.0 MAT-file, Platform: GLNXA64\0\0\0", "MATLAB"),
        (b"\x93NUMPY\x01\0v\0{'descr': '<f8'}\n", "NumPy"),
        (b"\x80\x04\x95\x1e\0\0\0\0\0\0\0]", "pickle"),
        (b"-- MySQL dump 10.13  Distrib 8.0.36\n--\n", "MySQL"),
        (b"--\n-- PostgreSQL database dump\n--\n", "PostgreSQL"),
        (b"\0\xb5\0mosquitto db\0\0\0", "mosquitto_sub"),
        (b"\x89HDF\r\n\x1a\n\0\0", "HDF5"),
        (b"PK\x03\x04\x14\0", "archive"),
        (b"7z\xbc\xaf\x27\x1c\0", "7z"),
        (b"%PDF-1.7\n", "PDF"),
        (b"<!DOCTYPE html>\n<html><title>404, 2009-03-02 07:00:00, none</title>\n", "web page"),
        (b"\xff\xd8\xff\xe0\0\x10JFIF", "picture"),
        (b"INSERT INTO log VALUES ('2009-03-02 07:00:00','M1','ON');\n", "dump"),
    ] {
        let error = refused(&written(&folder, "log", bytes));
        assert!(error.code().starts_with("log-form::") && error.to_string().contains(said), "{said}: {error}");
    }
    // Such bytes inside a log do not matter.
    let text = "time,sensor,value\n2009-03-02 07:00:00,%PDF-,<html>\n";
    assert_eq!(told(&from_text(&folder, "csv", "log.csv", text)), [("%PDF-", "<html>")]);
}

#[test]
fn the_level_of_an_x10_sensor_is_its_reading_where_its_state_stays() {
    let folder = Folder::new("levels");
    let mut text =
        String::from(" mark | zone | number | state | level | source | info\n------+------+--------+---+---+---+---\n");
    for row in 0..6 {
        text += &format!(" {} | S | 17 | 1 | {} | A | i\n", time(2 * row), 38 + row);
        text += &format!(" {} | V | 3 | {} | 100 | A | i\n", time(2 * row + 1), row % 2);
    }
    let log = from_text(&folder, "psql", "raw.data", &text);
    assert_eq!(told(&log)[..4], [("S17", "38"), ("V3", "0"), ("S17", "39"), ("V3", "1")]);
}

#[test]
fn domoticz_names_its_devices() {
    let folder = Folder::new("domoticz");
    let path = folder.path().join("domoticz.db");
    let sql = "CREATE TABLE DeviceStatus (ID INTEGER PRIMARY KEY, Name TEXT, SwitchType INTEGER, nValue INTEGER);
        INSERT INTO DeviceStatus VALUES (1, 'Hall', 8, 0), (2, 'Front door', 11, 0), (3, 'Kitchen', 0, 0), (4, 'Kitchen', 0, 0);
        CREATE TABLE LightingLog (DeviceRowID INTEGER, nValue INTEGER, sValue TEXT, Date DATETIME);
        INSERT INTO LightingLog VALUES (1, 1, '0', '2009-03-02 07:00:00'), (1, 0, '0', '2009-03-02 07:01:00'),
            (2, 1, '0', '2009-03-02 07:02:00'), (2, 0, '0', '2009-03-02 07:03:00'), (3, 1, '0', '2009-03-02 07:05:00');
        CREATE TABLE Temperature (DeviceRowID INTEGER, Temperature FLOAT, Humidity INTEGER, Date DATETIME);
        INSERT INTO Temperature VALUES (4, 21.5, 0, '2009-03-02 07:04:00');";
    Connection::open(&path).unwrap().execute_batch(sql).unwrap();
    let (source, log) = from_file(&path);
    assert_eq!(source.form().name, "domoticz");
    let rows = [
        ("Hall", "ON"),
        ("Hall", "OFF"),
        ("Front door", "OPEN"),
        ("Front door", "CLOSE"),
        ("Kitchen 4", "21.5"),
        ("Kitchen 3", "ON"),
    ];
    assert_eq!((told(&log), log.skipped), (rows.to_vec(), 0));
    let kinds: Vec<_> = log.known.iter().map(|known| (&*known.id, &*known.kind)).collect();
    assert_eq!(kinds[..2], [("Hall", "motion"), ("Front door", "contact")]);
    // A database without its devices is another one.
    let path = folder.path().join("other.db");
    let sql = "CREATE TABLE LightingLog (time, sensor, value); INSERT INTO LightingLog VALUES ('2009-03-02 07:00:00', 'M1', 'ON')";
    Connection::open(&path).unwrap().execute_batch(sql).unwrap();
    assert_eq!(from_file(&path).0.form().name, "sqlite");
}

/// The columns with their roles.
fn columns(log: &Log) -> Vec<(&str, ColumnRole)> {
    log.columns.iter().map(|of| (of.column.as_str(), of.used_as)).collect()
}

#[test]
fn forms_without_a_heading_say_where_time_sensor_and_value_are() {
    let folder = Folder::new("columns");
    let state = |minute: usize| ["OFF", "ON"][minute % 2];
    let item = |minute: usize| {
        let (from, to) = (state(minute + 1), state(minute));
        format!(
            "2009-03-02 07:{minute:02}:00.421 [INFO ] [openhab.event.ItemStateChangedEvent   ] - Item 'Hall' changed from {from} to {to}\n"
        )
    };
    let openhab = from_text(&folder, "openhab", "events.log", &(0..9).map(item).collect::<String>());
    let record =
        "Bathing,4/1/2003,20:41:35,21:32:50\n100,68\nToilet Flush,Sink faucet\n20:51:52,20:58:22\n20:52:05,21:05:51\n";
    let mit = from_text(&folder, "mit", "activities_data.csv", record);
    let span = |at: usize| format!("{} {}\tHall\n", time(2 * at), time(2 * at + 1));
    let intervals = from_text(&folder, "intervals", "intervals.txt", &(0..9).map(span).collect::<String>());
    let xes = "<log>\n<trace><event><string key=\"concept:name\" value=\"Eat\"/>\
        <date key=\"time:timestamp\" value=\"2009-03-02T07:00:00Z\"/></event></trace></log>\n";
    let xes = from_text(&folder, "xes", "events.xes", xes);
    for (log, roles) in [
        (&openhab, &[ColumnRole::Time, ColumnRole::Sensor, ColumnRole::Value][..]),
        (&mit, &[ColumnRole::Time, ColumnRole::Label, ColumnRole::Sensor, ColumnRole::Time, ColumnRole::End]),
        (&intervals, &[ColumnRole::Time, ColumnRole::End, ColumnRole::Sensor]),
        (&xes, &[ColumnRole::Time, ColumnRole::Label, ColumnRole::End]),
    ] {
        assert_eq!(columns(log).into_iter().map(|(_, role)| role).collect::<Vec<_>>(), roles, "{:?}", columns(log));
        assert!(log.columns.iter().all(|of| !of.because.is_empty() && !of.is_guess));
    }
}

#[test]
fn a_reading_before_a_colon_is_no_room() {
    let folder = Folder::new("colon");
    let log = |between: &'static str| {
        let text = lines(20, move |row| format!("Flur_1 {between} {}", ["on", "off"][row % 2]));
        from_text(&folder, "casas", "log.txt", &text)
    };
    let (reading, room) = (log("motion:"), log("Kitchen"));
    assert_eq!(columns(&reading)[3], ("column 4", ColumnRole::Kind));
    assert_eq!((reading.known[0].room.as_deref(), reading.known[0].kind.as_str()), (None, "motion"));
    assert_eq!(room.known[0].room.as_deref(), Some("Kitchen"));
}
