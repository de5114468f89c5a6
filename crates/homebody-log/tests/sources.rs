//! Logs of any program are read back.

use crate::stage::texts::{carry, content, skipped};
use crate::stage::{self, Folder};
use homebody_core::scenario::logger::{LoggerFile, MessagesFile, OnOffFile, TimeFormat};
use homebody_core::time::UtcTime;
use homebody_log::limits::{LONGEST_ID, LONGEST_ROW_BYTES, LONGEST_VALUE, MOST_CELLS};
use homebody_log::log::Clock;
use homebody_log::{Log, LogError, LogSource, WriteMode, read, stream, survey};
use rusqlite::Connection;
use std::fs;

const ALL: [&str; 3] = ["sqlite:log.db", "csv:log.csv", "casas:log.txt"];

fn from_text(folder: &Folder, url: &str, text: &str) -> Result<Log, LogError> {
    let url = folder.url(url);
    fs::write(url.file().unwrap(), text).unwrap();
    assert_eq!(LogSource::recognise(url.file().unwrap()).unwrap(), LogSource::from(&url));
    read(&url, &LoggerFile::default())
}

/// Rows as microseconds, sensor, value.
fn told(log: &Log) -> Vec<(i64, &str, &str)> {
    log.events.iter().map(|event| (event.at.micros(), log.sensor(event), log.value(event))).collect()
}

#[test]
fn reads_back_logged_rows() {
    let firings = stage::firings(5_000);
    let messages = MessagesFile::OnOff(OnOffFile::exactly(4.0));
    for time in [TimeFormat::Local, TimeFormat::LocalOffset, TimeFormat::Utc, TimeFormat::EpochS] {
        let folder = Folder::new(&format!("back-{time:?}"));
        let file = LoggerFile { messages: messages.clone(), time, ..Default::default() };
        let urls = ALL.map(|url| folder.url(url));
        let stored = stage::store(stage::open(&urls, &file, false).unwrap(), &firings, 100).unwrap();
        let [database, csv, casas] = urls.map(|url| {
            assert_eq!(LogSource::recognise(url.file().unwrap()).unwrap(), LogSource::from(&url));
            read(&url, &LoggerFile::default()).unwrap()
        });
        assert!(database.columns.is_empty() && !csv.columns.is_empty());
        assert_eq!(content(database.clone()), content(csv));
        assert_eq!(database.events.len() as u64, stored.rows);
        assert_eq!(casas.clock, Clock::Local);
        let clock = if time == TimeFormat::Local { Clock::Local } else { Clock::Utc };
        assert_eq!(database.clock, clock);
        if time == TimeFormat::Local {
            assert_eq!(casas.events, database.events);
        } else {
            let first = UtcTime::from(stage::calendar().timestamp(firings[0].at));
            assert_eq!(database.events[0].at, first.on_wall_of_utc());
        }
    }
}

#[test]
fn a_log_goes_from_form_to_form_and_comes_back_the_same() {
    let folder = Folder::new("round");
    let file = LoggerFile { messages: MessagesFile::OnOff(OnOffFile::exactly(4.0)), ..Default::default() };
    let logger = stage::open(&[folder.url("casas:first.txt")], &file, false).unwrap();
    stage::store(logger, &stage::firings(10_000), 100).unwrap();
    let mut from = folder.url("casas:first.txt");
    for to in ["sqlite:second.db", "csv:third.csv", "sqlite:fourth.db", "casas:last.txt"] {
        let to = folder.url(to);
        let log = read(&from, &LoggerFile::default()).unwrap();
        let rows = carry(&from, &to, "UTC", WriteMode::Create).unwrap();
        assert_eq!(rows, log.events.len() as u64);
        from = to;
    }
    assert_eq!(folder.text("first.txt"), folder.text("last.txt"));
    let again = carry(&folder.url("casas:first.txt"), &from, "UTC", WriteMode::Create);
    assert!(matches!(again, Err(LogError::Exists { .. })));
}

