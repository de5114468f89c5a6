//! The outcome of each sentence: how often it was planned, begun and done, how late, and how long.

use super::agenda::Agenda;
use super::item::Item;
use super::resident_routine::SentenceId;
use crate::routine::Activity;
use homebody_core::time::{MINUTE, RunTime, Span};
use std::collections::BTreeMap;

/// Delay within which an activity is in time (our choice): the previous one is finished first, and a walk follows.
pub const LATE: Span = MINUTE.times(15);

#[derive(Clone, Debug, Default, PartialEq)]
pub struct SentenceTally {
    sentences: BTreeMap<SentenceId, SentenceOutcome>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SentenceOutcome {
    /// Planned times on past days; for a rule, how often its trigger lasted long enough; for a change, the days with it.
    pub planned: u32,
    pub begun: u32,
    pub done: u32,
    /// Dropped without a route to the place.
    pub no_way: u32,
    /// Of all begun: planned seconds, and actual seconds from beginning to end.
    pub planned_s: f64,
    pub lasted_s: f64,
    /// Begun more than [`LATE`] after their time.
    pub late: u32,
}

impl SentenceTally {
    /// All 0 for a sentence without an occasion.
    pub fn outcome(&self, sentence: SentenceId) -> SentenceOutcome {
        self.sentences.get(&sentence).copied().unwrap_or_default()
    }

    /// Counts the plan of a past day from this item on. Coming home is the end of an outing and counts with it.
    pub(super) fn plan(&mut self, agenda: &Agenda, first: usize) {
        agenda.items.iter().skip(first).chain(&agenda.breaks).for_each(|item| self.plan_item(item));
    }

    /// Counts an item that leaves the plan before the day is over.
    pub(super) fn plan_item(&mut self, item: &Item) {
        let of = item.of.filter(|_| item.activity != Activity::ComeHome);
        of.into_iter().chain(item.home).for_each(|of| self.count(Some(of), |lived| lived.planned += 1));
    }

    pub(super) fn begin(&mut self, item: &Item, now: RunTime) {
        let until_s = item.until.map(|until| (until - now).max(Span::ZERO).seconds());
        self.count(item.of, |lived| {
            lived.begun += 1;
            lived.planned_s += until_s.unwrap_or(item.lasts.seconds());
            // The stated time counts, even if something else moved the start. A visitor who was let in came in time.
            let due = if item.stated_by > RunTime::MIN { item.stated_by } else { item.start };
            lived.late += u32::from(!item.is_let_in && now - due > LATE);
        });
        // An outing ends when the sentence says so, unless it begins later than that.
        let is_late = item.until.is_some_and(|home| now - home > LATE);
        self.count(item.home, |lived| {
            lived.begun += 1;
            lived.late += u32::from(is_late);
        });
    }

    pub(super) fn end(&mut self, of: Option<SentenceId>, lasted: Span) {
        self.count(of, |lived| {
            lived.done += 1;
            lived.lasted_s += lasted.seconds();
        });
    }

    pub(super) fn no_way(&mut self, of: Option<SentenceId>) {
        self.count(of, |lived| lived.no_way += 1);
    }

    /// Counts a due rule, or a day with a change.
    pub(super) fn hold(&mut self, of: SentenceId) {
        self.count(Some(of), |lived| lived.planned += 1);
    }

    fn count(&mut self, of: Option<SentenceId>, count: impl FnOnce(&mut SentenceOutcome)) {
        if let Some(of) = of {
            count(self.sentences.entry(of).or_default());
        }
    }
}
