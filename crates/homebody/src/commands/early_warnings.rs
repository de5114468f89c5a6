//! Warnings of sentences without room in the first days, simulated during a run or a cohort.

use super::check::tell_remark;
use crate::failure::Failure;
use homebody_core::problem::Problem;
use homebody_log::error::no_thread;
use homebody_simulation::{Cancel, PlannedRun, SAMPLE_TIME, SampledRun, shortened};
use indicatif::ProgressBar;
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;

/// Most sentences that a run lists (our choice); `homebody routine check --lived` lists all.
pub const MOST_DIFFERENCES: usize = 5;

/// A sample of the first days on a thread of its own.
pub struct EarlyWarnings {
    /// `None` after they were printed.
    warnings: Mutex<Option<Receiver<Vec<Problem>>>>,
    cancel: Cancel,
}

impl EarlyWarnings {
    pub fn begin(plan: PlannedRun) -> Result<EarlyWarnings, Failure> {
        let (send, warnings) = channel();
        let cancel = Cancel::new();
        let of_sample = cancel.clone();
        let sample = move || {
            // The run itself reports an impossible decision of a driver.
            let sampled = plan.sample(SAMPLE_TIME, &of_sample).ok().flatten();
            let _ = send.send(sampled.iter().flat_map(SampledRun::warnings).collect());
        };
        let begun = thread::Builder::new().name("sample".into()).spawn(sample);
        begun.map_err(|error| Failure::file(no_thread("to simulate the first days", error)))?;
        Ok(EarlyWarnings { warnings: Mutex::new(Some(warnings)), cancel })
    }

    /// Prints the warnings once they are known.
    pub fn tell_soon(&self, progress: &ProgressBar) {
        let mut pending = self.pending();
        if let Some(warnings) = pending.as_ref().and_then(|warnings| warnings.try_recv().ok()) {
            *pending = None;
            progress.suspend(|| tell(warnings));
        }
    }

    /// Waits for the warnings, and prints them if that was not done before.
    pub fn tell_now(&self) {
        if let Some(warnings) = self.pending().take() {
            tell(warnings.recv().unwrap_or_default());
        }
    }

    fn pending(&self) -> MutexGuard<'_, Option<Receiver<Vec<Problem>>>> {
        self.warnings.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn tell(warnings: Vec<Problem>) {
    shortened(warnings, MOST_DIFFERENCES).iter().for_each(tell_remark);
}

impl Drop for EarlyWarnings {
    fn drop(&mut self) {
        self.cancel.cancel();
    }
}
