//! Stores a run's firings in as many places as wished.

use crate::destination::Destination;
use crate::destination::writer::{BATCH, BATCH_WAITS, Writer};
use crate::error::LogError;
use crate::files::{WriteMode, all_can_be_written};
use crate::policy::SinkMetrics;
use crate::run::RunInfo;
use crate::sink::{Begin, Watermark};
use crate::table::{Batch, Cell, ColumnNames, LogRow, Messages, ShownTexts, TextId, TextPool};
use crate::url::Url;
use homebody_core::event::{Firing, Value};
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::RunTime;
use std::sync::Arc;
use std::time::Instant;

/// Destinations of these places, after a check that all can be written.
pub fn destinations(urls: &[Url], how: WriteMode) -> Result<Vec<Destination>, LogError> {
    if how != WriteMode::Resume {
        let files: Vec<_> = urls.iter().filter_map(Url::file).collect();
        all_can_be_written(&files, how == WriteMode::Overwrite)?;
    }
    Ok(urls.iter().map(Destination::new).collect())
}

/// Stores firings as a scenario's `logger.json` says.
///
/// [`Logger::store`] what each advance of the run has brought, then [`Logger::finish`]. A logger that is dropped
/// unfinished has been given up: text files vanish, a database keeps what it holds. After an error the logger is of no
/// more use.
pub struct Logger {
    writers: Vec<Writer>,
    messages: Messages,
    shown: ShownTexts,
    texts: TextPool,
    ids: Vec<TextId>,
    /// The value of nearly all rows.
    on: Cell,
    /// Rows that were made by the last call, and rows that do not fill a batch yet.
    made: Vec<LogRow>,
    batch: Batch,
    sent_at: Instant,
    until: RunTime,
    stored: Stored,
    rows_of_firings: RowsOfFirings,
    failed: Option<String>,
}

/// The firing of each row of the log: it joins the truth to the log, in each mode of messages.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RowsOfFirings {
    /// Of each of the firings that were stored last, the row that tells of it: its own, or the ON that it prolongs.
    pub rows: Vec<u64>,
    /// The rows since then that say that a hold is over, with the last firing that was held.
    pub offs: Vec<(u64, u64)>,
}

/// The result of a logger.
#[derive(Debug, Default)]
pub struct Stored {
    /// Rows in each of the places.
    pub rows: u64,
    /// Rows of each sensor.
    pub by_sensor: Vec<u64>,
    /// Their places.
    pub places: Vec<String>,
    /// The destinations that the run could do without and that failed: each with its error.
    pub failed: Vec<(String, LogError)>,
    /// The error of a required destination that was away when the run was stopped: it lacks rows that the others have.
    pub away: Option<LogError>,
}

impl Logger {
    /// Opens all destinations, or none.
    pub fn open(
        destinations: Vec<Destination>,
        file: &LoggerFile,
        run: &Arc<RunInfo>,
        how: WriteMode,
    ) -> Result<Logger, LogError> {
        let columns = ColumnNames::new(file)?;
        let sensors = run.sensor_names();
        let shown = ShownTexts::new(file, &sensors)?;
        let beginning = Begin::new(run.clone(), vec![columns.log_table()], shown.time, how);
        let beginning = Begin { run_column: columns.run, spreadsheet_safe: file.spreadsheet_safe, ..beginning };
        let mut stored = Stored { by_sensor: vec![0; sensors.len()], ..Stored::default() };
        let mut writers = Vec::new();
        for destination in destinations {
            let (place, is_required) = (destination.place.clone(), destination.policy.required);
            match Writer::spawn(destination, &beginning) {
                Ok(writer) => writers.push(writer),
                Err(error) if is_required => return Err(error),
                Err(error) => stored.failed.push((place, error)),
            }
        }
        let mut texts = TextPool::default();
        Ok(Logger {
            writers,
            messages: Messages::new(&file.messages, run.seed, &sensors),
            ids: texts.ids(&shown.sensors),
            on: shown.cell(Value::On, &mut texts),
            shown,
            texts,
            made: Vec::new(),
            batch: Batch::with_capacity(BATCH, COLUMNS),
            sent_at: Instant::now(),
            until: RunTime::START,
            stored,
            rows_of_firings: RowsOfFirings::default(),
            failed: None,
        })
    }

    /// Stores firings: all from the last `until` to this one, in their order. Returns the rows that come from them.
    ///
    /// Rows wait a moment for others. A run in real time that is paused calls this without firings now and then, so that its last rows
    /// reach the log.
    pub fn store(&mut self, firings: &[Firing], until: RunTime) -> Result<&RowsOfFirings, LogError> {
        if let Some(place) = &self.failed {
            return Err(LogError::Stopped { place: place.clone() });
        }
        self.rows_of_firings.rows.clear();
        self.rows_of_firings.offs.clear();
        for firing in firings {
            let row = self.messages.firing(firing, &mut self.made);
            self.rows_of_firings.rows.push(row);
            self.take_made(row)?;
        }
        self.until = until;
        self.messages.quiet(until, &mut self.made);
        self.take_made(u64::MAX)?;
        if self.sent_at.elapsed() >= BATCH_WAITS {
            self.send()?;
        }
        Ok(&self.rows_of_firings)
    }

