//! Drivers: who decides what a resident's body does next.
//!
//! A driver is asked at the instant its last segment ends, with its [`Surroundings`], and answers with the next one. Of
//! sensors it knows nothing. A copy of a driver decides as the original.
//!
//! A driver may be written elsewhere. What is wrong with its answers, [`error`] says.

pub mod absent;
pub mod error;
pub mod live;
pub mod path;
pub mod surroundings;

use crate::event::{MotionState, Need, ThingUse, Vitals};
use crate::geometry::Point;
use crate::scenario::path::Posture;
use crate::stride::Stride;
use crate::time::Micros;
use live::Input;
use std::fmt;
pub use surroundings::{Body, Occupant, Surroundings};

/// What a body does over a span; the spans of one resident follow each other without gaps.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionSegment {
    /// From when, in microseconds since the run's start.
    pub begin: Micros,
    /// Later than `begin`.
    pub end: Micros,
    /// What the body does.
    pub doing: MotionState,
    /// How it holds itself meanwhile.
    pub posture: Posture,
}

impl MotionSegment {
    /// The part of it before an instant, which is not before its beginning.
    pub fn until(&self, end: Micros) -> MotionSegment {
        if self.end <= end {
            return self.clone();
        }
        let doing = match self.doing {
            MotionState::Stride { from, to } => {
                MotionState::Stride { from, to: Stride::new(from, to, self.begin, self.end).position(end) }
            }
            doing => doing,
        };
        MotionSegment { end, doing, ..*self }
    }

    /// Whether the body, which was doing `before` until this segment begins, just stays on as it is.
    pub fn goes_on(&self, before: &MotionSegment) -> bool {
        let walks = matches!(self.doing, MotionState::Stride { .. });
        !walks && before.end == self.begin && before.doing == self.doing && before.posture == self.posture
    }

    /// Where the body is at an instant of the segment, its end included; `None` while away.
    pub fn position(&self, at: Micros) -> Option<Point> {
        match self.doing {
            MotionState::Stride { from, to } => Some(Stride::new(from, to, self.begin, self.end).position(at)),
            MotionState::InPlace { at, .. } | MotionState::Rest { at } => Some(at),
            MotionState::Away => None,
        }
    }

    /// Where the body is at the end of the segment; `None` while away.
    pub fn to(&self) -> Option<Point> {
        match self.doing {
            MotionState::Stride { to, .. } => Some(to),
            MotionState::InPlace { at, .. } | MotionState::Rest { at } => Some(at),
            MotionState::Away => None,
        }
    }
}

/// A driver's answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Next {
    /// What the body does from now on. It begins now and where the last one ended; who rests for ever does so until
    /// [`NEVER`](crate::time::NEVER).
    Segment(MotionSegment),
    /// From this instant on the resident does this, or nothing that has a name. It takes no time: ask again.
    Activity(Option<String>),
    /// The resident uses a thing. It takes no time: ask again.
    Use(ThingUse),
    /// From this instant on heart and lungs are like this. It takes no time: ask again.
    Vitals(Vitals),
    /// For the truth: how strong a need is, from 0 to 1. It takes no time: ask again.
    Need(Need, f64),
    /// For the truth: from this instant on a condition is this severe. It takes no time: ask again.
    Condition(String, f64),
}

/// Who decides what a resident does.
pub trait Driver: fmt::Debug + Send + Sync {
    /// What the resident does from now on. It is asked at 0 and whenever a segment ends, and again after each answer that
    /// takes no time. The first segment says where the body is; each later one begins where the last one ended, but after a
    /// time away. An answer that no body can follow ends the run: see [`error::DriverFault`].
    fn next(&mut self, around: &Surroundings) -> Next;

    /// A copy that decides as the original.
    fn copy(&self) -> Box<dyn Driver>;

    /// From now on input may come while the run goes on, besides what the driver knows already. False if it takes none.
    fn open_input(&mut self) -> bool {
        false
    }

    /// From `at` on the input is this. Only for a driver whose input is open.
    fn input(&mut self, _at: Micros, _input: Input) {}
}

impl Clone for Box<dyn Driver> {
    fn clone(&self) -> Box<dyn Driver> {
        self.copy()
    }
}
