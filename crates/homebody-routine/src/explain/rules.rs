//! Rules in words, and as layers.

use super::words::{clock, join, lasts_words, number};
use crate::language::activities::phrase;
use crate::routine::{Lapse, Response, Routine, RoutineRule, RuleTrigger};

/// The trigger: "whenever the stove has been on or open for 20 minutes, unless the person is in bed".
pub fn whenever(rule: &RoutineRule) -> String {
    let lasts = if rule.lasts.high > 0.0 { format!(" for {}", lasts_words(&rule.lasts)) } else { String::new() };
    let only_if = rule.only_if.iter().map(|one| {
        let state = so(&one.state);
        if one.holds { format!(", only if {state}") } else { format!(", unless {state}") }
    });
    format!("whenever {}{lasts}{}", event(&rule.whenever, rule.lasts.high > 0.0), only_if.collect::<String>())
}

/// The responses in order, with lapses.
pub fn answers(rule: &RoutineRule) -> String {
    let done = join(rule.answers().map(answer), ", then ");
    let lapse = rule.lapse.map(|Lapse { probability, later }| {
        let later =
            later.map_or(" and leaves it".to_owned(), |later| format!(" and does it {} later", lasts_words(&later)));
        format!(", but forgets it with probability {}{later}", number(probability))
    });
    done + lapse.unwrap_or_default().as_str()
}

fn answer(answer: &Response) -> String {
    match answer {
        Response::Turn { thing, on: true } => format!("goes to the {thing} and turns it on or opens it"),
        Response::Turn { thing, on: false } => format!("goes to the {thing} and turns it off or closes it"),
        Response::Do { activity, place, lasts } => {
            let place = place.as_ref().map(|place| format!("at the {place}"));
            let lasts = lasts.as_ref().map(|lasts| format!("for {}", lasts_words(lasts)));
            join([Some(phrase(activity)), place, lasts].into_iter().flatten(), " ")
        }
    }
}

fn event(trigger: &RuleTrigger, lasts: bool) -> String {
    match trigger {
        RuleTrigger::On(thing) => format!("the {thing} has been on or open"),
        RuleTrigger::At(place) => format!("the person has been at the {place}"),
        RuleTrigger::Away => "the person has been out".into(),
        RuleTrigger::InBed => "the person has been in bed".into(),
        RuleTrigger::Rings(thing) => format!("anybody turns on the {thing}"),
        RuleTrigger::Dark(room) => format!("it gets dark{}", in_room(room)),
        RuleTrigger::Company(who) if !lasts => format!("{} comes", somebody(who)),
        RuleTrigger::Doing(activity) if !lasts => format!("the person begins: {}", phrase(activity)),
        RuleTrigger::Done(activity) => format!("this is over: {}", phrase(activity)),
        RuleTrigger::Between(from, _) if !lasts => format!("it gets {}", clock(*from)),
        RuleTrigger::Follows => "the rule before has been answered".into(),
        state => so(state),
    }
}

fn so(state: &RuleTrigger) -> String {
    match state {
        RuleTrigger::On(thing) | RuleTrigger::Rings(thing) => format!("the {thing} is on or open"),
        RuleTrigger::At(place) => format!("the person is at the {place}"),
        RuleTrigger::Away => "the person is out".into(),
        RuleTrigger::InBed => "the person is in bed".into(),
        RuleTrigger::Dark(room) => format!("it is dark{}", in_room(room)),
        RuleTrigger::Company(who) => format!("{} is there", somebody(who)),
        RuleTrigger::Alone => "nobody else is there".into(),
        RuleTrigger::Sitting => "the person sits".into(),
        RuleTrigger::Doing(activity) => format!("this goes on: {}", phrase(activity)),
        RuleTrigger::Done(activity) => format!("this is over: {}", phrase(activity)),
        RuleTrigger::Between(from, to) => format!("it is between {} and {}", clock(*from), clock(*to)),
        RuleTrigger::Follows => "the rule before has been answered".into(),
        RuleTrigger::Wakes => "the person wakes at night".into(),
    }
}

fn in_room(room: &Option<String>) -> String {
    room.as_ref().map(|room| format!(" in the {room}, with its lamp off")).unwrap_or_default()
}

fn somebody(who: &Option<String>) -> String {
    who.as_ref().map_or("somebody".to_owned(), |who| format!("the {who}"))
}

/// The rules as layers, the first on top: each suppresses those below while it is answered.
pub fn layers(routine: &Routine) -> String {
    let count = routine.rules.len();
    if count == 0 {
        return String::new();
    }
    let mut text = String::from("Layers, of which each goes before all below it until it is answered:\n\n");
    let layer = |height: usize, what: &str, done: &str| format!("  {height:>2} | {what}\n     |   -> {done}\n");
    for (index, rule) in routine.rules.iter().enumerate() {
        text += &layer(count + 1 - index, &whenever(rule), &answers(rule));
    }
    text += &layer(1, "needs that press, and what happens", "toilet, drinks, callers");
    text += &layer(0, "the plan of the day", "what is said, and what fills the time");
    text
}
