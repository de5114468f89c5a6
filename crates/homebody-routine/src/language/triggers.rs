//! The trigger of a rule: "the stove has been on for 20 minutes", "the door bell rings", "it gets dark and she is alone".

use super::activities;
use super::amounts::{self, AmountUnit, amount};
use super::clause::{PLACES, eat_preposition};
use super::messages::{RuleSentenceMessage, WordMessage};
use super::reader::{SentenceReader, Sort, is_determiner};
use super::subjects::{self, SentenceSubject};
use super::times;
use super::unknown_word;
use super::words::{TextSpan, Token};
use crate::routine::{Activity, Circumstance, RuleTrigger};
use homebody_core::fuzzy::Fuzzy;

const DAY_S: f64 = 86_400.0;

pub fn trigger(reader: &mut SentenceReader, is_first: bool) -> Option<(RuleTrigger, TextSpan, Fuzzy, TextSpan)> {
    let from = reader.at;
    let whenever = match reader.attempt(event) {
        Some(event) => event,
        None => state(reader)?,
    };
    if whenever == RuleTrigger::Follows && is_first {
        let span = reader.span(from);
        reader.fault(span, RuleSentenceMessage::NoRuleBefore);
    }
    let span = reader.span(from);
    let needs_length =
        matches!(whenever, RuleTrigger::On(_) | RuleTrigger::At(_) | RuleTrigger::Away | RuleTrigger::InBed);
    if !needs_length && reader.peek(0) != "for" {
        return Some((whenever, span, Fuzzy::exactly(0.0), span));
    }
    let (lasts, lasts_span) = how_long(reader)?;
    Some((whenever, span, lasts, lasts_span))
}

/// "and she is not in the kitchen", "unless her daughter is there".
pub fn circumstances(reader: &mut SentenceReader) -> Option<Vec<Circumstance>> {
    let mut found = Vec::new();
    loop {
        let begins = |reader: &mut SentenceReader| {
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
            reader.fault(span, RuleSentenceMessage::NoCircumstance);
            return None;
        };
        found.push(Circumstance { holds: holds == is_so, state });
    }
}

