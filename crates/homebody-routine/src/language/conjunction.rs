//! Clauses joined by "and" or "or": what each takes over from the others.
//!
//! Days, how often and from when on hold for all of them. Of what is joined by "and", a part of the day holds for all that say
//! no other; a time of day is that of the first, and the next come after it. What is joined by "or" shares everything, and each
//! is done on its share of the days.

use super::adverbs::{Adverbs, Slot};
use super::clause::{Clause, ClauseJoin};
use super::predicate::Predicate;
use super::words::TextSpan;
use crate::routine::{Activity, HabitChance, HabitTime, PartOfDay};

pub fn share(group: &mut [Clause], join: Option<ClauseJoin>) -> Option<TextSpan> {
    match join {
        // "She does not read or knit": neither is done.
        Some(ClauseJoin::Or) if group.iter().all(|clause| matches!(clause.predicate, Predicate::Not(_))) => {
            take_over(group)
        }
        Some(ClauseJoin::Or) => {
            divide(group);
            None
        }
        Some(ClauseJoin::And) => take_over(group),
        Some(ClauseJoin::Then) | None => None,
    }
}

fn is_at_night(group: &[Clause]) -> bool {
    let [first, then, ..] = group else { return false };
    let rises = first.predicate == Predicate::Does(Activity::GetUp);
    let at_night = first.adverbs.part.as_ref().is_some_and(|part| part.value == PartOfDay::Night);
    rises && (at_night || then.predicate == Predicate::Does(Activity::LieAwake))
}

pub fn without_waking(group: &mut Vec<Clause>) {
    if !is_at_night(group) {
        return;
    }
    let woken = group.remove(0);
    if let Some(next) = group.first_mut() {
        let own = next.adverbs.clone();
        next.adverbs = Adverbs { when: own.when.clone().or(woken.adverbs.when.clone()), ..own.under(&woken.adverbs) };
        next.span = woken.span.to(next.span);
    }
}

/// "Four times a day: at 7:30, 12:30, 16:30 and 20:00" is once at each of these times, "twice: morning and evening" once in each.
pub fn without_count(group: &mut [Clause]) {
    let count = group.len() as u32;
    let has_time = |when: &HabitTime| {
        matches!(when, HabitTime::At(_) | HabitTime::Before(..) | HabitTime::After(..) | HabitTime::With(_))
    };
    let is_then = |clause: &Clause| match &clause.adverbs.when {
        Some(slot) => has_time(&slot.value),
        None => clause.adverbs.part.is_some(),
    };
    // "Twice in the morning and twice in the evening" says it of each.
    let said = |clause: &Clause| clause.adverbs.times.as_ref().map(|times| times.span);
    let once = |clause: &Clause| clause.again && said(clause) == said(&group[0]);
    let is_list = count > 1 && group.iter().all(is_then) && group[1..].iter().all(once);
    for clause in group.iter_mut().filter(|_| is_list) {
        clause.adverbs.times.take_if(|times| times.value == (count, count));
    }
}

fn take_over(group: &mut [Clause]) -> Option<TextSpan> {
    let (last, earlier) = group.split_last_mut()?;
    // "She reads in the morning and in the evening for 20 minutes": so long each time.
    for clause in earlier.iter_mut().filter(|clause| last.again && clause.predicate == last.predicate) {
        clause.adverbs.lasts = clause.adverbs.lasts.take().or(last.adverbs.lasts.clone());
    }
    // "She washes and dresses at 07:30": the time behind the last is about all before it that say none.
    for clause in earlier.iter_mut().filter(|clause| is_lived(clause) && clause.subject == last.subject) {
        let behind = behind_verb(last);
        if !says_days(&clause.adverbs) && says_days(&behind) {
            // "She reads at 10:00 and naps on Sunday" leaves open what is on Sunday.
            let only_often = Adverbs { chance: None, ..behind.clone() };
            if says_time(&clause.adverbs) && !says_days(&only_often) {
                // "Takes a tablet in the morning and goes out often": often is about going out.
                continue;
            }
            if says_time(&clause.adverbs) && !says_time(&behind) {
                return days_span(&behind);
            }
            clause.adverbs = days(clause.adverbs.clone(), &behind);
        }
        if says_time(&clause.adverbs) {
            continue;
        }
        if last.predicate == Predicate::Does(Activity::ComeHome) {
            continue;
        }
        clause.adverbs.part = behind.part.clone();
        let Some(when) = behind.when.clone() else { continue };
        if last.predicate == Predicate::Does(Activity::GoToBed) {
            clause.adverbs.when = Some(Slot { value: HabitTime::Before(Activity::GoToBed, None), ..when });
        } else {
            clause.adverbs.when = last.adverbs.when.replace(Slot { value: HabitTime::Then, ..when });
        }
    }
    for at in 1..group.len() {
        let (before, here) = group.split_at_mut(at);
        let (Some(first), [here, ..]) = (before.first(), here) else { continue };
        if !is_lived(here) || !is_lived(first) {
            continue;
        }
        // "She goes to church on Sunday and reads" does, too.
        let behind = behind_verb(first);
        let goes_on = here.predicate == Predicate::Does(Activity::ComeHome) || says_days(&here.adverbs) || here.again;
        if says_days(&behind) && !goes_on && here.subject == first.subject {
            return days_span(&behind);
        }
        here.adverbs = days(here.adverbs.clone(), &first.adverbs);
        if !says_time(&here.adverbs) && here.subject == first.subject {
            match &first.adverbs.when {
                Some(when) => here.adverbs.when = Some(Slot { value: HabitTime::Then, ..when.clone() }),
                None => here.adverbs.part = first.adverbs.part.clone(),
            }
        }
    }
    None
}

