//! Rows of named values for programs: what was found in a log, as lines of JSON or as a table of a database.

use crate::error::LogError;
use rusqlite::types::Value as Cell;
use rusqlite::{Connection, OptionalExtension, params_from_iter};
use serde_json::{Map, Value};
use std::path::Path;

/// Rows of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Records {
    /// Their kind, such as `alert`: what the table is called, and each line's `kind`.
    pub kind: &'static str,
    /// The names of the values, in order.
    pub columns: &'static [&'static str],
    /// A row has a value for each name, in any order; what it lacks is null.
    pub rows: Vec<Map<String, Value>>,
}

impl Records {
    /// As text: a JSON object a line.
    pub fn lines(&self) -> String {
        let line = |row: &Map<String, Value>| {
            let kind = ("kind".to_owned(), Value::from(self.kind));
            let values =
                self.columns.iter().map(|name| ((*name).to_owned(), row.get(*name).cloned().unwrap_or_default()));
            Value::Object([kind].into_iter().chain(values).collect()).to_string() + "\n"
        };
        self.rows.iter().map(line).collect()
    }

    /// Stores them in a table of a database, which is created if necessary; other tables stay unchanged. An existing table is replaced
    /// with `force` only.
    ///
    /// # Errors
    ///
    /// If the table exists, or the database cannot be written.
    pub fn store(&self, path: &Path, force: bool) -> Result<(), LogError> {
        let stored = self.store_in(path, force).map_err(|error| LogError::database(path, error))?;
        if stored {
            Ok(())
        } else {
            Err(LogError::Exists { place: format!("table {} of {}", self.kind, path.display()) })
        }
    }

    fn store_in(&self, path: &Path, force: bool) -> Result<bool, rusqlite::Error> {
        let mut connection = Connection::open(path)?;
        let step = connection.transaction()?;
        let there = "select 1 from sqlite_master where type = 'table' and name = ?1";
        let is_there = step.query_row(there, [self.kind], |_| Ok(())).optional()?.is_some();
        if is_there && !force {
            return Ok(false);
        }
        let quoted: Vec<String> = self.columns.iter().map(|name| format!("\"{name}\"")).collect();
        step.execute_batch(&format!(
            "drop table if exists \"{0}\"; create table \"{0}\" ({1})",
            self.kind,
            quoted.join(", ")
        ))?;
        let marks = vec!["?"; self.columns.len()].join(", ");
        let mut insert = step.prepare(&format!("insert into \"{}\" values ({marks})", self.kind))?;
        for row in &self.rows {
            insert.execute(params_from_iter(self.columns.iter().map(|name| cell(row.get(*name)))))?;
        }
        drop(insert);
        step.commit()?;
        Ok(true)
    }
}

/// The cell of a value; lists and objects become JSON.
fn cell(value: Option<&Value>) -> Cell {
    match value {
        None | Some(Value::Null) => Cell::Null,
        Some(Value::Bool(is_so)) => Cell::Integer(i64::from(*is_so)),
        Some(Value::Number(number)) => match number.as_i64() {
            Some(whole) => Cell::Integer(whole),
            None => number.as_f64().map_or(Cell::Null, Cell::Real),
        },
        Some(Value::String(text)) => Cell::Text(text.clone()),
        Some(other) => Cell::Text(other.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn alerts() -> Records {
        let row = |day: &str, value: Value| match json!({ "date": day, "value": value, "shown_by": [day] }) {
            Value::Object(row) => row,
            _ => Map::new(),
        };
        let rows = vec![row("2024-01-01", json!(1.5)), row("2024-01-02", Value::Null)];
        Records { kind: "alert", columns: &["date", "value", "shown_by"], rows }
    }

    #[test]
    fn a_line_is_an_object() {
        let lines = alerts().lines();
        let first: Value = serde_json::from_str(lines.lines().next().unwrap()).unwrap();
        assert_eq!(first, json!({ "kind": "alert", "date": "2024-01-01", "value": 1.5, "shown_by": ["2024-01-01"] }));
        assert_eq!(lines.lines().count(), 2);
    }

    #[test]
    fn replaces_a_table_only_with_force() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("care.db");
        alerts().store(&path, false).unwrap();
        assert!(matches!(alerts().store(&path, false), Err(LogError::Exists { .. })));
        alerts().store(&path, true).unwrap();
        let other = Records { kind: "sentence", ..alerts() };
        other.store(&path, false).unwrap();
        let connection = Connection::open(&path).unwrap();
        let rows = "select count(*), sum(value), max(shown_by) from alert";
        let found = connection.query_row(rows, [], |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?))).unwrap();
        assert_eq!(found, (2, 1.5, "[\"2024-01-02\"]".to_owned()));
    }
}
