//! Plain arithmetic sixty times a second: every body against every beam, with no physics engine, no grid
//! and no masks.
//!
//! What we assume: as the exact way does, a body that touches a beam and has changed since the last look is seen.
//!
//! How: the beams come from the baked field, so walls cost nothing here; each look computes the distance of
//! each body that has changed to each beam of each sensor.
//!
//! Left out: the levels `sensitivity` and `zones`.

use crate::{Eye, Pose};
use homebody_core::home::Home;
use homebody_core::home::field::Field;

/// The beams of all sensors for bodies of one size.
pub struct BruteEye<'a> {
    field: &'a Field,
    sensors: usize,
    last: Vec<Pose>,
}

impl<'a> BruteEye<'a> {
    /// An eye that has not looked yet, for the sensors of a home and its field of one size of body.
    pub fn new(home: &Home, field: &'a Field) -> BruteEye<'a> {
        BruteEye { field, sensors: home.sensors.len(), last: Vec::new() }
    }
}

impl Eye for BruteEye<'_> {
    fn look(&mut self, bodies: &[Pose], changed: &mut [bool]) {
        for (sensor, changed) in changed.iter_mut().enumerate().take(self.sensors) {
            *changed = bodies.iter().enumerate().any(|(index, pose)| {
                // A body is as large as it ever was since the last look.
                self.last.get(index).is_some_and(|last| last != pose) && self.field.sees(sensor, pose.at)
            });
        }
        self.last.clear();
        self.last.extend_from_slice(bodies);
    }
}
