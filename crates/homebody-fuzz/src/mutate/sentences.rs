//! Sentences of routines, from parts of those that the language knows.

use super::{numbers, texts};
use crate::dice::Dice;

/// A sentence for each form of the language.
const FORMS: &str = include_str!("../../../homebody-routine/tests/forms.txt");

/// Words at which clauses begin.
const BEGINNINGS: [&str; 34] = [
    "at",
    "on",
    "in",
    "for",
    "after",
    "before",
    "from",
    "to",
    "until",
    "over",
    "by",
    "with",
    "then",
    "and",
    "or",
    "if",
    "whenever",
    "every",
    "most",
    "often",
    "sometimes",
    "rarely",
    "never",
    "about",
    "once",
    "twice",
    "when",
    "while",
    "between",
    "during",
    "fading",
    "give",
    "each",
    "for",
];

const CLAUSES: [&str; 30] = [
    "at about 25:61",
    "at 00:00",
    "from 23:59 to 00:01",
    "for 0 minutes",
    "for 1000000 hours",
    "give or take 40 days",
    "every 0 days",
    "every 999999999999 days",
    "0 times a day",
    "1000000 times a day",
    "on 30 February",
    "from 31 December 9999",
    "from week 4294967296",
    "from day 0 to day -1",
    "over 0 days",
    "until week 0",
    "100 % of the time",
    "300 % more often",
    "on Monday and Monday and Monday",
    "in winter, in summer",
    "before breakfast after dinner",
    "in the bathroom in the bedroom",
    "whenever the stove has been on for 0 minutes, she turns it off",
    "she shows severe depression",
    "she wanders at night",
    "except on Sunday",
    "at about 08:00, give or take 20 minutes",
    "once or twice",
    "for 30 to 50 minutes",
    "if it is dark",
];

/// Names of the home and the person, to be put for others.
const NAMES: [&str; 12] = [
    "she",
    "Margaret",
    "her daughter",
    "the stove",
    "the armchair",
    "the bathroom",
    "the front door",
    "the television",
    "nobody",
    "it",
    "the cat",
    "the moon",
];

/// A routine of some sentences below each other, or under headings.
pub fn routine(dice: &mut Dice) -> String {
    let mut text = String::from("Margaret is 82. She walks at about 0.65 m/s.\n");
    for _ in 0..dice.size(30) {
        if dice.is(0.15) {
            text +=
                *dice.one(&["Every day\n", "On Monday\n", "From week 6:\n", "Most nights\n", "In winter,\n", "# a\n"]);
        }
        text += *dice.one(&["", "", "  ", "\t", "    "]);
        text += &sentence(dice);
        text += *dice.one(&["\n", "\n", ".\n", ". ", "!\n", "\r\n", "\r", "", "; "]);
    }
    if dice.is(0.05) {
        text = text.repeat(dice.size(super::times(text.len(), 2_000)));
    }
    text
}

/// Changes lines of a routine.
pub fn lines(text: &mut String, dice: &mut Dice) {
    let mut lines: Vec<String> = text.split_inclusive('\n').map(str::to_owned).collect();
    for _ in 0..dice.size(6) {
        let at = dice.below(lines.len());
        match dice.below(6) {
            0 if !lines.is_empty() => drop(lines.remove(at)),
            1 if !lines.is_empty() => lines[at] = reworded(&lines[at], dice),
            2 if !lines.is_empty() => lines.insert(at, lines[dice.below(lines.len())].clone()),
            3 if !lines.is_empty() => {
                let other = dice.below(lines.len());
                lines.swap(at, other);
            }
            4 if !lines.is_empty() => lines[at] = format!("{}{}", dice.one(&["  ", "\t", ""]), lines[at].trim_start()),
            _ => lines.insert(at, format!("{}\n", sentence(dice))),
        }
    }
    *text = lines.concat();
}

/// A sentence that the language knows, or that begins as one of them and ends as another.
pub fn sentence(dice: &mut Dice) -> String {
    let forms = forms();
    let form = *dice.one(&forms);
    match dice.below(6) {
        0 => form.to_owned(),
        1 => format!("{} {}", form.trim_end_matches('.'), dice.one(&CLAUSES)),
        2 => reworded(form, dice),
        3 => format!("{}, {}", dice.one(&CLAUSES), form),
        _ => {
            let other = *dice.one(&forms);
            format!("{} {}", clause(form, true, dice), clause(other, false, dice))
        }
    }
}

/// The sentence with other words and numbers.
fn reworded(sentence: &str, dice: &mut Dice) -> String {
    let mut words: Vec<String> = sentence.split(' ').map(str::to_owned).collect();
    for _ in 0..dice.size(3) {
        let at = dice.below(words.len());
        let Some(word) = words.get(at).cloned() else { break };
        let number = words.iter().position(|word| word.starts_with(|c: char| c.is_ascii_digit()));
        match (dice.below(6), number) {
            (0..=2, Some(number)) => {
                let was = words[number].trim_matches(|c: char| !c.is_ascii_digit()).parse().unwrap_or(1.0);
                words[number] = numbers::other(was, dice);
            }
            (0, None) => words[at] = (*dice.one(&NAMES)).to_owned(),
            (3, _) => drop(words.remove(at)),
            (4, _) => words.insert(at, word),
            (5, _) if dice.is(0.3) => words[at] = texts::other(&word, dice),
            _ => words.insert(at, (*dice.one(&CLAUSES)).to_owned()),
        }
    }
    words.join(" ")
}

/// The beginning of a sentence, up to some clause of it, or its end from there on.
fn clause<'t>(sentence: &'t str, is_head: bool, dice: &mut Dice) -> &'t str {
    let begins = |at: &usize| {
        let rest = &sentence[at + 1..];
        BEGINNINGS.contains(&rest.split(' ').next().unwrap_or_default())
    };
    let cuts: Vec<usize> = sentence.match_indices(' ').map(|(at, _)| at).filter(begins).collect();
    let Some(&cut) = cuts.get(dice.below(cuts.len())) else { return sentence };
    if is_head { &sentence[..cut] } else { &sentence[cut + 1..] }
}

/// The sentences that the language knows, each on a line of its own.
fn forms() -> Vec<&'static str> {
    FORMS.lines().filter(|line| !line.is_empty() && !line.starts_with(['#', ' '])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sentences_are_old_and_new() {
        let forms = forms();
        assert!(forms.len() > 200, "{}", forms.len());
        let mut dice = Dice::of("sentences", 1, 0);
        let known = (0..1000).filter(|_| forms.contains(&sentence(&mut dice).as_str())).count();
        assert!((100..500).contains(&known), "{known}");
    }
}
