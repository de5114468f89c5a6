//! The simulated home: a scenario goes in, a resident moves, sensors see it, firings come out.
//!
//! The core is pure: no I/O, no clock, no threads, no hash maps. Reading order:

pub mod drivers;
pub mod event;
pub mod geometry;
pub mod home;
pub mod problem;
pub mod scenario;
pub mod time;
