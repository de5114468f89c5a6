//! Checks of a place, each with what was found and what to do, and the check of the numbers of a run's rows.

use crate::error::LogError;
use crate::table::{ColumnNames, Table, truth};
use crate::url::Url;
use homebody_core::problem::{counted, readable};
use homebody_core::scenario::logger::LoggerFile;
use serde::Serialize;

/// The result of a check.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum CheckVerdict {
    /// As it should be.
    Ok,
    /// Not as it should be, though nothing is lost or stopped by it.
    Warning,
    /// Something is lost, or will not work.
    Wrong,
}

/// One thing that was looked at.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Check {
    /// The result.
    pub verdict: CheckVerdict,
    /// The subject, in a word or two.
    pub about: String,
    /// The finding, as a sentence without its full stop. It never has a password in it.
    pub says: String,
    /// Advice.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hint: Option<String>,
    /// The number of rows of one run, if they were counted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rows: Option<u64>,
}

impl Check {
    /// It is as it should be.
    pub fn ok(about: &str, says: impl Into<String>) -> Check {
        Check { verdict: CheckVerdict::Ok, about: about.into(), says: readable(says.into()), hint: None, rows: None }
    }

    /// It is not, and that may be meant.
    pub fn warning(about: &str, says: impl Into<String>, hint: impl Into<String>) -> Check {
        Check { verdict: CheckVerdict::Warning, hint: Some(readable(hint.into())), ..Check::ok(about, says) }
    }

    /// It is not.
    pub fn wrong(about: &str, says: impl Into<String>, hint: impl Into<String>) -> Check {
        Check { verdict: CheckVerdict::Wrong, hint: Some(readable(hint.into())), ..Check::ok(about, says) }
    }

    /// The same, said of a part of what was looked at.
    pub fn of(self, part: &str) -> Check {
        Check { says: format!("{part}: {}", self.says), ..self }
    }

    /// A check that failed with an error, which may have a hint of its own.
    pub fn of_error(about: &str, error: &LogError) -> Check {
        let text = error.to_string();
        let (says, hint) = text.split_once("\n  hint: ").map_or((&*text, None), |(says, hint)| (says, Some(hint)));
        let hint = hint.map(|hint| readable(hint.to_owned()));
        Check { verdict: CheckVerdict::Wrong, hint, ..Check::ok(about, says.replace('\n', "; ")) }
    }
}

/// Options of checks.
#[derive(Clone, Copy)]
pub struct CheckOptions<'a> {
    /// The names of the log's table and columns.
    pub mapping: &'a LoggerFile,
    /// Whether a check may write if it leaves nothing behind, such as a message that is not retained.
    pub may_write: bool,
}

/// Checks a place.
pub type Examine = fn(&Url, &CheckOptions) -> Result<Vec<Check>, LogError>;

/// Row numbers, in the order of the rows.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RowNumbers {
    rows: u64,
    next: i64,
    /// The first number that is missing, and how many are.
    gap: Option<(i64, u64)>,
    /// The first number that came again, and how many did.
    again: Option<(i64, u64)>,
}

impl RowNumbers {
    /// Takes the number of a row.
    pub fn push(&mut self, number: i64) {
        self.rows += 1;
        let ahead = number.saturating_sub(self.next);
        match ahead {
            0 => {}
            1.. => {
                self.gap =
                    Some((self.gap.map_or(self.next, |gap| gap.0), self.gap.map_or(0, |gap| gap.1) + ahead as u64))
            }
            _ => {
                self.again =
                    Some((self.again.map_or(number, |again| again.0), self.again.map_or(0, |again| again.1) + 1))
            }
        }
        self.next = self.next.max(number.saturating_add(1));
    }

    /// The number of rows so far.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// The check of the rows of a run; `run` is its name, such as `run 5`.
    pub fn check(&self, run: &str) -> Check {
        let of = |some: Option<(i64, u64)>| (some.map_or(0, |(_, count)| count as i64), some.map(|(first, _)| first));
        found_of(run, self.rows as i64, of(self.gap), of(self.again))
    }
}

/// The check of the rows of a run: the number of rows, of missing ones and of duplicates, with the first of these.
pub fn found_of(run: &str, rows: i64, gap: (i64, Option<i64>), again: (i64, Option<i64>)) -> Check {
    const HINT: &str =
        "homebody run --resume FOLDER compares what is there with the run lived again; or write the log anew";
    let count = rows.max(0) as u64;
    let rows = counted(count as usize, "row", "rows");
    let first = |first: Option<i64>| first.map_or_else(String::new, |first| format!(", the first is {first}"));
    let mut wrong = Vec::new();
    if gap.0 > 0 {
        wrong.push(format!("{} missing{}", counted(gap.0 as usize, "number is", "numbers are"), first(gap.1)));
    }
    if again.0 > 0 {
        let what = counted(
            again.0 as usize,
            "row has a number that was there before",
            "rows have numbers that were there before",
        );
        wrong.push(format!("{what}{}", first(again.1)));
    }
    let check = match wrong.is_empty() {
        true => Check::ok("rows", format!("{run}: {rows}, numbered from 0 without a gap")),
        false => Check::wrong("rows", format!("{run}: of {rows}, {}", wrong.join("; ")), HINT),
    };
    Check { rows: Some(count), ..check }
}

/// The table of a log by the names of a mapping, and what the column of the run's id is called.
///
/// # Errors
///
/// A name that no database takes, or one that is used twice.
pub fn log_table(mapping: &LoggerFile) -> Result<(Table, String), LogError> {
    let columns = ColumnNames::new(mapping)?;
    Ok((columns.log_table(), columns.run.clone()))
}

/// The tables of a truth, but for those that are not there because an earlier version wrote it, or because it was to be brief.
pub fn truth_tables(is_there: impl Fn(&str) -> bool) -> Vec<Table> {
    truth::tables_of(is_there)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(numbers: &[i64]) -> Check {
        let mut all = RowNumbers::default();
        numbers.iter().for_each(|&number| all.push(number));
        all.check("run 1")
    }

    #[test]
    fn gaps_and_doubles_are_found() {
        let whole = Check::ok("rows", "run 1: 3 rows, numbered from 0 without a gap");
        assert_eq!(check(&[0, 1, 2]), Check { rows: Some(3), ..whole });
        let gap = check(&[1, 2, 5]);
        assert_eq!(gap.verdict, CheckVerdict::Wrong);
        assert_eq!(gap.says, "run 1: of 3 rows, 3 numbers are missing, the first is 0");
        let again = check(&[0, 1, 1, 0, 2]);
        assert_eq!(again.says, "run 1: of 5 rows, 2 rows have numbers that were there before, the first is 1");
        assert_eq!(check(&[i64::MAX, i64::MIN]).verdict, CheckVerdict::Wrong);
    }
}
