//! Going somewhere, giving up where no way leads, and being out.

use super::driver::{RoutineDriver, Walks};
use super::manner::Manner;
use super::places::Spot;
use super::script::{Interruptible, Stay, Step};
use homebody_core::drivers::{MotionSegment, Next};
use homebody_core::event::MotionState;
use homebody_core::scenario::path::Posture;
use homebody_core::time::{Micros, SECOND, micros};
use std::collections::VecDeque;

homebody_core::numbers! {
    /// Time that a person who finds no way stands still, so that an attempt always takes time.
    static AT_A_LOSS_S = "driver.at_a_loss": 60.0, "s", [1.0, 3_600.0];
}

/// How far a move leads.
fn metres(segment: &MotionSegment) -> f64 {
    match segment.doing {
        MotionState::Stride { from, to } => from.distance(to),
        _ => 0.0,
    }
}

impl RoutineDriver {
    pub(super) fn go(&mut self, spot: Spot, now: Micros) {
        let Some(spot) = self.free_spot(spot.clone()) else {
            if !self.queue(spot) {
                self.give_up(now);
            }
            return;
        };
        // Waiting is not over where one only waits.
        if !spot.name.is_empty() {
            self.queues = 0;
        }
        let hour = self.hour(now);
        let Some(playing) = self.scripts.last_mut() else { return };
        let from = self.body.room();
        let Some(moves) = self.body.go(&spot, now, hour, self.parameters.pace, &mut playing.stream) else {
            return self.give_up(now);
        };
        playing.spot = Some(spot.clone());
        let metres: f64 = moves.iter().map(metres).sum();
        match playing.walks {
            Walks::Need => self.errands.need(hour, metres),
            Walks::Errand => self.errands.errand(metres),
            Walks::Back => {
                self.errands.errand(metres);
                // Whatever interrupts the sitting down afterwards leads back there of need.
                playing.walks = Walks::Need;
            }
            Walks::Cooking | Walks::Roaming => {}
        }
        let is_errand = playing.walks == Walks::Errand;
        let arrival = moves.last().map_or(now, |last| last.end);
        self.lamps(from, spot.room, now, moves);
        self.watches.arrive(spot.room, &spot.name, &self.home.plan, arrival, &self.life);
        // Who comes by sees what was left on; on an errand only at the thing itself.
        for thing in self.watches.left_on() {
            if self.home.plan.room_at(self.home.plan.things[thing as usize].at) == spot.room
                && (!is_errand || spot.name == self.places.thing_name(thing))
            {
                self.act(thing, false, arrival);
            }
        }
    }

    /// There is no way to where this is done: what is left of it is not done. A night is spent wherever one is, and who visits
    /// stays where they are.
    pub(super) fn give_up(&mut self, now: Micros) {
        let is_visit = self.visitor.is_some();
        let Some(playing) = self.scripts.last_mut() else { return };
        if is_visit || playing.steps.iter().any(|step| matches!(step, Step::Wake)) {
            return;
        }
        let at_a_loss = Stay {
            posture: self.body.posture(),
            manner: Manner::BUSY.by(&self.life.numbers),
            left: micros(self.life.numbers.of(&AT_A_LOSS_S)),
            until: None,
            may: Interruptible::Nothing,
        };
        self.tally.no_way(playing.of.take());
        let left = std::mem::replace(&mut playing.steps, VecDeque::from([Step::Stay(at_a_loss)]));
        let mut stays_on = Vec::new();
        for step in left {
            match step {
                Step::Meet(need) => self.needs.put_off(need, now),
                Step::Act(thing, false) if self.watches.is_on(thing) => stays_on.push(thing),
                _ => {}
            }
        }
        // Whoever comes by turns it off.
        self.watches.forget(stays_on);
    }

    pub(super) fn away(&mut self, lasts: Micros, until: Option<Micros>, now: Micros) {
        let end = until.unwrap_or(now.saturating_add(lasts));
        let end = self.watches.leave(now, end, &self.life).max(now + SECOND);
        self.needs.pause(now);
        self.put_out_the_lamp(now);
        self.ready.push_back(Next::Segment(MotionSegment {
            begin: now,
            end,
            doing: MotionState::Away,
            posture: Posture::Standing,
        }));
        if self.visitor.is_none() {
            self.needs.waking(end, &self.life, self.agenda.day, &self.parameters);
        }
    }
}
