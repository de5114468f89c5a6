//! What goes wrong, as Python's exceptions: `homebody.errors` has their classes.

use homebody_core::messages::Diagnose;
use homebody_core::problem::{Diagnostic, Problems};
use homebody_kit::Error;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use serde::Serialize;
use std::fmt::Display;

/// The module of the exceptions.
const ERRORS: &str = "homebody.errors";

/// An error of the library, as Python raises it.
pub fn raised(error: Error) -> PyErr {
    let message = error.diagnostic();
    let raised = of_class(error);
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

fn of_class(error: Error) -> PyErr {
    match error {
        Error::Problems(problems) => with_problems(&problems),
        Error::TimeZone { .. }
        | Error::Length { .. }
        | Error::Members { .. }
        | Error::Resident { .. }
        | Error::Template { .. } => named("ScenarioError", error),
        Error::Driver { .. } => named("DriverError", error),
        Error::Exists { .. } | Error::NotEmpty { .. } => named("Exists", error),
        Error::Cancelled => named("Stopped", error),
        Error::File { .. }
        | Error::Unreadable(_)
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

/// One exception with all problems: each with its place, its words, its code, its fix and its data.
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
