//! Mutators of JSON, SQL, markup and sentences by their grammar. Libraries mutate bytes, or values of Rust types; they
//! cannot keep the form of a file and break its rules.

use crate::choices::Choices;
use std::collections::BTreeMap;
use std::sync::OnceLock;

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

/// Largest size in bytes of an input that repetition enlarges (our choice).
const MOST_REPEATED_BYTES: usize = 300_000;

/// Largest number of repetitions of an item of this length, at most `most`.
fn times(length: usize, most: usize) -> usize {
    (MOST_REPEATED_BYTES / (length + 1)).clamp(1, most)
}

fn words(list: &str) -> &'static [String] {
    static WORDS: OnceLock<BTreeMap<String, Vec<String>>> = OnceLock::new();
    let words = WORDS.get_or_init(|| {
        serde_json::from_str(include_str!("mutate/words.json"))
            .expect("the lists of words are JSON, which a test reads")
    });
    &words[list]
}

pub fn word(choices: &mut Choices, list: &str) -> &'static str {
    choices.one::<String>(words(list))
}
