//! What is wrong with a driver's answer. Drivers may be anybody's, so no answer is taken on trust.

use super::{MotionSegment, Next};
use crate::event::MotionState;
use crate::geometry::Point;
use crate::ids::ThingId;
use crate::time::{Micros, seconds};
use std::fmt;

/// A driver has answered with what no body can do. The run ends at that instant.
#[derive(Clone, Debug, PartialEq)]
pub struct DriverError {
    /// The name of the resident whose driver it is.
    pub resident: String,
    /// When it was asked: microseconds since the start of the run.
    pub at: Micros,
    /// What is wrong with the answer.
    pub fault: DriverFault,
}

/// What is wrong with an answer. Instants are in microseconds since the start of the run, places in metres.
#[derive(Clone, Debug, PartialEq)]
pub enum DriverFault {
    /// The segment begins at another instant than that at which the driver was asked.
    BeginsElsewhen {
        /// When the segment begins.
        begin: Micros,
    },
    /// The segment ends when it begins, or before.
    EndsTooSoon {
        /// When the segment ends.
        end: Micros,
    },
    /// A number that is infinite, none at all (NaN), or below 0 where that cannot be; `what` says which.
    NoNumber {
        /// Which number, as a part of a sentence.
        what: &'static str,
    },
    /// The segment begins elsewhere than where the body is.
    Jump {
        /// Where the body is.
        from: Point,
        /// Where the segment begins.
        to: Point,
    },
    /// A place further than [`WALL_M`] from every room and every opening of a door.
    Outside {
        /// The place.
        at: Point,
    },
    /// There are only `things` things.
    NoSuchThing {
        /// The thing that was named.
        thing: ThingId,
        /// How many things the home has.
        things: usize,
    },
    /// So many answers that take no time, one after the other.
    NoEnd {
        /// How many there were.
        answers: usize,
    },
    /// The driver itself says that it cannot go on.
    Failed {
        /// Why, in its own words.
        why: String,
    },
}

/// Largest difference between the end of a segment and the start of the next, by rounding (our choice).
pub const JUMP_M: f64 = 0.01;

/// Distance from the rooms and doors of the home within which a body is inside (our choice): a wall is thinner.
pub const WALL_M: f64 = 0.5;

/// Largest number of answers without duration at one instant (our choice).
pub const MOST_ANSWERS: usize = 100_000;

impl DriverFault {
    /// What is wrong with an answer that was asked for at `now`, of a body that is at `here` (`None` while it is away) in a
    /// home of so many things. Whether its place is in the home is not looked at.
    #[inline]
    pub(crate) fn of(answer: &Next, now: Micros, here: Option<Point>, things: usize) -> Option<DriverFault> {
        let no_number = |what| Some(DriverFault::NoNumber { what });
        match answer {
            Next::Segment(segment) => DriverFault::of_segment(segment, now, here),
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
    fn of_segment(segment: &MotionSegment, now: Micros, here: Option<Point>) -> Option<DriverFault> {
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

    /// `None`: what is wrong says already what to do.
    fn hint(&self) -> Option<&'static str> {
        Some(match self {
            DriverFault::BeginsElsewhen { .. } => "a segment begins when the driver is asked: at `around.now()`",
            DriverFault::EndsTooSoon { .. } => "a segment takes at least a microsecond",
            DriverFault::NoNumber { .. } => "places, amplitudes and levels are finite, and amplitudes not below 0",
            DriverFault::Jump { .. } => "let the body walk there, or go away and come back",
            DriverFault::Outside { .. } => "who leaves the home is `MotionState::Away`",
            DriverFault::NoSuchThing { .. } => "find it by its name with `Plan::thing`",
            DriverFault::NoEnd { .. } => "answer with a segment, which takes time",
            DriverFault::Failed { .. } => return None,
        })
    }
}

impl fmt::Display for DriverError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let DriverError { resident, at, fault } = self;
        write!(f, "the driver of {resident:?}, asked at {} s, ", seconds(*at))?;
        if let DriverFault::Failed { why } = fault {
            return write!(f, "cannot go on: {why}");
        }
        f.write_str("gave ")?;
        match *fault {
            DriverFault::BeginsElsewhen { begin } => write!(f, "a segment that begins at {} s", seconds(begin)),
            DriverFault::EndsTooSoon { end } => write!(f, "a segment that ends at {} s", seconds(end)),
            DriverFault::NoNumber { what } => write!(f, "a number that is none, for {what}"),
            DriverFault::Jump { from, to } => write!(f, "a segment at {to:.2}, but the body is at {from:.2}"),
            DriverFault::Outside { at } => write!(f, "a place outside the home, {at:.2}"),
            DriverFault::NoSuchThing { thing, things } => {
                write!(f, "the use of thing {}, but the home has {things}, counted from 0", thing.0)
            }
            DriverFault::NoEnd { answers } => write!(f, "{answers} answers that take no time"),
            DriverFault::Failed { .. } => Ok(()),
        }?;
        fault.hint().map_or(Ok(()), |hint| write!(f, "\n  hint: {hint}"))
    }
}

impl std::error::Error for DriverError {}
