//! A life in plain language, and the living of it.
//!
//! In reading order:

// What a routine says: habits, rules, changes.
pub mod routine;

// How text becomes a routine.
pub mod language;
pub mod explain;
pub mod completion;

// How a diary becomes text.
pub mod rhythm;

// The living of it, and everybody of a scenario who does.
pub mod living;
mod room_for;
mod needs_of_home;
pub mod household;
mod messages;

// The furniture that a home needs besides its own.
pub mod furnished;

// The messages of all of it.
pub mod catalogue;
