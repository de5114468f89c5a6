//! The simulated home: a scenario goes in, a resident moves, sensors see it, firings come out.
//!
//! The core is pure: it does no I/O, reads no clock, knows no thread and iterates no hash map. In reading
//! order:

#![warn(missing_docs)]

// Spans and instants in whole microseconds, plane geometry, named random streams.
pub mod time;
pub mod geometry;
pub mod random;

// Means and quantiles, and what "about" and "most" mean in numbers.
pub mod statistics;
pub mod fuzzy;

// The numbers that models are made of.
pub mod numbers;

// What names are made of, what furniture is for, and what activities are called.
pub mod names;
pub mod role;
pub mod vocabulary;
pub mod sensed;
pub mod states;
pub mod languages;
pub mod doors;
pub mod activity;

// What the user wrote, and what is wrong with it.
pub mod scenario;
pub mod messages;
pub mod catalogue;
pub mod problem;
pub mod problems;

// The home, what its sensors are, and what they see in it.
pub mod home;
pub mod sensors;

// Bodies in three dimensions, and what cameras see of them.
pub mod body;
pub mod camera;

// Movement: strides, who decides on them, the world they happen in, and the way of what its sensors say.
pub mod stride;
pub mod ids;
pub mod sensor_set;
pub mod deed;
pub mod event;
mod timers;
pub mod drivers;
pub mod world;
pub mod link;
pub mod outside;
pub mod run;
pub mod scene;
pub mod recording;
pub mod snapshots;
pub mod models;

// The naive way, as oracle and as baseline.
pub mod naive;
