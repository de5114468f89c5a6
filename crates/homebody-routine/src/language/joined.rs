//! Clauses joined by "and" or "or": what each takes over from the others.
//!
//! Days, how often and from when on hold for all of them. Of what is joined by "and", a part of the day holds for all that say
//! no other; a time of day is that of the first, and the next come after it. What is joined by "or" shares everything, and each
//! is done on its share of the days.

use super::adverbs::{Adverbs, Slot};
use super::clause::{Clause, Join};
use super::predicates::Predicate;
use crate::routine::{Activity, Chance, When};

/// Lets each clause of a group have what the others say for all.
pub fn share(group: &mut [Clause], join: Option<Join>) {
    match join {
        // "She does not read or knit": neither is done.
        Some(Join::Or) if group.iter().all(|clause| matches!(clause.predicate, Predicate::Not(_))) => take_over(group),
        Some(Join::Or) => divide(group),
        Some(Join::And) => take_over(group),
        Some(Join::Then) | None => {}
    }
}

fn take_over(group: &mut [Clause]) {
    let Some((last, earlier)) = group.split_last_mut() else { return };
    // "She washes and dresses at 07:30": the time behind the last is about all before it that say none.
    for clause in earlier
        .iter_mut()
        .filter(|clause| !says_time(&clause.adverbs) && is_lived(clause) && clause.subject == last.subject)
    {
        clause.adverbs = days(clause.adverbs.clone(), &last.adverbs);
        clause.adverbs.part = last.adverbs.part.clone();
        let Some(when) = last.adverbs.when.clone() else { continue };
        if last.predicate == Predicate::Does(Activity::GoToBed) {
            clause.adverbs.when = Some(Slot { value: When::Before(Activity::GoToBed, None), ..when });
        } else {
            clause.adverbs.when = last.adverbs.when.replace(Slot { value: When::Then, ..when });
        }
    }
    for at in 1..group.len() {
        let (before, here) = group.split_at_mut(at);
        let (first, here) = (&before[0], &mut here[0]);
        if !is_lived(here) {
            continue;
        }
        here.adverbs = days(here.adverbs.clone(), &first.adverbs);
        if !says_time(&here.adverbs) && here.subject == first.subject {
            match &first.adverbs.when {
                Some(when) => here.adverbs.when = Some(Slot { value: When::Then, ..when.clone() }),
                None => here.adverbs.part = first.adverbs.part.clone(),
            }
        }
    }
}

fn divide(group: &mut [Clause]) {
    let count = group.len() as f64;
    let all: Vec<Adverbs> = group.iter().map(|clause| clause.adverbs.clone()).collect();
    for clause in group.iter_mut() {
        let span = clause.predicate_span;
        clause.adverbs = all.iter().fold(clause.adverbs.clone(), |own, other| own.under(other));
        let chance = clause.adverbs.chance.as_ref().map_or(Chance::ALWAYS, |slot| slot.value);
        let chance = match clause.tends && clause.adverbs.chance.is_none() {
            true => Chance::of(crate::fuzzy::Quantifier::Most),
            false => chance,
        };
        let value =
            Chance { quantifier: None, probability: chance.probability / count, becomes: None, days_a_week: None };
        clause.adverbs.chance = Some(Slot { value, span, own: true });
    }
}

/// Whether a clause says something that has its time, and not who somebody is.
fn is_lived(clause: &Clause) -> bool {
    !matches!(clause.predicate, Predicate::Remark | Predicate::Age(_) | Predicate::Kind(_) | Predicate::Pace(_))
}

/// Whether a clause says at what time, or how long.
fn says_time(adverbs: &Adverbs) -> bool {
    adverbs.when.is_some() || adverbs.part.is_some() || adverbs.until_time.is_some() || adverbs.times.is_some()
}

/// What these say with the days, how often, and the phase of others, where they say none.
fn days(own: Adverbs, others: &Adverbs) -> Adverbs {
    let time = (own.when.clone(), own.part.clone(), own.lasts.clone(), own.until_time.clone(), own.times.clone());
    let (when, part, lasts, until_time, times) = time;
    Adverbs { when, part, lasts, until_time, times, ..own.under(others) }
}
