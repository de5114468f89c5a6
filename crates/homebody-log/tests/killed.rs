//! A killed run leaves a beginning of its rows without gaps and without doubles.

use crate::stage::{self, Folder};
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::Span;
use rusqlite::Connection;
use std::path::Path;
use std::time::Duration;

/// The place for the child; the parent sets it.
const CHILD: &str = "HOMEBODY_TEST_KILLED";
const KILLS: u64 = 20;

/// The child: stores rows until it is killed. Run as a test of its own it has nothing to do.
#[test]
fn child() {
    let Ok(path) = std::env::var(CHILD) else { return };
    let urls = ["sqlite", "csv"].map(|scheme| format!("{scheme}:{path}.{scheme}").parse().unwrap());
    let mut logger = stage::open(&urls, &LoggerFile::default(), false).unwrap();
    let firings = stage::firings(5_000_000);
    for (index, step) in firings.chunks(50).enumerate() {
        logger.store(step, step[step.len() - 1].at + Span::MICROSECOND).unwrap();
        if index % 1000 == 999 {
            logger.make_durable().unwrap();
        }
    }
    logger.finish().unwrap();
}

#[test]
fn a_killed_run_loses_and_doubles_no_stored_row() {
    let folder = Folder::new("killed");
    let firings = stage::firings(1_000);
    let mut longest = 0;
    for kill in 0..KILLS {
        let base = folder.path().join(format!("log-{kill}"));
        let mut child = stage::child("killed::child", CHILD, &base);
        let database = base.with_extension("sqlite");
        stage::wait_for(|| database.exists());
        std::thread::sleep(Duration::from_millis(kill * 7919 % 1_000));
        child.kill().unwrap();
        assert!(!child.wait().unwrap().success(), "killed before its end");
        longest = longest.max(check(&database, &firings));
        assert!(!base.with_extension("csv").exists(), "a text file has its name only when it is whole");
    }
    assert!(longest > 0, "some were killed with rows stored");
}

/// Looks at what a killed run has left; the rows.
fn check(path: &Path, firings: &[homebody_core::event::Firing]) -> i64 {
    let connection = Connection::open(path).unwrap();
    let whole: String = connection.query_row("PRAGMA integrity_check", [], |row| row.get(0)).unwrap();
    assert_eq!(whole, "ok");
    let tables: i64 = connection.query_row("SELECT count(*) FROM sqlite_schema", [], |row| row.get(0)).unwrap();
    if tables == 0 {
        return 0; // killed before it had begun
    }
    let ended: i64 = connection.query_row("SELECT count(ended_at) FROM run", [], |row| row.get(0)).unwrap();
    assert_eq!(ended, 0, "a killed run is not marked as complete");
    let sql = "SELECT count(*), count(DISTINCT seq), coalesce(max(seq) + 1, 0) FROM firing";
    let counts = connection.query_row(sql, [], |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?)));
    let (rows, distinct, last): (i64, i64, i64) = counts.unwrap();
    assert!(rows == distinct && rows == last, "{rows} rows, {distinct} of them distinct, the last is {last}");
    let names = stage::sensors();
    let mut statement = connection.prepare("SELECT sensor FROM firing ORDER BY seq LIMIT 1000").unwrap();
    let sensors = statement.query_map([], |row| row.get::<_, String>(0)).unwrap().map(Result::unwrap);
    for (sensor, firing) in sensors.zip(firings) {
        assert_eq!(sensor, names[firing.sensor.index()]);
    }
    rows
}
