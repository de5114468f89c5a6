//! MQTT as a destination of logs: a home that a monitoring system cannot tell from a real one.
//!
//! Each row is one message of quality of service 1. How messages look is a style: that of Home Assistant's discovery, that of
//! Zigbee2MQTT, or plain JSON. What runs may be told by messages is in `order.rs`; what this crate does with a broker besides
//! is to tidy up.
//!
//! A row counts as durable once the broker has acknowledged it. What is not acknowledged is sent again on the next connection,
//! with the same run and number. What a broker has acknowledged and then forgets, because it dies with its memory, is lost.

mod address;
mod certificate;
mod clean;
mod connection;
mod discovery;
mod entities;
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

pub use address::{Address, Discovery, Style};
pub use clean::{Cleaned, clean};
pub use fleet::MqttFleet;
pub use messages::MESSAGES;
pub use order::{Kind, Order, Reply, TakesOrders, order_of};
pub use sink::{MqttSink, policy};

use homebody_core::scenario::scheme::Scheme;
use homebody_log::Sink;
use homebody_log::Url;
use homebody_log::registry::{OpenFleet, PlacePlugin};

/// The kinds of places of this crate, for a program that installs them.
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
