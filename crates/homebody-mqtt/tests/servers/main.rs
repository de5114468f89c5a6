//! Logs to a real broker: mosquitto, started and ended by each test.
//!
//! Without mosquitto the tests say so and pass, unless `HOMEBODY_SERVERS=required` is set.

mod arrives;
mod broker;
mod fleet;
mod home_assistant;
mod looks;
mod ordered;
mod refused;
mod tidied;
mod zigbee2mqtt;
