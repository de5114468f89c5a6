//! All rows of one table of a truth, wherever it is, with instants on the run's own clock.

use super::database::{instant, text};
use super::instant::Instants;
use super::recorded_truth::RecordedTruth;
use super::run_clock::RunClock;
use super::tables::Value;
use super::turns::Turns;
use crate::error::LogError;
use crate::table::{ColumnKind, Table};
use crate::truth::{Truth, tables};
use crate::url::Url;
use homebody_core::time::Micros;
use rusqlite::Row;
use rusqlite::types::ValueRef;
use std::collections::HashMap;

/// Gives the rows of a table of a truth in the order in which they were written, with their cells in the order of the columns of
/// [`tables`]. An instant is a [`Value::Integer`]: microseconds since the run's start, by the clock of its files, or as
/// [`RunClock::as_told`] has it.
///
/// # Errors
///
/// [`LogError::NoTruth`] if there is none in this place, or none with this table; those of `take`.
pub fn truth_rows(
    url: &Url,
    table: Truth,
    clock: &RunClock,
    take: &mut dyn FnMut(&[Value<'_>]) -> Result<(), LogError>,
) -> Result<(), LogError> {
    let truth = RecordedTruth::open(url, &[table])?;
    let clock = truth.clock(clock);
    let turns = Turns::new(&truth, &clock)?;
    let table = &tables()[table as usize];
    let columns: Vec<String> = table.columns.iter().map(|column| format!("{:?}", column.name)).collect();
    let sql = format!("SELECT {} FROM {:?} ORDER BY rowid", columns.join(", "), table.name);
    let failed = |error| truth.error(error);
    let mut statement = truth.connection.prepare(&sql).map_err(failed)?;
    let mut rows = statement.query([]).map_err(failed)?;
    let mut reader = Reader { table, turns, instants: Instants::default(), last: HashMap::new() };
    while let Some(row) = rows.next().map_err(failed)? {
        take(&reader.cells(row).map_err(failed)?)?;
    }
    Ok(())
}

struct Reader<'t> {
    table: &'t Table,
    turns: Turns,
    instants: Instants,
    /// The last instant that was read, by whose it was.
    last: HashMap<String, Micros>,
}

impl Reader<'_> {
    fn cells<'r>(&mut self, row: &'r Row) -> rusqlite::Result<Vec<Value<'r>>> {
        let who = self.table.column("resident").map(|column| row.get_ref(column)).transpose()?;
        let who = who.map_or_else(String::new, |who| text(who).into_owned());
        let mut cells = Vec::with_capacity(self.table.columns.len());
        for (index, column) in self.table.columns.iter().enumerate() {
            cells.push(match (column.kind, row.get_ref(index)?) {
                (ColumnKind::Instant, _) => match instant(row, index, &mut self.instants)? {
                    None => Value::Null,
                    Some(at) => Value::Integer(self.turned(&who, at)),
                },
                (ColumnKind::Real, ValueRef::Integer(number)) => Value::Real(number as f64),
                (_, ValueRef::Integer(number)) => Value::Integer(number),
                (_, ValueRef::Real(number)) => Value::Real(number),
                // What is empty is nothing, as in files of text.
                (_, ValueRef::Text(bytes)) if !bytes.is_empty() => Value::Text(str::from_utf8(bytes).unwrap_or("")),
                _ => Value::Null,
            });
        }
        Ok(cells)
    }

    fn turned(&mut self, who: &str, at: Micros) -> Micros {
        let last = self.last.get_mut(who);
        let turned = self.turns.turn(who, at, last.as_ref().map_or(Micros::MIN, |last| **last));
        match last {
            Some(last) => *last = turned,
            None => _ = self.last.insert(who.to_owned(), turned),
        }
        turned
    }
}
