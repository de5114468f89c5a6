//! How a body gets from place to place. In reading order:

// What a way becomes when somebody walks it.
pub mod gait;

// What kind of travel it is.
pub mod pattern;

pub use gait::{Gait, rise, sit, walk};
pub use pattern::{Pattern, pattern_of};
