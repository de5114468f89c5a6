//! Clauses joined by "and", "or" or "then": what each takes over from the others.
//!
//! Days, how often and from when on hold for all of them. Of what is joined by "and", a part of the day holds for all that say
//! no other; a time of day is that of the first, and the next come after it. What is joined by "or" shares everything, and each
//! is done on its share of the days.

use super::messages::SentenceMessage;
use super::parts::{Chance, Parts, Said, Slot};
use super::value::{Clause, Join, Verb};
use super::words::TextSpan;
use crate::routine::{Activity, HabitChance};
use homebody_core::problem::Diagnostic;

/// The clauses of a sentence, each with all of its parts.
pub fn shared(front: &Parts, clauses: &[(Join, Clause)]) -> Result<Vec<Clause>, (TextSpan, Diagnostic)> {
    let mut all: Vec<Clause> = Vec::new();
    let clauses = of_visits(clauses);
    let mut rest = &clauses[..];
    while let Some((_, first)) = rest.first() {
        let length = rest.iter().skip(1).position(|(join, _)| *join == Join::Then).map_or(rest.len(), |at| at + 1);
        let mut group: Vec<Clause> = Vec::new();
        let (mut and, mut or) = (false, false);
        for (at, (join, clause)) in rest[..length].iter().enumerate() {
            let parts = match (at, all.first()) {
                (0, None) => clause.parts.clone().with_rest_of(front),
                (0, Some(first)) => clause.parts.clone().on_days_of(&first.parts),
                _ => clause.parts.clone(),
            };
            let clause = Clause { parts, ..clause.clone() };
            if at > 0 {
                and |= *join != Join::Or;
                or |= *join == Join::Or;
            }
            match (*join, group.last()) {
                (Join::Again, Some(last)) => group.push(again(last, clause)),
                _ => group.push(clause),
            }
        }
        if and && or {
            return Err((first.span.to(rest[length - 1].1.span), SentenceMessage::AndOr.into()));
        }
        let is_not = group.iter().all(|clause| matches!(clause.verb, Verb::Not(_)));
        if or && !is_not {
            divide(&mut group);
        } else if let Some(unclear) = take_over(&mut group, &rest[..length]) {
            return Err((unclear, SentenceMessage::SharedPart { text: String::new() }.into()));
        }
        all.append(&mut group);
        rest = &rest[length..];
    }
    Ok(all)
}

/// "Visits on Sunday and cooks": what a visitor does without parts of its own happens during the visit before it.
fn of_visits(clauses: &[(Join, Clause)]) -> Vec<(Join, Clause)> {
    let mut all: Vec<(Join, Clause)> = Vec::new();
    for (join, clause) in clauses {
        let mut clause = clause.clone();
        let is_work = matches!(clause.verb, Verb::Helps(..)) && clause.parts.is_empty() && *join == Join::And;
        let visit = all.last().filter(|(_, last)| matches!(last.verb, Verb::Visits | Verb::Helps(..)));
        if let Some((_, visit)) = visit.filter(|(_, visit)| is_work && visit.subject == clause.subject) {
            clause.parts = visit.parts.clone();
            clause.behind = visit.behind.clone();
        }
        all.push((*join, clause));
    }
    all
}

/// The clause before, with other parts.
fn again(last: &Clause, more: Clause) -> Clause {
    let (says_when, says_part) = (more.parts.when.is_some(), more.parts.part.is_some());
    let says_days = more.parts.weekdays.is_some() || more.parts.every.is_some() || more.parts.of_month.is_some();
    let mut before = last.parts.clone();
    if says_when || says_part {
        (before.when, before.part, before.until) = (None, None, None);
    }
    if says_days {
        (before.chance, before.weekdays, before.every, before.of_month) = (None, None, None, None);
    }
    if more.parts.times.is_some() {
        before.chance = before.chance.filter(|slot| !slot.value.is_rate);
    }
    if more.parts.chance.is_some() {
        before.times = None;
    }
    if let (Some(follows), Some(until)) = (&more.parts.follows, &last.parts.until_day) {
        before.from = Some(Slot { value: until.value, span: follows.span, own: true });
        before.until_day = None;
    }
    let parts = more.parts.with_rest_of(&before);
    let parts = Parts { follows: parts.follows.filter(|_| last.parts.until_day.is_none()), ..parts };
    Clause { parts, ..more }
}

