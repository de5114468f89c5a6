//! Who does what: the subject of a sentence and its verb.

use super::activities;
use super::adverbs::{Adverbs, Slot};
use super::amounts::{Unit, amount};
use super::faults::did_you_mean;
use super::helping::Help;
use super::helping::visiting;
use super::measures::{Measure, Of, measure, rises_by};
use super::reader::{Reader, Sort, begins_adverb, is_determiner};
use super::remarks::remark;
use super::words::{Span, Token};
use crate::fuzzy::{Fuzzy, Quantifier};
use crate::routine::{Activity, Chance, Kind, PartOfDay, When};
use homebody_core::scenario::nearest::nearest;

/// Who or what a sentence is about.
#[derive(Clone, Debug, PartialEq)]
pub enum Subject {
    /// The person, by pronoun or name.
    Person,
    /// Somebody who visits, such as `daughter`.
    Visitor(String),
    /// A name that is not the person's.
    Stranger(String),
    /// At which hours things are done.
    Hours,
    Pulse,
    Breathing,
}

/// What is said of the subject.
#[derive(Clone, Debug, PartialEq)]
pub enum Predicate {
    Age(f64),
    Kind(Kind),
    /// "is", with a measure still to come.
    Is,
    /// "walks", with a measure or a speed still to come.
    Walks,
    Pace(super::amounts::Amount),
    Does(Activity),
    /// Words for something of the user's own.
    Own(String),
    Visits,
    Not(Activity),
    Skips(Activity),
    Shows(String, f64),
    Forgets(String),
    /// "sleeps" or "turns in bed", with a measure still to come.
    Sleeps,
    /// "vary", with a measure still to come.
    Vary,
    Rises(Measure),
    /// "breathes", with a measure still to come.
    Breathes,
    /// A visitor comes, and this is done.
    Helps(Activity, Help),
    /// Somebody who is named comes, and this is done.
    HelpedBy(String, Activity),
    /// Somebody who is named comes.
    VisitedBy(String),
    /// What is begun and not brought to its end.
    Unfinished(Activity),
    /// What somebody is, has or likes.
    Remark,
}

const HOURS: &str = "hours|times|days|day|routine";
pub const VISITS: [&str; 17] = [
    "comes|come to stay with her|him|them",
    "comes|come to stay",
    "comes|come to the house|home|flat|apartment",
    "pops|pop in|by|round|over",
    "stops|stop by|in",
    "looks|look in on her|him|them",
    "stays|stay with|at her|him|them",
    "stays|stay",
    "visits|visit her|him|them|it",
    "visits|visit",
    "comes|come to visit|help",
    "comes|come to see|visit her|him|them",
    "comes|come to help her|him|them",
    "comes|come by|over|round|in|around",
    "comes|come",
    "drops|drop by|in",
    "calls|call in|by|round",
];

/// The subject, if a sentence has one here.
pub fn subject(reader: &mut Reader) -> Option<Subject> {
    if reader.eat("she|he|they|it") || reader.eat("the person|resident|patient") {
        return Some(Subject::Person);
    }
    if let Some(people) = reader.attempt(people) {
        return Some(people);
    }
    match reader.person() {
        Some(false) => return Some(Subject::Person),
        Some(true) => return of_the_person(reader),
        None => {}
    }
    if ["her", "his", "their", "its"].contains(&reader.peek(0)) {
        return reader.attempt(|reader| {
            reader.at += 1;
            of_the_person(reader)
        });
    }
    if is_determiner(reader.peek(0)) {
        return reader.attempt(|reader| {
            reader.at += 1;
            visitor(reader)
        });
    }
    None
}

/// "her daughter", "her pulse", "her hours".
fn of_the_person(reader: &mut Reader) -> Option<Subject> {
    if reader.eat("pulse") || reader.eat("heart rate") || reader.eat("heart beats|beat") || reader.eat("heart") {
        return Some(Subject::Pulse);
    }
    if reader.eat("breathing|respiration|breath") {
        return Some(Subject::Breathing);
    }
    if reader.eat(HOURS) {
        return Some(Subject::Hours);
    }
    visitor(reader)
}

