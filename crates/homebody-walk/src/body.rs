//! The body of somebody who lives in a home: where it is, how it gets from place to place.

use crate::gait::{Gait, rise, sit, walk};
use crate::mesh::Mesh;
use crate::places::Spot;
use crate::routes::Routes;
use crate::schemas::{Wanderers, Wandering, wander};
use homebody_core::drivers::MotionSegment;
use homebody_core::event::MotionState;
use homebody_core::geometry::Point;
use homebody_core::home::Home;
use homebody_core::random::Stream;
use homebody_core::scenario::path::Posture;
use homebody_core::time::{Micros, SECOND, micros};
use std::sync::Arc;

/// Where a body is, and what it walks by.
#[derive(Clone, Debug)]
pub struct Body {
    home: Arc<Home>,
    routes: Routes,
    pace_mps: f64,
    at: Point,
    posture: Posture,
    spot: Option<Spot>,
}

/// Nearer than this is there.
pub const THERE_M: f64 = 0.01;

homebody_core::numbers! {
    /// Walking speed below which a person is frail in rising and sitting, fully so at half of it: 0.4-0.8 m/s is
    /// limited community walking.
    static FRAIL_MPS = "body.frail": 0.6, "m/s", [0.05, 2.0];
    /// Median time that sitting up takes a person who lies.
    static SITTING_UP_S = "body.sitting_up": 8.0, "s", [0.5, 120.0];
    /// Standard deviation of the logarithm of the time that sitting up takes.
    static SITTING_UP_SPREAD = "body.sitting_up_spread": 0.3, "1", [0.0, 2.0];
    /// Distance that the trunk moves in sitting up.
    static SITTING_UP_AMPLITUDE_M = "body.sitting_up_amplitude": 0.4, "m", [0.0, 1.0];
}

impl Body {
    /// A body that is nowhere yet, of somebody who usually walks so fast.
    pub fn new(home: Arc<Home>, mesh: Arc<Mesh>, pace_mps: f64) -> Body {
        Body { home, routes: Routes::new(mesh), pace_mps, at: Point::ZERO, posture: Posture::Standing, spot: None }
    }

    /// The same body, which remembers so many ways at most.
    pub fn remembering(self, ways: usize) -> Body {
        Body { routes: self.routes.at_most(ways), ..self }
    }

    /// Puts the body somewhere, at the beginning of a run or behind the door.
    pub fn place(&mut self, spot: Spot, posture: Posture) {
        (self.at, self.posture, self.spot) = (spot.at, posture, Some(spot));
    }

    /// The body has begun a move: where it will be.
    pub fn follow(&mut self, next: &MotionSegment) {
        match next.doing {
            MotionState::Stride { to, .. } => self.at = to,
            MotionState::InPlace { at, .. } | MotionState::Rest { at } => self.at = at,
            MotionState::Away => return,
        }
        self.posture = next.posture;
    }

    /// Where it is, in metres.
    pub fn at(&self) -> Point {
        self.at
    }

    /// How it is.
    pub fn posture(&self) -> Posture {
        self.posture
    }

    /// What it walks by.
    pub fn mesh(&self) -> &Arc<Mesh> {
        self.routes.mesh()
    }

    /// The place that it went to last.
    pub fn spot(&self) -> Option<&Spot> {
        self.spot.as_ref()
    }

    /// Index of the plan's room in which it is.
    pub fn room(&self) -> Option<usize> {
        self.home.plan.room_at(self.at)
    }

