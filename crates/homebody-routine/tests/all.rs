//! All tests of the crate in one program.

#[path = "../../../tests/generated.rs"]
mod generated;
mod carers;
mod days;
mod diagnostics;
mod explanation;
mod fall_sentences;
mod falls;
mod forms;
mod habits;
mod home;
mod lexicon;
mod mutations;
mod page;
mod reach;
mod residents;
mod roles;
mod rule_effects;
mod stage;
mod streams;
mod untrained_writers;
