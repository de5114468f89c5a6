//! A line of a log that could not be understood.

use serde::Serialize;

/// A line that could not be understood.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Skipped {
    /// Counted from 1; in a database, the row.
    pub line: u64,
    /// What could not be understood, as a part of a sentence.
    pub why: String,
}
