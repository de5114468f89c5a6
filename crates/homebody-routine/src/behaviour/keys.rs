//! Names of the random streams of sentences: the meaning, and the position among sentences of equal meaning.
//!
//! So blank lines, comments, indentation, synonyms, file names and other sentences do not change a sentence's random
//! numbers. A changed meaning is a new sentence, with new numbers.
//!
//! Names are spelt out field by field, not derived: renaming a field or variant changes no log, while every change of this
//! file does.

use crate::routine::{
    Circumstance, DayEpisode, DaySelection, Effect, Habit, HabitTime, Phase, PhaseDay, Response, Routine,
    RoutineChange, RoutineRule, RuleTrigger,
};
use homebody_core::fuzzy::Fuzzy;
use std::collections::BTreeMap;

/// In the order of the file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Keys {
    pub habits: Vec<String>,
    pub rules: Vec<String>,
    pub changes: Vec<String>,
}

impl Keys {
    /// `source` separates this routine from other routines and conditions of the resident.
    pub fn new(routine: &Routine, source: &str) -> Keys {
        let mut before = 0;
        let habits = routine.habits.iter().map(|habit| {
            let said = match habit.when.time {
                // A habit with "then" includes the habit before it.
                HabitTime::Then => format!("{} of {before:016x}", habit_key(habit)),
                _ => habit_key(habit),
            };
            before = hash(&said);
            said
        });
        Keys {
            habits: among_like("habit", source, habits),
            rules: among_like("rule", source, routine.rules.iter().map(rule_key)),
            changes: among_like("change", source, routine.changes.iter().map(change_key)),
        }
    }
}

/// Adds kind, source, and the number of equal sentences before.
fn among_like(kind: &str, source: &str, all: impl Iterator<Item = String>) -> Vec<String> {
    let mut alike: BTreeMap<String, u32> = BTreeMap::new();
    let name = |said: String| {
        let before = alike.entry(said.clone()).or_default();
        let name = format!("{kind}/{source}/{said}/{before}");
        *before += 1;
        name
    };
    all.map(name).collect()
}

