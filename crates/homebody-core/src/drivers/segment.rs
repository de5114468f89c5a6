//! What a body does for a time, as drivers say it.

use crate::event::MotionState;
use crate::geometry::Point;
use crate::scenario::path::Posture;
use crate::stride::Stride;
use crate::time::Micros;

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
