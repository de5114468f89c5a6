//! What has been understood of a text, sentence by sentence.

use super::adverbs::Adverbs;
use super::calendar::days_between;
use super::messages::TimeMessage;
use super::reader::Reader;
use super::words::{Line, Span};
use crate::routine::{Activity, Moment, Phase, Quote, Routine};

/// What has been understood so far.
pub(crate) struct Draft<'t> {
    pub routine: Routine,
    pub is_condition: bool,
    /// The person's name, where only the text says it.
    pub name: Option<String>,
    /// Where the verb of each habit stands.
    pub habit_spans: Vec<Span>,
    /// Who is said to find whoever has fallen.
    pub finders: Vec<(String, Span)>,
    /// Where each rule says what happens, and for how long.
    pub rule_spans: Vec<(Span, Span)>,
    pub first_date: Option<(i16, u8, u8)>,
    pub usual: Vec<Activity>,
    pub text: &'t str,
    pub lines: Vec<Line<'t>>,
    /// Whether nobody will read what is understood: no lines are counted.
    pub is_trial: bool,
    /// How many words of sentences that are not understood as they stand were read in other ways.
    pub freely_read: usize,
}

impl<'t> Draft<'t> {
    /// A draft in which nothing has been understood yet, about the same.
    pub fn anew<'n>(&self, text: &'n str) -> Draft<'n> {
        Draft {
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

impl Draft<'_> {
    /// The words at a place, with line and column.
    pub fn said(&self, span: Span) -> Quote {
        if self.is_trial {
            return Quote { line: 1, column: 1, text: String::new() };
        }
        let index = self.lines.partition_point(|line| line.start <= span.start).saturating_sub(1);
        let start = self.lines.get(index).map_or(0, |line| line.start);
        let column = self.text.get(start..span.start).map_or(0, |before| before.chars().count()) as u32 + 1;
        let text = self.text.get(span.start..span.end).unwrap_or_default().to_owned();
        Quote { line: index as u32 + 1, column, text }
    }

    /// A phase has to begin before it ends, and before how often changes.
    pub fn phase(&self, reader: &mut Reader, phase: &Phase, adverbs: &Adverbs, span: Span) {
        let becomes = adverbs.chance.as_ref().and_then(|slot| Some((slot.span, slot.value.becomes?.1)));
        if let Some((at, by)) = becomes {
            let from = phase.from.unwrap_or(Moment::Day(0));
            if days_between(from, by, self.first_date).is_some_and(|days| days <= 0) {
                reader.fault(at, TimeMessage::ChangeBeforeBegin { text: reader.said(at) });
            }
        }
        let (Some(from), Some(until)) = (phase.from, phase.until) else { return };
        if days_between(from, until, self.first_date).is_some_and(|days| days <= 0) {
            let span = adverbs.until.as_ref().map_or(span, |slot| slot.span);
            reader.fault(span, TimeMessage::EndBeforeBegin { text: reader.said(span) });
        }
    }
}
