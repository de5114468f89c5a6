//! What can go wrong with a scenario, a run or a log, in this crate's own words.

use crate::VERSION;
use crate::find::Unfindable;
use crate::profiles::MOST_MEMBERS;
use homebody_core::drivers::error::DriverError;
use homebody_core::problem::{Problem, Problems};
use homebody_core::time::Micros;
use homebody_log::LogError;
use homebody_log::error::no_thread;
use std::io;
use std::path::{Path, PathBuf};

/// An error of any kind, as callers' own code brings it.
pub type BoxError = Box<dyn std::error::Error + Send + Sync>;

/// Why something could not be done. Its text says to people what is wrong and, after `hint:`, what to do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// What was written is wrong: all problems of all files, each with its place and a hint.
    #[error(transparent)]
    Problems(#[from] Problems),
    /// A file or folder could not be read or written.
    #[error("{}: {why}", path.display())]
    File {
        /// The file or folder.
        path: PathBuf,
        /// What is wrong with it.
        why: String,
        /// What the system says, where it was asked.
        #[source]
        source: Option<io::Error>,
    },
    /// What is looked for in a log cannot be found in any.
    #[error(transparent)]
    Find(#[from] Unfindable),
    /// No scenario of this name came with the program.
    #[error("there is no template {name:?}\n  hint: there are {}", known.join(", "))]
    Template {
        /// What was asked for.
        name: String,
        /// The names that there are.
        known: Vec<String>,
    },
    /// Something has the name of a folder that was to be new.
    #[error("{} exists already\n  hint: name a folder that does not", path.display())]
    Exists {
        /// The folder.
        path: PathBuf,
    },
    /// The name of a new folder has an invisible character.
    #[error("{:?} has a character that is invisible\n  hint: write the name without it", path.display().to_string())]
    UnseenName {
        /// The folder.
        path: PathBuf,
    },
    /// Of what was given no scenario can be begun: all that is wrong.
    #[error("{0}")]
    Unbeginnable(String),
    /// There is no recording at this path.
    #[error("{}: there is no such recording", path.display())]
    NoRecording {
        /// Where it was looked for.
        path: PathBuf,
    },
    /// A run or a cohort was killed in its first moment: what it is to be is not written down.
    #[error(
        "the run in {} was ended before anything of it was stored\n  hint: there is nothing to go on with: remove the folder, \
         and begin the run anew",
        folder.display()
    )]
    NotBegun {
        /// Its folder.
        folder: PathBuf,
    },
    /// A file is no recording of a run.
    #[error("{} is no recording: {why}", path.display())]
    Recording {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        why: String,
    },
    /// A run was killed, or is still being lived: its recording does not say what it came to.
    #[error("{} is no recording of a whole run: it was not completed", path.display())]
    Unfinished {
        /// The recording.
        path: PathBuf,
        /// The folder in which the run can be gone on with, be it the run's own or its cohort's.
        folder: Option<PathBuf>,
    },
    /// In a run a driver of the caller's own has moved somebody: its recording does not live it again.
    #[error(
        "{} does not live its run again: {} moved by a driver of another program\n  hint: what it left can be read, drawn \
         and compared; the program that has the driver lives it anew",
        path.display(),
        were(residents)
    )]
    OwnDrivers {
        /// The recording.
        path: PathBuf,
        /// Whom the drivers have moved, by name.
        residents: Vec<String>,
    },
    /// A file is where the folder of a run or a cohort was to be.
    #[error("{} is a file{}", path.display(), folder_of(folder.as_deref()))]
    NotFolder {
        /// The file.
        path: PathBuf,
        /// The folder that it is in, if that is the folder of a run or a cohort.
        folder: Option<PathBuf>,
    },
    /// What is in the place of a cohort's member is nothing to go on with.
    #[error("{why}\n  hint: move {} away; then this member is lived anew", folder.display())]
    Member {
        /// Where the member's folder is to be.
        folder: PathBuf,
        /// What is wrong with it.
        why: String,
    },
    /// Where a cohort is to begin is something already.
    #[error("{} holds {file} already\n  hint: {}", folder.display(), where_to_begin(*is_cohort))]
    NotEmpty {
        /// The folder, or the URL of an object store.
        folder: PathBuf,
        /// The first of what is there.
        file: String,
        /// Whether it is a cohort.
        is_cohort: bool,
    },
    /// A cohort cannot have so many members.
    #[error("a cohort of {count} members is none\n  hint: it has from 1 to {MOST_MEMBERS}")]
    Members {
        /// How many were asked for.
        count: u32,
    },
    /// A run or a cohort was lived to its end: nothing of it is left to do.
    #[error("the {what} in {} is complete: there is nothing to go on with", folder.display())]
    Complete {
        /// What it is: `run` or `cohort`.
        what: &'static str,
        /// Its folder.
        folder: PathBuf,
    },
    /// A run or a cohort was begun by another version of the program, which may live it otherwise.
    #[error("the {what} in {} was begun by version {version}; this is {VERSION}\n  hint: go on with that version, or begin it anew", folder.display())]
    OtherVersion {
        /// What it is: `run` or `cohort`.
        what: &'static str,
        /// Its folder.
        folder: PathBuf,
        /// What began it.
        version: String,
    },
    /// A log cannot be walked back through a home.
    #[error("{0}")]
    Translation(String),
    /// Whoever asked has asked for it to end early.
    #[error("it was cancelled")]
    Cancelled,
    /// A fleet cannot be like this, or cannot tell these places: all that is wrong.
    #[error("{0}")]
    Fleet(String),
    /// A scenario cannot be fitted to a log.
    #[error("{0}")]
    Calibration(String),
    /// A folder has no log in it.
    #[error("{} is a folder without a log\n  hint: name the log itself, or the folder of a run that has one", folder.display())]
    NoLog {
        /// The folder.
        folder: PathBuf,
    },
    /// A log has no pictures of cameras beside it.
    #[error(
        "{log} has no silhouettes beside it\n  hint: name the folder of a run whose home has cameras: sensors of kind \"camera\" in home.json"
    )]
    NoSilhouettes {
        /// The log's name.
        log: String,
    },
    /// A run was killed, or is being lived, and has not stored a row yet.
    #[error("the run in {} has no rows yet", folder.display())]
    NoRows {
        /// The run's folder.
        folder: PathBuf,
        /// The folder by which it can be gone on with: the run's, or that of its cohort.
        resume: PathBuf,
    },
    /// A folder is a cohort's, in which each member has a log of their own.
    #[error("{} is a cohort: each member has a log of their own\n  hint: {}", folder.display(), first_of(member.as_deref()))]
    IsCohort {
        /// The cohort's folder.
        folder: PathBuf,
        /// The first member who was lived.
        member: Option<PathBuf>,
    },
    /// No time zone has this name.
    #[error("{0}")]
    TimeZone(String),
    /// A run can not be this long.
    #[error("a run of {days} days is none\n  hint: it lasts longer than nothing, and at most a hundred years")]
    Length {
        /// How long it was to be, in days.
        days: f64,
    },
    /// Nobody of this name lives in the scenario.
    #[error("nobody called {name:?} lives there\n  hint: there are {}", known.join(", "))]
    Resident {
        /// Who was meant.
        name: String,
        /// Who lives there.
        known: Vec<String>,
    },
    /// A driver that a caller has brought decided what nobody can do.
    #[error("{why}")]
    Driver {
        /// Whom it moves.
        resident: String,
        /// What it did, when, and a hint.
        why: String,
        /// When, in microseconds since the run's start.
        at_us: Micros,
    },
    /// A log, the truth or a recording could not be written or read.
    #[error("{0}")]
    Log(#[source] BoxError),
    /// A run was stopped while it waited for a destination that is away: there it is not complete.
    #[error("{away}")]
    StoppedAway {
        /// Which it is, and why it was away.
        #[source]
        away: Box<LogError>,
        /// The folder in which the run can be gone on with, where there is one.
        folder: Option<PathBuf>,
    },
    /// A caller's own sink failed.
    #[error("a sink failed: {0}")]
    Sink(#[source] BoxError),
    /// There are no threads to live on.
    #[error("{}", no_thread("to live on", .0))]
    Threads(String),
}

fn folder_of(folder: Option<&Path>) -> String {
    match folder {
        Some(folder) => format!("\n  hint: name its folder, {}", folder.display()),
        None => ", and no run or cohort has left it\n  hint: name the folder of one".into(),
    }
}

fn were(residents: &[String]) -> String {
    format!("{} {}", residents.join(", "), if residents.len() == 1 { "was" } else { "were" })
}

fn where_to_begin(is_cohort: bool) -> &'static str {
    match is_cohort {
        true => "a cohort was begun there: go on with it, or name a new folder",
        false => "a cohort begins where nothing is: name a new folder, or an empty one",
    }
}

