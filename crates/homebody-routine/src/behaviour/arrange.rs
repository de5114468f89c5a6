//! The order of a day: one meal after the other, and activities without a time of their own in free time.

use super::drafts::{SOON_DONE, TO_AND_FRO};
use super::item::Item;
use crate::routine::{Activity, Meal};
use homebody_core::time::{Interval, RunTime, Span};

/// A late breakfast delays lunch.
pub(super) fn one_meal_after_the_other(items: &mut [Item]) {
    let mut over = RunTime::MIN;
    for meal in Meal::ALL {
        let is_of = |item: &&mut Item| {
            item.visitor.is_none() && [Activity::Prepare(meal), Activity::Eat(meal)].contains(&item.activity)
        };
        let of_meal: Vec<&mut Item> = items.iter_mut().filter(is_of).collect();
        let Some(begin) = of_meal.iter().map(|item| item.start).min() else { continue };
        let by = over.saturating_since(begin).max(Span::ZERO);
        for item in of_meal {
            (item.start, item.latest, item.waits) = (item.start + by, item.latest + by, item.waits || by > Span::ZERO);
            over = over.max(item.start + item.lasts);
        }
    }
}

/// Spreads activities with a number per day over the time at home. Those that a long outing displaced follow it.
pub(super) fn count_at_home(breaks: &mut [Item], items: &[Item], up: RunTime, bed: RunTime) {
    let outings = items.iter().filter(|item| item.activity == Activity::Leave && item.visitor.is_none());
    let outings = outings.map(|item| Interval::new(item.start, item.until.unwrap_or(item.start + item.lasts)));
    let mut away: Vec<Interval<RunTime>> = Vec::new();
    for outing in outings {
        let over = away.last().map_or(up, |before| before.end);
        away.extend(Some(outing.intersection(Interval::new(over, bed))).filter(|outing| !outing.is_empty()));
    }
    let awake = Interval::new(up, bed);
    for item in breaks.iter_mut().filter(|item| item.is_counted && awake.contains(item.start)) {
        let span = item.open.map_or(awake, |open| open.intersection(awake));
        let away: Vec<_> = away.iter().map(|outing| outing.intersection(span)).filter(|one| !one.is_empty()).collect();
        let at_home = span.length() - away.iter().map(|outing| outing.length()).sum::<Span>();
        let share = at_home.ratio(span.length().max(Span::MICROSECOND));
        let mut start = span.begin + (item.start - span.begin).share(share);
        for outing in &away {
            start += if start >= outing.begin { outing.length() } else { Span::ZERO };
        }
        (item.start, item.latest) = (start, span.end);
    }
}

/// Moves each activity that a sentence gives a part of the day to the nearest free time of that part. Without one, it
/// keeps its time.
pub(super) fn into_free_time(items: &mut [Item]) {
    let time_of = |item: &Item| Interval::new(item.start, item.until.unwrap_or(item.start + item.lasts));
    let is_firm = |item: &&Item| {
        !item.waits && item.open.is_none() && (item.has_its_time || item.is_essential() || item.visitor.is_some())
    };
    let mut busy: Vec<Interval<RunTime>> = items.iter().filter(is_firm).map(time_of).collect();
    for item in items.iter_mut().filter(|item| !item.is_unsaid && item.lasts > SOON_DONE) {
        let Some(open) = item.open else { continue };
        let time = time_of(item);
        let length = time.length();
        let is_free = |start: &RunTime| {
            let around = Interval::new(*start - TO_AND_FRO, *start + length + TO_AND_FRO);
            busy.iter().all(|other| other.overlap(around) == Span::ZERO)
        };
        let beside = busy.iter().flat_map(|other| [other.begin - length - TO_AND_FRO, other.end + TO_AND_FRO]);
        let starts = std::iter::once(time.begin).chain(beside.filter(|start| open.contains(*start)));
        let start = starts.filter(is_free).min_by_key(|start| (*start - time.begin).abs()).unwrap_or(time.begin);
        (item.latest, item.start) = (item.latest + (start - time.begin), start);
        busy.push(Interval::new(start, start + length));
    }
}
