//! What a summary comes to: plain data.

use super::set::Set;
use homebody_core::fuzzy::Quantifier;
use jiff::civil::Date;
use serde::Serialize;
use std::fmt;

/// Smallest truth value of a sentence in the summary (our choice).
pub const TRUE_ENOUGH: f64 = 0.8;
/// The days of a log in words.
#[derive(Clone, Debug, Serialize)]
pub struct VerbalSummary {
    /// What the log is called.
    pub name: String,
    /// The first of the days that it is about.
    pub from: Option<Date>,
    /// How many days it is about, and how many of them count.
    pub days: usize,
    /// Those that are whole, with somebody at home.
    pub days_that_count: usize,
    /// Whether enough days that count lie before to say what has changed.
    pub is_compared: bool,
    /// What cannot be said, in sentences.
    pub remarks: Vec<String>,
    /// The sentences, those that say most first.
    pub sentences: Vec<SummarySentence>,
}

/// A sentence about a measure.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SummarySentence {
    /// For carers.
    pub plain: String,
    /// The same with numbers.
    pub expert: String,
    /// The days of the plain sentence, and the average where that has none.
    #[serde(skip)]
    pub numbers: String,
    /// The measure's name.
    pub measure: &'static str,
    /// Whether it says what has changed: more than before, or less; `None` where it says how things are.
    pub is_more: Option<bool>,
    /// On how many of the days.
    pub quantifier: Quantifier,
    /// How the measure is on them.
    pub set: Set,
    /// From 0 to 1.
    pub truth: f64,
    /// The share of the days on which the measure is known.
    pub focus: f64,
    /// How much it says, from 0 to 1.
    pub says: f64,
    /// The share of the days on which it is so.
    pub share: f64,
    /// The measure's mean over the days.
    pub mean: f64,
    /// The mean of the days before, of a change.
    pub before: Option<f64>,
    /// The days on which it is so.
    pub shown_by: Vec<Date>,
}

/// Whom sentences are about.
#[derive(Clone, Copy, Debug)]
pub struct SummarySubject<'a> {
    /// What they are called: `Margaret`, or `The resident`.
    pub subject: &'a str,
    /// So many of the last days.
    pub last: usize,
}

impl VerbalSummary {
    /// Writes the sentences, for experts with truth values, and the remarks after them.
    ///
    /// # Errors
    ///
    /// Those of the formatter.
    pub fn write(&self, f: &mut fmt::Formatter, is_expert: bool) -> fmt::Result {
        for sentence in &self.sentences {
            writeln!(f, "{}", if is_expert { &sentence.expert } else { &sentence.plain })?;
        }
        if !self.sentences.is_empty() && !self.remarks.is_empty() {
            writeln!(f)?;
        }
        self.remarks.iter().try_for_each(|remark| writeln!(f, "{remark}."))
    }
}

impl fmt::Display for VerbalSummary {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.write(f, false)
    }
}
