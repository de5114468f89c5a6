//! "Whenever the stove has been on for 20 minutes, she turns it off."

use super::activities;
use super::adverbs::Adverbs;
use super::amounts::{self, Unit, amount};
use super::build::only;
use super::clause::{Clause, PLACES, eat_preposition, tail};
use super::draft::Draft;
use super::meaning::Kind;
use super::predicates;
use super::reader::{Reader, Sort};
use super::said::{self, Predicate};
use super::subjects::{self, Subject};
use super::unknown;
use super::words::Span;
use crate::fuzzy::Fuzzy;
use crate::routine::{Response, Rule, Trigger};

/// Reads a rule from behind "whenever".
pub fn rule(reader: &mut Reader, draft: &mut Draft, front: &Adverbs) {
    only(reader, front, &[Kind::Phase], "a rule holds whenever it comes true");
    let from = reader.at;
    let Some(whenever) = trigger(reader) else { return };
    let trigger_span = reader.span(from);
    let Some((lasts, lasts_span)) = how_long(reader) else { return };
    reader.skip_commas();
    reader.eat("then");
    let mut adverbs = Adverbs::default();
    let start = reader.at;
    match subjects::subject(reader) {
        Some(Subject::Person) => {}
        Some(_) => {
            let span = reader.span(start);
            let what = format!("{:?} does not live here", reader.said(span));
            return reader.fault(span, what, "a rule says what she does".to_owned());
        }
        None if reader.is_over() => {
            let hint = "write \"..., she turns it off\"".to_owned();
            return reader.fault(reader.here(), "it is not said what she does then", hint);
        }
        None => {
            let hint = "write \"she\" after the comma".to_owned();
            return reader.fault(reader.here(), "it is not said who does this", hint);
        }
    }
    adverbs.all(reader);
    let Some(response) = response(reader, &whenever, &mut adverbs) else { return };
    adverbs.all(reader);
    if !reader.is_over() {
        let (here, hint) = (reader.here(), "a rule ends with what she does".to_owned());
        let what = format!("{:?} is not understood here", reader.said(here));
        return reader.fault(here, what, hint);
    }
    only(reader, &adverbs, &[Kind::Chance, Kind::Lasts, Kind::Phase], "a rule holds whenever it comes true");
    let probability = adverbs.chance.as_ref().map_or(1.0, |chance| chance.value.probability);
    let all = adverbs.under(front);
    let phase = all.phase_meant(reader, draft.is_condition);
    let span = reader.span(0);
    draft.phase(reader, &phase, &all, span);
    let rule = Rule { said: draft.said(span), whenever, lasts, probability, phase, response };
    draft.routine.rules.push(rule);
    draft.rule_spans.push((trigger_span, lasts_span));
}

fn trigger(reader: &mut Reader) -> Option<Trigger> {
    let from = reader.at;
    if subjects::subject(reader) == Some(Subject::Person) {
        if !is_or_was(reader) {
            let hint = "write \"she has been in the bathroom for 45 minutes\"".to_owned();
            reader.fault(reader.here(), "it is not said where she is", hint);
            return None;
        }
        reader.eat("sitting|lying|standing|staying");
        if reader.eat("away|out|gone|outside") || reader.eat("away from home") {
            return Some(Trigger::Away);
        }
        if reader.eat("in bed") {
            return Some(Trigger::InBed);
        }
        if eat_preposition(reader)
            && let Some(place) = reader.name(&PLACES)
        {
            return Some(Trigger::At(place));
        }
        unknown::unknown_name(reader, &PLACES, "no place of this home");
        return None;
    }
    reader.at = from;
    let Some(thing) = reader.name(&[Sort::Thing]) else {
        unknown::unknown_name(reader, &[Sort::Thing], "nothing that this home has");
        return None;
    };
    let is = is_or_was(reader);
    reader.eat("left");
    if is && reader.eat("on|open|running") {
        return Some(Trigger::On(thing));
    }
    let hint = format!("write \"the {thing} has been on for 20 minutes\" or \"has been open for 5 minutes\"");
    reader.fault(reader.here(), format!("it is not said how the {thing} is"), hint);
    None
}

fn is_or_was(reader: &mut Reader) -> bool {
    reader.eat("has|have been") || reader.eat("is|are|stays|lies")
}

