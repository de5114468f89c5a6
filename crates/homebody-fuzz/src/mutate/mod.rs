//! Mutators, by the grammar of what they change.

/// Largest size in bytes of an input that repetition enlarges (our choice).
const MOST_REPEATED_BYTES: usize = 300_000;

/// How often something of this length may be repeated, at most `most` times.
fn times(length: usize, most: usize) -> usize {
    (MOST_REPEATED_BYTES / (length + 1)).clamp(1, most)
}

pub mod bytes;
pub mod json;
pub mod markup;
pub mod numbers;
pub mod outlines;
pub mod scripts;
pub mod sentences;
pub mod sql;
pub mod tables;
pub mod texts;
