//! Rows on their way into columns: those of one table, until they are enough to be written together.

use crate::frame::TextColumn;
use arrow_array::{ArrayRef, Float64Array, Int32Array, Int64Array, RecordBatch, TimestampMicrosecondArray};
use arrow_schema::{ArrowError, DataType, Schema, SchemaRef};
use homebody_log::table::InstantWriter;
use homebody_log::table::{Cell, TextId, thousandths};
use std::collections::HashMap;
use std::sync::Arc;

pub(crate) struct Columns {
    schema: SchemaRef,
    run: Option<i64>,
    columns: Vec<Values>,
    rows: usize,
    /// Whether texts keep their numbers for the whole file.
    are_texts_kept: bool,
}

enum Values {
    Instants(Vec<Option<i64>>),
    Integers(Vec<Option<i64>>),
    Reals(Vec<Option<f64>>),
    Texts(Dictionary),
}

#[derive(Default)]
struct Dictionary {
    column: TextColumn,
    /// By the number of a text in the run.
    of_texts: Vec<Option<i32>>,
    of_thousandths: HashMap<i32, i32>,
}

impl Columns {
    pub fn new(schema: SchemaRef, run: Option<i64>, are_texts_kept: bool) -> Columns {
        let values = |field: &Arc<arrow_schema::Field>| match field.data_type() {
            DataType::Timestamp(..) => Values::Instants(Vec::new()),
            DataType::Int64 => Values::Integers(Vec::new()),
            DataType::Float64 => Values::Reals(Vec::new()),
            _ => Values::Texts(Dictionary::default()),
        };
        let columns = schema.fields().iter().skip(usize::from(run.is_some())).map(values).collect();
        Columns { schema, run, columns, rows: 0, are_texts_kept }
    }

    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Adds a row; `texts` are those of the run.
    pub fn push(&mut self, cells: &[Cell], clock: &mut InstantWriter, texts: &[Arc<str>]) {
        for (column, &cell) in self.columns.iter_mut().zip(cells) {
            match (column, cell) {
                (Values::Instants(all), Cell::Instant(at)) => all.push(Some(clock.micros(at))),
                (Values::Integers(all), Cell::Integer(number)) => all.push(Some(number)),
                (Values::Reals(all), Cell::Real(number)) => all.push(Some(number)),
                (Values::Texts(all), Cell::Text(id)) => all.push_text(id, texts),
                (Values::Texts(all), Cell::Thousandths(number)) => all.push_thousandths(number),
                (Values::Instants(all) | Values::Integers(all), _) => all.push(None),
                (Values::Reals(all), _) => all.push(None),
                (Values::Texts(all), _) => all.column.rows.push(None),
            }
        }
        self.rows += 1;
    }

    /// The rows that wait, which wait no more.
    pub fn take(&mut self) -> Result<RecordBatch, ArrowError> {
        self.take_with(self.schema.clone(), |texts, rows| texts.array(rows))
    }

    /// The same with numbers in place of texts; [`Columns::texts`] has these.
    pub fn take_numbers(&mut self, schema: SchemaRef) -> Result<RecordBatch, ArrowError> {
        self.take_with(schema, |_, rows| Ok(Arc::new(rows.into_iter().collect::<Int32Array>())))
    }

    fn take_with(
        &mut self,
        schema: SchemaRef,
        texts_of: impl Fn(&TextColumn, Vec<Option<i32>>) -> Result<ArrayRef, ArrowError>,
    ) -> Result<RecordBatch, ArrowError> {
        let rows = std::mem::take(&mut self.rows);
        let run = self.run.map(|run| Arc::new(Int64Array::from_value(run, rows)) as ArrayRef);
        let first = usize::from(run.is_some());
        let mut arrays: Vec<ArrayRef> = run.into_iter().collect();
        for (column, field) in self.columns.iter_mut().zip(self.schema.fields().iter().skip(first)) {
            arrays.push(match column {
                Values::Instants(all) => {
                    let zone = match field.data_type() {
                        DataType::Timestamp(_, zone) => zone.clone(),
                        _ => None,
                    };
                    let instants = std::mem::take(all).into_iter().collect::<TimestampMicrosecondArray>();
                    Arc::new(instants.with_timezone_opt(zone))
                }
                Values::Integers(all) => Arc::new(std::mem::take(all).into_iter().collect::<Int64Array>()),
                Values::Reals(all) => Arc::new(std::mem::take(all).into_iter().collect::<Float64Array>()),
                Values::Texts(texts) => {
                    let rows = std::mem::take(&mut texts.column.rows);
                    let array = texts_of(&texts.column, rows)?;
                    if !self.are_texts_kept {
                        *texts = Dictionary::default();
                    }
                    array
                }
            });
        }
        RecordBatch::try_new(schema, arrays)
    }

    /// A row of nothing whose columns of texts know all texts that have come.
    pub fn texts(&self) -> Result<RecordBatch, ArrowError> {
        let fields = self.schema.fields().iter().filter(|field| matches!(field.data_type(), DataType::Dictionary(..)));
        let schema = Schema::new(fields.cloned().collect::<Vec<_>>());
        let mut arrays: Vec<ArrayRef> = Vec::new();
        for column in &self.columns {
            if let Values::Texts(texts) = column {
                arrays.push(texts.column.array(vec![None])?);
            }
        }
        let rows = arrow_array::RecordBatchOptions::new().with_row_count(Some(1));
        RecordBatch::try_new_with_options(Arc::new(schema), arrays, &rows)
    }
}

impl Dictionary {
    fn push_text(&mut self, TextId(id): TextId, texts: &[Arc<str>]) {
        let id = id as usize;
        if id >= self.of_texts.len() {
            self.of_texts.resize(id + 1, None);
        }
        let number = *self.of_texts[id].get_or_insert_with(|| self.column.number(&texts[id]));
        self.column.rows.push(Some(number));
    }

    fn push_thousandths(&mut self, value: i32) {
        let number = *self.of_thousandths.entry(value).or_insert_with(|| {
            let mut text = String::new();
            thousandths(value, &mut text);
            self.column.number(&text)
        });
        self.column.rows.push(Some(number));
    }
}
