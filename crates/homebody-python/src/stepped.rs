//! A run that its caller advances step by step.

use crate::driver::{Raised, or_raised};
use crate::fault::{json, named};
use crate::table::TableStream;
use homebody_arrow::{ColumnTable, TextColumn};
use homebody_core::time::{RunTime, SECOND};
use homebody_simulation::Simulation;
use pyo3::prelude::*;
use serde_json::json;
use std::sync::{Mutex, MutexGuard};

/// A run in progress.
#[pyclass(frozen, module = "homebody._homebody")]
pub struct SteppedRun {
    run: Mutex<Simulation>,
    by_driver: Raised,
}

impl SteppedRun {
    pub fn new(run: Simulation, by_driver: Raised) -> SteppedRun {
        SteppedRun { run: Mutex::new(run), by_driver }
    }

    fn lock(&self) -> PyResult<MutexGuard<'_, Simulation>> {
        // After a panic in a step, the run is not usable.
        self.run.lock().map_err(|_| named("HomebodyError", "an earlier step of this run has failed"))
    }
}

#[pymethods]
impl SteppedRun {
    /// Simulates so many seconds, and returns the events.
    fn step(&self, py: Python<'_>, lasts_s: f64) -> PyResult<TableStream> {
        if lasts_s.is_nan() || lasts_s <= 0.0 {
            return Err(named("HomebodyError", "a step is longer than nothing"));
        }
        py.detach(|| {
            let mut run = self.lock()?;
            let sensors: Vec<String> = run.sensors().map(str::to_owned).collect();
            let calendar = run.calendar().clone();
            let until = RunTime::START + run.progress().done.saturating_add(SECOND.share(lasts_s));
            let batch = run.advance_to(until).map_err(|error| or_raised(error, &self.by_driver))?;
            let (mut times, mut devices, mut values) =
                (Vec::new(), TextColumn::from_texts(sensors), TextColumn::default());
            for firing in batch.firings {
                times.push(Some(calendar.timestamp(firing.at).as_microsecond()));
                devices.push_place(Some(firing.sensor.0));
                values.push(Some(&firing.value.to_string()));
            }
            let zone = calendar.local(RunTime::START).time_zone().iana_name().unwrap_or("UTC").to_owned();
            let frame = ColumnTable::default().instants("time", times, Some(&zone));
            let frame = frame.texts("device", devices).and_then(|frame| frame.texts("value", values));
            TableStream::of(frame.and_then(ColumnTable::batch))
        })
    }

    /// The simulated time and the length, in seconds, and the wall-clock time.
    #[getter]
    fn progress(&self) -> PyResult<(f64, f64, String)> {
        let run = self.lock()?;
        let progress = run.progress();
        let now = run.calendar().wall_clock(RunTime::START + progress.done);
        Ok((progress.done.seconds(), progress.length.seconds(), now))
    }

    /// The present scene, as JSON.
    fn scene(&self) -> PyResult<String> {
        let run = self.lock()?;
        let scene = run.scene();
        let plan = &run.home().plan;
        let bodies = run.residents().into_iter().zip(&scene.bodies).map(|(name, body)| {
            let body = body.as_ref().map(|body| {
                let room = body.room.map(|room| plan.rooms[room.index()].name.clone());
                json!({ "x": body.at.x, "y": body.at.y, "posture": body.posture.name(), "room": room })
            });
            (name, body.unwrap_or(serde_json::Value::Null))
        });
        let bodies: serde_json::Map<String, serde_json::Value> = bodies.collect();
        let on: Vec<&str> = scene.on.iter().map(|thing| plan.things[thing.index()].name.as_str()).collect();
        json(&json!({ "bodies": bodies, "on": on }))
    }
}
