//! Mutators, by the grammar of what they change.

pub mod bytes;
pub mod json;
pub mod markup;
pub mod numbers;
pub mod outlines;
pub mod sentences;
pub mod sql;
pub mod tables;
pub mod texts;
