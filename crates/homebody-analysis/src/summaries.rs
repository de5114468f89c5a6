//! Sentences about the last days, such as "Ada got up for the bathroom at least twice on most nights of the last two weeks."
//!
//! Each is a protoform (Yager 1982): on so many of the days, the measure is so. Both are fuzzy sets. The truth value is how well
//! the share of the days fits the quantifier, by Zadeh's calculus; a sentence needs 0.8. Of all true sentences about a measure,
//! the summary has the most specific: a strict quantifier and a narrow set. Changes come first.
//!
//! We assume that each measure is about one person. Left out: estimates, and sentences about several measures at once.

mod distance;
mod protoform;
mod sentence;
mod set;
mod wording;

use crate::measures::{DailyMeasure, DayMeasures, Measures};
use homebody_core::problem::counted;
use jiff::civil::Date;
use protoform::{Protoform, change, level, topics};

pub use distance::{between, of_summaries};
pub use protoform::truth;
pub use sentence::{SummarySentence, SummarySubject, TRUE_ENOUGH, VerbalSummary};
pub use set::Set;

/// Smallest number of days that count for a summary (our choice).
const LEAST_DAYS: usize = 5;
/// Largest number of earlier days, and smallest number of them that count (our choice).
const BEFORE: usize = 56;
const LEAST_BEFORE: usize = 7;

pub fn summarise(measures: &Measures, about: SummarySubject) -> VerbalSummary {
    let from = measures.days.len().saturating_sub(about.last);
    let (before, days) = measures.days.split_at(from);
    let before = &before[before.len().saturating_sub(BEFORE)..];
    let days_that_count = days.iter().filter(|day| day.counts()).count();
    let mut remarks = measures.remarks.clone();
    let (mut sentences, mut changes) = (Vec::new(), Vec::new());
    let is_compared = before.iter().filter(|day| day.counts()).count() >= LEAST_BEFORE;
    if days_that_count < LEAST_DAYS {
        let known = counted(days_that_count, "complete day", "complete days");
        remarks.push(format!("Only {known} so far; at least {LEAST_DAYS} are needed for a summary"));
    } else {
        if !is_compared {
            let days = counted(about.last, "day", "days");
            remarks.push(format!("Changes need at least {LEAST_BEFORE} complete days before the last {days}"));
        }
        for topic in topics().into_iter().filter(|(measure, _)| !measures.guesses.contains(&measure.name)) {
            let of = |days: &[DayMeasures]| known(topic.0, days);
            let values = of(days);
            if values.len() < LEAST_DAYS {
                continue;
            }
            let sentence = |found: Protoform| found.sentence(topic, &values, days.len(), about);
            sentences.extend(level(topic, &values).map(sentence));
            let past = of(before);
            if is_compared && past.len() >= LEAST_BEFORE {
                changes.extend(change(topic, &values, &past).map(sentence));
            }
        }
    }
    let sentences = [without_repeats(changes), without_repeats(sentences)].concat();
    VerbalSummary {
        name: measures.name.clone(),
        from: days.first().map(|day| day.date),
        days: days.len(),
        days_that_count,
        is_compared,
        remarks,
        sentences,
    }
}

fn known(measure: &DailyMeasure, days: &[DayMeasures]) -> Vec<(Date, f64)> {
    let of = |day: &DayMeasures| Some((day.date, day.value(measure.name)?));
    days.iter().filter(|day| day.counts()).filter_map(of).collect()
}

/// The sentences that say most first; of those about the same thing, the first alone.
fn without_repeats(mut sentences: Vec<SummarySentence>) -> Vec<SummarySentence> {
    sentences.sort_by(|a, b| b.says.total_cmp(&a.says));
    let mut told: Vec<&str> = Vec::new();
    sentences.retain(|sentence| {
        let subject =
            topics().into_iter().find(|topic| topic.0.name == sentence.measure).map_or("", |topic| topic.1.subject);
        let is_new = !told.contains(&subject);
        told.extend(is_new.then_some(subject));
        is_new
    });
    sentences
}

#[cfg(test)]
mod tests;
