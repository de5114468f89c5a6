//! What can go wrong with a log.

use homebody_core::scenario::scheme::NoPlace;
use std::error::Error;
use std::io;
use std::path::Path;

/// What went wrong, at which place, and what to do about it.
#[derive(Debug, thiserror::Error)]
pub enum LogError {
    #[error("{place} exists already\n  hint: name another place, or allow that what is there is replaced")]
    Exists { place: String },
    #[error("two outputs have the same file, {place}\n  hint: give each its own")]
    SameFile { place: String },
    #[error("{place} is a folder\n  hint: name a file in it")]
    IsFolder { place: String },
    #[error("{place} is no file that a database can be in\n  hint: name a file, or write csv: or casas: there")]
    NoFile { place: String },
    #[error("the folder of {place} does not exist\n  hint: create it, or correct the path")]
    NoFolder { place: String },
    #[error("{place} may not be written\n  hint: check who may write there")]
    Denied { place: String },
    #[error("no space is left for {place}\n  hint: what it held before is safe; make room and run again")]
    Full { place: String },
    #[error("{place}: writing failed\n  hint: the disk may be failing or full, or the size of files limited")]
    Unwritten { place: String },
    #[error("{place} is locked by another program\n  hint: close that program, or write to another file")]
    Locked { place: String },
    #[error("{name:?} cannot name a {what} in a database\n  hint: use up to 63 of a-z, 0-9 and _, not a digit first")]
    Name { what: &'static str, name: String },
    #[error("the {what} {name:?} is used twice\n  hint: give each its own name")]
    SameName { what: &'static str, name: String },
    #[error("the sensors {first:?} and {second:?} would both be {shown:?} in the log\n  hint: give each its own id")]
    SameSensor { first: String, second: String, shown: String },
    #[error("{place} does not exist\n  hint: correct the path")]
    Missing { place: String },
    #[error("{place} cannot be read as a log: {why}")]
    NoLog { place: String, why: String },
    #[error("{place}: {source}")]
    File { place: String, source: io::Error },
    #[error("{place}: {source}")]
    Database { place: String, source: Box<dyn Error + Send + Sync> },
    #[error("{place} is read by this command, which cannot replace it\n  hint: name another file")]
    IsSource { place: String },
    #[error("{place}: {source}\n  hint: a run needs a folder that may be written")]
    Unmade { place: String, source: io::Error },
    #[error(transparent)]
    NoPlace(#[from] NoPlace),
    #[error("the recording cannot be written down: {0}")]
    Recording(#[from] serde_json::Error),
    #[error("{0}")]
    Zone(String),
    #[error("{place} takes no more rows after its error")]
    Stopped { place: String },
    #[error("{place} cannot hold {what}\n  hint: {hint}")]
    CannotHold { place: String, what: String, hint: &'static str },
    #[error(
        "{place} is not the beginning of this run: {what}\n  hint: it was changed since, or made from other files; \
         begin the run anew"
    )]
    Changed { place: String, what: String },
    #[error("{place} does not answer: nothing was taken for {seconds} s\n  hint: what it confirmed before is safe")]
    Hangs { place: String, seconds: u64 },
    /// What a destination of a caller's own has to say.
    #[error("{place}: {what}{}", .hint.as_ref().map(|hint| format!("\n  hint: {hint}")).unwrap_or_default())]
    Destination {
        place: String,
        what: String,
        hint: Option<String>,
        /// Whether the same call may succeed a little later.
        passes: bool,
        source: Option<Box<dyn Error + Send + Sync>>,
    },
}

impl LogError {
    /// An error of a destination of a caller's own, which does not pass by itself.
    pub fn destination(place: impl Into<String>, what: impl Into<String>) -> LogError {
        LogError::Destination { place: place.into(), what: what.into(), hint: None, passes: false, source: None }
    }

    /// The same error, said to pass: the same call may succeed a little later.
    pub fn passing(self) -> LogError {
        match self {
            LogError::Destination { place, what, hint, source, .. } => {
                LogError::Destination { place, what, hint, passes: true, source }
            }
            other => other,
        }
    }

    /// Whether the same call may succeed a little later.
    pub fn passes(&self) -> bool {
        matches!(self, LogError::Destination { passes: true, .. })
    }

    /// What an error of a file means.
    pub(crate) fn file(path: &Path, source: io::Error) -> LogError {
        let place = place_of(path);
        match source.kind() {
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => LogError::Full { place },
            io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => LogError::Denied { place },
            io::ErrorKind::IsADirectory => LogError::IsFolder { place },
            _ => LogError::File { place, source },
        }
    }

    /// What an error of a database means.
    pub(crate) fn database(path: &Path, source: rusqlite::Error) -> LogError {
        use rusqlite::ErrorCode::*;
        use rusqlite::ffi::SQLITE_IOERR_WRITE;
        let place = place_of(path);
        match source.sqlite_error_code() {
            Some(DatabaseBusy | DatabaseLocked) => LogError::Locked { place },
            Some(DiskFull) => LogError::Full { place },
            Some(ReadOnly | PermissionDenied) => LogError::Denied { place },
            _ if source.sqlite_error().is_some_and(|error| error.extended_code == SQLITE_IOERR_WRITE) => {
                LogError::Unwritten { place }
            }
            _ => LogError::Database { place, source: source.into() },
        }
    }
}

/// A file, as errors tell it.
pub(crate) fn place_of(path: &Path) -> String {
    path.display().to_string()
}