#[test]
fn a_database_of_ours_names_the_zone_of_its_home() {
    let folder = Folder::new("zone");
    let database = Connection::open(folder.path().join("log.db")).unwrap();
    let rows = "CREATE TABLE firing (fired_at TEXT, sensor TEXT, value TEXT);
        INSERT INTO firing VALUES ('2009-03-07T22:00:05Z', 'hall', 'ON')";
    database.execute_batch(rows).unwrap();
    let zone = || {
        let log = read(&folder.url("sqlite:log.db"), &LoggerFile::default()).unwrap();
        log.zone.and_then(|zone| zone.iana_name().map(str::to_owned))
    };
    assert_eq!(zone(), None);
    database.execute_batch("CREATE TABLE run (zone TEXT); INSERT INTO run VALUES ('America/Chicago')").unwrap();
    assert_eq!(zone().as_deref(), Some("America/Chicago"));
    database.execute_batch("INSERT INTO run VALUES ('Europe/Berlin')").unwrap();
    assert_eq!(zone(), None, "two homes have no one zone");
}

/// Texts in CSV are read back with blanks at their ends and control characters; CASAS refuses those that it cannot hold.
#[test]
fn odd_texts_are_read_back_or_refused() {
    let odd =
        [(" door ", "ON"), ("\u{a0}stove", "  ON"), ("a\tb", "O\nN"), ("\r\nhall\r", "x\r"), ("=cmd()", "\u{1}'=1 ")];
    let folder = Folder::new("odd");
    let database = Connection::open(folder.path().join("first.db")).unwrap();
    database.execute_batch("CREATE TABLE firing (fired_at TEXT, sensor TEXT, value TEXT)").unwrap();
    for (sensor, value) in odd {
        let sql = "INSERT INTO firing VALUES ('2009-03-07 22:00:05', ?, ?)";
        database.execute(sql, [sensor, value]).unwrap();
    }
    drop(database);
    carry(&folder.url("sqlite:first.db"), &folder.url("csv:second.csv"), "UTC", WriteMode::Create).unwrap();
    let texts = |log: &Log| {
        log.events.iter().map(|event| (log.sensor(event).to_owned(), log.value(event).to_owned())).collect::<Vec<_>>()
    };
    let expected = odd.map(|(sensor, value)| (sensor.to_owned(), value.to_owned()));
    let log = read(&folder.url("csv:second.csv"), &LoggerFile::default()).unwrap();
    assert_eq!(texts(&log), expected);
    // Lines that end as on Windows add nothing to the last cell.
    let plain = "seq,fired_at,sensor,value\r\n0,2009-03-07 22:00:05, door ,ON\r\n";
    let log = from_text(&folder, "csv:windows.csv", plain).unwrap();
    assert_eq!(texts(&log), [(" door ".to_owned(), "ON".to_owned())]);
    let error = carry(&folder.url("sqlite:first.db"), &folder.url("casas:third.txt"), "UTC", WriteMode::Create)
        .unwrap_err()
        .to_string();
    assert!(error.contains("cannot hold the control characters of ") && error.contains("sqlite:log.db"), "{error}");
    assert!(!folder.files().iter().any(|name| name.starts_with("third")), "{:?}", folder.files());
}

#[test]
fn a_log_is_streamed_in_parts() {
    let folder = Folder::new("streamed");
    let urls = ALL.map(|url| folder.url(url));
    let logger = stage::open(&urls, &LoggerFile::default(), false).unwrap();
    stage::store(logger, &stage::firings(50_000), 1000).unwrap();
    for url in urls {
        let whole = read(&url, &LoggerFile::default()).unwrap();
        let (mut events, mut most) = (Vec::new(), 0);
        let rest = stream(&url, &LoggerFile::default(), &mut |part| {
            most = most.max(part.events.len());
            assert!(part.events.iter().all(|event| (event.sensor as usize) < part.sensors.len()));
            events.extend_from_slice(&part.events);
            Ok(())
        })
        .unwrap();
        assert!(most * 5 < events.len(), "{most} of {} rows at once", events.len());
        assert_eq!((rest.rows, rest.events.len()), (50_000, 0));
        assert_eq!(Log { events, ..rest }, whole);
        assert_eq!(survey(&url, &LoggerFile::default()).unwrap().sensors, whole.sensors);
        // The caller may stop reading.
        let mut parts = 0;
        let enough = stream(&url, &LoggerFile::default(), &mut |_| {
            parts += 1;
            Err(LogError::destination("there", "it is full"))
        });
        assert!(enough.is_err() && parts == 1);
    }
}

