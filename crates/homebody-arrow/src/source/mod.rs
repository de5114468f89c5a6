//! Reads logs back: files of Parquet and of Arrow IPC, ours and those of pandas, polars and others, and data sets of them.

mod batches;
mod cells;
mod examine;
mod files;
mod guard;
mod ipc;
mod rows;
mod tables;

pub(crate) use batches::Batches;
pub(crate) use examine::examine;
use homebody_log::LogError;
use homebody_log::source::{Form, Shows, Start};
use std::path::{Path, PathBuf};
pub(crate) use tables::read_tables;

/// The forms of this crate.
pub(crate) const FORMS: [Form; 2] = [
    Form {
        name: "parquet",
        what: "Parquet, a file or a folder of them by run and day: columns of time, sensor and value under any of the usual names or ours",
        shows: |start| shows(start, batches::PARQUET),
        read: rows::read,
    },
    Form {
        name: "arrow",
        what: "a file of Arrow IPC (Feather, version 2), with columns as in Parquet",
        shows: |start| shows(start, batches::ARROW),
        read: rows::read,
    },
];

fn shows(start: &Start, magic: &[u8]) -> Shows {
    match start.begins_with(magic) {
        true if rows::are_activities(&start.path) => Shows::Activities,
        is_it => Shows::rows_if(is_it),
    }
}

/// Where the files of a place are on this machine: those of an object store are brought here first, for as long as the first of the two
/// lives.
#[cfg(feature = "cloud")]
fn here(path: &Path) -> Result<(Option<tempfile::TempDir>, PathBuf), LogError> {
    match path.to_string_lossy().contains("://") {
        true => crate::store::fetched(path).map(|(kept, path)| (Some(kept), path)),
        false => Ok((None, path.into())),
    }
}

#[cfg(not(feature = "cloud"))]
fn here(path: &Path) -> Result<((), PathBuf), LogError> {
    match path.to_string_lossy().contains("://") {
        true => Err(crate::fault::no_store(path)),
        false => Ok(((), path.into())),
    }
}

/// An error of a file that was brought here, as one of the place that it is from.
fn of_place(path: &Path, error: LogError) -> LogError {
    match error {
        LogError::NoLog { why, .. } if path.to_string_lossy().contains("://") => {
            LogError::NoLog { place: path.display().to_string(), why }
        }
        error => error,
    }
}
