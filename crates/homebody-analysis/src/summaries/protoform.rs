//! The possible sentences about a measure, their truth, and the one that says most.

use super::sentence::{SummarySentence, SummarySubject, TRUE_ENOUGH};
use super::set::{BORDER, Set};
use crate::measures::{DailyMeasure, Earlier, MEASURES, SummaryUse, ValueForm};
use crate::phrases::joined;
use homebody_core::fuzzy::Quantifier;
use homebody_core::names::capitalised;
use jiff::civil::Date;

type Topic = (&'static DailyMeasure, SummaryUse);

/// The measures of summaries, in order of rank.
pub(super) fn topics() -> Vec<Topic> {
    let mut topics: Vec<Topic> = MEASURES.iter().filter_map(|measure| Some((measure, measure.summary?))).collect();
    topics.sort_by_key(|(_, summary)| summary.rank);
    topics
}

/// Largest number in a set of counts.
const MOST_TIMES: u32 = 8;
/// Factor on the likelihood for each further count (our choice).
const ONE_MORE: f64 = 0.6;
/// The widths of sets of hours.
const WIDTHS_H: [f64; 5] = [0.5, 1.0, 1.5, 2.0, 3.0];

/// Strength of the quantifiers of each level, from the strongest on (our choice).
const STRICT: [(Quantifier, f64); 6] = [
    (Quantifier::Every, 1.0),
    (Quantifier::AlmostAlways, 0.95),
    (Quantifier::Most, 0.8),
    (Quantifier::Often, 0.6),
    (Quantifier::AboutHalf, 0.5),
    (Quantifier::Sometimes, 0.3),
];
/// Number of days of a change: some days are beyond the past without a change.
const OF_CHANGES: usize = 4;

pub(super) struct Protoform {
    quantifier: Quantifier,
    set: Set,
    truth: f64,
    says: f64,
    before: Option<f64>,
}

/// The share of values that are in a set, and the degree to which it fits a quantifier.
pub fn truth(quantifier: Quantifier, set: Set, values: impl Iterator<Item = f64>) -> (f64, f64) {
    let set = set.fuzzy();
    let (mut sum, mut count) = (0.0, 0.0);
    for value in values {
        (sum, count) = (sum + set.agreement(value), count + 1.0);
    }
    let share = if count > 0.0 { sum / count } else { 0.0 };
    (share, quantifier.share().agreement(share))
}

/// The level of a measure, if a sentence fits.
pub(super) fn level((measure, summary): Topic, values: &[(Date, f64)]) -> Option<Protoform> {
    let mut best: Option<Protoform> = None;
    let range = summary.range?;
    for set in sets(measure.unit.form, range) {
        // The narrowness of the set in the range of the measure.
        let narrow = 1.0 - covers(set, range);
        for (quantifier, strict) in STRICT {
            let is_not_at_all = set == Set::Exactly(0);
            if is_not_at_all && strict < 0.9 {
                continue;
            }
            let (_, truth) = truth(quantifier, set, values.iter().map(|(_, value)| *value));
            let says = truth * strict * narrow;
            if truth >= TRUE_ENOUGH && best.as_ref().is_none_or(|best| says > best.says) {
                best = Some(Protoform { quantifier, set, truth, says, before: None });
            }
        }
    }
    best
}

fn sets(unit: ValueForm, (low, high): (f64, f64)) -> Vec<Set> {
    match unit {
        ValueForm::Times => {
            let most = MOST_TIMES.min(high as u32);
            (0..=most).map(Set::Exactly).chain((1..=most).map(Set::AtLeast)).collect()
        }
        _ => {
            let steps = ((high - low) * 2.0) as u32;
            let begins = (0..steps).map(|step| low + f64::from(step) / 2.0);
            begins.flat_map(|from| WIDTHS_H.map(|width| Set::Between(from, from + width))).collect()
        }
    }
}

/// The share of all possible values that a set covers: higher counts are taken to be rarer, each so many times as likely as one fewer.
fn covers(set: Set, (low, high): (f64, f64)) -> f64 {
    let at_least = |times: u32| (0..times).fold(1.0, |share, _| share * ONE_MORE);
    match set {
        Set::AtLeast(times) => at_least(times),
        Set::Exactly(times) => at_least(times) * (1.0 - ONE_MORE),
        Set::Between(from, to) => (to - from + BORDER) / (high - low),
        Set::Beyond { .. } => 0.5,
    }
}

pub(super) fn change((measure, _): Topic, values: &[(Date, f64)], past: &[(Date, f64)]) -> Option<Protoform> {
    let count = past.len() as f64;
    let mean = past.iter().map(|(_, value)| value).sum::<f64>() / count;
    let square = past.iter().map(|(_, value)| (value - mean) * (value - mean)).sum::<f64>() / count;
    let sd = square.sqrt().max(measure.least_sd);
    let now = values.iter().map(|(_, value)| value).sum::<f64>() / values.len() as f64;
    let set = Set::Beyond { mean, sd, is_more: now > mean };
    let told = STRICT[..OF_CHANGES].iter().find_map(|&(quantifier, strict)| {
        let (_, truth) = truth(quantifier, set, values.iter().map(|(_, value)| *value));
        (truth >= TRUE_ENOUGH).then_some((quantifier, strict, truth))
    });
    let (quantifier, strict, truth) = told?;
    let apart = (now - mean).abs() / sd;
    Some(Protoform { quantifier, set, truth, says: truth * strict * (apart / (1.0 + apart)), before: Some(mean) })
}

impl Protoform {
    pub(super) fn sentence(
        self,
        (measure, _): Topic,
        values: &[(Date, f64)],
        days: usize,
        about: SummarySubject,
    ) -> SummarySentence {
        let Protoform { quantifier, set, truth, says, before } = self;
        let fuzzy = set.fuzzy();
        let count = values.len() as f64;
        let share = values.iter().map(|(_, value)| fuzzy.agreement(*value)).sum::<f64>() / count;
        let is_so = values.iter().filter(|(_, value)| fuzzy.agreement(*value) >= 0.5);
        let shown_by: Vec<Date> = is_so.map(|(date, _)| *date).collect();
        let mean = values.iter().map(|(_, value)| value).sum::<f64>() / count;
        let words = measure.summary_words(quantifier, set, about, days);
        let (so, known) = (shown_by.len(), values.len());
        let exactly = |value| measure.with_unit(value, 2);
        let earlier = before.map_or(String::new(), |before| format!(", previously {}", exactly(before)));
        let on = format!("on {so} of {known} {}s", measure.occasion);
        let expert = format!("{words} (truth {truth:.2}; {on}; mean {}{earlier}).", exactly(mean));
        let compared = before.map(|before| measure.compared(mean, Earlier::Before(before), true)).unwrap_or_default();
        let average = measure.on_average(mean).filter(|_| before.is_none());
        let plain = format!("{}.", joined(words, &compared));
        let numbers = format!("{}{}.", capitalised(&on), average.map(|mean| format!("; {mean}")).unwrap_or_default());
        let is_more = match set {
            Set::Beyond { is_more, .. } => Some(is_more),
            _ => None,
        };
        let focus = count / days.max(1) as f64;
        SummarySentence {
            plain,
            expert,
            numbers,
            measure: measure.name,
            is_more,
            quantifier,
            set,
            truth,
            focus,
            says,
            share,
            mean,
            before,
            shown_by,
        }
    }
}
