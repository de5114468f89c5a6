//! How a command fails: what people read, and the exit code that scripts read.

use homebody_core::drivers::error::DriverError;
use homebody_core::messages::Diagnose;
use homebody_core::problem::{Diagnostic, Problems};
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
    /// Problems with what the user wrote.
    Problems(Problems),
    /// A problem with what the user asked for.
    Usage(String),
    /// A file cannot be read or written.
    Io(String),
    /// A message with a code, and the exit code.
    Coded(Box<Diagnostic>, u8),
    /// A signal ended the command early, which was printed; the exit code.
    Signal(u8),
}

impl Failure {
    /// A file that cannot be read or written.
    pub fn io(path: &Path, error: impl Display) -> Failure {
        Failure::Io(format!("{}: {error}", path.display()))
    }

    /// A problem with what the user asked for.
    pub fn usage(what: impl Display) -> Failure {
        Failure::Usage(what.to_string())
    }

    /// A problem with what the user asked for, by its message.
    pub fn asked(message: impl Diagnose) -> Failure {
        Failure::Coded(Box::new(message.diagnostic()), 2)
    }

    /// The same failure with another hint.
    pub fn advising(self, hint: &str) -> Failure {
        match self {
            Failure::Coded(message, code) => {
                Failure::Coded(Box::new(Diagnostic { hint: Some(hint.to_owned()), fix: None, ..*message }), code)
            }
            other => other,
        }
    }

    /// A file that cannot be read or written, by its message.
    pub fn file(message: impl Diagnose) -> Failure {
        Failure::Coded(Box::new(message.diagnostic()), 1)
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
        Failure::asked(error)
    }
}

impl From<LogError> for Failure {
    fn from(error: LogError) -> Failure {
        match error {
            LogError::BadUrl(problems) | LogError::NoMapping(problems) | LogError::SensorMap(problems) => {
                Failure::Problems(problems)
            }
            LogError::Name { .. }
            | LogError::SameName { .. }
            | LogError::SameSensor { .. }
            | LogError::SameFile { .. }
            | LogError::NoLog(_)
            | LogError::NoTables { .. }
            | LogError::TooLong(_)
            | LogError::NoPlace(_)
            | LogError::NotBuiltIn { .. }
            | LogError::Zone { .. } => Failure::asked(error),
            error => Failure::file(error),
        }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Failure {
        match error {
            Error::Problems(problems) => Failure::Problems(problems),
            Error::Unbeginnable(mut problems) | Error::Fleet(mut problems) => match problems.0.pop() {
                Some(only) if problems.0.is_empty() => Failure::asked(only),
                last => Failure::Problems(Problems(problems.0.into_iter().chain(last).collect())),
            },
            Error::Log(error) => match error.0.downcast::<LogError>() {
                Ok(error) => (*error).into(),
                Err(error) => Failure::Io(error.to_string()),
            },
            Error::NoRows { .. }
            | Error::File { .. }
            | Error::Unreadable(_)
            | Error::Exists { .. }
            | Error::StoppedAway { .. }
            | Error::NoLog { .. }
            | Error::NoRecording { .. }
            | Error::NotBegun { .. }
            | Error::NotFolder { .. }
            | Error::NotEmpty { .. }
            | Error::Threads { .. } => Failure::file(error),
            error => Failure::asked(error),
        }
    }
}
