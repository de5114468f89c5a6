//! After a loss of power at any moment, the database opens and holds each confirmed row once, in order.
//!
//! A program that stores a run is watched by strace: what it writes into its files, and when it makes sure of them. Then the power is lost
//! after each of these, in thought: files are made of what was sure by then and of any part of the rest, and are opened by our reader. Nothing
//! is left to how this machine's disk behaves. `HOMEBODY_KILLS` says after how many of the events; all of them without a number, as by
//! `HOMEBODY_KILLS=all`.
#![cfg(target_os = "linux")]

mod disk;
mod trace;

use crate::stage::{self, Folder};
use disk::{Luck, lose_power};
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::Span;
use homebody_log::{LogError, Url, WriteMode, read};
use rusqlite::Connection;
use std::io::Write;
use std::path::Path;
use std::process::Command;
use trace::{Event, missing, trace};

/// The place and the mode of the child; the parent sets it.
const CHILD: &str = "HOMEBODY_TEST_POWER";
const HOW: &str = "HOMEBODY_TEST_POWER_HOW";

/// Rows of each advance: some that trickle in, many at once, some more.
const ADVANCES: [usize; 12] = [1, 3, 40, 40, 200, 40, 12_000, 40, 40, 11_000, 300, 7];

fn all_rows() -> usize {
    ADVANCES.iter().sum()
}

/// The child: stores rows, and says of each advance when it is safe. Run as a test of its own it has nothing to do.
#[test]
fn child() {
    let Ok(path) = std::env::var(CHILD) else { return };
    match std::env::var(HOW).as_deref() {
        Ok("ours") => ours(&format!("sqlite:{path}").parse().unwrap()),
        Ok(synchronous) => plain(Path::new(&path), synchronous),
        Err(_) => unreachable!("the parent sets it"),
    }
}

/// One write, so that it is one event.
fn confirm(rows: usize) {
    std::io::stderr().write_all(format!("confirmed {rows}\n").as_bytes()).unwrap();
}

fn ours(url: &Url) {
    let mut logger = stage::open(std::slice::from_ref(url), &LoggerFile::default(), false).unwrap();
    let firings = stage::firings(all_rows() as u64);
    let mut rows = 0;
    for advance in ADVANCES {
        let step = &firings[rows..rows + advance];
        rows += advance;
        logger.store(step, step[advance - 1].at + Span::MICROSECOND).unwrap();
        logger.make_durable().unwrap();
        logger.wait_durable().unwrap();
        confirm(rows);
    }
    logger.finish().unwrap();
    confirm(rows);
}

/// A program that knows only one setting.
fn plain(path: &Path, synchronous: &str) {
    let connection = Connection::open(path).unwrap();
    connection.execute_batch(&format!("PRAGMA journal_mode = WAL; PRAGMA synchronous = {synchronous}")).unwrap();
    connection
        .execute_batch("CREATE TABLE firing (run_id INTEGER, seq INTEGER, fired_at TEXT, sensor TEXT, value TEXT)")
        .unwrap();
    let mut rows = 0;
    for advance in [5, 40, 40, 300] {
        let sql = "WITH RECURSIVE n (seq) AS (SELECT ?1 UNION ALL SELECT seq + 1 FROM n WHERE seq < ?2 - 1) \
                   INSERT INTO firing SELECT 1, seq, '2009-03-07 22:00:00', 'fridge', 'ON' FROM n";
        connection.execute(sql, (rows as i64, (rows + advance) as i64)).unwrap();
        rows += advance;
        confirm(rows);
    }
}

/// The requests of a child to its files.
fn traced(folder: &Folder, how: &str) -> Vec<Event> {
    let inner = folder.path().join("files");
    std::fs::create_dir(&inner).unwrap();
    let mut command = Command::new(std::env::current_exe().unwrap());
    command.args(["power::child", "--exact", "--test-threads", "1", "--nocapture"]);
    let events = trace(command.env(CHILD, inner.join("log.db")).env(HOW, how), &inner);
    assert!(events.iter().any(|event| matches!(event, Event::Confirmed(_))), "{events:?}");
    events
}

