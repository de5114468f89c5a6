//! The command from end to end, as people and scripts use it.
#![cfg(unix)]

#[cfg(feature = "mqtt")]
mod away;
mod bad_input;
mod beginnings;
mod calibrated;
mod cameras;
mod cohorts;
#[cfg(feature = "mqtt")]
mod commanded;
mod days;
mod drawn_plans;
mod driven;
mod faults;
mod figures;
mod flat;
mod fleets;
mod folder;
mod found;
mod from_logs;
mod hostile;
mod imports;
mod installing;
mod invariants;
mod killed_commands;
mod labels;
mod life_from;
mod links;
mod live_homes;
mod lives;
mod logs;
mod looks;
mod measured;
#[cfg(feature = "mqtt")]
#[allow(dead_code, reason = "these tests use a part of it")]
#[path = "../../../homebody-mqtt/tests/servers/mosquitto.rs"]
mod mosquitto;
mod names_along;
mod noted_log;
mod outputs;
mod packaging;
mod passwords;
#[allow(dead_code, reason = "these tests use a part of it")]
#[path = "../../../homebody-life/tests/played_server.rs"]
mod played_server;
#[cfg(feature = "postgresql")]
#[path = "../../../homebody-postgres/tests/stage/server.rs"]
mod postgres;
#[cfg(feature = "postgresql")]
mod put_back;
mod real_plans;
mod replays;
mod resumed;
#[cfg(feature = "postgresql")]
mod server_truths;
mod served;
mod serving;
mod soak;
mod stalled;
mod stops;
#[cfg(all(feature = "postgresql", feature = "parquet", feature = "mqtt"))]
mod stores;
mod streams;
mod trouble;
mod truths;
mod walked_back;
