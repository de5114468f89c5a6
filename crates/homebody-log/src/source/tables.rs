//! Tables of a truth, read by their names wherever they are: what a kind of place that keeps a truth must be able to do.

use super::instant::Instant;
use crate::error::LogError;
use crate::table::Table;
use crate::url::Url;

/// What a cell of a table says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value<'v> {
    /// Nothing: unknown, or it does not apply.
    Null,
    /// A whole number.
    Integer(i64),
    /// A number with a fraction, in the column's unit.
    Real(f64),
    /// A text; an instant, too, where a place keeps it as one.
    Text(&'v str),
    /// An instant where a place has a type for it.
    Instant(Instant),
}

/// Takes a row: of which table by its place among those that are wanted, and its cells in the order of the table's columns.
pub type TakeRow<'t> = dyn FnMut(usize, &[Value<'_>]) -> Result<(), LogError> + 't;

/// Gives all rows of some tables, each table's in the order in which they were written. What of them is not there is an error that
/// says all of it: [`LogError::NoTruth`].
pub type ReadTables = fn(&Url, &[&Table], &mut TakeRow<'_>) -> Result<(), LogError>;