fn how_long(reader: &mut Reader) -> Option<(Fuzzy, Span)> {
    let hint = "write \"for 20 minutes\"".to_owned();
    let from = reader.at;
    if !reader.eat("for") {
        reader.fault(reader.here(), "it is not said for how long", hint);
        return None;
    }
    let _ = reader.eat("more|longer than") || reader.eat("over");
    let Some(amount) = amount(reader).filter(|amount| amount.unit == Unit::Second) else {
        reader.fault(reader.here(), "it is not said for how long", hint);
        return None;
    };
    let span = reader.span(from);
    if amount.from <= 0.0 {
        let what = format!("{:?} is no time at all: this would always be so", reader.said(amount.span));
        reader.fault(amount.span, what, hint);
        return Some((Fuzzy::exactly(1.0), span));
    }
    Some((amounts::duration(reader, &amount), span))
}

fn response(reader: &mut Reader, whenever: &Trigger, adverbs: &mut Adverbs) -> Option<Response> {
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
            (true, Trigger::On(thing)) => Some(thing.clone()),
            (true, _) => None,
            (false, _) => reader.name(&PLACES),
        };
        let Some(place) = place else {
            unknown::unknown_name(reader, &PLACES, "no place of this home");
            return None;
        };
        let activity = crate::routine::Activity::Other(words);
        adverbs.all(reader);
        let lasts = adverbs.lasts.as_ref().map(|slot| slot.value);
        return Some(Response::Do { activity, place: Some(place), lasts });
    }
    let Some((words, span)) = said::own_words(reader) else {
        let here = reader.here();
        let words = reader.said(here).to_lowercase();
        unknown::unknown_verb(reader, &words, here);
        return None;
    };
    if unknown::is_nearly_known(&words) {
        unknown::unknown_verb(reader, &words, span);
        return None;
    }
    done(reader, Predicate::Own(words), from, adverbs)
}

/// "turns it off", "closes the fridge".
fn turn(reader: &mut Reader, whenever: &Trigger) -> Option<Option<Response>> {
    let turns = reader.eat("turns|turn|switches|switch");
    let on_off = [("on", true), ("off", false)];
    let mut on = if turns {
        reader.eat_any(&on_off)
    } else {
        Some(reader.eat_any(&[("closes|close|shuts|shut", false), ("opens|open", true)])?)
    };
    let thing = if reader.eat("it|them") {
        match whenever {
            Trigger::On(thing) => thing.clone(),
            _ => {
                let span = reader.span(reader.at.saturating_sub(1));
                reader.fault(span, "it is not clear what \"it\" is", "name the thing".to_owned());
                return Some(None);
            }
        }
    } else {
        predicates::thing(reader)
    };
    on = on.or_else(|| reader.eat_any(&on_off));
    let Some(on) = on else {
        let here = reader.here();
        reader.fault(here, "it is not said whether on or off", "write \"she turns it off\"".to_owned());
        return Some(None);
    };
    Some(Some(Response::Turn { thing, on }))
}

/// An activity with where and how long.
fn done(reader: &mut Reader, predicate: Predicate, from: usize, adverbs: &mut Adverbs) -> Option<Response> {
    let span = reader.span(from);
    let mut clause = Clause {
        span,
        subject: Subject::Person,
        predicate,
        predicate_span: span,
        place: None,
        measure: None,
        adverbs: adverbs.clone(),
        tends: false,
        beside: Vec::new(),
        again: false,
    };
    let then = tail(reader, &mut clause)?;
    if let Some(span) = then.map(|(_, span)| span).or(clause.measure.map(|measure| measure.span)) {
        let what = format!("{:?} does not fit here: a rule says one thing that is done", reader.said(span));
        reader.fault(span, what, None);
        return None;
    }
    *adverbs = clause.adverbs;
    let place = clause.place.map(|(place, _)| place);
    let lasts = adverbs.lasts.as_ref().map(|slot| slot.value);
    let activity = match clause.predicate {
        Predicate::Does(activity) => activity,
        Predicate::Own(words) if place.is_some() && lasts.is_some() => crate::routine::Activity::Other(words),
        Predicate::Own(words) => {
            unknown::unknown_verb(reader, &words, span);
            return None;
        }
        _ => return None,
    };
    Some(Response::Do { activity, place, lasts })
}