fn first_of(member: Option<&Path>) -> String {
    match member {
        Some(member) => format!("name one of them, such as {}", member.display()),
        None => "nobody of it has been lived".into(),
    }
}

impl Error {
    /// A file about which more can be said than the system says.
    pub(crate) fn file(path: &Path, why: impl Into<String>) -> Error {
        Error::File { path: path.into(), why: why.into(), source: None }
    }

    /// A file of which the system says what is wrong.
    pub(crate) fn io(path: &Path, error: io::Error) -> Error {
        Error::File { path: path.into(), why: error.to_string(), source: Some(error) }
    }

    /// The same error of a run that can be gone on with in this folder.
    pub(crate) fn of_run_in(self, folder: Option<PathBuf>) -> Error {
        let Error::Log(error) = self else { return self };
        match error.downcast::<LogError>() {
            Ok(away) if matches!(*away, LogError::StoppedAway { .. }) => Error::StoppedAway { away, folder },
            Ok(other) => Error::Log(other),
            Err(other) => Error::Log(other),
        }
    }
}

impl From<DriverError> for Error {
    fn from(error: DriverError) -> Error {
        Error::Driver { resident: error.resident.clone(), why: error.to_string(), at_us: error.at }
    }
}

impl From<LogError> for Error {
    fn from(error: LogError) -> Error {
        Error::Log(Box::new(error))
    }
}

impl From<Problem> for Error {
    fn from(problem: Problem) -> Error {
        Error::Problems(Problems(vec![problem]))
    }
}
