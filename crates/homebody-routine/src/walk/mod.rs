//! How a body gets from place to place. In reading order:

// Where it can walk, the shortest ways, and those found before.
pub mod mesh;
pub mod routes;

// What a way becomes when somebody walks it, or wanders without one.
pub mod gait;
pub mod schemas;

// What kind of travel it is.
pub mod pattern;

#[cfg(test)]
mod homes;

pub use gait::{Gait, rise, sit, walk};
pub use mesh::Mesh;
pub use pattern::{Pattern, pattern_of};
pub use routes::Routes;
pub use schemas::{Wandering, wander};
