//! Kinds of places whose sinks and forms are in crates of their own, which not every build has.
//!
//! A program that has them says so once, before all else, by [`install`]; from then on they are opened and read as all others are.

use crate::check::Examine;
use crate::fleet::FleetSink;
use crate::policy::Policy;
use crate::sink::{Begin, Sink, Watermark};
use crate::source::{Form, ReadTables};
use crate::table::Batch;
use crate::{LogError, Url};
use homebody_core::scenario::scheme::Scheme;
use homebody_core::time::Micros;
use std::sync::OnceLock;

/// What takes the rows of a fleet at a place.
pub type OpenFleet = fn(&Url) -> Box<dyn FleetSink>;

/// A kind of place that is in a crate of its own.
#[derive(Clone, Copy)]
pub struct Elsewhere {
    /// The kinds in `crates/homebody-core/src/scenario/scheme.rs` that it is about.
    pub schemes: &'static [Scheme],
    /// The sink of a place. Nothing is touched before it is begun.
    pub open: fn(&Url) -> Box<dyn Sink>,
    /// What takes the rows of a fleet at such a place; None where no fleet can write there.
    pub fleet: Option<OpenFleet>,
    /// How a destination of this kind is treated where nobody says otherwise.
    pub policy: fn() -> Policy,
    /// The forms in which it reads logs.
    pub forms: &'static [Form],
    /// What reads the tables of a truth there; None where no place of this kind keeps one.
    pub tables: Option<ReadTables>,
    /// The truth that such a place has of the run whose log is at the other; None where it has none, or cannot say.
    pub truth_of: Option<fn(&Url) -> Option<Url>>,
    /// What says what is wrong with such a place.
    pub examine: Examine,
}

static INSTALLED: OnceLock<Vec<Elsewhere>> = OnceLock::new();

/// Makes these kinds known, for the whole program. Only the first call does.
pub fn install(all: Vec<Elsewhere>) {
    let _ = INSTALLED.set(all);
}

/// Those that are known by now.
pub(crate) fn installed() -> &'static [Elsewhere] {
    INSTALLED.get().map(Vec::as_slice).unwrap_or_default()
}

/// The one of a kind of place.
pub(crate) fn of(scheme: Scheme) -> Option<&'static Elsewhere> {
    installed().iter().find(|elsewhere| elsewhere.schemes.contains(&scheme))
}

/// The usual policy of a place.
pub(crate) fn policy(url: &Url) -> Policy {
    let usual = if url.is_output() { Policy::of_server } else { Policy::default };
    of(url.scheme()).map_or_else(usual, |elsewhere| (elsewhere.policy)())
}

/// What stands where a kind is not in this build: to begin it is an error that says how to get it.
pub(crate) struct Absent(pub Url);

impl Sink for Absent {
    fn begin(&mut self, _: &Begin) -> Result<Watermark, LogError> {
        Err(not_built_in(&self.0))
    }

    fn write(&mut self, _: &Batch) -> Result<(), LogError> {
        Err(not_built_in(&self.0))
    }

    fn settle(&mut self) -> Result<Watermark, LogError> {
        Err(not_built_in(&self.0))
    }

    fn finish(&mut self, _: Micros) -> Result<(), LogError> {
        Err(not_built_in(&self.0))
    }
}

/// Says how to get a kind that is not in this build.
pub(crate) fn not_built_in(url: &Url) -> LogError {
    let row = url.scheme().row();
    LogError::NotBuiltIn { place: url.to_string(), name: row.name, feature: row.feature.unwrap_or(row.name) }
}
