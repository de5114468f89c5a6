//! All tests of the crate in one program.

#[allow(clippy::disallowed_methods, reason = "a test may read and write files; the core may not")]
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