    /// The moves that take it to a place: rising, walking, sitting or lying down; nothing if there is no way.
    pub fn go(
        &mut self,
        spot: &Spot,
        now: Micros,
        hour: f64,
        pace: f64,
        stream: &mut Stream,
    ) -> Option<Vec<MotionSegment>> {
        if self.at.distance(spot.at) < THERE_M {
            self.spot = Some(spot.clone());
            return Some(Vec::new());
        }
        let path = self.routes.path(self.at, spot.at)?;
        self.spot = Some(spot.clone());
        let mut moves = self.stand_up(now, pace, stream);
        let set_out = moves.last().map_or(now, |last| last.end);
        let gait = Gait::of_walk(self.pace_mps * pace, hour, 0.0, &self.home.numbers, stream);
        moves.extend(walk(&path, self.at, set_out, &gait));
        if spot.posture != Posture::Standing {
            let arrived = moves.last().map_or(set_out, |last| last.end);
            moves.push(sit(spot.at, arrived, self.frailty(pace), spot.posture, &self.home.numbers, stream));
        }
        Some(moves)
    }

    /// The moves of a walk without a goal.
    #[expect(clippy::too_many_arguments, reason = "they are the whole of what wandering depends on")]
    pub fn wander(
        &mut self,
        kind: Wandering,
        lasts: Micros,
        now: Micros,
        hour: f64,
        pace: f64,
        who: Wanderers,
        stream: &mut Stream,
    ) -> Vec<MotionSegment> {
        let mut moves = self.stand_up(now, pace, stream);
        let gait = Gait::of_walk(self.pace_mps * pace, hour, 0.0, &self.home.numbers, stream);
        let from = self.step_out(now, &gait, &mut moves);
        let begin = moves.last().map_or(now, |last| last.end);
        let mesh = self.routes.mesh();
        moves.extend(wander(
            kind,
            mesh,
            &self.home.plan,
            from,
            begin,
            lasts.max(10 * SECOND),
            &gait,
            &self.home.numbers,
            who,
            stream,
        ));
        self.spot = None;
        moves
    }

    /// The moves of getting up, and out of the bed or the chair; none for who stands on free floor.
    pub fn get_up(&mut self, now: Micros, hour: f64, pace: f64, stream: &mut Stream) -> Vec<MotionSegment> {
        let mut moves = self.stand_up(now, pace, stream);
        let gait = Gait::of_walk(self.pace_mps * pace, hour, 0.0, &self.home.numbers, stream);
        self.step_out(now, &gait, &mut moves);
        self.spot = None;
        moves
    }

    /// Sitting or lying down where the body is already.
    pub fn settle(&self, posture: Posture, now: Micros, pace: f64, stream: &mut Stream) -> MotionSegment {
        sit(self.at, now, self.frailty(pace), posture, &self.home.numbers, stream)
    }

    /// Adds the step out of a bed or a chair to the moves; where it leads.
    fn step_out(&self, now: Micros, gait: &Gait, moves: &mut Vec<MotionSegment>) -> Point {
        let beside = self.routes.mesh().approach(self.at).filter(|beside| beside.distance(self.at) > THERE_M);
        let Some(beside) = beside else { return self.at };
        let begin = moves.last().map_or(now, |last| last.end);
        moves.extend(walk(&[beside], self.at, begin, gait));
        beside
    }

    /// Sitting up and rising, if it does not stand.
    fn stand_up(&self, now: Micros, pace: f64, stream: &mut Stream) -> Vec<MotionSegment> {
        let numbers = &self.home.numbers;
        let mut moves = Vec::new();
        if self.posture == Posture::Lying {
            let end = now + micros(stream.lognormal(numbers.of(&SITTING_UP_S), numbers.of(&SITTING_UP_SPREAD)));
            let amplitude_m = numbers.of(&SITTING_UP_AMPLITUDE_M);
            let doing = MotionState::InPlace { at: self.at, amplitude_m };
            moves.push(MotionSegment { begin: now, end, doing, posture: Posture::Sitting });
        }
        if self.posture != Posture::Standing {
            let begin = moves.last().map_or(now, |last| last.end);
            moves.push(rise(self.at, begin, self.frailty(pace), numbers, stream));
        }
        moves
    }

    fn frailty(&self, pace: f64) -> f64 {
        let frail_mps = self.home.numbers.of(&FRAIL_MPS);
        ((frail_mps - self.pace_mps * pace) / (frail_mps / 2.0)).clamp(0.0, 1.0)
    }
}
