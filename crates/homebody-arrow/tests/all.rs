//! All tests of the crate in one program, except those of buckets.

#[path = "../../../tests/alone.rs"]
mod alone;
#[path = "../../homebody-log/tests/stage/mod.rs"]
mod stage;
mod bombs;
mod data_sets;
mod others;
mod reading;
mod written;
