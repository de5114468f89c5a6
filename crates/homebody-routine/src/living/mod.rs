//! Living by a routine, layer by layer. In reading order:

// Whose life it is, and how it is on a day.
pub mod person;
mod parameters;
pub mod life;
mod keys;

// What is to be done on a day, where, and how each thing is done.
mod usual;
mod rising;
pub mod item;
mod drafts;
pub mod agenda;
pub use homebody_walk::{manner, places, stations};
pub mod script;

// What interrupts: needs and rules.
mod need;
mod needs;
mod errands;
mod watch;

// Who carries it out.
pub use homebody_walk::body;
mod chores;
mod playing;
pub mod driver;
mod turns;
pub mod tally;
pub mod account;
mod spare_time;
mod night;
pub mod company;
mod courtesy;
mod interrupts;
mod fallen;
mod ways;
mod lamps;
mod sight;
mod visit;
pub mod pet;

use homebody_core::numbers::Number;

/// The numbers that lives are made of.
pub(crate) fn numbers() -> Vec<Number> {
    let modules = [
        person::NUMBERS,
        parameters::NUMBERS,
        rising::NUMBERS,
        agenda::NUMBERS,
        needs::NUMBERS,
        company::NUMBERS,
        ways::NUMBERS,
        spare_time::NUMBERS,
        chores::NUMBERS,
        night::NUMBERS,
        pet::NUMBERS,
    ];
    let own = modules.concat().into_iter().cloned();
    own.chain(usual::numbers()).chain(spare_time::numbers()).collect()
}
