//! What was measured in the real world, done again with simulated homes and lives.
//!
//! Nothing here reads or writes a file: scenarios and the texts of recordings come in, figures and pictures go out.

/// The messages of this crate.
pub mod catalogue;

/// The walks of Godsey & Skubic (2009) past a motion sensor.
pub mod godsey2009;

/// The recordings of the SPHERE challenge, acted out again.
pub mod sphere;

/// Generated lives beside what was measured of real ones.
pub mod daily_life;

/// What is said is lived, or told before the run.
pub mod claims;
/// Lives in which nothing happens that cannot be.
pub mod possible;
/// How soon alerts come, and how often for nothing.
pub mod alerting;
/// Measures of days, by the logs of homes alone.
pub mod measures;

/// People who differ, with conditions and without, who live in one home.
pub mod people;

pub mod placing;
pub mod proposal;

pub mod falls;

pub mod round_trip;
/// What is wrong with sensors, by the logs of their homes alone.
pub mod sensor_health;
/// Where people were, by the logs of their homes alone.
pub mod walk_back;
/// Activities in a real home, recognised after having learnt from simulated days.
pub mod recogniser;
