//! Unusual names and other texts.

use super::word;
use crate::choices::Choices;

/// An odd text, a long one, or `text` with an odd insertion.
pub fn other(text: &str, choices: &mut Choices) -> String {
    match choices.below(5) {
        0 | 1 => word(choices, "texts").to_owned(),
        2 => choices.one(&["x", "é", "a ", "\u{1f474}"]).repeat(choices.size(100_000)),
        3 => format!("{text}{}", word(choices, "texts")),
        _ => {
            let mut chars: Vec<char> = text.chars().collect();
            let part = choices.part(chars.len());
            chars.splice(part, word(choices, "texts").chars());
            chars.into_iter().collect()
        }
    }
}
