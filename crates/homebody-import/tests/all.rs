//! All tests of the crate in one program.

mod from_log;
mod plans;