/// FNV-1a with 64 bits, so that names in a chain of "then" keep one length.
fn hash(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

fn habit_key(habit: &Habit) -> String {
    let mut text = String::new();
    if let Some(visitor) = &habit.visitor {
        text += &format!("{}: ", visitor.to_lowercase());
    }
    text += habit.activity.label();
    if let Some(place) = &habit.place {
        text += &format!(" at {}", place.to_lowercase());
    }
    if let Some(falling) = habit.falling {
        text += &format!(" {}", falling.words());
        text += &falling.mostly.map_or_else(String::new, |part| format!(" mostly {}", part.word()));
    }
    text += &habit.thing_on.as_ref().map(|thing| format!(" with {} on", thing.to_lowercase())).unwrap_or_default();
    text += &format!(" p {}", habit.when.chance.probability);
    if let Some((probability, by)) = habit.when.chance.becomes {
        text += &format!(" to {probability} by {}", moment_key(by));
    }
    if let Some(days) = habit.when.chance.days_a_week {
        text += &format!(" on {days} a week");
    }
    text += &days_key(&habit.when.days);
    text += &match &habit.when.time {
        HabitTime::AnyTime => String::new(),
        HabitTime::At(time) => format!(" from {}", fuzzy_key(time)),
        HabitTime::Within(part) => format!(" in {}", part.word()),
        HabitTime::After(activity, gap) => format!(" after {}{}", activity.label(), gap_key(gap)),
        HabitTime::Before(activity, gap) => format!(" before {}{}", activity.label(), gap_key(gap)),
        HabitTime::With(activity) => format!(" with {}", activity.label()),
        HabitTime::Then => " then".to_owned(),
    };
    for (what, amount) in [(" for ", &habit.when.lasts), (" until ", &habit.when.until)] {
        text += &amount.as_ref().map(|amount| format!("{what}{}", fuzzy_key(amount))).unwrap_or_default();
    }
    if habit.when.times != (1, 1) {
        text += &format!(" times {} {}", habit.when.times.0, habit.when.times.1);
    }
    if habit.when.is_total {
        text += " in all";
    }
    text + phase_key(&habit.when.phase).as_str()
}

fn days_key(days: &DaySelection) -> String {
    let DaySelection { weekdays, months, every, of_month, kind, weather, episode, poor_nights } = *days;
    let mut text = String::new();
    let by_calendar = DaySelection { weekdays, months, every, of_month, kind, ..DaySelection::ALL };
    if by_calendar != DaySelection::ALL {
        text += &format!(" days {weekdays:07b} {months:012b} {every}");
    }
    if of_month != DaySelection::ALL.of_month {
        text += &format!(" {} to {} of the month", of_month.0, of_month.1);
    }
    if let Some(kind) = kind {
        text += &format!(" on {} days", kind.word());
    }
    if let Some(weather) = weather {
        text += &format!(" in {} weather", weather.word());
    }
    if let Some(DayEpisode { every_days, lasts_days }) = episode {
        text += &format!(" in episodes {every_days} {lasts_days}");
    }
    if poor_nights > 0 {
        text += &format!(" after {poor_nights} poor nights");
    }
    text
}

fn rule_key(rule: &RoutineRule) -> String {
    let trigger = trigger_key(&rule.whenever);
    let only_if =
        |one: &Circumstance| format!(" {} {}", if one.holds { "if" } else { "unless" }, trigger_key(&one.state));
    let only_if: String = rule.only_if.iter().map(only_if).collect();
    let response = response_key(&rule.response);
    let then: String = rule.then.iter().map(|then| format!(" then {}", response_key(then))).collect();
    let lapse = rule.lapse.map(|lapse| {
        let later = lapse.later.map(|later| format!(" later {}", fuzzy_key(&later))).unwrap_or_default();
        format!(" forgets {}{later}", lapse.probability)
    });
    let lapse = lapse.unwrap_or_default();
    let (after, phase) = (fuzzy_key(&rule.lasts), phase_key(&rule.when.phase));
    format!("{trigger} after {after}{only_if} p {} {response}{then}{lapse}{phase}", rule.when.chance.probability)
}

fn trigger_key(trigger: &RuleTrigger) -> String {
    match trigger {
        RuleTrigger::On(thing) => format!("on {}", thing.to_lowercase()),
        RuleTrigger::At(place) => format!("at {}", place.to_lowercase()),
        RuleTrigger::Away => "away".to_owned(),
        RuleTrigger::InBed => "in bed".to_owned(),
        RuleTrigger::Rings(thing) => format!("rings {}", thing.to_lowercase()),
        RuleTrigger::Dark(room) => format!("dark {}", room.as_deref().unwrap_or_default().to_lowercase()),
        RuleTrigger::Company(who) => format!("company {}", who.as_deref().unwrap_or_default()),
        RuleTrigger::Alone => "alone".to_owned(),
        RuleTrigger::Sitting => "sitting".to_owned(),
        RuleTrigger::Doing(activity) => format!("doing {}", activity.label()),
        RuleTrigger::Done(activity) => format!("done {}", activity.label()),
        RuleTrigger::Between(from, to) => format!("between {from} {to}"),
        RuleTrigger::Follows => "follows".to_owned(),
        RuleTrigger::Wakes => "wakes".to_owned(),
    }
}

fn response_key(response: &Response) -> String {
    match response {
        Response::Turn { thing, on } => format!("turn {} {}", thing.to_lowercase(), if *on { "on" } else { "off" }),
        Response::Do { activity, place, lasts } => {
            let place = place.as_ref().map(|place| format!(" at {}", place.to_lowercase())).unwrap_or_default();
            let lasts = lasts.as_ref().map(|lasts| format!(" for {}", fuzzy_key(lasts))).unwrap_or_default();
            format!("{}{place}{lasts}", activity.label())
        }
    }
}

fn change_key(change: &RoutineChange) -> String {
    let part = change.when.part().map(|part| format!(" in {}", part.word())).unwrap_or_default();
    let chance = change.when.chance.probability;
    let effect = match &change.effect {
        Effect::Shows { condition, severity } => format!("shows {condition} {severity}"),
        Effect::Pace(by) => format!("pace {}", fuzzy_key(by)),
        Effect::PaceEachWeek(by) => format!("pace each week {}", fuzzy_key(by)),
        Effect::Later { activity, by } => format!("later {} {}", activity.label(), fuzzy_key(by)),
        Effect::Longer { activity, factor } => format!("longer {} {}", activity.label(), fuzzy_key(factor)),
        Effect::LongerBy { activity, by } => format!("longer by {} {}", activity.label(), fuzzy_key(by)),
        Effect::Oftener { activity, factor } => format!("oftener {}{part} {}", activity.label(), fuzzy_key(factor)),
        Effect::Skips { activity } => format!("skips {} {chance}", activity.label()),
        Effect::Irregular(by) => format!("irregular {}", fuzzy_key(by)),
        Effect::Active { factor } => format!("active{part} {}", fuzzy_key(factor)),
        Effect::DaysDiffer(by) => format!("days differ {}", fuzzy_key(by)),
        Effect::DaysAre { kind, very } => format!("{} days {very}", kind.word()),
        Effect::SleepsIn => "sleeps in".to_owned(),
        Effect::Restless(by) => format!("restless {}", fuzzy_key(by)),
        Effect::Forgets { thing } => format!("forgets {} {chance}", thing.to_lowercase()),
        Effect::KeepsOn { thing } => {
            let until = change.when.until.as_ref().map(|until| format!(" until {}", fuzzy_key(until)));
            let from = match &change.when.time {
                HabitTime::At(from) => format!(" from {}", fuzzy_key(from)),
                _ => " all night".to_owned(),
            };
            format!("keeps on {}{from}{} {chance}", thing.to_lowercase(), until.unwrap_or_default())
        }
        Effect::Range { place, inside } => {
            format!("{} {} {chance}", if *inside { "keeps to" } else { "avoids" }, place.to_lowercase())
        }
        Effect::Spares { thing } => format!("spares {}", thing.to_lowercase()),
        Effect::Shy { of, gain } => format!("shy {of:?} {gain}").to_lowercase(),
        Effect::Pulse(by) => format!("pulse {}", fuzzy_key(by)),
        Effect::Respiration(by) => format!("respiration {}", fuzzy_key(by)),
    };
    effect + phase_key(&change.when.phase).as_str()
}

fn phase_key(phase: &Phase) -> String {
    let mut text = String::new();
    for (what, moment) in [("from", phase.from), ("until", phase.until)] {
        if let Some(moment) = moment {
            text += &format!(" {what} {}", moment_key(moment));
        }
    }
    for (what, days) in [("over", phase.over_days), ("fading", phase.fading_days)] {
        if days != 0.0 {
            text += &format!(" {what} {days}");
        }
    }
    text
}

fn moment_key(moment: PhaseDay) -> String {
    match moment {
        PhaseDay::Day(day) => format!("day {day}"),
        PhaseDay::Date(year, month, day) => format!("{year}-{month}-{day}"),
    }
}

fn gap_key(gap: &Option<Fuzzy>) -> String {
    gap.as_ref().map(|gap| format!(" by {}", fuzzy_key(gap))).unwrap_or_default()
}

fn fuzzy_key(fuzzy: &Fuzzy) -> String {
    format!("{}|{}|{}|{}", fuzzy.low, fuzzy.from, fuzzy.to, fuzzy.high)
}
