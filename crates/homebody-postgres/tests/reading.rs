//! Tables are read back as they were written, and so are tables of other programs. Speed and partition of the rows change nothing.

use crate::stage::life::Life;
use crate::stage::{self, Server};
use homebody_core::scenario::logger::{LoggerFile, TimeFormat};
use homebody_core::time::WallTime;
use homebody_log::LogSource;
use homebody_log::log::Clock;
use homebody_log::{Log, LogError, Policy, Url, read, stream};
use homebody_postgres::POSTGRESQL;

fn log(url: &str, file: &LoggerFile) -> Result<Log, LogError> {
    homebody_log::registry::install(homebody_log::registry::Registry::new(vec![POSTGRESQL]));
    read(&url.parse::<Url>().unwrap(), file)
}

fn texts(log: &Log) -> Vec<(WallTime, &str, &str)> {
    log.events.iter().map(|event| (event.at, log.sensor(event), log.value(event))).collect()
}

#[test]
fn reads_the_same_log_as_from_sqlite() {
    let Some(server) = Server::shared() else { return };
    let database = server.database("readers");
    let folder = tempfile::tempdir().unwrap();
    for (number, time) in [TimeFormat::Utc, TimeFormat::EpochS, TimeFormat::EpochMs].into_iter().enumerate() {
        let mut file = LoggerFile { table: Some("said".into()), time, ..Default::default() };
        (file.columns.time, file.columns.sensor) = ("told_at".into(), "who".into());
        let url = server.url("postgres", &database, &format!("&schema=home{number}"));
        Life::new(5, 30_000).live_as(&url, None, Policy::default(), &file).unwrap();
        let beside: Url = format!("sqlite:{}/{number}.db", folder.path().display()).parse().unwrap();
        let run = std::sync::Arc::new(stage::life::run(5));
        let places = homebody_log::run_log::destinations(std::slice::from_ref(&beside), Default::default()).unwrap();
        let mut logger = homebody_log::Logger::open(places, &file, &run, Default::default()).unwrap();
        let firings = stage::life::firings(30_000);
        logger.store(&firings, firings[29_999].at).unwrap();
        logger.finish().unwrap();
        let (here, there) = (log(&url, &file).unwrap(), read(&beside, &file).unwrap());
        assert_eq!((here.rows, here.skipped, here.clock), (30_000, 0, Clock::Utc));
        assert_eq!(texts(&here), texts(&there), "{time:?}");
        let named: LogSource = url.parse().unwrap();
        let mut parts = 0;
        let streamed = stream(&named, &file, &mut |part| {
            parts += 1;
            assert!(part.events.len() <= 8192);
            Ok(())
        });
        assert!(streamed.unwrap().rows == 30_000 && parts > 3);
    }
}

#[test]
fn reads_the_named_one_of_several_runs() {
    let Some((_, _, url)) = Server::with_database("several") else { return };
    for (run, firings) in [(3, 10), (-4, 20), (12, 30)] {
        Life::new(run, firings).live(&url, None, Policy::default()).unwrap();
    }
    let file = LoggerFile::default();
    let error = log(&url, &file).unwrap_err().to_string();
    assert!(error.contains("has several runs: -4, 3, 12") && error.contains("?run=-4"), "{error}");
    assert_eq!(log(&format!("{url}&run=12"), &file).unwrap().rows, 30);
    assert_eq!(log(&format!("{url}&run=-4"), &file).unwrap().rows, 20);
    for run in ["7", "x", "3%20OR%20true"] {
        let error = log(&format!("{url}&run={run}"), &file).unwrap_err().to_string();
        assert!(error.contains("has no run") && error.contains("name one of its runs: -4, 3, 12"), "{error}");
    }
}

