//! Priorities: activities with a time, then other stated ones, then unstated ones; and activities relative to others.

use super::driver::{GRACE, RoutineDriver};
use super::item::Item;
use super::resident_routine::SentenceId;
use crate::routine::Activity;
use homebody_core::time::{MINUTE, RunTime, Span};

impl RoutineDriver {
    /// Unstated activities wait if they would delay stated ones, and flexible ones if they would delay those with a time.
    /// No one goes out just before a meal.
    pub(super) fn prefer_stated(&mut self, now: RunTime) {
        let bed = self.agenda.bed;
        let (breaks, rest) = (&self.agenda.breaks[self.next_break..], &mut self.agenda.items[self.next_item..]);
        let Some(next) = rest.first().filter(|next| next.start <= now + MINUTE) else { return };
        let may_wait = next.visitor.is_none() && !next.has_its_time && !next.is_essential() && next.until.is_none();
        if !next.waits && !may_wait {
            return;
        }
        let (is_outing, gives_way) = (next.activity == Activity::Leave, next.activity.gives_way_to_meals());
        // With walks, it takes somewhat longer than planned.
        let end = now + next.lasts + if is_outing { 4 * MINUTE } else { 2 * MINUTE };
        let fits_after = |item: &Item| item.start + item.lasts + next.lasts < bed;
        let is_timed = |item: &Item| {
            item.has_its_time && item.follows.is_none() && !(gives_way && item.is_essential()) && fits_after(item)
        };
        let is_said = |item: &Item| {
            // Of overdue activities, only medicine counts.
            let is_due = item.start >= now - GRACE || item.activity == Activity::TakeMedicine && item.latest >= now;
            !item.waits && item.start < end && is_due && (next.waits || is_timed(item))
        };
        let is_meal = |item: &Item| is_outing && item.is_essential() && item.start < now + 2 * GRACE;
        let is_first = |item: &Item| is_said(item) || is_meal(item) && item.latest >= now;
        if let Some(said) = rest.iter().skip(1).position(is_first).map(|said| said + 1) {
            rest[0].latest = rest[0].latest.max(rest[said].latest);
            rest[..=said].rotate_right(1);
            return;
        }
        // After an outing it is too late for interruptions of that time.
        let timed = breaks.iter().find(|item| item.has_its_time && (now..end).contains(&item.start));
        if let Some(timed) = timed.filter(|timed| is_outing && (next.waits || fits_after(timed))) {
            rest[0].start = timed.start + timed.lasts;
            rest[0].latest = rest[0].latest.max(rest[0].start);
            rest.sort_by_key(|item| item.start);
        }
    }

    /// Starts a following activity the stated delay after the actual end.
    pub(super) fn let_follow(&mut self, over: Option<SentenceId>, now: RunTime) {
        let Some(over) = over else { return };
        let rest = &mut self.agenda.items[self.next_item..];
        let mut has_moved = false;
        for item in rest.iter_mut() {
            if let Some((_, gap)) = item.follows.take_if(|(of, _)| *of == over) {
                let by = now + gap - item.start;
                (item.start, item.latest) = (item.start + by, item.latest + by.max(Span::ZERO));
                has_moved = true;
            }
        }
        if has_moved {
            rest.sort_by_key(|item| item.start);
        }
    }
}
