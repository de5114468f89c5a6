//! A line of a log that could not be understood.

use homebody_core::messages::Datum;
use serde::Serialize;
use serde_json::{Value, json};

/// A line that could not be understood.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Skipped {
    /// Counted from 1; in a database, the row.
    pub line: u64,
    /// Its file next to the log, if it is not in the log itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beside: Option<String>,
    /// The problem, as a part of a sentence.
    pub why: String,
}

impl Skipped {
    /// File and line, of a log that is called so.
    pub fn place(&self, log: &str) -> String {
        format!("{}:{}", self.beside.as_deref().unwrap_or(log), self.line)
    }
}

impl Datum for Skipped {
    fn datum(&self) -> Value {
        json!(self)
    }
}