#[test]
fn facts_about_sensors_come_with_the_log() {
    let folder = Folder::new("known");
    let log = "fired_at,sensor,value\n2009-03-02T07:12:03,M_1,FIRE\n2009-03-02T07:12:04,X,FIRE\n";
    let known = |table: &str| {
        fs::write(folder.url("csv:sensors.csv").file().unwrap(), table).unwrap();
        from_text(&folder, "csv:log.csv", log).unwrap().known
    };
    let head = "id,name,kind,room,x_m,y_m\n";
    let told = known(&format!("{head}M 1,hall wall,motion,hall,1.5,2\nD1,front door,contact,,0,0.25\n"));
    let told: Vec<_> =
        told.iter().map(|one| (&*one.id, &*one.name, &*one.kind, one.is_motion, one.room.as_deref())).collect();
    assert_eq!(
        told,
        [("M 1", "hall wall", "motion", true, Some("hall")), ("D1", "front door", "contact", false, None)]
    );
    assert_eq!(known("what,somebody,else\nwrote,of,theirs\n"), []);
    // A table that is too large is skipped and reported.
    let large = format!("{head}M 1,{},motion,hall,1.5,2\n", "x".repeat(4 << 20));
    assert_eq!(known(&large), []);
    let [remark] = &from_text(&folder, "csv:log.csv", log).unwrap().remarks[..] else { panic!("one remark") };
    assert!(remark.contains("sensors.csv: it is larger than 4 MB"), "{remark}");
}

#[test]
fn a_table_of_sensors_may_be_written_by_hand() {
    let folder = Folder::new("by hand");
    let log = "fired_at,sensor,value\n2009-03-02T07:12:03,M1,ON\n2009-03-02T07:12:04,D1,ON\n";
    let read = |table: &str| {
        fs::write(folder.url("csv:sensors.csv").file().unwrap(), table).unwrap();
        let log = from_text(&folder, "csv:log.csv", log).unwrap();
        let known: Vec<(String, String, Option<String>)> =
            log.known.into_iter().map(|known| (known.id, known.kind, known.room)).collect();
        let file = |place: &str| place.rsplit('/').next().unwrap().to_owned();
        let told: Vec<String> =
            log.problems.iter().map(|one| format!("{}: {}", file(&one.place("log.csv")), one.why)).collect();
        assert_eq!(log.skipped as usize, told.len());
        (known, told)
    };
    let row = |id: &str, kind: &str, room: Option<&str>| (id.to_owned(), kind.to_owned(), room.map(str::to_owned));
    let wanted = vec![row("M1", "motion", None), row("D1", "contact", None)];
    assert_eq!(read("id,kind\nM1,motion\nD1,contact\n"), (wanted.clone(), vec![]));
    assert_eq!(read("\u{feff}Kind;ID\nmotion;M1\ncontact;D1\n").0, wanted, "as a spreadsheet in German writes it");
    assert_eq!(read("id,room\nM1,hall\n").0, [row("M1", "", Some("hall"))]);
    // Each fault is reported with its line, and the rest counts.
    let (known, told) = read("id,kind,x_m\nM1,motoin,1\n,motion,1\nD1,contact,far\nD1,motion,1\n");
    assert_eq!(known, [row("M1", "", None), row("D1", "contact", None)]);
    assert_eq!(
        told,
        [
            "sensors.csv:2: the kind \"motoin\" is not known: there are motion, contact, used, reading, other, and words such as \
             door, bed and light",
            "sensors.csv:3: there is no id",
            "sensors.csv:4: x_m is no number: \"far\"",
            "sensors.csv:5: the id \"D1\" has a row already",
        ]
    );
}

#[test]
fn lines_are_counted_as_people_count_them() {
    let folder = Folder::new("lines");
    for (name, text) in [
        ("unix", "time,sensor,value\n2009-03-02T07:12:03,A,ON\nnever,A,ON\n\n2009-03-02T07:12:04,A,ON\nnever,A,ON\n"),
        (
            "windows",
            "time,sensor,value\r\n2009-03-02T07:12:03,A,ON\r\nnever,A,ON\r\n\r\n2009-03-02T07:12:04,A,ON\r\nnever,A,ON\r\n",
        ),
    ] {
        let log = from_text(&folder, &format!("csv:{name}.csv"), text).unwrap();
        assert_eq!(skipped(&log), [3, 6], "{name}");
    }
}

