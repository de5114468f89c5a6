//! Homebody for Python.

use pyo3::prelude::*;

#[pymodule]
fn _homebody(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("VERSION", homebody_kit::VERSION)
}
