//! Plain arithmetic sixty times a second: every body against every beam, without physics engine, grid or masks.
//!
//! We assume, as the kernel does, that a sensor sees a body that touches a beam and has changed since the last look.
//!
//! The beams come from the baked field, so walls cost nothing; each look computes the distance of each changed body to
//! each beam of each sensor.
//!
//! Left out: the levels `sensitivity` and `zones`.

use crate::{Eye, Pose};
use homebody_core::home::Home;
use homebody_core::home::field::Field;

pub struct BruteEye<'a> {
    field: &'a Field,
    sensors: usize,
    last: Vec<Pose>,
}

impl<'a> BruteEye<'a> {
    pub fn new(home: &Home, field: &'a Field) -> BruteEye<'a> {
        BruteEye { field, sensors: home.sensors.len(), last: Vec::new() }
    }
}

impl Eye for BruteEye<'_> {
    fn look(&mut self, bodies: &[Pose], changed: &mut [bool]) {
        for (sensor, changed) in changed.iter_mut().enumerate().take(self.sensors) {
            *changed = bodies.iter().enumerate().any(|(index, pose)| {
                // A body counts with its largest size since the last look.
                self.last.get(index).is_some_and(|last| last != pose) && self.field.sees(sensor, pose.at)
            });
        }
        self.last.clear();
        self.last.extend_from_slice(bodies);
    }
}
