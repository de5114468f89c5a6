//! The routine language: habits, rules and changes in sentences that a nurse can read aloud.
//!
//! In reading order: `words` splits text into sentences of words. The `grammar`, read from `english.grammar`, and the
//! `lexicon`, read from `english.words`, say which sentences there are; the `chart` finds all readings of a sentence, and the
//! `productions` make their values, whose `parts` fill slots. `sentence` chooses the reading; `sharing` divides parts among the
//! clauses; `build`, `changes` and `stays` make habits, changes and rules of them; `refusal` says what is not covered; `check`
//! finds contradictions. `faults` collects all problems and reports them together.

pub mod activities;
pub mod amounts;
mod build;
mod builder;
mod calendar;
pub(crate) mod canonical;
mod changes;
mod chart;
mod check;
mod clock;
mod draft;
mod faults;
mod filled_chart;
mod grammar;
mod known_names;
pub mod lexicon;
pub(crate) mod messages;
mod names;
mod offers;
mod parts;
mod productions;
mod refusal;
mod rewriting;
mod sentence;
mod sharing;
pub mod statement;
mod stays;
#[cfg(test)]
mod tests;
pub mod times;
mod tokens;
mod value;
mod verb_forms;
mod words;

use crate::routine::{Quote, Routine, RoutinePerson};
use builder::{Built, Context, PersonFact};
use draft::{RoutineDraft, quote};
use faults::Faults;
use homebody_core::problem::Problem;
pub use known_names::KnownNames;
pub use lexicon::Lexicon;
use messages::SentenceMessage;
use names::HomeNames;
use parts::Parts;
use sentence::{Budget, Reading, read};
use std::ops::Range;
use tokens::span_of;
use words::{Sentence, TextSpan};

/// Largest length of a line.
pub const LONGEST_LINE: usize = 2_000;

/// Largest number of sentences.
pub const MOST_SENTENCES: usize = 2_000;

/// The mark of a sentence that is kept and has no effect.
const NOTE: &str = "note:";

/// The words before the colon of a line that names the language of a routine.
const LANGUAGE_HEADS: [&str; 2] = ["language", "sprache"];

/// The words for the severity of a condition, from mild to severe.
const SEVERITIES: &str = "mild|slight|light|moderate|severe|serious|strong";

pub fn routine(file: &str, text: &str, known: &KnownNames) -> (Routine, Vec<Problem>) {
    read_text(file, text, known, false)
}

pub fn condition(file: &str, text: &str, known: &KnownNames) -> (Routine, Vec<Problem>) {
    let known = KnownNames { person: None, ..known.clone() };
    read_text(file, text, &known, true)
}

pub fn place(said: &Quote, text: &str) -> Range<usize> {
    let line = words::lines(text)[said.line as usize - 1];
    let before: usize = line.text.chars().take(said.column as usize - 1).map(char::len_utf8).sum();
    line.start + before..line.start + before + said.text.len()
}

/// The whole sentence that has these words, with its full stop; of a note, from "Note:" on.
pub fn sentence_place(said: &Quote, text: &str) -> Range<usize> {
    let words = place(said, text);
    let line = words::lines(text)[said.line as usize - 1];
    let begin = line.start + line.text.len() - line.text.trim_start().len();
    if text[begin..words.start].trim_end().eq_ignore_ascii_case(NOTE) {
        return begin..words.end;
    }
    let lexicon = language_of(text).0.unwrap_or(Lexicon::built_in());
    let sentences = words::sentences(line, &|word| lexicon.is_word("after-ordinals", word));
    let spans = sentences.iter().map(Sentence::span);
    let span = spans.into_iter().find(|span| span.start <= words.start && words.end <= span.end);
    let (start, end) = span.map_or((words.start, words.end), |span| (span.start, span.end));
    let after = text[end..line.start + line.text.len()].split('#').next().unwrap_or_default();
    let signs = after.split(char::is_alphanumeric).next().unwrap_or_default();
    let closing = match signs.find(['.', '!', '?', ';']) {
        Some(stop) => stop + 1,
        None if signs == after => signs.trim_end().len(),
        None => 0,
    };
    start..end + closing
}

