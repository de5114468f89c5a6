//! Drivers: who decides what a resident's body does next.
//!
//! A driver is asked at the instant its last span ends, and answers with the next one. It knows the
//! plan and its own resident; of the other residents it sees only where their bodies are, and of
//! sensors it knows nothing. A copy of a driver decides as the original.

pub mod live;
pub mod path;

use crate::event::{MotionState, Need, ThingUse, Vitals};
use crate::geometry::Point;
use crate::scenario::path::Posture;
use crate::stride::Stride;
use crate::time::{Micros, NEVER};
use live::LiveDriver;
use path::PathDriver;
use std::fmt;

/// What a body does over a span; the spans of one resident follow each other without gaps.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionSegment {
    pub begin: Micros,
    /// Later than `begin`.
    pub end: Micros,
    pub doing: MotionState,
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
}

/// A driver's answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Next {
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
    /// The resident rests where it is for ever.
    Done,
}

/// The body of another resident, as something to run into.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    pub at: Point,
    pub radius_m: f64,
}

/// Who decides what a resident does.
#[derive(Clone, Debug)]
pub enum Driver {
    Path(PathDriver),
    Live(Box<LiveDriver>),
    /// One that this crate does not know, such as a routine.
    Other(Box<dyn Decide>),
    /// Nobody: the resident is out for the whole run.
    Absent,
}

/// What every driver does that is written elsewhere; see [`Driver`] for what each answer means.
pub trait Decide: fmt::Debug + Send + Sync {
    fn next(&mut self, now: Micros) -> Next;
    fn pose(&self) -> (Point, Posture);
    /// A copy that decides as the original.
    fn copy(&self) -> Box<dyn Decide>;
}

impl Clone for Box<dyn Decide> {
    fn clone(&self) -> Box<dyn Decide> {
        self.copy()
    }
}

impl Driver {
    /// What the resident does from `now` on. `now` is the end of the last span, or 0;
    /// `others` are the bodies of the other residents who are at home, for those who mind them, and `on` says which things of
    /// the plan are on, or open.
    pub fn next(&mut self, now: Micros, others: &[Body], on: &[bool]) -> Next {
        match self {
            Driver::Path(driver) => driver.next(now),
            Driver::Live(driver) => driver.next(now, others, on),
            Driver::Other(driver) => driver.next(now),
            Driver::Absent => Next::Segment(MotionSegment {
                begin: now,
                end: NEVER,
                doing: MotionState::Away,
                posture: Posture::Standing,
            }),
        }
    }

    /// Whether the resident runs into others.
    pub fn minds_others(&self) -> bool {
        matches!(self, Driver::Live(_))
    }

    /// Where the body is, and how, at the end of the spans handed out so far.
    pub fn pose(&self) -> (Point, Posture) {
        match self {
            Driver::Path(driver) => driver.pose(),
            Driver::Live(driver) => driver.pose(),
            Driver::Other(driver) => driver.pose(),
            Driver::Absent => (Point::ZERO, Posture::Standing),
        }
    }
}
