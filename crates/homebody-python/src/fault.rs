//! What goes wrong, as Python's exceptions: `homebody.errors` has their classes.

use homebody_core::problem::Problems;
use homebody_kit::Error;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use serde::Serialize;
use std::fmt::Display;

/// The module of the exceptions.
const ERRORS: &str = "homebody.errors";

/// An error of the library, as Python raises it.
pub fn raised(error: Error) -> PyErr {
    match error {
        Error::Problems(problems) => with_problems(&problems),
        Error::TimeZone(_)
        | Error::Length { .. }
        | Error::Members { .. }
        | Error::Resident { .. }
        | Error::Template { .. } => named("ScenarioError", error),
        Error::Driver { .. } => named("DriverError", error),
        Error::Exists { .. } | Error::NotEmpty { .. } => named("Exists", error),
        Error::Cancelled => named("Stopped", error),
        Error::File { .. }
        | Error::Log(_)
        | Error::StoppedAway { .. }
        | Error::NoLog { .. }
        | Error::NoSilhouettes { .. }
        | Error::NoRecording { .. }
        | Error::OwnDrivers { .. }
        | Error::NotFolder { .. }
        | Error::IsCohort { .. }
        | Error::NoRows { .. } => named("LogError", error),
        error => named("HomebodyError", error),
    }
}

/// An exception by the name of its class, with what is wrong as its text.
pub fn named(class: &str, what: impl Display) -> PyErr {
    let what = what.to_string();
    Python::attach(|py| match py.import(ERRORS).and_then(|errors| errors.getattr(class)?.call1((what,))) {
        Ok(error) => PyErr::from_value(error),
        Err(error) => error,
    })
}

/// One exception with all problems: file, line, column, what, hint.
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
