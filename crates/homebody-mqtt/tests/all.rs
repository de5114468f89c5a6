//! All tests of the crate in one program. Brokers are mosquitto, which each test starts and ends.
//!
//! Where mosquitto is not installed, the tests say so and pass, unless `HOMEBODY_SERVERS=required` is set.

#[path = "../../../tests/alone.rs"]
mod alone;
#[path = "../../../tests/hangs.rs"]
mod hanging;
#[path = "../../../tests/outage.rs"]
mod outages;
#[path = "../../../tests/stalling.rs"]
mod stalling;
mod hangs;
mod outage;
mod servers;
