//! The movement of a body over a span, as an answer of a driver.

use crate::geometry::Point;
use crate::posture::Posture;
use crate::stride::Stride;
use crate::time::{Interval, RunTime};

/// A movement of a body over a span. Positions are in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs, reason = "each variant says what its data are")]
pub enum MotionState {
    /// A straight movement at constant speed.
    Stride { from: Point, to: Point },
    /// Movement on the spot: `amplitude_m` is how far what moves moves.
    InPlace { at: Point, amplitude_m: f64 },
    /// Keeping still.
    Rest { at: Point },
    /// Out of the home.
    Away,
}

/// A movement over a span. The spans of one resident follow each other without gaps.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionSegment {
    /// From when.
    pub begin: RunTime,
    /// Later than `begin`.
    pub end: RunTime,
    /// The movement.
    pub doing: MotionState,
    /// The posture during the movement.
    pub posture: Posture,
}

impl MotionSegment {
    /// The part of it before an instant, which is not before its beginning.
    pub fn until(&self, end: RunTime) -> MotionSegment {
        self.within(Interval::new(self.begin, end.min(self.end)))
    }

    /// The part of it within an interval that it contains.
    pub fn within(&self, time: Interval<RunTime>) -> MotionSegment {
        let doing = match self.doing {
            MotionState::Stride { from, to } if time != Interval::new(self.begin, self.end) => {
                let stride = Stride::new(from, to, self.begin, self.end);
                MotionState::Stride { from: stride.position(time.begin), to: stride.position(time.end) }
            }
            doing => doing,
        };
        MotionSegment { begin: time.begin, end: time.end, doing, ..*self }
    }

    /// The parts of it before and after an instant within it.
    pub fn split(&self, at: RunTime) -> [MotionSegment; 2] {
        let first = self.until(at);
        let doing = match (first.to(), self.doing) {
            (Some(from), MotionState::Stride { to, .. }) => MotionState::Stride { from, to },
            (_, doing) => doing,
        };
        [first, MotionSegment { begin: at, doing, ..*self }]
    }

    /// Whether the body continues the same rest or absence as `before`.
    pub fn continues(&self, before: &MotionSegment) -> bool {
        let walks = matches!(self.doing, MotionState::Stride { .. });
        !walks && before.end == self.begin && before.doing == self.doing && before.posture == self.posture
    }

    /// The position of the body at an instant of the segment, its end included; `None` while away.
    pub fn position(&self, at: RunTime) -> Option<Point> {
        match self.doing {
            MotionState::Stride { from, to } => Some(Stride::new(from, to, self.begin, self.end).position(at)),
            MotionState::InPlace { at, .. } | MotionState::Rest { at } => Some(at),
            MotionState::Away => None,
        }
    }

    /// The position of the body at the end of the segment; `None` while away.
    pub fn to(&self) -> Option<Point> {
        match self.doing {
            MotionState::Stride { to, .. } => Some(to),
            MotionState::InPlace { at, .. } | MotionState::Rest { at } => Some(at),
            MotionState::Away => None,
        }
    }
}
