//! A broker that is stopped while a thousand rows come a second: they are put aside, and all are heard once it is back.
//!
//! `HOMEBODY_OUTAGE_S` says for how many seconds; the figures in `docs/mqtt.md` are those of 60.

#[path = "servers/broker.rs"]
#[allow(dead_code, reason = "this test uses a part of it")]
mod broker;

use broker::{Broker, Listener, REMEMBERS, SOON, firings, run, wait_for};
use homebody_core::scenario::logger::LoggerFile;
use homebody_log::{Destination, How, Logger, WhenDown};
use homebody_mqtt::{MqttSink, policy};
use std::collections::BTreeSet;
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

/// Longer than a broker is waited for before rows are put aside.
const USUAL_S: u64 = 7;
const A_SECOND: u64 = 1000;
/// Rows come for so long before the broker is stopped, and after it is back.
const BESIDE_S: u64 = 2;
const MOST_MIB: u64 = 256;

/// The most memory that this program has had, in MiB; what is heard is a part of it.
fn most_mib() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap();
    line.trim().trim_end_matches(" kB").parse::<u64>().unwrap() / 1024
}

#[test]
fn a_broker_that_is_stopped_while_a_thousand_rows_come_a_second_is_told_all() {
    let Some(mut broker) = Broker::with(REMEMBERS) else { return };
    let seconds = std::env::var("HOMEBODY_OUTAGE_S").ok().and_then(|seconds| seconds.parse().ok()).unwrap_or(USUAL_S);
    let listener = Listener::lasting(&broker, "homebody/#");
    let spools = tempfile::tempdir().unwrap();
    let to = Destination::own("mqtt", MqttSink::live(&broker.url("homebody")), policy());
    let to = to.when_down(&WhenDown::Spool(spools.path().into(), 64 << 20));
    let mut logger = Logger::open(vec![to], &LoggerFile::default(), &Arc::new(run()), How::New).unwrap();
    let rows = (seconds + 2 * BESIDE_S) * A_SECOND;
    let (all, begun) = (firings(rows), Instant::now());
    let (mut is_stopped, mut is_back, mut most_aside) = (false, false, 0);
    for (number, step) in all.chunks(10).enumerate() {
        let lived = Duration::from_millis(10 * number as u64);
        thread::sleep(lived.saturating_sub(begun.elapsed()));
        if lived.as_secs() >= BESIDE_S && !is_stopped {
            broker.stop();
            is_stopped = true;
        }
        if lived.as_secs() >= BESIDE_S + seconds && !is_back {
            broker.begin();
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
    assert!(begun.elapsed() < Duration::from_secs(seconds + 2 * BESIDE_S) + SOON);
    wait_for("the last row", || (listener.rows() == rows).then_some(()));
    let heard: Vec<u64> = listener.heard().iter().filter_map(|heard| Some(heard.row()?.1)).collect();
    let known: BTreeSet<u64> = heard.iter().copied().collect();
    println!(
        "stopped for {seconds} s: {rows} rows, {} missing, {} heard again; {} kB put aside, {} MiB at most",
        rows as usize - known.len(),
        heard.len() - known.len(),
        most_aside / 1000,
        most_mib()
    );
    assert!(most_aside > 0, "rows were put aside");
    assert!(known.into_iter().eq(0..rows), "none is lost");
    // What was on its way as the broker stopped may come twice, with its number; nothing else does.
    assert!(heard.len() as u64 - rows <= 1000, "{} are heard again", heard.len() as u64 - rows);
    assert!(most_mib() <= MOST_MIB, "{} MiB", most_mib());
}
