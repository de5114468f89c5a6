//! One program at a time writes into the folder of a run.

use crate::error::{LogError, place_of};
use std::fs::{File, TryLockError};
use std::path::Path;

/// A folder that nobody else writes into while this lives. It ends with the program, however that ends.
#[derive(Debug)]
pub struct FolderLock {
    _held: Option<File>,
}

impl FolderLock {
    /// Takes the folder.
    ///
    /// # Errors
    ///
    /// [`LogError::Busy`] if another program, or another run of this one, has it.
    pub fn take(folder: &Path) -> Result<FolderLock, LogError> {
        // Where a system locks no folders, nothing is held.
        let Ok(file) = File::open(folder) else { return Ok(FolderLock { _held: None }) };
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => Err(LogError::Busy { place: place_of(folder) }),
            Err(TryLockError::Error(_)) => Ok(FolderLock { _held: None }),
            Ok(()) => Ok(FolderLock { _held: Some(file) }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(unix)]
    fn one_at_a_time_has_a_folder() {
        let folder = std::env::temp_dir().join(format!("homebody-lock-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let lock = FolderLock::take(&folder).unwrap();
        assert!(matches!(FolderLock::take(&folder), Err(LogError::Busy { .. })));
        drop(lock);
        assert!(FolderLock::take(&folder).is_ok());
        std::fs::remove_dir(&folder).unwrap();
    }
}
