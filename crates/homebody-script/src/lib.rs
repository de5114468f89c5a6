//! Residents whose driver is a script in the scenario's folder, for decisions that routines cannot express.
//!
//! A script is asked for the next steps whenever the body is free, and answers in the words of [`vocabulary`]: go, sit,
//! use, wait. It sees the same surroundings as every driver and draws from named streams of the run's seed. It reads no
//! clock and no file, and its memory is copied with the driver. A script that does not end is stopped with a message.
//!
//! The language is [Rhai](https://rhai.rs). [`Program::read`] checks a text as far as possible before a run, and
//! [`ScriptDriver`] drives a resident by it. This crate knows no sensors, logs or files.

pub mod vocabulary;
mod step;

mod cast;
mod names;
mod moment;
mod engine;
mod check;
mod messages;
mod program;

mod driver;

pub use cast::Cast;
pub use driver::ScriptDriver;
pub use engine::{known_words, standard_functions};
pub use messages::ScriptMessage;
pub use names::ScriptNames;
pub use program::Program;
