//! MQTT as a destination of logs: a home that a monitoring system cannot tell from a real one.
//!
//! Each row is one message of quality of service 1, in one of three styles: that of Home Assistant's discovery, that of Zigbee2MQTT, or
//! plain JSON. `order.rs` reads messages that are orders to runs; `clean.rs` removes retained messages.
//!
//! A row counts as durable once the broker has acknowledged it. All others are sent again on the next connection, with the same run and
//! number. A row is lost if the broker acknowledges it and then dies with its memory.

mod address;
mod certificate;
mod clean;
mod connection;
mod discovery;
mod entities;
#[cfg(test)]
#[path = "../../../tests/generated.rs"]
mod generated;
mod examine;
mod fleet;
mod flight;
mod greeting;
mod line;
mod messages;
mod names;
mod order;
mod place;
mod sink;
mod speaker;
mod speech;
mod trouble;
mod visit;
mod zigbee;

pub use address::{BrokerAddress, Discovery, Style};
pub use clean::{Cleaned, clean};
pub use fleet::MqttFleet;
pub use messages::MESSAGES;
pub use order::{Order, OrderedFault, Reply, TakesOrders, order_of};
pub use sink::{MqttSink, policy};

use homebody_core::scenario::scheme::Scheme;
use homebody_log::Sink;
use homebody_log::Url;
use homebody_log::registry::{OpenFleet, PlacePlugin};

pub fn plugin() -> PlacePlugin {
    let open = |url: &Url| -> Box<dyn Sink> { Box::new(MqttSink::new(url)) };
    let fleet: OpenFleet = |url| Box::new(MqttFleet::new(url));
    PlacePlugin {
        schemes: &[Scheme::Mqtt, Scheme::Mqtts],
        open,
        fleet: Some(fleet),
        policy,
        forms: &[],
        tables: None,
        truth_of: None,
        examine: examine::examine,
    }
}
