//! Movements of a body from place to place in a home.
//!
//! [`Mesh`] holds the floor for a body of one radius and finds the shortest ways, [`Routes`] remembers them; [`walk`]
//! turns a way into strides and turns of a [`Gait`], [`rise`] and [`sit`] lead out of seats and into them. Patterns of wandering
//! need no goal. All of them return [`MotionSegment`]s that follow each other in time and place, for a driver to pass
//! on.
//!
//! Lengths are metres in the plane of the home, instants are run time. Functions return `None` without a route. The
//! crate is as pure as the core: the same home, ends and stream give the same walk on every machine. It does not know
//! the walker, the purpose, or the sensors.
//!
//! ```
//! use homebody_core::geometry::Point;
//! use homebody_core::plan::Plan;
//! use homebody_core::numbers::Numbers;
//! use homebody_core::random::Stream;
//! use homebody_core::time::RunTime;
//! use homebody_walk::{Gait, Mesh, walk};
//!
//! let home = r#"{
//!     "name": "one room",
//!     "rooms": [{ "name": "room", "outline": [[0, 0], [4, 0], [4, 3], [0, 3]] }],
//!     "walls": [],
//!     "furniture": [{ "name": "table", "at": [2, 1], "size_m": [0.8, 1.8], "height_m": 0.7 }]
//! }"#;
//! let mesh = Mesh::new(&Plan::new(&serde_json::from_str(home)?), 0.22);
//! let (from, to) = (Point::new(0.5, 0.5), Point::new(3.5, 0.5));
//! let path = mesh.path(from, to).expect("the table leaves a way");
//! assert!(path.len() > 1, "around the table");
//!
//! let gait = Gait::for_walk(0.65, 9.0, 0.0, &Numbers::default(), &mut Stream::named(1, "gait"));
//! let segments = walk(&path, from, RunTime::START, &gait);
//! assert!(segments.windows(2).all(|pair| pair[0].end == pair[1].begin));
//!
//! assert_eq!(mesh.path(from, Point::new(9.0, 9.0)), None, "out of doors");
//! # Ok::<(), serde_json::Error>(())
//! ```
//!
//! [`MotionSegment`]: homebody_core::motion::MotionSegment

mod mesh;
mod routes;

mod gait;
mod schemas;

mod pattern;

pub mod places;
pub mod stations;
mod standing;
pub mod manner;
pub mod body;

#[cfg(test)]
mod homes;

use homebody_core::numbers::Number;

pub use gait::{Gait, rise, sit, walk};
pub use mesh::Mesh;
pub use pattern::{Pattern, travel_pattern};
pub use routes::Routes;
pub use schemas::{Gains, WanderStyle, Wanderers};

pub fn numbers() -> Vec<Number> {
    let own = [gait::NUMBERS, schemas::NUMBERS, mesh::NUMBERS, body::NUMBERS].concat().into_iter().cloned();
    own.chain(manner::Manner::numbers()).collect()
}
