//! A database file: the rows in a table as the network has it, and the table `run` beside it.

use super::Opening;
use super::database::{Database, Insert};
use super::run;
use crate::clock::Clock;
use crate::error::LogError;
use crate::mapping::Shown;
use crate::messages::Row;
use crate::writer::Sink;
use homebody_core::time::Micros;
use std::path::Path;

/// A database file of a row a row.
pub(crate) struct Sqlite {
    database: Database,
    insert: Insert,
    clock: Clock,
    shown: Shown,
    value: String,
    run: i64,
}

impl Sqlite {
    pub fn open(path: &Path, opening: &Opening) -> Result<Sqlite, LogError> {
        let (columns, shown) = (opening.columns, opening.shown);
        // Without a rowid the key is the table itself rather than an index beside it: smaller and faster.
        let tables = format!(
            "CREATE TABLE \"{}\" (\"{}\" INTEGER, \"{}\" INTEGER, \"{}\" {}, \"{}\" TEXT, \"{}\" TEXT, \
             PRIMARY KEY (\"{}\", \"{}\")) WITHOUT ROWID",
            columns.table,
            columns.run,
            columns.seq,
            columns.time,
            run::time_type(shown.time),
            columns.sensor,
            columns.value,
            columns.run,
            columns.seq,
        );
        let mut clock = opening.clock();
        let begin = run::begin(opening.run, shown.time, &mut clock);
        let database = Database::create(path, opening.force, &[&tables], begin)?;
        let names = [&columns.seq, &columns.time, &columns.sensor, &columns.value].map(String::as_str);
        Ok(Sqlite {
            database,
            insert: Insert::new(&columns.table, (&columns.run, opening.run.id), &names),
            clock,
            shown: shown.clone(),
            value: String::new(),
            run: opening.run.id,
        })
    }
}

impl Sink for Sqlite {
    type Row = Row;

    fn path(&self) -> &Path {
        self.database.path()
    }

    fn write(&mut self, rows: &[Row]) -> Result<(), LogError> {
        self.database.change(rows.len(), |connection| {
            self.insert.rows(connection, rows, |row, binding| {
                binding.put(row.seq as i64)?;
                binding.put(self.clock.stamp(row.at))?;
                binding.put(&self.shown.sensors[row.sensor.index()])?;
                binding.put(self.shown.value(row.value, &mut self.value))
            })
        })
    }

    fn settle(&mut self) -> Result<(), LogError> {
        self.database.settle()
    }

    fn finish(mut self: Box<Self>, end: Micros) -> Result<(), LogError> {
        run::end(&mut self.database, self.run, self.clock.stamp(end))?;
        self.database.close()
    }
}
