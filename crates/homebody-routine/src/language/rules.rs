//! "Whenever the stove has been on for 20 minutes, she turns it off."

use super::activities;
use super::adverbs::Adverbs;
use super::amounts::{AmountUnit, amount};
use super::build::only;
use super::clause::{Clause, PLACES};
use super::draft::RoutineDraft;
use super::meaning::AdverbKind;
use super::messages::{RuleSentenceMessage, WordMessage};
use super::predicate::{self, Predicate};
use super::predicate_tail::tail;
use super::predicates;
use super::reader::{SentenceReader, Sort};
use super::subjects::{self, SentenceSubject};
use super::triggers::{circumstances, trigger};
use super::unknown_word;
use super::words::{SentenceWord, Token};
use crate::routine::{HabitChance, Lapse, Response, RoutineRule, RuleTrigger, When};

/// Reads a rule from behind "whenever".
pub fn rule(reader: &mut SentenceReader, draft: &mut RoutineDraft, front: &Adverbs) {
    only(reader, front, &[AdverbKind::Phase], "a rule starts each time its first part comes true");
    let is_first = draft.routine.rules.is_empty();
    let Some((whenever, trigger_span, lasts, lasts_span)) = trigger(reader, is_first) else { return };
    let Some(mut only_if) = circumstances(reader) else { return };
    reader.skip_commas();
    reader.eat("then");
    let mut adverbs = Adverbs::default();
    let start = reader.at;
    match subjects::subject(reader) {
        Some(SentenceSubject::Person) => {}
        Some(_) => {
            let span = reader.span(start);
            return reader.fault(span, RuleSentenceMessage::NotTheResident { text: reader.said(span) });
        }
        None if reader.is_over() => {
            return reader.fault(reader.here(), RuleSentenceMessage::NoAnswer);
        }
        None => {
            let help = "write \"she\" after the comma".to_owned();
            return reader.fault(reader.here(), WordMessage::NoSubject { help });
        }
    }
    adverbs.all(reader);
    let Some(response) = response(reader, &whenever, &mut adverbs) else { return };
    more(reader, &mut adverbs);
    let Some(then) = steps(reader, &whenever, &response) else { return };
    let lapse = reader.attempt(lapse);
    let Some(more) = circumstances(reader) else { return };
    only_if.extend(more);
    if !reader.is_over() {
        let (here, help) = (reader.here(), Some("end the rule with what she does".into()));
        return reader.fault(here, WordMessage::NotUnderstood { text: reader.said(here), help });
    }
    only(
        reader,
        &adverbs,
        &[AdverbKind::Chance, AdverbKind::Lasts, AdverbKind::Phase],
        "a rule starts each time its first part comes true",
    );
    let chance = adverbs.chance.as_ref().map_or(HabitChance::ALWAYS, |chance| chance.value);
    let all = adverbs.under(front);
    let phase = all.phase_meant(reader, draft.is_condition);
    let span = reader.span(0);
    draft.phase(reader, &phase, &all, span);
    let when = When { phase, chance, ..When::default() };
    let rule = RoutineRule { said: draft.said(span), whenever, lasts, only_if, when, response, then, lapse };
    draft.routine.rules.push(rule);
    draft.rule_spans.push((trigger_span, lasts_span));
}

fn more(reader: &mut SentenceReader, adverbs: &mut Adverbs) {
    let ends = |word: &str| ["and", "then"].contains(&word) || DEPENDS.contains(&word);
    while reader.token(0) == Some(Token::Word) && !ends(reader.peek(0)) && adverbs.next(reader) {}
}

const DEPENDS: [&str; 5] = ["but", "unless", "if", "while", "only"];

fn steps(reader: &mut SentenceReader, whenever: &RuleTrigger, first: &Response) -> Option<Vec<Response>> {
    let mut then: Vec<Response> = Vec::new();
    loop {
        let goes_on = |reader: &mut SentenceReader| {
            let comma = reader.token(0) == Some(Token::Comma);
            reader.skip_commas();
            let joins = reader.eat("and then|afterwards") || reader.eat("and|then");
            reader.eat("she|he|they");
            let is_step = (joins || comma) && !reader.is_over() && !DEPENDS.contains(&reader.peek(0));
            (is_step && reader.ahead(|reader| is_verb(reader))).then_some(())
        };
        if reader.attempt(goes_on).is_none() {
            return Some(then);
        }
        let mut adverbs = Adverbs::default();
        // "Opens it" is about what was gone to.
        let is_thing = |place: &str| reader.names.has(&place.to_lowercase(), Sort::Thing);
        let used = then.iter().rev().chain([first]).find_map(|step| match step {
            Response::Turn { thing, .. } => Some(thing.clone()),
            Response::Do { place: Some(place), .. } if is_thing(place) => Some(place.clone()),
            Response::Do { .. } => None,
        });
        let it = used.map_or(whenever.clone(), RuleTrigger::On);
        let step = response(reader, &it, &mut adverbs)?;
        more(reader, &mut adverbs);
        then.push(match (step, adverbs.lasts) {
            (Response::Do { activity, place, lasts: None }, Some(lasts)) => {
                Response::Do { activity, place, lasts: Some(lasts.value) }
            }
            (step, _) => step,
        });
    }
}

fn is_verb(reader: &mut SentenceReader) -> bool {
    let is_state = ["is", "has", "somebody", "this"].contains(&reader.peek(0));
    reader.peek(0).ends_with('s') && (!is_state || reader.ahead(activities::activity).is_some())
}

