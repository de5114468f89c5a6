//! Sentences that only say which days are busy or quiet.

use super::adverbs::{Adverbs, Slot};
use super::build;
use super::clause::Clause;
use super::day_kind::{are_of_kind, has_days};
use super::draft::RoutineDraft;
use super::messages::WordMessage;
use super::predicate::Predicate;
use super::predicate_tail::tail;
use super::reader::SentenceReader;
use super::subjects::SentenceSubject;
use crate::routine::HabitChance;
use homebody_core::fuzzy::Quantifier;

/// Behind the days: "some days are busy and some are quiet".
pub fn says_kinds(
    reader: &mut SentenceReader,
    draft: &mut RoutineDraft,
    mut adverbs: Adverbs,
    heading: Option<&Adverbs>,
) -> bool {
    let mut start = 0;
    while let Some(kind) = are_of_kind(reader) {
        let predicate_span = reader.span(reader.at - 1);
        // "A quiet day: she hardly leaves her chair".
        let is_told = reader.attempt(|reader| {
            reader.skip_commas();
            reader.eat(":|when|and|on");
            reader.eat("which");
            reader.eat("she|he|they").then_some(())?;
            has_days(reader)
        });
        let (kind, very) = is_told.unwrap_or(kind);
        let mut clause = Clause {
            span: reader.span(start),
            subject: SentenceSubject::Person,
            predicate: Predicate::Lively(kind, very),
            predicate_span,
            place: None,
            measure: None,
            adverbs: std::mem::take(&mut adverbs),
            tends: false,
            again: false,
            beside: Vec::new(),
            finder: None,
        };
        let Some(goes_on) = tail(reader, &mut clause) else { return true };
        clause.adverbs = heading.map_or(clause.adverbs.clone(), |heading| clause.adverbs.clone().under(heading));
        build::build(reader, draft, clause);
        if goes_on.is_none() {
            return true;
        }
        start = reader.at;
        let others = reader.eat("some|others") || reader.eat("other days");
        let span = reader.span(start);
        if others {
            adverbs.chance = Some(Slot { value: HabitChance::from_quantifier(Quantifier::Sometimes), span, own: true });
        } else {
            adverbs.all(reader);
        }
    }
    if start > 0 {
        let help = Some("write \"some days are busy and some are quiet\"".into());
        let (here, text) = (reader.here(), reader.said(reader.here()));
        reader.fault(here, WordMessage::NotUnderstood { text, help });
    }
    start > 0
}
