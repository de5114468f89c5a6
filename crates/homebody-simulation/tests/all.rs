//! All tests of the crate in one program, except those of buckets.

mod examples;
mod interventions;
mod numbers;
mod rewinding;
mod runs;
mod scripts;
mod stopped_truths;
