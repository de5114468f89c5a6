//! A life in plain language, and the living of it.
//!
//! In reading order:

// How a body gets from place to place: paths with clearance, gait, and what disturbs both.
pub mod walk;
