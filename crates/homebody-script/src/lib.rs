//! Residents whose driver is a script in the scenario's folder, for what the language of routines cannot say.
//!
//! A script is asked what comes next whenever the body is free. It answers in the words of [`vocabulary`]: go, sit, use,
//! wait. What it sees is what every driver sees; what it draws, it draws from named streams of the run's seed. It reads no
//! clock and no file, and what it remembers is copied with the driver. One that runs away is stopped with a message.
//!
//! The language is [Rhai](https://rhai.rs). [`Program::read`] checks a text as far as that can be done before a run, and
//! [`ScriptDriver`] lives by it. This crate knows no sensors, logs or files.

#![warn(missing_docs)]

// What can be said, and what each word wants.
pub mod vocabulary;
mod step;

// What a script is asked with, and how it is read and asked.
mod cast;
mod names;
mod moment;
mod engine;
mod check;
mod messages;
mod program;

// Who lives by it.
mod driver;

pub use cast::Cast;
pub use driver::ScriptDriver;
pub use engine::{known_words, standard_functions};
pub use messages::ScriptMessage;
pub use names::Names;
pub use program::Program;
