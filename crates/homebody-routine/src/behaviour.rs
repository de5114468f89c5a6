//! The behaviour of residents with a routine, layer by layer.

pub mod traits;
mod parameters;
pub mod resident_routine;
mod keys;

mod defaults;
mod rising;
pub mod item;
mod drafts;
pub mod agenda;
mod arrange;
pub use homebody_walk::{manner, places, stations};
pub mod script;

mod need;
mod needs;
mod errands;
mod watch;

pub use homebody_walk::body;
mod chores;
mod current_activity;
pub mod driver;
mod priority;
pub mod tally;
pub mod difference;
mod spare_time;
mod night;
pub mod company;
mod courtesy;
mod interrupts;
mod fall;
mod ways;
mod lamps;
mod things;
mod wakings;
mod range;
mod weather;
mod sight;
mod visit;
mod help;
mod labels;
pub mod pet;

use homebody_core::numbers::Number;

/// The parameters of behaviour.
pub(crate) fn numbers() -> Vec<Number> {
    let modules = [
        traits::NUMBERS,
        parameters::NUMBERS,
        rising::NUMBERS,
        agenda::NUMBERS,
        needs::NUMBERS,
        company::NUMBERS,
        ways::NUMBERS,
        spare_time::NUMBERS,
        chores::NUMBERS,
        night::NUMBERS,
        wakings::NUMBERS,
        pet::NUMBERS,
    ];
    let own = modules.concat().into_iter().cloned();
    own.chain(defaults::numbers()).chain(spare_time::numbers()).collect()
}
