//! Faults of a driver's answer. Any program may supply a driver, so each answer is checked.

use crate::drivers::Next;
use crate::geometry::Point;
use crate::ids::ThingId;
use crate::messages::{Datum, Value};
use crate::motion::{MotionSegment, MotionState};
use crate::problem::{Diagnose, Diagnostic};
use crate::time::RunTime;
use std::fmt;

/// A driver has answered with what no body can do. The run ends at that instant.
#[derive(Clone, Debug, PartialEq)]
pub struct DriverError {
    /// The name of the resident whose driver it is.
    pub resident: String,
    /// When it was asked.
    pub at: RunTime,
    /// The fault of the answer.
    pub fault: DriverFault,
}

crate::messages! {
    /// A problem with an answer. Places are in metres.
    #[derive(Clone, PartialEq)]
    pub enum DriverFault in "driver" {
        /// A driver answers at an instant with the segment of movement that begins then.
        BeginsElsewhen { begin: RunTime }
            error "wrong-begin" ("its segment of movement begins at {begin_s} s, not at the time of the question", begin_s = begin.seconds())
            hint ("begin a segment at the time of the question: `around.now()`");
        /// A segment of movement takes time: its end is after its begin.
        EndsTooSoon { end: RunTime }
            error "wrong-end" ("its segment ends at {end_s} s, which is not after its begin", end_s = end.seconds())
            hint ("let a segment last at least a microsecond");
        /// A number is infinite, not a number (NaN), or negative where that is impossible.
        NoNumber {
            /// The number, as a part of a sentence.
            what: &'static str,
        } error "invalid-number" ("it gave an invalid number for {what}")
            hint ("give finite numbers, and an amplitude of at least 0");
        /// A body does not jump: each segment begins where the one before it ended.
        Jump { from: Point, to: Point }
            error "jump" ("its segment of movement begins at {to:.2}, but the body is at {from:.2}")
            hint ("let the body walk there, or leave the home and come back");
        /// The place is more than half a metre from every room and every opening of a door.
        Outside { at: Point } error "outside-home" ("it gave a place outside the home, {at:.2}")
            hint ("use `MotionState::Away` for a resident who leaves the home");
        /// A thing has a number from 0 on. The home does not have so many things.
        NoSuchThing { thing: ThingId, things: usize }
            error "unknown-thing" ("it uses the thing {number}, but the home has {things} things, numbered from 0", number = thing.0)
            hint ("find a thing by its name with `Plan::thing`");
        /// The driver was asked again and again at one instant, and gave only answers that take no time.
        NoEnd { answers: usize } error "no-progress" ("it gave {answers} answers in a row that take no time")
            hint ("answer with a segment, which takes time");
        /// The driver reports that it cannot continue, for example because a script has failed.
        Failed {
            /// The reason, in the driver's own words.
            why: String,
        } error "failed" ("{why}");
    }
}

impl Datum for ThingId {
    fn datum(&self) -> Value {
        self.0.datum()
    }
}

/// Largest difference between the end of a segment and the start of the next, by rounding (our choice).
pub const JUMP_M: f64 = 0.01;

/// Distance from the rooms and doors of the home within which a body is inside (our choice): a wall is thinner.
pub const WALL_M: f64 = 0.5;

/// Largest number of answers without duration at one instant (our choice).
pub const MOST_ANSWERS: usize = 100_000;

impl DriverFault {
    /// The fault of an answer at `now`, of a body at `here` (`None` while it is away) in a home with a number of
    /// things. Whether its position is in the home is not checked.
    #[inline]
    pub(crate) fn in_answer(answer: &Next, now: RunTime, here: Option<Point>, things: usize) -> Option<DriverFault> {
        let no_number = |what| Some(DriverFault::NoNumber { what });
        match answer {
            Next::Segment(segment) => DriverFault::in_segment(segment, now, here),
            Next::Use(act) if act.thing.index() >= things => {
                Some(DriverFault::NoSuchThing { thing: act.thing, things })
            }
            Next::Vitals(vitals) if !(vitals.pulse.is_finite() && vitals.respiration.is_finite()) => {
                no_number("the vitals")
            }
            Next::Need(_, level) if !level.is_finite() => no_number("the level of a need"),
            Next::Failed(why) => Some(DriverFault::Failed { why: why.clone() }),
            Next::Condition(_, severity) if !severity.is_finite() => no_number("the severity of a condition"),
            _ => None,
        }
    }

    #[inline]
    fn in_segment(segment: &MotionSegment, now: RunTime, here: Option<Point>) -> Option<DriverFault> {
        let &MotionSegment { begin, end, doing, .. } = segment;
        if begin != now {
            return Some(DriverFault::BeginsElsewhen { begin });
        }
        if end <= begin {
            return Some(DriverFault::EndsTooSoon { end });
        }
        let (from, to) = match doing {
            MotionState::Stride { from, to } => (from, to),
            MotionState::InPlace { at, amplitude_m } if amplitude_m.is_finite() && amplitude_m >= 0.0 => (at, at),
            MotionState::InPlace { .. } => return Some(DriverFault::NoNumber { what: "the amplitude" }),
            MotionState::Rest { at } => (at, at),
            MotionState::Away => return None,
        };
        if !(from.is_finite() && to.is_finite()) {
            return Some(DriverFault::NoNumber { what: "the place" });
        }
        let here = here.filter(|&here| here.distance_squared(from) > JUMP_M * JUMP_M)?;
        Some(DriverFault::Jump { from: here, to: from })
    }
}

impl Diagnose for DriverError {
    fn diagnostic(&self) -> Diagnostic {
        let DriverError { resident, at, fault } = self;
        let mut problem = fault.diagnostic();
        problem.what = format!("the driver of {resident:?} failed at {} s: {}", at.seconds(), problem.what);
        problem.data.insert("resident".into(), resident.datum());
        problem.data.insert("at_us".into(), at.datum());
        problem
    }
}

impl fmt::Display for DriverError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.diagnostic().fmt(f)
    }
}

impl std::error::Error for DriverError {}
