//! What a rule waits for: "the stove has been on for 20 minutes", "the door bell rings", "it gets dark and she is alone".

use super::activities;
use super::amounts::{self, Unit, amount};
use super::clause::{PLACES, eat_preposition};
use super::messages::{RuleMessage, WordMessage};
use super::reader::{Reader, Sort, is_determiner};
use super::subjects::{self, Subject};
use super::times;
use super::unknown;
use super::words::{Span, Token};
use crate::routine::{Activity, Circumstance, Trigger};
use homebody_core::fuzzy::Fuzzy;

const DAY_S: f64 = 86_400.0;

/// What begins a rule, and for how long it has to last, each with where that is said.
pub fn trigger(reader: &mut Reader, is_first: bool) -> Option<(Trigger, Span, Fuzzy, Span)> {
    let from = reader.at;
    let whenever = match reader.attempt(event) {
        Some(event) => event,
        None => state(reader)?,
    };
    if whenever == Trigger::Follows && is_first {
        let span = reader.span(from);
        reader.fault(span, RuleMessage::NoRuleBefore);
    }
    let span = reader.span(from);
    let needs_length = matches!(whenever, Trigger::On(_) | Trigger::At(_) | Trigger::Away | Trigger::InBed);
    if !needs_length && reader.peek(0) != "for" {
        return Some((whenever, span, Fuzzy::exactly(0.0), span));
    }
    let (lasts, lasts_span) = how_long(reader)?;
    Some((whenever, span, lasts, lasts_span))
}

/// "and she is not in the kitchen", "unless her daughter is there".
pub fn circumstances(reader: &mut Reader) -> Option<Vec<Circumstance>> {
    let mut found = Vec::new();
    loop {
        let begins = |reader: &mut Reader| {
            reader.skip_commas();
            reader.eat_any(&[
                ("and only if|when|while", true),
                ("only if|when|while", true),
                ("and unless", false),
                ("unless", false),
                ("and", true),
                ("if", true),
                ("while", true),
            ])
        };
        let Some(holds) = reader.attempt(begins) else { return Some(found) };
        let from = reader.at;
        let (state, is_so) = if let Some(said) = reader.attempt(circumstance) {
            said
        } else {
            let span = if reader.is_over() { reader.here() } else { reader.span(from) };
            reader.fault(span, RuleMessage::NoCircumstance);
            return None;
        };
        found.push(Circumstance { holds: holds == is_so, state });
    }
}

/// A state, and whether it is so.
fn circumstance(reader: &mut Reader) -> Option<(Trigger, bool)> {
    if reader.eat("it is|gets") || reader.eat("it has been") {
        let not = reader.eat("not") || reader.eat("no longer");
        let reads = [("dark", true), ("light|bright|day", false)];
        if let Some(is_dark) = reader.eat_any(&reads) {
            return Some((Trigger::Dark(room(reader)), is_dark != not));
        }
        return Some((between(reader)?, !not));
    }
    if let Some(company) = reader.attempt(company) {
        return Some(company);
    }
    let from = reader.at;
    if subjects::subject(reader) == Some(Subject::Person) {
        if !(reader.eat("is|are") || reader.eat("has been")) {
            return None;
        }
        let not = reader.eat("not") || reader.eat("no longer");
        return Some((of_person(reader)?, !not));
    }
    reader.at = from;
    let thing = reader.name(&[Sort::Thing])?;
    reader.eat("is|are").then_some(())?;
    let not = reader.eat("not") || reader.eat("no longer");
    let is_on = reader.eat_any(&[("on|open|running", true), ("off|shut|closed", false)])?;
    Some((Trigger::Rings(thing), is_on != not))
}

/// "somebody is there", "her daughter is not there", "nobody is at home".
fn company(reader: &mut Reader) -> Option<(Trigger, bool)> {
    if reader.ahead(|reader| reader.name(&[Sort::Thing]).is_some()) {
        return None;
    }
    let who = if reader.eat("somebody|someone|anybody|anyone") || reader.eat("a|any visitor") {
        Some((None, true))
    } else if reader.eat("nobody") || reader.eat("no one") {
        Some((None, false))
    } else {
        match subjects::subject(reader)? {
            Subject::Visitor(name) => Some((Some(name), true)),
            _ => None,
        }
    };
    let (who, is_so) = who?;
    reader.eat("else");
    (reader.eat("is|are") || reader.eat("has been")).then_some(())?;
    let is_there = {
        let not = reader.eat("not");
        reader.eat("there|here|in|present|visiting|around").then_some(!not).or_else(|| {
            (reader.eat("at home") || reader.eat("in the house|home|flat|apartment") || reader.eat("with her|him|them"))
                .then_some(!not)
        })?
    };
    Some((Trigger::Company(who), is_so == is_there))
}

