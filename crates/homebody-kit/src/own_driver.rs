//! Drivers that callers bring: they take the places of the scenario's own, and what nobody can do is refused.

use crate::error::Error;
use homebody_core::drivers::{Decide, MotionSegment, Next};
use homebody_core::event::MotionState;
use homebody_core::geometry::Point;
use homebody_core::home::Home;
use homebody_core::run::{DriverProvider, Guest};
use homebody_core::scenario::path::Posture;
use homebody_core::time::Micros;
use homebody_routine::household::Household;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Makes a driver from the home and the run's seed.
pub type MakeDriver = Arc<dyn Fn(&Arc<Home>, u64) -> Box<dyn Decide> + Send + Sync>;

/// So many answers that take no time are no decision any more (ours).
const MOST_ANSWERS: u32 = 10_000;

/// The first thing that went wrong with any of the drivers. A clone is the same.
#[derive(Clone, Debug, Default)]
pub struct Fault(Arc<Mutex<Option<Error>>>);

impl Fault {
    fn set(&self, error: Error) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
    }

    /// What went wrong, if anything did.
    pub fn take(&self) -> Option<Error> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

/// The drivers of a run: the caller's own for some residents, the household's for the others.
pub struct Provider<'a> {
    pub household: &'a Household,
    /// By resident, with their names.
    pub own: &'a BTreeMap<usize, (String, MakeDriver)>,
    pub fault: Fault,
}

impl DriverProvider for Provider<'_> {
    fn guests(&self) -> Vec<Guest> {
        self.household.guests()
    }

    fn driver(&self, body: usize, home: &Arc<Home>, seed: u64) -> Option<Box<dyn Decide>> {
        let Some((resident, make)) = self.own.get(&body) else { return self.household.driver(body, home, seed) };
        Some(Box::new(Watched {
            driver: make(home, seed),
            home: home.clone(),
            resident: resident.clone(),
            fault: self.fault.clone(),
            answers: (0, 0),
            has_failed: false,
        }))
    }
}

/// A driver whose answers are looked at before the world gets them. After one that is refused it rests for ever.
#[derive(Clone, Debug)]
struct Watched {
    driver: Box<dyn Decide>,
    home: Arc<Home>,
    resident: String,
    fault: Fault,
    /// The instant of the last answers, and how many there were.
    answers: (Micros, u32),
    has_failed: bool,
}

impl Watched {
    /// What is wrong with an answer.
    fn wrong(&mut self, now: Micros, next: &Next) -> Option<String> {
        let (at, count) = self.answers;
        self.answers = (now, if at == now { count + 1 } else { 1 });
        let plan = &self.home.plan;
        match next {
            _ if self.answers.1 > MOST_ANSWERS => {
                Some(format!("answers more than {MOST_ANSWERS} times without letting time pass"))
            }
            Next::Segment(MotionSegment { begin, .. }) if *begin != now => {
                Some(format!("begins a movement at {begin}, which is not now"))
            }
            Next::Segment(MotionSegment { end, .. }) if *end <= now => {
                Some(format!("ends a movement at {end}, which is not after its beginning"))
            }
            Next::Segment(MotionSegment { doing, .. }) => self.outside(doing),
            Next::Use(thing_use) if thing_use.thing.index() >= plan.things.len() => {
                Some(format!("uses thing {}, and the home has {}", thing_use.thing.index(), plan.things.len()))
            }
            Next::Need(_, level) if !(0.0..=1.0).contains(level) => {
                Some(format!("has a need of {level}, which is not from 0 to 1"))
            }
            Next::Condition(name, severity) if !severity.is_finite() => {
                Some(format!("shows {name:?} with a severity of {severity}"))
            }
            Next::Done => self.outside(&MotionState::Rest { at: self.driver.pose().0 }),
            _ => None,
        }
    }

    fn outside(&self, doing: &MotionState) -> Option<String> {
        let points = match *doing {
            MotionState::Stride { from, to } => vec![from, to],
            MotionState::InPlace { at, amplitude_m } if amplitude_m.is_finite() && amplitude_m >= 0.0 => vec![at],
            MotionState::InPlace { amplitude_m, .. } => return Some(format!("moves in place by {amplitude_m} m")),
            MotionState::Rest { at } => vec![at],
            MotionState::Away => Vec::new(),
        };
        let is_outside = |at: &Point| !at.is_finite() || !self.home.plan.is_inside(*at);
        let at = points.into_iter().find(is_outside)?;
        Some(format!("moves the body to ({}, {}), which is outside the home", at.x, at.y))
    }
}

impl Decide for Watched {
    fn next(&mut self, now: Micros) -> Next {
        if self.has_failed {
            return Next::Done;
        }
        let next = self.driver.next(now);
        let Some(why) = self.wrong(now, &next) else { return next };
        self.has_failed = true;
        self.fault.set(Error::Driver { resident: self.resident.clone(), why, at_us: now });
        Next::Done
    }

    fn pose(&self) -> (Point, Posture) {
        // Where nobody can be, nothing is computed.
        if self.has_failed {
            (self.home.plan.rooms.first().map_or(Point::ZERO, |room| room.outline[0]), Posture::Standing)
        } else {
            self.driver.pose()
        }
    }

    fn copy(&self) -> Box<dyn Decide> {
        Box::new(self.clone())
    }
}
