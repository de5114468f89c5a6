//! One case: done with all that is measured, and what became of it.

use crate::memory::Memory;
use crate::target::{Files, Target, Verdict};
use std::fs;
use std::panic::{self, AssertUnwindSafe};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// What became of a case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum End {
    /// It was read.
    Accepted,
    /// It was refused, in words.
    Refused,
    /// A panic, or an invariant that does not hold; or the process died or hung.
    Failed(String),
}

/// A case that has ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Done {
    /// What became of it.
    pub end: End,
    /// How long it took: of the processors, where the system tells, which is at most what the clock says.
    pub took: Duration,
    /// The most memory that it took at a time, in bytes.
    pub peak_bytes: usize,
}

/// What panics have said, of whatever thread, since somebody has asked.
static PANICS: Mutex<Vec<String>> = Mutex::new(Vec::new());

/// From now on panics are kept, not printed.
pub fn keep_panics() {
    panic::set_hook(Box::new(|panic| {
        let place = panic.location().map(|place| format!("{}:{}", place.file(), place.line())).unwrap_or_default();
        let payload = panic.payload();
        let text = payload.downcast_ref::<String>().map(String::as_str);
        let what = text.or(payload.downcast_ref::<&str>().copied()).unwrap_or("something");
        panics().push(format!("panic at {place}: {what}"));
    }));
}

fn panics() -> std::sync::MutexGuard<'static, Vec<String>> {
    PANICS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The time that processors have spent on this process; None where the system does not tell.
fn processor_time() -> Option<Duration> {
    /// What Linux counts in is a hundredth of a second for all who ask, whatever its clock.
    const TICK: Duration = Duration::from_millis(10);
    let stat = fs::read_to_string("/proc/self/stat").ok()?;
    // Behind the name, in brackets, which may have blanks: the 14th and 15th figure of all.
    let (_, figures) = stat.rsplit_once(')')?;
    let ticks: Vec<u32> =
        figures.split_whitespace().skip(11).take(2).filter_map(|figure| figure.parse().ok()).collect();
    Some(TICK * ticks.iter().sum::<u32>())
}

/// Does a case in a folder of its own, which is gone afterwards.
pub fn run(target: &Target, files: &Files) -> Done {
    let folder = match tempfile::tempdir() {
        Ok(folder) => folder,
        Err(error) => {
            let end = End::Failed(format!("no folder for temporary files: {error}"));
            return Done { end, took: Duration::ZERO, peak_bytes: 0 };
        }
    };
    panics().clear();
    let memory = Memory::begin();
    let (begun, before) = (Instant::now(), processor_time());
    let result = panic::catch_unwind(AssertUnwindSafe(|| (target.run)(files, folder.path())));
    // On a machine that others use, a case may have waited for them: it has not taken that time.
    let waited = begun.elapsed();
    let took = processor_time().zip(before).map_or(waited, |(after, before)| waited.min(after.saturating_sub(before)));
    let peak_bytes = memory.peak_bytes();
    let panicked = panics().first().cloned();
    let end = match (panicked, result) {
        (Some(panic), _) => End::Failed(panic),
        (None, Ok(Ok(Verdict::Accepted))) => End::Accepted,
        (None, Ok(Ok(Verdict::Refused))) => End::Refused,
        (None, Ok(Err(what))) => End::Failed(what),
        (None, Err(_)) => End::Failed("a panic that said nothing".into()),
    };
    Done { end, took, peak_bytes }
}
