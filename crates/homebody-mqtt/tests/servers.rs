//! Logs that go to a real broker.
//!
//! Without mosquitto the tests say so and pass, unless `HOMEBODY_SERVERS=required` is set.

mod arrives;
pub mod broker;
mod fleet;
mod home_assistant;
mod looks;
mod ordered;
mod refused;
mod tidied;
mod zigbee2mqtt;
