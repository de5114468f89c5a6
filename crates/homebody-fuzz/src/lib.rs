//! Hostile inputs for all that reads what anybody may have written, without end and always the same.
//!
//! A target is something that reads, with a corpus, a mutator and what holds of it always. A case is a target, a seed and a
//! number, which is all that it depends on. Cases are done in processes of their own, which a case may hang or kill; what
//! each took is measured.
//!
//! ```sh
//! cargo run --release -p homebody-fuzz
//! ```
//!
//! This crate does not know what a home or a log means; it knows what must hold of each. Reading order:

#![warn(missing_docs)]

/// What a target is.
pub mod target;
/// What is fuzzed.
pub mod targets;

mod dice;
mod corpus;
mod mutate;

mod memory;
/// One case, measured.
pub mod case;
/// The process that does cases.
pub mod worker;
/// The one that watches it.
pub mod supervise;
/// What became of all.
pub mod table;
