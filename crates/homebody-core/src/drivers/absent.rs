//! Nobody decides: the resident is out for the whole run.

use super::{Driver, MotionSegment, Next, Surroundings};
use crate::event::MotionState;
use crate::scenario::path::Posture;
use crate::time::NEVER;

/// The driver of a resident for whom there is none.
#[derive(Clone, Copy, Debug)]
pub struct Absent;

impl Driver for Absent {
    fn next(&mut self, around: &Surroundings) -> Next {
        let (begin, end) = (around.now(), NEVER);
        Next::Segment(MotionSegment { begin, end, doing: MotionState::Away, posture: Posture::Standing })
    }

    fn copy(&self) -> Box<dyn Driver> {
        Box::new(*self)
    }
}
