//! The verb of a sentence, with its objects.

use super::activities;
use super::adverbs::{Adverbs, Slot};
use super::amounts::{AmountUnit, amount};
use super::day_kind::has_days;
use super::falling::falls;
use super::faults::did_you_mean;
use super::indirect::{
    cared, falls_asleep, has_visitors, is_doing, is_helped, is_remark, spends, takes_long, tends_not, unable,
    unfinished, visited,
};
use super::measures::{Of, measure, rises_by};
use super::messages::{TimeSentenceMessage, WordMessage};
use super::predicate::Predicate;
use super::reader::{SentenceReader, Sort, begins_adverb};
use super::subjects::SentenceSubject;
use super::times;
use super::unknown_word::{no_thing, unknown_name};
use super::words::Token;
use crate::routine::{Activity, HabitTime, PartOfDay, ResidentKind, Shy};

const WHERE: &str = "at|in|on|by|near|beside|next";

pub fn predicate(reader: &mut SentenceReader, adverbs: &mut Adverbs) -> Option<Predicate> {
    if let Some(found) = roundabout(reader, adverbs) {
        return Some(found);
    }
    if reader.eat("is|are") {
        return Some(being(reader, adverbs));
    }
    if let Some(found) = reader.attempt(shying).or_else(|| falls(reader)) {
        return Some(found);
    }
    let not = reader.eat("does|do not") || reader.eat("doesn't|don't|never") || reader.eat("no longer");
    let stops = |reader: &mut SentenceReader| reader.eat("stops|stop") && !reader.ahead(|reader| reader.eat(WHERE));
    if not || reader.attempt(|reader| stops(reader).then_some(())).is_some() {
        reader.eat("ever");
        let other = reader.attempt(|reader| not_before(reader, adverbs)).or_else(|| reader.attempt(not_missed));
        return other.or_else(|| negated(reader));
    }
    if let Some(activity) = reader.attempt(|reader| until_up(reader, adverbs)) {
        return Some(Predicate::Does(activity));
    }
    if let Some((kind, very)) = reader.attempt(has_days) {
        return Some(Predicate::Lively(kind, very));
    }
    for read in [sleeps_in, walking, changing, illness, forgetting, skipping] {
        if let Some(found) = reader.attempt(read) {
            return Some(found);
        }
    }
    reader.attempt(|reader| {
        let begins = reader.eat("starts|start|begins|begin") && (reader.eat("to") || !reader.is_over());
        (begins && reader.ahead(activities::activity).is_some()).then_some(())
    });
    if let Some(found) = reader.attempt(|reader| wakes_at_night(reader, adverbs)) {
        return Some(found);
    }
    if let Some(activity) = activities::activity(reader) {
        if activity == Activity::GetUp
            && let Some(purpose) = at_night_for(reader, adverbs)
        {
            return Some(Predicate::Does(purpose));
        }
        if activity == Activity::ComeHome || activity == Activity::Leave {
            reader.attempt(|reader| (reader.eat("from") && reader.name(&[Sort::Place]).is_some()).then_some(()));
        }
        return Some(Predicate::Does(activity));
    }
    reader.eat("walks|walk").then_some(Predicate::Walks)
}

fn roundabout(reader: &mut SentenceReader, adverbs: &mut Adverbs) -> Option<Predicate> {
    let plain =
        [unable, unfinished, is_helped, visited, has_visitors, cared].into_iter().find_map(|read| reader.attempt(read));
    let found = plain
        .or_else(|| reader.attempt(|reader| tends_not(reader, adverbs)))
        .or_else(|| reader.attempt(|reader| falls_asleep(reader, adverbs)))
        .or_else(|| reader.attempt(|reader| takes_long(reader, adverbs)))
        .or_else(|| reader.attempt(|reader| spends(reader, adverbs)));
    if found.is_some() {
        return found;
    }
    if reader.ahead(|reader| reader.eat("is|are|be"))
        && let Some(activity) = reader.attempt(|reader| is_doing(reader, adverbs))
    {
        return Some(Predicate::Does(activity));
    }
    reader.attempt(is_remark).map(|()| Predicate::Remark)
}

fn wakes_at_night(reader: &mut SentenceReader, adverbs: &mut Adverbs) -> Option<Predicate> {
    if !["wakes", "wake", "waking"].contains(&reader.peek(0)) {
        return None;
    }
    activities::activity(reader)?;
    let mut rest = adverbs.clone();
    rest.all(reader);
    rest.part.as_ref().filter(|part| part.value == PartOfDay::Night)?;
    *adverbs = rest;
    Some(Predicate::Does(Activity::LieAwake))
}

fn until_up(reader: &mut SentenceReader, adverbs: &mut Adverbs) -> Option<Activity> {
    let stays_up = reader.eat("stays|stay|remains|remain up|awake");
    if !(stays_up || reader.eat("stays|stay|remains|remain|lies|lie in bed") || reader.eat("sleeps|sleep")) {
        return None;
    }
    reader.eat("in");
    let mut rest = adverbs.clone();
    rest.all(reader);
    let fits = |part: PartOfDay| (part == PartOfDay::Morning) != stays_up && part != PartOfDay::Afternoon;
    if rest.when.is_some() || rest.lasts.is_some() || rest.part.as_ref().is_some_and(|part| !fits(part.value)) {
        return None;
    }
    let until = rest.until_time.take()?;
    rest.when = Some(Slot { value: HabitTime::At(until.value), span: until.span, own: until.own });
    *adverbs = rest;
    Some(if stays_up { Activity::GoToBed } else { Activity::GetUp })
}