#[test]
fn a_log_in_utc_becomes_local_for_casas_alone() {
    let folder = Folder::new("utc");
    let text = "entity_id,state,last_changed\nbinary_sensor.hall,on,2009-03-02T13:12:03.250000Z\n";
    from_text(&folder, "csv:ha.csv", text).unwrap();
    let from = folder.url("csv:ha.csv");
    carry(&from, &folder.url("casas:log.txt"), "America/Chicago", WriteMode::Create).unwrap();
    carry(&from, &folder.url("csv:log.csv"), "America/Chicago", WriteMode::Create).unwrap();
    assert_eq!(folder.text("log.txt"), "2009-03-02 07:12:03.250000\tbinary_sensor.hall\ton\n");
    assert_eq!(folder.text("log.csv").lines().last(), Some("0,2009-03-02T13:12:03.250000Z,binary_sensor.hall,on"));
    let nowhere = carry(&from, &folder.url("csv:x.csv"), "Mars/Olympus", WriteMode::Create);
    assert!(matches!(nowhere, Err(LogError::Zone { .. })));
}

#[test]
fn other_peoples_tables_are_found() {
    let folder = Folder::new("tables");
    for (name, sql) in [
        (
            "names",
            "CREATE TABLE sensor (id, room); INSERT INTO sensor VALUES (1, 'hall');
             CREATE TABLE \"my events\" (device TEXT, state TEXT, timestamp TEXT);
             INSERT INTO \"my events\" VALUES ('D1', 'OPEN', '2009-03-02 07:12:03')",
        ),
        (
            "content",
            "CREATE TABLE x (a INTEGER, b TEXT, c TEXT, d TEXT);
             INSERT INTO x VALUES (7, '2009-03-02 07:12:03', 'D1', 'OPEN')",
        ),
        (
            "seconds",
            "CREATE TABLE log (ts REAL, sensor TEXT, value TEXT);
             INSERT INTO log VALUES (1235977923.0, 'D1', 'OPEN')",
        ),
    ] {
        let url = folder.url(&format!("sqlite:{name}.db"));
        Connection::open(url.file().unwrap()).unwrap().execute_batch(sql).unwrap();
        let log = read(&url, &LoggerFile::default()).unwrap();
        assert_eq!(told(&log), [(1_235_977_923_000_000, "D1", "OPEN")], "{name}");
    }
    for (name, sql) in [
        ("none", "CREATE TABLE x (a)"),
        (
            "spans",
            "CREATE TABLE x (who TEXT, what TEXT, begun TEXT, ended TEXT, note TEXT);
             INSERT INTO x VALUES ('margaret', 'cook', '2009-03-02 07:12:03', '2009-03-02 07:20:00', 'soup')",
        ),
    ] {
        let url = folder.url(&format!("sqlite:{name}.db"));
        Connection::open(url.file().unwrap()).unwrap().execute_batch(sql).unwrap();
        assert!(matches!(read(&url, &LoggerFile::default()), Err(LogError::NoLog { .. })), "{name}");
    }
}

#[test]
fn a_mapping_leads_to_its_own_table() {
    let folder = Folder::new("mapped");
    let mut file = LoggerFile { table: Some("hits".into()), time: TimeFormat::EpochMs, ..Default::default() };
    file.columns.time = "sensor".into();
    file.columns.sensor = "time".into();
    let url = folder.url("sqlite:log.db");
    stage::ten_rows(&url, &file);
    let other = "CREATE TABLE firing (run_id, seq, fired_at, sensor, value)";
    Connection::open(url.file().unwrap()).unwrap().execute_batch(other).unwrap();
    let log = read(&url, &file).unwrap();
    assert_eq!(log.events.len(), 10);
    assert_eq!(log.sensor(&log.events[0]), "bedroom motion");
}

#[test]
fn finds_an_unknown_mapping_by_its_rows() {
    let folder = Folder::new("unnamed");
    for (index, time) in [TimeFormat::EpochS, TimeFormat::EpochMs, TimeFormat::Local].into_iter().enumerate() {
        let mut file = LoggerFile { table: Some("hits".into()), time, ..Default::default() };
        (file.columns.time, file.columns.sensor, file.columns.value) = ("ts_x".into(), "who".into(), "what".into());
        for scheme in ["sqlite", "csv"] {
            let url = folder.url(&format!("{scheme}:log{index}.{scheme}"));
            stage::ten_rows(&url, &file);
            let log = read(&url, &LoggerFile::default()).unwrap();
            assert_eq!((log.events.len(), log.skipped), (10, 0), "{url} in {time:?}");
            assert_eq!(log.sensor(&log.events[0]), "bedroom motion");
        }
    }
}

