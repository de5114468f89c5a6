//! All tests of the crate in one program.

#[allow(clippy::disallowed_methods, reason = "a test may read and write files; the crate may not")]
#[path = "../../../tests/generated.rs"]
mod generated;
mod agreement;
mod canonical;
mod carers;
mod days;
mod diagnostics;
mod explanation;
mod fall_sentences;
mod falls;
mod forms;
mod german;
mod habits;
mod home;
mod lexicon;
mod mutations;
mod own_days;
mod page;
mod range;
mod reach;
mod random_statements;
mod residents;
mod roles;
mod rule_effects;
mod stage;
mod stated_first;
mod statements_page;
mod streams;
mod such_days;
mod things;
mod untrained_writers;
mod visits;
