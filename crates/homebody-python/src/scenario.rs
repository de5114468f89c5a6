//! Scenarios: opened, made of texts, looked at, and lived.

use crate::driver::{PythonDriver, Raised, or_raised};
use crate::fault::{json, named, raised};
use crate::lived::lived;
use crate::stepped::LiveRun;
use crate::work::PythonProgress;
use homebody_analysis::coverage::{self, STEP_M};
use homebody_core::problem::{Problem, Problems};
use homebody_core::resident::Build;
use homebody_core::scenario::load::NoText;
use homebody_picture::{coverage_map, floor_plan};
use homebody_simulation::{Destinations, OpenScenario, RunSetup, ScenarioSource, SimulationError, Template};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The names of the scenarios that came with the program.
#[pyfunction]
pub fn templates() -> Vec<String> {
    Template::all().map(Template::name).collect()
}

/// A scenario that has passed every check.
#[pyclass(frozen, name = "Scenario", module = "homebody._homebody")]
pub struct PythonScenario {
    pub opened: OpenScenario,
}

/// What a run is to be, as `homebody.scenario` says it.
#[derive(FromPyObject)]
pub struct RunOptions {
    #[pyo3(item)]
    days: Option<f64>,
    #[pyo3(item)]
    seed: Option<u64>,
    #[pyo3(item)]
    start: Option<String>,
    #[pyo3(item)]
    without: Vec<String>,
    #[pyo3(item)]
    numbers: BTreeMap<String, f64>,
    #[pyo3(item)]
    one_of_many: bool,
    /// By resident, what makes their driver of a seed.
    #[pyo3(item)]
    drivers: BTreeMap<String, Py<PyAny>>,
}

impl PythonScenario {
    /// As it is, or with a run that begins when that is said.
    fn starting(&self, start: Option<&str>) -> PyResult<OpenScenario> {
        let Some(start) = start else { return Ok(self.opened.clone()) };
        self.opened.starting(start).map_err(|error| match error {
            // Of a scenario that is right, it is the start that is not.
            SimulationError::Problems(Problems(problems)) => {
                let told = problems.iter().map(|Problem { what, hint, .. }| {
                    hint.as_ref().map_or_else(|| what.clone(), |hint| format!("{what}\n  hint: {hint}"))
                });
                PyValueError::new_err(format!("start is {start:?}: {}", told.collect::<Vec<_>>().join("\n")))
            }
            error => raised(error),
        })
    }

    /// A run as it is wanted, and where exceptions of its drivers are left.
    fn setup(&self, wanted: RunOptions) -> PyResult<(RunSetup, Raised)> {
        let RunOptions { days, seed, start, without, numbers, one_of_many, drivers } = wanted;
        let opened = self.starting(start.as_deref())?;
        let mut setup = opened.run().without(without);
        if let Some(days) = days {
            setup = setup.days(days);
        }
        if let Some(seed) = seed {
            setup = setup.seed(seed);
        }
        if one_of_many {
            setup = setup.one_of_many();
        }
        for (name, value) in numbers {
            setup = setup.number(name, value);
        }
        let raised = Raised::default();
        for (resident, make) in drivers {
            let raised = raised.clone();
            setup = setup.driver(resident, move |home, seed| PythonDriver::make(&make, home, seed, &raised));
        }
        Ok((setup, raised))
    }
}

#[pymethods]
impl PythonScenario {
    /// By a folder or its `scenario.json`.
    #[staticmethod]
    fn at(py: Python<'_>, path: PathBuf, trusted: bool) -> PyResult<PythonScenario> {
        py.detach(|| {
            let source = ScenarioSource::at(path)?;
            if trusted { source.trusted().open() } else { source.open() }
        })
        .map(|opened| PythonScenario { opened })
        .map_err(raised)
    }

    /// One that came with the program.
    #[staticmethod]
    fn template(py: Python<'_>, name: &str) -> PyResult<PythonScenario> {
        py.detach(|| homebody_simulation::template(name)).map(|opened| PythonScenario { opened }).map_err(raised)
    }

    /// Of texts by the names of their files.
    #[staticmethod]
    fn of_texts(py: Python<'_>, texts: BTreeMap<String, String>, entry: String) -> PyResult<PythonScenario> {
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

    /// Its files: those that were read, by name, and their texts.
    #[getter]
    fn texts(&self) -> BTreeMap<String, String> {
        self.opened.scenario().sources.clone()
    }

    /// A text of its folder, whether the scenario links it or not.
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

    /// By room, something near its middle: where one may stand.
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

    /// The room that a point is in.
    fn room_at(&self, x: f64, y: f64) -> Option<String> {
        let plan = self.opened.scenario().home.plan();
        plan.room_at(homebody_core::geometry::point([x, y])).map(|room| plan.rooms[room].name.clone())
    }

    /// What is right in it and hardly meant, in a run of so many days, that begins then, with numbers of the models set.
    fn remarks(
        &self,
        py: Python<'_>,
        days: f64,
        start: Option<&str>,
        numbers: BTreeMap<String, f64>,
    ) -> PyResult<String> {
        let opened = self.starting(start)?.with_numbers(numbers).map_err(raised)?;
        let length = opened.scenario().calendar.span_of_days(days);
        json(&py.detach(|| opened.remarks(length)))
    }

    fn plan_svg(&self, py: Python<'_>) -> String {
        py.detach(|| floor_plan(&self.opened.scenario().home))
    }

    /// Its figures and its map.
    fn coverage(&self, py: Python<'_>) -> PyResult<(String, String)> {
        let scenario = self.opened.scenario();
        py.detach(|| {
            let build = scenario.residents.first().map_or_else(Build::adult, |resident| Build::new(&resident.file));
            let seen = coverage::of_home(&scenario.home, build, STEP_M);
            Ok((json(&seen.coverage)?, coverage_map(&seen.home, &seen.coverage, &seen.beams())))
        })
    }

    /// Lives a run into a new folder in `runs`; returns what became of it as JSON.
    fn run(&self, py: Python<'_>, runs: PathBuf, wanted: RunOptions, told: Option<Py<PyAny>>) -> PyResult<String> {
        let (setup, by_driver) = self.setup(wanted)?;
        let watched = PythonProgress::new(told);
        let result = py.detach(|| {
            let run = setup.cancel(&watched.cancel).start().map_err(|error| or_raised(error, &by_driver))?;
            let stored = run.store(&Destinations::new_folder_in(runs), |progress| {
                watched.tell(progress.done.micros() as f64, progress.length.micros() as f64);
            });
            lived(&stored.map_err(|error| or_raised(error, &by_driver))?)
        });
        watched.over(result)
    }

    /// A run at its beginning, to be stepped.
    fn live(&self, py: Python<'_>, wanted: RunOptions) -> PyResult<LiveRun> {
        let (setup, by_driver) = self.setup(wanted)?;
        let run = py.detach(|| setup.start()).map_err(|error| or_raised(error, &by_driver))?;
        Ok(LiveRun::new(run, by_driver))
    }
}
