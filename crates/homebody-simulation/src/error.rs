//! Errors of scenarios, runs and cohorts.

use crate::VERSION;
use crate::limits::MOST_MEMBERS;
use homebody_core::drivers::error::DriverError;
use homebody_core::messages::Diagnose;
use homebody_core::problem::{Diagnostic, Problem, Problems};
use homebody_core::time::RunTime;
use homebody_log::LogError;
use std::io;
use std::path::{Path, PathBuf};

/// An error of the caller's own code.
pub type BoxError = Box<dyn std::error::Error + Send + Sync>;

homebody_core::messages! {
    /// Errors of scenarios, runs and cohorts.
    #[non_exhaustive]
    pub enum SimulationError in "kit" {
        /// A file or folder cannot be read or written.
        File { path: PathBuf, why: String, source: Option<io::Error> } error "file" ("{}: {why}", path.display())
            cause (source.as_ref().map(|source| source as _));
        /// Homebody comes with some example scenarios, which are templates of new ones. None has this name.
        Template { name: String, known: Vec<String> } error "no-template" ("no template is called {name:?}")
            hint ("the templates are {}", known.join(", "));
        /// The command creates a folder, and something with this name exists.
        Exists { path: PathBuf } error "exists" ("{} already exists", path.display())
            hint ("choose the name of a new folder");
        /// No recording exists at this path.
        NoRecording { path: PathBuf } error "no-recording" ("no recording found at {}", path.display())
            hint ("name the recording.json of a run, or the run's folder");
        /// The run or cohort was killed in its first moment, before its recording was written.
        NotBegun { folder: PathBuf } error "nothing-to-resume"
            ("the run in {} ended before Homebody stored any data", folder.display())
            hint ("delete the folder, and start the run again");
        /// The file is not the recording of a run.
        Recording { path: PathBuf, why: String } error "not-a-recording"
            ("{} is not a recording: {why}", path.display())
            hint ("name the recording.json of a run");
        /// The run has not ended, or was killed, so its recording has no digest of the whole run.
        Incomplete {
            path: PathBuf,
            /// The folder to resume: the run's own or its cohort's.
            folder: Option<PathBuf>,
        } error "incomplete-run" ("the run of {} is not complete", path.display())
            advice (Some(match folder {
                Some(folder) => format!("resume the run with homebody run --resume {}, and then replay it", folder.display()),
                None => "name the recording of a complete run".into(),
            }));
        /// A driver of another program moved a resident in this run. The recording does not contain that driver.
        OwnDrivers { path: PathBuf, residents: Vec<String> } error "own-driver"
            ("cannot replay {}: a driver of another program moved {}", path.display(), residents.join(", "))
            hint ("you can still read, draw and compare the run's files; to replay the run, use the program that contains the driver");
        /// A file has the place of the folder of a run or a cohort.
        NotFolder { path: PathBuf, folder: Option<PathBuf> } error "not-a-folder"
            ("{} is a file, and a folder was expected", path.display())
            advice (Some(match folder {
                Some(folder) => format!("name its folder, {}", folder.display()),
                None => "name the folder of a run or a cohort".into(),
            }));
        /// The folder of a cohort's member holds something else.
        Member { folder: PathBuf, why: String } error "foreign-member" ("{why}")
            hint ("move {} away; then Homebody simulates this member again", folder.display());
        /// A cohort starts in an empty folder.
        NotEmpty { folder: PathBuf, file: String, is_cohort: bool } error "not-empty"
            ("{} already contains {file}", folder.display())
            advice (Some(match is_cohort {
                true => "resume the cohort that is there, or name a new folder",
                false => "name a new or an empty folder",
            }));
        /// The number of members is out of range.
        Members { count: u32 } error "cohort-size" ("a cohort cannot have {count} members")
            hint ("choose 1 to {MOST_MEMBERS}");
        /// The run or cohort is complete. There is nothing to resume.
        Complete { what: &'static str, folder: PathBuf } error "complete"
            ("the {what} in {} is complete: there is nothing to resume", folder.display());
        /// Another version of the program started the run, and may simulate it differently.
        OtherVersion { what: &'static str, folder: PathBuf, version: String } error "other-version"
            ("version {version} started the {what} in {}, and this is version {VERSION}", folder.display())
            hint ("resume the {what} with that version, or start a new {what}");
        /// The work was stopped by the caller.
        Cancelled error "cancelled" ("the work was cancelled");
        /// The duration is out of range.
        Length { days: f64 } error "duration" ("a run cannot last {days} days")
            hint ("choose more than 0 days and at most 100 years");
        /// No resident has this name.
        Resident { name: String, known: Vec<String> } error "no-resident" ("no resident is called {name:?}")
            hint ("the residents are {}", known.join(", "));
        /// A driver of the caller's own made a decision that is not possible.
        Driver { resident: String, why: String, at_us: RunTime } error "driver" ("{why}");
        /// The run was stopped while it waited for a destination, so the log there is not complete.
        StoppedAway { away: Box<LogError>, folder: Option<PathBuf> } error "stopped-away"
            ("{away}") cause (Some(away.as_ref()));
        /// A destination of the caller's own failed.
        Sink { source: BoxError } error "sink" ("a destination failed: {source}") cause (Some(source.as_ref()));
        /// The system gives the program no threads.
        Threads { why: String } error "no-threads" ("cannot start threads for the simulation: {why}")
            hint ("raise this user's limits on threads or memory, or run fewer simulations at once");
        => inner {
            /// All problems of all files, each with its place and a hint.
            Problems(Problems);
            /// A file cannot be read, or is not of the expected kind.
            Unreadable(Diagnostic);
            /// A log, the ground truth or a recording cannot be written or read.
            Log(LogError);
        }
    }
}

impl SimulationError {
    /// An error of a file, with the reason in words.
    pub fn file(path: &Path, why: impl Into<String>) -> SimulationError {
        SimulationError::File { path: path.into(), why: why.into(), source: None }
    }

    /// An error of a file that a message explains.
    pub fn unreadable(path: &Path, message: impl Into<Diagnostic>) -> SimulationError {
        SimulationError::Unreadable(Diagnostic::of_file(&path.display().to_string(), message, None))
    }

    /// An error of the system about a file.
    pub fn io(path: &Path, error: io::Error) -> SimulationError {
        SimulationError::File { path: path.into(), why: error.to_string(), source: Some(error) }
    }

    /// The same error of a run that can be resumed in this folder.
    pub fn resumable_in(self, folder: Option<PathBuf>) -> SimulationError {
        match self {
            SimulationError::Log(away @ LogError::StoppedAway { .. }) => {
                SimulationError::StoppedAway { away: Box::new(away), folder }
            }
            other => other,
        }
    }
}

/// A failed step.
#[derive(Debug)]
pub enum StepError {
    /// A driver made a decision that is not possible.
    Driver(DriverError),
    /// A destination failed.
    Log(LogError),
}

impl Diagnose for StepError {
    fn diagnostic(&self) -> Diagnostic {
        match self {
            StepError::Driver(error) => error.diagnostic(),
            StepError::Log(error) => error.diagnostic(),
        }
    }
}

impl From<DriverError> for SimulationError {
    fn from(error: DriverError) -> SimulationError {
        SimulationError::Driver { resident: error.resident.clone(), why: error.to_string(), at_us: error.at }
    }
}

impl From<LogError> for SimulationError {
    fn from(error: LogError) -> SimulationError {
        SimulationError::Log(error)
    }
}

impl From<Problems> for SimulationError {
    fn from(problems: Problems) -> SimulationError {
        SimulationError::Problems(problems)
    }
}

impl From<StepError> for SimulationError {
    fn from(error: StepError) -> SimulationError {
        match error {
            StepError::Driver(error) => error.into(),
            StepError::Log(error) => error.into(),
        }
    }
}

impl From<Problem> for SimulationError {
    fn from(problem: Problem) -> SimulationError {
        SimulationError::Problems(Problems(vec![problem]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::error::Error as _;

    #[test]
    fn an_error_of_a_file_has_the_error_of_the_system_as_its_source() {
        assert!(SimulationError::io(Path::new("a"), io::ErrorKind::NotFound.into()).source().is_some());
        assert!(SimulationError::file(Path::new("a"), "it is empty").source().is_none());
        let error = LogError::destination("mine", "it failed").caused_by("the third is too many");
        assert_eq!(error.source().map(ToString::to_string).as_deref(), Some("the third is too many"));
    }
}
