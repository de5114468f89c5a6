//! Plans of Sweet Home 3D, written by the tests, and the homes that they become.

mod plan;

mod flats;
mod levels;
mod practice;
mod habits;
mod reachability;
mod hostile;
mod random;
