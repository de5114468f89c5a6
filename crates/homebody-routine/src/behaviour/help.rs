//! The work of visitors: instead of their host, as cooking and cleaning, or together, as washing.

use super::defaults;
use super::drafts::WELCOMED;
use super::item::Item;
use super::resident_routine::ResidentRoutine;
use crate::routine::{Activity, Meal};
use homebody_core::activity::{ActivityKind, Help, UsualLength};
use homebody_core::numbers::Numbers;
use homebody_core::time::{HOUR, MINUTE, RunTime, Span};
use std::collections::VecDeque;

/// Time that a visitor who works until the end of the visit needs to put things away (our choice).
pub(super) const PUTTING_AWAY: Span = MINUTE.times(5);

/// Time between the last dish and the meal of the host (our choice).
const SERVED: Span = MINUTE.times(3);

/// Longest time that a meal from a visitor waits for a person without a stated time to eat (our choice).
const KEEPS_WARM: Span = MINUTE.times(15);

/// Longest time after its plan at which help begins (our choice).
const LATEST: Span = HOUR;

/// The work of a visitor.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct VisitorWork {
    pub(super) activity: Activity,
    pub(super) start: RunTime,
    pub(super) lasts: Span,
    /// Whether the host does it, and the visitor stands by.
    pub(super) is_help: bool,
    /// Whether the visitor has found the host at it.
    pub(super) has_begun: bool,
}

impl Activity {
    /// Whether the host does it, with a visitor's help, as opposed to the visitor alone.
    fn is_done_together(&self) -> bool {
        let row = self.row();
        row.is_some_and(|row| row.kind == ActivityKind::Care || row.help == Some(Help::Together))
    }
}

fn usual_length(activity: &Activity, numbers: &Numbers) -> Span {
    let UsualLength { median_min, .. } = defaults::length(activity, numbers);
    Span::from_seconds(median_min * 60.0)
}

/// Takes from the host's plan what a visitor does instead, and adds what they do together.
pub(super) fn share(items: &mut Vec<Item>, breaks: &mut Vec<Item>, numbers: &Numbers) {
    let visits: Vec<Item> = items.iter().filter(|item| !item.does.is_empty()).cloned().collect();
    for visit in visits {
        for activity in visit.does.iter().filter(|activity| **activity != Activity::GetUp) {
            if !activity.is_done_together() {
                items.retain(|item| item.visitor.is_some() || item.activity != *activity);
                if let Activity::Prepare(meal) = activity {
                    let ready = visit.start + WELCOMED + usual_length(activity, numbers) + SERVED;
                    eat_what_comes(items, *meal, &visit, ready);
                }
                continue;
            }
            // The host's own wash is this one.
            let is_own = |item: &Item| item.activity == *activity && item.is_unsaid && item.visitor.is_none();
            items.retain(|item| !is_own(item));
            let start = visit.start + WELCOMED;
            let key = format!("{}/{}", visit.key, activity.label());
            let item = Item::now(key, activity.clone(), usual_length(activity, numbers));
            breaks.push(Item { start, latest: start + LATEST, has_its_time: true, is_unsaid: false, ..item });
        }
    }
}

/// A meal that a visitor brings or cooks is eaten when it is ready, and without a stated time soon after the visit.
fn eat_what_comes(items: &mut [Item], meal: Meal, visit: &Item, ready: RunTime) {
    let over = visit.until.unwrap_or(visit.start + visit.lasts);
    let is_own = |item: &&mut Item| item.visitor.is_none() && item.activity == Activity::Eat(meal);
    for item in items.iter_mut().filter(is_own) {
        let is_stated = item.of.is_some_and(|of| of.source != ResidentRoutine::UNSAID);
        let start = match is_stated {
            false if item.start > over + KEEPS_WARM => over,
            _ => item.start.max(ready.min(over)),
        };
        (item.latest, item.start) = (item.latest + (start - item.start).max(Span::ZERO), start);
        // As firm as the visit.
        item.waits = false;
    }
}

/// The work of a visit, by start.
pub(super) fn work(
    visit: &Item,
    until: RunTime,
    (items, breaks): (&[Item], &[Item]),
    numbers: &Numbers,
) -> VecDeque<VisitorWork> {
    let begin = visit.start + WELCOMED;
    let mut work: Vec<VisitorWork> = Vec::new();
    for activity in visit.does.iter().filter(|activity| !activity.is_done_together()) {
        let mut lasts = usual_length(activity, numbers);
        let mut start = begin;
        if let Activity::Prepare(meal) = activity {
            let eats = items.iter().find(|item| item.visitor.is_none() && item.activity == Activity::Eat(*meal));
            start = eats.map_or(begin, |eats| (eats.start - lasts - SERVED).max(begin));
        } else if *activity == Activity::Housework {
            // As long as there is time.
            lasts = until - begin;
        }
        work.push(VisitorWork { activity: activity.clone(), start, lasts, is_help: false, has_begun: false });
    }
    // Activities of the host with help are breaks of the plan.
    let is_of_visit = |item: &&Item| {
        let begins = [begin, begin - Span::MICROSECOND].contains(&item.start);
        begins && item.visitor.is_none() && item.activity.is_done_together()
    };
    work.extend(breaks.iter().filter(is_of_visit).map(|item| VisitorWork {
        activity: item.activity.clone(),
        start: item.start,
        lasts: item.lasts + LATEST / 2,
        is_help: true,
        has_begun: false,
    }));
    work.sort_by_key(|work| (work.start, !work.is_help));
    work.into()
}
