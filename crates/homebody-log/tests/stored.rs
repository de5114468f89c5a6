//! The stored rows, their place and their form.

use crate::stage::{self, Folder};
use homebody_core::event::{Events, Fact, Firing, Provenance, Trigger, Value};
use homebody_core::geometry::Point;
use homebody_core::ids::{ResidentId, RoomId, SensorId};
use homebody_core::motion::MotionState;
use homebody_core::posture::Posture;
use homebody_core::scenario::logger::{LoggerFile, MessagesFile, OccupancyFile, OnOffFile, TimeFormat};
use homebody_core::time::{MINUTE, RunTime, SECOND, Span};
use homebody_log::table::truth;
use homebody_log::{LogError, RowsOfFirings, Url, WriteMode};
use rusqlite::Connection;
use std::collections::BTreeSet;

const ALL: [&str; 3] = ["sqlite:log.db", "csv:log.csv", "casas:log.txt"];

fn at(after: Span) -> RunTime {
    RunTime::START + after
}

fn fires(seq: u64, after: Span, sensor: u32) -> Firing {
    Firing { seq, at: at(after), sensor: SensorId(sensor), value: Value::Fire }
}

/// All rows of a query, as text.
fn rows(folder: &Folder, file: &str, sql: &str) -> Vec<String> {
    let connection = Connection::open(folder.path().join(file)).unwrap();
    let mut statement = connection.prepare(sql).unwrap();
    let columns = statement.column_count();
    let rows = statement.query_map([], |row| {
        let cells = (0..columns).map(|index| Ok(format!("{:?}", row.get::<_, rusqlite::types::Value>(index)?)));
        Ok(cells.collect::<rusqlite::Result<Vec<_>>>()?.join(" "))
    });
    rows.unwrap().map(Result::unwrap).collect()
}

fn schema(folder: &Folder, file: &str) -> Vec<String> {
    rows(folder, file, "SELECT name FROM sqlite_schema WHERE type = 'table' ORDER BY name")
}

