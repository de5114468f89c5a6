//! Experiments that judge the claims of Homebody: each compares its results with published figures, with logs of real homes, or with the
//! ground truth of simulated homes.
//!
//! The experiments are no part of the program that users install. The program `homebody-lab` runs them: [`run`].

/// The messages of this crate.
pub mod catalogue;
mod commands;
mod messages;

/// The quality of alerts of a condition.
pub mod alerting;
/// Sentences of routines, and what must be true in their simulation.
pub mod claims;
/// Simulated days beside published figures.
pub mod daily_life;
pub mod falls;
/// The walks of Godsey & Skubic (2009) past a motion sensor.
pub mod godsey2009;
/// People located from the logs of their homes alone.
pub mod locating;
/// Measures of days from logs, beside the true ones.
pub mod measures;
/// Events that no simulation may have.
pub mod possible;
/// Activities in a real home, recognised after training on simulated days.
pub mod recogniser;
pub mod round_trip;
/// Sensor faults found in the logs of homes alone.
pub mod sensor_faults;
/// The recordings of the SPHERE challenge, simulated again.
pub mod sphere;

pub use commands::{command, run};
