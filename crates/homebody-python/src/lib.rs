//! Homebody for Python: a thin layer over `homebody-simulation` and other crates. The classes that users see are written in Python, in
//! `python/homebody/`.
//!
//! Other threads of Python run during long work, which reports its progress and ends when Python is interrupted (`work.rs`). Answers are
//! JSON, tables are Arrow streams (`table.rs`), pictures are SVG. Reading order: `fault.rs`, `work.rs`, then one file for each class.

mod fault;
mod work;
mod table;
mod pictures;
mod driver;
mod scenario;
mod log;
mod stepped;
mod summary;
mod cohort;
mod conversation;

use homebody_analysis::measures::MEASURES;
use pyo3::prelude::*;
use std::ffi::OsString;

/// Runs a command line, and ends the program, which is the command `homebody`.
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
    module.add("RUN_OPTIONS", homebody_simulation::RunOptions::schema().to_value()["properties"].to_string())?;
    module.add_class::<table::TableStream>()?;
    module.add_class::<scenario::PythonScenario>()?;
    module.add_class::<log::PythonLog>()?;
    module.add_class::<stepped::SteppedRun>()?;
    module.add_class::<cohort::PythonCohort>()?;
    module.add_class::<conversation::PythonConversation>()?;
    for function in [
        wrap_pyfunction!(command, module)?,
        wrap_pyfunction!(scenario::templates, module)?,
        wrap_pyfunction!(scenario::routine_text, module)?,
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
