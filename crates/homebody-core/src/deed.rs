//! What may be done to a home from outside, and when: plain data, in the words of a recording.

use crate::time::{RunTime, Span};
use serde::{Deserialize, Serialize};

/// Something that is done from outside, and when.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FromOutside {
    /// When.
    pub at_us: RunTime,
    /// What is done.
    pub deed: Deed,
}

/// What is done from outside.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "do", rename_all = "snake_case", deny_unknown_fields)]
pub enum Deed {
    /// A thing is opened, closed, turned on or off.
    Use {
        /// Its name.
        thing: String,
        /// How it is afterwards: open or on, or closed or off.
        on: bool,
    },
    /// A sensor fails.
    Fail {
        /// Its name in the home.
        sensor: String,
        /// How.
        failure: SensorFailure,
        /// Until when; None for the rest of the run.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        until_us: Option<RunTime>,
    },
    /// Somebody falls where they are.
    Fall {
        /// Their name.
        resident: String,
        /// How long they lie before they get up.
        lies_us: Span,
    },
}

/// How a sensor fails, as the faults of a link file have it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum SensorFailure {
    /// Its battery fades for so long, and is empty then.
    Battery {
        /// How long; 0 where it is empty at once.
        fades_us: Span,
    },
    /// It hears nothing, and repeats itself or is silent.
    Stuck {
        /// How often it says again what it said last; None where it is silent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        every_us: Option<Span>,
    },
    /// It comes off its place, and sees nothing real.
    FallsOff,
    /// So many of a million of its messages are lost on the way.
    BadLink {
        /// How many.
        lost_ppm: u32,
    },
}

impl Deed {
    /// What it is, in a word.
    pub fn word(&self) -> &'static str {
        match self {
            Deed::Use { on: true, .. } => "on",
            Deed::Use { on: false, .. } => "off",
            Deed::Fail { failure, .. } => failure.word(),
            Deed::Fall { .. } => "fall",
        }
    }
}

impl SensorFailure {
    /// What it is, in a word, as link files have it.
    pub fn word(self) -> &'static str {
        match self {
            SensorFailure::Battery { .. } => "battery",
            SensorFailure::Stuck { .. } => "stuck",
            SensorFailure::FallsOff => "falls_off",
            SensorFailure::BadLink { .. } => "bad_link",
        }
    }
}
