//! The rate of rows into a database, compared with the barest loop that fills a table, and the rate of reading logs, compared with reading
//! their lines.

use crate::stage::{self, Folder};
use homebody_core::event::{Events, Fact, Firing, Provenance, Trigger};
use homebody_core::ids::ResidentId;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::Span;
use homebody_log::{RowsOfFirings, survey};
use rusqlite::{Connection, params};
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::time::{Duration, Instant};

const ROWS: u64 = 1_000_000;
const ROUNDS: usize = 5;

/// The least rate of rows, in parts of that of lines (our choice): understanding a row takes no longer than reading its line.
const LEAST_READ: f64 = 0.5;

#[test]
#[ignore = "a measurement: cargo test --release -p homebody-log --test all rate:: -- --ignored --nocapture"]
fn a_database_is_filled_as_fast_as_by_a_bare_loop() {
    let folder = Folder::new("rate");
    let firings = stage::firings(ROWS);
    let rows = rows(&folder, &firings);
    let mut ratios: Vec<f64> = (0..ROUNDS)
        .map(|_| {
            let bare = bare_loop(&folder, &rows).as_secs_f64();
            let urls = [folder.url("sqlite:log.db")];
            let began = Instant::now();
            let logger = stage::open(&urls, &LoggerFile::default(), true).unwrap();
            stage::store(logger, &firings, 500).unwrap();
            let ours = began.elapsed().as_secs_f64();
            let rate = |seconds: f64| ROWS as f64 / seconds;
            println!("bare loop {:.0} rows/s, logger {:.0} rows/s: {:.2}", rate(bare), rate(ours), bare / ours);
            bare / ours
        })
        .collect();
    ratios.sort_by(f64::total_cmp);
    assert!(ratios[ROUNDS / 2] >= 0.95, "{ratios:?}");
}

#[test]
#[ignore = "a measurement: cargo test --release -p homebody-log --test all rate:: -- --ignored --nocapture"]
fn text_files_are_written() {
    let folder = Folder::new("rate-text");
    let firings = stage::firings(ROWS);
    for url in ["csv:log.csv", "casas:log.txt"] {
        let logger = stage::open(&[folder.url(url)], &LoggerFile::default(), true).unwrap();
        let began = Instant::now();
        stage::store(logger, &firings, 500).unwrap();
        println!("{url} {:.0} rows/s", ROWS as f64 / began.elapsed().as_secs_f64());
    }
}

#[test]
#[ignore = "a measurement: cargo test --release -p homebody-log --test all rate:: -- --ignored --nocapture"]
fn causes_are_written() {
    let folder = Folder::new("rate-truth");
    let firings = stage::firings(ROWS);
    let mut log = stage::open_truth(&folder.path().join("truth.db"), &[], &LoggerFile::default()).unwrap();
    let began = Instant::now();
    for step in firings.chunks(500) {
        let provenance = |firing: &Firing| Fact::Provenance {
            seq: firing.seq,
            provenance: Provenance {
                resident: Some(ResidentId(0)),
                seen_at: firing.at - Span::MICROSECOND,
                trigger: Trigger::Movement,
            },
        };
        let joined = RowsOfFirings { rows: step.iter().map(|firing| firing.seq).collect(), offs: Vec::new() };
        log.store(
            &Events { firings: step.to_vec(), facts: step.iter().map(provenance).collect(), ..Events::default() },
            &joined,
        )
        .unwrap();
    }
    log.finish(firings[firings.len() - 1].at).unwrap();
    println!("causes {:.0} rows/s", ROWS as f64 / began.elapsed().as_secs_f64());
}

#[test]
#[ignore = "a measurement: cargo test --release -p homebody-log --test all rate:: -- --ignored --nocapture"]
fn logs_are_read_not_much_slower_than_their_lines() {
    let folder = Folder::new("rate-read");
    let firings = stage::firings(ROWS);
    let mut slowest = f64::INFINITY;
    for url in ["casas:log.txt", "csv:log.csv"] {
        let url = folder.url(url);
        let logger = stage::open(std::slice::from_ref(&url), &LoggerFile::default(), true).unwrap();
        stage::store(logger, &firings, 500).unwrap();
        let mut ratios: Vec<f64> = (0..ROUNDS)
            .map(|_| {
                let began = Instant::now();
                let file = BufReader::with_capacity(1 << 16, File::open(url.file().unwrap()).unwrap());
                assert!(file.lines().map(|line| line.unwrap().len()).sum::<usize>() > 0);
                let lines = began.elapsed().as_secs_f64();
                let began = Instant::now();
                assert_eq!(survey(&url, &LoggerFile::default()).unwrap().rows, ROWS);
                let ours = began.elapsed().as_secs_f64();
                let rate = |seconds: f64| ROWS as f64 / seconds;
                println!("{url}: lines {:.0}/s, rows {:.0}/s: {:.2}", rate(lines), rate(ours), lines / ours);
                lines / ours
            })
            .collect();
        ratios.sort_by(f64::total_cmp);
        slowest = slowest.min(ratios[ROUNDS / 2]);
    }
    assert!(slowest >= LEAST_READ, "{slowest}");
}

/// The rows as text, made beforehand: the bare loop's time is the database's alone.
fn rows(folder: &Folder, firings: &[Firing]) -> Vec<(String, String)> {
    let logger = stage::open(&[folder.url("csv:rows.csv")], &LoggerFile::default(), true).unwrap();
    stage::store(logger, firings, 500).unwrap();
    let text = folder.text("rows.csv");
    let rows = text.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>());
    rows.map(|fields| (fields[1].to_string(), fields[2].to_string())).collect()
}

/// One prepared statement, one transaction, the defaults of the database: a row at a time.
fn bare_loop(folder: &Folder, rows: &[(String, String)]) -> Duration {
    let path = folder.path().join("bare.db");
    let _ = std::fs::remove_file(&path);
    let began = Instant::now();
    let mut connection = Connection::open(&path).unwrap();
    connection
        .execute_batch(
            "CREATE TABLE firing (run_id INTEGER, seq INTEGER, fired_at TEXT, sensor TEXT, value TEXT, \
             PRIMARY KEY (run_id, seq)) WITHOUT ROWID",
        )
        .unwrap();
    let transaction = connection.transaction().unwrap();
    {
        let mut insert = transaction.prepare("INSERT INTO firing VALUES (?, ?, ?, ?, ?)").unwrap();
        for (seq, (time, sensor)) in rows.iter().enumerate() {
            insert.execute(params![1, seq as i64, time, sensor, "ON"]).unwrap();
        }
    }
    transaction.commit().unwrap();
    connection.close().unwrap();
    began.elapsed()
}
