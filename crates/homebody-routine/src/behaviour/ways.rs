use super::driver::{RoutineDriver, WalkPurpose};
use super::item::Item;
use super::manner::Manner;
use super::places::HomePlace;
use super::script::{ActivityStep, Interruptible, StayStep};
use crate::routine::{Activity, WalkRests};
use homebody_core::drivers::Next;
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::posture::Posture;
use homebody_core::random::Stream;
use homebody_core::time::{RunTime, SECOND, Span};
use std::collections::VecDeque;

homebody_core::numbers! {
    /// Time that a person who finds no way stands still, so that an attempt always takes time.
    static AT_A_LOSS_S = "driver.at_a_loss": 60.0, "s", [1.0, 3_600.0];
}

/// Shortest stretch between two rests, in metres (our choice).
const SHORTEST_STRETCH_M: f64 = 1.0;

/// Shortest stay that is a rest from walking (our choice).
const LEAST_REST: Span = SECOND.times(5);

fn metres(segment: &MotionSegment) -> f64 {
    match segment.doing {
        MotionState::Stride { from, to } => from.distance(to),
        _ => 0.0,
    }
}

/// A way with a rest after each longest stretch. The first stretch may have begun before the way.
fn with_rests(
    moves: Vec<MotionSegment>,
    rests: WalkRests,
    walked_m: &mut f64,
    stream: &mut Stream,
) -> Vec<MotionSegment> {
    let most_m = rests.after_m.max(SHORTEST_STRETCH_M);
    let (mut delay, mut all) = (Span::ZERO, Vec::new());
    for segment in moves {
        let mut left = MotionSegment { begin: segment.begin + delay, end: segment.end + delay, ..segment };
        while *walked_m + metres(&left) > most_m {
            let share = ((most_m - *walked_m) / metres(&left)).max(0.0);
            let cut = left.begin + (left.end - left.begin).share(share);
            if cut >= left.end {
                break;
            }
            if cut > left.begin {
                let [first, rest] = left.split(cut);
                all.push(first);
                left = rest;
            }
            let MotionState::Stride { from, .. } = left.doing else { break };
            let lasts = Span::from_seconds(rests.lasts.draw(stream)).max(SECOND);
            let (doing, posture) = (MotionState::Rest { at: from }, Posture::Standing);
            all.push(MotionSegment { begin: left.begin, end: left.begin + lasts, doing, posture });
            left = MotionSegment { begin: left.begin + lasts, end: left.end + lasts, ..left };
            (*walked_m, delay) = (0.0, delay + lasts);
        }
        // A turn is too short to be a rest.
        let is_rest = !matches!(left.doing, MotionState::Stride { .. }) && left.end - left.begin >= LEAST_REST;
        *walked_m = if is_rest { 0.0 } else { *walked_m + metres(&left) };
        all.push(left);
    }
    all
}

impl RoutineDriver {
    /// A stay of this length, after which a longest stretch begins anew.
    pub(super) fn rest_for(&mut self, lasts: Span) {
        if lasts >= LEAST_REST {
            self.walked_m = 0.0;
        }
    }

    /// The purpose of an activity's walks. Sitting down after an errand is the way back.
    pub(super) fn walks_for(&mut self, item: &Item) -> WalkPurpose {
        let was_errand = std::mem::take(&mut self.was_errand);
        match item.activity {
            Activity::Housework if item.is_errand() => {
                self.errands.run();
                self.was_errand = true;
                WalkPurpose::Errand
            }
            Activity::Prepare(_) | Activity::Housework => WalkPurpose::Cooking,
            Activity::Wander | Activity::Pace | Activity::Lap => WalkPurpose::Roaming,
            _ if item.is_filler() && was_errand => WalkPurpose::Back,
            _ => WalkPurpose::Need,
        }
    }

    pub(super) fn go(&mut self, spot: HomePlace, now: RunTime) {
        let Some(spot) = self.free_spot(spot.clone()) else { return self.wait_for(spot, now) };
        let hour = self.hour(now);
        let Some(playing) = self.scripts.last_mut() else { return };
        // To step aside does not end the wait.
        if !matches!(playing.steps.front(), Some(ActivityStep::Wait(_))) {
            playing.waits = 0;
        }
        let from = self.body.room();
        let Some(moves) = self.body.go(&spot, now, hour, self.parameters.pace, &mut playing.stream) else {
            return self.give_up(false, now);
        };
        let moves = match self.life.rests {
            Some(rests) if self.visitor.is_none() => with_rests(moves, rests, &mut self.walked_m, &mut playing.stream),
            _ => moves,
        };
        playing.spot = Some(spot.clone());
        let metres: f64 = moves.iter().map(metres).sum();
        match playing.walks {
            WalkPurpose::Need => self.errands.need(hour, metres),
            WalkPurpose::Errand => self.errands.errand(metres),
            WalkPurpose::Back => {
                self.errands.errand(metres);
                // After an interruption, the way back to sitting down is necessary.
                playing.walks = WalkPurpose::Need;
            }
            WalkPurpose::Cooking | WalkPurpose::Roaming => {}
        }
        let is_errand = playing.walks == WalkPurpose::Errand;
        let arrival = moves.last().map_or(now, |last| last.end);
        self.lamps(from, spot.room, now, moves);
        self.watches.arrive(spot.room, &spot.name, &self.home.plan, arrival, &self.life);
        // A resident who comes in notices things left on, on an errand only the thing itself. One who stays in the room
        // does not, or nothing could be forgotten in a home of one room.
        for thing in self.watches.left_on() {
            let is_there = spot.name == self.places.thing_name(thing);
            let comes_in = from != spot.room && !is_errand;
            if self.home.plan.room_at(self.home.plan.things[thing as usize].at) == spot.room && (is_there || comes_in) {
                self.act(thing, false, arrival);
            }
        }
    }

    /// Without a route, the rest of the activity is dropped. A night is spent on the spot, and visitors stay where they
    /// are.
    pub(super) fn give_up(&mut self, is_blocked: bool, now: RunTime) {
        let is_visit = self.visitor.is_some();
        let Some(playing) = self.scripts.last_mut() else { return };
        if is_visit || playing.steps.iter().any(|step| matches!(step, ActivityStep::Wake)) {
            return;
        }
        let at_a_loss = StayStep {
            posture: self.body.posture(),
            manner: Manner::BUSY.with_numbers(&self.life.numbers),
            left: Span::from_seconds(self.life.numbers.of(&AT_A_LOSS_S)),
            until: None,
            may: Interruptible::Nothing,
        };
        let at_a_loss = if is_blocked { ActivityStep::Wait(at_a_loss) } else { ActivityStep::Stay(at_a_loss) };
        self.tally.no_way(playing.of.take());
        let left = std::mem::replace(&mut playing.steps, VecDeque::from([at_a_loss]));
        let mut stays_on = Vec::new();
        for step in left {
            match step {
                ActivityStep::Meet(need) => self.needs.put_off(need, now),
                ActivityStep::Act(thing, false) if self.watches.is_on(thing) => stays_on.push(thing),
                _ => {}
            }
        }
        // The next passer-by turns it off.
        self.watches.forget(stays_on);
    }

    pub(super) fn away(&mut self, lasts: Span, until: Option<RunTime>, now: RunTime) {
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
