//! All tests of the crate in one program.

mod coverage;
mod home;
mod parts;
