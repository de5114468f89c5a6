//! Plans of Sweet Home 3D, made here, and what becomes of them.

mod plan;

mod flats;
mod levels;
mod practice;
mod habits;
mod reachability;
mod hostile;
mod random;
