//! What can go wrong with a log.

use crate::url::UrlError;
use std::io;
use std::path::{Path, PathBuf};

/// What went wrong, at which file, and what to do about it.
#[derive(Debug, thiserror::Error)]
pub enum LogError {
    #[error("{0} exists already\n  hint: --force replaces it", .path.display())]
    Exists { path: PathBuf },
    #[error("two outputs have the same file, {0}\n  hint: give each its own", .path.display())]
    SameFile { path: PathBuf },
    #[error("{0} is a folder\n  hint: name a file in it", .path.display())]
    IsFolder { path: PathBuf },
    #[error("{0} is no file that a database can be in\n  hint: name a file, or write csv: or casas: there", .path.display())]
    NoFile { path: PathBuf },
    #[error("the folder of {0} does not exist\n  hint: create it, or correct the path", .path.display())]
    NoFolder { path: PathBuf },
    #[error("{0} may not be written\n  hint: check who may write there", .path.display())]
    Denied { path: PathBuf },
    #[error("no space is left for {0}\n  hint: what it held before is safe; make room and run again", .path.display())]
    Full { path: PathBuf },
    #[error("{0}: writing failed\n  hint: the disk may be failing or full, or the size of files limited", .path.display())]
    Unwritten { path: PathBuf },
    #[error("{0} is locked by another program\n  hint: close that program, or write to another file", .path.display())]
    Locked { path: PathBuf },
    #[error("{name:?} cannot name a {what} in a database\n  hint: use up to 63 of a-z, 0-9 and _, not a digit first")]
    Name { what: &'static str, name: String },
    #[error("the {what} {name:?} is used twice\n  hint: give each its own name")]
    SameName { what: &'static str, name: String },
    #[error("the sensors {first:?} and {second:?} would both be {shown:?} in the log\n  hint: give each its own id")]
    SameSensor { first: String, second: String, shown: String },
    #[error("{0} does not exist\n  hint: correct the path", .path.display())]
    Missing { path: PathBuf },
    #[error("{0} cannot be read as a log: {why}", .path.display())]
    NoLog { path: PathBuf, why: String },
    #[error("{0}: {source}", .path.display())]
    File { path: PathBuf, source: io::Error },
    #[error("{0}: {source}", .path.display())]
    Database { path: PathBuf, source: rusqlite::Error },
    #[error("{0} is read by this command, which cannot replace it\n  hint: name another file", .path.display())]
    IsSource { path: PathBuf },
    #[error("{0}: {source}\n  hint: a run needs a folder that may be written", .path.display())]
    Unmade { path: PathBuf, source: io::Error },
    #[error(transparent)]
    Url(#[from] UrlError),
    #[error("the recording cannot be written down: {0}")]
    Recording(#[from] serde_json::Error),
    #[error("{0}")]
    Zone(String),
    #[error("{0} takes no more rows after its error", .path.display())]
    Stopped { path: PathBuf },
}

impl LogError {
    /// What an error of a file means.
    pub(crate) fn file(path: &Path, source: io::Error) -> LogError {
        let path = path.to_owned();
        match source.kind() {
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => LogError::Full { path },
            io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => LogError::Denied { path },
            io::ErrorKind::IsADirectory => LogError::IsFolder { path },
            _ => LogError::File { path, source },
        }
    }

    /// What an error of a database means.
    pub(crate) fn database(path: &Path, source: rusqlite::Error) -> LogError {
        use rusqlite::ErrorCode::*;
        use rusqlite::ffi::SQLITE_IOERR_WRITE;
        let path = path.to_owned();
        match source.sqlite_error_code() {
            Some(DatabaseBusy | DatabaseLocked) => LogError::Locked { path },
            Some(DiskFull) => LogError::Full { path },
            Some(ReadOnly | PermissionDenied) => LogError::Denied { path },
            _ if source.sqlite_error().is_some_and(|error| error.extended_code == SQLITE_IOERR_WRITE) => {
                LogError::Unwritten { path }
            }
            _ => LogError::Database { path, source },
        }
    }
}
