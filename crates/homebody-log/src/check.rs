//! What is said of a place that was looked at: checks, each with what was found and what to do.

use crate::error::LogError;
use crate::url::Url;
use homebody_core::problem::readable;
use homebody_core::scenario::logger::LoggerFile;
use serde::Serialize;

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

    /// The same, said of a part of what was looked at.
    pub fn of(self, part: &str) -> Check {
        Check { says: format!("{part}: {}", self.says), ..self }
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
