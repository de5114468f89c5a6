//! Hostile inputs for every reader of foreign data: the targets, their seeds, the mutators and the limits of a case.
//!
//! `tests/targets.rs` runs them. proptest draws, repeats and shrinks the cases, and runs them in a child process, which
//! a case may hang or kill. The crate checks properties of homes and logs, not their content.

pub mod case;
pub mod target;
pub mod targets;

mod choices;
mod mutate;
mod seeds;
