//! One case: done with all that is measured, and what became of it.

use crate::memory::Memory;
use crate::targets::{Files, Target, Verdict};
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
    /// How long it took.
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
        let what = panic.payload_as_str().unwrap_or("something");
        panics().push(format!("panic at {place}: {what}"));
    }));
}

fn panics() -> std::sync::MutexGuard<'static, Vec<String>> {
    PANICS.lock().unwrap_or_else(PoisonError::into_inner)
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
    let begun = Instant::now();
    let result = panic::catch_unwind(AssertUnwindSafe(|| (target.run)(files, folder.path())));
    let (took, peak_bytes) = (begun.elapsed(), memory.peak_bytes());
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
