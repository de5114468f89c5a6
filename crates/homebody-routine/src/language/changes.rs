//! The meaning of a clause that changes something.

use super::builder::Builder;
use super::messages::SentenceMessage;
use super::parts::{Measure, Of, SlotKind};
use super::productions::unsaid_chance;
use super::value::{Clause, SentenceSubject, Verb};
use crate::routine::{Activity, Effect, HabitChance, HabitTime, PartOfDay, RoutineChange, Shy, When};
use homebody_core::activity::TimeUse;
use homebody_core::fuzzy::{Fuzzy, Quantifier};

/// Strength of a shy person's avoidance of others, where the goal has 1 (our choice).
const SHY: f64 = 1.5;
/// Stops a minute of a person who always stops (our choice).
const STOPS_PER_MIN: f64 = 6.0;
/// How much later somebody gets up who sleeps longer, without a number (our choice).
const SLEEPS_LONGER_S: (f64, f64) = (1_800.0, 5_400.0);

const PHASE_ALONE: &[SlotKind] = &[SlotKind::Phase];
const PHASE: &[SlotKind] = &[SlotKind::Phase, SlotKind::Days];
const PHASE_AND_PART: &[SlotKind] = &[SlotKind::Phase, SlotKind::Days, SlotKind::Part];
/// Of a thing that is on from one time until another.
const OF_THING: &[SlotKind] =
    &[SlotKind::Phase, SlotKind::Days, SlotKind::Chance, SlotKind::Said, SlotKind::Until, SlotKind::Part];
const PHASE_AND_CHANCE: &[SlotKind] = &[SlotKind::Phase, SlotKind::Days, SlotKind::Chance];

pub const IS: &str = "write \"is 82\", \"is a cat\", \"is out\" or \"is 30 % less active\"";

pub fn change(builder: &mut Builder, clause: &Clause) {
    let Some((effect, allowed)) = effect(builder, clause) else { return };
    let why = "a change holds for whole days, from its first day on";
    let allowed: Vec<SlotKind> = allowed.iter().copied().chain([SlotKind::Measure]).collect();
    builder.only(&clause.parts, &allowed, why);
    let phase = builder.phase(&clause.parts, clause.span);
    if let (Effect::DaysAre { .. }, Some(kind)) = (&effect, &clause.parts.kind) {
        return builder.fault(kind.span, SentenceMessage::WhichDays);
    }
    if let Some(nights) = &clause.parts.poor_nights {
        let text = builder.said(nights.span);
        let reason = "an activity may follow a poor night, and a change may not".to_owned();
        return builder.fault(nights.span, SentenceMessage::DoesNotFit { text, reason });
    }
    let part = clause.parts.part.as_ref().and_then(|slot| slot.value.first()).copied();
    let (time, until) = match effect {
        Effect::Oftener { .. } | Effect::Active { .. } => (part.map_or(HabitTime::AnyTime, HabitTime::Within), None),
        Effect::KeepsOn { .. } => keeping(builder, clause),
        _ => (HabitTime::AnyTime, None),
    };
    let chance = match effect {
        Effect::DaysAre { .. } => days_chance(clause),
        Effect::Skips { .. } | Effect::Forgets { .. } | Effect::KeepsOn { .. } | Effect::Range { .. }
            if chance(clause).is_some() =>
        {
            clause.parts.chance.as_ref().map_or(HabitChance::ALWAYS, |slot| slot.value.chance)
        }
        _ => HabitChance::ALWAYS,
    };
    let when = When { phase, days: clause.parts.days(), chance, time, until, ..When::default() };
    let said = builder.quote(clause.span);
    builder.built.changes.push(RoutineChange { said, when, effect });
}

