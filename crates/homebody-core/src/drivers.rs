//! Drivers: who decides what a resident's body does next.
//!
//! A driver is asked at the instant its last segment ends, with its [`Surroundings`], and answers with the next one. Of
//! sensors it knows nothing. A copy of a driver decides as the original.
//!
//! A driver may be written elsewhere. [`error`] describes the faults of its answers.

pub mod absent;
pub mod error;
pub mod input;
pub mod live;
pub mod path;
pub mod surroundings;

use crate::event::{BodilyNeed, ThingUse, Vitals};
use crate::motion::MotionSegment;
use crate::time::{RunTime, Span};
use input::Input;
use std::any::Any;
use std::fmt;
pub use surroundings::{Occupant, PlacedBody, Surroundings};

/// A driver's answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Next {
    /// The movement of the body from now on, from the end of the last one. A body that rests for ever does so until
    /// [`RunTime::NEVER`].
    Segment(MotionSegment),
    /// From this instant on the resident does this, or nothing that has a name. It takes no time: ask again.
    Activity(Option<String>),
    /// The resident uses a thing. It takes no time: ask again.
    Use(ThingUse),
    /// From this instant on heart and lungs are like this. It takes no time: ask again.
    Vitals(Vitals),
    /// For the truth: how strong a need is, from 0 to 1. It takes no time: ask again.
    Need(BodilyNeed, f64),
    /// For the truth: from this instant on a condition is this severe. It takes no time: ask again.
    Condition(String, f64),
    /// The driver has failed: the reason in words for people, with a hint. It ends the run.
    Failed(String),
}

/// The decisions of a resident.
pub trait Driver: fmt::Debug + Send + Sync {
    /// The next decision of the resident. It is asked at the start and whenever a segment ends, and again after each
    /// answer that takes no time. The first segment gives the position of the body; each later one begins where the
    /// last one ended, except after an absence. An answer that no body can follow ends the run: see
    /// [`error::DriverFault`].
    fn next(&mut self, around: &Surroundings) -> Next;

    /// A copy that decides as the original.
    fn copy(&self) -> Box<dyn Driver>;

    /// The driver itself, for callers that know its type and read its results after a run; `None` if it has no results.
    fn as_any(&self) -> Option<&dyn Any> {
        None
    }

    /// From now on input may come during the run, in addition to the input that the driver has. False if it takes none.
    fn open_input(&mut self) -> bool {
        false
    }

    /// The body, which is at home, has fallen where it is, for a reason outside of it: what it was doing ended now. From now on it
    /// lies on the floor for so long, and gets up then; the driver says so when it is asked next, at this instant. False if its
    /// bodies do not fall; then nothing has changed.
    fn falls(&mut self, _around: &Surroundings, _lies: Span) -> bool {
        false
    }

    /// From `at` on the input is this. Only for a driver whose input is open.
    fn input(&mut self, _at: RunTime, _input: Input) {}
}

impl Clone for Box<dyn Driver> {
    fn clone(&self) -> Box<dyn Driver> {
        self.copy()
    }
}
