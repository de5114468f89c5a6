//! Columns in memory, for programs that pass tables on in Arrow's form.

use arrow_array::types::Int32Type;
use arrow_array::{
    ArrayRef, DictionaryArray, Float64Array, Int32Array, Int64Array, RecordBatch, RecordBatchOptions, StringArray,
    TimestampMicrosecondArray,
};
use arrow_schema::{ArrowError, Field, Schema};
use std::collections::HashMap;
use std::sync::Arc;

/// A table that is built column by column. All columns have the same number of rows.
#[derive(Default)]
pub struct ColumnTable {
    fields: Vec<Field>,
    arrays: Vec<ArrayRef>,
    rows: usize,
}

/// A column of texts that is filled row by row.
#[derive(Default)]
pub struct TextColumn {
    pub(crate) rows: Vec<Option<i32>>,
    /// Each text is in it once: some readers refuse a dictionary with duplicates.
    texts: Vec<Arc<str>>,
    known: HashMap<Arc<str>, i32>,
}

impl ColumnTable {
    /// A column of instants, in microseconds since 1970: in UTC with a zone, else local time.
    pub fn instants(self, name: &str, values: Vec<Option<i64>>, zone: Option<&str>) -> ColumnTable {
        let values: TimestampMicrosecondArray = values.into_iter().collect();
        self.with(name, Arc::new(values.with_timezone_opt(zone)))
    }

    pub fn integers(self, name: &str, values: Vec<Option<i64>>) -> ColumnTable {
        self.with(name, Arc::new(values.into_iter().collect::<Int64Array>()))
    }

    pub fn reals(self, name: &str, values: Vec<Option<f64>>) -> ColumnTable {
        self.with(name, Arc::new(values.into_iter().collect::<Float64Array>()))
    }

    /// A column of texts.
    ///
    /// # Errors
    ///
    /// If a row has the index of a missing text.
    pub fn texts(self, name: &str, mut column: TextColumn) -> Result<ColumnTable, ArrowError> {
        let rows = std::mem::take(&mut column.rows);
        let texts = column.array(rows)?;
        Ok(self.with(name, texts))
    }

    /// The whole table.
    ///
    /// # Errors
    ///
    /// If columns differ in their number of rows.
    pub fn batch(self) -> Result<RecordBatch, ArrowError> {
        let rows = RecordBatchOptions::new().with_row_count(Some(self.rows));
        RecordBatch::try_new_with_options(Arc::new(Schema::new(self.fields)), self.arrays, &rows)
    }

    fn with(mut self, name: &str, array: ArrayRef) -> ColumnTable {
        self.fields.push(Field::new(name, array.data_type().clone(), true));
        self.rows = array.len();
        self.arrays.push(array);
        self
    }
}

impl TextColumn {
    /// A column whose rows are indices into these texts.
    pub fn from_texts(texts: Vec<String>) -> TextColumn {
        TextColumn { texts: texts.into_iter().map(Into::into).collect(), ..TextColumn::default() }
    }

    /// Adds a row with the text of this index.
    pub fn push_place(&mut self, place: Option<u32>) {
        self.rows.push(place.map(|place| place as i32));
    }

    pub fn push(&mut self, text: Option<&str>) {
        let row = text.map(|text| self.number(text));
        self.rows.push(row);
    }

    /// The number of a text, which is added if it is new.
    pub(crate) fn number(&mut self, text: &str) -> i32 {
        if let Some(&number) = self.known.get(text) {
            return number;
        }
        let (number, text): (_, Arc<str>) = (self.texts.len() as i32, text.into());
        self.texts.push(text.clone());
        self.known.insert(text, number);
        number
    }

    pub(crate) fn array(&self, rows: Vec<Option<i32>>) -> Result<ArrayRef, ArrowError> {
        let texts: StringArray = self.texts.iter().map(|text| Some(&**text)).collect();
        let rows: Int32Array = rows.into_iter().collect();
        Ok(Arc::new(DictionaryArray::<Int32Type>::try_new(rows, Arc::new(texts))?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use arrow_array::Array;
    use arrow_array::cast::AsArray;

    #[test]
    fn columns_of_one_length_are_a_table() {
        let mut texts = TextColumn::default();
        [Some("a"), None, Some("a")].into_iter().for_each(|text| texts.push(text));
        let frame = ColumnTable::default().instants("time", vec![Some(0), None, Some(7)], Some("Europe/Berlin"));
        let frame = frame.texts("device", texts).unwrap().reals("x", vec![None, Some(0.5), None]);
        let batch = frame.integers("n", vec![Some(1), Some(2), Some(3)]).batch().unwrap();
        assert_eq!((batch.num_rows(), batch.num_columns()), (3, 4));
        let devices = batch.column(1).as_dictionary::<Int32Type>();
        assert_eq!((devices.values().len(), devices.null_count()), (1, 1), "a text is kept once");
        let uneven = ColumnTable::default().integers("a", vec![Some(1)]).integers("b", vec![]);
        assert!(uneven.batch().is_err());
    }
}