fn effect(builder: &mut Builder, clause: &Clause) -> Option<(Effect, &'static [SlotKind])> {
    let measure = clause.parts.measure.as_ref().map(|slot| slot.value);
    if names_one_outing(builder, clause) {
        let text = builder.said(clause.verb_span);
        builder.fault(clause.verb_span, SentenceMessage::OneOuting { text });
        return None;
    }
    let of_body = clause.subject == SentenceSubject::Pulse || clause.subject == SentenceSubject::Breathing;
    Some(match (&clause.verb, measure.map(|Measure { of, by }| (of, by))) {
        (Verb::Does(act), Some((of, by))) => return of_activity(builder, clause, &act.activity, of, by),
        (Verb::Walks | Verb::Is, Some((Of::Faster, by))) => (Effect::Pace(by), PHASE),
        (Verb::Walks, Some((Of::FasterBy { each_week: true }, by))) => (Effect::PaceEachWeek(by), PHASE),
        (Verb::Is, Some((Of::Active, factor))) => (Effect::Active { factor }, PHASE_AND_PART),
        (Verb::Sleeps, Some((Of::Restless | Of::Much, by))) => (Effect::Restless(by), PHASE),
        (Verb::Sleeps, Some((Of::Later | Of::LongerBy, by))) => {
            (Effect::Later { activity: Activity::GetUp, by }, PHASE)
        }
        (Verb::Sleeps, Some((Of::Longer | Of::Some, by))) if by.from != by.to => {
            let (least, most) = SLEEPS_LONGER_S;
            let by = if by.from > 1.0 { Fuzzy::between(least, most) } else { Fuzzy::between(-most, -least) };
            (Effect::Later { activity: Activity::GetUp, by }, PHASE)
        }
        (Verb::Vary, Some((Of::Much, by))) => (Effect::Irregular(by), PHASE),
        (Verb::Differ, Some((Of::Much, by))) => (Effect::DaysDiffer(by), PHASE),
        (Verb::SleepsIn, None) => (Effect::SleepsIn, PHASE),
        (Verb::Lively(kind, very), None) => (Effect::DaysAre { kind: *kind, very: *very }, PHASE_AND_CHANCE),
        (Verb::Breathes, Some((Of::Breaths, by))) => (Effect::Respiration(by), PHASE),
        (Verb::Is, Some((Of::Breaths, by))) if of_body => (Effect::Respiration(by), PHASE),
        (Verb::Is, Some((Of::Beats, by))) if of_body => (Effect::Pulse(by), PHASE),
        (Verb::Rises(Measure { of: Of::Beats, by }), None) => (Effect::Pulse(*by), PHASE),
        (Verb::Rises(Measure { by, .. }), None) => (Effect::Respiration(*by), PHASE),
        (Verb::Shy(Shy::GoingOn), None) => {
            let often = chance(clause).unwrap_or(Quantifier::Sometimes.probability());
            (Effect::Shy { of: Shy::GoingOn, gain: STOPS_PER_MIN * often }, PHASE_AND_CHANCE)
        }
        (Verb::Stops(gain), None) => (Effect::Shy { of: Shy::GoingOn, gain: *gain }, PHASE),
        (Verb::Shy(of), None) => (Effect::Shy { of: *of, gain: SHY }, PHASE),
        (Verb::Shows(condition, severity), None) => {
            (Effect::Shows { condition: condition.clone(), severity: *severity }, PHASE_ALONE)
        }
        (Verb::Not(act) | Verb::Skips(act), None) if act.activity == Activity::GoToBed => {
            let text = builder.said(clause.verb_span);
            let reason = "write when she goes to bed instead, such as \"on day 5 she goes to bed at 05:00\"".to_owned();
            builder.fault(clause.verb_span, SentenceMessage::DoesNotFit { text, reason });
            return None;
        }
        (Verb::Not(act), None) => match chance(clause) {
            Some(_) => (Effect::Skips { activity: act.activity.clone() }, PHASE_AND_CHANCE),
            None => {
                let factor = Fuzzy::exactly(0.0);
                (Effect::Oftener { activity: act.activity.clone(), factor }, PHASE_AND_PART)
            }
        },
        (Verb::Skips(act), None) => {
            let says_weekdays = clause.parts.weekdays.as_ref().is_some_and(|slot| slot.own);
            let activity = act.activity.clone();
            if says_weekdays && chance(clause).is_none() {
                return Some((Effect::Skips { activity }, PHASE));
            }
            let last = builder.said(act.span);
            let last = last.rsplit(' ').next().unwrap_or_default();
            needed_chance(builder, clause, format!("she skips {last} on 30 % of days"))?;
            (Effect::Skips { activity }, PHASE_AND_CHANCE)
        }
        (Verb::KeepsOn(thing, _), None) => (Effect::KeepsOn { thing: thing.clone() }, OF_THING),
        (Verb::Forgets(thing), None) if clause.parts.says_time() => {
            (Effect::KeepsOn { thing: thing.clone() }, OF_THING)
        }
        (Verb::Range(place, inside), None) => {
            (Effect::Range { place: place.clone(), inside: *inside }, PHASE_AND_CHANCE)
        }
        (Verb::Spares(thing), None) => (Effect::Spares { thing: thing.clone() }, PHASE),
        (Verb::Forgets(thing), None) => {
            needed_chance(builder, clause, format!("she forgets the {thing} on 5 % of occasions"))?;
            (Effect::Forgets { thing: thing.clone() }, PHASE_AND_CHANCE)
        }
        _ => {
            not_a_change(builder, clause);
            return None;
        }
    })
}

