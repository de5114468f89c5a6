//! The time to locate a log in its home, compared with simulating the same days.
//!
//! Both sides of a ratio take turns in one run, so that a noisy machine disturbs both. The work that is done once for the home, before the
//! first message, is in the time of locating.
//!
//! Ends with one line per home: `RATIO walked_vs_lived <home> <median> <min>..<max>`. Names after `--` ask for those homes alone.

#[path = "../../homebody-core/benches/measure/spread.rs"]
mod spread;

use homebody_query::LoadedLog;
use homebody_simulation::{Cancel, Destinations, template};
use homebody_tracking::locate;
use spread::Spread;
use std::path::Path;
use std::time::Instant;
use tempfile::TempDir;

const ROUNDS: usize = 5;
const DAYS: u32 = 60;
const HOMES: [&str; 3] = ["tigerplace", "studio", "couple-with-cat"];

fn main() {
    let asked: Vec<String> = std::env::args().skip(1).filter(|arg| !arg.starts_with('-')).collect();
    let homes = HOMES.iter().filter(|name| asked.is_empty() || asked.iter().any(|asked| asked == *name));
    let lines: Vec<String> = homes.map(|name| walked_against_lived(name)).collect();
    lines.iter().for_each(|line| println!("{line}"));
}

fn walked_against_lived(name: &str) -> String {
    let folder = TempDir::new().expect("a folder");
    let log = folder.path().join("log.csv");
    let home = template(name).expect("a template");
    let mut ratios = Vec::new();
    for _ in 0..ROUNDS {
        let lived_s = timed(|| live(name, &log));
        let read = LoadedLog::read(&url(&log), None).expect("a log");
        let rows = read.log.events.len() as f64;
        let walked_s = timed(|| {
            locate(&read.log, home.scenario(), &Cancel::new(), |_| ()).expect("a log of its home");
        });
        println!("{name}, {rows} rows of {DAYS} days: lived {lived_s:.2} s, walked back {walked_s:.2} s");
        println!("{name}: {:.1} us a row, a million in {:.1} s", walked_s / rows * 1e6, walked_s / rows * 1e6);
        ratios.push(walked_s / lived_s);
    }
    Spread::of(&ratios).line(&format!("walked_vs_lived {name}"), 1)
}

fn url(log: &Path) -> String {
    format!("csv:{}", log.display())
}

fn live(name: &str, log: &Path) {
    let _ = std::fs::remove_file(log);
    let destinations = Destinations::log(&url(log)).expect("a destination");
    let run = template(name).expect("a template").run().days(DAYS);
    run.start().expect("a run").store(&destinations, |_| ()).expect("a log");
}

fn timed(what: impl FnOnce()) -> f64 {
    let start = Instant::now();
    what();
    start.elapsed().as_secs_f64()
}
