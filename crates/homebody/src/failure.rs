//! How a command fails: what people read, and the exit code that scripts read.

use homebody_core::drivers::error::DriverError;
use homebody_core::problem::Problems;
use homebody_experiment::people::NotLived;
use homebody_kit::Error;
use homebody_log::LogError;
use std::fmt::Display;
use std::path::Path;

/// The exit codes of every command.
pub const EXIT_CODES: &str =
    "Exit codes: 0 success, 1 a file could not be read or written, 2 an argument or a file is invalid";

/// Why a command ended early.
pub enum Failure {
    /// What the user wrote is wrong.
    Problems(Problems),
    /// What the user asked is wrong.
    Usage(String),
    /// A file could not be read or written.
    Io(String),
    /// A signal has ended it early, which was told; this is the exit code.
    Signal(u8),
}

impl Failure {
    /// A file that could not be read or written.
    pub fn io(path: &Path, error: impl Display) -> Failure {
        Failure::Io(format!("{}: {error}", path.display()))
    }

    pub fn usage(what: impl Display) -> Failure {
        Failure::Usage(what.to_string())
    }
}

impl From<Problems> for Failure {
    fn from(problems: Problems) -> Failure {
        Failure::Problems(problems)
    }
}

impl From<NotLived> for Failure {
    fn from(error: NotLived) -> Failure {
        match error {
            NotLived::Problems(problems) => Failure::Problems(problems),
            NotLived::NoRoutine => Failure::usage(error),
            NotLived::NotMeasured(_) | NotLived::Stopped => Failure::Io(error.to_string()),
        }
    }
}

impl From<DriverError> for Failure {
    fn from(error: DriverError) -> Failure {
        Failure::Usage(error.to_string())
    }
}

impl From<LogError> for Failure {
    fn from(error: LogError) -> Failure {
        match error {
            LogError::Name { .. }
            | LogError::SameName { .. }
            | LogError::SameSensor { .. }
            | LogError::SameFile { .. }
            | LogError::NoMapping { .. }
            | LogError::SensorMap { .. }
            | LogError::NoLog { .. }
            | LogError::NoTables { .. }
            | LogError::TooLong { .. }
            | LogError::NoPlace(_)
            | LogError::NotBuiltIn { .. }
            | LogError::Zone(_) => Failure::Usage(error.to_string()),
            LogError::Unmade { .. } => Failure::Io(format!("{error}; --out selects another place")),
            LogError::Exists { place } => Failure::Io(format!("{place} exists already\n  hint: --force replaces it")),
            error => Failure::Io(error.to_string()),
        }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Failure {
        match error {
            Error::Problems(problems) => Failure::Problems(problems),
            Error::Log(error) => match error.downcast::<LogError>() {
                Ok(error) => (*error).into(),
                Err(error) => Failure::Io(error.to_string()),
            },
            Error::NoRows { ref resume, .. } => Failure::Io(format!(
                "{error}\n  hint: homebody run --resume {} resumes it, unless another process simulates it now",
                resume.display()
            )),
            Error::File { .. }
            | Error::Exists { .. }
            | Error::StoppedAway { .. }
            | Error::NoLog { .. }
            | Error::NoRecording { .. }
            | Error::NotBegun { .. }
            | Error::NotFolder { .. }
            | Error::NotEmpty { .. }
            | Error::Threads(_) => Failure::Io(error.to_string()),
            error => Failure::usage(error),
        }
    }
}