/// "Meals on Wheels", "carers": those whom everybody knows.
fn people(reader: &mut Reader) -> Option<Subject> {
    let from = reader.at;
    let lexicon = reader.names.lexicon.clone();
    reader.at += lexicon.list("PEOPLE", |ahead| reader.peek(ahead))?;
    let name = reader.passed(from);
    reader.ahead(visitor_verb).then_some(Subject::Visitor(name))
}

/// Whether what a visitor does, or is, stands here.
fn visitor_verb(reader: &mut Reader) -> bool {
    Adverbs::default().all(reader);
    reader.eat("also|usually|often|still|no");
    reader.ahead(|reader| visiting(reader).is_some())
        || reader.ahead(|reader| activities::activity(reader).is_some())
        || reader.ahead(|reader| remark(reader).is_some())
        || reader.eat("is|are|has|does|stays|helps")
}

/// A few words, up to the verb.
fn visitor(reader: &mut Reader) -> Option<Subject> {
    const MOST: usize = 5;
    if let Some(people) = reader.attempt(people) {
        return Some(people);
    }
    let from = reader.at;
    while reader.at < from + MOST && reader.token(0) == Some(Token::Word) {
        if reader.at > from && reader.ahead(visitor_verb) {
            return Some(Subject::Visitor(reader.passed(from)));
        }
        // "Her niece lives nearby and visits" names no niece who lives nearby.
        if reader.peek(0) == "and" && !is_determiner(reader.peek(1)) {
            return None;
        }
        reader.at += 1;
    }
    None
}

pub fn visits(reader: &mut Reader) -> bool {
    VISITS.iter().any(|phrase| reader.eat(phrase))
}

/// What goes before where somebody is, not before where they go.
const WHERE: &str = "at|in|on|by|near|beside|next";

/// Passes over words that say that somebody likes to do something, or mostly does: both are how they usually live.
pub fn tends(reader: &mut Reader) -> bool {
    reader
        .attempt(|reader| {
            let to = reader.eat("likes|like|loves|love|prefers|prefer|tends|tend to")
                || reader.eat("is|are known|inclined|prone to")
                || reader.eat("has|have a habit of")
                || reader.eat("is|are in the habit of");
            let doing = !to && reader.eat("likes|like|loves|love|enjoys|enjoy|prefers|prefer");
            let begins = |reader: &mut Reader| {
                let is_gerund = reader.peek(0).ends_with("ing");
                let start = reader.at;
                reader.skip_determiners();
                let named = reader.at > start || !is_gerund;
                reader.at = start;
                match (to, doing) {
                    (true, _) => true,
                    (_, true) if is_gerund => activities::activity(reader).is_some() || own_words(reader).is_some(),
                    (_, true) if named => {
                        reader.skip_determiners();
                        activities::noun(reader).is_some()
                            && (reader.is_over() || reader.token(0) != Some(Token::Word) || begins_adverb(reader))
                    }
                    _ => false,
                }
            };
            reader.ahead(begins).then_some(())
        })
        .is_some()
}

/// Passes over "needs to" and "has to": who has to do it does it.
pub fn needs_to(reader: &mut Reader) -> bool {
    reader
        .attempt(|reader| {
            (reader.eat("needs|need|has|have to") && reader.ahead(|reader| activities::activity(reader).is_some()))
                .then_some(())
        })
        .is_some()
}

/// "spends the afternoon knitting", "spends most of the day in her armchair".
fn spends(reader: &mut Reader, adverbs: &mut Adverbs) -> Option<Predicate> {
    if !reader.eat("spends|spend") {
        return None;
    }
    let start = reader.at;
    let most_of_day = ["most of the day", "much of the day", "all day", "her|his|their days|day", "the day"];
    let is_day = most_of_day.iter().any(|day| reader.eat(day));
    let part = if is_day {
        None
    } else {
        let _ = reader.eat("most|much of") || reader.eat("all");
        reader.eat("the|her|his|each|every|most");
        Some(reader.eat_any(&super::times::PARTS).filter(|part| *part != PartOfDay::Night)?)
    };
    let span = reader.span(start);
    let activity = match activities::activity(reader) {
        Some(activity) => activity,
        None => reader
            .ahead(|reader| reader.eat("in|on|at|by") && reader.name(&[Sort::Place]).is_some())
            .then_some(Activity::Relax)?,
    };
    match part {
        Some(part) => {
            let (from, to) = part.hours();
            let around = |at: f64| Fuzzy::around(at, super::times::ABOUT_TIME_S);
            adverbs.when = Some(Slot { value: When::At(around(from)), span, own: true });
            adverbs.until_time = Some(Slot { value: around(to), span, own: true });
        }
        None => {
            adverbs.times = Some(Slot { value: DAY_TIMES, span, own: true });
            adverbs.lasts = Some(Slot { value: DAY_LASTS_S, span, own: true });
            adverbs.part = Some(Slot { value: PartOfDay::Day, span, own: true });
        }
    }
    Some(Predicate::Does(activity))
}

