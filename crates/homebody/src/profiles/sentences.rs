//! What a profile says, written into a routine: the sentences that say otherwise go, its own come instead.

use homebody_routine::language::{self, Known};
use homebody_routine::routine::{Effect, Routine};
use std::ops::Range;

/// What a routine is to say of the person.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Said {
    /// Such as "The person is 75".
    pub age: Option<String>,
    /// Such as "The person walks at 0.5 m/s".
    pub pace: Option<String>,
    /// Such as "From week 6 the person shows moderate depression"; nothing leaves conditions as they are.
    pub conditions: Option<Vec<String>>,
}

/// A fact of which a routine says one at most.
#[derive(Clone, Copy, PartialEq)]
enum Fact {
    Age,
    Pace,
}

impl Said {
    /// The text of a routine, with this in it. What stays keeps its line and its column.
    pub fn within(&self, text: &str, routine: &Routine, known: &Known) -> String {
        let mut text = text.to_owned();
        if self.conditions.is_some() {
            for change in routine.changes.iter().filter(|change| matches!(change.effect, Effect::Shows { .. })) {
                let line = lines(&text).get(change.said.line as usize - 1).cloned().unwrap_or_default();
                let chars = text[line.clone()].char_indices().nth(change.said.column as usize - 1);
                let start = line.start + chars.map_or(0, |(at, _)| at);
                let is_indented = text[line].starts_with(char::is_whitespace);
                blank(&mut text, start..start + change.said.text.len());
                if is_indented {
                    blank_heading_of(&mut text, change.said.line as usize - 1);
                }
            }
        }
        let mut added: Vec<&String> = self.conditions.iter().flatten().collect();
        for (fact, said) in [(Fact::Age, &self.age), (Fact::Pace, &self.pace)] {
            let Some(said) = said else { continue };
            match sentences(&text).into_iter().find(|place| is_fact(&text[place.clone()], fact, known)) {
                Some(place) => text.replace_range(place, said),
                None => added.insert(0, said),
            }
        }
        for said in added {
            text += &format!("\n{said}.");
        }
        text + "\n"
    }
}

/// Whether a sentence says this fact and nothing else.
fn is_fact(sentence: &str, fact: Fact, known: &Known) -> bool {
    let (routine, problems) = language::routine("", sentence, known);
    let said = routine.person.map(|person| match fact {
        Fact::Age => person.age_years.is_some(),
        Fact::Pace => person.pace_mps.is_some(),
    });
    problems.is_empty() && said == Some(true)
}

/// Where each line is, without its end.
fn lines(text: &str) -> Vec<Range<usize>> {
    let mut start = 0;
    let line = |line: &str| {
        let range = start..start + line.len();
        start = range.end + 1;
        range
    };
    text.replace("\r\n", " \n").replace('\r', "\n").split('\n').map(line).collect()
}

/// Where each sentence is, without what ends it; comments are none.
fn sentences(text: &str) -> Vec<Range<usize>> {
    let mut sentences = Vec::new();
    for line in lines(text) {
        let code = text[line.clone()].split('#').next().unwrap_or_default();
        let mut start = 0;
        let ends =
            code.match_indices('.').map(|(at, _)| at).filter(|at| !code[at + 1..].starts_with(char::is_alphanumeric));
        for end in ends.chain([code.len()]) {
            let blanks = code[start..end].len() - code[start..end].trim_start().len();
            let end_of_words = start + code[start..end].trim_end().len();
            if start + blanks < end_of_words {
                sentences.push(line.start + start + blanks..line.start + end_of_words);
            }
            start = (end + 1).min(code.len());
        }
    }
    sentences
}

/// Puts a blank for every byte, so that all else stays where it is.
fn blank(text: &mut String, place: Range<usize>) {
    let blanks = " ".repeat(text[place.clone()].chars().count());
    text.replace_range(place, &blanks);
}

/// Takes away the heading of an indented line that has become empty, if nothing else stands below it.
fn blank_heading_of(text: &mut String, line: usize) {
    let all = lines(text);
    let is_empty = |line: &Range<usize>| {
        let code = text[line.clone()].split('#').next().unwrap_or_default();
        code.chars().all(|c| c.is_whitespace() || c == '.')
    };
    let is_indented = |line: &Range<usize>| text[line.clone()].starts_with(char::is_whitespace);
    if !is_empty(&all[line]) {
        return;
    }
    let before = all[..line].iter().rev().find(|line| !is_empty(line));
    let after = all[line + 1..].iter().find(|line| !is_empty(line));
    if let Some(heading) = before.filter(|line| !is_indented(line)).filter(|_| !after.is_some_and(is_indented)) {
        let code = text[heading.clone()].split('#').next().unwrap_or_default().len();
        blank(text, heading.start..heading.start + code);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn known() -> Known {
        Known {
            person: Some("Margaret".into()),
            conditions: vec!["depression".into(), "frailty".into()],
            ..Known::default()
        }
    }

    fn within(said: &Said, text: &str) -> String {
        let (routine, problems) = language::routine("a.routine", text, &known());
        assert!(problems.is_empty(), "{problems:?}");
        let new = said.within(text, &routine, &known());
        let (_, problems) = language::routine("a.routine", &new, &known());
        assert!(problems.is_empty(), "{new}\n{problems:?}");
        new
    }

    #[test]
    fn what_says_otherwise_goes_where_it_stands() {
        let said = Said {
            age: Some("The person is 75".into()),
            pace: Some("The person walks at 0.5 m/s".into()),
            ..Said::default()
        };
        let text = "# Margaret is 82.\nMargaret is 82. She walks at about 0.65 m/s. # slow\nShe naps.\n";
        let new = "# Margaret is 82.\nThe person is 75. The person walks at 0.5 m/s. # slow\nShe naps.\n\n";
        assert_eq!(within(&said, text), new);
        assert_eq!(within(&said, "She naps."), "She naps.\nThe person walks at 0.5 m/s.\nThe person is 75.\n");
    }

    #[test]
    fn other_conditions_are_shown_instead() {
        let none = Said { conditions: Some(Vec::new()), ..Said::default() };
        let one = Said { conditions: Some(vec!["The person shows frailty".into()]), ..Said::default() };
        let text = "She naps. From week 6 she shows mild depression. She reads.\r\nShe shows frailty.";
        let rest = "She naps.                                      . She reads.\r\n                 .";
        assert_eq!(within(&none, text), format!("{rest}\n"));
        assert_eq!(within(&one, text), format!("{rest}\nThe person shows frailty.\n"));
        assert_eq!(within(&Said::default(), text), format!("{text}\n"));
    }

    #[test]
    fn a_heading_goes_with_the_last_line_below_it() {
        let none = Said { conditions: Some(Vec::new()), ..Said::default() };
        let alone = within(&none, "She naps.\nFrom week 6\n  she shows depression\n  she shows frailty\nShe reads.");
        assert_eq!(alone.split_whitespace().collect::<Vec<_>>().join(" "), "She naps. She reads.");
        let not_alone = within(&none, "From week 6\n  she shows depression\n  she naps\n");
        assert!(not_alone.starts_with("From week 6\n") && not_alone.contains("she naps"));
    }
}
