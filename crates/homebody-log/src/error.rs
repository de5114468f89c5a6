//! What can go wrong with a log.

use crate::limits::LONGEST_ROW_BYTES;
use crate::skipped::Skipped;
use crate::written::Refused;
use homebody_core::problem::readable;
use homebody_core::scenario::scheme::NoPlace;
use std::error::Error;
use std::fmt;
use std::fs::{File, OpenOptions};
use std::io;
use std::path::Path;
use std::time::Duration;

/// What to say where the system gives no thread `to` do something.
pub fn no_thread(to: &str, why: impl fmt::Display) -> String {
    format!("there is no thread {to}: {why}\n  hint: allow this user more threads or memory, or run less at once")
}

fn no_writer(place: &str, why: &io::Error) -> String {
    no_thread(&format!("to write {place}"), why)
}

/// What went wrong, at which place, and what to do about it.
#[derive(Debug, thiserror::Error)]
pub enum LogError {
    /// There is a file where one is to be made, and nobody has allowed that it is replaced.
    #[error("{place} exists already\n  hint: name another place, or allow that what is there is replaced")]
    Exists {
        /// The file.
        place: String,
    },
    /// A database is where a file is to be made, and holds what no run has left.
    #[error(
        "{place} is a database that holds {what}, and is never replaced\n  hint: name another file, or remove it yourself"
    )]
    OthersDatabase {
        /// The file.
        place: String,
        /// The part that no run left, as a part of a sentence.
        what: String,
    },
    /// Two outputs of a run lead to one file, perhaps by different paths.
    #[error("two outputs have the same file, {place}\n  hint: give each its own")]
    SameFile {
        /// The file.
        place: String,
    },
    /// A folder is where a file was to be written.
    #[error("{place} is a folder\n  hint: name a file in it")]
    IsFolder {
        /// The folder.
        place: String,
    },
    /// A database was to be in something else than a file, such as a device.
    #[error("{place} is no file that a database can be in\n  hint: name a file, or write csv: or casas: there")]
    NoFile {
        /// What it is.
        place: String,
    },
    /// There is no folder for the file that is to be made.
    #[error("the folder of {place} does not exist\n  hint: create it, or correct the path")]
    NoFolder {
        /// The file.
        place: String,
    },
    /// The system does not let this program write there.
    #[error("{place} may not be written\n  hint: check who may write there")]
    Denied {
        /// The file.
        place: String,
    },
    /// The system does not let this program read it.
    #[error("{place} may not be read\n  hint: check who may read it")]
    Unreadable {
        /// The file or folder.
        place: String,
    },
    /// The disk is full, or what this user may use of it.
    #[error("no space is left for {place}\n  hint: what it held before is safe; make room and run again")]
    Full {
        /// The file.
        place: String,
    },
    /// The system could not write what a database gave it.
    #[error("{place}: writing failed\n  hint: the disk may be failing or full, or the size of files limited")]
    Unwritten {
        /// The database's file.
        place: String,
    },
    /// Another program has been writing to the database for longer than we wait.
    #[error("{place} is locked by another program\n  hint: close that program, or write to another file")]
    Locked {
        /// The database's file.
        place: String,
    },
    /// A file of a run's folder is a pipe, a device or a folder.
    #[error(
        "{place} is a pipe, a device or a folder\n  hint: it is no file that a run has made; remove it, or live the run anew"
    )]
    NoPlain {
        /// What is there.
        place: String,
    },
    /// A file of a run's folder is a link, or in a folder that is one, so that writing there would write elsewhere.
    #[error(
        "{place} leads out of the run's folder\n  hint: it is no file that a run has made; remove it, or live the run anew"
    )]
    LeadsOut {
        /// The file.
        place: String,
    },
    /// The file to write is a link, lies behind one, or is not this program's.
    #[error("{place} is not written: {why}\n  hint: look what it is, and remove it or name another file")]
    NotOwn {
        /// The file.
        place: String,
        /// The reason, as a part of a sentence.
        why: String,
    },
    /// The file that counts a destination's confirmed rows is wrong.
    #[error(
        "{place}: {what}\n  hint: it says how many rows a destination has; put back what was there, or remove it: then all rows are given again"
    )]
    Unnoted {
        /// The file.
        place: String,
        /// The reason, as a part of a sentence.
        what: String,
    },
    /// Another program is living a run into the folder, or writing the file.
    #[error("another program is writing into {place}\n  hint: let it come to its end, or stop it first")]
    Busy {
        /// The folder or file.
        place: String,
    },
    /// The system gives no thread to a destination.
    #[error("{}", no_writer(.place, .source))]
    NoThread {
        /// The destination.
        place: String,
        /// What the system says.
        source: io::Error,
    },
    /// A run that is gone on with was stopped before it had come as far as before.
    #[error(
        "{place} has come further than this time: it stays as it was\n  hint: go on with the run again, and longer"
    )]
    NotYet {
        /// What has come further.
        place: String,
    },
    /// A name of the mapping is none that SQL takes: `^[a-z_][a-z0-9_]{0,62}$`, and not one of SQLite's own.
    #[error("{name:?} cannot name a {what} in a database\n  hint: use up to 63 of a-z, 0-9 and _, not a digit first")]
    Name {
        /// What has the name: a table or a column.
        what: &'static str,
        /// The name.
        name: String,
    },
    /// Two columns of the mapping have one name.
    #[error("the {what} {name:?} is used twice\n  hint: give each its own name")]
    SameName {
        /// What has the name.
        what: &'static str,
        /// The name.
        name: String,
    },
    /// Nobody could tell two sensors apart in the log.
    #[error("the sensors {first:?} and {second:?} would both be {shown:?} in the log\n  hint: give each its own id")]
    SameSensor {
        /// The one, by its name in the home.
        first: String,
        /// The other.
        second: String,
        /// The id that both have.
        shown: String,
    },
    /// What is to be read is not there.
    #[error("{place} does not exist\n  hint: correct the path")]
    Missing {
        /// The file.
        place: String,
    },
    /// What is to be read is no log in any form that is known.
    #[error("{place} cannot be read as a log: {why}")]
    NoLog {
        /// The file.
        place: String,
        /// Why not, as a part of a sentence.
        why: String,
    },
    /// A file is to tell the names of a table and its columns, and does not.
    #[error("{place} is no logger.json: {why}\n  hint: docs/reference/logger.md lists its keys")]
    NoMapping {
        /// The file.
        place: String,
        /// Why not.
        why: String,
    },
    /// A table of sensors' names has something wrong in it.
    #[error(
        "{}\n  hint: a table of sensors has a line id,name and then one for each sensor, with its own id and its own name",
        .problems.join("\n")
    )]
    SensorMap {
        /// All that is wrong: file, line and what.
        problems: Vec<String>,
    },
    /// A database has no tables: a run has only just begun in it, or it is none of a log.
    #[error(
        "{place} has no tables, so no log\n  hint: name one that has; what is computed, such as a view, is not read"
    )]
    NoTables {
        /// The file.
        place: String,
    },
    /// A row or a cell is longer than any of a log's, so it is not read into memory.
    #[error("{place}: {what}\n  hint: no log has that: name one")]
    TooLong {
        /// The file, with the line where it is known.
        place: String,
        /// What is too long, as a sentence.
        what: String,
    },
    /// What is to be read is no truth of a run.
    #[error(
        "{place} has no truth: {why}\n  hint: name the database that the log's run has left, or csv:FILE, parquet:FILE and so on where each table is a file"
    )]
    NoTruth {
        /// The place.
        place: String,
        /// Why not, as a part of a sentence.
        why: String,
    },
    /// A truth tells of another run than the log's.
    #[error("{truth} is not the truth of this log: {what}\n  hint: name the truth that the same run has left")]
    OtherRun {
        /// The truth.
        truth: String,
        /// In what they differ, as a part of a sentence.
        what: String,
    },
    /// Lines of a log are not understood, so that nobody can tell which row is which.
    #[error("{}\n  hint: the truth counts the log's rows: take the log as its run has left it", told(.place, .problems, *.skipped))]
    Gaps {
        /// The log.
        place: String,
        /// The first of the lines.
        problems: Vec<Skipped>,
        /// How many they are.
        skipped: u64,
    },
    /// What is to be written would replace a file that a run has left, or is writing.
    #[error("{place} is a file of the run in {folder}\n  hint: name a file elsewhere, or by another name")]
    OfRun {
        /// The file.
        place: String,
        /// The run's folder.
        folder: String,
    },
    /// The system could not read or write a file, for a reason that none of the others names.
    #[error("{place}: {source}")]
    File {
        /// The file.
        place: String,
        /// What the system says.
        source: io::Error,
    },
    /// A file is to be a database, and is none, or a damaged one.
    #[error(
        "{place}: {source}\n  hint: it is no database, or a damaged one: put back what was there, or name another file"
    )]
    Broken {
        /// The file.
        place: String,
        /// What the database says.
        source: Box<dyn Error + Send + Sync>,
    },
    /// A database could not be read or written, for a reason that none of the others names.
    #[error("{place}: {source}\n  hint: name another file, or take a copy of this one from before it was changed")]
    Database {
        /// The database's file.
        place: String,
        /// What the database says.
        source: Box<dyn Error + Send + Sync>,
    },
    /// A database opens, and its journal does not.
    #[error(
        "{place}: {source}, though its file can be opened\n  hint: it needs files beside itself: look who may write in its folder, and \
         how many files may be open at once (ulimit -n)"
    )]
    NoRoomBeside {
        /// The database's file.
        place: String,
        /// The database's own message.
        source: Box<dyn Error + Send + Sync>,
    },
    /// The output of a command would replace what the command reads.
    #[error("{place} is read by this command, which cannot replace it\n  hint: name another file")]
    IsSource {
        /// The file.
        place: String,
    },
    /// The folder of a run could not be made.
    #[error("{place}: {source}\n  hint: a run needs a folder that may be written")]
    Unmade {
        /// The folder.
        place: String,
        /// What the system says.
        source: io::Error,
    },
    /// What is put aside for a destination that is away has no room left.
    #[error(
        "{place} is still away, and its spool {spool} is full: it may have {most_mb} MB\n  hint: what {place} has confirmed is safe \
         there; once it is back, go on with the run in its folder, or allow a larger spool"
    )]
    SpoolFull {
        /// The destination.
        place: String,
        /// The file of rows that were put aside.
        spool: String,
        /// How large it may be.
        most_mb: u64,
    },
    /// A destination has not come back by the end of a run.
    #[error(
        "{place} is away: it was waited for {seconds} s at the end\n  hint: what it has confirmed is safe there; once it is back, \
         go on with the run in its folder"
    )]
    StillAway {
        /// The destination.
        place: String,
        /// How long, in seconds.
        seconds: u64,
    },
    /// A run was stopped while it waited for a destination.
    #[error("{place} was away when the run was stopped: {why}; what it has confirmed is safe there")]
    StoppedAway {
        /// The destination.
        place: String,
        /// Why it was away, as a part of a sentence.
        why: String,
    },
    /// A kind of place is known by its name alone: this build cannot write or read it.
    #[error(
        "{place}: this program was built without {name}\n  hint: cargo install --path crates/homebody --features {feature} \
         builds one that has it"
    )]
    NotBuiltIn {
        /// The place.
        place: String,
        /// What stands before the colon.
        name: &'static str,
        /// The feature of the build that brings it.
        feature: &'static str,
    },
    /// A text names no place that a log can go to.
    #[error(transparent)]
    NoPlace(#[from] NoPlace),
    /// A run's recording could not be turned into JSON.
    #[error("the recording cannot be written down: {0}")]
    Recording(#[from] serde_json::Error),
    /// There is no time zone of the name that was given; the text says so, with a hint.
    #[error("{0}")]
    Zone(String),
    /// A destination was given rows after it had failed or was finished.
    #[error("{place} takes no more rows after its error")]
    Stopped {
        /// The destination.
        place: String,
    },
    /// A destination has no room in its form for what it is asked to take.
    #[error("{place} cannot hold {what}\n  hint: {hint}")]
    CannotHold {
        /// The destination.
        place: String,
        /// What it cannot hold, as a part of a sentence.
        what: String,
        /// What to do about it.
        hint: &'static str,
    },
    /// A truth is brief, and what is asked for is in what it leaves out.
    #[error(
        "{place} leaves out the table {table:?}, as the truths of large cohorts do\n  hint: homebody replay, of the recording of the \
         same member, lives it again with all tables"
    )]
    LeftOut {
        /// The truth.
        place: String,
        /// The table.
        table: String,
    },
    /// What is there already cannot be gone on with: it is no beginning of this run.
    #[error(
        "{place} is not the beginning of this run: {what}\n  hint: it was changed since, or the recording is of another run; put \
         back what was there, or begin the run anew"
    )]
    Changed {
        /// The destination.
        place: String,
        /// In what it differs, as a part of a sentence.
        what: String,
    },
    /// A destination has not answered a request within the time that its policy gives it.
    #[error("{place} does not answer: nothing was taken for {seconds} s\n  hint: what it confirmed before is safe")]
    Hangs {
        /// The destination.
        place: String,
        /// How long, in seconds.
        seconds: u64,
    },
    /// What a destination of a caller's own has to say.
    #[error("{place}: {what}{}", .hint.as_ref().map(|hint| format!("\n  hint: {hint}")).unwrap_or_default())]
    Destination {
        /// What the destination is called.
        place: String,
        /// What is wrong, as a part of a sentence.
        what: String,
        /// What to do about it, where that can be said.
        hint: Option<String>,
        /// Whether the same call may succeed a little later.
        passes: bool,
        /// The error that it comes of, where there is one.
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
        matches!(self, LogError::Destination { passes: true, .. } | LogError::Hangs { .. })
    }

    /// The same error, of a destination that is away, where the run was stopped and does not wait for it any more.
    pub(crate) fn of_stopped_run(self) -> LogError {
        match self {
            LogError::Destination { place, what, passes: true, .. } => LogError::StoppedAway { place, why: what },
            LogError::Hangs { ref place, .. } => LogError::StoppedAway { place: place.clone(), why: self.reason() },
            other => other,
        }
    }

    /// The error of a destination that has not answered within this time.
    pub fn hangs(place: &str, within: Duration) -> LogError {
        LogError::Hangs { place: place.into(), seconds: within.as_secs().max(1) }
    }

    /// What is wrong with a destination, as a part of a sentence.
    pub(crate) fn reason(&self) -> String {
        match self {
            LogError::Destination { what, .. } => what.clone(),
            LogError::Hangs { seconds, .. } => format!("it has not answered for {seconds} s"),
            other => other.to_string(),
        }
    }

    /// What an error of a file means.
    pub fn file(path: &Path, source: io::Error) -> LogError {
        let place = place_of(path);
        if let Some(why) = Refused::of(&source) {
            return LogError::NotOwn { place, why: why.to_string() };
        }
        match source.kind() {
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => LogError::Full { place },
            io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => LogError::Denied { place },
            io::ErrorKind::IsADirectory => LogError::IsFolder { place },
            _ => LogError::File { place, source },
        }
    }

    /// What is too long in a line of a log, as a sentence.
    pub(crate) fn too_long(path: &Path, line: u64, what: String) -> LogError {
        LogError::TooLong { place: format!("{}:{line}", place_of(path)), what }
    }

    /// What an error of reading a file means.
    pub fn reading(path: &Path, source: io::Error) -> LogError {
        match source.kind() {
            io::ErrorKind::PermissionDenied => LogError::Unreadable { place: place_of(path) },
            _ => LogError::file(path, source),
        }
    }

    /// Whether a database is in use by somebody else, as an error of it says.
    pub(crate) fn is_in_use(error: &rusqlite::Error) -> bool {
        use rusqlite::ErrorCode::{DatabaseBusy, DatabaseLocked};
        matches!(error.sqlite_error_code(), Some(DatabaseBusy | DatabaseLocked))
    }

    /// What an error of a database means.
    pub(crate) fn database(path: &Path, source: rusqlite::Error) -> LogError {
        use rusqlite::ErrorCode::*;
        use rusqlite::ffi::{SQLITE_IOERR_FSYNC, SQLITE_IOERR_SHMSIZE, SQLITE_IOERR_TRUNCATE, SQLITE_IOERR_WRITE};
        /// What SQLite says where the system could not write.
        const WRITING: [i32; 4] = [SQLITE_IOERR_WRITE, SQLITE_IOERR_SHMSIZE, SQLITE_IOERR_TRUNCATE, SQLITE_IOERR_FSYNC];
        let place = place_of(path);
        match source.sqlite_error_code() {
            _ if LogError::is_in_use(&source) => LogError::Locked { place },
            Some(DiskFull) => LogError::Full { place },
            Some(TooBig) => {
                let what = format!("a row or a cell of it is longer than {LONGEST_ROW_BYTES} bytes");
                LogError::TooLong { place, what }
            }
            Some(NotADatabase | DatabaseCorrupt) => LogError::Broken { place, source: said(source) },
            Some(ReadOnly | PermissionDenied) => LogError::Denied { place },
            // It does not say why; the system does.
            Some(CannotOpen) => match (File::open(path), OpenOptions::new().write(true).open(path)) {
                (Err(error), _) => LogError::reading(path, error),
                (_, Err(error)) => LogError::file(path, error),
                _ => LogError::NoRoomBeside { place, source: said(source) },
            },
            _ if source.sqlite_error().is_some_and(|error| WRITING.contains(&error.extended_code)) => {
                LogError::Unwritten { place }
            }
            _ => LogError::Database { place, source: said(source) },
        }
    }
}

