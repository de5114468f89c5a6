//! A fleet that runs for long takes no more memory and no more handles over time.
//!
//! `HOMEBODY_SOAK_S` says for how many seconds it goes, at a thousand times the pace of life, and `HOMEBODY_SOAK_HOMES` how many homes.
#![cfg(target_os = "linux")]

use crate::folder::{Folder, Running};
use std::fs;
use std::thread;
use std::time::{Duration, Instant};

/// In 7 s almost two hours are simulated.
const USUAL_S: u64 = 7;
const USUAL_HOMES: u64 = 12;

/// Largest growth of memory in MiB: allocators do not return memory at once.
const GROWS_MIB: f64 = 2.0;
/// Further growth a minute, as `docs/explanation/robustness.md` says.
const GROWS_MIB_A_MINUTE: f64 = 1.0;

/// The memory and the handles of a program at an instant.
#[derive(Clone, Copy, Debug)]
struct Has {
    at_s: f64,
    mib: f64,
    handles: usize,
}

fn asked(name: &str, usual: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(usual)
}

/// The memory and the handles of a program over this time.
fn watched(running: &mut Running, lasts: Duration) -> Vec<Has> {
    let begun = Instant::now();
    let of = format!("/proc/{}", running.id());
    let mut seen = Vec::new();
    while begun.elapsed() < lasts && running.is_alive() {
        let status = fs::read_to_string(format!("{of}/status")).unwrap_or_default();
        let resident = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
        let kib = resident.and_then(|line| line.trim().trim_end_matches(" kB").parse::<f64>().ok());
        let handles = fs::read_dir(format!("{of}/fd")).map_or(0, Iterator::count);
        seen.extend(kib.map(|kib| Has { at_s: begun.elapsed().as_secs_f64(), mib: kib / 1024.0, handles }));
        thread::sleep(Duration::from_millis(100));
    }
    seen
}

/// The growth after the first third of the time, if it is too large.
fn grows(seen: &[Has]) -> Option<String> {
    let (_, seen) = seen.split_at(seen.len() / 3);
    let (earlier, later) = seen.split_at(seen.len() / 2);
    let most = |seen: &[Has]| seen.iter().map(|has| has.mib).fold(0.0, f64::max);
    let handles = |seen: &[Has]| seen.iter().map(|has| has.handles).max().unwrap_or(0);
    let minutes = (later.last()?.at_s - earlier.first()?.at_s) / 60.0;
    let grown = most(later) - most(earlier);
    let what = format!(
        "{grown:.2} MiB and {} handles more after {minutes:.1} min",
        handles(later) as i64 - handles(earlier) as i64
    );
    println!("{what}; {:.1} MiB at most", most(later));
    let is_more = grown > GROWS_MIB + GROWS_MIB_A_MINUTE * minutes || handles(later) > handles(earlier) + 2;
    is_more.then_some(what)
}

#[test]
fn a_fleet_that_goes_for_long_takes_no_more_as_it_goes() {
    let folder = Folder::with("studio");
    folder.copy_scenario("tigerplace");
    let (lasts_s, homes) = (asked("HOMEBODY_SOAK_S", USUAL_S), asked("HOMEBODY_SOAK_HOMES", USUAL_HOMES));
    let words = format!("--homes {homes} --start 2026-11-01T08:00 --speed 1000 --for {}s", lasts_s + 1);
    let mut running = folder
        .start(&format!("fleet studio tigerplace {words} --out jsonl:/dev/null --skew 2s --report-every 1s --quiet"));
    let seen = watched(&mut running, Duration::from_secs(lasts_s));
    running.finish().ok();
    assert!(seen.len() as u64 >= 5 * lasts_s, "it was looked at {} times", seen.len());
    assert_eq!(grows(&seen), None);

    // The control: what grows is seen to grow, be it memory or handles.
    let grown = |mib: f64, handles: usize| -> Vec<Has> {
        let with = |(number, has): (usize, &Has)| Has {
            mib: has.mib + mib * number as f64,
            handles: has.handles + handles * number,
            ..*has
        };
        seen.iter().enumerate().map(with).collect()
    };
    let twice_mib = 2.0 * (GROWS_MIB + GROWS_MIB_A_MINUTE * lasts_s as f64 / 60.0);
    assert!(grows(&grown(3.0 * twice_mib / seen.len() as f64, 0)).is_some() && grows(&grown(0.0, 1)).is_some());
    assert_eq!(grows(&grown(0.0, 0)), None);
}
