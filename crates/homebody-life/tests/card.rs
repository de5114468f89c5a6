//! The card of the language is short, and each of its examples is right.

use homebody_life::Conversation;
use homebody_simulation::template;

const CARD: &str = include_str!("../src/card.md");

/// A model reads a card of this length with care (our choice).
const MOST_WORDS: usize = 1_500;

#[test]
fn is_short() {
    let words = CARD.split_whitespace().count();
    assert!(words <= MOST_WORDS, "{words} words");
}

#[test]
fn its_sentences_are_accepted_together() {
    let (_, examples) = CARD.split_once("```\n").unwrap();
    let lines: Vec<&str> = examples.trim_end().trim_end_matches("```").lines().collect();
    assert!(lines.len() > 15);
    let answer = serde_json::json!({ "lines": [{ "source": "A life.", "statements": lines }] }).to_string();
    let mut conversation = Conversation::new(template("tigerplace").unwrap(), None, "A life.").unwrap();
    conversation.take(&answer).unwrap();
    let refused: Vec<_> =
        conversation.draft().unwrap().lines[0].statements.iter().filter(|it| it.refused.is_some()).collect();
    assert!(refused.is_empty(), "{refused:#?}");
    // A wrong sentence among them is found.
    let wrong = answer.replace("She gets up at 07:00", "She sort of gets up at 07:00");
    conversation.take(&wrong).unwrap();
    assert!(conversation.latest_faults().0 > 0);
}

#[test]
fn the_prompt_names_the_home_and_the_deeds() {
    let prompt = Conversation::new(template("couple-with-cat").unwrap(), Some("ruth"), "She naps.").unwrap().prompt();
    for name in ["Ruth", "henry", "bathroom", "naps", "does puzzles", "1. She naps."] {
        assert!(prompt.contains(name), "{name}: {prompt}");
    }
}
