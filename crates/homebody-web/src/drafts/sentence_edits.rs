//! The changes of a routine's text that write a statement into it.

use homebody_routine::explain::in_the_voice_of;
use homebody_routine::language::sentence_place;
use homebody_routine::routine::{HabitTime, Quote, RoutinePerson, RuleTrigger};
use homebody_routine::statement::Statement;
use std::collections::BTreeSet;
use std::ops::Range;

/// A part of a text in bytes, and the text in its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SentenceEdit {
    pub range: Range<usize>,
    pub insert: String,
}

/// A sentence of a statement: its place in the text, and its canonical form.
#[derive(Clone, Debug, Default)]
struct StatementPart {
    place: Option<Range<usize>>,
    sentence: Option<String>,
}

/// Canonical sentences as a routine says them: of a man whom it calls "he", and with a capital letter at the start.
pub fn written(text: &str, sentences: Vec<String>) -> String {
    let sentence = |sentence: String| {
        let mut letters = in_the_voice_of(text, &sentence);
        if let Some(first) = letters.chars().next() {
            letters.replace_range(..first.len_utf8(), &first.to_uppercase().to_string());
        }
        letters
    };
    sentences.into_iter().map(sentence).collect::<Vec<_>>().join(" ")
}

/// The places of the sentences of a statement, in the order of the text.
pub fn places(said: &Quote, statement: &Statement, text: &str) -> Vec<Range<usize>> {
    let places = parts(said, statement, text).into_iter().filter_map(|part| part.place);
    let in_order: BTreeSet<(usize, usize)> = places.map(|place| (place.start, place.end)).collect();
    in_order.into_iter().map(|(start, end)| start..end).collect()
}

/// The changes that put a statement in the place of another one. Statements of the same sentence get sentences of their own.
pub fn replacing(text: &str, all: &[(Quote, Statement)], at: usize, new: &Statement) -> Vec<SentenceEdit> {
    let old = parts(&all[at].0, &all[at].1, text);
    let fresh = in_place_of(&old, &all[at].1, new);
    let is_changed = |(old, fresh): &(&StatementPart, &Option<String>)| old.sentence != **fresh;
    let changed = old.iter().zip(&fresh).filter(is_changed).filter_map(|(old, _)| old.place.clone());
    let changed: BTreeSet<(usize, usize)> = changed.map(|place| (place.start, place.end)).collect();
    let mut edits: Vec<SentenceEdit> = Vec::new();
    for (start, end) in changed {
        let is_here = |part: &StatementPart| part.place == Some(start..end);
        let mut sentences = Vec::new();
        for (index, (said, statement)) in all.iter().enumerate() {
            match index == at {
                true => sentences
                    .extend(old.iter().zip(&fresh).filter(|(old, _)| is_here(old)).filter_map(|(_, new)| new.clone())),
                false => sentences
                    .extend(parts(said, statement, text).into_iter().filter(is_here).filter_map(|part| part.sentence)),
            }
        }
        edits.push(in_place(text, start..end, &written(text, sentences)));
    }
    let more: Vec<String> =
        old.iter().zip(&fresh).filter(|(old, _)| old.place.is_none()).filter_map(|(_, new)| new.clone()).collect();
    if !more.is_empty() {
        let last = old.iter().filter_map(|part| part.place.as_ref()).map(|place| place.end).max().unwrap_or(text.len());
        edits.push(on_a_new_line(text, line_of(text, last), &written(text, more)));
    }
    edits
}

/// The change that adds a statement on a line of its own: after a line, or after the block that the line is in.
pub fn adding(text: &str, all: &[(Quote, Statement)], line: usize, new: &Statement) -> SentenceEdit {
    let mut after = end_of_block(text, line);
    // A sentence with "then" stays behind the one before it.
    let is_new_following = follows(new);
    let later = all.iter().filter(|(said, _)| said.line as usize > line);
    for (said, _) in later.take_while(|(_, statement)| !is_new_following && follows(statement)) {
        after = end_of_block(text, after.max(said.line as usize));
    }
    on_a_new_line(text, after, &written(text, new.sentences()))
}

/// The text with all changes.
pub fn applied(text: &str, edits: &[SentenceEdit]) -> String {
    let mut text = text.to_owned();
    for edit in edits.iter().rev() {
        text.replace_range(edit.range.clone(), &edit.insert);
    }
    text
}

/// The line and the column of a byte, both from 1, the column in characters.
pub fn position(text: &str, at: usize) -> (u32, u32) {
    let before = &text[..at];
    let start = before.rfind(['\n', '\r']).map_or(0, |end| end + 1);
    (line_of(text, at) as u32, before[start..].chars().count() as u32 + 1)
}

