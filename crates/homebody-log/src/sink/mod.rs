//! Where rows end up: one file each kind of place, all in the shape of [`Sink`](crate::writer::Sink).

pub(crate) mod casas;
pub(crate) mod csv;
pub(crate) mod database;
pub(crate) mod run;
pub(crate) mod sqlite;

use crate::clock::Clock;
use crate::error::LogError;
use crate::logger::RunInfo;
use crate::mapping::{Columns, Shown};
use crate::messages::Row;
use crate::url::Url;
use crate::writer::Sink;
use homebody_core::scenario::calendar::Calendar;

/// What every sink of a log is opened with.
pub(crate) struct Opening<'a> {
    pub columns: &'a Columns,
    pub shown: &'a Shown,
    pub calendar: &'a Calendar,
    pub run: &'a RunInfo,
    pub force: bool,
}

impl Opening<'_> {
    /// Opens the sink of a place.
    pub fn open(&self, url: &Url) -> Result<Box<dyn Sink<Row = Row>>, LogError> {
        Ok(match url {
            Url::Sqlite(path) => Box::new(sqlite::Sqlite::open(path, self)?),
            Url::Csv(path) => Box::new(csv::Csv::open(path, self)?),
            Url::Casas(path) => Box::new(casas::Casas::open(path, self)?),
        })
    }

    fn clock(&self) -> Clock {
        Clock::new(self.calendar, self.shown.time)
    }
}