/// Most of a day is so many times so long (ours): meals and the toilet go on beside it.
const DAY_TIMES: (u32, u32) = (4, 4);
const DAY_LASTS_S: Fuzzy = Fuzzy { low: 5_400.0, from: 7_200.0, to: 7_200.0, high: 9_000.0 };

/// "tends not to eat breakfast": mostly it is left out.
fn tends_not(reader: &mut Reader, adverbs: &mut Adverbs) -> Option<Predicate> {
    let from = reader.at;
    if !(reader.eat("tends|tend|prefers|prefer|likes|like not to")) {
        return None;
    }
    let span = reader.span(from);
    let activity = activities::activity(reader)?;
    adverbs.chance.get_or_insert(Slot { value: Chance::of(Quantifier::Most), span, own: true });
    Some(Predicate::Skips(activity))
}

/// "falls asleep": for the night where it is late, else a nap.
fn falls_asleep(reader: &mut Reader, adverbs: &Adverbs) -> Option<Predicate> {
    /// From then on, and until then, it is late (ours).
    const LATE_S: f64 = 20.0 * 3600.0;
    const EARLY_S: f64 = 5.0 * 3600.0;
    if !reader.eat("falls|fall|falling|drifts|drift asleep|off") || reader.ahead(|reader| reader.eat("in front")) {
        return None;
    }
    let mut rest = adverbs.clone();
    let has_place = reader.ahead(|reader| {
        rest.all(reader);
        reader.eat("in|on|at") && reader.name(&[Sort::Place]).is_some()
    });
    let is_late = match rest.when.as_ref().map(|slot| &slot.value) {
        Some(When::At(at)) => at.from >= LATE_S || at.from < EARLY_S,
        _ => false,
    };
    match (has_place, is_late, rest.part.as_ref().map(|slot| slot.value)) {
        (false, true, _) => Some(Predicate::Does(Activity::GoToBed)),
        (true, false, _)
        | (_, false, Some(PartOfDay::Morning | PartOfDay::Afternoon | PartOfDay::Evening | PartOfDay::Day)) => {
            Some(Predicate::Does(Activity::Nap))
        }
        _ => None,
    }
}

/// "is visited by a nurse": who comes.
fn visited(reader: &mut Reader) -> Option<Predicate> {
    if !(reader.eat("is|are visited|seen") && reader.eat("by")) {
        return None;
    }
    reader.skip_determiners();
    let start = reader.at;
    while reader.token(0) == Some(Token::Word) && !begins_adverb(reader) && reader.at < start + 4 {
        reader.at += 1;
    }
    (reader.at > start).then(|| Predicate::VisitedBy(reader.passed(start)))
}

