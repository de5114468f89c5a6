//! Those who come to visit: out until a visit that the routine of whom they visit has planned, then at the door, on a seat, and
//! out again.

use super::agenda::Agenda;
use super::driver::{MINUTE, RoutineDriver};
use super::manner::Manner;
use super::script::{Interruptible, Stay, Step};
use homebody_core::activity::VISITING;
use homebody_core::drivers::{MotionSegment, Next};
use homebody_core::event::MotionState;
use homebody_core::role::Role;
use homebody_core::scenario::path::Posture;
use homebody_core::time::{Micros, SECOND};
use std::collections::VecDeque;

/// How long a visitor waits for the door to open before going away: hosts are on the toilet, or on their way home (ours).
const PATIENCE: Micros = 60 * MINUTE;

impl RoutineDriver {
    /// A visitor is out until the next visit.
    pub(super) fn await_visit(&mut self, now: Micros) {
        let name = self.visitor.clone();
        for _ in 0..400 {
            let visit =
                self.agenda.items.iter().skip(self.next_item).position(|item| item.visitor == name && item.start > now);
            if let Some(visit) = visit {
                self.next_item += visit + 1;
                return self.come_to_visit(self.next_item - 1);
            }
            let day = self.agenda.day + 1;
            self.agenda = Agenda::of(&self.life, day, &self.life.parameters(day));
            self.midnight = self.life.midnight(day);
            self.next_item = 0;
        }
        let end = now.saturating_add(30 * 1440 * MINUTE);
        self.ready.push_back(Next::Segment(MotionSegment {
            begin: now,
            end,
            doing: MotionState::Away,
            posture: Posture::Standing,
        }));
    }

    pub(super) fn come_to_visit(&mut self, item: usize) {
        let item = self.agenda.items[item].clone();
        let stream = self.life.stream_of_day(self.agenda.day, &format!("{}/visitor", item.key));
        let door = self.places.of(Role::FrontDoor).cloned();
        if let Some(door) = &door {
            self.body.place(door.clone(), Posture::Standing);
        }
        let talk = |posture, left| {
            Step::Stay(Stay { posture, manner: Manner::TALKING, left, until: None, may: Interruptible::Nothing })
        };
        let mut steps = VecDeque::from([Step::Away { lasts: 0, until: Some(item.start) }]);
        steps.push_back(Step::Ring { left: PATIENCE });
        steps.push_back(Step::Name(VISITING.into()));
        steps.push_back(talk(Posture::Standing, 40 * SECOND));
        if let Some(seat) = self.places.of(Role::GuestSeat) {
            steps.push_back(Step::Go(seat.clone()));
            steps.push_back(talk(seat.posture, item.lasts));
        }
        steps.extend(door.map(Step::Go));
        steps.push_back(talk(Posture::Standing, 40 * SECOND));
        // Out of the home is no activity of theirs.
        steps.push_back(Step::Name(String::new()));
        self.play(steps, stream, VISITING);
    }
}
