//! Checks of a place that has a log or a truth: each has a finding and advice. They only read, unless they say otherwise.

mod sqlite;
mod text;

pub use crate::check::{Check, CheckOptions, CheckVerdict, Examine, RowNumbers, found_of, log_table, truth_tables};
use crate::error::LogError;
use crate::read::LogSource;
use crate::registry;
use crate::url::Url;
use homebody_core::scenario::scheme::{SCHEMES, Scheme, Stands};
pub use sqlite::sqlite_version;

/// All that there is to say of a place.
///
/// # Errors
///
/// Only what is wrong with the words: [`LogError::NoPlace`], [`LogError::NotBuiltIn`], and names of a mapping that cannot be. All else is
/// a check.
pub fn examine(url: &Url, asked: &CheckOptions) -> Result<Vec<Check>, LogError> {
    match url.scheme() {
        Scheme::Sqlite => sqlite::examine(url, asked),
        scheme if scheme.row().stands == Stands::Text => text::examine(&url.into(), asked),
        _ => (registry::plugin(url)?.examine)(url, asked),
    }
}

/// The same of a log in whatever form, be it one that a run can go to or not.
///
/// # Errors
///
/// As [`examine`].
pub fn examine_log(log: &LogSource, asked: &CheckOptions) -> Result<Vec<Check>, LogError> {
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

/// Whether a host is this machine by its name, so that connections cross no network.
pub fn is_this_machine(host: &str) -> bool {
    ["localhost", "127.0.0.1", "::1"].contains(&host)
}
