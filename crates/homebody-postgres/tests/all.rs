//! All tests of the crate in one program.

#[path = "../../../tests/alone.rs"]
mod alone;
#[path = "../../../tests/hangs.rs"]
mod hanging;
#[path = "../../../tests/outage.rs"]
mod outages;
#[path = "../../../tests/stalling.rs"]
mod stalling;
mod ambiguous;
mod fleet;
mod hangs;
mod killed;
mod outage;
mod reading;
mod secret;
mod stage;
mod trouble;