/// How the person is, behind "is".
fn of_person(reader: &mut Reader) -> Option<Trigger> {
    if reader.eat("alone") || reader.eat("by herself|himself") || reader.eat("on her|his own") {
        reader.eat("at home");
        return Some(Trigger::Alone);
    }
    if reader.eat("away|out|gone|outside") {
        return Some(Trigger::Away);
    }
    if let Some(activity) = reader.attempt(doing) {
        return Some(Trigger::Doing(activity));
    }
    let sits = reader.eat("sitting|seated");
    let lies = !sits && reader.eat("lying|asleep|resting");
    if reader.eat("in bed") {
        return Some(Trigger::InBed);
    }
    reader.eat("standing|staying");
    let place = reader.attempt(|reader| if eat_preposition(reader) { reader.name(&PLACES) } else { None });
    match place {
        Some(place) => Some(Trigger::At(place)),
        None if sits => Some(Trigger::Sitting),
        None if lies => Some(Trigger::InBed),
        None => None,
    }
}

/// "reading", "watching television": what lasts.
fn doing(reader: &mut Reader) -> Option<Activity> {
    reader.peek(0).ends_with("ing").then_some(())?;
    if ["sitting", "lying", "standing", "staying"].contains(&reader.peek(0)) {
        return None;
    }
    activities::activity(reader)
}

fn room(reader: &mut Reader) -> Option<String> {
    reader.attempt(|reader| if reader.eat("in") { reader.name(&[Sort::Room]) } else { None })
}

/// "after 20:00", "before 8:00", "between 20:00 and 6:00".
fn between(reader: &mut Reader) -> Option<Trigger> {
    if reader.eat("between") {
        let (from, to) = times::time_range(reader, "and")?;
        return Some(Trigger::Between(from.at.rem_euclid(DAY_S), to.at.rem_euclid(DAY_S)));
    }
    if reader.eat("after|past") || reader.eat("later than") {
        return Some(Trigger::Between(times::time(reader, true)?.at.rem_euclid(DAY_S), DAY_S));
    }
    reader.eat("before|earlier").then_some(())?;
    Some(Trigger::Between(0.0, times::time(reader, true)?.at.rem_euclid(DAY_S)))
}

/// What happens rather than lasts: a bell, dusk, an hour, somebody who comes, what is begun or over.
fn event(reader: &mut Reader) -> Option<Trigger> {
    if reader.eat("it gets|becomes|grows|is") {
        reader.eat("already");
        if reader.eat("dark") {
            return Some(Trigger::Dark(room(reader)));
        }
        let at = times::time(reader, true)?.at.rem_euclid(DAY_S);
        return Some(Trigger::Between(at, DAY_S));
    }
    if reader.eat("nobody is there|home|here") || reader.eat("nobody is at home") || reader.eat("no one is there") {
        return Some(Trigger::Alone);
    }
    if let Some(found) = reader.attempt(rings) {
        return Some(found);
    }
    if let Some(found) = reader.attempt(somebody_comes) {
        return Some(found);
    }
    (subjects::subject(reader) == Some(Subject::Person)).then_some(())?;
    if reader.eat("does so|that|it|this") || reader.eat("has done so|that|it|this") {
        return Some(Trigger::Follows);
    }
    if reader.eat("needs the toilet|bathroom|loo") || reader.eat("needs to go to the toilet|bathroom|loo") {
        return Some(Trigger::Doing(Activity::UseBathroom));
    }
    let feels = [
        ("is|feels|gets thirsty", Activity::Drink),
        ("is|feels|gets hungry", Activity::Snack),
        ("is|feels|gets tired|sleepy", Activity::Nap),
    ];
    if let Some((_, activity)) = feels.into_iter().find(|(words, _)| reader.eat(words)) {
        return Some(Trigger::Doing(activity));
    }
    if reader.eat("starts|begins to") {
        return activities::activity(reader).map(Trigger::Doing);
    }
    if reader.eat("has finished|stopped|ended") || reader.eat("finishes|stops|ends") {
        return activities::event(reader).map(Trigger::Done);
    }
    if reader.eat("comes|gets home|back") || reader.eat("has come home|back") {
        return Some(Trigger::Done(Activity::Leave));
    }
    let has = reader.attempt(|reader| (reader.eat("has|have") && !["been"].contains(&reader.peek(0))).then_some(()));
    if has.is_some() {
        return activities::activity(reader).map(Trigger::Done);
    }
    let is_doing = |reader: &mut Reader| {
        (reader.eat("is|are") || reader.eat("has|have been")).then_some(())?;
        doing(reader)
    };
    reader.attempt(is_doing).or_else(|| reader.attempt(activities::activity)).map(Trigger::Doing)
}

