//! What a body does for a time, as drivers say it.

use crate::geometry::Point;
use crate::posture::Posture;
use crate::stride::Stride;
use crate::time::{Interval, RunTime};

/// What a body does over a span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MotionState {
    /// A straight movement at constant speed.
    Stride {
        /// Where it begins, in metres.
        from: Point,
        /// Where it ends, in metres.
        to: Point,
    },
    /// Movement on the spot: `amplitude_m` is how far what moves moves.
    InPlace {
        /// Where the body is, in metres.
        at: Point,
        /// How far what moves moves, in metres.
        amplitude_m: f64,
    },
    /// Keeping still.
    Rest {
        /// Where the body is, in metres.
        at: Point,
    },
    /// Out of the home.
    Away,
}

/// What a body does over a span; the spans of one resident follow each other without gaps.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionSegment {
    /// From when.
    pub begin: RunTime,
    /// Later than `begin`.
    pub end: RunTime,
    /// What the body does.
    pub doing: MotionState,
    /// How it holds itself meanwhile.
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

    /// Whether the body, which was doing `before` until this segment begins, just stays on as it is.
    pub fn goes_on(&self, before: &MotionSegment) -> bool {
        let walks = matches!(self.doing, MotionState::Stride { .. });
        !walks && before.end == self.begin && before.doing == self.doing && before.posture == self.posture
    }

    /// Where the body is at an instant of the segment, its end included; `None` while away.
    pub fn position(&self, at: RunTime) -> Option<Point> {
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
