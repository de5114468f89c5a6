//! `logger.json` checked: the names and texts under which rows are stored.

use super::{Cell, Column, ColumnKind, LOG, Table, TextPool};
use crate::error::LogError;
use homebody_core::event::Value;
use homebody_core::scenario::logger::{LoggerFile, MessagesFile, TimeFormat};
use std::collections::BTreeMap;
use std::fmt::Write;

/// The table of runs.
const RUN_TABLE: &str = "run";

/// The names of a row's parts in a database or in a header line.
#[derive(Clone, Debug)]
pub(crate) struct ColumnNames {
    pub table: String,
    pub run: String,
    pub seq: String,
    pub time: String,
    pub sensor: String,
    pub value: String,
}

/// The texts of each sensor and each value in a log, and its format of time.
#[derive(Clone, Debug)]
pub(crate) struct ShownTexts {
    pub sensors: Vec<String>,
    /// The texts of ON and OFF.
    pub values: [String; 2],
    pub time: TimeFormat,
}

impl ColumnNames {
    /// The names of a mapping, if all of them may reach SQL.
    pub fn new(file: &LoggerFile) -> Result<ColumnNames, LogError> {
        let columns = &file.columns;
        let table = file.table.clone().unwrap_or_else(|| "firing".into());
        checked_name("table", &table)?;
        if table == RUN_TABLE {
            return Err(LogError::SameName { what: "table", name: table });
        }
        let names = [&columns.run, &columns.seq, &columns.time, &columns.sensor, &columns.value];
        for (index, name) in names.iter().enumerate() {
            checked_name("column", name)?;
            if names[..index].contains(name) {
                return Err(LogError::SameName { what: "column", name: name.to_string() });
            }
        }
        Ok(ColumnNames {
            table,
            run: columns.run.clone(),
            seq: columns.seq.clone(),
            time: columns.time.clone(),
            sensor: columns.sensor.clone(),
            value: columns.value.clone(),
        })
    }
}

impl ColumnNames {
    /// The table of a log under these names.
    pub fn log_table(&self) -> Table {
        let column = |name: &String, kind, about| Column { name: name.clone(), kind, unit: "", about };
        Table {
            name: self.table.clone(),
            about: LOG,
            columns: vec![
                column(&self.seq, ColumnKind::Integer, "the number of the row in its run, from 0"),
                column(&self.time, ColumnKind::Instant, "when the logger says that it was said"),
                column(&self.sensor, ColumnKind::Text, "the sensor's id in the log"),
                column(&self.value, ColumnKind::Text, "what it said, such as ON or 21.5"),
            ],
            is_numbered: true,
            is_frequent: true,
        }
    }
}

impl ShownTexts {
    /// The sensors under the network's own ids, and the two values of the kind of messages, ON first.
    pub fn new(file: &LoggerFile, sensors: &[String]) -> Result<ShownTexts, LogError> {
        let values = match &file.messages {
            MessagesFile::FireOnly | MessagesFile::OnOff(_) => ["ON", "OFF"],
            MessagesFile::Occupancy(_) => ["true", "false"],
        };
        let shown = sensors.iter().map(|name| file.ids.get(name).unwrap_or(name).clone()).collect();
        apart(sensors, &shown)?;
        Ok(ShownTexts { sensors: shown, values: values.map(String::from), time: file.time })
    }

    /// The text of what a row says; `buffer` is where it is put together if it has to be.
    pub fn value<'a>(&'a self, value: Value, buffer: &'a mut String) -> &'a str {
        match value {
            Value::Fire | Value::On => &self.values[0],
            Value::Off => &self.values[1],
            value => {
                buffer.clear();
                // A string takes whatever is written to it.
                let _ = write!(buffer, "{value}");
                buffer
            }
        }
    }

    /// The same as a cell.
    pub fn cell(&self, value: Value, texts: &mut TextPool) -> Cell {
        match value {
            Value::Fire | Value::On => Cell::Text(texts.id(&self.values[0])),
            Value::Off => Cell::Text(texts.id(&self.values[1])),
            Value::Reading(number) => Cell::Thousandths(number),
            value => Cell::Text(texts.id(&value.to_string())),
        }
    }
}

/// Refuses a log in which two sensors have the same text.
pub(crate) fn apart(sensors: &[String], shown: &Vec<String>) -> Result<(), LogError> {
    let mut seen = BTreeMap::new();
    for (name, shown) in sensors.iter().zip(shown) {
        if let Some(first) = seen.insert(shown, name) {
            return Err(LogError::SameSensor { first: first.clone(), second: name.clone(), shown: shown.clone() });
        }
    }
    Ok(())
}

/// Checks a name that reaches SQL: `^[a-z_][a-z0-9_]{0,62}$`, and not reserved by the database.
fn checked_name(what: &'static str, name: &str) -> Result<(), LogError> {
    let letters = |byte: u8| byte.is_ascii_lowercase() || byte == b'_';
    let fits = name.len() <= 63
        && name.bytes().next().is_some_and(letters)
        && name.bytes().all(|byte| letters(byte) || byte.is_ascii_digit())
        && !name.starts_with("sqlite_");
    if fits { Ok(()) } else { Err(LogError::Name { what, name: name.into() }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_plain_names_reach_sql() {
        for name in ["firing", "_x1", "select", &"a".repeat(63)] {
            let file = LoggerFile { table: Some(name.into()), ..Default::default() };
            assert!(ColumnNames::new(&file).is_ok(), "{name}");
        }
        for name in ["", "1a", "Firing", "a b", "a\"; drop table run; --", "sqlite_x", "é", "run", &"a".repeat(64)] {
            let file = LoggerFile { table: Some(name.into()), ..Default::default() };
            assert!(ColumnNames::new(&file).is_err(), "{name}");
            let mut file = LoggerFile::default();
            file.columns.time = name.into();
            assert_eq!(ColumnNames::new(&file).is_err(), name != "run", "{name}");
        }
    }

    #[test]
    fn a_column_used_twice_is_refused() {
        let mut file = LoggerFile::default();
        file.columns.time = "value".into();
        assert!(matches!(ColumnNames::new(&file), Err(LogError::SameName { .. })));
    }

    #[test]
    fn sensors_are_shown_by_their_ids_and_stay_apart() {
        let sensors = ["hall motion".to_string(), "fridge".to_string()];
        let mut file = LoggerFile::default();
        file.ids.insert("hall motion".into(), "A1".into());
        assert_eq!(ShownTexts::new(&file, &sensors).unwrap().sensors, ["A1", "fridge"]);
        file.ids.insert("fridge".into(), "A1".into());
        assert!(matches!(ShownTexts::new(&file, &sensors), Err(LogError::SameSensor { .. })));
    }
}
