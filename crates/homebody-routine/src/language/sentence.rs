//! One sentence: its words into the chart, and the best of its readings.

use super::build::build;
use super::builder::{Built, Context};
use super::chart::{Chart, FAULT_COST, MOST_STEPS, MOST_WORDS, Phrase, SKIP_COST};
use super::filled_chart::filled_chart;
use super::messages::SentenceMessage;
use super::names::HomeNames;
use super::parts::Parts;
use super::refusal;
use super::tokens::{Tokens, span_of};
use super::value::{PhraseValue, SpokenStatement};
use super::words::{SentenceWord, TextSpan};
use homebody_core::problem::Diagnostic;
use std::sync::Arc;

/// A sentence that is understood, or its problems.
pub enum Reading {
    Heading(Box<Parts>),
    Meaning(Box<Built>),
    Refused(Vec<(TextSpan, Diagnostic)>),
}

/// The steps that a text may take for sentences that are refused. Beyond them, no words are left out to find offers.
pub struct Budget {
    pub left: usize,
}

/// Steps for a refused sentence of a text that has used up its budget (our choice).
const FEW_STEPS: usize = 10_000;
/// Steps that the search for what was meant counts as, by its time (our choice).
const STEPS_OF_HINTS: usize = 5_000;

pub fn read(
    names: &HomeNames,
    context: Context,
    words: &[SentenceWord],
    is_indented: bool,
    budget: &mut Budget,
) -> Reading {
    let (reading, steps) = with_steps(names, context, words, is_indented, budget);
    let Reading::Refused(faults) = reading else { return reading };
    let has_left = budget.left > 0 && words.len() <= MOST_WORDS;
    budget.left = budget.left.saturating_sub(steps + STEPS_OF_HINTS);
    if !has_left {
        return Reading::Refused(faults);
    }
    let (faults, steps) = refusal::with_offer(names, context, &Tokens::new(words), faults);
    budget.left = budget.left.saturating_sub(steps);
    Reading::Refused(faults)
}

fn with_steps(
    names: &HomeNames,
    context: Context,
    words: &[SentenceWord],
    is_indented: bool,
    budget: &Budget,
) -> (Reading, usize) {
    let tokens = Tokens::new(words);
    let span = span_of(&tokens.words);
    if tokens.words.len() > MOST_WORDS {
        return (Reading::Refused(vec![(span, SentenceMessage::TooManyWords { most: MOST_WORDS }.into())]), 0);
    }
    let most_steps = if budget.left > 0 { MOST_STEPS } else { FEW_STEPS };
    let mut chart = filled_chart(names, context.text, &tokens, budget.left > 0, most_steps);
    let reading = best(names, context, &tokens, &mut chart, is_indented);
    (reading, chart.steps)
}

fn best(names: &HomeNames, context: Context, tokens: &Tokens, chart: &mut Chart, is_indented: bool) -> Reading {
    let span = span_of(&tokens.words);
    let found = chart.readings("Statement");
    let mut best: Vec<(usize, u32, Arc<Phrase>, Built)> = Vec::new();
    for item in found {
        let PhraseValue::Statement(statement) = item.value.as_ref() else { continue };
        let built = build(context, statement, span);
        let faults = built.faults.len() + item.faults.as_ref().map_or(0, |faults| faults.len());
        best.push((faults, item.cost, item, built));
    }
    best.sort_by_key(|(faults, cost, ..)| (*cost >= SKIP_COST, *faults, *cost));
    let Some((faults, cost, item, built)) = best.first() else {
        return Reading::Refused(refusal::without_reading(names, context, chart));
    };
    if item.skipped != 0 {
        let skipped: Vec<(u64, usize)> = best.iter().map(|(faults, _, item, _)| (item.skipped, *faults)).collect();
        let mut all = refusal::left_out(names, context, tokens, chart, &skipped);
        all.extend(item.faults.iter().flat_map(|faults| faults.iter().cloned()));
        all.sort_by_key(|(span, _)| span.start);
        return Reading::Refused(all);
    }
    if *faults > 0 {
        let mut all: Vec<(TextSpan, Diagnostic)> =
            item.faults.iter().flat_map(|faults| faults.iter().cloned()).collect();
        all.extend(built.faults.iter().cloned());
        return Reading::Refused(all);
    }
    if let PhraseValue::Statement(statement) = item.value.as_ref()
        && let SpokenStatement::Heading(parts) = statement.as_ref()
    {
        return match is_indented {
            true => Reading::Refused(vec![(span, SentenceMessage::NothingDone.into())]),
            false => Reading::Heading(Box::new(parts.clone())),
        };
    }
    let other = best.iter().skip(1).find(|(faults, other, _, other_built)| {
        *faults == 0 && *other < FAULT_COST && other == cost && !other_built.is_same(built)
    });
    if let Some((.., other)) = other {
        let message = refusal::two_meanings(built, other);
        return Reading::Refused(vec![(span, message)]);
    }
    let (_, _, _, built) = best.swap_remove(0);
    Reading::Meaning(Box::new(built))
}
