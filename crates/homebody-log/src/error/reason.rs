//! A place together with the reason why it does not serve: the reason has a code, and the place is named once.

use homebody_core::messages::{Diagnose, Value};
use homebody_core::problem::{Diagnostic, readable};
use std::error::Error;
use std::fmt;

/// Why a place does not serve.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reason {
    /// The place: a file, a folder, or the URL of a server.
    pub place: String,
    /// The reason, as a part of a sentence, with its code.
    pub why: Box<Diagnostic>,
    about: ReasonTopic,
}

/// The sentence that a reason completes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ReasonTopic {
    Log,
    Truth,
    OtherTruth,
    Writing,
    Run,
    Holding,
    Place,
}

impl Reason {
    pub(crate) fn new(about: ReasonTopic, place: impl Into<String>, why: impl Into<Diagnostic>) -> Reason {
        let why = why.into();
        // It may quote what a file contains.
        let (what, hint) = (readable(why.what), why.hint.map(readable));
        Reason { place: place.into(), why: Box::new(Diagnostic { what, hint, ..why }), about }
    }
}

impl Diagnose for Reason {
    fn diagnostic(&self) -> Diagnostic {
        let Reason { place, why, about } = self;
        let what = match about {
            ReasonTopic::Log => format!("cannot read {place} as a log: {}", why.what),
            ReasonTopic::Truth => format!("{place} has no ground truth: {}", why.what),
            ReasonTopic::OtherTruth => format!("{place} is not the ground truth of this log: {}", why.what),
            ReasonTopic::Writing => format!("Homebody does not write {place}: {}", why.what),
            ReasonTopic::Run => format!("{place} is not the beginning of this run: {}", why.what),
            ReasonTopic::Holding => format!("{place} cannot hold {}", why.what),
            ReasonTopic::Place => format!("{place}: {}", why.what),
        };
        of_place(why, place, what)
    }
}

/// The same message about a place, in other words.
fn of_place(why: &Diagnostic, place: &str, what: String) -> Diagnostic {
    let mut data = why.data.clone();
    data.insert("place".into(), Value::from(place));
    Diagnostic { what, data, ..why.clone() }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.diagnostic().fmt(f)
    }
}

impl Error for Reason {}

homebody_core::messages! {
    /// The error of a destination that a program brings along.
    pub(crate) enum OwnMessage in "log" {
        /// A destination of another program reports an error, in words of its own.
        Destination {
            /// The destination's name.
            place: String,
            what: String,
        } error "destination" ("{place}: {what}");
    }
}

/// The error of a destination.
#[derive(Debug)]
pub struct DestinationError {
    /// The destination's name.
    pub place: String,
    /// The reason, as a part of a sentence.
    pub why: Box<Diagnostic>,
    /// Whether the same call may succeed a little later.
    pub passes: bool,
    /// The error that caused it.
    pub source: Option<Box<dyn Error + Send + Sync>>,
}

impl Diagnose for DestinationError {
    fn diagnostic(&self) -> Diagnostic {
        let DestinationError { place, why, .. } = self;
        let own = OwnMessage::Destination { place: place.clone(), what: why.what.clone() }.diagnostic();
        match why.code {
            "" => Diagnostic { hint: why.hint.clone(), ..own },
            _ => of_place(why, place, own.what),
        }
    }
}

impl fmt::Display for DestinationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.diagnostic().fmt(f)
    }
}

impl Error for DestinationError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        Some(self.source.as_deref()? as &(dyn Error + 'static))
    }
}
