//! Experiments that judge the claims of Homebody: each compares its results with published figures, with logs of real homes, or with the
//! ground truth of simulated homes.
//!
//! The installed program does not contain the experiments. The program `homebody-lab` runs them: [`run`].

/// Converts errors of other areas into that of an experiment.
macro_rules! from_errors {
    ($error:ident: $($variant:ident($inner:ty)),*) => {
        $(impl From<$inner> for $error {
            fn from(error: $inner) -> $error {
                $error::$variant(error)
            }
        })*
    };
}

pub mod catalogue;
mod commands;
mod messages;
mod simulated;

pub mod alerting;
pub mod claims;
pub mod daily_life;
pub mod falls;
pub mod godsey2009;
pub mod locating;
pub mod measures;
pub mod possible;
pub mod recogniser;
pub mod round_trip;
pub mod sensor_faults;
pub mod sphere;

pub use commands::{command, run};
