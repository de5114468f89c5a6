//! The tables that are looked for.

use crate::error::LogError;
use crate::mapping::Columns;
use crate::table::Table;
use crate::truth::{self, LATER};
use homebody_core::scenario::logger::LoggerFile;

/// The table of a log by the names of a mapping, and what the column of the run's id is called.
///
/// # Errors
///
/// A name that no database takes, or one that is used twice.
pub fn log_table(mapping: &LoggerFile) -> Result<(Table, String), LogError> {
    let columns = Columns::new(mapping)?;
    Ok((columns.log_table(), columns.run.clone()))
}

/// The tables of a truth, but for those that are not there because an earlier version wrote it.
pub fn truth_tables(is_there: impl Fn(&str) -> bool) -> Vec<Table> {
    let is_wanted = |table: &Table| !LATER.contains(&table.name.as_str()) || is_there(&table.name);
    truth::tables().into_iter().filter(is_wanted).collect()
}
