//! A clause: who does what, with what stands behind the verb in any order.

use super::activities;
use super::adverbs::Adverbs;
use super::amounts::{Unit, amount};
use super::faults::did_you_mean;
use super::measures::{Measure, measure};
use super::predicates::{self, Predicate, Subject};
use super::reader::{Reader, Sort};
use super::words::{Span, Token};
use crate::routine::Activity;

/// What a habit may be said to be done at.
pub const PLACES: [Sort; 3] = [Sort::Place, Sort::Room, Sort::Thing];

/// A clause with all that was said in it.
#[derive(Clone, Debug)]
pub struct Clause {
    pub span: Span,
    pub subject: Subject,
    pub predicate: Predicate,
    pub predicate_span: Span,
    pub place: Option<(String, Span)>,
    pub measure: Option<Measure>,
    pub adverbs: Adverbs,
}

/// Reads the rest of a clause. Nothing if it is not understood; else the "then" that another clause follows.
pub fn tail(reader: &mut Reader, clause: &mut Clause) -> Option<Option<Span>> {
    loop {
        reader.skip_commas();
        if reader.is_over() {
            return Some(None);
        }
        let at = reader.at;
        if reader.eat("and then") || reader.eat("then") {
            return Some(Some(reader.span(at)));
        }
        if let Some(measure) = measure(reader) {
            if clause.measure.is_some() {
                let what = format!("{:?} is a second change in one sentence", reader.said(measure.span));
                reader.fault(measure.span, what, "make two sentences".to_owned());
            }
            clause.measure = Some(measure);
            continue;
        }
        if put_place(reader, clause) || clause.adverbs.next(reader) {
            continue;
        }
        not_understood(reader, clause);
        return None;
    }
}

/// "in the armchair".
pub fn place(reader: &mut Reader) -> Option<(String, Span)> {
    let start = reader.at;
    let name = reader.attempt(|reader| if eat_preposition(reader) { reader.name(&PLACES) } else { None })?;
    Some((name, reader.span(start)))
}

/// A place within the rest of a clause; the kitchen of "cleans the kitchen" is one too.
fn put_place(reader: &mut Reader, clause: &mut Clause) -> bool {
    let start = reader.at;
    let cleans = matches!(&clause.predicate, Predicate::Does(Activity::Housework));
    let found = place(reader).or_else(|| {
        let name = if cleans { reader.name(&PLACES) } else { None }?;
        Some((name, reader.span(start)))
    });
    let Some((name, span)) = found else { return false };
    if let Some((first, _)) = &clause.place {
        let what = format!("{:?} is a second place beside {first:?}", reader.said(span));
        reader.fault(span, what, "leave one of them out, or make two sentences".to_owned());
    }
    clause.place = Some((name, span));
    true
}

pub fn eat_preposition(reader: &mut Reader) -> bool {
    reader.eat("in front of") || reader.eat("next to") || reader.eat("in|on|at|by|near|beside|to|from|into|onto")
}

fn not_understood(reader: &mut Reader, clause: &Clause) {
    let (here, word) = (reader.here(), reader.peek(0).to_owned());
    if word == "and" || word == "but" || word == "or" {
        let hint = match reader.ahead(|reader| {
            reader.at += 1;
            Adverbs::default().next(reader)
        }) {
            true => "make two sentences, one for each",
            false => "write \"then\" between things done one after another, or make two sentences",
        };
        let hint = hint.to_owned();
        return reader.fault(here, format!("{word:?} joins more than one sentence can say"), hint);
    }
    let at = reader.at;
    if reader.eat("to") && activities::activity(reader).is_some() {
        let (span, doing) = (reader.span(at), reader.said(reader.span(at + 1)));
        if let Predicate::Own(words) = &clause.predicate {
            let what = format!("{:?} says more than what is done", format!("{words} {}", reader.said(span)));
            let hint = format!("write \"she {}\"", activities::in_third_person(&doing));
            return reader.fault(clause.predicate_span.to(span), what, hint);
        }
        let hint = format!("say what she does, not what for: \"then she {}\"", activities::in_third_person(&doing));
        return reader.fault(span, format!("{:?} is a purpose", reader.said(span)), hint);
    }
    reader.at = at;
    if eat_preposition(reader) && !reader.is_over() && !matches!(reader.token(0), Some(Token::Number(_))) {
        let goes = match &clause.predicate {
            Predicate::Own(words) => predicates::is_way(words),
            other => *other == Predicate::Is,
        };
        let outside = goes.then_some("for what is outside, write \"she goes out at 10:00 for 2 hours\"");
        predicates::unknown_name_or(reader, &PLACES, "no place of this home, and no time", outside);
        return;
    }
    reader.at = at;
    if let Predicate::Own(words) = &clause.predicate {
        return predicates::unknown_verb(reader, words, clause.predicate_span);
    }
    let what = format!("{:?} is not understood here", reader.said(here));
    let hint = expected(reader, clause, &word);
    reader.fault(here, what, hint);
}

/// What could stand where a word is not understood.
fn expected(reader: &mut Reader, clause: &Clause, word: &str) -> String {
    if ["when", "if", "whenever", "because", "unless"].contains(&word) {
        return "what depends on something begins with it: \"whenever she has been in bed for 10 hours, she gets up\""
            .into();
    }
    if word == "late" || word == "early" {
        return format!(
            "say at what time, such as \"at about 9:00\", or by how much: \"1 hour {}\"",
            if word == "late" { "later" } else { "earlier" }
        );
    }
    let known = did_you_mean(word, vocabulary().filter(|known| *known != word));
    if let Some(hint) = known.filter(|hint| hint.starts_with("did")) {
        return hint;
    }
    let length = reader.ahead(amount).filter(|amount| matches!(amount.unit, Unit::Second | Unit::Day));
    if let Some(length) = length {
        return format!("write \"for {}\"", reader.said(length.span));
    }
    if clause.predicate == Predicate::Is {
        return predicates::IS.into();
    }
    if word == "to" {
        return "for a stretch of time, write \"from 10:00 to 12:00\"".into();
    }
    if matches!(reader.token(0), Some(Token::Number(_)))
        && reader.token(1) == Some(Token::Word)
        && !reader.ahead(|reader| amount(reader).is_some_and(|amount| amount.unit != Unit::None))
    {
        return format!("say how many times, or for how long: \"{word} times a day\", \"for {word} minutes\"");
    }
    if word == "until" || word == "till" {
        return "write \"until 22:00\" or \"until day 100\"".into();
    }
    if word.contains(',') {
        return format!("a number has a point, not a comma: {:?}", word.replace(',', "."));
    }
    if "later earlier longer shorter more less slower faster".split(' ').any(|more| more == word) {
        if clause.predicate == Predicate::Walks {
            return "say by how much, such as \"10 % slower\"".into();
        }
        return format!("say by how much, such as \"1 hour {word}\" or \"30 % {word}\"");
    }
    "expected where, when, how long or how often: \"in the armchair\", \"at about 19:00\", \"for 20 minutes\"".into()
}

/// Words that slips are looked for among.
pub fn vocabulary() -> impl Iterator<Item = &'static str> + Clone {
    const WORDS: &str = "she he they her his their the about around at on in for from until over after before with \
        between and then every most often sometimes rarely usually always almost never once twice times minutes hours \
        days weeks months morning afternoon evening night noon midnight monday tuesday wednesday thursday friday \
        saturday sunday weekdays weekends january february march april june july august september october november \
        december winter spring summer autumn breakfast lunch dinner bed give take later earlier longer shorter more \
        less slower faster week day whenever first fading percent seldom daily o'clock during half";
    WORDS.split_whitespace()
}
