//! A home with names for sentences, and a short form of parsed routines.
#![allow(dead_code)]

use homebody_core::fuzzy::Fuzzy;
use homebody_core::problem::{Problem, Problems};
use homebody_routine::language::{KnownNames, routine};
use homebody_routine::routine::{
    DaySelection, Effect, Habit, HabitChance, HabitTime, Phase, Response, Routine, RoutineChange, RoutineRule,
};

pub fn home() -> KnownNames {
    let list = |names: &str| names.split(", ").map(str::to_owned).collect();
    KnownNames {
        person: Some("Margaret".into()),
        places: list(
            "armchair, sofa, bed, dining chair, toilet, shower, stove, fridge, sink, washbasin, living room window, \
             bedroom window, front door, bookcase",
        ),
        things: list(
            "stove, fridge, front door, bedroom door, television, lamp, washing machine, armchair, bed, sofa, door bell, telephone",
        ),
        rooms: list("bedroom, bathroom, kitchen, living room, hall"),
        floors: list("ground floor, upper floor"),
        conditions: list("depression, heart-failure, urinary-tract-infection, cognitive-decline"),
        first_date: Some((2009, 3, 2)),
        ..KnownNames::default()
    }
}

/// Reads a text without problems.
#[track_caller]
pub fn understood(text: &str) -> Routine {
    let (routine, problems) = routine("margaret.routine", text, &home());
    assert!(problems.is_empty(), "{text}\n{}", Problems(problems).render());
    routine
}

pub fn problems(text: &str) -> Vec<Problem> {
    routine("margaret.routine", text, &home()).1
}

/// A routine in short, without defaults.
pub fn short(routine: &Routine) -> String {
    let person = routine.person.as_ref().map(|person| {
        let age = person.age_years.map(|age| format!(" age {age}")).unwrap_or_default();
        let pace = person.pace_mps.map(|pace| format!(" pace {}", fuzzy(&pace))).unwrap_or_default();
        let rests = person.rests.map(|rests| format!(" rests {} m {}", rests.after_m, fuzzy(&rests.lasts)));
        format!("{} {:?}{age}{pace}{}", person.name, person.kind, rests.unwrap_or_default())
    });
    let habits = routine.habits.iter().map(habit);
    let parts = person.into_iter().chain(habits).chain(routine.rules.iter().map(rule));
    let parts = parts.chain(routine.changes.iter().map(change));
    parts.chain(routine.remarks.iter().map(|_| "remark".to_owned())).collect::<Vec<_>>().join(" & ")
}

fn habit(habit: &Habit) -> String {
    let mut text = format!("{:?}", habit.activity);
    if let Some(visitor) = &habit.visitor {
        text = format!("{visitor}: {text}");
    }
    if let Some(falling) = habit.falling.map(|falling| falling.words()).filter(|words| !words.is_empty()) {
        text += &format!(" ({falling})");
    }
    if let Some(part) = habit.falling.and_then(|falling| falling.mostly) {
        text += &format!(" mostly {part:?}");
    }
    if let Some(place) = &habit.place {
        text += &format!(" @{place}");
    }
    if let Some(thing) = &habit.thing_on {
        text += &format!(" with {thing} on");
    }
    text += &chance(&habit.when.chance);
    text += &days(&habit.when.days);
    text += &when(&habit.when.time);
    if let Some(lasts) = &habit.when.lasts {
        text += &format!(" lasts {}", fuzzy(lasts));
    }
    if let Some(until) = &habit.when.until {
        text += &format!(" until {}", fuzzy(until));
    }
    if habit.when.times != (1, 1) {
        text += &format!(" times {:?}", habit.when.times);
    }
    if habit.when.is_total {
        text += " in all";
    }
    if habit.when.nights > 0 {
        text += &format!(" nights {}", habit.when.nights);
    }
    if habit.key {
        text += " key";
    }
    if !habit.does.is_empty() {
        text += &format!(" does {:?}", habit.does);
    }
    text + phase(&habit.when.phase).as_str()
}

fn chance(chance: &HabitChance) -> String {
    match (chance.quantifier, chance.becomes) {
        (Some(quantifier), None) => format!(" {quantifier:?}"),
        (None, None) => format!(" p{:.3}", chance.probability),
        (Some(quantifier), Some((to, by))) => format!(" {quantifier:?}>{to:.2} by {by:?}"),
        (None, Some((to, by))) => format!(" p{:.3}>{to:.2} by {by:?}", chance.probability),
    }
}

fn days(days: &DaySelection) -> String {
    let mut text = String::new();
    if days.weekdays != DaySelection::ALL.weekdays {
        text += &format!(" days {:07b}", days.weekdays);
    }
    if days.months != DaySelection::ALL.months {
        text += &format!(" months {:012b}", days.months);
    }
    if days.of_month != DaySelection::ALL.of_month {
        text += &format!(" of month {:?}", days.of_month);
    }
    if let Some(kind) = days.kind {
        text += &format!(" {kind:?}");
    }
    if days.every != 1 {
        text += &format!(" every {}", days.every);
    }
    if let Some(weather) = days.weather {
        text += &format!(" {weather:?}");
    }
    if let Some(episode) = days.episode {
        text += &format!(" for {} days every {}", episode.lasts_days, episode.every_days);
    }
    if days.poor_nights > 0 {
        text += &format!(" after {} poor nights", days.poor_nights);
    }
    text
}

