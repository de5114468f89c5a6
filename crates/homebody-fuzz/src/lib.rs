//! Hostile inputs for every reader of foreign data: the targets, their seeds, the mutators and the limits of a case.
//!
//! `tests/targets.rs` runs them. proptest draws, repeats and shrinks the cases, and runs them in a child process, which a
//! case may hang or kill. This crate knows no homes and no logs, only the properties that must hold of each.

#![warn(missing_docs)]

/// One case, measured.
pub mod case;
/// Targets and their cases.
pub mod target;
/// The targets.
pub mod targets;

mod choices;
mod mutate;
mod seeds;
