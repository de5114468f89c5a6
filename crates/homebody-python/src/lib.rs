//! Homebody for Python: a thin layer over `homebody-kit`. What is here opens, lives and reads; what is pythonic about it is written in
//! Python, in `python/homebody/`.
//!
//! Whatever takes long lets other threads of Python go on, tells how far it is, and ends when Python is interrupted (`work.rs`). Answers
//! are JSON, tables go out as Arrow's streams (`table.rs`), pictures as SVG. Reading order: `fault.rs`, `work.rs`, then one file for each
//! class.

mod fault;
mod work;
mod table;
mod pictures;
mod driver;
mod scenario;
mod lived;
mod log;
mod stepped;
mod cohort;

use homebody_analysis::measures::MEASURES;
use pyo3::prelude::*;
use std::ffi::OsString;

/// Does what the words of a command line ask for, and ends the program. Nobody else is at work in it: it is the command `homebody`.
#[pyfunction]
fn command(words: Vec<OsString>) {
    std::process::exit(homebody::run(words).into());
}

#[pymodule]
fn _homebody(module: &Bound<'_, PyModule>) -> PyResult<()> {
    homebody_simulation::install_sinks();
    module.add("VERSION", homebody_simulation::VERSION)?;
    module.add("MOST_MEMBERS", homebody_simulation::MOST_MEMBERS)?;
    let observed = MEASURES.iter().filter(|measure| measure.is_observed).map(|measure| measure.name);
    module.add("OBSERVED_MEASURES", observed.collect::<Vec<_>>())?;
    module.add_class::<table::TableStream>()?;
    module.add_class::<scenario::PythonScenario>()?;
    module.add_class::<log::PythonLog>()?;
    module.add_class::<stepped::LiveRun>()?;
    module.add_class::<cohort::PythonCohort>()?;
    for function in [
        wrap_pyfunction!(command, module)?,
        wrap_pyfunction!(scenario::templates, module)?,
        wrap_pyfunction!(log::compare, module)?,
        wrap_pyfunction!(log::translate, module)?,
        wrap_pyfunction!(pictures::png, module)?,
        wrap_pyfunction!(cohort::list_of_cohort, module)?,
        wrap_pyfunction!(cohort::bring_member, module)?,
    ] {
        module.add_function(function)?;
    }
    Ok(())
}
