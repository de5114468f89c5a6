//! The kind that a sensor is taken for, and the evidence.

use homebody_core::sensed::Kind;
use serde::Serialize;

/// Evidence for the kind of a sensor, the best first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Evidence {
    Table,
    Source,
    Home,
    /// Values that no other kind has.
    Values,
    Name,
    Guess,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Classification {
    pub kind: Kind,
    pub by: Evidence,
    pub because: String,
}

impl Classification {
    pub(super) fn new(kind: Kind, by: Evidence, because: impl Into<String>) -> Classification {
        Classification { kind, by, because: because.into() }
    }
}
