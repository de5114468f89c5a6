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

mod alerting;
pub mod catalogue;
mod claims;
mod commands;
mod daily_life;
mod falls;
mod godsey2009;
mod locating;
mod measures;
mod messages;
mod possible;
mod recogniser;
mod round_trip;
mod sensor_faults;
mod simulated;
mod sphere;
mod statements;

pub use commands::{command, run};
