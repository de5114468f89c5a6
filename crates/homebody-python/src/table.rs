//! Tables for Python: Arrow streams, which pandas, polars, pyarrow and others read without a copy.

use crate::fault::named;
use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::{RecordBatch, RecordBatchIterator};
use homebody_arrow::SchemaRef;
use pyo3::prelude::*;
use pyo3::types::PyCapsule;

/// The name of the capsule of a stream.
const NAME: &std::ffi::CStr = c"arrow_array_stream";

/// A table in memory. All its streams share the memory.
#[pyclass(frozen, name = "Stream", module = "homebody._homebody")]
pub struct TableStream {
    schema: SchemaRef,
    batches: Vec<RecordBatch>,
}

impl TableStream {
    pub fn of(batch: Result<RecordBatch, impl std::fmt::Display>) -> PyResult<TableStream> {
        let batch = batch.map_err(|error| named("HomebodyError", error))?;
        Ok(TableStream { schema: batch.schema(), batches: vec![batch] })
    }

    /// A table of parts with the same columns.
    pub fn of_parts(batches: Vec<RecordBatch>) -> PyResult<TableStream> {
        let schema = batches.first().ok_or_else(|| named("LogError", "it has no rows"))?.schema();
        Ok(TableStream { schema, batches })
    }
}

#[pymethods]
impl TableStream {
    #[getter]
    fn rows(&self) -> usize {
        self.batches.iter().map(RecordBatch::num_rows).sum()
    }

    #[getter]
    fn columns(&self) -> Vec<String> {
        self.schema.fields().iter().map(|field| field.name().clone()).collect()
    }

    #[getter]
    fn bytes(&self) -> usize {
        self.batches.iter().map(RecordBatch::get_array_memory_size).sum()
    }

    /// The types of the columns, by Arrow's names.
    #[getter]
    fn types(&self) -> Vec<String> {
        self.schema.fields().iter().map(|field| field.data_type().to_string()).collect()
    }

    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        // The consumer casts the columns, as the interface allows.
        let _ = requested_schema;
        let batches = self.batches.clone().into_iter().map(Ok);
        let batches = RecordBatchIterator::new(batches, self.schema.clone());
        PyCapsule::new_with_value(py, FFI_ArrowArrayStream::new(Box::new(batches)), NAME)
    }
}
