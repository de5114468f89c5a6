//! What came of each sentence of a life: how often it was planned, begun and done, how late, and for how long.

use super::agenda::Agenda;
use super::item::Item;
use super::life::SentenceId;
use homebody_core::time::{Micros, SECOND, seconds};
use std::collections::BTreeMap;

/// Delay within which an activity is in time (our choice): the previous one is finished first, and a walk follows.
pub const LATE: Micros = 15 * 60 * SECOND;

/// What has been lived of a life so far, sentence by sentence.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    sentences: BTreeMap<SentenceId, Lived>,
}

/// What came of one sentence.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lived {
    /// How often it was to be done on the days that are over; of a rule, how often what it waits for had lasted; of a change, on how many days it held.
    pub planned: u32,
    pub begun: u32,
    /// Begun and brought to its end.
    pub done: u32,
    /// Left out as there was no way to where it is done.
    pub no_way: u32,
    /// How long it was to take, of all that were begun, and how long it took, from its beginning to its end.
    pub planned_s: f64,
    pub lasted_s: f64,
    /// How many were begun more than [`LATE`] after their time.
    pub late: u32,
}

impl Tally {
    /// What came of a sentence; all is 0 of what never came up.
    pub fn of(&self, sentence: SentenceId) -> Lived {
        self.sentences.get(&sentence).copied().unwrap_or_default()
    }

    /// The plan of a day that is over, from this item on.
    pub(super) fn plan(&mut self, agenda: &Agenda, first: usize) {
        for item in agenda.items.iter().skip(first).chain(&agenda.breaks) {
            self.count(item.of, |lived| lived.planned += 1);
        }
    }

    pub(super) fn begin(&mut self, item: &Item, now: Micros) {
        let until_s = item.until.map(|until| seconds((until - now).max(0)));
        self.count(item.of, |lived| {
            lived.begun += 1;
            lived.planned_s += until_s.unwrap_or(seconds(item.lasts));
            lived.late += u32::from(now - item.start > LATE);
        });
    }

    pub(super) fn end(&mut self, of: Option<SentenceId>, lasted: Micros) {
        self.count(of, |lived| {
            lived.done += 1;
            lived.lasted_s += seconds(lasted);
        });
    }

    pub(super) fn no_way(&mut self, of: Option<SentenceId>) {
        self.count(of, |lived| lived.no_way += 1);
    }

    /// A rule is due, or a change holds for a day.
    pub(super) fn hold(&mut self, of: SentenceId) {
        self.count(Some(of), |lived| lived.planned += 1);
    }

    fn count(&mut self, of: Option<SentenceId>, count: impl FnOnce(&mut Lived)) {
        if let Some(of) = of {
            count(self.sentences.entry(of).or_default());
        }
    }
}
