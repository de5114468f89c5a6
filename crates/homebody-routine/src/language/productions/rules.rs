//! Rules: "Whenever the stove has been on for 20 minutes, she turns it off."

use super::arguments::{Arguments, Production};
use super::numbers::{as_range, duration};
use super::times::{as_event, as_parts, as_time};
use crate::language::amounts::DAY_S;
use crate::language::messages::{RuleSentenceMessage, TimeSentenceMessage};
use crate::language::parts::{Parts, Said, TimeOfDay};
use crate::language::value::{Answer, PhraseValue, RuleSaid, SpokenStatement};
use crate::routine::{Activity, Circumstance, Lapse, Response, RuleTrigger};
use homebody_core::fuzzy::Fuzzy;

/// Probability of forgetting, if the sentence gives none (our choice).
const FORGETS: f64 = 0.3;

pub fn named(name: &str) -> Option<Production> {
    Some(match name {
        "thing_on" => |a| state(RuleTrigger::On(a.name()?)),
        "person_at" => |a| state(RuleTrigger::At(a.name()?)),
        "trigger" => |a| state(plain(a.constant(0))?),
        "trigger_doing" => |a| state(RuleTrigger::Doing(a.one(as_event)?)),
        "trigger_done" => |a| state(RuleTrigger::Done(a.one(as_event)?)),
        "doing_act" => |a| state(RuleTrigger::Doing(Activity::from_label(a.constant(0))?)),
        "done_act" => |a| state(RuleTrigger::Done(Activity::from_label(a.constant(0))?)),
        "trigger_dark" => |a| state(RuleTrigger::Dark(a.name())),
        "rings" => |a| state(RuleTrigger::Rings(a.name()?)),
        "anyone" => |_| Some(PhraseValue::Unit),
        "visitor_name" => |a| Some(PhraseValue::Name(a.name().unwrap_or_else(|| a.spoken()))),
        "company" => |a| state(RuleTrigger::Company(a.name())),
        "trigger_time" => |a| {
            let at = closed(a)?[0];
            state(RuleTrigger::Between(at, DAY_S))
        },
        "trigger_for" | "follows_for" => |a| {
            let trigger = a.one(as_trigger).map_or(RuleTrigger::Follows, |(trigger, _)| trigger);
            let range = a.one(as_range)?;
            let lasts = duration(range);
            if range.to > DAY_S {
                let span = a.kids[a.kids.len() - 1].span;
                a.fault(span, TimeSentenceMessage::LongerThanADay { text: a.said(span) });
            } else if range.from <= 0.0 {
                let span = a.kids[a.kids.len() - 1].span;
                a.fault(span, RuleSentenceMessage::Always { text: a.said(span) });
            }
            Some(PhraseValue::Trigger(trigger, Some(lasts)))
        },
        "circumstance" => |a| circumstance(a, plain(a.constant(0))?, true),
        "circumstance_not" => |a| circumstance(a, plain(a.constant(0))?, false),
        "circumstance_dark" => |a| circumstance(a, RuleTrigger::Dark(a.name()), !a.has("not")),
        "circumstance_between" => |a| {
            let times = a.all(as_time);
            let at = |time: &TimeOfDay| (!time.clock.open).then_some(time.clock.s.rem_euclid(DAY_S));
            circumstance(a, RuleTrigger::Between(at(&times[0])?, at(&times[1])?), !a.has("not"))
        },
        "circumstance_after" => |a| {
            let at = closed(a)?[0];
            circumstance(a, RuleTrigger::Between(at, DAY_S), !a.has("not"))
        },
        "circumstance_before" => |a| {
            let at = closed(a)?[0];
            circumstance(a, RuleTrigger::Between(0.0, at), !a.has("not"))
        },
        "circumstance_company" => |a| circumstance(a, RuleTrigger::Company(a.name()), !a.has("not")),
        "circumstance_thing" => |a| circumstance(a, RuleTrigger::Rings(a.name()?), !a.has("not")),
        "circumstance_doing" => |a| circumstance(a, RuleTrigger::Doing(a.one(as_event)?), !a.has("not")),
        "circumstance_at" => |a| circumstance(a, RuleTrigger::At(a.name()?), !a.has("not")),
        "circumstances" => |a| {
            let negated = a.has("not");
            let all = a.all(as_circumstances).concat();
            let turned = all.into_iter().map(|one| Circumstance { holds: one.holds != negated, ..one });
            Some(PhraseValue::Circumstances(turned.collect()))
        },
        "it" => |_| Some(PhraseValue::Name(String::new())),
        "turn" => |a| response(Response::Turn { thing: a.name()?, on: a.has("on") }),
        "turn_word" => |a| {
            let on = a.words[1].text == "on";
            response(Response::Turn { thing: a.name()?, on })
        },
        "respond" => |a| response(Response::Do { activity: a.act()?.activity, place: None, lasts: None }),
        "respond_at" => |a| {
            let activity = Activity::Other(a.words[..a.words.len()].first()?.text.clone());
            let activity = if a.has("looks") { Activity::Other("looks at".to_owned()) } else { activity };
            response(Response::Do { activity, place: a.name(), lasts: None })
        },
        "respond_own" => |a| response(Response::Do { activity: Activity::Other(a.name()?), place: None, lasts: None }),
        "answer" => |a| {
            let both = a.all(as_parts);
            let parts = match both[..] {
                [ref one] => one.clone(),
                [ref first, ref second] => super::clauses::merged(a, first, second),
                _ => Parts::default(),
            };
            let mut answer = a.one(as_answers)?.pop()?;
            answer.parts = parts;
            Some(PhraseValue::Answers(vec![Answer { span: a.span, ..answer }]))
        },
        "answers" => |a| Some(PhraseValue::Answers(a.all(as_answers).concat())),
        "lapse" => |a| {
            let chances = a.all(as_parts);
            let chance =
                chances.iter().find_map(|parts| parts.chance.as_ref()).map(|slot| slot.value.chance.probability);
            if chances.iter().flat_map(Parts::slots).any(|(kind, _)| kind != crate::language::parts::SlotKind::Chance) {
                return None;
            }
            let later = a.one(as_range).map(duration);
            Some(PhraseValue::Lapse(Lapse { probability: chance.unwrap_or(FORGETS), later }))
        },
        "rule" => rule,
        _ => return None,
    })
}