#[test]
fn reads_one_of_several_runs() {
    let folder = Folder::new("runs");
    let url = folder.url("sqlite:log.db");
    stage::ten_rows(&url, &LoggerFile::default());
    let more = "INSERT INTO firing SELECT 2, seq, fired_at, sensor, value FROM firing";
    Connection::open(url.file().unwrap()).unwrap().execute_batch(more).unwrap();
    let log = read(&url, &LoggerFile::default()).unwrap();
    assert_eq!((log.events.len(), log.skipped), (10, 0));
    assert_eq!(log.remarks, ["of 2 runs in it only the first is read"]);
}

#[test]
fn csv_files_of_many_kinds() {
    let folder = Folder::new("csv");
    let one = [(1_235_977_923_250_000, "M1", "ON")];
    for text in [
        "time,device,value\n2009-03-02 07:12:03.25,M1,ON\n",
        "\u{feff}Time,Sensor,Value\r\n2009-03-02 07:12:03.25,M1,ON\r\n",
        "2009-03-02 07:12:03.25,M1,ON,Sleep\n",
        "seq,ts_local,sensor_id,event_code\n0,2009-03-02 07:12:03.25,M1,ON\n",
        "time;sensor;value\n2009-03-02 07:12:03.25;M1;ON\n",
        "value,\"sensor\",note,time\nON,\"M1\",\"a, b\",2009-03-02T07:12:03.25\n",
    ] {
        assert_eq!(told(&from_text(&folder, "csv:log.csv", text).unwrap()), one, "{text}");
    }
    for text in ["a,b,c\n1,2,3\n", "a,b,c\n", "a,b,c\n2009-03-02 07:12:03.25,M1\n"] {
        assert!(matches!(from_text(&folder, "csv:log.csv", text), Err(LogError::NoLog { .. })), "{text}");
    }
    let log =
        from_text(&folder, "csv:log.csv", "time,device,value\n2009-03-02 07:12:03.25,M1,ON\nx,M1\n,,,,\n").unwrap();
    assert_eq!((told(&log), log.skipped), (one.to_vec(), 2));
    assert_eq!(log.problems[0].line, 3);
}

#[test]
fn reports_files_that_are_not_logs() {
    let folder = Folder::new("no-log");
    for scheme in ["sqlite", "csv", "casas"] {
        let missing = read(&folder.url(&format!("{scheme}:none")), &LoggerFile::default());
        assert!(matches!(missing, Err(LogError::Missing { .. })));
        let url = folder.url(&format!("{scheme}:text"));
        fs::write(url.file().unwrap(), "it is,\n no,\n log,").unwrap();
        assert!(matches!(read(&url, &LoggerFile::default()), Err(LogError::NoLog { .. })), "{scheme}");
        let is_folder = read(&folder.url(&format!("{scheme}:.")), &LoggerFile::default());
        assert!(matches!(is_folder, Err(LogError::IsFolder { .. })));
    }
}

/// One row with a zone does not make strangers of all others, be it the first.
#[test]
fn most_rows_say_which_clock_it_is() {
    let folder = Folder::new("clocks");
    let text = "2009-03-02T07:12:03Z M1 ON\n2009-03-02 07:12:04 M1 OFF\nnonsense\n2009-03-02 07:12:05 M1 ON\n";
    let log = from_text(&folder, "casas:log", text).unwrap();
    assert_eq!((log.events.len(), log.rows, log.clock), (2, 2, Clock::Local));
    assert_eq!(skipped(&log), [1, 3]);
}

#[test]
fn skips_times_that_no_clock_shows() {
    let folder = Folder::new("far");
    let text = "2009-03-02 07:12:03 M1 ON\n9999-12-31 23:59:59 M1 OFF\n-9999-01-01 00:00:00 M1 OFF\n";
    let log = from_text(&folder, "casas:log", text).unwrap();
    assert_eq!((log.events.len(), log.skipped), (1, 2));
    assert!(from_text(&folder, "casas:never", "9999-12-31T23:59:59Z M1 OFF\n").is_err());
}