fn parts(said: &Quote, statement: &Statement, text: &str) -> Vec<StatementPart> {
    let place = |said: &Quote| Some(sentence_place(said, text));
    match statement {
        Statement::Person(person) => {
            let facts = facts(person);
            facts.map(|(said, sentence)| StatementPart { place: said.and_then(place), sentence }).into()
        }
        other => vec![StatementPart { place: place(said), sentence: Some(other.sentences().join(" ")) }],
    }
}

/// The kind, the age, the pace and the rests of a person: the words of the text, and the canonical sentence.
fn facts(person: &RoutinePerson) -> [(Option<&Quote>, Option<String>); 4] {
    let bare = RoutinePerson { name: person.name.clone(), ..RoutinePerson::default() };
    let only = |person: RoutinePerson| Statement::Person(person).sentences().pop();
    [
        (person.kind_said.as_ref(), only(RoutinePerson { kind: person.kind, ..bare.clone() })),
        (person.age_said.as_ref(), only(RoutinePerson { age_years: person.age_years, ..bare.clone() })),
        (person.pace_said.as_ref(), only(RoutinePerson { pace_mps: person.pace_mps, ..bare.clone() })),
        (person.rests_said.as_ref(), only(RoutinePerson { rests: person.rests, ..bare })),
    ]
}

/// The new sentence for each part of the old statement.
fn in_place_of(old: &[StatementPart], was: &Statement, new: &Statement) -> Vec<Option<String>> {
    if let (Statement::Person(_), Statement::Person(person)) = (was, new) {
        return facts(person).map(|(_, sentence)| sentence).into();
    }
    let first = old.iter().position(|part| part.place.is_some()).unwrap_or(0);
    let sentence = |index: usize| (index == first).then(|| new.sentences().join(" "));
    (0..old.len()).map(sentence).collect()
}

/// Words at the start of a sentence that are small inside one.
const SMALL_WORDS: [&str; 4] = ["She ", "He ", "Her ", "His "];

/// A sentence in the place of another. Without a full stop before, it has none; a line that becomes empty is removed.
fn in_place(text: &str, place: Range<usize>, sentence: &str) -> SentenceEdit {
    let is_open = |text: &str| !text.ends_with(['.', '!', '?', ';']);
    if !sentence.is_empty() {
        let old = &text[place.clone()];
        let stop = if is_open(old) { "." } else { "" };
        let mut insert = sentence.strip_suffix(stop).unwrap_or(sentence).to_owned();
        // Under a heading, sentences begin with a small letter; a name keeps its own.
        let is_small = old.starts_with(char::is_lowercase);
        if is_small && SMALL_WORDS.iter().any(|word| insert.starts_with(word)) {
            insert[..1].make_ascii_lowercase();
        }
        return SentenceEdit { insert, range: place };
    }
    let line_start = text[..place.start].rfind(['\n', '\r']).map_or(0, |end| end + 1);
    let rest = &text[place.end..];
    let line_end = rest.find('\n').map_or(text.len(), |end| place.end + end + 1);
    let is_alone = text[line_start..place.start].trim().is_empty() && text[place.end..line_end].trim().is_empty();
    let range = match is_alone {
        true => line_start..line_end,
        false => place.start..place.end + rest.len() - rest.trim_start_matches(' ').len(),
    };
    SentenceEdit { range, insert: String::new() }
}

/// A sentence after a line, or in the place of an empty one.
fn on_a_new_line(text: &str, line: usize, sentence: &str) -> SentenceEdit {
    let start: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    let said = text[start..].split('\n').next().unwrap_or_default();
    let said = said.strip_suffix('\r').unwrap_or(said);
    match said.trim().is_empty() {
        true => SentenceEdit { range: start..start + said.len(), insert: sentence.to_owned() },
        false => SentenceEdit { range: start + said.len()..start + said.len(), insert: format!("\n{sentence}") },
    }
}

/// The last line of the block of a line: a heading with the indented lines below it.
fn end_of_block(text: &str, line: usize) -> usize {
    let lines = text.lines().enumerate().skip(line).map(|(index, line)| (index + 1, line));
    let said = lines.filter(|(_, line)| !line.split('#').next().unwrap_or_default().trim().is_empty());
    said.take_while(|(_, line)| line.starts_with([' ', '\t', '\u{a0}']))
        .map(|(number, _)| number)
        .last()
        .unwrap_or(line)
}

/// Whether it follows the statement before it in the text.
fn follows(statement: &Statement) -> bool {
    match statement {
        Statement::Rule(rule) => rule.whenever == RuleTrigger::Follows,
        Statement::Habit(habit)
        | Statement::Sleep(habit)
        | Statement::Away(habit)
        | Statement::Visit(habit)
        | Statement::Event(habit) => habit.when.time == HabitTime::Then,
        _ => false,
    }
}

fn line_of(text: &str, at: usize) -> usize {
    text[..at].matches('\n').count() + 1
}
