//! All tests of the crate in one program, except those of memory.

#[path = "../../../tests/generated.rs"]
mod generated;
#[allow(dead_code, reason = "these tests use a part of it")]
#[path = "../../homebody-life/tests/played_server.rs"]
mod played_server;
mod playback;
mod server;
mod stored;
mod wire;
