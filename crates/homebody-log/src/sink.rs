//! Destinations of rows: one file for each kind of place, all in the shape of [`Sink`]; the registry opens them.

pub(crate) mod casas;
pub(crate) mod csv;
pub(crate) mod database;
pub(crate) mod fleet;
pub(crate) mod fleet_jsonl;
pub(crate) mod jsonl;
pub(crate) mod sqlite;
pub(crate) mod text;
pub(crate) mod text_rows;
pub(crate) mod whole;

use crate::error::LogError;
use crate::files::WriteMode;
use crate::policy::{Cancel, Deadline};
use crate::run::RunInfo;
use crate::table::{Batch, InstantWriter, Table};
pub(crate) use casas::Casas;
pub(crate) use csv::Csv;
pub use csv::csv_line;
pub(crate) use fleet::{Fleet, FleetEvent, FleetSink};
pub(crate) use fleet_jsonl::FleetJsonl;
use homebody_core::scenario::logger::TimeFormat;
use homebody_core::time::RunTime;
pub(crate) use jsonl::Jsonl;
use std::sync::Arc;
pub(crate) use text_rows::TextRows;
pub(crate) use whole::Whole;

/// A destination of rows: a file, a database, a broker, or a caller's own.
///
/// The order of calls: [`begin`](Sink::begin) once, then any number of [`write`](Sink::write) and [`make_durable`](Sink::make_durable),
/// then [`finish`](Sink::finish), or drop if the run is given up. All calls come from one thread, which is the destination's own: a slow
/// one makes the run wait, or not, by its [`Policy`](crate::Policy). One that takes longer than `begin.deadline` for one request hangs.
/// For the run that is an error that passes, and the same call, made again, gets the answer of the first.
///
/// Rows come in the order of the run, without gaps. After an error that [`passes`](LogError::passes) the same call is made again, if the
/// policy says so: the destination must not store its rows twice. After any other error the only further call is drop.
pub trait Sink: Send {
    /// Begins a run, or resumes it if `begin.how` says so. Returns how many rows the destination holds of this run: these are not given
    /// again. A destination that wants to compare them returns the beginning.
    fn begin(&mut self, begin: &Begin) -> Result<Watermark, LogError>;

    /// Takes rows. They may be lost until the next `make_durable`.
    fn write(&mut self, batch: &Batch) -> Result<(), LogError>;

    /// Makes sure of the rows taken, as far as it can by now. Returns up to where all rows are durable: they survive the
    /// death of this program, and that of the machine where the destination can promise it.
    fn make_durable(&mut self) -> Result<Watermark, LogError>;

    /// Makes sure of everything, and marks the run as ended at an instant.
    fn finish(&mut self, end: RunTime) -> Result<(), LogError>;

    /// Whether it holds rows back and needs further calls to make them durable, even without new rows.
    fn is_behind(&self) -> bool {
        false
    }
}

/// The parameters of a destination's beginning.
#[derive(Clone, Debug)]
pub struct Begin {
    /// The run, with its sensors.
    pub run: Arc<RunInfo>,
    /// The tables that rows will be of: one of a log, several of the truth.
    pub tables: Arc<Vec<Table>>,
    /// The format of instants, by the run's mapping.
    pub time: TimeFormat,
    /// The name of the column of the run's id, by the run's mapping.
    pub run_column: String,
    /// Whether texts that a spreadsheet would run are escaped in CSV, by the run's mapping.
    pub spreadsheet_safe: bool,
    /// The treatment of existing files.
    pub how: WriteMode,
    /// Whether files have their names only once all rows are in them. Otherwise those that others can follow have them earlier.
    pub is_whole: bool,
    /// Once it says so, a destination that is away is not to be waited for any more, in this call and in later ones.
    pub cancel: Cancel,
    /// The time for one request. A sink with several requests in a call tells it so.
    pub deadline: Deadline,
}

impl Begin {
    /// A beginning with the usual name of the run's column, and with the usual deadline.
    pub fn new(run: Arc<RunInfo>, tables: Vec<Table>, time: TimeFormat, how: WriteMode) -> Begin {
        Begin {
            run,
            tables: Arc::new(tables),
            time,
            run_column: "run_id".into(),
            spreadsheet_safe: false,
            how,
            is_whole: false,
            cancel: Cancel::new(),
            deadline: Deadline::default(),
        }
    }

    /// A clock that writes instants as the run's mapping wants them.
    pub fn clock(&self) -> InstantWriter {
        InstantWriter::new(&self.run.calendar, self.time)
    }
}

/// How many rows of a run a destination holds, by table. They are the first ones, without gaps.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Watermark(pub Vec<u64>);

impl Watermark {
    /// The beginning: no rows.
    pub fn none() -> Watermark {
        Watermark::default()
    }

    /// The number of durable rows of a table.
    pub fn of(&self, table: usize) -> u64 {
        self.0.get(table).copied().unwrap_or(0)
    }
}
