//! All tests of the crate in one program, except those of memory.

#[path = "../../../tests/generated.rs"]
mod generated;
mod playback;
mod server;
mod stored;
mod wire;