/// "but often forgets it", "but she forgets it on 20 % of occasions and does it an hour later".
fn lapse(reader: &mut SentenceReader) -> Option<Lapse> {
    reader.skip_commas();
    reader.eat("but|and").then_some(())?;
    reader.eat("she|he|they");
    let mut adverbs = Adverbs::default();
    adverbs.all(reader);
    reader.eat("forgets").then_some(())?;
    reader.eat("it|to|this|so");
    adverbs.all(reader);
    let later = reader.attempt(|reader| {
        reader.eat("and");
        reader.eat("she|he|they");
        reader.eat("does|remembers it|so").then_some(())?;
        reader.eat("only|about");
        let later = amount(reader).filter(|amount| amount.unit == AmountUnit::Second)?.as_duration();
        reader.eat("later|afterwards").then_some(later)
    });
    let probability = adverbs.chance.as_ref().map_or(FORGETS, |chance| chance.value.probability);
    Some(Lapse { probability, later })
}

/// Probability of forgetting, if the sentence gives none (our choice).
const FORGETS: f64 = 0.3;

fn response(reader: &mut SentenceReader, whenever: &RuleTrigger, adverbs: &mut Adverbs) -> Option<Response> {
    let from = reader.at;
    if let Some(turn) = turn(reader, whenever) {
        return turn;
    }
    reader.at = from;
    if let Some(activity) = activities::activity(reader) {
        return done(reader, Predicate::Does(activity), from, adverbs);
    }
    if reader.eat("checks|check") || reader.eat("looks|look at|after") || reader.eat("goes|go to") {
        let words = reader.passed(from).trim_end_matches(" to").to_owned();
        let place = match (reader.eat("it"), whenever) {
            (true, RuleTrigger::On(thing) | RuleTrigger::Rings(thing)) => Some(thing.clone()),
            (true, _) => None,
            (false, _) => reader.name(&PLACES),
        };
        let Some(place) = place else {
            unknown_word::unknown_name(reader, &PLACES, unknown_word::no_place);
            return None;
        };
        let activity = crate::routine::Activity::Other(words);
        more(reader, adverbs);
        let lasts = adverbs.lasts.as_ref().map(|slot| slot.value);
        return Some(Response::Do { activity, place: Some(place), lasts });
    }
    let Some((words, span)) = predicate::own_words(reader) else {
        let here = reader.here();
        let words = reader.said(here).to_lowercase();
        unknown_word::unknown_verb(reader, &words, here);
        return None;
    };
    if unknown_word::is_nearly_known(&words) {
        unknown_word::unknown_verb(reader, &words, span);
        return None;
    }
    done(reader, Predicate::Own(words), from, adverbs)
}

/// "turns it off", "closes the fridge".
fn turn(reader: &mut SentenceReader, whenever: &RuleTrigger) -> Option<Option<Response>> {
    let turns = reader.eat("turns|turn|switches|switch");
    let on_off = [("on", true), ("off", false)];
    let mut on = if turns {
        reader.eat_any(&on_off)
    } else {
        Some(reader.eat_any(&[("closes|close|shuts|shut", false), ("opens|open", true)])?)
    };
    let thing = if reader.eat("it|them") {
        match whenever {
            RuleTrigger::On(thing) | RuleTrigger::Rings(thing) => thing.clone(),
            _ => {
                let span = reader.span(reader.at.saturating_sub(1));
                reader.fault(span, RuleSentenceMessage::WhichThing);
                return Some(None);
            }
        }
    } else {
        predicates::thing(reader)
    };
    on = on.or_else(|| reader.eat_any(&on_off));
    let Some(on) = on else {
        let here = reader.here();
        reader.fault(here, RuleSentenceMessage::OnOrOff);
        return Some(None);
    };
    Some(Some(Response::Turn { thing, on }))
}

fn done(reader: &mut SentenceReader, predicate: Predicate, from: usize, adverbs: &mut Adverbs) -> Option<Response> {
    let span = reader.span(from);
    let mut clause = Clause {
        span,
        subject: SentenceSubject::Person,
        predicate,
        predicate_span: span,
        place: None,
        measure: None,
        adverbs: adverbs.clone(),
        tends: false,
        beside: Vec::new(),
        finder: None,
        again: false,
    };
    let is_other = |word: &SentenceWord| DEPENDS.contains(&word.text.as_str()) && word.text != "only";
    let rest = reader.words.get(reader.at..).unwrap_or_default();
    let end = rest.iter().position(is_other).map_or(reader.words.len(), |end| reader.at + end);
    let mut up_to = SentenceReader {
        words: &reader.words[..end],
        at: reader.at,
        names: reader.names,
        faults: &mut *reader.faults,
        text: reader.text,
        part: reader.part,
    };
    let then = tail(&mut up_to, &mut clause)?;
    reader.at = up_to.at;
    if let Some((_, join)) = then {
        reader.at = reader.words.iter().position(|word| word.span.start >= join.start).unwrap_or(reader.at);
    }
    if let Some(span) = clause.measure.map(|measure| measure.span) {
        reader.fault(span, RuleSentenceMessage::ChangeInRule { text: reader.said(span) });
        return None;
    }
    *adverbs = clause.adverbs;
    let place = clause.place.map(|(place, _)| place);
    let lasts = adverbs.lasts.as_ref().map(|slot| slot.value);
    let activity = match clause.predicate {
        Predicate::Does(activity) => activity,
        Predicate::Own(words) if place.is_some() && lasts.is_some() => crate::routine::Activity::Other(words),
        Predicate::Own(words) => {
            unknown_word::unknown_verb(reader, &words, span);
            return None;
        }
        _ => return None,
    };
    Some(Response::Do { activity, place, lasts })
}