fn plain(name: &str) -> Option<RuleTrigger> {
    Some(match name {
        "Away" => RuleTrigger::Away,
        "InBed" => RuleTrigger::InBed,
        "Alone" => RuleTrigger::Alone,
        "Sitting" => RuleTrigger::Sitting,
        "Follows" => RuleTrigger::Follows,
        "Wakes" => RuleTrigger::Wakes,
        _ => return None,
    })
}

fn state(trigger: RuleTrigger) -> Option<PhraseValue> {
    Some(PhraseValue::Trigger(trigger, None))
}

fn circumstance(_: &Arguments, state: RuleTrigger, holds: bool) -> Option<PhraseValue> {
    Some(PhraseValue::Circumstances(vec![Circumstance { holds, state }]))
}

fn response(response: Response) -> Option<PhraseValue> {
    Some(PhraseValue::Answers(vec![Answer {
        response,
        parts: Parts::default(),
        span: crate::language::words::TextSpan::default(),
    }]))
}

/// Times of a circumstance, which nothing else decides.
fn closed(a: &mut Arguments) -> Option<Vec<f64>> {
    let times = a.all(as_time);
    if let Some(open) = times.iter().find(|time| time.clock.open) {
        let text = a.said(open.clock.span);
        let help = format!("write \"{text} am\" or \"{text} pm\"");
        a.fault(open.clock.span, TimeSentenceMessage::AmbiguousTime { text, help });
    }
    Some(times.iter().map(|time| time.clock.s.rem_euclid(DAY_S)).collect())
}

fn as_trigger(value: &PhraseValue) -> Option<(RuleTrigger, Option<Fuzzy>)> {
    match value {
        PhraseValue::Trigger(trigger, lasts) => Some((trigger.clone(), *lasts)),
        _ => None,
    }
}

fn as_circumstances(value: &PhraseValue) -> Option<Vec<Circumstance>> {
    match value {
        PhraseValue::Circumstances(all) => Some(all.clone()),
        _ => None,
    }
}

fn as_answers(value: &PhraseValue) -> Option<Vec<Answer>> {
    match value {
        PhraseValue::Answers(answers) => Some(answers.clone()),
        _ => None,
    }
}

fn rule(a: &mut Arguments) -> Option<PhraseValue> {
    let at = a.kids.iter().position(|kid| as_trigger(&kid.value).is_some())?;
    let (trigger, lasts) = as_trigger(&a.kids[at].value)?;
    let trigger_span = a.kids[at].span;
    let front = a.kids[..at].iter().find_map(|kid| as_parts(&kid.value)).unwrap_or_default();
    let needs_length =
        matches!(trigger, RuleTrigger::On(_) | RuleTrigger::At(_) | RuleTrigger::Away | RuleTrigger::InBed);
    if needs_length && lasts.is_none() {
        a.fault(trigger_span, RuleSentenceMessage::NoLength);
    }
    let answers = a.one(as_answers)?;
    let asks_then = |parts: &Parts| parts.when.as_ref().is_some_and(|slot| slot.value == [Said::Then]);
    if answers.iter().any(|answer| asks_then(&answer.parts)) {
        return None;
    }
    let lapse = a.one(|value| match value {
        PhraseValue::Lapse(lapse) => Some(*lapse),
        _ => None,
    });
    let only_if = a.all(as_circumstances).concat();
    let said = RuleSaid { trigger, trigger_span, lasts, only_if, answers, lapse };
    Some(PhraseValue::Statement(Box::new(SpokenStatement::Rule(front, said))))
}
