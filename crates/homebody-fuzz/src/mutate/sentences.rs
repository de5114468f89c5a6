//! Sentences of routines, from parts of known sentences.

use super::{numbers, texts, word};
use crate::choices::Choices;

/// A sentence for each form of the language.
const FORMS: &str = include_str!("../../../homebody-routine/tests/forms.txt");

/// A routine of some sentences in a list, or under headings.
pub fn routine(choices: &mut Choices) -> String {
    let mut text = String::from("Margaret is 82. She walks at about 0.65 m/s.\n");
    for _ in 0..choices.size(30) {
        if choices.is(0.15) {
            text += *choices.one(&["Every day", "On Monday", "From week 6:", "Most nights", "In winter,", "# a"]);
            text += "\n";
        }
        text += *choices.one(&["", "", "  ", "\t", "    "]);
        text += &sentence(choices);
        text += *choices.one(&["\n", "\n", ".\n", ". ", "!\n", "\r\n", "\r", "", "; "]);
    }
    if choices.is(0.05) {
        text = text.repeat(choices.size(super::times(text.len(), 2_000)));
    }
    text
}

pub fn lines(text: &mut String, choices: &mut Choices) {
    let mut lines: Vec<String> = text.split_inclusive('\n').map(str::to_owned).collect();
    for _ in 0..choices.size(6) {
        let at = choices.below(lines.len());
        match choices.below(6) {
            0 if !lines.is_empty() => drop(lines.remove(at)),
            1 if !lines.is_empty() => lines[at] = reworded(&lines[at], choices),
            2 if !lines.is_empty() => lines.insert(at, lines[choices.below(lines.len())].clone()),
            3 if !lines.is_empty() => {
                let other = choices.below(lines.len());
                lines.swap(at, other);
            }
            4 if !lines.is_empty() => {
                lines[at] = format!("{}{}", choices.one(&["  ", "\t", ""]), lines[at].trim_start())
            }
            _ => lines.insert(at, format!("{}\n", sentence(choices))),
        }
    }
    *text = lines.concat();
}

/// A known sentence, or the beginning of one with the end of another.
pub fn sentence(choices: &mut Choices) -> String {
    let forms = forms();
    let form = *choices.one(&forms);
    match choices.below(6) {
        0 => form.to_owned(),
        1 => format!("{} {}", form.trim_end_matches('.'), word(choices, "clauses")),
        2 => reworded(form, choices),
        3 => format!("{}, {}", word(choices, "clauses"), form),
        _ => {
            let other = *choices.one(&forms);
            format!("{} {}", clause(form, true, choices), clause(other, false, choices))
        }
    }
}

fn reworded(sentence: &str, choices: &mut Choices) -> String {
    let mut words: Vec<String> = sentence.split(' ').map(str::to_owned).collect();
    for _ in 0..choices.size(3) {
        let at = choices.below(words.len());
        let Some(word) = words.get(at).cloned() else { break };
        let number = words.iter().position(|word| word.starts_with(|c: char| c.is_ascii_digit()));
        match (choices.below(6), number) {
            (0..=2, Some(number)) => {
                let was = words[number].trim_matches(|c: char| !c.is_ascii_digit()).parse().unwrap_or(1.0);
                words[number] = numbers::other(was, choices);
            }
            (0, None) => words[at] = super::word(choices, "names").to_owned(),
            (3, _) => drop(words.remove(at)),
            (4, _) => words.insert(at, word),
            (5, _) if choices.is(0.3) => words[at] = texts::other(&word, choices),
            _ => words.insert(at, super::word(choices, "clauses").to_owned()),
        }
    }
    words.join(" ")
}

/// The sentence before one of its clauses, or from that clause on.
fn clause<'t>(sentence: &'t str, is_head: bool, choices: &mut Choices) -> &'t str {
    let begins = |at: &usize| {
        let rest = &sentence[at + 1..];
        super::words("beginnings").iter().any(|word| rest.split(' ').next() == Some(word))
    };
    let cuts: Vec<usize> = sentence.match_indices(' ').map(|(at, _)| at).filter(begins).collect();
    let Some(&cut) = cuts.get(choices.below(cuts.len())) else { return sentence };
    if is_head { &sentence[..cut] } else { &sentence[cut + 1..] }
}

fn forms() -> Vec<&'static str> {
    FORMS.lines().filter(|line| !line.is_empty() && !line.starts_with(['#', ' '])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choices;

    #[test]
    fn sentences_are_old_and_new() {
        let forms = forms();
        assert!(forms.len() > 200, "{}", forms.len());
        let bytes = choices::bytes(1);
        let mut choices = Choices::new(&bytes);
        let known = (0..1000).filter(|_| forms.contains(&sentence(&mut choices).as_str())).count();
        assert!((100..500).contains(&known), "{known}");
    }
}
