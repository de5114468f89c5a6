//! Labels of the ground truth: the way to the place of an activity, and waiting, are not part of it.

use super::current_activity::ActivityPart;
use super::driver::RoutineDriver;
use super::script::ActivityStep;
use homebody_core::activity::{WAITING, WALKING};

impl RoutineDriver {
    /// The label in the ground truth for the present movement.
    pub(super) fn label(&self) -> &str {
        match self.part {
            ActivityPart::Way => WALKING,
            ActivityPart::Wait => WAITING,
            ActivityPart::Itself => &self.name,
        }
    }

    /// Sets the part of the activity that a step belongs to: the first way leads to its place.
    pub(super) fn set_part(&mut self, step: &ActivityStep) {
        let Some(playing) = self.scripts.last_mut() else { return };
        match step {
            ActivityStep::Name(_) => playing.is_there = false,
            ActivityStep::Meet(_) | ActivityStep::LieDown | ActivityStep::Wake | ActivityStep::KeepCompany => {}
            ActivityStep::Go(_) if !playing.is_there => self.part = ActivityPart::Way,
            _ => (playing.is_there, self.part) = (true, ActivityPart::Itself),
        }
    }
}
