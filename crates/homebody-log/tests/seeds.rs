//! A destination fails in any way, at any of its calls, before or after taking the rows: each policy does what its documentation says.
//!
//! A seed decides how long it is away, how often, whether it hangs or is slow, and which policy there is. `HOMEBODY_SEEDS` says how many
//! seeds there are.

use crate::stage::sinks::{self, Call, sink};
use crate::stage::{self, Folder};
use homebody_core::random::Stream;
use homebody_log::run_log::destinations;
use homebody_log::table::{Batch, Cell};
use homebody_log::{Destination, LogError, Policy, Stored, Watermark, WhenDown, WriteMode};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::Duration;

const USUAL_SEEDS: u64 = 60;
const ROWS: u64 = 4_000;
const A_WHILE: Duration = Duration::from_millis(3);

/// The fate of a call.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fate {
    Done,
    /// It is refused, and nothing is taken.
    Away,
    /// It is taken, and its answer is lost.
    Unheard,
    /// It takes a while.
    Slow,
    /// It fails for good.
    Over,
}

/// A destination, whose calls have the fates that a seed gives them.
#[derive(Clone)]
struct Place {
    seed: u64,
    /// Whether it takes rows twice: the control.
    forgets: bool,
    got: Arc<Mutex<Got>>,
}

#[derive(Default)]
struct Got {
    asked: u64,
    kept: sinks::Got,
    is_over: bool,
}

impl Place {
    /// Each call has a chance of its own; a seed of seven ends it for good somewhere, and one of fourteen at the first or second call,
    /// which there are always.
    fn fate(&self, number: u64) -> Fate {
        let mut of_all = Stream::named(self.seed, "place");
        let latest = if self.seed.is_multiple_of(14) { 3.0 } else { 80.0 };
        let (failing, last) = (of_all.between(0.0, 0.6), of_all.between(0.0, latest) as u64);
        let mut stream = Stream::named(self.seed, &format!("call/{number}"));
        match stream.unit() {
            _ if self.seed.is_multiple_of(7) && number >= last => Fate::Over,
            unit if unit < failing / 2.0 => Fate::Away,
            unit if unit < failing => Fate::Unheard,
            unit if unit > 0.97 => Fate::Slow,
            _ => Fate::Done,
        }
    }

    fn answer(&self, call: Call, batch: &Batch) -> Result<Watermark, LogError> {
        let mut got = self.got.lock().unwrap();
        got.asked += 1;
        // Rows whose answer was lost are not taken again.
        let first = match batch.rows().next().map(|row| row.cells[0]) {
            Some(Cell::Integer(first)) if !self.forgets => first as u64,
            _ => u64::MAX,
        };
        let known = got.kept.rows.len() as u64;
        let take = |got: &mut Got| got.kept.take(call, &batch.beyond(&mut [known.saturating_sub(first)]));
        let away = || LogError::destination("a place", "it is away").passing();
        match self.fate(got.asked) {
            Fate::Away => Err(away()),
            Fate::Unheard => {
                take(&mut got);
                Err(away())
            }
            Fate::Over => {
                got.is_over = true;
                Err(LogError::destination("a place", "it is over"))
            }
            Fate::Slow => {
                thread::sleep(A_WHILE);
                Ok(take(&mut got))
            }
            Fate::Done => Ok(take(&mut got)),
        }
    }
}

/// The policy of a seed, and what it is called.
fn policy(seed: u64, folder: &Folder) -> (&'static str, Policy, WhenDown) {
    let patient =
        Policy { retry_for: Duration::from_secs(60), retry_after: Duration::from_millis(1), ..Policy::default() };
    match seed % 4 {
        0 => ("error", Policy { retry_for: Duration::ZERO, ..Policy::default() }, WhenDown::Error),
        1 => ("optional", Policy { retry_for: Duration::ZERO, ..Policy::optional() }, WhenDown::Error),
        2 => ("retry", patient, WhenDown::Error),
        _ => ("spool", patient, WhenDown::Spool(folder.path().into(), 64 << 20)),
    }
}

fn stored(seed: u64, folder: &Folder, place: &Place) -> (&'static str, Result<Stored, LogError>) {
    let (name, policy, when) = policy(seed, folder);
    let mut all = destinations(&[folder.url("csv:log.csv")], WriteMode::Create).unwrap();
    let place = place.clone();
    let place = sink(move |call, batch| place.answer(call, batch));
    all.push(Destination::own("a place", place, policy).when_down(&when));
    let logger = stage::logger(all, WriteMode::Create);
    let step = 1 + (Stream::named(seed, "steps").unit() * 400.0) as usize;
    (name, logger.and_then(|logger| stage::store(logger, &stage::firings(ROWS), step)))
}

#[test]
fn each_policy_holds_for_every_failure() {
    let seeds = std::env::var("HOMEBODY_SEEDS").ok().and_then(|text| text.parse().ok()).unwrap_or(USUAL_SEEDS);
    let mut ends: BTreeMap<String, u64> = BTreeMap::new();
    for seed in 1..=seeds {
        let folder = Folder::new(&format!("seed-{seed}"));
        let place = Place { seed, forgets: false, got: Arc::default() };
        let (policy, stored) = stored(seed, &folder, &place);
        let got = place.got.lock().unwrap();
        let what =
            format!("seed {seed}, {policy}: {:?}, {} calls", stored.as_ref().map(|stored| stored.rows), got.asked);
        assert!(got.kept.has(got.kept.rows.len() as u64), "{what}: a row is missing, doubled or out of turn");
        let is_whole = got.kept.ended && got.kept.rows.len() as u64 == ROWS;
        // A run without a success may still have stored all, if the last answer was lost.
        match (policy, &stored) {
            ("optional", Ok(stored)) => {
                assert_eq!(stored.rows, ROWS, "{what}");
                assert!(is_whole || !stored.failed.is_empty(), "{what}: it is not told that it failed");
            }
            (_, Ok(_)) => assert!(is_whole, "{what}"),
            ("error", Err(_)) => {}
            (_, Err(error)) => assert!(got.is_over, "{what}: {error}"),
        }
        // The file of the run is whole or missing, and there if the run has come to its end.
        let files = folder.files();
        assert!(files.is_empty() && stored.is_err() || files == ["log.csv"], "{what}: {files:?}");
        assert!(files.is_empty() || folder.text("log.csv").lines().count() as u64 == ROWS + 1, "{what}");
        *ends.entry(format!("{policy} {}", if stored.is_ok() { "whole" } else { "ended" })).or_default() += 1;
    }
    println!("{seeds} seeds: {ends:?}");
    assert!(
        seeds < USUAL_SEEDS
            || ["retry whole", "retry ended", "spool whole", "error ended"].iter().all(|end| ends.contains_key(*end)),
        "{ends:?}"
    );
    // The control: the test catches a sink that stores rows twice after a lost answer.
    let twice = (1..=20).filter(|seed| {
        let folder = Folder::new(&format!("twice-{seed}"));
        let place = Place { seed: *seed, forgets: true, got: Arc::default() };
        let _ = stored(*seed, &folder, &place);
        let kept = &place.got.lock().unwrap().kept;
        !kept.has(kept.rows.len() as u64)
    });
    assert!(twice.count() > 0, "rows that are there twice are seen");
}
