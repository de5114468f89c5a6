//! Scripts: parts of the language in wrong places.

use super::{numbers, word, words};
use crate::choices::Choices;

/// Changes a script: half of the mutants in one or two places, and remain scripts; the others at random, in one to
/// eight places.
pub fn script(text: &mut String, others: &[&str], choices: &mut Choices) {
    if choices.below(2) == 0 {
        for _ in 0..choices.size(2) {
            match choices.below(3) {
                0 => number(text, choices),
                1 => call_for_call(text, choices),
                _ => statement(text, choices),
            }
        }
        return;
    }
    for _ in 0..choices.size(8) {
        match choices.below(5) {
            0 => {
                let part = word(choices, "script parts");
                let places: Vec<usize> = text.char_indices().map(|(at, _)| at).chain([text.len()]).collect();
                text.insert_str(*choices.one(&places), part);
            }
            1 => number(text, choices),
            2 => lines(text, choices),
            3 => call_for_call(text, choices),
            _ => part_of_another(text, others, choices),
        }
    }
}

fn statement(text: &mut String, choices: &mut Choices) {
    let parts = words("script parts").iter().map(String::as_str);
    let statements: Vec<&str> = parts.filter(|part| part.ends_with([';', '}'])).collect();
    let ends = |line: &str| line.trim_end().ends_with([';', '{']);
    let mut lines: Vec<&str> = text.lines().collect();
    let places: Vec<usize> = (1..=lines.len()).filter(|&at| ends(lines[at - 1])).collect();
    if !places.is_empty() {
        lines.insert(*choices.one(&places), *choices.one(&statements));
        *text = lines.join("\n");
    }
}

fn number(text: &mut String, choices: &mut Choices) {
    let is_digit = |at: usize| text.as_bytes()[at].is_ascii_digit();
    let begins: Vec<usize> = (0..text.len()).filter(|&at| is_digit(at) && (at == 0 || !is_digit(at - 1))).collect();
    if begins.is_empty() {
        return;
    }
    let begin = *choices.one(&begins);
    let end = text[begin..].find(|c: char| !c.is_ascii_digit()).map_or(text.len(), |length| begin + length);
    let other = numbers::other(text[begin..end].parse().unwrap_or(0.0), choices);
    text.replace_range(begin..end, &other);
}

fn part_of_another(text: &mut String, others: &[&str], choices: &mut Choices) {
    if others.is_empty() {
        return;
    }
    let taken: Vec<&str> = choices.one(others).lines().collect();
    let part = choices.part(taken.len());
    let mut lines: Vec<&str> = text.lines().collect();
    let at = choices.below(lines.len() + 1);
    lines.splice(at..at, taken[part].iter().copied());
    *text = lines.join("\n");
}

fn lines(text: &mut String, choices: &mut Choices) {
    let mut lines: Vec<String> = text.lines().map(String::from).collect();
    if lines.is_empty() {
        return;
    }
    let line = lines.remove(choices.below(lines.len()));
    for _ in 0..choices.below(3) {
        lines.insert(choices.below(lines.len() + 1), line.clone());
    }
    *text = lines.join("\n");
}

fn call_for_call(text: &mut String, choices: &mut Choices) {
    let calls: Vec<usize> = text.match_indices('(').map(|(at, _)| at).collect();
    if calls.is_empty() {
        return;
    }
    let end = *choices.one(&calls);
    let is_of_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let begin = text[..end]
        .rfind(|c: char| !is_of_word(c))
        .map_or(0, |at| at + text[at..].chars().next().map_or(1, char::len_utf8));
    text.replace_range(begin..end, word(choices, "script calls"));
}
