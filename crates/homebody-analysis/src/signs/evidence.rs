//! The kind that a sensor is taken for, and the evidence.

use homebody_core::sensed::Kind;
use serde::Serialize;

/// Evidence for the kind of a sensor, the best first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Evidence {
    /// The table of the log's sensors.
    Table,
    /// The log's source.
    Source,
    /// The home that the log is of.
    Home,
    /// Values that no other kind has.
    Values,
    /// Its name or its id.
    Name,
    /// A guess by the time that it is on.
    Guess,
}

/// The kind of a sensor, and the evidence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Classification {
    pub kind: Kind,
    pub by: Evidence,
    /// The evidence in words.
    pub because: String,
}

impl Classification {
    pub(super) fn new(kind: Kind, by: Evidence, because: impl Into<String>) -> Classification {
        Classification { kind, by, because: because.into() }
    }
}
