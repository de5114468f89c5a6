//! Scenarios: open, create, inspect and run them.

use crate::driver::{PythonDriver, Raised, or_raised};
use crate::fault::{json, named, raised};
use crate::stepped::SteppedRun;
use crate::summary::summary;
use crate::work::PythonProgress;
use homebody_analysis::coverage::{self, STEP_M};
use homebody_core::problem::{Problem, Problems};
use homebody_core::resident::Build;
use homebody_core::scenario::load::NoText;
use homebody_picture::{coverage_map, floor_plan};
use homebody_simulation::statement::{Statement, text};
use homebody_simulation::{
    Destinations, OpenScenario, RunOptions, RunSetup, ScenarioSource, SimulationError, Template,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The names of the scenarios that come with the program.
#[pyfunction]
pub fn templates() -> Vec<String> {
    Template::all().map(Template::name).collect()
}

/// The sentences of statements, which are JSON.
#[pyfunction]
pub fn routine_text(statements: &str) -> PyResult<String> {
    let statements: Vec<Statement> =
        serde_json::from_str(statements).map_err(|error| PyValueError::new_err(error.to_string()))?;
    Ok(text(&statements))
}

/// A scenario that has passed every check.
#[pyclass(frozen, name = "Scenario", module = "homebody._homebody")]
pub struct PythonScenario {
    pub opened: OpenScenario,
}

/// The setup of a run with these options, which are JSON.
pub fn run_setup(scenario: &OpenScenario, options: &str) -> PyResult<RunSetup> {
    let mut options: RunOptions = serde_json::from_str(options).map_err(|error| named("ScenarioError", error))?;
    let scenario = match options.start.take() {
        Some(start) => start.in_scenario(scenario).map_err(|error| match error {
            // The scenario is valid, so its problems are those of the start.
            SimulationError::Problems(Problems(problems)) => {
                let texts = problems.iter().map(|Problem { what, hint, .. }| {
                    hint.as_ref().map_or_else(|| what.clone(), |hint| format!("{what}\n  hint: {hint}"))
                });
                let texts = texts.collect::<Vec<_>>().join("\n");
                PyValueError::new_err(format!("start is {:?}: {texts}", start.to_string()))
            }
            error => raised(error),
        })?,
        None => scenario.clone(),
    };
    options.setup(&scenario).map_err(raised)
}

impl PythonScenario {
    /// The setup of a run, and the place for exceptions of its drivers, which are functions by resident that make a driver from a seed.
    fn setup(&self, options: &str, drivers: BTreeMap<String, Py<PyAny>>) -> PyResult<(RunSetup, Raised)> {
        let mut setup = run_setup(&self.opened, options)?;
        let raised = Raised::default();
        for (resident, make) in drivers {
            let raised = raised.clone();
            setup = setup.driver(resident, move |_, seed| PythonDriver::make(&make, seed, &raised));
        }
        Ok((setup, raised))
    }
}

#[pymethods]
impl PythonScenario {
    /// Opens a folder or its `scenario.json`.
    #[staticmethod]
    fn at(py: Python<'_>, path: PathBuf, trusted: bool) -> PyResult<PythonScenario> {
        py.detach(|| {
            let source = ScenarioSource::at(path)?;
            if trusted { source.trusted().open() } else { source.open() }
        })
        .map(|opened| PythonScenario { opened })
        .map_err(raised)
    }

    /// Opens a scenario that comes with the program.
    #[staticmethod]
    fn template(py: Python<'_>, name: &str) -> PyResult<PythonScenario> {
        py.detach(|| homebody_simulation::template(name)).map(|opened| PythonScenario { opened }).map_err(raised)
    }

    /// Opens texts by the names of their files.
    #[staticmethod]
    fn from_texts(py: Python<'_>, texts: BTreeMap<String, String>, entry: String) -> PyResult<PythonScenario> {
        py.detach(|| ScenarioSource::from_texts(texts, entry).open())
            .map(|opened| PythonScenario { opened })
            .map_err(raised)
    }

    #[getter]
    fn name(&self) -> &str {
        self.opened.name()
    }

    /// The name of its own file.
    #[getter]
    fn entry(&self) -> &str {
        self.opened.source().entry()
    }

    /// The texts of its files, by name.
    #[getter]
    fn texts(&self) -> BTreeMap<String, String> {
        self.opened.scenario().sources.clone()
    }

    /// The text of a file in its folder, also of one that the scenario does not link.
    fn text(&self, name: &str) -> PyResult<String> {
        self.opened.source().files().read(name).map_err(|why| {
            let why = match why {
                NoText::Missing => "there is no such file".to_owned(),
                NoText::Unreadable { why, .. } => why,
            };
            named("ScenarioError", format!("{name}: {why}"))
        })
    }

    #[getter]
    fn days(&self) -> f64 {
        self.opened.scenario().file.days
    }

    #[getter]
    fn seed(&self) -> u64 {
        self.opened.scenario().file.seed
    }

    #[getter]
    fn time_zone(&self) -> String {
        self.opened.scenario().file.time_zone.clone()
    }

    #[getter]
    fn residents(&self) -> Vec<String> {
        self.opened.scenario().residents.iter().map(|resident| resident.file.name.clone()).collect()
    }

    #[getter]
    fn rooms(&self) -> Vec<String> {
        self.opened.scenario().home.plan().rooms.iter().map(|room| room.name.clone()).collect()
    }

    #[getter]
    fn things(&self) -> Vec<String> {
        self.opened.scenario().home.plan().things.iter().map(|thing| thing.name.clone()).collect()
    }

    #[getter]
    fn sensors(&self) -> Vec<String> {
        self.opened.scenario().home.placed_sensors().iter().map(|sensor| sensor.name.clone()).collect()
    }

    /// Named points where a body can stand.
    #[getter]
    fn places(&self) -> BTreeMap<String, (f64, f64)> {
        let places = &self.opened.scenario().home.plan().places;
        places.iter().map(|(name, at)| (name.clone(), (at.x, at.y))).collect()
    }

    /// The corners of the home's bounds: left, bottom, right, top, in metres.
    #[getter]
    fn bounds(&self) -> (f64, f64, f64, f64) {
        let (low, high) = self.opened.scenario().home.plan().bounds();
        (low.x, low.y, high.x, high.y)
    }

    /// The room of a point.
    fn room_at(&self, x: f64, y: f64) -> Option<String> {
        let plan = self.opened.scenario().home.plan();
        plan.room_at(homebody_core::geometry::point([x, y])).map(|room| plan.rooms[room].name.clone())
    }

    /// The warnings about a run with these options.
    fn remarks(&self, py: Python<'_>, options: &str) -> PyResult<String> {
        let setup = run_setup(&self.opened, options)?;
        let (opened, length) = (setup.scenario().clone(), setup.span().map_err(raised)?);
        json(&py.detach(|| opened.remarks(length)))
    }

    fn plan_svg(&self, py: Python<'_>) -> String {
        py.detach(|| floor_plan(&self.opened.scenario().home))
    }

    /// The figures and the map of its coverage.
    fn coverage(&self, py: Python<'_>) -> PyResult<(String, String)> {
        let scenario = self.opened.scenario();
        py.detach(|| {
            let build = scenario.residents.first().map_or_else(Build::adult, |resident| Build::new(&resident.file));
            let seen = coverage::of_home(&scenario.home, build, STEP_M);
            Ok((json(&seen.coverage)?, coverage_map(&seen.home, &seen.coverage, &seen.beams())))
        })
    }

    /// Simulates a run into a new folder in `runs`. Returns its summary as JSON.
    fn run(
        &self,
        py: Python<'_>,
        runs: PathBuf,
        options: &str,
        drivers: BTreeMap<String, Py<PyAny>>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<String> {
        let (setup, by_driver) = self.setup(options, drivers)?;
        let watched = PythonProgress::new(progress);
        let result = py.detach(|| {
            let run = setup.cancel(&watched.cancel).start().map_err(|error| or_raised(error, &by_driver))?;
            let stored = run.store(&Destinations::new_folder_in(runs), |progress| {
                watched.tell(progress.done.micros() as f64, progress.length.micros() as f64);
            });
            summary(&stored.map_err(|error| or_raised(error, &by_driver))?)
        });
        watched.finish(result)
    }

    /// A run at its start, to advance step by step.
    fn live(&self, py: Python<'_>, options: &str, drivers: BTreeMap<String, Py<PyAny>>) -> PyResult<SteppedRun> {
        let (setup, by_driver) = self.setup(options, drivers)?;
        let run = py.detach(|| setup.start()).map_err(|error| or_raised(error, &by_driver))?;
        Ok(SteppedRun::new(run, by_driver))
    }
}