#[test]
fn a_run_reaches_all_places() {
    let folder = Folder::new("all");
    let urls = ALL.map(|url| folder.url(url));
    let firings = stage::firings(20_000);
    let stored = stage::store(stage::open(&urls, &LoggerFile::default(), false).unwrap(), &firings, 7).unwrap();
    assert_eq!(stored.rows, 20_000);
    assert_eq!(stored.by_sensor.iter().sum::<u64>(), 20_000);
    assert_eq!(folder.files(), ["log.csv", "log.db", "log.txt"], "no companions, no parts");

    let first = rows(&folder, "log.db", "SELECT run_id, seq, fired_at, sensor, value FROM firing ORDER BY seq LIMIT 2");
    assert_eq!(
        first[1],
        r#"Integer(1) Integer(1) Text("2009-03-07 22:00:05.000003") Text("kitchen motion") Text("ON")"#
    );
    assert_eq!(folder.text("log.csv").lines().nth(2), Some("1,2009-03-07 22:00:05.000003,kitchen motion,ON"));
    assert_eq!(folder.text("log.txt").lines().nth(1), Some("2009-03-07 22:00:05.000003\tKitchenMotion\tON"));

    let counted = rows(&folder, "log.db", "SELECT count(*), min(seq), max(seq) FROM firing");
    assert_eq!(counted, ["Integer(20000) Integer(0) Integer(19999)"]);
    assert_eq!(folder.text("log.csv").lines().count(), 20_001);
    assert_eq!(folder.text("log.txt").lines().count(), 20_000);
    let run = rows(&folder, "log.db", "SELECT scenario, seed, started_at, ended_at IS NOT NULL FROM run");
    assert_eq!(
        run,
        [r#"Text("a quiet night") Text("18446744073709551615") Text("2009-03-07 22:00:00.000000") Integer(1)"#]
    );
}

#[test]
fn the_steps_of_a_run_change_no_byte() {
    let firings = stage::firings(60_000);
    let file = LoggerFile { messages: MessagesFile::OnOff(OnOffFile::exactly(4.0)), ..Default::default() };
    let mut all = Vec::new();
    for step in [1, 13, 5_000, 100_000] {
        let folder = Folder::new(&format!("advance-{step}"));
        let urls = ALL.map(|url| folder.url(url));
        stage::store(stage::open(&urls, &file, false).unwrap(), &firings, step).unwrap();
        all.push(["log.db", "log.csv", "log.txt"].map(|name| std::fs::read(folder.path().join(name)).unwrap()));
    }
    assert!(all.iter().all(|logs| logs == &all[0]));
}

#[test]
fn a_mapping_names_everything() {
    let folder = Folder::new("mapping");
    let mut file = LoggerFile {
        table: Some("order".into()),
        time: TimeFormat::EpochMs,
        messages: MessagesFile::Occupancy(OccupancyFile { timeout_s: 90.0 }),
        ..Default::default()
    };
    file.columns.time = "select".into();
    file.columns.sensor = "code".into();
    file.ids.insert("fridge".into(), "A3".into());
    let urls = [folder.url("sqlite:log.db"), folder.url("csv:log.csv")];
    let mut logger = stage::open(&urls, &file, false).unwrap();
    logger.store(&[fires(0, SECOND, 2)], at(100 * SECOND)).unwrap();
    logger.finish().unwrap();
    let stored = rows(&folder, "log.db", r#"SELECT seq, "select", typeof("select"), code, value FROM "order""#);
    assert_eq!(
        stored,
        [
            r#"Integer(0) Integer(1236484801000) Text("integer") Text("A3") Text("true")"#,
            r#"Integer(1) Integer(1236484891000) Text("integer") Text("A3") Text("false")"#,
        ]
    );
    assert_eq!(folder.text("log.csv"), "seq,select,code,value\n0,1236484801000,A3,true\n1,1236484891000,A3,false\n");
}

#[test]
fn instants_can_be_numbers() {
    let folder = Folder::new("epoch");
    let file = LoggerFile { time: TimeFormat::EpochS, ..Default::default() };
    let mut logger = stage::open(&[folder.url("sqlite:log.db")], &file, false).unwrap();
    logger.store(&[fires(0, SECOND / 4, 0)], at(SECOND)).unwrap();
    logger.finish().unwrap();
    let stored = rows(&folder, "log.db", "SELECT fired_at, (SELECT started_at FROM run) FROM firing");
    assert_eq!(stored, ["Real(1236484800.25) Real(1236484800.0)"]);
}

#[test]
fn a_message_held_at_the_end_stays_on() {
    let folder = Folder::new("held");
    let file = LoggerFile { messages: MessagesFile::OnOff(OnOffFile::exactly(4.0)), ..Default::default() };
    let mut logger = stage::open(&[folder.url("casas:log.txt")], &file, false).unwrap();
    logger.store(&[fires(0, Span::ZERO, 0)], at(2 * SECOND)).unwrap();
    logger.store(&[fires(1, 2 * SECOND, 2)], at(5 * SECOND)).unwrap();
    let stored = logger.finish().unwrap();
    assert_eq!(stored.by_sensor, [2, 0, 1]);
    let values: Vec<String> =
        folder.text("log.txt").lines().map(|line| line.split_once('\t').unwrap().1.to_string()).collect();
    assert_eq!(values, ["BedroomMotion\tON", "fridge\tON", "BedroomMotion\tOFF"]);
}

#[test]
fn a_run_in_real_time_continues_while_it_is_watched() {
    let folder = Folder::new("watched");
    let mut logger = stage::open(&[folder.url("sqlite:log.db")], &LoggerFile::default(), false).unwrap();
    let watcher = Connection::open(folder.path().join("log.db")).unwrap();
    let count = || watcher.query_row("SELECT count(*) FROM firing", [], |row| row.get::<_, i64>(0)).unwrap();
    assert_eq!(count(), 0);
    logger.store(&stage::firings(3), at(SECOND * 100)).unwrap();
    let began = std::time::Instant::now();
    while count() < 3 {
        assert!(began.elapsed().as_secs() < 60, "rows reach a watcher within a second or so");
        std::thread::sleep(std::time::Duration::from_millis(50));
        logger.store(&[], at(SECOND * 100)).unwrap();
    }
    watcher.execute_batch("BEGIN; SELECT count(*) FROM firing").unwrap();
    logger.store(&[fires(3, SECOND * 100, 0)], at(SECOND * 101)).unwrap();
    logger.finish().unwrap();
    assert_eq!(count(), 3, "a watcher's transaction stands still");
    watcher.execute_batch("COMMIT").unwrap();
    assert_eq!(count(), 4);
}

#[test]
fn a_reader_does_not_block_a_resumed_run() {
    let folder = Folder::new("reader-of-a-beginning");
    let urls = [folder.url("sqlite:log.db")];
    let firings = stage::firings(50);
    let mut logger = stage::open(&urls, &LoggerFile::default(), false).unwrap();
    let watcher = Connection::open(folder.path().join("log.db")).unwrap();
    let count = || watcher.query_row("SELECT count(*) FROM firing", [], |row| row.get::<_, i64>(0)).unwrap();
    logger.store(&firings[..20], firings[20].at).unwrap();
    logger.make_durable().unwrap();
    logger.wait_durable().unwrap();
    assert_eq!(count(), 20);
    // It stops before its end, while the watcher reads.
    watcher.execute_batch("BEGIN; SELECT count(*) FROM firing").unwrap();
    drop(logger);
    let logger = stage::open_of(&urls, &LoggerFile::default(), &stage::sensors(), WriteMode::Resume).unwrap();
    stage::store(logger, &firings, 7).unwrap();
    watcher.execute_batch("COMMIT").unwrap();
    assert_eq!(count(), 50);
}

#[test]
fn a_reader_from_before_the_first_rows_blocks_no_writer() {
    let folder = Folder::new("early-reader");
    let firings = stage::firings(50);
    let mut logger = stage::open(&[folder.url("sqlite:log.db")], &LoggerFile::default(), false).unwrap();
    let watcher = Connection::open(folder.path().join("log.db")).unwrap();
    watcher.execute_batch("BEGIN; SELECT count(*) FROM firing").unwrap();
    let begun = std::time::Instant::now();
    for firing in &firings {
        logger.store(std::slice::from_ref(firing), firing.at + Span::MICROSECOND).unwrap();
    }
    logger.finish().unwrap();
    // A run that ends waits for two seconds to leave one file.
    assert!(begun.elapsed() < std::time::Duration::from_secs(10), "{:?}", begun.elapsed());
    watcher.execute_batch("COMMIT").unwrap();
    assert_eq!(watcher.query_row("SELECT count(*) FROM firing", [], |row| row.get::<_, i64>(0)).unwrap(), 50);
}

#[test]
fn a_slow_reader_never_ends_a_fast_run() {
    for settled in [0, 60_000] {
        let folder = Folder::new(&format!("reader-{settled}"));
        let firings = stage::firings(200_000);
        let mut logger = stage::open(&[folder.url("sqlite:log.db")], &LoggerFile::default(), false).unwrap();
        let (first, rest) = firings.split_at(settled);
        if let Some(last) = first.last() {
            logger.store(first, last.at + Span::MICROSECOND).unwrap();
        }
        let watcher = Connection::open(folder.path().join("log.db")).unwrap();
        watcher.busy_timeout(std::time::Duration::from_secs(10)).unwrap();
        let count = || watcher.query_row("SELECT count(*) FROM firing", [], |row| row.get::<_, i64>(0)).unwrap();
        while settled > 0 && count() == 0 {
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
        watcher.execute_batch("BEGIN; SELECT count(*) FROM firing").unwrap();
        let reader = std::thread::spawn(move || {
            std::thread::sleep(std::time::Duration::from_secs(4));
            watcher.execute_batch("COMMIT").unwrap();
            watcher
        });
        for part in rest.chunks(5_000) {
            logger.store(part, part[part.len() - 1].at + Span::MICROSECOND).unwrap();
        }
        logger.finish().unwrap();
        let watcher = reader.join().unwrap();
        let all = watcher.query_row("SELECT count(*) FROM firing", [], |row| row.get::<_, i64>(0)).unwrap();
        assert_eq!(all, 200_000);
    }
}

fn truth(folder: &Folder, places: &[Url], events: &Events) -> Result<(), LogError> {
    let path = folder.path().join("truth.db");
    let mut log = stage::open_truth(&path, places, &LoggerFile::default())?;
    // The firing of number 5 has no cause; row 4 comes from that of number 6.
    log.store(events, &RowsOfFirings { rows: vec![3, 4], offs: vec![(2, 4)] })?;
    log.finish(at(MINUTE))
}

fn a_short_life() -> Events {
    let (bed, door) = (Point::new(1.0, 2.0), Point::new(4.0, 2.5));
    let activity = |after, name: Option<&str>| Fact::Activity {
        resident: ResidentId(0),
        at: at(after),
        name: name.map(String::from),
    };
    let moving = |begin, end, doing| Fact::Movement {
        resident: ResidentId(0),
        begin: at(begin),
        end: at(end),
        doing,
        posture: Posture::Standing,
    };
    Events {
        frames: Vec::new(),
        firings: vec![fires(5, 2 * SECOND, 0), fires(6, 3 * SECOND, 1)],
        facts: vec![
            Fact::Room { resident: ResidentId(0), at: at(Span::ZERO), room: Some(RoomId(0)) },
            activity(Span::ZERO, Some("sleep")),
            moving(Span::ZERO, SECOND, MotionState::InPlace { at: bed, amplitude_m: 0.2 }),
            Fact::Provenance {
                seq: 6,
                provenance: Provenance {
                    resident: Some(ResidentId(0)),
                    seen_at: at(2 * SECOND),
                    trigger: Trigger::Movement,
                },
            },
            Fact::Provenance {
                seq: 9,
                provenance: Provenance {
                    resident: Some(ResidentId(0)),
                    seen_at: at(2 * SECOND),
                    trigger: Trigger::Movement,
                },
            },
            activity(10 * SECOND, None),
            moving(SECOND, 5 * SECOND, MotionState::Stride { from: bed, to: door }),
            moving(5 * SECOND, MINUTE, MotionState::Away),
            Fact::Room { resident: ResidentId(0), at: at(5 * SECOND), room: None },
            activity(20 * SECOND, Some("out")),
        ],
    }
}

#[test]
fn stores_the_truth() {
    let folder = Folder::new("truth");
    truth(&folder, &[], &a_short_life()).unwrap();
    assert_eq!(
        rows(&folder, "truth.db", "SELECT name, substr(begin_at, 12, 8), substr(end_at, 12, 8) FROM activity"),
        [r#"Text("sleep") Text("22:00:00") Text("22:00:10")"#, r#"Text("out") Text("22:00:20") Text("22:01:00")"#]
    );
    assert_eq!(
        rows(&folder, "truth.db", "SELECT firing, row, resident, fired_at, sensor FROM cause"),
        [
            r#"Integer(6) Integer(4) Text("margaret") Text("2009-03-07 22:00:03.000000") Text("kitchen motion")"#,
            r#"Integer(9) Null Text("margaret") Null Null"#,
        ]
    );
    assert_eq!(
        rows(&folder, "truth.db", "SELECT kind, from_x, to_y, amplitude_m, posture FROM movement"),
        [
            r#"Text("in_place") Real(1.0) Real(2.0) Real(0.2) Text("standing")"#,
            r#"Text("stride") Real(1.0) Real(2.5) Null Text("standing")"#,
            r#"Text("away") Null Null Null Text("standing")"#,
        ]
    );
    assert_eq!(rows(&folder, "truth.db", "SELECT row, firing FROM off"), ["Integer(2) Integer(4)"]);
    let rooms = rows(&folder, "truth.db", "SELECT room FROM room");
    assert_eq!(rooms, [r#"Text("bedroom")"#, "Null"]);
}

#[test]
fn truth_and_firings_are_never_in_one_file() {
    let folder = Folder::new("apart");
    let log = folder.url("sqlite:log.db");
    let logger = stage::open(std::slice::from_ref(&log), &LoggerFile::default(), false).unwrap();
    let same = folder.url("sqlite:./truth.db");
    let error = truth(&folder, std::slice::from_ref(&same), &a_short_life()).unwrap_err();
    assert!(matches!(error, LogError::SameFile { .. }));
    truth(&folder, std::slice::from_ref(&log), &a_short_life()).unwrap();
    stage::store(logger, &stage::firings(10), 10).unwrap();
    assert_eq!(schema(&folder, "log.db"), [r#"Text("firing")"#, r#"Text("run")"#]);
    let truth = truth::tables().into_iter().map(|table| table.name).chain(["run".into()]).collect::<BTreeSet<_>>();
    let truth: Vec<_> = truth.into_iter().map(|name| format!("Text({name:?})")).collect();
    assert_eq!(schema(&folder, "truth.db"), truth);
}

#[test]
fn a_logger_without_places_counts_alone() {
    let logger = stage::open(&[], &LoggerFile::default(), false);
    assert_eq!(stage::store(logger.unwrap(), &stage::firings(10), 3).unwrap().rows, 10);
}

#[test]
fn formulas_are_escaped_and_read_back() {
    for (is_safe, cell) in [(true, "'=1+1"), (false, "=1+1")] {
        let folder = Folder::new(&format!("formula-{is_safe}"));
        let mut file = LoggerFile { spreadsheet_safe: is_safe, ..Default::default() };
        file.ids.insert("fridge".into(), "=1+1".into());
        let urls = [folder.url("csv:log.csv"), folder.url("sqlite:log.db")];
        let mut logger = stage::open(&urls, &file, false).unwrap();
        logger.store(&[fires(0, SECOND, 2)], at(100 * SECOND)).unwrap();
        logger.finish().unwrap();
        let text = std::fs::read_to_string(folder.path().join("log.csv")).unwrap();
        assert!(text.contains(&format!(",{cell},")), "{text}");
        for url in &urls {
            assert_eq!(homebody_log::read(url, &file).unwrap().sensors, ["=1+1"]);
        }
    }
}
