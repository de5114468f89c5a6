//! Routines: habits, rules and changes in plain language, and the driver that acts on them.

pub mod routine;

pub mod language;
pub use language::statement;
pub mod explain;
pub mod completion;

pub mod rhythm;

pub mod behaviour;
mod room_for;
mod needs_of_home;
pub mod household;
mod messages;

pub mod furniture;

pub mod catalogue;
