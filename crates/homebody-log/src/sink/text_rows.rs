//! A destination of text, a row a line, in any form of text.

use super::text::{TextSink, TextTarget};
use super::{Begin, Sink, Watermark};
use crate::error::LogError;
use crate::table::{Batch, BatchRow, Cell, InstantWriter, Table, TextId};
use crate::url::Url;
use homebody_core::event::Value;
use homebody_core::scenario::scheme::Scheme;
use homebody_core::time::RunTime;
use std::fmt::Write;

/// A form of text with a row a line: all that one such form has of its own.
pub(crate) trait TextForm: Sized + Send + 'static {
    const SCHEME: Scheme;

    /// Whether the file of a run has its name from its first line on, so that others can follow it. Other forms do so where they are
    /// asked to.
    const IS_FOLLOWED: bool = false;

    /// Prepares to write the rows of a run to `at`, or refuses tables that the form cannot hold.
    fn begin(at: &TextTarget, begin: &Begin) -> Result<Self, LogError>;

    /// The first line of a table, without its end.
    fn header(_: &Table) -> Option<String> {
        None
    }

    /// Takes a new text of the rows to come, in the order of their numbers.
    fn learn(&mut self, at: &TextTarget, text: &str) -> Result<(), LogError>;

    /// Appends the line of a row, without its end.
    fn line(&mut self, row: &BatchRow, line: &mut Vec<u8>);
}

/// Text files of a row a line, one for each table.
pub(crate) struct TextRows<F> {
    at: TextTarget,
    is_followed: bool,
    open: Option<OpenText<F>>,
}

struct OpenText<F> {
    form: F,
    files: Vec<TextSink>,
    /// By table.
    rows: Vec<u64>,
    texts: usize,
    line: Vec<u8>,
}

impl<F: TextForm> TextRows<F> {
    /// The sink of a place; a file that `is_followed` has its name from its first line on.
    pub fn at(url: &Url, is_followed: bool) -> Box<dyn Sink> {
        Box::new(TextRows::<F> { at: TextTarget::from_url(url), is_followed, open: None })
    }
}

impl<F: TextForm> Sink for TextRows<F> {
    fn begin(&mut self, begin: &Begin) -> Result<Watermark, LogError> {
        let form = F::begin(&self.at, begin)?;
        let is_followed = if F::IS_FOLLOWED { !begin.is_whole } else { self.is_followed };
        let mut files = Vec::new();
        for (table, at) in begin.tables.iter().zip(self.at.for_tables(F::SCHEME, &begin.tables)?) {
            let mut file = TextSink::begin(&at, begin.how, is_followed, &begin.deadline)?;
            if let Some(header) = F::header(table) {
                file.line(format!("{header}\n").as_bytes())?;
            }
            files.push(file);
        }
        let rows = vec![0; files.len()];
        self.open = Some(OpenText { form, files, rows, texts: 0, line: Vec::new() });
        Ok(Watermark::none())
    }

    fn write(&mut self, batch: &Batch) -> Result<(), LogError> {
        let stopped = || LogError::Stopped { place: self.at.place() };
        let OpenText { form, files, rows, texts, line } = self.open.as_mut().ok_or_else(stopped)?;
        for text in batch.texts_from(*texts) {
            form.learn(&self.at, &text)?;
            *texts += 1;
        }
        for row in batch.rows() {
            line.clear();
            form.line(&row, line);
            line.push(b'\n');
            files[row.table].line(line)?;
            rows[row.table] += 1;
        }
        files.iter_mut().try_for_each(TextSink::show)
    }

    fn make_durable(&mut self) -> Result<Watermark, LogError> {
        let Some(open) = &mut self.open else { return Ok(Watermark::none()) };
        let files = open.files.iter_mut().zip(&open.rows);
        let durable = files.map(|(file, &rows)| Ok(if file.make_durable()? { rows } else { 0 }));
        Ok(Watermark(durable.collect::<Result<_, LogError>>()?))
    }

    fn finish(&mut self, _end: RunTime) -> Result<(), LogError> {
        self.open.take().into_iter().flat_map(|open| open.files).try_for_each(TextSink::finish)
    }
}

pub(crate) struct CellWriter {
    pub clock: InstantWriter,
    /// By number, as the form writes them.
    pub texts: Vec<String>,
    number: String,
}

impl CellWriter {
    pub fn new(clock: InstantWriter) -> CellWriter {
        CellWriter { clock, texts: Vec::new(), number: String::new() }
    }

    /// The text of a cell; None for an empty cell.
    pub fn text(&mut self, cell: Cell) -> Option<&str> {
        self.number.clear();
        // A string takes all that is written to it.
        let _ = match cell {
            Cell::Null => return None,
            Cell::Instant(at) => return Some(self.clock.text(at)),
            Cell::Text(TextId(id)) => return Some(&self.texts[id as usize]),
            Cell::Integer(number) => write!(self.number, "{number}"),
            Cell::Real(number) => write!(self.number, "{number}"),
            Cell::Thousandths(value) => write!(self.number, "{}", Value::Reading(value)),
        };
        Some(&self.number)
    }
}
