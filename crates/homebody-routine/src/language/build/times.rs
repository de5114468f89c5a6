//! Times of day: open ones are decided by the rest of the sentence.

use crate::language::amounts::DAY_S;
use crate::language::builder::Builder;
use crate::language::clock::{both_halves, half_of_activity, half_of_part};
use crate::language::messages::TimeSentenceMessage;
use crate::language::parts::{Parts, Said, Slot, TimeOfDay};
use crate::language::times::{HOUR_S, is_of_next_day};
use crate::routine::{Activity, HabitTime, PartOfDay};
use homebody_core::fuzzy::Fuzzy;

impl Builder<'_> {
    /// The seconds since midnight of a time; an open one is decided by the part of the day, or by what is done.
    fn seconds(&mut self, time: TimeOfDay, parts: &Parts, doing: &Activity) -> Fuzzy {
        let clock = time.clock;
        let hour = (clock.s / HOUR_S).floor();
        let by_part = || match parts.part.as_ref()?.value[..] {
            [part] => half_of_part(part, hour),
            _ => None,
        };
        let late =
            if clock.open { by_part().or_else(|| half_of_activity(doing, clock.s / HOUR_S)) } else { Some(false) };
        if late.is_none() {
            let text = self.said(clock.span);
            let help = both_halves(&text, hour, clock.s % HOUR_S == 0.0);
            self.fault(clock.span, TimeSentenceMessage::AmbiguousTime { text, help });
        }
        let s = clock.s + if late == Some(true) { DAY_S / 2.0 } else { 0.0 };
        Fuzzy::around(s, time.spread_s)
    }

    /// When, and until when, with times after midnight counted on where they belong to the night before.
    pub(in crate::language) fn time(
        &mut self,
        when: Option<&Said>,
        parts: &Parts,
        doing: &Activity,
    ) -> (HabitTime, Option<Fuzzy>) {
        /// Time before the given hour within which a person who gets up by then does so (our choice).
        const BY_S: f64 = 1_800.0;
        let at_night = parts.part.as_ref().is_some_and(|slot| slot.value == [PartOfDay::Night]);
        let is_bed = *doing == Activity::GoToBed;
        let on_its_day = |at: Fuzzy| {
            let next = at_night && at.from < 9.0 * HOUR_S || is_bed && at.from < 6.0 * HOUR_S;
            if next { at.map(|at| at + DAY_S) } else { at }
        };
        let (mut when, mut until) = match when {
            None => match parts.part.as_ref().and_then(|slot| slot.value.first()) {
                Some(part) => (HabitTime::Within(*part), None),
                None => (HabitTime::AnyTime, None),
            },
            Some(Said::At(time)) => (HabitTime::At(on_its_day(self.seconds(*time, parts, doing))), None),
            Some(Said::By(time)) => {
                let at = on_its_day(self.seconds(*time, parts, doing)).from;
                (HabitTime::At(Fuzzy::between(at - BY_S, at)), None)
            }
            Some(Said::Between(from, to)) => {
                let first = on_its_day(self.seconds(*from, parts, doing)).from;
                let last = self.end(*to, first, parts, doing).from;
                (HabitTime::At(Fuzzy::between(first, last)), None)
            }
            Some(Said::FromTo(from, to)) => {
                let first = on_its_day(self.seconds(*from, parts, doing));
                let last = self.end(*to, first.from, parts, doing);
                (HabitTime::At(first), Some(last))
            }
            Some(Said::Within(part)) => (HabitTime::Within(*part), None),
            Some(Said::After(activity, gap)) => (HabitTime::After(activity.clone(), *gap), None),
            Some(Said::Before(activity, gap)) => (HabitTime::Before(activity.clone(), *gap), None),
            Some(Said::With(activity)) => (HabitTime::With(activity.clone()), None),
            Some(Said::Then) => (HabitTime::Then, None),
        };
        if let Some(Slot { value: Said::At(time), span, .. }) = &parts.until {
            let begin = match &when {
                HabitTime::At(at) => Some(at.from),
                _ => None,
            };
            let mut end = match begin {
                Some(begin) => self.end(*time, begin, parts, doing),
                None => self.seconds(*time, parts, doing),
            };
            if begin.is_some_and(|begin| is_of_next_day(end.from, begin)) {
                end = end.map(|end| end + DAY_S);
            }
            if begin.is_some_and(|begin| end.from <= begin) {
                let text = self.said(*span);
                self.fault(*span, TimeSentenceMessage::EndBeforeBegin { text });
            }
            until = Some(end);
        }
        if let HabitTime::At(at) = &mut when {
            *at = Fuzzy { ..*at };
        }
        (when, until)
    }

    /// The end of a stretch: an open one is the first time after its beginning.
    fn end(&mut self, to: TimeOfDay, begin: f64, parts: &Parts, doing: &Activity) -> Fuzzy {
        if to.clock.open {
            return Fuzzy::around(next_open(begin, to.clock.s), to.spread_s);
        }
        let end = self.seconds(to, parts, doing);
        if begin >= DAY_S && end.from < begin { end.map(|end| end + DAY_S) } else { end }
    }

    pub(super) fn check_times(&mut self, parts: &Parts, when: &HabitTime) {
        if let (Some(part), HabitTime::At(at)) = (parts.part.as_ref().filter(|part| part.own), when)
            && let [one] = part.value[..]
        {
            let (from, to) = match one {
                PartOfDay::Morning => (3.0, 12.5),
                PartOfDay::Noon => (11.0, 14.5),
                PartOfDay::Afternoon => (11.5, 18.5),
                PartOfDay::Evening => (16.0, 24.0),
                PartOfDay::Night => (19.0, 33.0),
                PartOfDay::Day => (5.0, 22.0),
            };
            if at.to < from * HOUR_S || at.from > to * HOUR_S {
                let time = parts.when.as_ref().map_or(part.span, |slot| slot.span);
                let (text, part_text) = (self.said(time), self.said(part.span));
                self.fault(time, TimeSentenceMessage::PartOfDay { text, part: one.word().to_string(), part_text });
            }
        }
        // "While she watches television in the evening" says both.
        let follows =
            matches!(when, HabitTime::After(..) | HabitTime::Before(..) | HabitTime::With(_) | HabitTime::Then);
        if let (Some(part), Some(said), true) = (&parts.part, &parts.when, follows)
            && part.own
            && said.own
        {
            let (text, first) = (self.said(said.span), self.said(part.span));
            let meaning = "both say at which time".to_owned();
            self.fault(said.span, TimeSentenceMessage::Twice { text, first, meaning });
        }
        if let (Some(lasts), Some(until)) = (&parts.lasts, &parts.until) {
            let (text, other) = (self.said(lasts.span), self.said(until.span));
            self.fault(until.span, TimeSentenceMessage::TwoEnds { text, other });
        }
    }
}

fn next_open(begin: f64, open: f64) -> f64 {
    let half = DAY_S / 2.0;
    begin + (open - begin).rem_euclid(half)
}

/// The parts with one time each.
pub(super) fn spread(parts: &Parts) -> Vec<(Option<Said>, Parts)> {
    if let Some(slot) = &parts.when {
        return slot.value.iter().map(|when| (Some(when.clone()), parts.clone())).collect();
    }
    match &parts.part {
        Some(slot) => slot
            .value
            .iter()
            .map(|part| (None, Parts { part: Some(Slot { value: vec![*part], ..slot.clone() }), ..parts.clone() }))
            .collect(),
        None => vec![(None, parts.clone())],
    }
}
