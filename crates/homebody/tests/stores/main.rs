//! Places of all kinds, including servers: their rows can be read back, and their problems are reported.
//!
//! The tests start the servers. Without an installed server they print a note and pass, unless `HOMEBODY_SERVERS=required` is set.
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
