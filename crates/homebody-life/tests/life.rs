//! All tests of the crate in one program.

mod card;
mod conversations;
mod played_server;
mod servers;
