use super::driver::RoutineDriver;
use homebody_core::drivers::Next;
use homebody_core::motion::MotionSegment;
use homebody_core::role::Role;
use homebody_core::time::RunTime;

impl RoutineDriver {
    /// Adds switching of lamps to a walk: in the dark, off in the room that is left, on in the next.
    pub(super) fn lamps(&mut self, from: Option<usize>, to: Option<usize>, now: RunTime, moves: Vec<MotionSegment>) {
        let (off, on) = (self.lamp(from), self.lamp(to));
        if let Some(off) = off.filter(|&lamp| from != to && self.watches.is_on(lamp)) {
            self.act(off, false, now);
        }
        let arrival = moves.last().map_or(now, |last| last.end);
        self.ready.extend(moves.into_iter().map(Next::Segment));
        // No light in the bedroom on the way back to sleep.
        let to_sleep = self.needs.asleep() && to == self.places.for_role(Role::Bed).and_then(|bed| bed.room);
        let dark = self.home.is_dark(now) && !to_sleep;
        if let Some(on) = on.filter(|&lamp| dark && !self.watches.is_on(lamp)) {
            self.act(on, true, arrival);
        }
    }

    fn lamp(&self, room: Option<usize>) -> Option<u32> {
        room.map(|room| self.places.lamp(room))
    }

    /// Turns off the lamp of its room, if this resident turned it on.
    pub(super) fn put_out_the_lamp(&mut self, now: RunTime) {
        if let Some(lamp) = self.lamp(self.body.room()).filter(|&lamp| self.watches.is_on(lamp)) {
            self.act(lamp, false, now);
        }
    }
}