fn circumstance(reader: &mut SentenceReader) -> Option<(RuleTrigger, bool)> {
    if reader.eat("it is|gets") || reader.eat("it has been") {
        let not = reader.eat("not") || reader.eat("no longer");
        let reads = [("dark", true), ("light|bright|day", false)];
        if let Some(is_dark) = reader.eat_any(&reads) {
            return Some((RuleTrigger::Dark(room(reader)), is_dark != not));
        }
        return Some((between(reader)?, !not));
    }
    if let Some(company) = reader.attempt(company) {
        return Some(company);
    }
    let from = reader.at;
    if subjects::subject(reader) == Some(SentenceSubject::Person) {
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
    Some((RuleTrigger::Rings(thing), is_on != not))
}

/// "somebody is there", "her daughter is not there", "nobody is at home".
fn company(reader: &mut SentenceReader) -> Option<(RuleTrigger, bool)> {
    if reader.ahead(|reader| reader.name(&[Sort::Thing]).is_some()) {
        return None;
    }
    let who = if reader.eat("somebody|someone|anybody|anyone") || reader.eat("a|any visitor") {
        Some((None, true))
    } else if reader.eat("nobody") || reader.eat("no one") {
        Some((None, false))
    } else {
        match subjects::subject(reader)? {
            SentenceSubject::Visitor(name) => Some((Some(name), true)),
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
    Some((RuleTrigger::Company(who), is_so == is_there))
}

fn of_person(reader: &mut SentenceReader) -> Option<RuleTrigger> {
    if reader.eat("alone") || reader.eat("by herself|himself") || reader.eat("on her|his own") {
        reader.eat("at home");
        return Some(RuleTrigger::Alone);
    }
    if reader.eat("away|out|gone|outside") {
        return Some(RuleTrigger::Away);
    }
    if let Some(activity) = reader.attempt(doing) {
        return Some(RuleTrigger::Doing(activity));
    }
    let sits = reader.eat("sitting|seated");
    let lies = !sits && reader.eat("lying|asleep|resting");
    if reader.eat("in bed") {
        return Some(RuleTrigger::InBed);
    }
    reader.eat("standing|staying");
    let place = reader.attempt(|reader| if eat_preposition(reader) { reader.name(&PLACES) } else { None });
    match place {
        Some(place) => Some(RuleTrigger::At(place)),
        None if sits => Some(RuleTrigger::Sitting),
        None if lies => Some(RuleTrigger::InBed),
        None => None,
    }
}

/// "reading", "watching television": what lasts.
fn doing(reader: &mut SentenceReader) -> Option<Activity> {
    reader.peek(0).ends_with("ing").then_some(())?;
    if ["sitting", "lying", "standing", "staying"].contains(&reader.peek(0)) {
        return None;
    }
    activities::activity(reader)
}

fn room(reader: &mut SentenceReader) -> Option<String> {
    reader.attempt(|reader| if reader.eat("in") { reader.name(&[Sort::Room]) } else { None })
}

/// "after 20:00", "before 8:00", "between 20:00 and 6:00".
fn between(reader: &mut SentenceReader) -> Option<RuleTrigger> {
    if reader.eat("between") {
        let (from, to) = times::time_range(reader, "and")?;
        return Some(RuleTrigger::Between(from.at.rem_euclid(DAY_S), to.at.rem_euclid(DAY_S)));
    }
    if reader.eat("after|past") || reader.eat("later than") {
        return Some(RuleTrigger::Between(times::time(reader, true)?.at.rem_euclid(DAY_S), DAY_S));
    }
    reader.eat("before|earlier").then_some(())?;
    Some(RuleTrigger::Between(0.0, times::time(reader, true)?.at.rem_euclid(DAY_S)))
}

fn event(reader: &mut SentenceReader) -> Option<RuleTrigger> {
    if reader.eat("it gets|becomes|grows|is") {
        reader.eat("already");
        if reader.eat("dark") {
            return Some(RuleTrigger::Dark(room(reader)));
        }
        let at = times::time(reader, true)?.at.rem_euclid(DAY_S);
        return Some(RuleTrigger::Between(at, DAY_S));
    }
    if reader.eat("nobody is there|home|here") || reader.eat("nobody is at home") || reader.eat("no one is there") {
        return Some(RuleTrigger::Alone);
    }
    if let Some(found) = reader.attempt(rings) {
        return Some(found);
    }
    if let Some(found) = reader.attempt(somebody_comes) {
        return Some(found);
    }
    (subjects::subject(reader) == Some(SentenceSubject::Person)).then_some(())?;
    if reader.eat("does so|that|it|this") || reader.eat("has done so|that|it|this") {
        return Some(RuleTrigger::Follows);
    }
    if reader.eat("needs the toilet|bathroom|loo") || reader.eat("needs to go to the toilet|bathroom|loo") {
        return Some(RuleTrigger::Doing(Activity::UseBathroom));
    }
    let feels = [
        ("is|feels|gets thirsty", Activity::Drink),
        ("is|feels|gets hungry", Activity::Snack),
        ("is|feels|gets tired|sleepy", Activity::Nap),
    ];
    if let Some((_, activity)) = feels.into_iter().find(|(words, _)| reader.eat(words)) {
        return Some(RuleTrigger::Doing(activity));
    }
    if reader.eat("starts|begins to") {
        return activities::activity(reader).map(RuleTrigger::Doing);
    }
    if reader.eat("has finished|stopped|ended") || reader.eat("finishes|stops|ends") {
        return activities::event(reader).map(RuleTrigger::Done);
    }
    if reader.eat("comes|gets home|back") || reader.eat("has come home|back") {
        return Some(RuleTrigger::Done(Activity::Leave));
    }
    let has = reader.attempt(|reader| (reader.eat("has|have") && !["been"].contains(&reader.peek(0))).then_some(()));
    if has.is_some() {
        return activities::activity(reader).map(RuleTrigger::Done);
    }
    let is_doing = |reader: &mut SentenceReader| {
        (reader.eat("is|are") || reader.eat("has|have been")).then_some(())?;
        doing(reader)
    };
    reader.attempt(is_doing).or_else(|| reader.attempt(activities::activity)).map(RuleTrigger::Doing)
}

/// "the door bell rings".
fn rings(reader: &mut SentenceReader) -> Option<RuleTrigger> {
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
            return Some(RuleTrigger::Rings(String::new()));
        }
    };
    (reader.eat("rings|sounds|buzzes")
        || reader.eat("goes off")
        || reader.eat("is turned|switched on")
        || reader.eat("is rung|opened"))
    .then_some(RuleTrigger::Rings(thing))
}

/// "her daughter comes", "somebody visits".
fn somebody_comes(reader: &mut SentenceReader) -> Option<RuleTrigger> {
    if reader.ahead(|reader| reader.name(&[Sort::Thing]).is_some()) {
        return None;
    }
    let who = if reader.eat("somebody|someone|anybody|anyone") || reader.eat("a visitor") {
        None
    } else {
        match subjects::subject(reader)? {
            SentenceSubject::Visitor(name) => Some(name),
            _ => return None,
        }
    };
    (reader.eat("comes|arrives|visits")
        || reader.eat("has come|arrived")
        || reader.eat("has been there|here|home")
        || reader.eat("is there|here|home"))
    .then_some(())?;
    reader.eat("there|here|in|home");
    Some(RuleTrigger::Company(who))
}

fn state(reader: &mut SentenceReader) -> Option<RuleTrigger> {
    let from = reader.at;
    if subjects::subject(reader) == Some(SentenceSubject::Person) {
        if !is_or_was(reader) {
            reader.fault(reader.here(), RuleSentenceMessage::NoWhere);
            return None;
        }
        if let Some(state) = reader.attempt(of_person) {
            return Some(state);
        }
        reader.eat("sitting|lying|standing|staying");
        eat_preposition(reader);
        unknown_word::unknown_name(reader, &PLACES, unknown_word::no_place);
        return None;
    }
    reader.at = from;
    let Some(thing) = reader.name(&[Sort::Thing]) else {
        unknown_word::unknown_name(reader, &[Sort::Thing], unknown_word::no_thing);
        return None;
    };
    let is = is_or_was(reader);
    reader.eat("left");
    if is && reader.eat("on|open|running") {
        return Some(RuleTrigger::On(thing));
    }
    reader.fault(reader.here(), RuleSentenceMessage::NoState { thing });
    None
}

fn is_or_was(reader: &mut SentenceReader) -> bool {
    reader.eat("has|have been") || reader.eat("is|are|stays|lies")
}

fn how_long(reader: &mut SentenceReader) -> Option<(Fuzzy, TextSpan)> {
    let from = reader.at;
    if !reader.eat("for") {
        reader.fault(reader.here(), RuleSentenceMessage::NoLength);
        return None;
    }
    let _ = reader.eat("more|longer than") || reader.eat("over");
    let Some(amount) = amount(reader).filter(|amount| amount.unit == AmountUnit::Second) else {
        reader.fault(reader.here(), RuleSentenceMessage::NoLength);
        return None;
    };
    let span = reader.span(from);
    if amount.from <= 0.0 {
        reader.fault(amount.span, RuleSentenceMessage::Always { text: reader.said(amount.span) });
        return Some((Fuzzy::exactly(1.0), span));
    }
    Some((amounts::duration(reader, &amount), span))
}
