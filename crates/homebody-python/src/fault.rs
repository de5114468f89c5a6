//! Errors as exceptions of Python, whose classes are in `homebody.errors`.

use homebody_core::messages::Diagnose;
use homebody_core::problem::{Diagnostic, Problems};
use homebody_life::FreeTextError;
use homebody_query::QueryError;
use homebody_simulation::SimulationError;
use homebody_tracking::TrackingError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use serde::Serialize;
use std::fmt::Display;

/// The module of the exceptions.
const ERRORS: &str = "homebody.errors";

/// An error of the library.
pub trait LibraryError: Diagnose {
    /// The exception without its message.
    fn exception(self) -> PyErr;
}

/// An error of the library as an exception.
pub fn raised(error: impl LibraryError) -> PyErr {
    let message = error.diagnostic();
    let raised = error.exception();
    Python::attach(|py| match with_message(py, &raised, &message) {
        Ok(()) => raised,
        Err(error) => error,
    })
}

/// Gives an exception the code, the hint, the fix and the data of its message.
fn with_message(py: Python<'_>, raised: &PyErr, message: &Diagnostic) -> PyResult<()> {
    let value = raised.value(py);
    value.setattr("code", message.code)?;
    value.setattr("hint", &message.hint)?;
    value.setattr("fix", loaded(py, &message.fix)?)?;
    value.setattr("data", loaded(py, &message.data)?)
}

/// A value as dictionaries and lists.
fn loaded<'py>(py: Python<'py>, value: &impl Serialize) -> PyResult<Bound<'py, PyAny>> {
    py.import("json")?.call_method1("loads", (json(value)?,))
}

impl LibraryError for SimulationError {
    fn exception(self) -> PyErr {
        match self {
            SimulationError::Problems(problems) => with_problems(&problems),
            SimulationError::Length { .. }
            | SimulationError::Members { .. }
            | SimulationError::Resident { .. }
            | SimulationError::Template { .. } => named("ScenarioError", self),
            SimulationError::Driver { .. } => named("DriverError", self),
            SimulationError::Exists { .. } | SimulationError::NotEmpty { .. } => named("Exists", self),
            SimulationError::Cancelled => named("Stopped", self),
            SimulationError::File { .. }
            | SimulationError::Unreadable(_)
            | SimulationError::Log(_)
            | SimulationError::StoppedAway { .. }
            | SimulationError::NoRecording { .. }
            | SimulationError::OwnDrivers { .. }
            | SimulationError::NotFolder { .. } => named("LogError", self),
            error => named("HomebodyError", error),
        }
    }
}

impl LibraryError for FreeTextError {
    fn exception(self) -> PyErr {
        match self {
            FreeTextError::Simulation(error) => error.exception(),
            FreeTextError::NoResident { .. } | FreeTextError::UnknownResident { .. } => named("ScenarioError", self),
            FreeTextError::Model(_) | FreeTextError::NothingUsable { .. } => named("ModelError", self),
            error => named("HomebodyError", error),
        }
    }
}

impl LibraryError for QueryError {
    fn exception(self) -> PyErr {
        match self {
            QueryError::Simulation(error) => error.exception(),
            QueryError::TimeZone { .. } => named("ScenarioError", self),
            QueryError::NoLog { .. }
            | QueryError::NoSilhouettes { .. }
            | QueryError::IsCohort { .. }
            | QueryError::NoRows { .. } => named("LogError", self),
            error => named("HomebodyError", error),
        }
    }
}

impl LibraryError for TrackingError {
    fn exception(self) -> PyErr {
        match self {
            TrackingError::Simulation(error) => error.exception(),
            TrackingError::Query(error) => error.exception(),
            error => named("HomebodyError", error),
        }
    }
}

/// An exception by the name of its class, with its text.
pub fn named(class: &str, what: impl Display) -> PyErr {
    let what = what.to_string();
    Python::attach(|py| match py.import(ERRORS).and_then(|errors| errors.getattr(class)?.call1((what,))) {
        Ok(error) => PyErr::from_value(error),
        Err(error) => error,
    })
}

/// One exception with all problems: each with place, text, code, fix and data.
fn with_problems(problems: &Problems) -> PyErr {
    let raise = |py: Python<'_>| -> PyResult<PyErr> {
        let list = PyList::empty(py);
        let class = py.import(ERRORS)?.getattr("Problem")?;
        for problem in &problems.0 {
            let keys = PyDict::new(py);
            keys.set_item("file", &problem.file)?;
            keys.set_item("line", problem.line)?;
            keys.set_item("column", problem.column)?;
            keys.set_item("what", &problem.what)?;
            keys.set_item("hint", &problem.hint)?;
            keys.set_item("code", problem.code)?;
            keys.set_item("severity", problem.severity.word())?;
            keys.set_item("fix", loaded(py, &problem.fix)?)?;
            keys.set_item("data", loaded(py, &problem.data)?)?;
            list.append(class.call((), Some(&keys))?)?;
        }
        Ok(PyErr::from_value(py.import(ERRORS)?.getattr("ScenarioError")?.call1((problems.render(), list))?))
    };
    Python::attach(|py| raise(py).unwrap_or_else(|error| error))
}

/// A value as JSON.
pub fn json(value: &impl Serialize) -> PyResult<String> {
    serde_json::to_string(value).map_err(|error| named("HomebodyError", error))
}
