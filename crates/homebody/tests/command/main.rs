//! The command from end to end, as people and scripts use it.
#![cfg(unix)]

mod flat;
mod folder;
mod noted_log;

mod beginnings;
mod imports;
mod real_plans;
mod drawn_plans;
mod invariants;
mod killed_commands;
mod names_along;
mod links;
mod replays;
mod outputs;
mod passwords;
mod trouble;
mod stops;
mod streams;
mod resumed;
mod driven;
mod bad_input;
mod from_logs;
mod hostile;
mod logs;
mod looks;
mod measured;
mod days;
mod found;
mod figures;
mod installing;
mod labels;
mod lives;
mod live_homes;
mod fleets;
#[cfg(feature = "postgresql")]
#[path = "../../../homebody-postgres/tests/stage/server.rs"]
mod postgres;
#[cfg(feature = "postgresql")]
mod put_back;
#[cfg(feature = "postgresql")]
mod server_truths;
#[cfg(feature = "mqtt")]
mod commanded;
#[cfg(feature = "mqtt")]
mod away;
mod stalled;
mod truths;
mod walked_back;
mod calibrated;
mod cameras;
mod cohorts;
mod serving;
mod faults;
mod soak;
