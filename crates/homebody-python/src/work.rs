//! Work that takes long: without Python's lock, with a callable that is told how far it is, until Python is interrupted.

use homebody_simulation::Cancel;
use pyo3::prelude::*;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Interval at which Python receives the progress and is asked whether to continue (our choice).
const EVERY: Duration = Duration::from_millis(50);

/// What tells Python how far some work is, and ends the work where Python raises.
pub struct PythonProgress {
    told: Option<Py<PyAny>>,
    pub cancel: Cancel,
    state: Mutex<ProgressState>,
}

struct ProgressState {
    last: Instant,
    raised: Option<PyErr>,
}

impl PythonProgress {
    /// `told` is called with what is done and of how much.
    pub fn new(told: Option<Py<PyAny>>) -> PythonProgress {
        PythonProgress {
            told,
            cancel: Cancel::new(),
            state: Mutex::new(ProgressState { last: Instant::now(), raised: None }),
        }
    }

    /// How far it is; from whichever thread.
    pub fn tell(&self, done: f64, all: f64) {
        let Ok(mut state) = self.state.try_lock() else { return };
        if state.last.elapsed() < EVERY && done < all || state.raised.is_some() {
            return;
        }
        state.last = Instant::now();
        let told = Python::attach(|py| {
            py.check_signals()?;
            match &self.told {
                Some(told) => told.call1(py, (done, all)).map(|_| ()),
                None => Ok(()),
            }
        });
        if let Err(error) = told {
            state.raised = Some(error);
            self.cancel.cancel();
        }
    }

    /// Does work whose threads are others' while this one asks Python whether to go on: only the thread that Python began in is told
    /// of Ctrl-C, and it would do nothing but wait.
    pub fn beside<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        std::thread::scope(|scope| {
            let (is_doing, is_done) = mpsc::channel::<()>();
            let doing = scope.spawn(move || {
                let done = work();
                drop(is_doing);
                done
            });
            while is_done.recv_timeout(EVERY) == Err(RecvTimeoutError::Timeout) {
                // Not with the state in hand: who tells how far it is has that, and waits for Python.
                if let Err(error) = Python::attach(|py| py.check_signals()) {
                    self.state.lock().unwrap_or_else(PoisonError::into_inner).raised.get_or_insert(error);
                    self.cancel.cancel();
                }
            }
            doing.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        })
    }

    /// What Python has raised meanwhile is raised; else what came of the work stands.
    pub fn over<T>(self, result: PyResult<T>) -> PyResult<T> {
        let state = self.state.into_inner().unwrap_or_else(PoisonError::into_inner);
        state.raised.map_or(result, Err)
    }
}
