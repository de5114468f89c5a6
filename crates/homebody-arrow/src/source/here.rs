//! Where files are that may be in an object store.

use homebody_log::LogError;
use std::path::{Path, PathBuf};

/// Where the files of a place are on this machine: those of an object store are brought here first, for as long as the first of the two
/// lives.
#[cfg(feature = "cloud")]
pub(super) fn here(path: &Path) -> Result<(Option<tempfile::TempDir>, PathBuf), LogError> {
    match path.to_string_lossy().contains("://") {
        true => crate::store::fetched(path).map(|(kept, path)| (Some(kept), path)),
        false => Ok((None, path.into())),
    }
}

#[cfg(not(feature = "cloud"))]
pub(super) fn here(path: &Path) -> Result<((), PathBuf), LogError> {
    match path.to_string_lossy().contains("://") {
        true => Err(crate::fault::no_store(path)),
        false => Ok(((), path.into())),
    }
}

/// An error of a file that was brought here, as one of the place that it is from.
pub(super) fn of_place(path: &Path, error: LogError) -> LogError {
    match error {
        LogError::NoLog(reason) if path.to_string_lossy().contains("://") => {
            LogError::no_log(path.display().to_string(), *reason.why)
        }
        error => error,
    }
}
