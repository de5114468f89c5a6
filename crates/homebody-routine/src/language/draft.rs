//! The meaning of a text so far.

use super::adverbs::Adverbs;
use super::calendar::days_between;
use super::messages::TimeSentenceMessage;
use super::reader::SentenceReader;
use super::words::{TextLine, TextSpan};
use crate::routine::{Activity, Phase, PhaseDay, Quote, Routine};

pub(crate) struct RoutineDraft<'t> {
    pub routine: Routine,
    pub is_condition: bool,
    pub name: Option<String>,
    pub habit_spans: Vec<TextSpan>,
    pub finders: Vec<(String, TextSpan)>,
    pub rule_spans: Vec<(TextSpan, TextSpan)>,
    pub first_date: Option<(i16, u8, u8)>,
    pub usual: Vec<Activity>,
    pub text: &'t str,
    pub lines: Vec<TextLine<'t>>,
    pub is_trial: bool,
    pub freely_read: usize,
}

impl<'t> RoutineDraft<'t> {
    pub fn anew<'n>(&self, text: &'n str) -> RoutineDraft<'n> {
        RoutineDraft {
            routine: Routine::default(),
            is_condition: self.is_condition,
            name: None,
            habit_spans: Vec::new(),
            finders: Vec::new(),
            rule_spans: Vec::new(),
            first_date: self.first_date,
            usual: self.usual.clone(),
            text,
            lines: Vec::new(),
            is_trial: true,
            freely_read: 0,
        }
    }
}

impl RoutineDraft<'_> {
    pub fn said(&self, span: TextSpan) -> Quote {
        if self.is_trial {
            return Quote { line: 1, column: 1, text: String::new() };
        }
        let index = self.lines.partition_point(|line| line.start <= span.start).saturating_sub(1);
        let start = self.lines.get(index).map_or(0, |line| line.start);
        let column = self.text.get(start..span.start).map_or(0, |before| before.chars().count()) as u32 + 1;
        let text = self.text.get(span.start..span.end).unwrap_or_default().to_owned();
        Quote { line: index as u32 + 1, column, text }
    }

    pub fn phase(&self, reader: &mut SentenceReader, phase: &Phase, adverbs: &Adverbs, span: TextSpan) {
        let becomes = adverbs.chance.as_ref().and_then(|slot| Some((slot.span, slot.value.becomes?.1)));
        if let Some((at, by)) = becomes {
            let from = phase.from.unwrap_or(PhaseDay::Day(0));
            if days_between(from, by, self.first_date).is_some_and(|days| days <= 0) {
                reader.fault(at, TimeSentenceMessage::ChangeBeforeBegin { text: reader.said(at) });
            }
        }
        let (Some(from), Some(until)) = (phase.from, phase.until) else { return };
        if days_between(from, until, self.first_date).is_some_and(|days| days <= 0) {
            let span = adverbs.until.as_ref().map_or(span, |slot| slot.span);
            reader.fault(span, TimeSentenceMessage::EndBeforeBegin { text: reader.said(span) });
        }
    }
}