/// Rows that are lost or doubled if the power is lost after so many events; None if all promises hold.
fn wrong_after(folder: &Folder, events: &[Event], luck: Luck, heeds: bool) -> Option<String> {
    let confirmed = events.iter().rev().find_map(|event| match event {
        Event::Confirmed(rows) => Some(*rows),
        _ => None,
    });
    let confirmed = confirmed.unwrap_or(0);
    let into = folder.path().join("left");
    let _ = std::fs::remove_dir_all(&into);
    std::fs::create_dir(&into).unwrap();
    lose_power(events, luck, heeds, &folder.path().join("files"), &into);
    let url = Url::new("sqlite:x".parse::<Url>().unwrap().scheme(), into.join("log.db"));
    let log = match read(&url, &LoggerFile::default()) {
        Ok(log) => log,
        // A run that has just begun has nothing yet.
        Err(LogError::Missing { .. } | LogError::NoTables { .. }) if confirmed == 0 => return None,
        Err(LogError::NoLog { .. })
            if confirmed == 0 && std::fs::metadata(url.path()).is_ok_and(|file| file.len() == 0) =>
        {
            return None;
        }
        Err(error) => return Some(format!("{confirmed} rows were confirmed: {error}")),
    };
    let connection = Connection::open(url.path()).unwrap();
    let whole: String = connection.query_row("PRAGMA integrity_check", [], |row| row.get(0)).unwrap();
    if whole != "ok" {
        return Some(whole);
    }
    let counts = "SELECT count(*), count(DISTINCT seq), coalesce(max(seq) + 1, 0) FROM firing";
    let (rows, distinct, last): (u64, u64, u64) = connection
        .query_row(counts, [], |row| {
            Ok((row.get::<_, i64>(0)? as u64, row.get::<_, i64>(1)? as u64, row.get::<_, i64>(2)? as u64))
        })
        .unwrap();
    if rows != distinct || rows != last || log.rows != rows {
        return Some(format!("{rows} rows, {distinct} of them distinct, the last is {last}, {} are read", log.rows));
    }
    (rows < confirmed).then(|| format!("{confirmed} rows were confirmed, and {rows} are there"))
}

/// The default number of events before the loss.
const USUAL: usize = 40;

/// After which events the power is lost, and with what luck.
fn cuts(events: &[Event]) -> impl Iterator<Item = (usize, Luck)> {
    let most = match std::env::var("HOMEBODY_KILLS").as_deref() {
        Ok("all") => usize::MAX,
        Ok(number) => number.parse().unwrap_or(USUAL),
        Err(_) => USUAL,
    };
    let every = (events.len() / most.max(1)).max(1);
    let chance = |cut: usize| (0..3).map(move |round| Luck::Some((cut * 7 + round) as u64));
    let begin = move |cut: &usize| cut % every == every - 1;
    (1..=events.len())
        .filter(begin)
        .flat_map(move |cut| [Luck::None, Luck::All].into_iter().chain(chance(cut)).map(move |luck| (cut, luck)))
}

fn is_skipped() -> bool {
    let missing = missing();
    if let Some(why) = &missing {
        assert_ne!(std::env::var("HOMEBODY_STRACE").as_deref(), Ok("required"), "{why}");
        println!("skipped: {why}");
    }
    missing.is_some()
}

#[test]
fn confirmed_rows_survive_a_loss_of_power_once() {
    if is_skipped() {
        return;
    }
    let folder = Folder::new("power");
    let events = traced(&folder, "ours");
    let mut tried = 0;
    for (cut, luck) in cuts(&events) {
        let wrong = wrong_after(&folder, &events[..cut], luck, true);
        assert_eq!(wrong, None, "after {cut} of {} events, {luck:?}: {:?}", events.len(), kind(&events[cut - 1]));
        tried += 1;
    }
    // The rest is resumed, to the same rows as without the loss.
    let firings = stage::firings(all_rows() as u64);
    for cut in [events.len() / 3, events.len() / 2, events.len() - 9] {
        assert_eq!(wrong_after(&folder, &events[..cut], Luck::Some(cut as u64), true), None);
        let url = format!("sqlite:{}", folder.path().join("left/log.db").display()).parse::<Url>().unwrap();
        let logger =
            stage::open_of(std::slice::from_ref(&url), &LoggerFile::default(), &stage::sensors(), WriteMode::Resume)
                .unwrap();
        stage::store(logger, &firings, 500).unwrap();
        assert_eq!(read(&url, &LoggerFile::default()).unwrap().rows, all_rows() as u64);
    }
    println!("{} events, {tried} losses of power, {} rows: none lost, none doubled", events.len(), all_rows());

    // The control: a disk that ignores requests for durability, like one without such requests.
    let lost =
        cuts(&events).filter(|(cut, luck)| wrong_after(&folder, &events[..*cut], *luck, false).is_some()).count();
    println!("of a disk that heeds nothing, {lost} of {tried} are found wrong");
    assert!(lost > tried / 10);
}

#[test]
fn a_database_that_does_not_wait_for_its_disk_is_caught() {
    if is_skipped() {
        return;
    }
    let mut found = Vec::new();
    for how in ["FULL", "OFF"] {
        let folder = Folder::new(&format!("power-{how}"));
        let events = traced(&folder, how);
        let all =
            (1..=events.len()).flat_map(|cut| [Luck::None, Luck::All, Luck::Some(cut as u64)].map(|luck| (cut, luck)));
        let wrong = all.filter(|(cut, luck)| wrong_after(&folder, &events[..*cut], *luck, true).is_some()).count();
        println!("synchronous = {how}: of {} losses of power, {wrong} lose rows that were confirmed", 3 * events.len());
        found.push(wrong);
    }
    assert!(found[0] == 0 && found[1] > 0, "{found:?}");
}

fn kind(event: &Event) -> String {
    match event {
        Event::Write { file, at, bytes } => format!("{} bytes at {at} of {}", bytes.len(), file.display()),
        other => format!("{other:?}"),
    }
}