/// "gets up twice a night to go to the bathroom": what for.
fn at_night_for(reader: &mut SentenceReader, adverbs: &mut Adverbs) -> Option<Activity> {
    reader.attempt(|reader| {
        let mut rest = adverbs.clone();
        rest.all(reader);
        let at_night = rest.part.as_ref().is_some_and(|part| part.value == PartOfDay::Night);
        if !(at_night && reader.eat("to")) {
            return None;
        }
        let purpose = activities::activity(reader)?;
        *adverbs = rest;
        Some(purpose)
    })
}

fn sleeps_in(reader: &mut SentenceReader) -> Option<Predicate> {
    reader.eat("sleeps|sleep in after late nights").then_some(Predicate::SleepsIn)
}

/// "keeps close to the walls", "keeps away from others", "often stops as she wanders".
fn shying(reader: &mut SentenceReader) -> Option<Predicate> {
    let keeps = reader.eat("keeps|keep|stays|stay|walks|walk");
    if keeps
        && (reader.eat("close|near to the walls|wall")
            || reader.eat("along the walls|wall")
            || reader.eat("near the walls|wall"))
    {
        return Some(Predicate::Shy(Shy::OpenFloor));
    }
    if keeps && (reader.eat("away|clear from|of others|people") || reader.eat("away|clear from|of other people")) {
        return Some(Predicate::Shy(Shy::People));
    }
    if keeps {
        return None;
    }
    if reader.eat("fears|avoids open floor|floors|spaces") {
        return Some(Predicate::Shy(Shy::OpenFloor));
    }
    if reader.eat("avoids|shuns people|others|company") || reader.eat("avoids other people") {
        return Some(Predicate::Shy(Shy::People));
    }
    let stops = reader.eat("stops|pauses|halts")
        && (reader.eat("as|while|when she|he wanders|paces") || reader.eat("in wandering"));
    stops.then_some(Predicate::Shy(Shy::GoingOn))
}

/// "walks" where a speed or a change of it follows.
fn walking(reader: &mut SentenceReader) -> Option<Predicate> {
    if !reader.eat("walks|walk") {
        return None;
    }
    let pace = reader.attempt(|reader| {
        reader.eat("at");
        let pace = amount(reader).filter(|amount| amount.unit == AmountUnit::Speed)?;
        (!["slower", "faster", "quicker"].contains(&reader.peek(0))).then_some(pace)
    });
    if pace.is_some() {
        return pace.map(Predicate::Pace);
    }
    reader.ahead(|reader| measure(reader).is_some()).then_some(Predicate::Walks)
}

pub const IS: &str = "write \"is 82\", \"is a cat\", \"is out\" or \"is 30 % less active\"";

fn being(reader: &mut SentenceReader, adverbs: &mut Adverbs) -> Predicate {
    adverbs.all(reader);
    let kind = reader.attempt(|reader| {
        reader.skip_determiners();
        reader.eat_any(&[
            ("cat", ResidentKind::Cat),
            ("dog", ResidentKind::Dog),
            ("person|woman|man|lady|gentleman|human", ResidentKind::Person),
        ])
    });
    if let Some(kind) = kind {
        return Predicate::Kind(kind);
    }
    let age = reader.attempt(|reader| {
        let age = amount(reader)?;
        let is_age = age.unit == AmountUnit::Years || age.unit == AmountUnit::None && reader.at >= reader.words.len();
        let is_age = is_age
            || age.unit == AmountUnit::None
                && (reader.token(0) == Some(Token::Comma) || ["and", "but"].contains(&reader.peek(0)));
        is_age.then_some(age)
    });
    if let Some(age) = age {
        if age.from <= 0.0 || age.to > 130.0 {
            reader.fault(age.span, TimeSentenceMessage::Age { text: reader.said(age.span) });
        }
        return Predicate::Age(age.from);
    }
    if reader.eat("out|away|outside") || reader.eat("in|at hospital") || reader.eat("in|at the hospital") {
        return Predicate::Does(Activity::Leave);
    }
    Predicate::Is
}

/// "never misses Mass": that is what is done.
fn not_missed(reader: &mut SentenceReader) -> Option<Predicate> {
    reader.eat("misses|miss|skips|skip").then_some(())?;
    activities::event(reader).map(Predicate::Does)
}