#[test]
fn dirt_never_panics() {
    let folder = Folder::new("dirt");
    let mut state = 3_u64;
    let mut random = |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    let clean = "2009-03-02 07:12:03.250000\tM1\tON\n2009-03-02 07:12:04,M1,OFF\n\"a\",time,sensor,value\n".repeat(20);
    for _ in 0..300 {
        let mut bytes = clean.clone().into_bytes();
        for _ in 0..random(60) {
            let place = random(bytes.len());
            match random(3) {
                0 => bytes[place] = random(256) as u8,
                1 => bytes.truncate(place.max(1)),
                _ => bytes.insert(place, b"\t\n,\"\0\xff09-:."[random(11)]),
            }
        }
        for scheme in ["sqlite", "csv", "casas"] {
            let url = folder.url(&format!("{scheme}:dirt"));
            fs::write(url.file().unwrap(), &bytes).unwrap();
            let _ = read(&url, &LoggerFile::default());
        }
    }
    let long = [&b"x".repeat(200_000)[..], b"\n2009-03-02 07:12:03 M1 ON\n"].concat();
    let url = folder.url("casas:long");
    fs::write(url.file().unwrap(), long).unwrap();
    let log = read(&url, &LoggerFile::default()).unwrap();
    assert_eq!((log.events.len(), log.skipped, log.problems[0].line), (1, 1, 1));
}

#[test]
fn overlong_values_end_the_reading() {
    let folder = Folder::new("long");
    let head = "time,sensor,value\n2009-03-02 07:12:03,M1,ON\n";
    let row = |cell: &str| format!("{head}2009-03-02 07:12:04,M1,{cell}\n");
    for (text, said) in [
        (",".repeat(3 << 20), "log.csv:1: the line is longer than 1048576 bytes"),
        ("x".repeat(3 << 20), "log.csv:1: the line is longer than 1048576 bytes"),
        (format!("{head}{},\n", ",".repeat(MOST_CELLS)), "log.csv:3: the row has more than 1000 cells"),
    ] {
        let url = folder.url("csv:log.csv");
        fs::write(url.file().unwrap(), &text).unwrap();
        let error = read(&url, &LoggerFile::default()).unwrap_err();
        assert!(matches!(error, LogError::TooLong { .. }), "{error}");
        let error = error.to_string();
        assert!(error.contains(said) && error.contains("hint: ") && error.len() < 400, "{said}: {error}");
    }
    // A cell that is too long costs its row alone.
    for (text, said) in [
        (row(&"é".repeat(LONGEST_VALUE + 1)), "the value \"é"),
        (row("ON").replace("04,M1", &format!("04,{}", "M".repeat(LONGEST_ID + 1))), "the sensor \"MMM"),
    ] {
        let log = from_text(&folder, "csv:log.csv", &text).unwrap();
        assert_eq!((log.events.len(), log.skipped, log.problems[0].line), (1, 1, 3));
        assert!(log.problems[0].why.starts_with(said) && log.problems[0].why.len() < 200, "{:?}", log.problems);
    }
    let line = "2009-03-02 07:12:03 M1 ON\n";
    let long = format!("{line}{line}{}\n{line}", "x".repeat(LONGEST_ROW_BYTES + 1));
    let error = from_text(&folder, "casas:log.txt", &long).unwrap_err().to_string();
    assert!(error.contains("log.txt:3: the line is longer than 1048576 bytes"), "{error}");
    let whole = format!("{line}2009-03-02 07:12:04 M1 ON {}\n", "x".repeat(LONGEST_ROW_BYTES - 27));
    assert_eq!(from_text(&folder, "casas:log.txt", &whole).unwrap().events.len(), 2);
    // The control: what is as long as it may be is read.
    for text in [
        row(&"é".repeat(LONGEST_VALUE)),
        row("ON").replace("04,M1", &format!("04,{}", "M".repeat(LONGEST_ID))),
        row(&format!("ON{}", ",".repeat(MOST_CELLS - 3))),
        row(&format!("ON,{}", "x".repeat(LONGEST_ROW_BYTES - 100))),
    ] {
        let log = from_text(&folder, "csv:log.csv", &text).unwrap();
        assert_eq!((log.events.len(), log.skipped), (2, 0));
    }
}

