//! A server that is stopped while a thousand rows come a second: they are put aside on disk, and then it has each once.
//!
//! `HOMEBODY_OUTAGE_S` says for how many seconds; the figures in `docs/postgresql.md` are those of 60.

mod stage;

use homebody_core::scenario::logger::LoggerFile;
use homebody_log::{How, Logger, Policy, WhenDown};
use stage::Server;
use stage::life::{destination, firings, run};
use std::sync::Arc;
use std::time::{Duration, Instant};

const USUAL_S: u64 = 3;
const A_SECOND: u64 = 1000;
/// Rows come for so long before the server is stopped, and after it is back.
const BESIDE_S: u64 = 2;
const MOST_MIB: u64 = 256;

/// The most memory that this program has had, in MiB.
fn most_mib() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap();
    line.trim().trim_end_matches(" kB").parse::<u64>().unwrap() / 1024
}

#[test]
fn who_is_stopped_while_a_thousand_rows_come_a_second_has_each_once() {
    let Some(mut server) = Server::start() else { return };
    let seconds = std::env::var("HOMEBODY_OUTAGE_S").ok().and_then(|seconds| seconds.parse().ok()).unwrap_or(USUAL_S);
    let (url, spools) = (server.url("postgres", &server.database("outage"), ""), tempfile::tempdir().unwrap());
    let to = destination(&url, &Policy::default()).when_down(&WhenDown::Spool(spools.path().into(), 64 << 20));
    let mut logger = Logger::open(vec![to], &LoggerFile::default(), &Arc::new(run(1)), How::New).unwrap();
    let rows = (seconds + 2 * BESIDE_S) * A_SECOND;
    let (all, begun) = (firings(rows), Instant::now());
    let (mut is_stopped, mut is_back, mut most_aside) = (false, false, 0);
    for (number, step) in all.chunks(10).enumerate() {
        let lived = Duration::from_millis(10 * number as u64);
        std::thread::sleep(lived.saturating_sub(begun.elapsed()));
        if lived.as_secs() >= BESIDE_S && !is_stopped {
            server.stop();
            is_stopped = true;
        }
        if lived.as_secs() >= BESIDE_S + seconds && !is_back {
            server.restart();
            is_back = true;
        }
        logger.store(step, step[step.len() - 1].at + 1).unwrap();
        if number % 100 == 99 {
            // As a run does that goes at a pace.
            logger.settle().unwrap();
        }
        let files = std::fs::read_dir(spools.path()).unwrap().map(|file| file.unwrap().metadata().unwrap().len());
        most_aside = most_aside.max(files.sum::<u64>());
    }
    assert!(is_back, "it was stopped, and is back");
    logger.finish().unwrap();
    let found = server.psql("outage", "SELECT count(*), count(DISTINCT seq), max(seq) FROM firing");
    println!(
        "stopped for {seconds} s: {rows} rows, {found} found, counted and the highest; {} kB put aside, {} MiB at most",
        most_aside / 1000,
        most_mib()
    );
    assert_eq!(found, format!("{rows}|{rows}|{}", rows - 1), "none is lost, none is there twice");
    assert!(most_aside > 0, "rows were put aside");
    assert_eq!(std::fs::read_dir(spools.path()).unwrap().count(), 0, "no spool is left");
    assert!(most_mib() <= MOST_MIB, "{} MiB", most_mib());
}
