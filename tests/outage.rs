//! A place that is stopped while a thousand rows come a second, for tests of the crates that have such places.

use homebody_core::event::Firing;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::Span;
use homebody_log::{Destination, Logger, RunInfo, WhenDown, WriteMode};
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

const A_SECOND: u64 = 1000;
/// Rows come for so long before the place is stopped, and after it is back.
const BESIDE_S: u64 = 2;
/// What was put aside is given within this time once all rows have come.
const SOON: Duration = Duration::from_secs(60);
/// What may be put aside: plenty for a minute, and more where it is longer.
const MOST_SPOOLED_BYTES_A_MINUTE: u64 = 64 << 20;

/// How long a place is stopped.
pub struct Outage {
    pub seconds: u64,
}

impl Outage {
    /// For so many seconds, unless `HOMEBODY_OUTAGE_S` says otherwise.
    pub fn of(usual_s: u64) -> Outage {
        let asked = std::env::var("HOMEBODY_OUTAGE_S").ok().and_then(|seconds| seconds.parse().ok());
        Outage { seconds: asked.unwrap_or(usual_s) }
    }

    /// How many rows come in all.
    pub fn rows(&self) -> u64 {
        (self.seconds + 2 * BESIDE_S) * A_SECOND
    }

    /// Gives all rows to a place, which `turn(false)` stops and `turn(true)` begins again. Returns how many bytes were put aside at most;
    /// nothing is left of them.
    pub fn live(&self, to: Destination, run: RunInfo, all: &[Firing], mut turn: impl FnMut(bool)) -> u64 {
        let spools = tempfile::tempdir().unwrap();
        let most_bytes = MOST_SPOOLED_BYTES_A_MINUTE * self.seconds.div_ceil(60);
        let to = to.when_down(&WhenDown::Spool(spools.path().into(), most_bytes));
        let mut logger = Logger::open(vec![to], &LoggerFile::default(), &Arc::new(run), WriteMode::Create).unwrap();
        let begun = Instant::now();
        let (mut is_stopped, mut is_back, mut most_aside) = (false, false, 0);
        for (number, step) in all.chunks(10).enumerate() {
            let lived = Duration::from_millis(10 * number as u64);
            thread::sleep(lived.saturating_sub(begun.elapsed()));
            if lived.as_secs() >= BESIDE_S && !is_stopped {
                turn(false);
                is_stopped = true;
            }
            if lived.as_secs() >= BESIDE_S + self.seconds && !is_back {
                turn(true);
                is_back = true;
            }
            logger.store(step, step[step.len() - 1].at + Span::MICROSECOND).unwrap();
            if number % 100 == 99 {
                // As a run does that goes at a pace.
                logger.make_durable().unwrap();
            }
            // Some are removed meanwhile.
            let files = std::fs::read_dir(spools.path()).unwrap().flat_map(|file| file.unwrap().metadata());
            let files = files.map(|file| file.len());
            most_aside = most_aside.max(files.sum::<u64>());
        }
        assert!(is_back, "it was stopped, and is back");
        logger.finish().unwrap();
        let lasts = Duration::from_secs(self.seconds + 2 * BESIDE_S);
        // Whoever was away for longer than a minute has much to take.
        let long = lasts.saturating_sub(Duration::from_secs(60));
        assert!(begun.elapsed() < lasts + SOON + long / 4, "all of it took {:?}", begun.elapsed());
        assert!(most_aside > 0, "rows were put aside");
        assert_eq!(std::fs::read_dir(spools.path()).unwrap().count(), 0, "no spool is left");
        most_aside
    }
}

/// More memory than this no run takes while a place is away.
pub const MOST_MIB: u64 = 256;

/// The most memory that this program has had, in MiB.
pub fn most_mib() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap();
    line.trim().trim_end_matches(" kB").parse::<u64>().unwrap() / 1024
}