/// "the door bell rings".
fn rings(reader: &mut Reader) -> Option<Trigger> {
    let from = reader.at;
    let thing = match reader.name(&[Sort::Thing]) {
        Some(thing) => thing,
        None => {
            while reader.token(0) == Some(Token::Word)
                && !["rings", "goes"].contains(&reader.peek(0))
                && reader.at < from + 4
            {
                reader.at += 1;
            }
            (reader.at > from && is_determiner(&reader.words[from].text) && reader.eat("rings")).then_some(())?;
            let span = reader.span(from);
            reader.fault(span, WordMessage::NothingRings { text: reader.said(span) });
            return Some(Trigger::Rings(String::new()));
        }
    };
    (reader.eat("rings|sounds|buzzes")
        || reader.eat("goes off")
        || reader.eat("is turned|switched on")
        || reader.eat("is rung|opened"))
    .then_some(Trigger::Rings(thing))
}

/// "her daughter comes", "somebody visits".
fn somebody_comes(reader: &mut Reader) -> Option<Trigger> {
    if reader.ahead(|reader| reader.name(&[Sort::Thing]).is_some()) {
        return None;
    }
    let who = if reader.eat("somebody|someone|anybody|anyone") || reader.eat("a visitor") {
        None
    } else {
        match subjects::subject(reader)? {
            Subject::Visitor(name) => Some(name),
            _ => return None,
        }
    };
    (reader.eat("comes|arrives|visits")
        || reader.eat("has come|arrived")
        || reader.eat("has been there|here|home")
        || reader.eat("is there|here|home"))
    .then_some(())?;
    reader.eat("there|here|in|home");
    Some(Trigger::Company(who))
}

/// A state that has lasted.
fn state(reader: &mut Reader) -> Option<Trigger> {
    let from = reader.at;
    if subjects::subject(reader) == Some(Subject::Person) {
        if !is_or_was(reader) {
            reader.fault(reader.here(), RuleMessage::NoWhere);
            return None;
        }
        if let Some(state) = reader.attempt(of_person) {
            return Some(state);
        }
        reader.eat("sitting|lying|standing|staying");
        eat_preposition(reader);
        unknown::unknown_name(reader, &PLACES, unknown::no_place);
        return None;
    }
    reader.at = from;
    let Some(thing) = reader.name(&[Sort::Thing]) else {
        unknown::unknown_name(reader, &[Sort::Thing], unknown::no_thing);
        return None;
    };
    let is = is_or_was(reader);
    reader.eat("left");
    if is && reader.eat("on|open|running") {
        return Some(Trigger::On(thing));
    }
    reader.fault(reader.here(), RuleMessage::NoState { thing });
    None
}

fn is_or_was(reader: &mut Reader) -> bool {
    reader.eat("has|have been") || reader.eat("is|are|stays|lies")
}

fn how_long(reader: &mut Reader) -> Option<(Fuzzy, Span)> {
    let from = reader.at;
    if !reader.eat("for") {
        reader.fault(reader.here(), RuleMessage::NoLength);
        return None;
    }
    let _ = reader.eat("more|longer than") || reader.eat("over");
    let Some(amount) = amount(reader).filter(|amount| amount.unit == Unit::Second) else {
        reader.fault(reader.here(), RuleMessage::NoLength);
        return None;
    };
    let span = reader.span(from);
    if amount.from <= 0.0 {
        reader.fault(amount.span, RuleMessage::Always { text: reader.said(amount.span) });
        return Some((Fuzzy::exactly(1.0), span));
    }
    Some((amounts::duration(reader, &amount), span))
}
