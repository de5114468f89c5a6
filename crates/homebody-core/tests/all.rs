//! All tests of the crate in one program.

#[path = "../../../tests/generated.rs"]
mod generated;
mod activities;
mod bad_input;
mod cameras;
mod catalogue;
mod devices;
mod drivers;
mod invariants;
mod kinds;
mod levels;
mod link;
mod oracle;
mod random_home;
mod references;
mod schemas;
