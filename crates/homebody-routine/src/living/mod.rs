//! Living by a routine, layer by layer. In reading order:

// Whose life it is, and how it is on a day.
pub mod life;
mod keys;

// What is to be done on a day, where, and how each thing is done.
pub mod agenda;
pub mod places;
pub mod script;
mod manner;

// What interrupts: needs and rules.
mod need;
mod needs;
mod watch;

// Who carries it out.
pub mod body;
pub mod driver;
mod spare_time;
mod night;
mod visit;
pub mod pet;