/// "does not go to bed until two", "never gets up before ten": that is when.
fn not_before(reader: &mut SentenceReader, adverbs: &mut Adverbs) -> Option<Predicate> {
    let activity = activities::activity(reader)?;
    let from = reader.at;
    reader.eat("much|well");
    if reader.eat("before|until|till") {
        if let Some(at) = times::time(reader, true) {
            let (value, span) = (HabitTime::At(at.fuzzy()), reader.span(from));
            adverbs.when = Some(Slot { value, span, own: true });
            return Some(Predicate::Does(activity));
        }
        reader.eat("after");
        let other = activities::event(reader)?;
        let (value, span) = (HabitTime::After(other, None), reader.span(from));
        adverbs.when = Some(Slot { value, span, own: true });
        return Some(Predicate::Does(activity));
    }
    None
}

fn negated(reader: &mut SentenceReader) -> Option<Predicate> {
    activities::activity(reader).map(Predicate::Not)
}

fn changing(reader: &mut SentenceReader) -> Option<Predicate> {
    for phrase in ["sleeps|sleep", "turns|turn in bed", "turns|turn over in bed", "tosses|toss and turns|turn"] {
        if reader.eat(phrase) {
            reader.eat("in bed");
            return Some(Predicate::Sleeps);
        }
    }
    reader.eat("breathes|breathe").then_some(Predicate::Breathes)
}

pub const SEVERITIES: [(&str, f64); 3] =
    [("mild|slight|light", 0.5), ("moderate", 1.0), ("severe|serious|strong", 1.5)];

/// "has depression": only what is known, since much else can be had.
fn has_condition(reader: &mut SentenceReader) -> Option<Predicate> {
    if !reader.eat("has|have") {
        return None;
    }
    reader.skip_determiners();
    let severity = reader.eat_any(&SEVERITIES).unwrap_or(1.0);
    reader.name(&[Sort::Condition]).map(|name| Predicate::Shows(name, severity))
}

fn illness(reader: &mut SentenceReader) -> Option<Predicate> {
    if let Some(found) = reader.attempt(has_condition) {
        return Some(found);
    }
    if !(reader.eat("shows|show|develops|develop") || reader.eat("suffers|suffer from") || reader.eat("has signs of")) {
        return None;
    }
    reader.eat("signs of");
    reader.skip_determiners();
    let severity = reader.eat_any(&SEVERITIES).unwrap_or(1.0);
    if let Some(name) = reader.name(&[Sort::Condition]) {
        return Some(Predicate::Shows(name, severity));
    }
    let from = reader.at;
    let stops =
        |reader: &SentenceReader| reader.is_over() || reader.token(0) != Some(Token::Word) || begins_adverb(reader);
    while !stops(reader) && reader.at < from + 4 {
        reader.at += 1;
    }
    let span = reader.span(from);
    let text = if reader.at == from { String::new() } else { reader.said(span) };
    let help = did_you_mean(&reader.said(span).to_lowercase(), reader.names.of(&[Sort::Condition]));
    reader.fault(span, WordMessage::UnknownCondition { text, help });
    Some(Predicate::Shows(String::new(), severity))
}

/// "forgets the stove", "leaves the fridge open"; "forgets her pills".
fn forgetting(reader: &mut SentenceReader) -> Option<Predicate> {
    if reader.eat("leaves|leave") {
        let thing = reader.name(&[Sort::Thing])?;
        return reader.eat("open|on|running|ajar").then_some(Predicate::Forgets(thing));
    }
    if !reader.eat("forgets|forget") {
        return None;
    }
    if let Some(activity) = reader.attempt(what_is_left_out) {
        return Some(Predicate::Skips(activity));
    }
    let verb = reader.eat("to turn|switch off") || reader.eat("to close|shut|turn|switch");
    let thing = thing(reader);
    if verb {
        reader.eat("off");
    }
    Some(Predicate::Forgets(thing))
}

fn what_is_left_out(reader: &mut SentenceReader) -> Option<Activity> {
    if reader.eat("to") {
        return activities::activity(reader);
    }
    if reader.ahead(|reader| reader.name(&[Sort::Thing]).is_some()) {
        return None;
    }
    activities::event(reader).filter(|event| matches!(event, Activity::TakeMedicine | Activity::Eat(_)))
}

pub fn thing(reader: &mut SentenceReader) -> String {
    if let Some(thing) = reader.name(&[Sort::Thing]) {
        return thing;
    }
    unknown_name(reader, &[Sort::Thing], no_thing)
}

fn skipping(reader: &mut SentenceReader) -> Option<Predicate> {
    if !reader.eat("skips|skip|misses|miss|refuses|refuse|declines|decline") {
        return None;
    }
    activities::event(reader).map(Predicate::Skips)
}

pub fn of_body(reader: &mut SentenceReader, subject: &SentenceSubject) -> Option<Predicate> {
    match subject {
        SentenceSubject::Pulse => {
            reader.eat("beats|beat");
            let rises = rises_by(reader, Of::Beats);
            rises.or_else(|| measure(reader)).map(Predicate::Rises)
        }
        SentenceSubject::Breathing => {
            let rises = rises_by(reader, Of::Breaths);
            rises.or_else(|| measure(reader)).map(Predicate::Rises)
        }
        SentenceSubject::Hours if reader.eat("differ|differs") => Some(Predicate::Differ),
        SentenceSubject::Hours => (reader.eat("vary|varies|change|changes|are|is")).then_some(Predicate::Vary),
        _ => None,
    }
}