/// From when until when a thing is on: by the clock, or all night.
fn keeping(builder: &mut Builder, clause: &Clause) -> (HabitTime, Option<Fuzzy>) {
    let parts = &clause.parts;
    let is_of_night = parts.part.as_ref().is_some_and(|slot| slot.value == [PartOfDay::Night]);
    let when = parts.when.as_ref().and_then(|slot| slot.value.first());
    let (time, until) = builder.time(when, parts, &Activity::Relax);
    let is_whole_night = matches!(clause.verb, Verb::KeepsOn(_, true)) || is_of_night;
    match (&time, &until) {
        (HabitTime::At(_), Some(_)) => return (time, until),
        _ if is_whole_night && when.is_none() && parts.until.is_none() => {}
        _ => {
            let (text, help) = (
                builder.said(clause.verb_span),
                "write \"from 20:00 until 22:00\", \"all night\", or how often she forgets it, \"on 5 % of occasions\""
                    .to_owned(),
            );
            builder.fault(clause.verb_span, SentenceMessage::OpenChange { text, help });
        }
    }
    (HabitTime::Within(PartOfDay::Night), None)
}

fn days_chance(clause: &Clause) -> HabitChance {
    let parts = &clause.parts;
    let says_days = parts.weekdays.is_some() || parts.months.is_some() || parts.every.is_some();
    parts
        .chance
        .as_ref()
        .map_or(if says_days { HabitChance::ALWAYS } else { unsaid_chance() }, |slot| slot.value.chance)
}

fn names_one_outing(builder: &Builder, clause: &Clause) -> bool {
    const GENERAL: [&str; 9] = ["", "apartment", "flat", "home", "house", "building", "out", "outside", "away"];
    let (Verb::Does(act) | Verb::Not(act) | Verb::Skips(act)) = &clause.verb else { return false };
    let said = builder.said(act.span);
    act.activity == Activity::Leave && !GENERAL.contains(&said.rsplit(' ').next().unwrap_or_default())
}

fn of_activity(
    builder: &mut Builder,
    clause: &Clause,
    activity: &Activity,
    of: Of,
    by: Fuzzy,
) -> Option<(Effect, &'static [SlotKind])> {
    let activity = activity.clone();
    let effect = match of {
        Of::Later => Effect::Later { activity, by },
        Of::Longer => Effect::Longer { activity, factor: by },
        Of::LongerBy => Effect::LongerBy { activity, by },
        Of::Oftener => return Some((Effect::Oftener { activity, factor: by }, PHASE_AND_PART)),
        Of::Some if lasts_long(&activity) => Effect::Longer { activity, factor: by },
        Of::Some => return Some((Effect::Oftener { activity, factor: by }, PHASE_AND_PART)),
        Of::Much => {
            let span = clause.parts.measure.as_ref().map_or(clause.span, |slot| slot.span);
            let text = builder.said(span);
            builder.fault(span, SentenceMessage::MoreOrLonger { text });
            return None;
        }
        _ => {
            not_a_change(builder, clause);
            return None;
        }
    };
    Some((effect, PHASE))
}

fn lasts_long(activity: &Activity) -> bool {
    matches!(
        TimeUse::from_label(activity.label()),
        TimeUse::Television | TimeUse::Reading | TimeUse::Relaxing | TimeUse::Computer | TimeUse::Eating
    )
}

fn not_a_change(builder: &mut Builder, clause: &Clause) {
    let help = match &clause.verb {
        Verb::Walks => {
            "write \"walks 10 % slower\", \"walks 0.02 m/s slower every week\", \"wanders around\", \
            \"walks up and down\" or \"goes for a walk\""
        }
        Verb::Is => IS,
        Verb::Sleeps => {
            "write \"sleeps 30 % more restlessly\", \"goes to bed at 22:30\", \"gets up at 09:00\", \
            \"goes to bed for 9 hours\" or \"naps\""
        }
        Verb::Vary => "write \"her hours vary twice as much\"",
        Verb::Differ => "write \"her days differ twice as much\"",
        Verb::Lively(..) => "write \"one day in three is a quiet day\" or \"on Sunday she has a busy day\"",
        Verb::Breathes => "write \"breathes 6 breaths a minute faster\"",
        _ => "describe the change as \"later\", \"longer\" or \"more often\"",
    };
    let span = clause.parts.measure.as_ref().map_or(clause.verb_span, |slot| slot.span);
    let (text, help) = (builder.said(span), help.to_owned());
    match &clause.parts.measure {
        Some(_) => builder.fault(span, SentenceMessage::OtherChange { text, help }),
        None => builder.fault(span, SentenceMessage::OpenChange { text, help }),
    }
}

/// The probability, if the sentence or its heading says one besides "every day".
fn chance(clause: &Clause) -> Option<f64> {
    let chance = clause.parts.chance.as_ref()?;
    let says = chance.own || chance.value.chance.quantifier != Some(Quantifier::Every);
    says.then_some(chance.value.chance.probability)
}

fn needed_chance(builder: &mut Builder, clause: &Clause, example: String) -> Option<f64> {
    let chance = chance(clause);
    if chance.is_none() {
        let text = builder.said(clause.verb_span);
        builder.fault(clause.verb_span, SentenceMessage::HowOften { text, example });
    }
    chance
}
