//! The words behind the verb, in any order, and messages about those not understood.

use super::activities;
use super::adverbs::Adverbs;
use super::amounts::{AmountUnit, amount};
use super::circumstances::{
    counts_cups, says_alone, says_beside, says_company, says_doing, says_errand, says_late, says_length, says_meal,
    says_outside, says_purpose, stays_on,
};
use super::clause::{Clause, ClauseJoin, PLACES, eat_preposition, place};
use super::falling::says_fall;
use super::faults::did_you_mean;
use super::measures::measure;
use super::messages::{SentenceMessage, WordMessage};
use super::predicate::Predicate;
use super::predicates::IS;
use super::reader::SentenceReader;
use super::unknown_word;
use super::words::{TextSpan, Token};
use crate::routine::Activity;
use homebody_core::problem::Advice;

pub fn tail(reader: &mut SentenceReader, clause: &mut Clause) -> Option<Option<(ClauseJoin, TextSpan)>> {
    loop {
        if says_fall(reader, clause) || says_beside(reader, clause) || stays_on(reader, clause) {
            continue;
        }
        if let Some(join) = in_list(reader, clause) {
            let span = reader.here();
            reader.skip_commas();
            return Some(Some((join, span)));
        }
        reader.skip_commas();
        if reader.is_over() {
            return Some(None);
        }
        let at = reader.at;
        if matches!(clause.predicate, Predicate::Remark | Predicate::Age(_) | Predicate::Kind(_)) && reader.eat("who") {
            return Some(Some((ClauseJoin::And, reader.span(at))));
        }
        if matches!(clause.predicate, Predicate::Does(_)) && reader.eat("only") {
            continue;
        }
        if clause.adverbs.excepted(reader).is_some() {
            continue;
        }
        if reader.eat("and then") || reader.eat("then") {
            return Some(Some((ClauseJoin::Then, reader.span(at))));
        }
        if let Some(join) =
            reader.eat_any(&[("and also", ClauseJoin::And), ("and|but", ClauseJoin::And), ("or", ClauseJoin::Or)])
        {
            return Some(Some((join, reader.span(at))));
        }
        if matches!(clause.predicate, Predicate::Remark) {
            not_understood(reader, clause);
            return None;
        }
        // "sees her at home"
        if matches!(clause.predicate, Predicate::Visits | Predicate::Helps(..)) && reader.eat("at home") {
            continue;
        }
        let more = [
            says_purpose,
            says_doing,
            says_alone,
            says_outside,
            says_company,
            says_meal,
            says_errand,
            says_late,
            counts_cups,
        ];
        if more.iter().any(|more| more(reader, clause)) {
            continue;
        }
        if let Some(measure) = measure(reader) {
            if clause.measure.is_some() {
                reader.fault(measure.span, SentenceMessage::SecondChange { text: reader.said(measure.span) });
            }
            clause.measure = Some(measure);
            continue;
        }
        if put_place(reader, clause) || clause.adverbs.next(reader) || says_length(reader, clause) {
            continue;
        }
        not_understood(reader, clause);
        return None;
    }
}

fn in_list(reader: &mut SentenceReader, clause: &Clause) -> Option<ClauseJoin> {
    if reader.token(0) != Some(Token::Comma) {
        return None;
    }
    let says_who = reader.ahead(|reader| {
        reader.skip_commas();
        Adverbs::default().all(reader);
        reader.eat("she|he") && !reader.is_over()
    });
    if says_who && !matches!(clause.predicate, Predicate::Remark) {
        return Some(ClauseJoin::And);
    }
    let goes_on = reader.ahead(|reader| {
        reader.skip_commas();
        let is_verb = reader.names.lexicon.is_third_person(reader.peek(0));
        is_verb && activities::activity(reader).is_some()
    });
    let rest = reader.words.get(reader.at..).unwrap_or_default();
    let has = |word: &str| rest.iter().any(|one| one.text == word);
    if goes_on && !has("or") && !has("then") && !matches!(clause.predicate, Predicate::Remark) {
        return Some(ClauseJoin::And);
    }
    let joins = |word: &str| rest.iter().any(|one| one.text == word);
    let join = if joins("or") { ClauseJoin::Or } else { ClauseJoin::And };
    if !(joins("or") || joins("and")) || rest.iter().any(|one| one.text == "then") {
        return None;
    }
    let goes_on = reader.ahead(|reader| {
        reader.skip_commas();
        let from = reader.at;
        let verb = activities::activity(reader).is_some();
        reader.at = from;
        let again = clause.adverbs.when.is_some() && {
            let mut more = Adverbs::default();
            more.next(reader) && more.when.is_some()
        };
        reader.at = from;
        let object = activities::noun(reader).is_some() && matches!(clause.predicate, Predicate::Does(_));
        verb || again || object
    });
    goes_on.then_some(join)
}

/// A place within the rest of a clause; the kitchen of "cleans the kitchen" is one too.
fn put_place(reader: &mut SentenceReader, clause: &mut Clause) -> bool {
    let start = reader.at;
    let cleans = matches!(&clause.predicate, Predicate::Does(Activity::Housework));
    let found = place(reader).or_else(|| {
        let name = if cleans { reader.name(&PLACES) } else { None }?;
        Some((name, reader.span(start)))
    });
    let Some((name, span)) = found else { return false };
    if let Some((first, _)) = &clause.place {
        let (text, first) = (reader.said(span), first.clone());
        reader.fault(span, SentenceMessage::TwoPlaces { text, first });
    }
    clause.place = Some((name, span));
    true
}

