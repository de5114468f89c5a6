//! Interventions in a home from outside, and their times, as plain data in the form of a recording.

use crate::time::{RunTime, Span};
use serde::{Deserialize, Serialize};

/// An intervention and its instant.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TimedIntervention {
    /// The instant.
    pub at_us: RunTime,
    /// The intervention.
    #[serde(rename = "deed")]
    pub intervention: Intervention,
}

/// An intervention from outside.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "do", rename_all = "snake_case", deny_unknown_fields)]
pub enum Intervention {
    /// A thing is opened, closed, turned on or off.
    Use {
        /// Its name.
        thing: String,
        /// The state afterwards: open or on, or closed or off.
        on: bool,
    },
    /// A sensor fails.
    Fail {
        /// Its name in the home.
        sensor: String,
        /// The kind of failure.
        failure: SensorFailure,
        /// The end; `None` for the rest of the run.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        until_us: Option<RunTime>,
    },
    /// A resident falls on the spot.
    Fall {
        /// Their name.
        resident: String,
        /// The time on the floor before they get up.
        lies_us: Span,
    },
}

/// A failure of a sensor. The faults of a link file have the same names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum SensorFailure {
    /// Its battery fades, and is empty then.
    Battery {
        /// The duration of the fading; 0 if it is empty at once.
        fades_us: Span,
    },
    /// It detects nothing, and repeats itself or is silent.
    Stuck {
        /// The interval at which it repeats its last message; `None` if it is silent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        every_us: Option<Span>,
    },
    /// It comes off its place, and sees nothing real.
    FallsOff,
    /// A share of its messages is lost on the way.
    BadLink {
        /// The number of lost messages in a million.
        lost_ppm: u32,
    },
}

impl Intervention {
    /// The name in the truth.
    pub fn word(&self) -> &'static str {
        match self {
            Intervention::Use { on: true, .. } => "on",
            Intervention::Use { on: false, .. } => "off",
            Intervention::Fail { failure, .. } => failure.word(),
            Intervention::Fall { .. } => "fall",
        }
    }
}

impl SensorFailure {
    /// The name in link files.
    pub fn word(self) -> &'static str {
        match self {
            SensorFailure::Battery { .. } => "battery",
            SensorFailure::Stuck { .. } => "stuck",
            SensorFailure::FallsOff => "falls_off",
            SensorFailure::BadLink { .. } => "bad_link",
        }
    }
}
