//! All tests of the crate in one program.

#[path = "../../../tests/alone.rs"]
mod alone;
#[path = "../../../tests/generated.rs"]
mod generated;
#[path = "../../../tests/hangs.rs"]
mod hanging;
mod doubtful;
mod evidence;
mod hangs;
mod home_assistant;
mod interchange;
mod killed;
mod timeline;
mod log_forms;
mod policies;
mod power;
mod rate;
mod recorded;
mod seeds;
mod sources;
mod spools;
mod stage;
mod stored;
mod tables;
mod texts;
mod trouble;
mod truth_tables;
