//! What somebody turns on and off on the way: lamps in the dark, and whatever a script uses.

use super::driver::RoutineDriver;
use homebody_core::drivers::{MotionSegment, Next};
use homebody_core::event::ThingUse;
use homebody_core::ids::ThingId;
use homebody_core::role::Role;
use homebody_core::time::Micros;

impl RoutineDriver {
    /// Puts a walk on its way: in the dark, the lamp of the room that is left goes off, that of the other on.
    pub(super) fn lamps(&mut self, from: Option<usize>, to: Option<usize>, now: Micros, moves: Vec<MotionSegment>) {
        let (off, on) = (self.lamp(from), self.lamp(to));
        if let Some(off) = off.filter(|&lamp| from != to && self.watches.is_on(lamp)) {
            self.act(off, false, now);
        }
        let arrival = moves.last().map_or(now, |last| last.end);
        self.ready.extend(moves.into_iter().map(Next::Segment));
        // Nobody lights the bedroom to go back to sleep.
        let to_sleep = self.needs.asleep() && to == self.places.of(Role::Bed).and_then(|bed| bed.room);
        let dark = self.home.is_dark(now) && !to_sleep;
        if let Some(on) = on.filter(|&lamp| dark && !self.watches.is_on(lamp)) {
            self.act(on, true, arrival);
        }
    }

    fn lamp(&self, room: Option<usize>) -> Option<u32> {
        room.map(|room| self.places.lamp(room))
    }

    /// Turns off the lamp of the room it is in, if it is this resident who has it on.
    pub(super) fn put_out_the_lamp(&mut self, now: Micros) {
        if let Some(lamp) = self.lamp(self.body.room()).filter(|&lamp| self.watches.is_on(lamp)) {
            self.act(lamp, false, now);
        }
    }

    pub(super) fn act(&mut self, thing: u32, on: bool, at: Micros) {
        self.watches.turn(thing, on, at, &self.life, &self.places);
        self.ready.push_back(Next::Use(ThingUse { thing: ThingId(thing), on }));
    }
}
