//! The simulated home: a scenario goes in, a resident moves, sensors see it, firings come out.
//!
//! The core is pure: no I/O, no clock, no threads, no hash maps. In reading order:

pub mod time;
pub mod geometry;
/// What a user wrote, what is wrong with it.
pub mod scenario;
pub mod problem;
pub mod home;
pub mod sensors;
pub mod random;
pub mod stride;
pub mod event;
pub mod drivers;
pub mod world;
//D pub mod run;
/// The naive way, as oracle and baseline.
pub mod naive;
