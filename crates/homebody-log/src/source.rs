//! The forms of logs that can be read, one file for each: ours, and those of real homes.

pub(crate) mod casas;
pub(crate) mod columns;
pub(crate) mod csv;
pub(crate) mod domoticz;
pub(crate) mod each_second;
pub(crate) mod foreign;
pub(crate) mod gateways;
mod gathered;
pub(crate) mod home_assistant;
mod in_order;
pub(crate) mod influx;
pub(crate) mod instant;
pub(crate) mod intervals;
pub(crate) mod json;
pub(crate) mod labels;
pub(crate) mod lines;
pub(crate) mod messages;
pub(crate) mod mit;
pub(crate) mod openhab;
pub(crate) mod options;
pub(crate) mod psql;
pub(crate) mod reading;
pub(crate) mod records;
pub(crate) mod sqlite;
pub(crate) mod start;
pub(crate) mod table_files;
pub(crate) mod xes;

use crate::error::LogError;
use crate::table::Table;
use crate::url::Url;
pub use columns::ColumnPlaces;
pub(crate) use each_second::{ARAS, day_of};
pub(crate) use foreign::{foreign_kind, no_text};
pub(crate) use gateways::{esphome, mosquitto, tasmota, zigbee2mqtt};
use homebody_core::scenario::logger::LoggerFile;
pub(crate) use instant::{InstantReader, instant_of_cell};
pub use instant::{LogInstant, since_1970};
pub(crate) use json::jsonl;
pub(crate) use labels::LabelTable;
pub(crate) use lines::LineReader;
pub use options::{DateOrder, DecimalMark, HomeColumn, TableOptions};
pub use reading::LogReading;
pub(crate) use reading::open;
pub(crate) use records::RecordReader;
pub use start::FileStart;
use std::fmt;
use std::path::Path;

/// A form of logs.
pub struct LogForm {
    /// The text before the colon, such as `casas`.
    pub name: &'static str,
    /// A description in words.
    pub what: &'static str,
    /// The content that the beginning of a file shows in this form.
    pub shows: fn(&FileStart) -> Shows,
    /// Reads a log of this form row by row, from its file or from what a server is reached by.
    pub read: fn(&Path, &LoggerFile, &mut LogReading<'_>) -> Result<(), LogError>,
}

/// The content that the beginning of a file shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shows {
    /// It is of another form.
    Nothing,
    /// It has activities and no sensors.
    Activities,
    /// It tells what sensors said.
    Rows,
}

impl Shows {
    /// Rows where this holds.
    pub fn rows_if(is_so: bool) -> Shows {
        if is_so { Shows::Rows } else { Shows::Nothing }
    }
}

impl PartialEq for LogForm {
    fn eq(&self, other: &LogForm) -> bool {
        self.name == other.name
    }
}

impl Eq for LogForm {}

impl fmt::Debug for LogForm {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.name)
    }
}

/// A cell of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TruthValue<'v> {
    /// Nothing: unknown, or it does not apply.
    Null,
    /// A whole number.
    Integer(i64),
    /// A number with a fraction, in the column's unit.
    Real(f64),
    /// A text; an instant, too, where a place keeps it as one.
    Text(&'v str),
    /// An instant where a place has a type for it.
    Instant(LogInstant),
}

/// Takes a row: the index of its table among those that are wanted, and its cells in the order of the table's columns.
pub type TakeTruthRow<'t> = dyn FnMut(usize, &[TruthValue<'_>]) -> Result<(), LogError> + 't;

/// Reads all rows of some tables, each table's in the order of writing. Missing tables and columns are one error: [`LogError::NoTruth`].
pub type ReadTables = fn(&Url, &[&Table], &mut TakeTruthRow<'_>) -> Result<(), LogError>;
