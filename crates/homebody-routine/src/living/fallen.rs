//! A fall that nobody has planned: somebody outside of the home says so.
//!
//! It interrupts whatever is done, as a need does. Who walks or stands falls there and then; who sits or lies gets up first, and
//! falls beside the chair or the bed. Afterwards they go back to what they were doing.

use super::driver::RoutineDriver;
use super::manner::Manner;
use super::script::{Interruptible, Stay, Step};
use homebody_core::activity::FALLEN;
use homebody_core::drivers::{MotionSegment, Next, Surroundings};
use homebody_core::event::MotionState;
use homebody_core::scenario::path::Posture;
use homebody_core::time::{Micros, SECOND};

/// How long it takes to get up from the floor, as in the falls of routines (ours).
const GETS_UP: Micros = 60 * SECOND;

impl RoutineDriver {
    /// Falls now, and lies there for so long. Visitors do not: their host waits for them to leave.
    pub(super) fn fall_now(&mut self, around: &Surroundings, lies: Micros) -> bool {
        let (now, Some(body), None) = (around.now(), around.body(), &self.visitor) else { return false };
        self.ready.clear();
        self.sight.rest = None;
        (self.pauses, self.queues, self.pushes_through) = (0, 0, false);
        // Whoever falls while they lie there already lies for so long from now on.
        if self.scripts.last().is_some_and(|playing| playing.label == FALLEN) {
            self.scripts.pop();
        }
        let here = MotionState::Rest { at: body.at };
        self.body.follow(&MotionSegment { begin: now, end: now, doing: here, posture: body.posture });
        let stay = |posture, manner, left| {
            Step::Stay(Stay { posture, manner, left, until: None, may: Interruptible::Nothing })
        };
        let steps = [
            Step::Name(FALLEN.into()),
            stay(Posture::Lying, Manner::FALLEN, lies),
            stay(Posture::Sitting, Manner::TURNING, GETS_UP),
        ];
        let stream = self.life.stream_of_day(self.agenda.day, &format!("outside/{now}/fall"));
        self.play(steps.into(), stream, FALLEN);
        self.watches.does(FALLEN, now, &self.life);
        let (hour, pace) = (self.hour(now), self.parameters.pace);
        if let Some(playing) = self.scripts.last_mut().filter(|_| body.posture != Posture::Standing) {
            let moves = self.body.get_up(now, hour, pace, &mut playing.stream);
            self.ready.extend(moves.into_iter().map(Next::Segment));
        }
        true
    }
}
