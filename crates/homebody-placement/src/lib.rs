//! Suggests where to mount the sensors of a home.
//!
//! People with and without health conditions are simulated in the home with every candidate sensor. Each layout of sensors is scored by
//! what its log alone tells of them. Nothing here reads or writes a file.

#![warn(missing_docs)]

/// How soon alerts find people with conditions.
pub mod adequacy;
/// The messages of this crate.
pub mod catalogue;
/// Simulated people with and without conditions.
pub mod people;
/// The suggested layout of a home.
pub mod proposal;
pub mod search;
/// Logs of simulated homes, with the ground truth.
pub mod simulated;