fn not_understood(reader: &mut SentenceReader, clause: &Clause) {
    let (here, word) = (reader.here(), reader.peek(0).to_owned());
    let at = reader.at;
    if reader.eat("to") && activities::activity(reader).is_some() {
        let (span, doing) = (reader.span(at), reader.said(reader.span(at + 1)));
        if let Predicate::Own(words) = &clause.predicate {
            let text = format!("{words} {}", reader.said(span));
            let is_not = words.split(' ').any(|word| word == "not");
            let help = (!is_not).then(|| format!("write \"she {}\"", activities::in_third_person(&doing)));
            return reader.fault(clause.predicate_span.to(span), SentenceMessage::Roundabout { text, help });
        }
        let (text, activity) = (reader.said(span), activities::in_third_person(&doing));
        return reader.fault(span, SentenceMessage::Purpose { text, activity });
    }
    reader.at = at;
    if eat_preposition(reader) && !reader.is_over() && !matches!(reader.token(0), Some(Token::Number(_))) {
        let goes = match &clause.predicate {
            Predicate::Own(words) => unknown_word::is_way(words),
            other => *other == Predicate::Is,
        };
        let outside = goes.then_some("for what is outside, write \"she goes out at 10:00 for 2 hours\"");
        unknown_word::unknown_name_or(reader, &PLACES, unknown_word::no_place_or_time, outside);
        return;
    }
    reader.at = at;
    if let Predicate::Own(words) = &clause.predicate {
        return unknown_word::unknown_verb(reader, words, clause.predicate_span);
    }
    let text = reader.said(here);
    if reader.faults.is_trial {
        return reader.fault(here, WordMessage::NotUnderstood { text, help: None });
    }
    let help = Some(expected(reader, clause, &word));
    reader.fault(here, WordMessage::NotUnderstood { text, help });
}

fn expected(reader: &mut SentenceReader, clause: &Clause, word: &str) -> Advice {
    if word == "when" && (reader.peek(1) == "it" || reader.peek(2) == "weather")
        || ["weather", "rain", "snow"].contains(&reader.peek(1))
    {
        return unknown_word::NO_WEATHER.into();
    }
    if clause.predicate == Predicate::Walks && ["slowly", "unsteadily", "carefully", "quickly"].contains(&word) {
        return "say how fast, \"she walks at 0.5 m/s\", or how it changes: \"from week 10 she walks 10 % slower\""
            .into();
    }
    if clause.predicate == Predicate::Is && word == "up" {
        return "say what she does then: \"she goes to the bathroom 3 times a night\", \"she lies awake at night\", \"she wanders \
            at night\""
            .into();
    }
    if ["when", "if", "whenever", "because", "unless"].contains(&word) {
        return "what depends on something begins with it: \"whenever she has been in bed for 10 hours, she gets up\""
            .into();
    }
    if word == "late" || word == "early" {
        return format!(
            "say at what time, such as \"at about 9:00\", or by how much: \"1 hour {}\"",
            if word == "late" { "later" } else { "earlier" }
        )
        .into();
    }
    if let Some(advice) = slip(word) {
        return advice;
    }
    let length = reader.ahead(amount).filter(|amount| matches!(amount.unit, AmountUnit::Second | AmountUnit::Day));
    if let Some(length) = length {
        return format!("write \"for {}\"", reader.said(length.span)).into();
    }
    if clause.predicate == Predicate::Is {
        return IS.into();
    }
    if word == "to" {
        return "for a stretch of time, write \"from 10:00 to 12:00\"".into();
    }
    if matches!(reader.token(0), Some(Token::Number(_)))
        && reader.token(1) == Some(Token::Word)
        && !reader.ahead(|reader| amount(reader).is_some_and(|amount| amount.unit != AmountUnit::None))
    {
        return format!("say how many times, or for how long: \"{word} times a day\", \"for {word} minutes\"").into();
    }
    if word == "until" || word == "till" {
        return "write \"until 22:00\" or \"until day 100\"".into();
    }
    if word.contains(',') {
        return format!("a number has a point, not a comma: {:?}", word.replace(',', ".")).into();
    }
    if "later earlier longer shorter more less slower faster".split(' ').any(|more| more == word) {
        if clause.predicate == Predicate::Walks {
            return "say by how much, such as \"10 % slower\"".into();
        }
        return format!("say by how much, such as \"1 hour {word}\" or \"30 % {word}\"").into();
    }
    "expected where, when, how long or how often: \"in the armchair\", \"at about 19:00\", \"for 20 minutes\"".into()
}

pub fn slip(word: &str) -> Option<Advice> {
    const OWN: &str = "the is no non this that these those there then them when what was were are be been will would all low \
        within without three eight nine ten twelve nights times tires days day mum dad he she it its his her too two to so \
        up down over other only more most less like just such some same still take takes made make home time";
    if OWN.split_whitespace().any(|own| own == word) {
        return None;
    }
    did_you_mean(word, vocabulary().filter(|known| *known != word)).filter(|advice| advice.fix.is_some())
}

pub fn vocabulary() -> impl Iterator<Item = &'static str> + Clone {
    const WORDS: &str = "she he they her his their the about around at on in for from until over after before with \
        between and then every most often sometimes rarely usually always almost never once twice times minutes hours \
        days weeks months morning afternoon evening night noon midnight monday tuesday wednesday thursday friday \
        saturday sunday weekdays weekends january february march april june july august september october november \
        december winter spring summer autumn breakfast lunch dinner bed give take later earlier longer shorter more \
        less slower faster week day whenever first fading percent seldom daily o'clock during half";
    WORDS.split_whitespace()
}