/// True for a routine in English, the language of canonical sentences.
pub fn is_english(text: &str) -> bool {
    language_of(text).0.is_none_or(|language| std::ptr::eq(language, Lexicon::built_in()))
}

pub fn severities() -> impl Iterator<Item = &'static str> + Clone {
    SEVERITIES.split('|')
}

struct Heading {
    parts: Parts,
    span: TextSpan,
    is_used: bool,
}

struct TextReader<'t> {
    text: &'t str,
    draft: RoutineDraft,
    names: HomeNames,
    faults: Faults,
    heading: Option<Heading>,
    budget: Budget,
}

/// Steps that a text takes for sentences that are refused (our choice): those of some twenty long ones.
const MOST_STEPS_OF_REFUSED: usize = 400_000;

fn read_text(file: &str, text: &str, known: &KnownNames, is_condition: bool) -> (Routine, Vec<Problem>) {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let (language, unknown) = language_of(text);
    let known = &KnownNames { lexicon: language.unwrap_or(&known.lexicon).clone(), ..known.clone() };
    let draft = RoutineDraft {
        routine: Routine { file: file.into(), ..Routine::default() },
        is_condition,
        name: None,
        habit_spans: Vec::new(),
        finders: Vec::new(),
        rule_spans: Vec::new(),
        first_date: known.first_date,
        usual: known.usual.clone(),
    };
    let lines = words::lines(text);
    let mut reader = TextReader {
        text,
        draft,
        names: HomeNames::new(known),
        faults: Faults::default(),
        heading: None,
        budget: Budget { left: MOST_STEPS_OF_REFUSED },
    };
    if let Some((span, name)) = unknown {
        reader.faults.add(span, SentenceMessage::UnknownLanguage { name });
    }
    reader.lines(&lines);
    reader.close();
    check::check(&reader.draft, &mut reader.faults);
    let problems = reader.faults.problems(&reader.draft.routine.file, &lines);
    (reader.draft.routine, problems)
}

/// The language that the first line names, if it names one: "Language: German". An unknown one is a problem.
fn language_of(text: &str) -> (Option<&'static Lexicon>, Option<(TextSpan, String)>) {
    let says = |line: &words::TextLine| line.text.split('#').next().is_some_and(|said| !said.trim().is_empty());
    let Some(line) = words::lines(text).into_iter().find(says) else { return (None, None) };
    let Some((start, name)) = named_language(line.text) else { return (None, None) };
    let language = Lexicon::of_language(name);
    let span = TextSpan { start: line.start + start, end: line.start + start + name.len() };
    (language, language.is_none().then(|| (span, name.to_owned())))
}

/// The name of a language in a line that is about nothing else, and where it begins.
fn named_language(line: &str) -> Option<(usize, &str)> {
    let (head, name) = line.split('#').next()?.split_once(':')?;
    let is_head = LANGUAGE_HEADS.contains(&head.trim().to_lowercase().as_str());
    let begin = head.len() + 1 + name.len() - name.trim_start().len();
    is_head.then(|| (begin, name.trim().trim_end_matches('.')))
}

