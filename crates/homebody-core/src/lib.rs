//! The simulated home: a scenario goes in, a resident moves, sensors see it, firings come out.
//!
//! The core is pure: it does no I/O, reads no clock, knows no thread and iterates no hash map. In reading
//! order:

#![warn(missing_docs)]

mod worded;

// Instants and spans of time, plane geometry, named random streams.
pub mod time;
pub mod geometry;
pub mod random;

// Means and quantiles, and what "about" and "most" mean in numbers.
pub mod statistics;
pub mod fuzzy;

// The numbers that models are made of.
pub mod numbers;

// The known name that was probably meant, and dates of a run.
pub mod nearest;
pub mod calendar;

// Names, roles of furniture, and activities.
pub mod names;
pub mod posture;
pub mod role;
pub mod vocabulary;
pub mod sensed;
pub mod states;
pub mod languages;
pub mod doors;
pub mod activity;

// Messages about problems of the user's files.
pub mod messages;
pub mod problem;
pub mod problems;

// The building and its residents.
pub mod stride;
pub mod ids;
pub mod plan;
pub mod motion;
pub mod resident;

// Bodies in three dimensions, and what cameras see of them.
pub mod body;
pub mod camera;

// Sensors, their views of a home, drivers, and the link.
pub mod sensor_set;
pub mod intervention;
pub mod event;
pub mod sensors;
pub mod home;
pub mod drivers;
pub mod link;

// The scenario: reading, checking, editing.
pub mod scenario;

// A run: the world, what is done to it from outside, and what is kept of it.
mod timers;
pub mod world;
pub mod outside;
pub mod run;
pub mod scene;
pub mod recording;
pub mod snapshots;
pub mod models;
pub mod catalogue;
