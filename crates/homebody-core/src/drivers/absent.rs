//! A resident who is out for the whole run.

use crate::drivers::{Driver, Next, Surroundings};
use crate::motion::{MotionSegment, MotionState};
use crate::posture::Posture;
use crate::time::RunTime;

/// The driver of a resident without a driver.
#[derive(Clone, Copy, Debug)]
pub struct Absent;

impl Driver for Absent {
    fn next(&mut self, around: &Surroundings) -> Next {
        let (begin, end) = (around.now(), RunTime::NEVER);
        Next::Segment(MotionSegment { begin, end, doing: MotionState::Away, posture: Posture::Standing })
    }

    fn copy(&self) -> Box<dyn Driver> {
        Box::new(*self)
    }
}
