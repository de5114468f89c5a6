//! Turns at a file: one page at a time reads it, compares it and writes it anew, of this server and of any other of the same folder.

use homebody_log::LogError;
use homebody_log::files::lock::FileLock;
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The turns at files. A clone is the same.
#[derive(Clone, Debug, Default)]
pub struct Turns(Arc<Mutex<()>>);

/// A turn, until it is dropped.
pub struct Turn<'t> {
    /// Between programs. It is given back first.
    _file: FileLock,
    /// Within this one, also where a system has no locks for files.
    _here: MutexGuard<'t, ()>,
}

impl Turns {
    /// Waits for the turn at a file, be it there yet or not.
    ///
    /// # Errors
    ///
    /// Those of [`FileLock::wait`]: its folder may not be written, or another program keeps the file for too long.
    pub fn take(&self, file: &Path) -> Result<Turn<'_>, LogError> {
        let here = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        Ok(Turn { _file: FileLock::wait(file)?, _here: here })
    }
}
