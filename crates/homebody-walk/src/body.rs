//! A resident's body: its place, and its movements between places.

use crate::gait::{Gait, rise, sit, walk};
use crate::mesh::Mesh;
use crate::places::HomePlace;
use crate::routes::Routes;
use crate::schemas::{WanderStyle, Wanderers, Wandering};
use homebody_core::geometry::Point;
use homebody_core::home::Home;
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::posture::Posture;
use homebody_core::random::Stream;
use homebody_core::time::{RunTime, SECOND, Span};
use std::sync::Arc;

#[derive(Clone, Debug)]
pub struct WalkingBody {
    home: Arc<Home>,
    routes: Routes,
    pace_mps: f64,
    at: Point,
    posture: Posture,
    spot: Option<HomePlace>,
}

/// Distance within which a body is already at a place.
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

impl WalkingBody {
    /// The body has no place yet; `pace_mps` is the person's usual speed.
    pub fn new(home: Arc<Home>, mesh: Arc<Mesh>, pace_mps: f64) -> WalkingBody {
        let (routes, posture) = (Routes::new(mesh), Posture::Standing);
        WalkingBody { home, routes, pace_mps, at: Point::ZERO, posture, spot: None }
    }

    pub fn remembering(self, ways: usize) -> WalkingBody {
        WalkingBody { routes: self.routes.at_most(ways), ..self }
    }

    pub fn place(&mut self, spot: HomePlace, posture: Posture) {
        (self.at, self.posture, self.spot) = (spot.at, posture, Some(spot));
    }

    pub fn follow(&mut self, next: &MotionSegment) {
        match next.doing {
            MotionState::Stride { to, .. } => self.at = to,
            MotionState::InPlace { at, .. } | MotionState::Rest { at } => self.at = at,
            MotionState::Away => return,
        }
        self.posture = next.posture;
    }

    pub fn at(&self) -> Point {
        self.at
    }

    pub fn posture(&self) -> Posture {
        self.posture
    }

    pub fn mesh(&self) -> &Arc<Mesh> {
        self.routes.mesh()
    }

    pub fn spot(&self) -> Option<&HomePlace> {
        self.spot.as_ref()
    }

    pub fn room(&self) -> Option<usize> {
        self.home.plan.room_at(self.at)
    }

    /// The segments that lead to a place: rising, walking, sitting or lying down. `None` if no route leads there.
    pub fn go(
        &mut self,
        spot: &HomePlace,
        now: RunTime,
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
        let gait = self.gait(hour, pace, stream);
        moves.extend(walk(&path, self.at, set_out, &gait));
        if spot.posture != Posture::Standing {
            let arrived = moves.last().map_or(set_out, |last| last.end);
            moves.push(sit(spot.at, arrived, self.frailty(pace), spot.posture, &self.home.numbers, stream));
        }
        Some(moves)
    }

    #[expect(clippy::too_many_arguments, reason = "they are the whole of what wandering depends on")]
    pub fn wander(
        &mut self,
        kind: WanderStyle,
        lasts: Span,
        now: RunTime,
        hour: f64,
        pace: f64,
        who: Wanderers,
        stream: &mut Stream,
    ) -> Vec<MotionSegment> {
        let mut moves = self.stand_up(now, pace, stream);
        let gait = self.gait(hour, pace, stream);
        let from = self.step_out(now, &gait, &mut moves);
        let begin = moves.last().map_or(now, |last| last.end);
        let (mesh, Home { plan, numbers, .. }) = (self.routes.mesh(), &*self.home);
        let lasting = lasts.max(10 * SECOND);
        let wandering = Wandering { kind, mesh, plan, from, begin, lasting, gait: &gait, numbers, who };
        moves.extend(wandering.moves(stream));
        self.spot = None;
        moves
    }

    /// The segments of rising and stepping out of a bed or chair; empty for a body that stands on free floor.
    pub fn get_up(&mut self, now: RunTime, hour: f64, pace: f64, stream: &mut Stream) -> Vec<MotionSegment> {
        let mut moves = self.stand_up(now, pace, stream);
        let gait = self.gait(hour, pace, stream);
        self.step_out(now, &gait, &mut moves);
        self.spot = None;
        moves
    }

    pub fn sit_down(&self, posture: Posture, now: RunTime, pace: f64, stream: &mut Stream) -> MotionSegment {
        sit(self.at, now, self.frailty(pace), posture, &self.home.numbers, stream)
    }

    fn step_out(&self, now: RunTime, gait: &Gait, moves: &mut Vec<MotionSegment>) -> Point {
        let beside = self.routes.mesh().approach(self.at).filter(|beside| beside.distance(self.at) > THERE_M);
        let Some(beside) = beside else { return self.at };
        let begin = moves.last().map_or(now, |last| last.end);
        moves.extend(walk(&[beside], self.at, begin, gait));
        beside
    }

    fn stand_up(&self, now: RunTime, pace: f64, stream: &mut Stream) -> Vec<MotionSegment> {
        let numbers = &self.home.numbers;
        let mut moves = Vec::new();
        if self.posture == Posture::Lying {
            let end =
                now + Span::from_seconds(stream.lognormal(numbers.of(&SITTING_UP_S), numbers.of(&SITTING_UP_SPREAD)));
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

    /// At a changed pace, a walk takes in proportion as long: the acceleration changes with its square, so that the body
    /// reaches its speed after the same distance.
    fn gait(&self, hour: f64, pace: f64, stream: &mut Stream) -> Gait {
        let gait = Gait::for_walk(self.pace_mps * pace, hour, 0.0, &self.home.numbers, stream);
        Gait { acceleration_mps2: gait.acceleration_mps2 * pace * pace, ..gait }
    }

    fn frailty(&self, pace: f64) -> f64 {
        let frail_mps = self.home.numbers.of(&FRAIL_MPS);
        ((frail_mps - self.pace_mps * pace) / (frail_mps / 2.0)).clamp(0.0, 1.0)
    }
}
