//! Locks for files that are read, compared and replaced: one page at a time, among all servers of the folder.

use homebody_log::LogError;
use homebody_log::files::lock::FileLock;
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Clones are the same locks.
#[derive(Clone, Debug, Default)]
pub struct WriteLocks(Arc<Mutex<()>>);

pub struct WriteLock<'t> {
    /// Among programs. It is released first.
    _file: FileLock,
    /// Within this program, and the only lock on systems without locks for files.
    _here: MutexGuard<'t, ()>,
}

impl WriteLocks {
    /// Waits for the lock of a file, which need not exist.
    ///
    /// # Errors
    ///
    /// Those of [`FileLock::wait`]: its folder may not be written, or another program keeps the file for too long.
    pub fn lock(&self, file: &Path) -> Result<WriteLock<'_>, LogError> {
        let here = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        Ok(WriteLock { _file: FileLock::wait(file)?, _here: here })
    }
}