impl TextReader<'_> {
    fn lines(&mut self, lines: &[words::TextLine]) {
        let mut count: usize = 0;
        for line in lines {
            if line.text.chars().nth(LONGEST_LINE).is_some() {
                let span = TextSpan { start: line.start, end: line.start };
                self.faults.add(span, SentenceMessage::LongLine { most: LONGEST_LINE });
                continue;
            }
            // Below a heading, a sentence that says nothing is one too: one that was taken out leaves its full stop.
            if let Some(heading) =
                self.heading.as_mut().filter(|_| line.is_indented() && line.text.trim().starts_with('.'))
            {
                heading.is_used = true;
            }
            if self.note(line) || named_language(line.text).is_some() {
                continue;
            }
            let lexicon = self.names.lexicon.clone();
            for sentence in words::sentences(*line, &|word| lexicon.is_word("after-ordinals", word)) {
                count += 1;
                if count > MOST_SENTENCES {
                    self.faults.add(sentence.span(), SentenceMessage::TooManySentences { most: MOST_SENTENCES });
                    return;
                }
                self.sentence(&sentence);
            }
        }
    }

    /// Keeps what stands behind "Note:" as it is.
    fn note(&mut self, line: &words::TextLine) -> bool {
        let said = line.text.trim_start();
        let begins = said.get(..NOTE.len()).is_some_and(|begin| begin.eq_ignore_ascii_case(NOTE));
        let rest = said.get(NOTE.len()..).unwrap_or_default().trim();
        if begins && !rest.is_empty() {
            let start = line.start + line.text.find(rest).unwrap_or(0);
            let span = TextSpan { start, end: start + rest.len() };
            self.draft.routine.remarks.push(quote(self.text, span));
        }
        begins
    }

    fn sentence(&mut self, sentence: &Sentence) {
        let span = span_of(&sentence.words);
        if !sentence.indented {
            self.close();
        } else if let Some(heading) = self.heading.as_mut() {
            heading.is_used = true;
        } else {
            self.faults.add(span, SentenceMessage::Indented);
        }
        let context = Context {
            text: self.text,
            lexicon: &self.names.lexicon,
            is_condition: self.draft.is_condition,
            person: self.names.person.as_deref(),
            first_date: self.draft.first_date,
            heading: self.heading.as_ref().map(|heading| &heading.parts),
            has_habits: !self.draft.routine.habits.is_empty(),
            has_rules: !self.draft.routine.rules.is_empty(),
            rooms: &self.names.rooms,
        };
        let reading = read(&self.names, context, &sentence.words, sentence.indented, &mut self.budget);
        match reading {
            Reading::Heading(parts) => self.heading = Some(Heading { parts: *parts, span, is_used: false }),
            Reading::Meaning(built) => self.add(*built),
            Reading::Refused(faults) => {
                faults.into_iter().for_each(|(span, message)| self.faults.add(span, message));
                if !sentence.indented {
                    self.heading = Some(Heading { parts: Parts::default(), span, is_used: true });
                }
            }
        }
    }

    fn add(&mut self, built: Built) {
        if let Some(name) = built.name {
            self.names.is_about(Some(&name));
            self.draft.name = Some(name);
        }
        for (fact, span, whole) in built.facts {
            self.fact(fact, span, whole);
        }
        for (habit, span) in built.habits {
            self.draft.routine.habits.push(habit);
            self.draft.habit_spans.push(span);
        }
        self.draft.routine.changes.extend(built.changes);
        for (rule, trigger, lasts) in built.rules {
            self.draft.routine.rules.push(rule);
            self.draft.rule_spans.push((trigger, lasts));
        }
        self.draft.finders.extend(built.finders);
    }

    fn fact(&mut self, fact: PersonFact, span: TextSpan, whole: TextSpan) {
        let name = self.draft.name.clone().or_else(|| self.names.person.clone()).unwrap_or_default();
        let said = quote(self.text, whole);
        let person = self.draft.routine.person.get_or_insert(RoutinePerson {
            said: said.clone(),
            name,
            ..RoutinePerson::default()
        });
        let again = match fact {
            PersonFact::Age(age) => {
                person.age_years = Some(age);
                person.age_said.replace(said).is_some()
            }
            PersonFact::Pace(pace) => {
                person.pace_mps = Some(pace);
                person.pace_said.replace(said).is_some()
            }
            PersonFact::Rests(rests) => {
                person.rests_said = Some(said);
                person.rests.replace(rests).is_some()
            }
            PersonFact::Kind(kind) => {
                person.kind_said = Some(said);
                std::mem::replace(&mut person.kind, kind) != crate::routine::ResidentKind::default()
            }
        };
        if again {
            let text = productions::arguments::said(self.text, span);
            self.faults.add(span, SentenceMessage::SaidBefore { text });
        }
    }

    fn close(&mut self) {
        if let Some(heading) = self.heading.take().filter(|heading| !heading.is_used) {
            self.faults.add(heading.span, SentenceMessage::EmptyHeading);
        }
    }
}
