//! Long work: without Python's lock, with progress for a callable, until Python is interrupted.

use homebody_simulation::Cancel;
use pyo3::prelude::*;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Interval at which Python receives the progress and is asked whether to continue (our choice).
const EVERY: Duration = Duration::from_millis(50);

/// Reports the progress of work to Python, and cancels the work if Python raises an exception.
pub struct PythonProgress {
    progress: Option<Py<PyAny>>,
    pub cancel: Cancel,
    state: Mutex<ProgressState>,
}

struct ProgressState {
    last: Instant,
    raised: Option<PyErr>,
}

impl PythonProgress {
    /// `progress` gets the done part and the whole.
    pub fn new(progress: Option<Py<PyAny>>) -> PythonProgress {
        PythonProgress {
            progress,
            cancel: Cancel::new(),
            state: Mutex::new(ProgressState { last: Instant::now(), raised: None }),
        }
    }

    /// Reports progress, from any thread.
    pub fn tell(&self, done: f64, all: f64) {
        let Ok(mut state) = self.state.try_lock() else { return };
        if state.last.elapsed() < EVERY && done < all || state.raised.is_some() {
            return;
        }
        state.last = Instant::now();
        let reported = Python::attach(|py| {
            py.check_signals()?;
            match &self.progress {
                Some(progress) => progress.call1(py, (done, all)).map(|_| ()),
                None => Ok(()),
            }
        });
        if let Err(error) = reported {
            state.raised = Some(error);
            self.cancel.cancel();
        }
    }

    /// Runs work on another thread, while this one checks for Ctrl-C: Python reports it only to its first thread.
    pub fn interruptible<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        std::thread::scope(|scope| {
            let (working, is_done) = mpsc::channel::<()>();
            let worker = scope.spawn(move || {
                let result = work();
                drop(working);
                result
            });
            while is_done.recv_timeout(EVERY) == Err(RecvTimeoutError::Timeout) {
                // Without the lock of the state: a thread that reports progress holds it and waits for Python.
                if let Err(error) = Python::attach(|py| py.check_signals()) {
                    self.state.lock().unwrap_or_else(PoisonError::into_inner).raised.get_or_insert(error);
                    self.cancel.cancel();
                }
            }
            worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        })
    }

    /// The exception that Python raised meanwhile, or else the result.
    pub fn finish<T>(self, result: PyResult<T>) -> PyResult<T> {
        let state = self.state.into_inner().unwrap_or_else(PoisonError::into_inner);
        state.raised.map_or(result, Err)
    }
}
