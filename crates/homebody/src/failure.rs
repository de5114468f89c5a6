//! Failures of commands: their messages and exit codes.

use homebody_core::drivers::error::DriverError;
use homebody_core::messages::Diagnose;
use homebody_core::problem::{Diagnostic, Problem, Problems};
use homebody_fleet::FleetError;
use homebody_life::{FreeTextError, ModelMessage};
use homebody_log::LogError;
use homebody_placement::people::PeopleError;
use homebody_query::QueryError;
use homebody_scaffold::ScaffoldError;
use homebody_simulation::SimulationError;
use homebody_tracking::TrackingError;
use std::fmt::Display;
use std::path::Path;

pub const EXIT_CODES: &str =
    "Exit codes: 0 success, 1 a file could not be read or written, 2 an argument or a file is invalid";

pub enum Failure {
    Problems(Problems),
    /// A message with a code, and the exit code.
    Coded(Box<Diagnostic>, u8),
    /// A signal ended the command early, which was printed; the exit code.
    Signal(u8),
}

impl Failure {
    /// A problem with the arguments or the input.
    pub fn asked(message: impl Diagnose) -> Failure {
        Failure::Coded(Box::new(message.diagnostic()), 2)
    }

    /// Several problems at once. A single one without a file is printed like any other message.
    pub fn all(problems: Vec<Diagnostic>) -> Failure {
        match &problems[..] {
            [only] if only.file.is_empty() => Failure::Coded(Box::new(only.clone()), 2),
            _ => Failure::Problems(Problems(problems)),
        }
    }

    /// Problems with arguments. A single one is printed like any other message.
    fn of_arguments(mut problems: Problems) -> Failure {
        match problems.0.pop() {
            Some(only) if problems.0.is_empty() => Failure::asked(only),
            last => Failure::Problems(Problems(problems.0.into_iter().chain(last).collect())),
        }
    }

    pub fn in_file(path: &Path, Problems(problems): Problems) -> Failure {
        let name = path.display().to_string();
        Failure::all(problems.into_iter().map(|problem| Problem::of_file(&name, problem, None)).collect())
    }

    pub fn advising(self, hint: &str) -> Failure {
        match self {
            Failure::Coded(message, code) => {
                Failure::Coded(Box::new(Diagnostic { hint: Some(hint.to_owned()), fix: None, ..*message }), code)
            }
            other => other,
        }
    }

    pub fn not_measured(why: impl Display) -> Failure {
        Failure::file(SimulationMessage::NotMeasured { why: why.to_string() })
    }

    /// A file that cannot be read or written.
    pub fn file(message: impl Diagnose) -> Failure {
        Failure::Coded(Box::new(message.diagnostic()), 1)
    }
}

homebody_core::messages! {
    /// Errors of commands that simulate people or homes to answer a question.
    pub enum SimulationMessage in "simulation" {
        /// Homebody simulates the first resident with and without conditions. A condition changes the sentences of a routine, so the
        /// resident needs one.
        NoRoutine error "no-routine" ("the first resident has no routine, so Homebody cannot simulate conditions")
            hint ("name a routine as \"driver\" of the first resident in the scenario");
        /// A simulated home has no log that can be measured, or a resident was asked to do something impossible.
        NotMeasured { why: String } error "not-measured" ("cannot simulate and measure a home: {why}");
        /// The simulation ended before its result was complete.
        Stopped error "stopped" ("the simulation was stopped before its end")
            hint ("run the command again");
    }
}

impl From<Problems> for Failure {
    fn from(problems: Problems) -> Failure {
        Failure::Problems(problems)
    }
}

impl From<PeopleError> for Failure {
    fn from(error: PeopleError) -> Failure {
        match error {
            PeopleError::Problems(problems) => Failure::Problems(problems),
            PeopleError::NoRoutine => Failure::asked(SimulationMessage::NoRoutine),
            PeopleError::Simulation(error) => Failure::not_measured(error),
            PeopleError::Stopped => Failure::file(SimulationMessage::Stopped),
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

impl From<SimulationError> for Failure {
    fn from(error: SimulationError) -> Failure {
        match error {
            SimulationError::Problems(problems) => Failure::Problems(problems),
            SimulationError::Log(error) => error.into(),
            SimulationError::File { .. }
            | SimulationError::Unreadable(_)
            | SimulationError::Exists { .. }
            | SimulationError::StoppedAway { .. }
            | SimulationError::NoRecording { .. }
            | SimulationError::NotBegun { .. }
            | SimulationError::NotFolder { .. }
            | SimulationError::NotEmpty { .. }
            | SimulationError::Threads { .. } => Failure::file(error),
            error => Failure::asked(error),
        }
    }
}

impl From<FreeTextError> for Failure {
    fn from(error: FreeTextError) -> Failure {
        match error {
            FreeTextError::Simulation(error) => error.into(),
            FreeTextError::Model(error @ (ModelMessage::BadUrl { .. } | ModelMessage::SeveralModels { .. })) => {
                Failure::asked(error)
            }
            FreeTextError::Model(error) => Failure::file(error),
            error => Failure::asked(error),
        }
    }
}

impl From<QueryError> for Failure {
    fn from(error: QueryError) -> Failure {
        match error {
            QueryError::Simulation(error) => error.into(),
            QueryError::NoRows { .. } | QueryError::NoLog { .. } => Failure::file(error),
            error => Failure::asked(error),
        }
    }
}

impl From<TrackingError> for Failure {
    fn from(error: TrackingError) -> Failure {
        match error {
            TrackingError::Simulation(error) => error.into(),
            TrackingError::Query(error) => error.into(),
            error => Failure::asked(error),
        }
    }
}

impl From<FleetError> for Failure {
    fn from(error: FleetError) -> Failure {
        match error {
            FleetError::Simulation(error) => error.into(),
            FleetError::Setup(problems) => Failure::of_arguments(problems),
            error => Failure::asked(error),
        }
    }
}

impl From<ScaffoldError> for Failure {
    fn from(error: ScaffoldError) -> Failure {
        match error {
            ScaffoldError::Simulation(error) => error.into(),
            ScaffoldError::Source(problems) => Failure::of_arguments(problems),
            error => Failure::asked(error),
        }
    }
}
