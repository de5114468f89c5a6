//! What is wrong with a place that has a log or a truth: checks, each with what was found and what to do. They only read, unless
//! it is said otherwise.

mod numbers;
mod sqlite;
mod text;

use crate::elsewhere;
use crate::error::LogError;
use crate::mapping::Columns;
use crate::source::Source;
use crate::table::Table;
use crate::truth;
use crate::url::Url;
use homebody_core::problem::readable;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::scenario::scheme::{SCHEMES, Scheme, Stands};
pub use numbers::{Numbers, found_of};
use serde::Serialize;
pub use sqlite::sqlite_version;

/// How it stands with what was looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
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
    /// How it stands.
    pub verdict: Verdict,
    /// What was looked at, in a word or two.
    pub about: String,
    /// What was found, as a sentence without its full stop. No password is ever in it.
    pub says: String,
    /// What to do about it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hint: Option<String>,
    /// How many rows of one run were counted, where they were.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rows: Option<u64>,
}

impl Check {
    /// It is as it should be.
    pub fn ok(about: &str, says: impl Into<String>) -> Check {
        Check { verdict: Verdict::Ok, about: about.into(), says: readable(says.into()), hint: None, rows: None }
    }

    /// It is not, and that may be meant.
    pub fn warning(about: &str, says: impl Into<String>, hint: impl Into<String>) -> Check {
        Check { verdict: Verdict::Warning, hint: Some(readable(hint.into())), ..Check::ok(about, says) }
    }

    /// It is not.
    pub fn wrong(about: &str, says: impl Into<String>, hint: impl Into<String>) -> Check {
        Check { verdict: Verdict::Wrong, hint: Some(readable(hint.into())), ..Check::ok(about, says) }
    }

    /// What an error says, which has a hint of its own or none.
    pub fn of_error(about: &str, error: &LogError) -> Check {
        let text = error.to_string();
        let (says, hint) = text.split_once("\n  hint: ").map_or((&*text, None), |(says, hint)| (says, Some(hint)));
        let hint = hint.map(|hint| readable(hint.to_owned()));
        Check { verdict: Verdict::Wrong, hint, ..Check::ok(about, says.replace('\n', "; ")) }
    }
}

/// How a place is looked at.
#[derive(Clone, Copy)]
pub struct Asked<'a> {
    /// What the log's table and columns are called.
    pub mapping: &'a LoggerFile,
    /// Whether something may be tried that leaves nothing behind, such as a message that no broker keeps.
    pub may_write: bool,
}

/// What looks at a place.
pub type Examine = fn(&Url, &Asked) -> Result<Vec<Check>, LogError>;

/// All that there is to say of a place.
///
/// # Errors
///
/// Only what is wrong with the words: [`LogError::NoPlace`], [`LogError::NotBuiltIn`], and names of a mapping that cannot be. All else is
/// a check.
pub fn examine(url: &Url, asked: &Asked) -> Result<Vec<Check>, LogError> {
    match url.scheme() {
        Scheme::Sqlite => sqlite::examine(url, asked),
        Scheme::Csv | Scheme::Jsonl | Scheme::Casas => text::examine(&url.into(), asked),
        scheme => {
            let elsewhere = elsewhere::of(scheme).ok_or_else(|| elsewhere::not_built_in(url))?;
            (elsewhere.examine)(url, asked)
        }
    }
}

/// The same of a log in whatever form, be it one that a run can go to or not.
///
/// # Errors
///
/// As [`examine`].
pub fn examine_log(log: &Source, asked: &Asked) -> Result<Vec<Check>, LogError> {
    let row = SCHEMES.iter().find(|row| row.name == log.form().name && row.stands != Stands::Server);
    match row {
        Some(row) => examine(&Url::new(row.scheme, log.path()), asked),
        None if log.is_server() => {
            let text = log.path().to_string_lossy().into_owned();
            examine(&text.parse()?, asked)
        }
        None => text::examine(log, asked),
    }
}

/// The table of a log by the names of a mapping, and what the column of the run's id is called.
///
/// # Errors
///
/// A name that no database takes, or one that is used twice.
pub fn log_table(mapping: &LoggerFile) -> Result<(Table, String), LogError> {
    let columns = Columns::new(mapping)?;
    Ok((columns.log_table(), columns.run.clone()))
}

/// The tables of a truth.
pub fn truth_tables() -> Vec<Table> {
    truth::tables()
}
