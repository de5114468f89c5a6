//! The command and the places of all kinds, servers too: what goes there comes back, and what is wrong with one is told.
//!
//! Servers are begun by the tests. Where they are not installed the tests say so and pass, unless `HOMEBODY_SERVERS=required` is set.
#![cfg(all(unix, feature = "postgresql", feature = "parquet", feature = "mqtt"))]
#![allow(dead_code, reason = "what tests of several programs share is used in part by each")]

#[path = "../command/flat.rs"]
mod flat;
#[path = "../command/folder.rs"]
mod folder;
#[path = "../../../homebody-mqtt/tests/servers/mosquitto.rs"]
mod mosquitto;
#[path = "../../../homebody-postgres/tests/stage/server.rs"]
mod server;

mod digests;
mod doctor;
mod examples;
mod labels;
mod own_names;
mod replaced;
