//! Drivers in Python: objects whose `next` returns the next step of a resident from the surroundings.
//!
//! `homebody.driver` turns the answers into plain tuples for this module, and the surroundings into objects of Python.

use crate::fault::raised;
use homebody_core::drivers::{Driver, Next, PlacedBody, Surroundings};
use homebody_core::event::ThingUse;
use homebody_core::geometry::{Point, point};
use homebody_core::ids::ThingId;
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::posture::Posture;
use homebody_core::time::{RunTime, Span};
use homebody_simulation::SimulationError;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

/// An exception of a driver, for the caller of the run.
pub type Raised = Arc<Mutex<Option<PyErr>>>;

/// The exception of a driver, or else the error.
pub fn or_raised(error: SimulationError, by_driver: &Raised) -> PyErr {
    by_driver.lock().unwrap_or_else(PoisonError::into_inner).take().unwrap_or_else(|| raised(error))
}

pub struct PythonDriver {
    /// The wrapper of `homebody.driver`; `None` if the driver could not be made.
    wrapped: Option<Py<PyAny>>,
    raised: Raised,
}

impl fmt::Debug for PythonDriver {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a driver in Python")
    }
}

impl PythonDriver {
    /// `make` is called with the seed.
    pub fn make(make: &Py<PyAny>, seed: u64, raised: &Raised) -> PythonDriver {
        let made = Python::attach(|py| make.call1(py, (seed,)));
        let mut driver = PythonDriver { wrapped: None, raised: raised.clone() };
        match made {
            Ok(wrapped) => driver.wrapped = Some(wrapped),
            Err(error) => driver.failed(error),
        }
        driver
    }

    fn failed(&self, error: PyErr) {
        self.raised.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
    }
}

impl Driver for PythonDriver {
    fn next(&mut self, around: &Surroundings) -> Next {
        let Some(wrapped) = &self.wrapped else { return Next::Failed("it could not be made".into()) };
        let answer = Python::attach(|py| {
            let plan = around.plan();
            let body = |body: PlacedBody| (body.resident.index(), xy(body.at), xy(body.to), body.posture.name());
            let own = around.body();
            let room = own.and_then(|own| around.room_at(own.at)).map(|room| plan.rooms[room.index()].name.clone());
            let others: Vec<_> = around.others().map(body).collect();
            let on = (0..plan.things.len()).filter(|&thing| around.is_on(ThingId::new(thing)));
            let on: Vec<&str> = on.map(|thing| plan.things[thing].name.as_str()).collect();
            let answer = wrapped.call1(py, (around.now().micros(), own.map(body), room, others, on))?;
            next(answer.bind(py), around)
        });
        answer.unwrap_or_else(|error| {
            let why = error.to_string();
            self.failed(error);
            Next::Failed(why)
        })
    }

    fn copy(&self) -> Box<dyn Driver> {
        let copied = Python::attach(|py| {
            let copy = self.wrapped.as_ref().map(|wrapped| py.import("copy")?.call_method1("deepcopy", (wrapped,)));
            copy.transpose().map(|copy| copy.map(Bound::unbind))
        });
        let wrapped = copied.unwrap_or_else(|error| {
            self.failed(error);
            None
        });
        Box::new(PythonDriver { wrapped, raised: self.raised.clone() })
    }
}

fn xy(at: Point) -> (f64, f64) {
    (at.x, at.y)
}

/// An answer: its kind, then its values.
fn next(answer: &Bound<'_, PyAny>, around: &Surroundings) -> PyResult<Next> {
    let wrong = |what: String| PyValueError::new_err(what);
    let (kind, of): (String, Bound<'_, PyAny>) = answer
        .extract()
        .map_err(|_| PyTypeError::new_err("next must answer with Stride, Rest, Stir, Away, Use or Doing"))?;
    let begin = around.now();
    let end = |lasts_s: f64| match lasts_s {
        lasts if lasts.is_infinite() && lasts > 0.0 => RunTime::NEVER,
        lasts => begin.saturating_add(Span::from_seconds(lasts)),
    };
    let here = |at: Option<(f64, f64)>| {
        let known = at.map(|(x, y)| point([x, y])).or(around.body().map(|body| body.at));
        known.ok_or_else(|| wrong("it has no body yet, or is away: say where it is, with at".into()))
    };
    let segment = |end, doing, posture| Next::Segment(MotionSegment { begin, end, doing, posture });
    Ok(match kind.as_str() {
        "stride" => {
            let (to, lasts_s, posture): ((f64, f64), f64, String) = of.extract()?;
            let doing = MotionState::Stride { from: here(None)?, to: point([to.0, to.1]) };
            segment(end(lasts_s), doing, posture_named(&posture)?)
        }
        "rest" => {
            let (at, lasts_s, posture): (Option<(f64, f64)>, f64, String) = of.extract()?;
            segment(end(lasts_s), MotionState::Rest { at: here(at)? }, posture_named(&posture)?)
        }
        "stir" => {
            let (at, lasts_s, posture, amplitude_m): (Option<(f64, f64)>, f64, String, f64) = of.extract()?;
            segment(end(lasts_s), MotionState::InPlace { at: here(at)?, amplitude_m }, posture_named(&posture)?)
        }
        "out" => segment(end(of.extract()?), MotionState::Away, Posture::Standing),
        "use" => {
            let (thing, on): (String, bool) = of.extract()?;
            let known = &around.plan().things;
            let index = known.iter().position(|known| known.name == thing).ok_or_else(|| {
                let names: Vec<&str> = known.iter().map(|thing| thing.name.as_str()).collect();
                wrong(format!("there is no thing {thing:?}; there are {}", names.join(", ")))
            })?;
            Next::Use(ThingUse { thing: ThingId::new(index), on })
        }
        "doing" => Next::Activity(of.extract()?),
        other => return Err(wrong(format!("{other:?} is no answer"))),
    })
}

fn posture_named(name: &str) -> PyResult<Posture> {
    Posture::named(name).ok_or_else(|| {
        let known = Posture::ALL.map(Posture::name).join(", ");
        PyValueError::new_err(format!("posture {name:?}: it is one of {known}"))
    })
}