fn take_over(group: &mut [Clause], said: &[(Join, Clause)]) -> Option<TextSpan> {
    let (last, earlier) = group.split_last_mut()?;
    for (at, clause) in earlier.iter_mut().enumerate() {
        if said.get(at + 1).is_some_and(|(join, _)| *join == Join::Again) && last.verb == clause.verb {
            // "In the morning and in the evening for 20 minutes": so long each time.
            clause.parts.lasts = clause.parts.lasts.take().or(last.parts.lasts.clone());
            continue;
        }
        if !(is_lived(clause) && clause.subject == last.subject) {
            continue;
        }
        let behind = last.behind.clone();
        if clause.parts.days_span().is_none() && behind.days_span().is_some() {
            // "Takes a tablet in the morning and goes out often": often is about going out.
            let only_often = Parts { chance: None, ..behind.clone() }.days_span().is_none();
            if clause.parts.says_time() && only_often {
                continue;
            }
            // "Reads at 10:00 and naps on Sunday" leaves open what is on Sunday.
            if clause.parts.says_time() && !behind.says_time() {
                return behind.days_span();
            }
            clause.parts = clause.parts.clone().on_days_of(&behind);
        }
        let is_bed = does(&last.verb, &Activity::GoToBed);
        if clause.parts.says_time() || does(&last.verb, &Activity::ComeHome) {
            continue;
        }
        clause.parts.part = behind.part.clone();
        let Some(when) = behind.when.clone() else { continue };
        if is_bed {
            clause.parts.when = Some(Slot { value: vec![Said::Before(Activity::GoToBed, None)], ..when });
        } else {
            clause.parts.when = last.parts.when.replace(Slot { value: vec![Said::Then], ..when });
        }
    }
    let (first, others) = group.split_first_mut()?;
    for (here, (join, _)) in others.iter_mut().zip(&said[1..]) {
        let is_again = *join == Join::Again;
        if !is_lived(here) || !is_lived(first) || is_again {
            continue;
        }
        // "She goes to church on Sunday and reads" does, too.
        let goes_on = does(&here.verb, &Activity::ComeHome) || here.parts.days_span().is_some();
        if first.behind.days_span().is_some() && !goes_on && here.subject == first.subject {
            return first.behind.days_span();
        }
        here.parts = here.parts.clone().on_days_of(&first.parts);
        if !here.parts.says_time() && here.subject == first.subject {
            match &first.parts.when {
                Some(when) => here.parts.when = Some(Slot { value: vec![Said::Then], ..when.clone() }),
                None => here.parts.part = first.parts.part.clone(),
            }
        }
    }
    None
}

fn does(verb: &Verb, activity: &Activity) -> bool {
    matches!(verb, Verb::Does(act) if act.activity == *activity)
}

fn is_lived(clause: &Clause) -> bool {
    !matches!(clause.verb, Verb::Age(_) | Verb::Kind(_) | Verb::Pace(_))
}

fn divide(group: &mut [Clause]) {
    let count = group.len() as f64;
    let all: Vec<Parts> = group.iter().map(|clause| clause.parts.clone()).collect();
    for clause in group.iter_mut() {
        let parts = all.iter().fold(clause.parts.clone(), |own, other| own.with_rest_of(other));
        let chance =
            parts.chance.as_ref().map_or(Chance { chance: HabitChance::ALWAYS, is_rate: false }, |slot| slot.value);
        let probability = chance.chance.probability / count;
        let shared = HabitChance { quantifier: None, probability, becomes: None, days_a_week: None };
        let chance = Slot { value: Chance { chance: shared, ..chance }, span: clause.verb_span, own: true };
        clause.parts = Parts { chance: Some(chance), ..parts };
    }
}
