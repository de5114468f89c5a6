//! Suggests positions for the sensors of a home.
//!
//! People with and without health conditions are simulated in the home with every candidate sensor. Each layout of
//! sensors is scored by its log alone. This crate reads and writes no files.

pub mod adequacy;
pub mod catalogue;
pub mod people;
pub mod proposal;
pub mod search;
pub mod simulated;