/// What is said of the person, if it is understood; `adverbs` takes what stands within.
pub fn predicate(reader: &mut Reader, adverbs: &mut Adverbs) -> Option<Predicate> {
    if let Some(found) = reader
        .attempt(unable)
        .or_else(|| reader.attempt(unfinished))
        .or_else(|| reader.attempt(|reader| is_helped(reader)))
    {
        return Some(found);
    }
    if let Some(found) = reader
        .attempt(|reader| tends_not(reader, adverbs))
        .or_else(|| reader.attempt(|reader| falls_asleep(reader, adverbs)))
    {
        return Some(found);
    }
    if let Some(found) = reader.attempt(|reader| spends(reader, adverbs)).or_else(|| reader.attempt(visited)) {
        return Some(found);
    }
    if reader.ahead(|reader| reader.eat("is|are"))
        && let Some(activity) = reader.attempt(|reader| is_doing(reader, adverbs))
    {
        return Some(Predicate::Does(activity));
    }
    if let Some(()) = reader.attempt(|reader| is_remark(reader)) {
        return Some(Predicate::Remark);
    }
    if reader.eat("is|are") {
        return Some(being(reader, adverbs));
    }
    let not = reader.eat("does|do not") || reader.eat("doesn't|don't|never") || reader.eat("no longer");
    // Who stops at the window does something there.
    let stops = |reader: &mut Reader| reader.eat("stops|stop") && !reader.ahead(|reader| reader.eat(WHERE));
    if not || reader.attempt(|reader| stops(reader).then_some(())).is_some() {
        reader.eat("ever");
        return negated(reader);
    }
    if let Some(activity) = reader.attempt(|reader| until_up(reader, adverbs)) {
        return Some(Predicate::Does(activity));
    }
    for read in [walking, changing, illness, forgetting, skipping] {
        if let Some(found) = reader.attempt(read) {
            return Some(found);
        }
    }
    reader.attempt(|reader| {
        let begins = reader.eat("starts|start|begins|begin") && (reader.eat("to") || !reader.is_over());
        (begins && reader.ahead(activities::activity).is_some()).then_some(())
    });
    let wakes = ["wakes", "wake", "waking"].contains(&reader.peek(0));
    if let Some(activity) = activities::activity(reader) {
        // Who wakes by night lies awake.
        if wakes
            && let Some(rest) = reader.attempt(|reader| {
                let mut rest = adverbs.clone();
                rest.all(reader);
                rest.part.as_ref().is_some_and(|part| part.value == PartOfDay::Night).then_some(rest)
            })
        {
            *adverbs = rest;
            return Some(Predicate::Does(Activity::LieAwake));
        }
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

/// "cannot cook", "is unable to wash": what is not done.
fn unable(reader: &mut Reader) -> Option<Predicate> {
    let not = reader.eat("cannot|can't")
        || reader.eat("can not")
        || reader.eat("can no longer")
        || reader.eat("is|are unable to")
        || reader.eat("is|are not able to")
        || reader.eat("is|are no longer able to")
        || reader.eat("refuses|refuse to");
    if !not { None } else { activities::activity(reader).map(Predicate::Not) }
}

/// "does not finish her lunch".
fn unfinished(reader: &mut Reader) -> Option<Predicate> {
    let not = reader.eat("does|do not finish") || reader.eat("doesn't|don't finish") || reader.eat("rarely finishes");
    if !not { None } else { activities::event(reader).map(Predicate::Unfinished) }
}

/// "needs help from her daughter to wash": somebody comes for it.
fn is_helped(reader: &mut Reader) -> Option<Predicate> {
    let help = "help|assistance|support|supervision";
    if !(reader.eat("needs|need|requires|require|gets|get|receives|receive|has|have") && reader.eat(help)) {
        return None;
    }
    let from = |reader: &mut Reader| -> Option<String> {
        if !reader.eat("from|of") {
            return None;
        }
        reader.skip_determiners();
        let start = reader.at;
        while reader.token(0) == Some(Token::Word) && !begins_adverb(reader) && reader.at < start + 4 {
            reader.at += 1;
        }
        (reader.at > start).then(|| reader.passed(start))
    };
    let before = reader.attempt(from);
    if !reader.eat("with|to|in") {
        return None;
    }
    let activity = activities::event(reader)?;
    let who = before.or_else(|| reader.attempt(from))?;
    Some(Predicate::HelpedBy(who, activity))
}

/// What "is" begins: being out, in hospital, awake.
fn is_doing(reader: &mut Reader, adverbs: &mut Adverbs) -> Option<Activity> {
    // "is usually up by 7:00", "is asleep by 23:00".
    let mut rest = adverbs.clone();
    let by_clock = reader.attempt(|reader| {
        reader.eat("is|are").then_some(())?;
        rest.all(reader);
        let state = reader.eat_any(&[("up", true), ("out of bed", true), ("asleep", false), ("in bed", false)])?;
        ["by", "at"].contains(&reader.peek(0)).then_some(state)
    });
    if let Some(is_up) = by_clock.filter(|_| !reader.ahead(|reader| reader.eat("at night"))) {
        *adverbs = rest;
        return Some(if is_up { Activity::GetUp } else { Activity::GoToBed });
    }
    activities::activity(reader)
}

/// A remark, but for what is said as a change or begins with a number.
fn is_remark(reader: &mut Reader) -> Option<()> {
    if reader.ahead(|reader| {
        reader.eat("is|are")
            && (amount(reader).is_some() || measure(reader).is_some() || {
                reader.skip_determiners();
                reader.eat("cat|dog|person|woman|man|lady|gentleman|human")
            })
    }) {
        return None;
    }
    remark(reader)
}

/// Who stays in bed until 9:00 gets up at 9:00, and who stays up until midnight goes to bed then.
fn until_up(reader: &mut Reader, adverbs: &mut Adverbs) -> Option<Activity> {
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
    rest.when = Some(Slot { value: When::At(until.value), span: until.span, own: until.own });
    *adverbs = rest;
    Some(if stays_up { Activity::GoToBed } else { Activity::GetUp })
}

/// "gets up twice a night to go to the bathroom": what for.
fn at_night_for(reader: &mut Reader, adverbs: &mut Adverbs) -> Option<Activity> {
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

/// "walks" where a speed or a change of it follows.
fn walking(reader: &mut Reader) -> Option<Predicate> {
    if !reader.eat("walks|walk") {
        return None;
    }
    let pace = reader.attempt(|reader| {
        reader.eat("at");
        let pace = amount(reader).filter(|amount| amount.unit == Unit::Speed)?;
        (!["slower", "faster", "quicker"].contains(&reader.peek(0))).then_some(pace)
    });
    if pace.is_some() {
        return pace.map(Predicate::Pace);
    }
    reader.ahead(|reader| measure(reader).is_some()).then_some(Predicate::Walks)
}

/// What may stand after "is".
pub const IS: &str = "write \"is 82\", \"is a cat\", \"is out\" or \"is 30 % less active\"";

fn being(reader: &mut Reader, adverbs: &mut Adverbs) -> Predicate {
    adverbs.all(reader);
    let kind = reader.attempt(|reader| {
        reader.skip_determiners();
        reader.eat_any(&[
            ("cat", Kind::Cat),
            ("dog", Kind::Dog),
            ("person|woman|man|lady|gentleman|human", Kind::Person),
        ])
    });
    if let Some(kind) = kind {
        return Predicate::Kind(kind);
    }
    let age = reader.attempt(|reader| {
        let age = amount(reader)?;
        let is_age = age.unit == Unit::Years || age.unit == Unit::None && reader.at >= reader.words.len();
        let is_age = is_age
            || age.unit == Unit::None
                && (reader.token(0) == Some(Token::Comma) || ["and", "but"].contains(&reader.peek(0)));
        is_age.then_some(age)
    });
    if let Some(age) = age {
        if age.from <= 0.0 || age.to > 130.0 {
            let hint = "say the age in years, such as \"is 82\"".to_owned();
            reader.fault(age.span, format!("nobody is {}", reader.said(age.span)), hint);
        }
        return Predicate::Age(age.from);
    }
    if reader.eat("out|away|outside") || reader.eat("in|at hospital") || reader.eat("in|at the hospital") {
        return Predicate::Does(Activity::Leave);
    }
    Predicate::Is
}

fn negated(reader: &mut Reader) -> Option<Predicate> {
    activities::activity(reader).map(Predicate::Not)
}

fn changing(reader: &mut Reader) -> Option<Predicate> {
    for phrase in ["sleeps|sleep", "turns|turn in bed", "turns|turn over in bed", "tosses|toss and turns|turn"] {
        if reader.eat(phrase) {
            reader.eat("in bed");
            return Some(Predicate::Sleeps);
        }
    }
    reader.eat("breathes|breathe").then_some(Predicate::Breathes)
}

/// What severity these words stand for; without one, a case is moderate.
pub const SEVERITIES: [(&str, f64); 3] =
    [("mild|slight|light", 0.5), ("moderate", 1.0), ("severe|serious|strong", 1.5)];

/// "has depression": only what is known, since much else can be had.
fn has_condition(reader: &mut Reader) -> Option<Predicate> {
    if !reader.eat("has|have") {
        return None;
    }
    reader.skip_determiners();
    let severity = reader.eat_any(&SEVERITIES).unwrap_or(1.0);
    reader.name(&[Sort::Condition]).map(|name| Predicate::Shows(name, severity))
}

fn illness(reader: &mut Reader) -> Option<Predicate> {
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
    let stops = |reader: &Reader| reader.is_over() || reader.token(0) != Some(Token::Word) || begins_adverb(reader);
    while !stops(reader) && reader.at < from + 4 {
        reader.at += 1;
    }
    let span = reader.span(from);
    let said = if reader.at == from { "this".to_owned() } else { format!("{:?}", reader.said(span)) };
    let hint = did_you_mean(&reader.said(span).to_lowercase(), reader.names.of(&[Sort::Condition]));
    reader.fault(span, format!("{said} is no condition that Homebody knows"), hint);
    Some(Predicate::Shows(String::new(), severity))
}

/// "forgets the stove", "leaves the fridge open"; "forgets her pills".
fn forgetting(reader: &mut Reader) -> Option<Predicate> {
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

/// What is not done by who forgets it: "her pills", "to eat lunch".
fn what_is_left_out(reader: &mut Reader) -> Option<Activity> {
    if reader.eat("to") {
        return activities::activity(reader);
    }
    if reader.ahead(|reader| reader.name(&[Sort::Thing]).is_some()) {
        return None;
    }
    activities::event(reader).filter(|event| matches!(event, Activity::TakeMedicine | Activity::Eat(_)))
}

/// A thing of this home; a fault where there is none.
pub fn thing(reader: &mut Reader) -> String {
    if let Some(thing) = reader.name(&[Sort::Thing]) {
        return thing;
    }
    unknown_name(reader, &[Sort::Thing], "nothing that this home has")
}

/// Passes over the words of a name that nothing has.
pub fn unknown_name(reader: &mut Reader, sorts: &[Sort], what: &str) -> String {
    unknown_name_or(reader, sorts, what, None)
}

/// The same, with a hint for where no name is near.
pub fn unknown_name_or(reader: &mut Reader, sorts: &[Sort], what: &str, far: Option<&str>) -> String {
    reader.skip_determiners();
    let from = reader.at;
    while !reader.is_over() && reader.token(0) != Some(Token::Comma) && !begins_adverb(reader) && reader.at < from + 4 {
        reader.at += 1;
    }
    let span = if reader.at == from { reader.here() } else { reader.span(from) };
    let said = reader.said(span);
    if reader.faults.is_trial {
        reader.fault(span, what, None);
        return said;
    }
    let known = did_you_mean(&said.to_lowercase(), reader.names.of(sorts));
    let near = known.filter(|hint| far.is_none() || hint.starts_with("did"));
    reader.fault(span, format!("{said:?} is {what}"), near.or(far.map(str::to_owned)));
    said
}

fn skipping(reader: &mut Reader) -> Option<Predicate> {
    if !reader.eat("skips|skip|misses|miss") {
        return None;
    }
    activities::event(reader).map(Predicate::Skips)
}

/// What is said of a pulse, of breathing or of hours.
pub fn of_body(reader: &mut Reader, subject: &Subject) -> Option<Predicate> {
    match subject {
        Subject::Pulse => {
            reader.eat("beats|beat");
            let rises = rises_by(reader, Of::Beats);
            rises.or_else(|| measure(reader)).map(Predicate::Rises)
        }
        Subject::Breathing => {
            let rises = rises_by(reader, Of::Breaths);
            rises.or_else(|| measure(reader)).map(Predicate::Rises)
        }
        Subject::Hours => (reader.eat("vary|varies|change|changes|are|is")).then_some(Predicate::Vary),
        _ => None,
    }
}

/// Words of the user's own for something that is done, up to where or when it is done.
pub fn own_words(reader: &mut Reader) -> Option<(String, Span)> {
    const MOST: usize = 6;
    let from = reader.at;
    let goes_on = |reader: &mut Reader| {
        let is_object = reader.at > from && is_spoken_to(reader);
        reader.token(0) == Some(Token::Word) && (is_object || !begins_adverb(reader))
    };
    while goes_on(reader) && reader.at < from + MOST {
        reader.at += 1;
    }
    if reader.at == from || goes_on(reader) {
        reader.at = from;
        return None;
    }
    let words: Vec<&str> = reader.words[from..reader.at].iter().map(|word| word.text.as_str()).collect();
    Some((words.join(" "), reader.span(from)))
}

/// "to the radio", of who listens to it: no way to a place, and no purpose.
fn is_spoken_to(reader: &mut Reader) -> bool {
    let verb = reader.at.checked_sub(1).and_then(|verb| reader.words.get(verb)).map_or("", |word| &word.text);
    let moves = ["go", "walk", "move", "come", "get", "sit"].iter().any(|known| activities::is_form(known, verb));
    let is_noun = is_determiner(reader.peek(1)) || reader.peek(1) == "music";
    !moves
        && reader.peek(0) == "to"
        && is_noun
        && !reader.ahead(|reader| {
            reader.at += 1;
            reader.name(&[Sort::Place, Sort::Room, Sort::Thing]).is_some()
        })
}

/// Says that nobody knows how to do this, with what was probably meant.
pub fn unknown_verb(reader: &mut Reader, words: &str, span: Span) {
    unknown_doing(reader, words, span, None);
}

/// The same, with a sentence that would do.
pub fn unknown_doing(reader: &mut Reader, words: &str, span: Span, example: Option<String>) {
    let said = reader.said(span);
    let what = format!("{said:?} is nothing that Homebody knows how to do");
    if reader.faults.is_trial {
        return reader.fault(span, what, None);
    }
    let known = match (meant(words), goes_with(words)) {
        (Some(phrase), _) => return reader.fault(span, what, format!("did you mean {phrase:?}?")),
        (None, Some(known)) => Some(format!("known are {known}")),
        (None, None) => None,
    };
    // What is done with something else is rather that than new.
    let is_new = |_: &String| looks_like_doing(words);
    let own = example.filter(is_new).or_else(|| own_example(reader, words).filter(|_| known.is_none())).map(|example| {
        format!("a new activity needs a place and a duration: {example:?}; out of the home, write \"she goes out for 2 hours\"")
    });
    let hint = match (known, own) {
        (Some(known), Some(own)) => Some(format!("{known}; {own}")),
        (known, own) => known.or(own),
    };
    reader.fault(span, what, hint);
}

/// How these words would be said as an activity of one's own, where they look like one.
fn own_example(reader: &Reader, words: &str) -> Option<String> {
    const SEATS: [&str; 3] = ["armchair", "sofa", "dining chair"];
    if !looks_like_doing(words) {
        return None;
    }
    let seat = SEATS.iter().find(|seat| reader.names.has(seat, Sort::Place)).map(|seat| format!("in the {seat}"));
    let place = seat.or_else(|| reader.names.of(&[Sort::Room]).next().map(|room| format!("in the {room}")));
    Some(format!("she {words} {} for 20 minutes", place.unwrap_or_else(|| "in the kitchen".to_owned())))
}

/// Whether words are those of something that is done at home, as far as can be told: a verb in the third person, and no word
/// that turns it into something else.
pub fn looks_like_doing(words: &str) -> bool {
    const NO_DOING: &str = "is goes comes walks moves gets likes wants needs becomes has seems feels knows leaves returns arrives \
        does says says asks tells tries keeps stops starts begins appears remains stays lives shows suffers hardly always";
    const TURNING: &str = "not no never without when because if while so that which who she he they and or but more less too as than \
        lot lots of any much many her him them it this up down out off back away cannot it's slowly well badly";
    let mut list = words.split(' ');
    let verb = list.next().unwrap_or_default();
    let is_verb = verb.len() > 3
        && verb.ends_with('s')
        && !verb.ends_with("ss")
        && !NO_DOING.split_whitespace().any(|other| other == verb);
    is_verb
        && words.split(' ').count() <= 5
        && !list.any(|word| TURNING.split_whitespace().any(|other| other == word) || word.ends_with("ly"))
}

/// The same of what is not done.
pub fn unknown_not(reader: &mut Reader, span: Span) {
    let said = reader.said(span);
    if reader.faults.is_trial {
        return reader.fault(span, said, None);
    }
    let hint = match meant(&activities::in_third_person(&said.to_lowercase())) {
        Some(phrase) => format!("did you mean {phrase:?}?"),
        None => "what is not done need not be said; to end something of your own, say until when it is so: \"until week 12 she \
            whittles in the armchair for 1 hour\""
            .to_owned(),
    };
    reader.fault(span, format!("{said:?} is nothing that Homebody knows how to do"), hint);
}

/// Whether these words only say that she goes somewhere, not what she does there.
pub fn is_way(words: &str) -> bool {
    !words.contains(' ') && ["go", "walk", "move", "come"].iter().any(|verb| activities::is_form(verb, words))
}

/// What else is done with this verb, where the verb alone is known.
fn goes_with(words: &str) -> Option<String> {
    const FEW: usize = 4;
    let verb = words.split(' ').next()?;
    let known = activities::all_phrases().iter().filter(|phrase| phrase.split(' ').next() == Some(verb));
    let known: Vec<String> = known.take(FEW).map(|phrase| format!("{phrase:?}")).collect();
    (!known.is_empty()).then(|| known.join(", "))
}

/// Whether a verb is known as it stands: then it is no slip of another.
fn is_known_verb(verb: &str) -> bool {
    activities::all_phrases().iter().any(|phrase| phrase.split(' ').next() == Some(verb))
}

/// The phrase that these words are probably a slip of.
pub fn meant(words: &str) -> Option<String> {
    let words: Vec<&str> = words.split(' ').filter(|word| !is_determiner(word)).collect();
    let verb = words.first().copied().unwrap_or_default();
    let is_verb = is_known_verb(verb);
    let phrases = activities::all_phrases();
    let verbs = ["shows", "skips", "forgets", "sleeps", "breathes", "walks", "turns in bed", "prepares", "visits"];
    let all = phrases.iter().map(String::as_str).chain(verbs);
    // As many words of what was said as the phrase has; the longest phrase that is near wins.
    let said: Vec<String> = (0..=words.len()).map(|length| words[..length].join(" ")).collect();
    let mut best: Option<(usize, &str)> = None;
    for phrase in all.filter(|phrase| !is_verb || phrase.split(' ').next() == Some(verb)) {
        let length = phrase.split(' ').count();
        // Who says more than the phrase does has said less of it wrongly.
        let slips = if length < words.len() { 1 } else { 2 };
        let said = said.get(length).filter(|said| said.len().abs_diff(phrase.len()) <= 2);
        let is_near = said.is_some_and(|said| is_slip(said, phrase, slips) && nearest(said, [phrase]).is_some());
        if is_near && best.is_none_or(|(longest, _)| length > longest) {
            best = Some((length, phrase));
        }
    }
    best.map(|(_, phrase)| phrase.to_owned())
}

/// Whether two phrases differ as slips do: most letters are the same, in order.
fn is_slip(said: &str, phrase: &str, slips: usize) -> bool {
    let (same, longer) = same_letters(said, phrase);
    same + slips >= longer
}

/// Whether these words are a phrase but for a letter in each: too near to be something new.
pub fn is_nearly_known(words: &str) -> bool {
    let words: Vec<&str> = words.split(' ').filter(|word| !is_determiner(word)).collect();
    let near = |(said, known): (&&str, &str)| {
        // Slips are seldom in the first letter: who sings does not ring. And who does a puzzle does not doze.
        if said.as_bytes().first() != known.as_bytes().first() || said.len().abs_diff(known.len()) > 1 {
            return false;
        }
        let (same, longer) = same_letters(said, known);
        **said == *known || *said != "does" && longer >= 4 && same + 1 >= longer
    };
    let is_near = |phrase: &String| {
        let count = phrase.split(' ').count();
        // Many short verbs differ by a letter: who stops does not shop.
        let is_long = count > 1 || phrase.len() >= 6;
        is_long && count <= words.len() && words.iter().zip(phrase.split(' ')).all(near)
    };
    activities::all_phrases().iter().any(is_near)
}

/// How many letters agree at the two ends of both, and how many the longer one has.
fn same_letters(a: &str, b: &str) -> (usize, usize) {
    let (longer, shorter) = if a.len() < b.len() { (b.as_bytes(), a.as_bytes()) } else { (a.as_bytes(), b.as_bytes()) };
    let front = longer.iter().zip(shorter).take_while(|(a, b)| a == b).count();
    let back =
        longer.iter().rev().zip(shorter.iter().rev()).take(shorter.len() - front).take_while(|(a, b)| a == b).count();
    (front + back, longer.len())
}
