//! The builder of a sentence's meaning: habits, changes, rules and facts, with their problems.

use super::calendar;
use super::lexicon::LexiconWords;
use super::messages::{SentenceMessage, TimeSentenceMessage};
use super::parts::{Parts, Slot, SlotKind};
use super::productions::arguments::said;
use super::words::TextSpan;
use crate::routine::{Habit, Phase, PhaseDay, Quote, ResidentKind, RoutineChange, RoutineRule, WalkRests};
use homebody_core::fuzzy::Fuzzy;
use homebody_core::problem::Diagnostic;

/// A fact about the person.
#[derive(Clone, Debug, PartialEq)]
pub enum PersonFact {
    Age(f64),
    Kind(ResidentKind),
    Pace(Fuzzy),
    Rests(WalkRests),
}

/// The meaning of one sentence, and its problems.
#[derive(Clone, Debug, Default)]
pub struct Built {
    pub habits: Vec<(Habit, TextSpan)>,
    pub changes: Vec<RoutineChange>,
    pub rules: Vec<(RoutineRule, TextSpan, TextSpan)>,
    pub facts: Vec<(PersonFact, TextSpan, TextSpan)>,
    /// The name by which the sentence introduces the person.
    pub name: Option<String>,
    pub finders: Vec<(String, TextSpan)>,
    pub faults: Vec<(TextSpan, Diagnostic)>,
}

impl Built {
    /// Whether both mean the same, whatever their words.
    pub fn is_same(&self, other: &Built) -> bool {
        let habits = |built: &Built| -> Vec<Habit> {
            built.habits.iter().map(|(habit, _)| Habit { said: Quote::default(), ..habit.clone() }).collect()
        };
        let changes = |built: &Built| -> Vec<RoutineChange> {
            built.changes.iter().map(|change| RoutineChange { said: Quote::default(), ..change.clone() }).collect()
        };
        let rules = |built: &Built| -> Vec<RoutineRule> {
            built.rules.iter().map(|(rule, ..)| RoutineRule { said: Quote::default(), ..rule.clone() }).collect()
        };
        let facts = |built: &Built| -> Vec<PersonFact> { built.facts.iter().map(|(fact, ..)| fact.clone()).collect() };
        habits(self) == habits(other)
            && changes(self) == changes(other)
            && rules(self) == rules(other)
            && facts(self) == facts(other)
    }
}

/// The text before and around a sentence, as far as its meaning depends on it.
#[derive(Clone, Copy)]
pub struct Context<'a> {
    pub text: &'a str,
    pub lexicon: &'a LexiconWords,
    pub is_condition: bool,
    pub person: Option<&'a str>,
    pub first_date: Option<(i16, u8, u8)>,
    pub heading: Option<&'a Parts>,
    pub has_habits: bool,
    pub has_rules: bool,
    pub rooms: &'a [String],
}

pub struct Builder<'a> {
    pub context: Context<'a>,
    pub built: Built,
}

impl Builder<'_> {
    pub fn fault(&mut self, span: TextSpan, message: impl Into<Diagnostic>) {
        self.built.faults.push((span, message.into()));
    }

    pub fn said(&self, span: TextSpan) -> String {
        said(self.context.text, span)
    }

    pub fn quote(&self, span: TextSpan) -> Quote {
        super::draft::quote(self.context.text, span)
    }

    /// Says what does not fit, of all but the given kinds.
    pub fn only(&mut self, parts: &Parts, allowed: &[SlotKind], why: &str) {
        for (kind, span) in parts.slots() {
            if !allowed.contains(&kind) {
                let text = self.said(span);
                self.fault(span, SentenceMessage::DoesNotFit { text, reason: why.to_owned() });
            }
        }
    }

    pub fn phase(&mut self, parts: &Parts, span: TextSpan) -> Phase {
        let from = parts.from.as_ref().map(|slot| slot.value);
        let days = parts.days();
        if days.weekdays == 0 || days.months == 0 {
            let except = parts.except_days.as_ref().or(parts.weekdays.as_ref()).map(|slot| slot.span);
            let span = except.or(parts.except_months.as_ref().map(|slot| slot.span)).unwrap_or(span);
            let (text, reason) = (self.said(span), "no day is left on which it happens".to_owned());
            self.fault(span, SentenceMessage::DoesNotFit { text, reason });
        }
        if let (Some(over), None, false) = (&parts.over, from, self.context.is_condition) {
            let help = "write \"From week 6, over 4 weeks, ...\"".to_owned();
            self.fault(over.span, TimeSentenceMessage::NoBeginning { help });
        }
        if let (Some(until), Some(for_days)) = (&parts.until_day, &parts.for_days) {
            let (text, other) = (self.said(until.span), self.said(for_days.span));
            self.fault(for_days.span, TimeSentenceMessage::TwoEnds { text, other });
        }
        if let (Some(for_days), None, true) =
            (&parts.for_days, from, parts.months.is_some() || parts.of_month.is_some())
        {
            let help = "write from which day, such as \"from 2026-07-01, for 14 days\"".to_owned();
            self.fault(for_days.span, TimeSentenceMessage::NoBeginning { help });
        }
        let days = parts.for_days.as_ref().map(|slot| slot.value as i32);
        let until = parts.until_day.as_ref().map(|slot| slot.value);
        let until = until.or(days.map(|days| calendar::later(from.unwrap_or(PhaseDay::Day(0)), days)));
        if let (Some(fading), None) = (&parts.fading, until) {
            self.fault(fading.span, TimeSentenceMessage::NoEndToFade);
        }
        let first = from.unwrap_or(PhaseDay::Day(0));
        let first_date = self.context.first_date;
        let is_before = |day| calendar::days_between(first, day, first_date).is_some_and(|days| days <= 0);
        let becomes = parts.chance.as_ref().and_then(|slot| Some((slot.span, slot.value.chance.becomes?.1)));
        if let Some((at, _)) = becomes.filter(|(_, by)| is_before(*by)) {
            let text = self.said(at);
            self.fault(at, TimeSentenceMessage::ChangeBeforeBegin { text });
        }
        if from.is_some() && until.is_some_and(is_before) {
            let span = parts.until_day.as_ref().map_or(span, |slot| slot.span);
            let text = self.said(span);
            self.fault(span, TimeSentenceMessage::EndBeforeBegin { text });
        }
        let days = |slot: &Option<Slot<f64>>| slot.as_ref().map_or(0.0, |slot| slot.value);
        Phase { from, over_days: days(&parts.over), until, fading_days: days(&parts.fading) }
    }
}
