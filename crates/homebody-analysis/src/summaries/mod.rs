//! Measures of days in words: sentences such as "On most nights of the last two weeks, she went to the bathroom twice or more."
//!
//! Each is a protoform (Yager 1982): on so many of the days, the measure is so. How many and how are fuzzy sets. The truth value is
//! how well the share of the days on which it is so fits the quantifier, by Zadeh's calculus; a sentence is told that
//! is true to 0.8 and more. Of all that are true of a measure, that one is told that says most: with a strict
//! quantifier and a narrow set. Sentences about what has changed come first.
//!
//! We assume that each measure is about one person. Left out: what is guessed, and sentences about several measures at once.

mod distance;
mod protoform;
mod sentence;
mod set;
mod words;

use crate::alerts::counts;
use crate::measures::{Day, Measures};
use homebody_core::problem::counted;
use jiff::civil::Date;
use protoform::{Found, change, level};
use words::{SPOKEN, Spoken};

pub use distance::{between, of_summaries};
pub use protoform::truth;
pub use sentence::{About, Sentence, Summary, TRUE_ENOUGH};
pub use set::Set;

/// Smallest number of days that count for a summary (our choice).
const LEAST_DAYS: usize = 5;
/// Largest number of earlier days, and smallest number of them that count (our choice).
const BEFORE: usize = 56;
const LEAST_BEFORE: usize = 7;

/// Summarises the last days of measures.
pub fn summarise(measures: &Measures, about: About) -> Summary {
    let from = measures.days.len().saturating_sub(about.last);
    let (before, days) = measures.days.split_at(from);
    let before = &before[before.len().saturating_sub(BEFORE)..];
    let days_that_count = days.iter().filter(|day| counts(day)).count();
    let mut remarks = measures.remarks.clone();
    let (mut sentences, mut changes) = (Vec::new(), Vec::new());
    let is_compared = before.iter().filter(|day| counts(day)).count() >= LEAST_BEFORE;
    if days_that_count < LEAST_DAYS {
        let known = counted(days_that_count, "day", "days");
        remarks.push(format!("{known} that count: too few to summarise, {LEAST_DAYS} are needed"));
    } else {
        if !is_compared {
            remarks
                .push(format!("Fewer than {LEAST_BEFORE} days that count lie before, so nothing is said of changes"));
        }
        let is_told = |spoken: &&Spoken| !measures.guesses.contains(&spoken.measure);
        for spoken in SPOKEN.iter().filter(is_told) {
            let of = |days: &[Day]| known(spoken, days);
            let values = of(days);
            if values.len() < LEAST_DAYS {
                continue;
            }
            let sentence = |found: Found| found.told(spoken, &values, days.len(), about);
            sentences.extend(level(spoken, &values).map(sentence));
            let past = of(before);
            if is_compared && past.len() >= LEAST_BEFORE {
                changes.extend(change(spoken, &values, &past).map(sentence));
            }
        }
    }
    let sentences = [without_repeats(changes), without_repeats(sentences)].concat();
    Summary {
        name: measures.name.clone(),
        from: days.first().map(|day| day.date),
        days: days.len(),
        days_that_count,
        is_compared,
        remarks,
        sentences,
    }
}

/// The days that count on which a measure is known, with its values.
fn known(spoken: &Spoken, days: &[Day]) -> Vec<(Date, f64)> {
    let of = |day: &Day| Some((day.date, day.value(spoken.measure)?));
    days.iter().filter(|day| counts(day)).filter_map(of).collect()
}

/// Those that say most first; of those about the same thing, the first alone.
fn without_repeats(mut sentences: Vec<Sentence>) -> Vec<Sentence> {
    sentences.sort_by(|a, b| b.says.total_cmp(&a.says));
    let mut told: Vec<&str> = Vec::new();
    sentences.retain(|sentence| {
        let thing = words::thing(sentence.measure);
        let is_new = !told.contains(&thing);
        told.extend(is_new.then_some(thing));
        is_new
    });
    sentences
}

#[cfg(test)]
mod tests;