    /// The number of rows of the log that are durable in all places.
    pub fn durable(&self) -> Watermark {
        let rows = self.writers.iter().map(|writer| writer.durable().of(0)).min();
        Watermark(vec![rows.unwrap_or(0)])
    }

    /// Makes sure of all rows and gives the files their names. Sensors that are held ON stay so. That a destination was away when the run
    /// was stopped is in what was stored.
    pub fn finish(mut self) -> Result<Stored, LogError> {
        self.store(&[], self.until)?;
        self.send()?;
        let mut stored = std::mem::take(&mut self.stored);
        for writer in std::mem::take(&mut self.writers) {
            let (place, is_required) = (writer.place().to_owned(), writer.is_required());
            match writer.finish(self.until) {
                Err(error @ LogError::StoppedAway { .. }) if is_required => stored.away = Some(error),
                Err(error) if is_required => return Err(error),
                Err(error) => stored.failed.push((place, error)),
                Ok(()) => stored.places.push(place),
            }
        }
        Ok(stored)
    }

    /// Puts what was made into the batch; `own` is the row of the firing that was stored, the others end a hold.
    fn take_made(&mut self, own: u64) -> Result<(), LogError> {
        let mut made = std::mem::take(&mut self.made);
        for row in made.drain(..) {
            if row.seq != own {
                self.rows_of_firings.offs.push((row.seq, row.firing));
            }
            self.stored.by_sensor[row.sensor.index()] += 1;
            let value = match row.value {
                Value::Fire | Value::On => self.on,
                value => self.shown.cell(value, &mut self.texts),
            };
            let sensor = Cell::Text(self.ids[row.sensor.index()]);
            let cells: [Cell; COLUMNS] = [Cell::Integer(row.seq as i64), Cell::Instant(row.at), sensor, value];
            self.batch.push_of(row.firing, 0, cells);
            if self.batch.len() >= BATCH {
                self.send()?;
            }
        }
        // Nothing is in it any more, but it has room for the next rows.
        self.made = made;
        Ok(())
    }

    fn send(&mut self) -> Result<(), LogError> {
        self.sent_at = Instant::now();
        let batch = std::mem::replace(&mut self.batch, Batch::with_capacity(BATCH, COLUMNS)).with(&self.texts);
        self.stored.rows += batch.len() as u64;
        let batch = Arc::new(batch);
        self.each(|writer| if batch.is_empty() { writer.check() } else { writer.send(batch.clone()) })
    }

    /// Asks all places to make their rows durable, without a wait. Otherwise they do so when no rows come for a second, and at the end.
    pub fn make_durable(&mut self) -> Result<(), LogError> {
        self.send()?;
        self.each(Writer::make_durable)
    }

    /// Waits until all places have made sure of what they were asked to.
    pub fn wait_durable(&mut self) -> Result<(), LogError> {
        self.each(Writer::wait_durable)
    }

    /// Has each of the places do something. From then on the run does without those that fail, if it can.
    fn each(&mut self, mut act: impl FnMut(&mut Writer) -> Result<(), LogError>) -> Result<(), LogError> {
        let mut index = 0;
        while index < self.writers.len() {
            let writer = &mut self.writers[index];
            match act(writer) {
                Ok(()) => index += 1,
                // The run ends after this; the others are to hold all of it up to there.
                Err(error @ LogError::StoppedAway { .. }) if writer.is_required() => {
                    self.writers.remove(index);
                    self.stored.away = Some(error);
                }
                Err(error) if writer.is_required() => {
                    // After a gap in one place, the others stop too.
                    self.failed = Some(writer.place().to_owned());
                    self.writers.clear();
                    return Err(error);
                }
                Err(error) => {
                    let place = self.writers.remove(index).place().to_owned();
                    self.stored.failed.push((place, error));
                }
            }
        }
        Ok(())
    }

    pub(crate) fn meters(&self) -> impl Iterator<Item = (String, Arc<SinkMetrics>)> {
        self.writers.iter().map(Writer::meter)
    }

    /// Whether the run is past all rows that its places had.
    pub(crate) fn is_past_replayed_part(&self) -> bool {
        self.writers.iter().all(Writer::is_past_replayed_part)
    }

    pub(crate) fn rows(&self) -> u64 {
        self.stored.rows + self.batch.len() as u64
    }
}

/// Columns of a log: the row's number, the instant, the sensor, and what it said.
const COLUMNS: usize = 4;
