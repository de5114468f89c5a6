//! The outcome of each sentence: how often it was planned, begun and done, how late, and how long.

use super::agenda::Agenda;
use super::item::Item;
use super::resident_routine::SentenceId;
use crate::routine::Activity;
use homebody_core::time::{DAY, Interval, MINUTE, RunTime, Span};
use std::collections::BTreeMap;

/// Delay within which an activity is in time (our choice): the previous one is finished first, and a walk follows.
pub const LATE: Span = MINUTE.times(15);

#[derive(Clone, Debug, Default, PartialEq)]
pub struct SentenceTally {
    sentences: BTreeMap<SentenceId, SentenceOutcome>,
    /// Planned activities that have begun, with their start, and those of the last day that are over.
    begun: Vec<(SentenceId, RunTime)>,
    over: Vec<(SentenceId, Interval<RunTime>)>,
}

#[derive(Clone, Debug, Default, PartialEq)]
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
    /// Of all begun: seconds from their drawn time to their beginning, if that is later.
    pub late_s: f64,
    /// The planned activities that took the time of those that were late or left out, with their ends.
    pub takers: BTreeMap<SentenceId, Vec<RunTime>>,
}

impl SentenceTally {
    /// All 0 for a sentence without an occasion.
    pub fn outcome(&self, sentence: SentenceId) -> SentenceOutcome {
        self.sentences.get(&sentence).cloned().unwrap_or_default()
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
        });
        // A visitor who was let in came in time.
        let since = |due: RunTime| if item.is_let_in { Span::ZERO } else { (now - due).max(Span::ZERO) };
        self.count(item.of, |lived| lived.late_s += since(item.due().min(item.start)).seconds());
        if since(item.due()) > LATE {
            self.count(item.of, |lived| lived.late += 1);
            self.count_taker(item, now);
        }
        // Nothing is begun in bed before the day is over.
        self.begun.extend(item.of.filter(|_| item.activity != Activity::GoToBed).map(|of| (of, now)));
        // An outing ends when the sentence says so, unless it begins later than that.
        let is_late = item.until.is_some_and(|home| now - home > LATE);
        self.count(item.home, |lived| {
            lived.begun += 1;
            lived.late += u32::from(is_late);
        });
    }

    /// Counts what took the time of an item that is left out.
    pub(super) fn leave_out(&mut self, item: &Item, now: RunTime) {
        self.count_taker(item, now);
    }

    /// The activity with the largest part of the time since an item was due.
    fn count_taker(&mut self, item: &Item, now: RunTime) {
        let since = Interval::new(item.due(), now.max(item.due()));
        let begun = self.begun.iter().map(|(of, begin)| (*of, Interval::new(*begin, now)));
        let others = self.over.iter().copied().chain(begun).filter(|(of, _)| Some(*of) != item.of);
        let longest = others.max_by_key(|(_, time)| time.overlap(since));
        let Some((of, time)) = longest.filter(|(_, time)| time.overlap(since) > Span::ZERO) else { return };
        self.count(item.of, |lived| lived.takers.entry(of).or_default().push(time.end));
    }

    /// Ends an activity that lasted so long, now.
    pub(super) fn end(&mut self, of: Option<SentenceId>, lasted: Span, now: RunTime) {
        if let Some(begun) = self.begun.iter().rposition(|(other, _)| Some(*other) == of) {
            let (of, begin) = self.begun.remove(begun);
            self.over.retain(|(_, time)| time.end > now - DAY);
            self.over.push((of, Interval::new(begin, now)));
        }
        self.count(of, |lived| {
            lived.done += 1;
            lived.lasted_s += lasted.seconds();
        });
    }

    pub(super) fn no_way(&mut self, of: Option<SentenceId>) {
        self.begun.retain(|(other, _)| Some(*other) != of);
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
