use super::set::Set;
use homebody_core::fuzzy::Quantifier;
use jiff::civil::Date;
use serde::Serialize;
use std::fmt;

/// Smallest truth value of a sentence in the summary (our choice).
pub const TRUE_ENOUGH: f64 = 0.8;
#[derive(Clone, Debug, Serialize)]
pub struct VerbalSummary {
    pub name: String,
    pub from: Option<Date>,
    /// The number of days, and of those that count.
    pub days: usize,
    pub days_that_count: usize,
    /// Enough days that count lie before to show changes.
    pub is_compared: bool,
    pub remarks: Vec<String>,
    pub sentences: Vec<SummarySentence>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SummarySentence {
    pub plain: String,
    /// The same with numbers.
    pub expert: String,
    /// The days of the plain sentence, and the average where that has none.
    #[serde(skip)]
    pub numbers: String,
    pub measure: &'static str,
    /// The direction of a change from before; `None` for a sentence about a level.
    pub is_more: Option<bool>,
    /// The share of the days, as a quantifier.
    pub quantifier: Quantifier,
    /// The set of values on these days.
    pub set: Set,
    /// From 0 to 1.
    pub truth: f64,
    /// The share of the days on which the measure is known.
    pub focus: f64,
    /// The content of the sentence, from 0 to 1.
    pub says: f64,
    /// The share of the days that fit.
    pub share: f64,
    /// The measure's mean over the days.
    pub mean: f64,
    /// The mean of the days before, of a change.
    pub before: Option<f64>,
    pub shown_by: Vec<Date>,
}

#[derive(Clone, Copy, Debug)]
pub struct SummarySubject<'a> {
    /// The name: `Margaret`, or `The resident`.
    pub subject: &'a str,
    pub last: usize,
}

impl VerbalSummary {
    /// Writes the sentences, for experts with truth values, and the remarks after them.
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