#[test]
fn names_a_missing_run_for_any_table() {
    let Some((server, database, url)) = Server::with_database("absent") else { return };
    let said = LoggerFile { table: Some("said".into()), ..Default::default() };
    for run in [3, 7] {
        Life::new(run, 10).live_as(&url, None, Policy::default(), &said).unwrap();
    }
    let usual = LoggerFile::default();
    let error = log(&format!("{url}&run=12"), &usual).unwrap_err().to_string();
    assert!(error.contains("there is no run 12") && error.contains("name one of the runs: 3, 7"), "{error}");
    assert_eq!(log(&format!("{url}&run=7"), &usual).unwrap().rows, 10);
    // The control: without a table of runs, the table of rows is missing.
    server.psql(&database, "DROP TABLE homebody_run");
    let error = log(&format!("{url}&run=12"), &usual).unwrap_err().to_string();
    assert!(error.contains("there is no table \"firing\""), "{error}");
}

#[test]
fn a_run_tells_the_zone_of_its_home() {
    let Some((server, database, url)) = Server::with_database("zones") else { return };
    for run in [1, 2] {
        Life::new(run, 10).live(&url, None, Policy::default()).unwrap();
    }
    server.psql(&database, "UPDATE homebody_run SET zone = 'UTC' WHERE run_id = 2");
    let zone = |run| {
        let log = log(&format!("{url}&run={run}"), &LoggerFile::default()).unwrap();
        assert_eq!(log.clock, Clock::Utc);
        log.zone.and_then(|zone| zone.iana_name().map(str::to_owned))
    };
    assert_eq!(zone(1).as_deref(), Some("America/Chicago"));
    assert_eq!(zone(2), None, "UTC is also said where the zone is not known");
    server.psql(&database, "DELETE FROM homebody_run WHERE run_id = 1");
    assert_eq!(zone(1), None, "the control");
}

#[test]
fn reads_foreign_tables_and_reports_missing_columns() {
    let Some((server, database, url)) = Server::with_database("others") else { return };
    server.psql(
        &database,
        "CREATE TABLE event (run text, time timestamp, device varchar(9), message numeric);
         INSERT INTO event VALUES ('b', '2009-03-02 07:12:03.25', 'hall', 21.5), ('b', '2009-03-02 07:12:01', 'bath', 1),
           ('b', NULL, 'bath', 1), ('b', '2009-03-02 07:13', NULL, 2), ('a', '2001-01-01', 'x', 0)",
    );
    let mut file = LoggerFile { table: Some("event".into()), ..Default::default() };
    let error = log(&url, &file).unwrap_err().to_string();
    for told in [
        "has no column \"fired_at\", no column \"sensor\", no column \"value\"",
        "the table has run, time, device, message",
        "--mapping",
    ] {
        assert!(error.contains(told), "{error}");
    }
    (file.columns.run, file.columns.time) = ("run".into(), "time".into());
    (file.columns.sensor, file.columns.value) = ("device".into(), "message".into());
    let read = log(&format!("{url}&run=b"), &file).unwrap();
    assert_eq!((read.rows, read.skipped, read.clock), (2, 2, Clock::Local));
    assert_eq!(texts(&read).iter().map(|row| (row.1, row.2)).collect::<Vec<_>>(), [("bath", "1"), ("hall", "21.5")]);
    let error = log(&url, &LoggerFile { table: Some("evnt".into()), ..Default::default() }).unwrap_err().to_string();
    assert!(
        error.contains("no table \"evnt\" in the schema \"public\"") && error.contains("did you mean \"event\""),
        "{error}"
    );
    let error = log(&format!("{url}&schema=nowhere"), &file).unwrap_err().to_string();
    assert!(error.contains("the schema has no tables"), "{error}");
}

#[test]
fn the_partition_of_rows_changes_nothing() {
    let Some((server, database, url)) = Server::with_database("parted") else { return };
    let mut dumps = Vec::new();
    for (run, (step, settles)) in [(1, 1), (7, 3), (50, 10), (4000, 1), (4000, usize::MAX)].into_iter().enumerate() {
        let run = run as i64 + 1;
        Life { step, settles, ..Life::new(run, 8_000) }.live(&url, Some(&url), Policy::default()).unwrap();
        dumps.push(server.dumps(&database, run));
    }
    assert!(dumps.iter().all(|dump| *dump == dumps[0]), "{dumps:?}");
    server.psql(&database, "UPDATE firing SET sensor = sensor || '.' WHERE run_id = 1 AND seq = 4711");
    assert_ne!(server.dump(&database, "public", 1), dumps[0][0], "the dump tells of one letter");
}
