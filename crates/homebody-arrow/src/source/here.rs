//! Local copies of files that may be in an object store.

use homebody_log::LogError;
use std::path::{Path, PathBuf};

/// The local folder of a place. Files of an object store are copied here first, for the lifetime of the temporary folder.
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
