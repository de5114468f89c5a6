//! The tables that are looked for.

use crate::error::LogError;
use crate::mapping::Columns;
use crate::table::Table;
use crate::truth;
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

/// The tables of a truth, but for those that are not there because an earlier version wrote it, or because it was to be brief.
pub fn truth_tables(is_there: impl Fn(&str) -> bool) -> Vec<Table> {
    truth::tables_of(is_there)
}