fn behind_verb(clause: &Clause) -> Adverbs {
    fn behind<T: Clone>(slot: &Option<Slot<T>>, verb: TextSpan) -> Option<Slot<T>> {
        slot.clone().filter(|slot| slot.span.start >= verb.end)
    }
    let (verb, said) = (clause.predicate_span, &clause.adverbs);
    Adverbs {
        chance: behind(&said.chance, verb),
        weekdays: behind(&said.weekdays, verb),
        months: behind(&said.months, verb),
        every: behind(&said.every, verb),
        of_month: behind(&said.of_month, verb),
        kind: behind(&said.kind, verb),
        part: behind(&said.part, verb),
        when: behind(&said.when, verb),
        until_time: behind(&said.until_time, verb),
        from: behind(&said.from, verb),
        until: behind(&said.until, verb),
        ..Adverbs::default()
    }
}

fn says_days(adverbs: &Adverbs) -> bool {
    days_span(adverbs).is_some()
}

pub fn days_span(adverbs: &Adverbs) -> Option<TextSpan> {
    let spans = [
        adverbs.weekdays.as_ref().map(|slot| slot.span),
        adverbs.chance.as_ref().map(|slot| slot.span),
        adverbs.months.as_ref().map(|slot| slot.span),
        adverbs.every.as_ref().map(|slot| slot.span),
        adverbs.of_month.as_ref().map(|slot| slot.span),
        adverbs.kind.as_ref().map(|slot| slot.span),
        adverbs.from.as_ref().map(|slot| slot.span),
        adverbs.until.as_ref().map(|slot| slot.span),
    ];
    spans.into_iter().flatten().next()
}

fn divide(group: &mut [Clause]) {
    let count = group.len() as f64;
    let all: Vec<Adverbs> = group.iter().map(|clause| clause.adverbs.clone()).collect();
    for clause in group.iter_mut() {
        let span = clause.predicate_span;
        clause.adverbs = all.iter().fold(clause.adverbs.clone(), |own, other| own.under(other));
        let chance = clause.adverbs.chance.as_ref().map_or(HabitChance::ALWAYS, |slot| slot.value);
        let chance = match clause.tends && clause.adverbs.chance.is_none() {
            true => HabitChance::from_quantifier(homebody_core::fuzzy::Quantifier::Most),
            false => chance,
        };
        let value =
            HabitChance { quantifier: None, probability: chance.probability / count, becomes: None, days_a_week: None };
        clause.adverbs.chance = Some(Slot { value, span, own: true });
    }
}

fn is_lived(clause: &Clause) -> bool {
    !matches!(clause.predicate, Predicate::Remark | Predicate::Age(_) | Predicate::Kind(_) | Predicate::Pace(_))
}

fn says_time(adverbs: &Adverbs) -> bool {
    adverbs.when.is_some() || adverbs.part.is_some() || adverbs.until_time.is_some() || adverbs.times.is_some()
}

fn days(own: Adverbs, others: &Adverbs) -> Adverbs {
    let time = (own.when.clone(), own.part.clone(), own.lasts.clone(), own.until_time.clone(), own.times.clone());
    let (when, part, lasts, until_time, times) = time;
    let (says_days, chance) =
        (own.weekdays.is_some() || own.every.is_some() || own.of_month.is_some(), own.chance.clone());
    let merged = own.under(others);
    // "Most days a wash, on Sunday a bath": on all Sundays.
    let own = Adverbs { chance: if says_days { chance } else { merged.chance.clone() }, ..merged };
    Adverbs { when, part, lasts, until_time, times, ..own }
}