/// One quote that nothing closes makes no row of all that follows; one that is closed later does.
#[test]
fn an_open_quote_costs_no_other_row() {
    let folder = Folder::new("quotes");
    let (head, good) = ("time,sensor,value\n", "2009-03-02 07:12:05,M1,ON\n");
    let rest = good.repeat(100_000);
    let log = from_text(&folder, "csv:log.csv", &format!("{head}2009-03-02 07:12:04,M1,\"ON\n{rest}")).unwrap();
    assert_eq!((log.events.len(), log.skipped, log.problems[0].line), (100_000, 1, 2));
    assert_eq!(log.problems[0].why, "a quote in it is never closed");
    let log = from_text(&folder, "csv:log.csv", &format!("{head}2009-03-02 07:12:04,M1,\"O\nN\"\n{good}")).unwrap();
    assert_eq!((log.values, log.skipped), (vec!["O\nN".to_owned(), "ON".into()], 0));
}

#[test]
fn reports_the_kind_of_a_file_without_text() {
    let folder = Folder::new("no-text");
    let whole = folder.url("sqlite:whole.db");
    let rows = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 9999)
                INSERT INTO firing SELECT '2009-03-02 07:12:03', 'M' || i, 'ON' FROM n";
    let database = Connection::open(whole.file().unwrap()).unwrap();
    database.execute_batch(&format!("CREATE TABLE firing (time, sensor, value); {rows}")).unwrap();
    drop(database);
    let database = fs::read(whole.file().unwrap()).unwrap();
    let utf16: Vec<u8> = "time,sensor,value\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    for (bytes, code) in [
        (&b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR,1,2\n"[..], "log-form::other-kind"),
        (&[b"\xff\xfe", &utf16[..]].concat(), "log-form::utf-16"),
        (b"PK\x03\x04\x14\0\n", "log-form::archive"),
        (&database[..database.len() / 2], "log-form::damaged-database"),
        (&database[..50], "log-form::damaged-database"),
    ] {
        let path = folder.path().join("log");
        fs::write(&path, bytes).unwrap();
        let read = LogSource::recognise(&path).and_then(|source| read(source, &LoggerFile::default()));
        let Err(LogError::NoLog(reason)) = read else { panic!("{code}: {read:?}") };
        assert_eq!(reason.why.code, code);
    }
    // A text is named by its line.
    fs::write(folder.path().join("log.txt"), "nonsense\n").unwrap();
    let why = read(&folder.url("casas:log.txt"), &LoggerFile::default()).unwrap_err().to_string();
    assert!(why.contains("line 1: there are no date"), "{why}");
}

#[test]
fn reads_only_tables_of_a_database_and_no_long_cells() {
    let folder = Folder::new("views");
    let endless = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n)
                   SELECT '2009-03-02 07:12:03' AS time, 'M1' AS sensor, 'ON' AS value FROM n";
    let large = "SELECT '2009-03-02 07:12:03' AS time, 'M1' AS sensor, hex(zeroblob(400000000)) AS value";
    for (name, view) in [("endless", endless), ("large", large)] {
        let url = folder.url(&format!("sqlite:{name}.db"));
        let database = Connection::open(url.file().unwrap()).unwrap();
        database.execute_batch(&format!("CREATE VIEW firing AS {view}; CREATE TABLE other (a, b)")).unwrap();
        let read = || read(&url, &LoggerFile::default());
        assert!(matches!(read(), Err(LogError::NoLog { .. })), "{name}");
        let log = "CREATE TABLE log (time, sensor, value); INSERT INTO log VALUES ('2009-03-02 07:12:03', 'M1', 'ON')";
        database.execute_batch(log).unwrap();
        assert_eq!(told(&read().unwrap()), [(1_235_977_923_000_000, "M1", "ON")], "{name}");
        database.execute_batch(&format!("UPDATE log SET value = hex(zeroblob({LONGEST_VALUE}))")).unwrap();
        assert!(matches!(read(), Err(LogError::NoLog { .. })), "{name}");
        database.execute_batch(&format!("UPDATE log SET value = hex(zeroblob({LONGEST_ROW_BYTES}))")).unwrap();
        assert!(matches!(read(), Err(LogError::TooLong { .. })), "{name}");
    }
}

#[test]
fn reading_leaves_a_database_unchanged() {
    let folder = Folder::new("left");
    let url = folder.url("sqlite:log.db");
    stage::ten_rows(&url, &LoggerFile::default());
    let before = (fs::read(url.file().unwrap()).unwrap(), folder.files());
    assert_eq!(read(&url, &LoggerFile::default()).unwrap().events.len(), 10);
    assert_eq!((fs::read(url.file().unwrap()).unwrap(), folder.files()), before);
}
