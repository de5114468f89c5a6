//! Cohorts: simulated by threads on this machine, or member by member on other machines.

use crate::fault::{json, named, raised};
use crate::scenario::{PythonScenario, run_setup};
use crate::work::PythonProgress;
use homebody_core::problem::Problem;
use homebody_simulation::{CohortLayout, MemberSummary, RunProgress, SimulationError, TruthKept, Url};
use pyo3::prelude::*;
use std::path::PathBuf;

/// Many runs of one scenario, stored in one folder.
#[pyclass(frozen, name = "Cohort", module = "homebody._homebody")]
pub struct PythonCohort {
    cohort: homebody_simulation::Cohort,
    /// The warnings.
    remarks: Vec<Problem>,
}

/// The members and the storage of a cohort, as `homebody._cohort` requests them.
#[derive(FromPyObject)]
pub struct CohortRequest {
    #[pyo3(item)]
    residents: Option<u32>,
    /// The name of a list of profiles, and its text.
    #[pyo3(item)]
    profiles: Option<(String, String)>,
    /// Such as `parquet`.
    #[pyo3(item)]
    form: String,
    /// `all` or `brief`.
    #[pyo3(item)]
    truth: Option<String>,
}

#[pymethods]
impl PythonCohort {
    /// A cohort of a scenario; `options` is JSON.
    #[new]
    fn new(py: Python<'_>, scenario: &PythonScenario, options: &str, request: CohortRequest) -> PyResult<PythonCohort> {
        let place: Url = format!("{}:cohort", request.form).parse().map_err(|why| named("ScenarioError", why))?;
        let layout = CohortLayout::at(&place).map_err(|why| named("ScenarioError", why))?;
        let run = run_setup(&scenario.opened, options)?;
        let made = py.detach(|| -> Result<_, SimulationError> {
            let (opened, length) = (run.scenario().clone(), run.span()?);
            let mut remarks = opened.remarks(length);
            let setup = match (&request.profiles, request.residents) {
                (Some((name, text)), _) => {
                    let profiles = opened.profiles_from_table(name, text, run.without_conditions())?;
                    remarks.extend(opened.remarks_on(name, &profiles, length)?);
                    run.cohort_of(profiles)
                }
                (None, count) => run.cohort(count.unwrap_or(1)),
            };
            let mut setup = setup.layout(layout);
            if let Some(kept) = &request.truth {
                setup = setup.truth(if kept == "brief" { TruthKept::Brief } else { TruthKept::All });
            }
            Ok(PythonCohort { cohort: setup.start()?, remarks })
        });
        made.map_err(raised)
    }

    /// The cohort of a folder.
    #[staticmethod]
    fn open(py: Python<'_>, folder: PathBuf) -> PyResult<PythonCohort> {
        py.detach(|| homebody_simulation::Cohort::in_folder(&folder))
            .map(|(cohort, _)| PythonCohort { cohort, remarks: Vec::new() })
            .map_err(raised)
    }

    /// The warnings as texts; none of a cohort that existed before.
    #[getter]
    fn remarks(&self) -> Vec<String> {
        self.remarks.iter().map(Problem::to_string).collect()
    }

    #[getter]
    fn count(&self) -> usize {
        self.cohort.count()
    }

    fn name_of(&self, index: usize) -> PyResult<String> {
        match index < self.cohort.count() {
            true => Ok(self.cohort.name_of(index)),
            false => Err(named("HomebodyError", format!("there are {} members", self.cohort.count()))),
        }
    }

    /// Writes its options into a folder.
    fn create(&self, py: Python<'_>, folder: PathBuf) -> PyResult<()> {
        py.detach(|| self.cohort.create(&folder)).map_err(raised)
    }

    /// Simulates one member into the folder. Returns the summary as JSON.
    fn run_member(&self, py: Python<'_>, folder: PathBuf, index: usize) -> PyResult<String> {
        self.name_of(index)?;
        py.detach(|| json(&self.cohort.run_member(&folder, index, |_| ()).map_err(raised)?))
    }

    /// Completes the list with the summaries of all members, in their order.
    fn finish(&self, py: Python<'_>, folder: PathBuf, members: Vec<String>) -> PyResult<()> {
        py.detach(|| {
            let members: Result<Vec<MemberSummary>, _> =
                members.iter().map(|text| serde_json::from_str(text)).collect();
            let members = members.map_err(|error| named("HomebodyError", error))?;
            self.cohort.finish(&folder, members).map(|_| ()).map_err(raised)
        })
    }

    /// Simulates the missing members of a folder, on all processors. Returns true if it was stopped.
    fn resume(&self, py: Python<'_>, folder: PathBuf, progress: Option<Py<PyAny>>) -> PyResult<bool> {
        let watched = PythonProgress::new(progress);
        let result = py.detach(|| {
            let incomplete = match homebody_simulation::IncompleteCohort::open(&folder) {
                Err(SimulationError::Complete { .. }) => return Ok(false),
                opened => opened.map_err(raised)?,
            };
            let progress = |now: RunProgress| watched.tell(now.done.micros() as f64, now.length.micros() as f64);
            let summary = watched.interruptible(|| incomplete.cancel(&watched.cancel).resume(progress));
            Ok(summary.map_err(raised)?.is_stopped())
        });
        watched.finish(result)
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
