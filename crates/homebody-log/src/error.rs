//! Errors of logs.

pub(crate) mod messages;
pub(crate) mod reason;
pub(crate) mod skipped;

use homebody_core::messages::Diagnose;
use homebody_core::problem::{Diagnostic, Problems, readable};
use homebody_core::scenario::scheme::NoPlace;
use messages::ThreadMessage;
pub use messages::{ChangedMessage, HoldMessage, TruthMessage};
pub(crate) use messages::{
    CountMessage, FileRefusal, LengthMessage, MappingMessage, OtherRunMessage, OutputMessage, PackedMessage,
    SensorTableMessage,
};
use reason::ReasonTopic;
pub use reason::{DestinationError, Reason};
pub use skipped::Skipped;
use std::error::Error;
use std::fs::{File, OpenOptions};
use std::path::Path;
use std::time::Duration;
use std::{fmt, io};

/// The message that the system gives no thread for a purpose, such as `to take commands`.
pub fn no_thread(purpose: &str, why: impl fmt::Display) -> ThreadMessage {
    ThreadMessage::Unavailable { purpose: purpose.into(), reason: why.to_string() }
}

homebody_core::messages! {
    /// Errors of reading and writing logs, each with the place and a way to solve it.
    pub enum LogError in "log" {
        /// A file with this name exists, and the command may not replace it.
        Exists { place: String } error "exists" ("{place} already exists")
            hint ("choose another name, or pass --force to replace the file");
        /// The destination is a database with tables that no run has written. Homebody never replaces such a database.
        OthersDatabase {
            place: String,
            /// The part that no run has written.
            what: String,
        } error "foreign-database" ("{place} is a database with {what}: Homebody does not replace it")
            hint ("choose another name, or delete the file yourself");
        /// Two destinations of one run are the same file, perhaps by different paths.
        SameFile { place: String } error "same-file" ("two destinations are the same file: {place}")
            hint ("give each destination its own file");
        /// The destination is a folder, and a file was expected.
        IsFolder { place: String } error "is-folder" ("{place} is a folder")
            hint ("name a file in it");
        /// SQLite needs a regular file. A device or a pipe cannot hold a database.
        NoFile { place: String } error "not-a-file" ("{place} cannot hold a database: it is not a regular file")
            hint ("name a regular file, or put \"csv:\" or \"jsonl:\" before this name");
        /// The folder of the destination does not exist.
        NoFolder { place: String } error "no-folder" ("the folder of {place} does not exist")
            hint ("create the folder, or correct the path");
        /// The system refuses to write the file.
        Denied { place: String } error "write-denied" ("cannot write {place}: permission denied")
            hint ("check the permissions of the file and its folder");
        /// The system refuses to read the file.
        Unreadable { place: String } error "read-denied" ("cannot read {place}: permission denied")
            hint ("check the permissions of the file and its folder");
        /// The disk is full, or the quota of this user is used up. Everything that was confirmed before is safe.
        Full { place: String } error "disk-full" ("no space left to write {place}")
            hint ("rows written before are safe; free some space and run the command again");
        /// The system failed to write to a database. The disk may be failing, or the size of files may be limited.
        Unwritten { place: String } error "write-failed" ("cannot write to the database {place}")
            hint ("check that the disk is sound and has space, and that ulimit -f allows files of this size");
        /// Another program holds the lock of the database for longer than Homebody waits.
        Locked { place: String } error "locked" ("another program has locked {place}")
            hint ("close that program, or write to another file");
        /// A run writes regular files only. A pipe, a device or a folder has the name of one of its files.
        NoPlain { place: String } error "not-regular" ("{place} is a pipe, a device or a folder, and not a file of a run")
            hint ("remove it, or start a new run");
        /// A file of the run's folder is a link, or lies in a folder that is a link. Writing there would write elsewhere.
        LeadsOut { place: String } error "leads-out" ("{place} is a link that leads out of the run's folder")
            hint ("remove the link, or start a new run");
        /// Another process is running into the folder, or is writing the file.
        Busy { place: String } error "busy" ("another program is writing into {place}")
            hint ("wait until it ends, or stop it first");
        /// The system gives no thread to a destination.
        NoThread { place: String, source: io::Error } error "no-thread" ("cannot start a thread that writes {place}: {source}")
            hint ("raise this user's limits on threads or memory, or run fewer simulations at once") cause (Some(source));
        /// A resumed run was stopped before it reached the end of the part that the destination has.
        NotYet { place: String } error "not-yet" ("{place} has more rows than this run has produced so far; Homebody did not change it")
            hint ("resume the run again, and let it run longer");
        /// SQL names match `^[a-z_][a-z0-9_]{0,62}$` and are not words of SQLite.
        Name { what: &'static str, name: String } error "invalid-name" ("{name:?} is not a valid name of a {what}")
            hint ("use at most 63 characters from a-z, 0-9 and _, and do not begin with a digit");
        /// Two columns or tables of the mapping have the same name.
        SameName { what: &'static str, name: String } error "duplicate-name" ("two {what}s have the name {name:?}")
            hint ("give each its own name");
        /// Two sensors would have the same identifier, so their rows could not be distinguished.
        SameSensor {
            /// The first sensor's name in the home.
            first: String,
            /// The second sensor's name.
            second: String,
            /// The identifier that both have.
            shown: String,
        } error "duplicate-sensor" ("the sensors {first:?} and {second:?} would both have the id {shown:?} in the log")
            hint ("give each its own id in logger.json");
        /// The log does not exist.
        Missing { place: String } error "not-found" ("{place} does not exist")
            hint ("correct the path");
        /// The database has no tables. A run may have just begun, or the file may be of another program.
        NoTables { place: String } error "no-tables" ("{place} has no tables")
            hint ("name a database that has a log; Homebody reads tables, not views");
        /// Labels are written by the number of a row, as the run has counted its rows. Some lines of this log were changed, so its rows
        /// have other numbers. `homebody inspect` lists these lines.
        Gaps {
            place: String,
            /// The first of the lines.
            problems: Vec<Skipped>,
            skipped: u64,
        } error "unreadable-rows" ("{lines}", lines = unreadable(place, problems, *skipped))
            hint ("the ground truth refers to rows by number: use the log exactly as the run wrote it");
        /// The output would replace a file of a run.
        OfRun { place: String, folder: String } error "file-of-run" ("{place} is a file of the run in {folder}")
            hint ("choose another name or another folder");
        /// The system failed to read or write a file.
        File { place: String, source: io::Error } error "io" ("{place}: {source}") cause (Some(source));
        /// The file is not a database, or a damaged one.
        Broken { place: String, source: Box<dyn Error + Send + Sync> }
            error "not-a-database" ("{place} is not a database, or is damaged: {source}")
            hint ("restore the file, or name another one") cause (Some(source.as_ref()));
        /// The database reports an error that Homebody does not know.
        Database { place: String, source: Box<dyn Error + Send + Sync> } error "database" ("{place}: {source}")
            hint ("name another file, or restore an earlier copy of this one") cause (Some(source.as_ref()));
        /// The database opens, but its journal does not.
        NoRoomBeside { place: String, source: Box<dyn Error + Send + Sync> }
            error "no-journal" ("cannot open the journal of {place}: {source}")
            hint ("check the permissions of its folder and the number of open files that the system allows (ulimit -n)")
            cause (Some(source.as_ref()));
        /// The command reads the file that it is asked to write.
        IsSource { place: String } error "is-source" ("this command reads {place}, so it cannot replace it")
            hint ("name another file");
        /// The folder of a run cannot be created.
        Unmade { place: String, source: io::Error } error "no-run-folder" ("cannot create the folder {place}: {source}")
            hint ("run in a folder that you can write to, or pass --out to write elsewhere") cause (Some(source));
        /// The spool holds the rows of an unavailable destination. It has reached its largest size.
        SpoolFull {
            place: String,
            /// The file of rows.
            spool: String,
            /// The largest size, in MB.
            most_mb: u64,
        } error "spool-full" ("{place} is still unavailable, and its spool {spool} has reached {most_mb} MB")
            hint ("resume the run once {place} is back, or allow a larger spool with --spool-mb; confirmed rows are safe");
        /// The run has ended, and the destination did not come back in time.
        StillAway { place: String, seconds: u64 }
            error "still-away" ("{place} is unavailable; Homebody waited {seconds} s for it at the end of the run")
            hint ("resume the run once the destination is back; confirmed rows are safe");
        /// The run was stopped while it waited for a destination.
        StoppedAway {
            place: String,
            /// The reason, as a part of a sentence.
            why: String,
        } error "stopped-away" ("{place} was unavailable when the run stopped: {why}; the rows that it had confirmed are safe");
        /// This build of the program lacks a feature.
        NotBuiltIn {
            place: String,
            name: &'static str,
            /// The feature that brings it.
            feature: &'static str,
        } error "not-built-in" ("{place}: this program was built without {name}")
            hint ("install one with it: cargo install --path crates/homebody --features {feature}");
        /// The recording cannot be written as JSON.
        Recording { source: serde_json::Error } error "recording" ("cannot write the recording: {source}") cause (Some(source));
        /// No time zone has this name.
        Zone {
            /// The reason, with a hint.
            why: String,
        } error "time-zone" ("{why}");
        /// The destination has failed or ended, and takes no more rows.
        Stopped { place: String } error "stopped" ("{place} takes no more rows after its error");
        /// The truths of large cohorts leave out some tables, and this command needs one of them.
        LeftOut { place: String, table: String }
            error "table-left-out" ("{place} has no table {table:?}: the ground truth of a large cohort has only some of the tables")
            hint ("replay the recording of this member: homebody replay writes all tables");
        /// The destination did not answer within the time that its policy gives it.
        Hangs { place: String, seconds: u64 } error "no-answer" ("{place} has not answered for {seconds} s")
            hint ("check that the destination is running; the rows that it has confirmed are safe");
        => inner {
            /// The text does not name a place for a log.
            NoPlace(NoPlace);
            /// The URL of a server has problems.
            BadUrl(Problems);
            /// The file does not have the form of any log that Homebody reads.
            NoLog(Reason);
            /// The row is longer than the rows of any log, so Homebody does not read it into memory.
            TooLong(Reason);
            /// The file is compressed, and Homebody cannot unpack it.
            Packed(Reason);
            /// The place does not hold the ground truth of a run.
            NoTruth(Reason);
            /// The ground truth belongs to another run than the log.
            OtherRun(Reason);
            /// The destination is a link, lies behind a link, or belongs to another user.
            NotOwn(Reason);
            /// The destination was changed since the run wrote it, or belongs to another run.
            Changed(Reason);
            /// The form of the destination has no room for the data.
            CannotHold(Reason);
            /// A destination reports an error.
            Destination(DestinationError);
            /// The file that counts the confirmed rows of a destination is damaged.
            Checkpoint(CountMessage);
            /// The file that names the table and columns of a log is not a valid `logger.json`.
            NoMapping(Problems);
            /// A table of sensors has problems.
            SensorMap(Problems);
        }
    }
}

impl From<NoPlace> for LogError {
    fn from(error: NoPlace) -> LogError {
        LogError::NoPlace(error)
    }
}

impl From<serde_json::Error> for LogError {
    fn from(source: serde_json::Error) -> LogError {
        LogError::Recording { source }
    }
}

impl LogError {
    /// The stable code, such as `log::exists`.
    pub fn code(&self) -> &'static str {
        self.diagnostic().code
    }

    /// An error of a destination, which does not pass by itself. A text may have its hint in a second line, after `hint: `.
    pub fn destination(place: impl Into<String>, why: impl Into<Diagnostic>) -> LogError {
        LogError::Destination(DestinationError {
            place: place.into(),
            why: Box::new(why.into()),
            passes: false,
            source: None,
        })
    }

    /// The same error, said to pass: the same call may succeed a little later.
    pub fn passing(self) -> LogError {
        match self {
            LogError::Destination(failed) => LogError::Destination(DestinationError { passes: true, ..failed }),
            other => other,
        }
    }

    /// The same error of a destination, with the error that caused it.
    pub fn caused_by(self, source: impl Into<Box<dyn Error + Send + Sync>>) -> LogError {
        match self {
            LogError::Destination(failed) => {
                LogError::Destination(DestinationError { source: Some(source.into()), ..failed })
            }
            other => other,
        }
    }

    /// A place that Homebody cannot read as a log.
    pub fn no_log(place: impl Into<String>, why: impl Into<Diagnostic>) -> LogError {
        LogError::NoLog(Reason::new(ReasonTopic::Log, place, why))
    }

    /// A place that does not hold the ground truth of a run.
    pub fn no_truth(place: impl Into<String>, why: impl Into<Diagnostic>) -> LogError {
        LogError::NoTruth(Reason::new(ReasonTopic::Truth, place, why))
    }

    pub(crate) fn other_run(truth: &str, why: impl Into<Diagnostic>) -> LogError {
        LogError::OtherRun(Reason::new(ReasonTopic::OtherTruth, truth, why))
    }

    /// A destination that was changed since the run wrote it, or belongs to another run.
    pub fn changed(place: impl Into<String>, why: impl Into<Diagnostic>) -> LogError {
        LogError::Changed(Reason::new(ReasonTopic::Run, place, why))
    }

    /// A destination whose form has no room for the data, which the text of `what` names.
    pub fn cannot_hold(place: impl Into<String>, what: impl Into<Diagnostic>) -> LogError {
        LogError::CannotHold(Reason::new(ReasonTopic::Holding, place, what))
    }

    /// Whether the same call may succeed a little later.
    pub fn passes(&self) -> bool {
        matches!(self, LogError::Destination(DestinationError { passes: true, .. }) | LogError::Hangs { .. })
    }

    /// The same error, of a destination that is away, where the run was stopped and does not wait for it any more.
    pub(crate) fn of_stopped_run(self) -> LogError {
        match self {
            LogError::Destination(DestinationError { place, why, passes: true, .. }) => {
                LogError::StoppedAway { place, why: why.what }
            }
            LogError::Hangs { ref place, .. } => LogError::StoppedAway { place: place.clone(), why: self.reason() },
            other => other,
        }
    }

    /// The error of a destination that has not answered within this time.
    pub fn hangs(place: &str, within: Duration) -> LogError {
        LogError::Hangs { place: place.into(), seconds: within.as_secs().max(1) }
    }

    /// The problem of a destination, as a part of a sentence.
    pub(crate) fn reason(&self) -> String {
        match self {
            LogError::Destination(failed) => failed.why.what.clone(),
            LogError::Hangs { seconds, .. } => format!("it has not answered for {seconds} s"),
            other => other.to_string(),
        }
    }

    /// Translates an error of a file.
    pub fn file(path: &Path, source: io::Error) -> LogError {
        let place = place_of(path);
        if let Some(why) = FileRefusal::from_error(&source) {
            return LogError::NotOwn(Reason::new(ReasonTopic::Writing, place, why));
        }
        if let Some(why) = source.get_ref().and_then(|why| why.downcast_ref::<PackedMessage>()) {
            return LogError::Packed(Reason::new(ReasonTopic::Place, place, *why));
        }
        match source.kind() {
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => LogError::Full { place },
            io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => LogError::Denied { place },
            io::ErrorKind::IsADirectory => LogError::IsFolder { place },
            _ => LogError::File { place, source },
        }
    }

    pub(crate) fn too_long(path: &Path, line: u64, what: LengthMessage) -> LogError {
        LogError::TooLong(Reason::new(ReasonTopic::Place, format!("{}:{line}", place_of(path)), what))
    }

    /// Translates an error of reading a file.
    pub fn reading(path: &Path, source: io::Error) -> LogError {
        match source.kind() {
            io::ErrorKind::PermissionDenied => LogError::Unreadable { place: place_of(path) },
            _ => LogError::file(path, source),
        }
    }

    /// Whether another program uses the database.
    pub(crate) fn is_in_use(error: &rusqlite::Error) -> bool {
        use rusqlite::ErrorCode::{DatabaseBusy, DatabaseLocked};
        matches!(error.sqlite_error_code(), Some(DatabaseBusy | DatabaseLocked))
    }

    pub(crate) fn database(path: &Path, source: rusqlite::Error) -> LogError {
        use rusqlite::ErrorCode::*;
        use rusqlite::ffi::{SQLITE_IOERR_FSYNC, SQLITE_IOERR_SHMSIZE, SQLITE_IOERR_TRUNCATE, SQLITE_IOERR_WRITE};
        /// The codes of SQLite for failures of the system to write.
        const WRITING: [i32; 4] = [SQLITE_IOERR_WRITE, SQLITE_IOERR_SHMSIZE, SQLITE_IOERR_TRUNCATE, SQLITE_IOERR_FSYNC];
        let place = place_of(path);
        match source.sqlite_error_code() {
            _ if LogError::is_in_use(&source) => LogError::Locked { place },
            Some(DiskFull) => LogError::Full { place },
            Some(TooBig) => LogError::TooLong(Reason::new(ReasonTopic::Place, place, LengthMessage::DatabaseRow)),
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

/// The message of a database, made readable: it quotes arbitrary text of its file.
fn said(source: rusqlite::Error) -> Box<dyn Error + Send + Sync> {
    let text = source.to_string();
    let told = readable(text.clone());
    if told == text { source.into() } else { told.into() }
}

/// A file, as errors tell it.
pub(crate) fn place_of(path: &Path) -> String {
    path.display().to_string()
}

/// The first line that cannot be read, and how many there are.
fn unreadable(place: &str, problems: &[Skipped], skipped: u64) -> String {
    match problems.first() {
        Some(first) if skipped == 1 => format!("cannot read {}: {}", first.place(place), first.why),
        Some(first) => format!("cannot read {skipped} lines of {place}, such as {}: {}", first.place(place), first.why),
        None => format!("cannot read {skipped} lines of {place}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distinguishes_denied_reads_from_denied_writes() {
        let denied = || io::Error::from(io::ErrorKind::PermissionDenied);
        let path = Path::new("log.csv");
        assert!(matches!(LogError::reading(path, denied()), LogError::Unreadable { .. }));
        assert!(matches!(LogError::file(path, denied()), LogError::Denied { .. }));
        assert!(matches!(LogError::reading(path, io::ErrorKind::IsADirectory.into()), LogError::IsFolder { .. }));
    }
}
