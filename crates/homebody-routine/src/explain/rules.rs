//! Rules in words, and as layers of which the upper go before the lower.

use super::words::{clock, join, lasts_words, number};
use crate::language::activities::phrase;
use crate::routine::{Lapse, Response, Routine, Rule, Trigger};

/// What a rule waits for: "whenever the stove has been on or open for 20 minutes, unless the person is in bed".
pub fn whenever(rule: &Rule) -> String {
    let lasts = if rule.lasts.high > 0.0 { format!(" for {}", lasts_words(&rule.lasts)) } else { String::new() };
    let only_if = rule.only_if.iter().map(|one| {
        let state = so(&one.state);
        if one.holds { format!(", only if {state}") } else { format!(", unless {state}") }
    });
    format!("whenever {}{lasts}{}", event(&rule.whenever, rule.lasts.high > 0.0), only_if.collect::<String>())
}

/// What is done then, one after the other, and what becomes of it where it is forgotten.
pub fn answers(rule: &Rule) -> String {
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

/// What happens, or has lasted.
fn event(trigger: &Trigger, lasts: bool) -> String {
    match trigger {
        Trigger::On(thing) => format!("the {thing} has been on or open"),
        Trigger::At(place) => format!("the person has been at the {place}"),
        Trigger::Away => "the person has been out".into(),
        Trigger::InBed => "the person has been in bed".into(),
        Trigger::Rings(thing) => format!("anybody turns on the {thing}"),
        Trigger::Dark(room) => format!("it gets dark{}", in_room(room)),
        Trigger::Company(who) if !lasts => format!("{} comes", somebody(who)),
        Trigger::Doing(activity) if !lasts => format!("the person begins: {}", phrase(activity)),
        Trigger::Done(activity) => format!("this is over: {}", phrase(activity)),
        Trigger::Between(from, _) if !lasts => format!("it gets {}", clock(*from)),
        Trigger::Follows => "the rule before has been answered".into(),
        state => so(state),
    }
}

/// What is so.
fn so(state: &Trigger) -> String {
    match state {
        Trigger::On(thing) | Trigger::Rings(thing) => format!("the {thing} is on or open"),
        Trigger::At(place) => format!("the person is at the {place}"),
        Trigger::Away => "the person is out".into(),
        Trigger::InBed => "the person is in bed".into(),
        Trigger::Dark(room) => format!("it is dark{}", in_room(room)),
        Trigger::Company(who) => format!("{} is there", somebody(who)),
        Trigger::Alone => "nobody else is there".into(),
        Trigger::Sitting => "the person sits".into(),
        Trigger::Doing(activity) => format!("this goes on: {}", phrase(activity)),
        Trigger::Done(activity) => format!("this is over: {}", phrase(activity)),
        Trigger::Between(from, to) => format!("it is between {} and {}", clock(*from), clock(*to)),
        Trigger::Follows => "the rule before has been answered".into(),
    }
}

fn in_room(room: &Option<String>) -> String {
    room.as_ref().map(|room| format!(" in the {room}, with its lamp off")).unwrap_or_default()
}

fn somebody(who: &Option<String>) -> String {
    who.as_ref().map_or("somebody".to_owned(), |who| format!("the {who}"))
}

/// The rules as layers, the first of the text on top: each suppresses those below it while it is answered, and releases them then.
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