/// What a database says, as people can read it: it quotes whatever is in its file.
fn said(source: rusqlite::Error) -> Box<dyn Error + Send + Sync> {
    let text = source.to_string();
    let told = readable(text.clone());
    if told == text { source.into() } else { told.into() }
}

/// A file, as errors tell it.
pub(crate) fn place_of(path: &Path) -> String {
    path.display().to_string()
}

/// The lines that are not understood, each by its place, as far as they are listed.
fn told(place: &str, problems: &[Skipped], skipped: u64) -> String {
    let mut lines: Vec<String> = problems.iter().map(|line| format!("{}: {}", line.place(place), line.why)).collect();
    let rest = skipped.saturating_sub(lines.len() as u64);
    if rest > 0 {
        lines.push(format!("{place}: {rest} more lines are not understood"));
    }
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_may_not_be_read_and_what_may_not_be_written_are_told_apart() {
        let denied = || io::Error::from(io::ErrorKind::PermissionDenied);
        let path = Path::new("log.csv");
        assert!(matches!(LogError::reading(path, denied()), LogError::Unreadable { .. }));
        assert!(matches!(LogError::file(path, denied()), LogError::Denied { .. }));
        assert!(matches!(LogError::reading(path, io::ErrorKind::IsADirectory.into()), LogError::IsFolder { .. }));
    }
}
