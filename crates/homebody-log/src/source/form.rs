//! What a form of logs is: how it is known, and what reads it.

use super::reading::Reading;
use super::start::Start;
use crate::error::LogError;
use homebody_core::scenario::logger::LoggerFile;
use std::fmt;
use std::path::Path;

/// A form in which logs are found.
pub struct Form {
    /// What stands before the colon where somebody names it, such as `casas`.
    pub name: &'static str,
    /// What it is, in words.
    pub what: &'static str,
    /// What the beginning of a file shows of it.
    pub shows: fn(&Start) -> Shows,
    /// Reads a log of this form row by row, from its file or from what a server is reached by.
    pub read: fn(&Path, &LoggerFile, &mut Reading<'_>) -> Result<(), LogError>,
}

/// What the beginning of a file shows of a form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shows {
    /// It is of another form.
    Nothing,
    /// It tells what somebody did, and nothing of sensors.
    Activities,
    /// It tells what sensors said.
    Rows,
}

impl Shows {
    /// Rows where this holds.
    pub fn rows_if(is_so: bool) -> Shows {
        if is_so { Shows::Rows } else { Shows::Nothing }
    }
}

impl PartialEq for Form {
    fn eq(&self, other: &Form) -> bool {
        self.name == other.name
    }
}

impl Eq for Form {}

impl fmt::Debug for Form {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.name)
    }
}
