//! Pictures of Homebody's own.

use crate::fault::named;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

/// A picture as PNG, of so many pixels in width.
#[pyfunction]
pub fn png<'py>(py: Python<'py>, svg: &str, width: u32) -> PyResult<Bound<'py, PyBytes>> {
    let bytes = py.detach(|| homebody_picture::png(svg, width)).map_err(|error| named("HomebodyError", error))?;
    Ok(PyBytes::new(py, &bytes))
}
