//! Cohorts: on this machine by threads, or member by member, wherever somebody has them lived.

use crate::fault::{json, named, raised};
use crate::scenario::PythonScenario;
use crate::work::PythonProgress;
use homebody_core::problem::Problem;
use homebody_simulation::{CohortLayout, CohortSummary, MemberSummary, RunProgress, SimulationError, TruthKept, Url};
use pyo3::prelude::*;
use std::path::PathBuf;

/// Many lives of one scenario, that are to be lived into one folder.
#[pyclass(frozen, name = "Cohort", module = "homebody._homebody")]
pub struct PythonCohort {
    cohort: homebody_simulation::Cohort,
    /// What is right in what was asked, and hardly meant.
    remarks: Vec<Problem>,
}

/// What a cohort is to be, as `homebody._cohort` passes it.
#[derive(FromPyObject)]
pub struct CohortOptions {
    #[pyo3(item)]
    residents: Option<u32>,
    /// The name of a list of profiles, and its text.
    #[pyo3(item)]
    profiles: Option<(String, String)>,
    #[pyo3(item)]
    days: Option<f64>,
    #[pyo3(item)]
    seed: Option<u64>,
    #[pyo3(item)]
    without: Vec<String>,
    /// Such as `parquet`.
    #[pyo3(item)]
    form: String,
    /// `all` or `brief`.
    #[pyo3(item)]
    truth: Option<String>,
}

#[pymethods]
impl PythonCohort {
    /// As it is wanted, of a scenario.
    #[new]
    fn new(py: Python<'_>, scenario: &PythonScenario, wanted: CohortOptions) -> PyResult<PythonCohort> {
        let place: Url = format!("{}:cohort", wanted.form).parse().map_err(|why| named("ScenarioError", why))?;
        let layout = CohortLayout::at(&place).map_err(|why| named("ScenarioError", why))?;
        let opened = &scenario.opened;
        let made = py.detach(|| -> Result<_, SimulationError> {
            let file = &opened.scenario().file;
            let length = opened.scenario().calendar.span_of_days(wanted.days.unwrap_or(file.days));
            let mut remarks = opened.remarks(length);
            let setup = match (&wanted.profiles, wanted.residents) {
                (Some((name, text)), _) => {
                    let profiles = opened.profiles_from_table(name, text, &wanted.without)?;
                    remarks.extend(opened.remarks_on(name, &profiles, length)?);
                    opened.cohort_of(profiles)
                }
                (None, count) => opened.cohort(count.unwrap_or(1)),
            };
            let mut setup = setup.without(&wanted.without).layout(layout);
            if let Some(days) = wanted.days {
                setup = setup.days(days);
            }
            if let Some(seed) = wanted.seed {
                setup = setup.seed(seed);
            }
            if let Some(kept) = &wanted.truth {
                setup = setup.truth(if kept == "brief" { TruthKept::Brief } else { TruthKept::All });
            }
            Ok(PythonCohort { cohort: setup.start()?, remarks })
        });
        made.map_err(raised)
    }

    /// The one that was begun in a folder.
    #[staticmethod]
    fn left_in(py: Python<'_>, folder: PathBuf) -> PyResult<PythonCohort> {
        py.detach(|| homebody_simulation::Cohort::left_in(&folder))
            .map(|(cohort, _)| PythonCohort { cohort, remarks: Vec::new() })
            .map_err(raised)
    }

    /// What is right in what was asked, and hardly meant: in words, of one that was not begun before.
    #[getter]
    fn remarks(&self) -> Vec<String> {
        self.remarks.iter().map(Problem::to_string).collect()
    }

    #[getter]
    fn count(&self) -> usize {
        self.cohort.count()
    }

    /// The name of a member.
    fn name_of(&self, index: usize) -> PyResult<String> {
        match index < self.cohort.count() {
            true => Ok(self.cohort.name_of(index)),
            false => Err(named("HomebodyError", format!("there are {} members", self.cohort.count()))),
        }
    }

    /// Writes down in a folder what it is to be.
    fn begin(&self, py: Python<'_>, folder: PathBuf) -> PyResult<()> {
        py.detach(|| self.cohort.create(&folder)).map_err(raised)
    }

    /// Lives one member into the folder; what became of them, as JSON.
    fn live_one(&self, py: Python<'_>, folder: PathBuf, index: usize) -> PyResult<String> {
        self.name_of(index)?;
        py.detach(|| json(&self.cohort.run_member(&folder, index, |_| ()).map_err(raised)?))
    }

    /// Completes the list by what became of all members, in their order.
    fn end(&self, py: Python<'_>, folder: PathBuf, lived: Vec<String>) -> PyResult<()> {
        py.detach(|| {
            let lived: Result<Vec<MemberSummary>, _> = lived.iter().map(|lived| serde_json::from_str(lived)).collect();
            let lived = lived.map_err(|error| named("HomebodyError", error))?;
            self.cohort.finish(&folder, lived).map(|_| ()).map_err(raised)
        })
    }

    /// Lives all who are missing in a folder in which it was begun, on all processors; whether it was ended early.
    fn go_on(&self, py: Python<'_>, folder: PathBuf, told: Option<Py<PyAny>>) -> PyResult<bool> {
        let watched = PythonProgress::new(told);
        let result = py.detach(|| {
            let unfinished = match homebody_simulation::IncompleteCohort::open(&folder) {
                Err(SimulationError::Complete { .. }) => return Ok(false),
                opened => opened.map_err(raised)?,
            };
            let progress = |now: RunProgress| watched.tell(now.done.micros() as f64, now.length.micros() as f64);
            let lived = watched.beside(|| unfinished.cancel(&watched.cancel).resume(progress)).map_err(raised)?;
            Ok(CohortSummary::is_stopped(&lived))
        });
        watched.over(result)
    }
}

/// The text of the list of the cohort in a folder or a store.
#[pyfunction]
pub fn list_of_cohort(py: Python<'_>, folder: PathBuf) -> PyResult<String> {
    py.detach(|| homebody_simulation::list_of_cohort(&folder)).map_err(raised)
}

/// Copies a member's files into another folder.
#[pyfunction]
pub fn bring_member(py: Python<'_>, folder: PathBuf, form: &str, name: &str, to: PathBuf) -> PyResult<()> {
    py.detach(|| homebody_simulation::bring_member(&folder, form, name, &to)).map_err(raised)
}