fn when(when: &HabitTime) -> String {
    let gap = |gap: &Option<Fuzzy>| gap.as_ref().map(|gap| format!(" by {}", fuzzy(gap))).unwrap_or_default();
    match when {
        HabitTime::AnyTime => String::new(),
        HabitTime::At(at) => format!(" at {}", fuzzy(at)),
        HabitTime::Within(part) => format!(" {part:?}"),
        HabitTime::After(activity, by) => format!(" after {activity:?}{}", gap(by)),
        HabitTime::Before(activity, by) => format!(" before {activity:?}{}", gap(by)),
        HabitTime::With(activity) => format!(" with {activity:?}"),
        HabitTime::Then => " then".into(),
    }
}

fn rule(rule: &RoutineRule) -> String {
    let response = match &rule.response {
        Response::Turn { thing, on } => format!("turn {thing} {}", if *on { "on" } else { "off" }),
        Response::Do { activity, place, lasts } => {
            let place = place.as_ref().map(|place| format!(" @{place}")).unwrap_or_default();
            let lasts = lasts.as_ref().map(|lasts| format!(" lasts {}", fuzzy(lasts))).unwrap_or_default();
            format!("{activity:?}{place}{lasts}")
        }
    };
    let (lasts, phase) = (fuzzy(&rule.lasts), phase(&rule.when.phase));
    let mut more = String::new();
    for one in &rule.only_if {
        more += &format!(" {} {:?}", if one.holds { "if" } else { "unless" }, one.state);
    }
    for step in &rule.then {
        more += &format!(" then {step:?}");
    }
    if let Some(lapse) = &rule.lapse {
        more += &format!(
            " forgets {}{}",
            lapse.probability,
            lapse.later.map(|by| format!(" {}", fuzzy(&by))).unwrap_or_default()
        );
    }
    format!("{:?} for {lasts}: p{} {response}{phase}{more}", rule.whenever, rule.when.chance.probability)
}

fn change(change: &RoutineChange) -> String {
    let part = change.when.part().map(|part| format!(" {part:?}")).unwrap_or_default();
    let probability = change.when.chance.probability;
    let effect = match &change.effect {
        Effect::Shows { condition, severity } => format!("Shows {condition} {severity}"),
        Effect::Pace(by) => format!("Pace {}", fuzzy(by)),
        Effect::PaceEachWeek(by) => format!("PaceEachWeek {}", fuzzy(by)),
        Effect::Later { activity, by } => format!("Later {activity:?} {}", fuzzy(by)),
        Effect::Longer { activity, factor } => format!("Longer {activity:?} {}", fuzzy(factor)),
        Effect::LongerBy { activity, by } => format!("LongerBy {activity:?} {}", fuzzy(by)),
        Effect::Oftener { activity, factor } => format!("Oftener {activity:?}{part} {}", fuzzy(factor)),
        Effect::Skips { activity } => format!("Skips {activity:?} {probability}"),
        Effect::DaysDiffer(by) => format!("DaysDiffer {}", fuzzy(by)),
        Effect::DaysAre { kind, very } => format!("DaysAre {kind:?} {very}{}", chance(&change.when.chance)),
        Effect::SleepsIn => "SleepsIn".to_owned(),
        Effect::Irregular(by) => format!("Irregular {}", fuzzy(by)),
        Effect::Active { factor } => format!("Active{part} {}", fuzzy(factor)),
        Effect::Restless(by) => format!("Restless {}", fuzzy(by)),
        Effect::KeepsOn { thing } => format!(
            "KeepsOn {thing}{}{} {probability}",
            when(&change.when.time),
            change.when.until.as_ref().map(|until| format!(" until {}", fuzzy(until))).unwrap_or_default()
        ),
        Effect::Range { place, inside } => format!("Range {place} {inside} {probability}"),
        Effect::Spares { thing } => format!("Spares {thing}"),
        Effect::Forgets { thing } => format!("Forgets {thing} {probability}"),
        Effect::Shy { of, gain } => format!("Shy {of:?} {gain}"),
        Effect::Pulse(by) => format!("Pulse {}", fuzzy(by)),
        Effect::Respiration(by) => format!("Respiration {}", fuzzy(by)),
    };
    effect + days(&change.when.days).as_str() + phase(&change.when.phase).as_str()
}

fn phase(phase: &Phase) -> String {
    let mut text = String::new();
    if let Some(from) = phase.from {
        text += &format!(" from {from:?}");
    }
    if phase.over_days != 0.0 {
        text += &format!(" over {}", phase.over_days);
    }
    if let Some(until) = phase.until {
        text += &format!(" until {until:?}");
    }
    if phase.fading_days != 0.0 {
        text += &format!(" fading {}", phase.fading_days);
    }
    text
}

/// The four corners; one number if all are equal.
fn fuzzy(fuzzy: &Fuzzy) -> String {
    let round = |value: f64| (value * 1000.0).round() / 1000.0;
    let corners = [fuzzy.low, fuzzy.from, fuzzy.to, fuzzy.high].map(round);
    if corners[0] == corners[3] { corners[0].to_string() } else { corners.map(|corner| corner.to_string()).join("/") }
}
