//! The meaning of the adverbs of a sentence: days, a time of day, a phase.

use super::adverbs::{Adverbs, Slot};
use super::amounts::DAY_S;
use super::calendar;
use super::messages::TimeSentenceMessage;
use super::reader::SentenceReader;
use super::times;
use super::words::TextSpan;
use crate::routine::{DaySelection, HabitTime, PartOfDay, Phase, PhaseDay};
use homebody_core::fuzzy::Fuzzy;

impl Adverbs {
    pub fn under(mut self, heading: &Adverbs) -> Adverbs {
        fn or<T: Clone>(own: &mut Option<Slot<T>>, heading: &Option<Slot<T>>) {
            if own.is_none() {
                *own = heading.clone().map(|slot| Slot { own: false, ..slot });
            }
        }
        let says_part = self.part.is_some();
        if !says_part {
            or(&mut self.when, &heading.when);
        }
        or(&mut self.part, &heading.part);
        if self.weekdays.is_none() && self.every.is_none() {
            or(&mut self.every, &heading.every);
            or(&mut self.weekdays, &heading.weekdays);
        }
        or(&mut self.chance, &heading.chance);
        or(&mut self.months, &heading.months);
        or(&mut self.of_month, &heading.of_month);
        or(&mut self.kind, &heading.kind);
        or(&mut self.lasts, &heading.lasts);
        or(&mut self.until_time, &heading.until_time);
        or(&mut self.times, &heading.times);
        or(&mut self.from, &heading.from);
        if self.until.is_none() && self.for_days.is_none() {
            or(&mut self.until, &heading.until);
            or(&mut self.for_days, &heading.for_days);
        }
        or(&mut self.over, &heading.over);
        or(&mut self.fading, &heading.fading);
        self
    }

    pub fn days_meant(&self) -> DaySelection {
        DaySelection {
            weekdays: self.weekdays.as_ref().map_or(DaySelection::ALL.weekdays, |slot| slot.value),
            months: self.months.as_ref().map_or(DaySelection::ALL.months, |slot| slot.value),
            every: self.every_meant(),
            of_month: self.of_month.as_ref().map_or(DaySelection::ALL.of_month, |slot| slot.value),
            kind: self.kind.as_ref().map(|slot| slot.value),
        }
    }

    fn every_meant(&self) -> u32 {
        let every = self.every.as_ref().map_or(DaySelection::ALL.every, |slot| slot.value);
        let is_weekday = self.weekdays.as_ref().is_some_and(|slot| slot.value.count_ones() == 1);
        if is_weekday && every.is_multiple_of(7) && !every.is_multiple_of(49) { every / 7 } else { every }
    }

    /// At what time of the day, with times after midnight counted on where they belong to the night before.
    pub fn time_meant(&self, is_bedtime: bool) -> HabitTime {
        let at_night = self.part.as_ref().is_some_and(|slot| slot.value == PartOfDay::Night);
        let next_day = |at: &Fuzzy| (at_night && at.from < 9.0 * 3600.0) || (is_bedtime && at.from < 6.0 * 3600.0);
        match (&self.when, &self.part) {
            (Some(Slot { value: HabitTime::At(at), .. }), _) if next_day(at) => HabitTime::At(at.map(|at| at + DAY_S)),
            (Some(when), _) => when.value.clone(),
            (None, Some(part)) => HabitTime::Within(part.value),
            (None, None) => HabitTime::AnyTime,
        }
    }

    /// Until when: after midnight if it begins in the evening before.
    pub fn until_meant(&self, when: &HabitTime) -> Option<Fuzzy> {
        let until = self.until_time.as_ref()?.value;
        match when {
            HabitTime::At(at) if times::is_of_next_day(until.from, at.from) => Some(until.map(|until| until + DAY_S)),
            _ => Some(until),
        }
    }

    pub fn phase_meant(&self, reader: &mut SentenceReader, is_condition: bool) -> Phase {
        let from = self.from.as_ref().map(|slot| slot.value);
        if let (Some(over), None, false) = (&self.over, from, is_condition) {
            let help = "write \"From week 6, over 4 weeks, ...\"".to_owned();
            reader.fault(over.span, TimeSentenceMessage::NoBeginning { help });
        }
        let days = self.for_days.as_ref().map(|slot| slot.value as i32);
        if let (Some(until), Some(for_days)) = (&self.until, &self.for_days) {
            let (text, other) = (reader.said(until.span), reader.said(for_days.span));
            reader.fault(for_days.span, TimeSentenceMessage::TwoEnds { text, other });
        }
        if let (Some(for_days), None, true) = (&self.for_days, from, self.months.is_some() || self.of_month.is_some()) {
            let help = "write from which day, such as \"from 2026-07-01, for 14 days\"".to_owned();
            reader.fault(for_days.span, TimeSentenceMessage::NoBeginning { help });
        }
        let until = self.until.as_ref().map(|slot| slot.value);
        let until = until.or(days.map(|days| calendar::later(from.unwrap_or(PhaseDay::Day(0)), days)));
        if let (Some(fading), None) = (&self.fading, until) {
            reader.fault(fading.span, TimeSentenceMessage::NoEndToFade);
        }
        let days = |slot: &Option<Slot<f64>>| slot.as_ref().map_or(0.0, |slot| slot.value);
        Phase { from, over_days: days(&self.over), until, fading_days: days(&self.fading) }
    }

    pub fn spans(&self, kinds: &[AdverbKind]) -> Vec<TextSpan> {
        fn own<T>(slot: &Option<Slot<T>>) -> Option<TextSpan> {
            slot.as_ref().filter(|slot| slot.own).map(|slot| slot.span)
        }
        let span = |kind: &AdverbKind| match kind {
            AdverbKind::Chance => own(&self.chance),
            AdverbKind::Weekdays => own(&self.weekdays),
            AdverbKind::Months => own(&self.months).or(own(&self.of_month)),
            AdverbKind::Every => own(&self.every),
            AdverbKind::Lively => own(&self.kind),
            AdverbKind::Part => own(&self.part),
            AdverbKind::When => own(&self.when),
            AdverbKind::Lasts => own(&self.lasts),
            AdverbKind::UntilTime => own(&self.until_time),
            AdverbKind::Times => own(&self.times),
            AdverbKind::Phase => {
                own(&self.from).or(own(&self.until)).or(own(&self.for_days)).or(own(&self.over)).or(own(&self.fading))
            }
        };
        let mut spans: Vec<TextSpan> = kinds.iter().filter_map(span).collect();
        spans.dedup();
        spans
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AdverbKind {
    Chance,
    Weekdays,
    Months,
    Every,
    Lively,
    Part,
    When,
    Lasts,
    UntilTime,
    Times,
    Phase,
}

impl AdverbKind {
    pub const ALL: [AdverbKind; 11] = [
        AdverbKind::Chance,
        AdverbKind::Weekdays,
        AdverbKind::Months,
        AdverbKind::Every,
        AdverbKind::Lively,
        AdverbKind::Part,
        AdverbKind::When,
        AdverbKind::Lasts,
        AdverbKind::UntilTime,
        AdverbKind::Times,
        AdverbKind::Phase,
    ];
}
