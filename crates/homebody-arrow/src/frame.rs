//! Columns in memory, for whoever hands tables on as Arrow has them.

use arrow_array::types::Int32Type;
use arrow_array::{
    ArrayRef, DictionaryArray, Float64Array, Int32Array, Int64Array, RecordBatch, RecordBatchOptions, StringArray,
    TimestampMicrosecondArray,
};
use arrow_schema::{ArrowError, Field, Schema};
use std::collections::HashMap;
use std::sync::Arc;

/// A table that is put together column by column. All columns have as many rows.
#[derive(Default)]
pub struct Frame {
    fields: Vec<Field>,
    arrays: Vec<ArrayRef>,
    rows: usize,
}

/// A column of texts on its way: each is kept once.
#[derive(Default)]
pub struct Texts {
    rows: Vec<Option<i32>>,
    texts: Vec<String>,
    known: HashMap<String, i32>,
}

impl Frame {
    /// A column of instants, in microseconds since 1970; with a zone they are those of the world's clock, without they are on
    /// some wall.
    pub fn instants(self, name: &str, values: Vec<Option<i64>>, zone: Option<&str>) -> Frame {
        let values: TimestampMicrosecondArray = values.into_iter().collect();
        self.with(name, Arc::new(values.with_timezone_opt(zone)))
    }

    /// A column of whole numbers.
    pub fn integers(self, name: &str, values: Vec<Option<i64>>) -> Frame {
        self.with(name, Arc::new(values.into_iter().collect::<Int64Array>()))
    }

    /// A column of numbers.
    pub fn reals(self, name: &str, values: Vec<Option<f64>>) -> Frame {
        self.with(name, Arc::new(values.into_iter().collect::<Float64Array>()))
    }

    /// A column of texts.
    ///
    /// # Errors
    ///
    /// If a row is of a text that there is not.
    pub fn texts(self, name: &str, Texts { rows, texts, .. }: Texts) -> Result<Frame, ArrowError> {
        let rows: Int32Array = rows.into_iter().collect();
        let texts: StringArray = texts.iter().map(|text| Some(text.as_str())).collect();
        Ok(self.with(name, Arc::new(DictionaryArray::<Int32Type>::try_new(rows, Arc::new(texts))?)))
    }

    /// All of it.
    ///
    /// # Errors
    ///
    /// If a column has other than the rows of the first.
    pub fn batch(self) -> Result<RecordBatch, ArrowError> {
        let rows = RecordBatchOptions::new().with_row_count(Some(self.rows));
        RecordBatch::try_new_with_options(Arc::new(Schema::new(self.fields)), self.arrays, &rows)
    }

    fn with(mut self, name: &str, array: ArrayRef) -> Frame {
        self.fields.push(Field::new(name, array.data_type().clone(), true));
        self.rows = array.len();
        self.arrays.push(array);
        self
    }
}

impl Texts {
    /// Texts of which rows are told by their places.
    pub fn of(texts: Vec<String>) -> Texts {
        Texts { rows: Vec::new(), known: HashMap::new(), texts }
    }

    /// A row of the text at a place.
    pub fn push_place(&mut self, place: Option<u32>) {
        self.rows.push(place.map(|place| place as i32));
    }

    /// A row of a text.
    pub fn push(&mut self, text: Option<&str>) {
        let row = text.map(|text| match self.known.get(text) {
            Some(&place) => place,
            None => {
                let place = self.texts.len() as i32;
                self.texts.push(text.to_owned());
                self.known.insert(text.to_owned(), place);
                place
            }
        });
        self.rows.push(row);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use arrow_array::Array;
    use arrow_array::cast::AsArray;

    #[test]
    fn columns_of_one_length_are_a_table() {
        let mut texts = Texts::default();
        [Some("a"), None, Some("a")].into_iter().for_each(|text| texts.push(text));
        let frame = Frame::default().instants("time", vec![Some(0), None, Some(7)], Some("Europe/Berlin"));
        let frame = frame.texts("device", texts).unwrap().reals("x", vec![None, Some(0.5), None]);
        let batch = frame.integers("n", vec![Some(1), Some(2), Some(3)]).batch().unwrap();
        assert_eq!((batch.num_rows(), batch.num_columns()), (3, 4));
        let devices = batch.column(1).as_dictionary::<Int32Type>();
        assert_eq!((devices.values().len(), devices.null_count()), (1, 1), "a text is kept once");
        let uneven = Frame::default().integers("a", vec![Some(1)]).integers("b", vec![]);
        assert!(uneven.batch().is_err());
    }
}
