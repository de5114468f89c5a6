//! Wandering: motor schemas on top of planned ways.
//!
//! A wanderer goes from place to place without an errand: at random, in laps over three to five places, or to and fro
//! between two (Martino-Saltzman et al. 1991). The planned way gives the direction; what is in the way pushes aside, and
//! noise makes the way crooked.
//!
//! We assume that a wanderer keeps one speed for the whole of it, and does not stop to turn. The order is one of the
//! places that are reached: if all rooms open on one hall, any order of places is to and fro between rooms.
//!
//! Vectors are added (Arkin 1989): toward the next visible corner of the way, away from the nearest obstacle (the
//! largest repulsion, not the sum, so that walls of many points do not dominate), into a random direction that persists
//! for a while, away from other people, and, for a person who fears open floor, back toward the nearest wall. [`Gains`]
//! holds the strength of each. The sum is computed anew at every tenth of a second. Its direction over half a second is
//! one straight step, if the body fits there with its whole radius. If not, the step follows the way planned anew from
//! there, which leads to the goal through any gap; so does the rest of a leg that takes too long.
//!
//! Now and then a wanderer stands still for a while. Other people stay where they were when the wandering began.
//!
//! Left out: setting off and slowing down, and what the wanderer looks for.

use crate::gait::Gait;
use crate::mesh::Mesh;
use crate::pattern::LAP_PLACES;
use homebody_core::geometry::{self, Point};
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::numbers::Numbers;
use homebody_core::plan::Plan;
use homebody_core::posture::Posture;
use homebody_core::random::Stream;
use homebody_core::time::{RunTime, Span};

/// The strength of each schema, as a factor of its usual gain; those whose usual gain is 0 are absolute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gains {
    pub goal: f64,
    pub walls: f64,
    pub noise: f64,
    /// Away from other people, relative to a goal of 1; usually 0.
    pub people: f64,
    /// Towards the nearest wall, relative to a goal of 1; usually 0.
    pub open_floor: f64,
    /// Pauses per minute; usually 0.
    pub pauses: f64,
}

impl Gains {
    pub const USUAL: Gains = Gains { goal: 1.0, walls: 1.0, noise: 1.0, people: 0.0, open_floor: 0.0, pauses: 0.0 };
}

impl Default for Gains {
    fn default() -> Gains {
        Gains::USUAL
    }
}

#[derive(Clone, Copy, Debug, Default)]
pub struct Wanderers<'a> {
    pub gains: Gains,
    /// In metres.
    pub others: &'a [Point],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum WanderStyle {
    Random,
    Lapping,
    Pacing,
}

homebody_core::numbers! {
    /// Duration of a step.
    static STEP_S = "wandering.step": 0.5, "s", [0.1, 2.0];
    /// Gain of the schema that leads to the goal (form after Arkin 1989).
    static GOAL_GAIN = "wandering.goal_gain": 1.0, "1", [0.1, 10.0];
    /// Gain of the schema that avoids obstacles (form after Arkin 1989).
    static AVOID_GAIN = "wandering.avoid_gain": 1.5, "1", [0.0, 10.0];
    /// Smallest gain of the noise in laps and in pacing (form after Arkin 1989).
    static NOISE_LEAST = "wandering.noise_least": 0.1, "1", [0.0, 5.0];
    /// Largest gain of the noise in laps and in pacing.
    static NOISE_MOST = "wandering.noise_most": 0.3, "1", [0.0, 5.0];
    /// Smallest gain of the noise in random wandering.
    static RANDOM_NOISE_LEAST = "wandering.random_noise_least": 0.6, "1", [0.0, 5.0];
    /// Largest gain of the noise in random wandering.
    static RANDOM_NOISE_MOST = "wandering.random_noise_most": 1.0, "1", [0.0, 5.0];
    /// Distance beyond which obstacles do not push.
    static AVOID_FROM_M = "wandering.avoid_from": 0.6, "m", [0.4, 3.0];
    /// Distance within which obstacles push with full strength.
    static AVOID_MOST_M = "wandering.avoid_most": 0.25, "m", [0.0, 0.35];
    /// Number of steps at least until the noise changes its direction.
    static NOISE_STEPS_LEAST = "wandering.noise_steps_least": 1.0, "1", [1.0, 50.0];
    /// Number of steps, exclusive, at most until the noise changes its direction.
    static NOISE_STEPS_MOST = "wandering.noise_steps_most": 5.0, "1", [1.0, 50.0];
    /// Distance from a goal at which a body has reached it.
    static REACHED_M = "wandering.reached": 0.35, "m", [0.05, 1.0];
    /// Duration of a leg, as a multiple of the planned way's, after which the leg follows the planned way.
    static PATIENCE = "wandering.patience": 3.0, "1", [1.0, 20.0];
    /// Distance between the places of a wandering, if the home has such places.
    static APART_M = "wandering.apart": 1.5, "m", [0.1, 10.0];
    /// Distance between the places of a wandering and things, if the home has such places.
    static ROOM_AROUND_M = "wandering.room_around": 0.5, "m", [0.0, 3.0];
    /// Distance at which a wall's pull on a person who fears open floor reaches its full strength.
    static OPEN_FROM_M = "wandering.open_from": 2.0, "m", [0.6, 6.0];
    /// Distance from a wall within which no person fears open floor.
    static OPEN_LEAST_M = "wandering.open_least": 0.45, "m", [0.2, 2.0];
    /// Distance beyond which other people do not push.
    static PEOPLE_FROM_M = "wandering.people_from": 1.5, "m", [0.3, 6.0];
    /// Median time that a wanderer stands still. The standard deviation of its logarithm is 0.6.
    static PAUSE_S = "wandering.pause": 4.0, "s", [0.5, 120.0];
    /// Amplitude of the movements on the spot of a person who does not know where to go.
    static LOST_AMPLITUDE_M = "wandering.lost_amplitude": 0.3, "m", [0.0, 1.0];
}

/// Number of times that a step is steered (our choice).
const STEERINGS: u32 = 5;

/// Number of points that are tried as places to wander between (our choice).
const TRIES: usize = 24;

#[derive(Clone, Copy)]
pub(crate) struct Wandering<'a> {
    pub kind: WanderStyle,
    pub mesh: &'a Mesh,
    pub plan: &'a Plan,
    pub from: Point,
    pub begin: RunTime,
    pub lasting: Span,
    pub gait: &'a Gait,
    pub numbers: &'a Numbers,
    pub who: Wanderers<'a>,
}

impl Wandering<'_> {
    /// Wanders for about `lasting`: until then, and on to a free place, at most one leg more.
    ///
    /// The segments continue each other from `begin`. Without a goal, the body moves on the spot.
    pub fn moves(&self, stream: &mut Stream) -> Vec<MotionSegment> {
        let goals = self.goals(stream);
        self.between(&goals, stream).0
    }

    /// Also returns the goals in the order of arrival.
    fn between(&self, goals: &[Point], stream: &mut Stream) -> (Vec<MotionSegment>, Vec<usize>) {
        let Wandering { kind, mesh, from, begin, lasting, gait, numbers, who, .. } = *self;
        if goals.len() < 2 {
            let doing = MotionState::InPlace { at: from, amplitude_m: numbers.of(&LOST_AMPLITUDE_M) };
            let end = begin.saturating_add(lasting.max(Span::MICROSECOND));
            return (vec![MotionSegment { begin, end, doing, posture: Posture::Standing }], Vec::new());
        }
        let noise_gain = match kind {
            WanderStyle::Random => [&RANDOM_NOISE_LEAST, &RANDOM_NOISE_MOST],
            WanderStyle::Lapping | WanderStyle::Pacing => [&NOISE_LEAST, &NOISE_MOST],
        };
        let step_s = numbers.of(&STEP_S);
        let mut wanderer = Wanderer {
            mesh,
            step_s,
            step_m: gait.speed_mps * step_s,
            schemas: Schemas {
                goal_gain: numbers.of(&GOAL_GAIN) * who.gains.goal,
                avoid_gain: numbers.of(&AVOID_GAIN) * who.gains.walls,
                open_gain: who.gains.open_floor,
                open_m: [&OPEN_LEAST_M, &OPEN_FROM_M].map(|number| numbers.of(number)),
                people_gain: who.gains.people,
                people_from_m: numbers.of(&PEOPLE_FROM_M),
                others: who.others.to_vec(),
                avoid_from_m: numbers.of(&AVOID_FROM_M),
                avoid_most_m: numbers.of(&AVOID_MOST_M),
                noise_gain: noise_gain.map(|gain| numbers.of(gain) * who.gains.noise),
                noise_lasts: [&NOISE_STEPS_LEAST, &NOISE_STEPS_MOST].map(|steps| numbers.of(steps)),
            },
            reached_m: numbers.of(&REACHED_M),
            patience: numbers.of(&PATIENCE),
            pause_chance: who.gains.pauses * step_s / 60.0,
            pause_s: numbers.of(&PAUSE_S),
            noise: Point::ZERO,
            noise_steps: 0,
            at: from,
            now: begin,
            until: begin.saturating_add(lasting),
            moves: Vec::new(),
        };
        let mut visited: Vec<usize> = Vec::new();
        while !wanderer.is_over() {
            let next = match kind {
                WanderStyle::Random => unvisited(&visited, goals.len(), stream),
                _ => visited.last().map_or(0, |last| (last + 1) % goals.len()),
            };
            if !wanderer.leg(goals[next], stream) {
                break;
            }
            visited.push(next);
        }
        (wanderer.moves, visited)
    }

    /// Reachable places: two for pacing, three to five for laps, and enough for random wandering that one is always unvisited.
    fn goals(&self, stream: &mut Stream) -> Vec<Point> {
        let Wandering { kind, mesh, plan, from, numbers, .. } = *self;
        let [apart_m, around_m, reached_m] = [&APART_M, &ROOM_AROUND_M, &REACHED_M].map(|number| numbers.of(number));
        let count = match kind {
            WanderStyle::Random => LAP_PLACES + 2,
            WanderStyle::Lapping => 3 + stream.pick(&[1.0; 3]),
            WanderStyle::Pacing => 2,
        };
        let sizes: Vec<f64> = plan.rooms.iter().map(|room| geometry::signed_area(&room.outline).abs()).collect();
        let mut goals: Vec<Point> = Vec::new();
        let mut second_best: Vec<Point> = Vec::new();
        for _ in 0..TRIES {
            let room = stream.pick(&sizes);
            if room >= plan.rooms.len() {
                break;
            }
            let p = mesh.free_point(room, stream);
            if goals.len() == count || !mesh.is_free(p) || !mesh.can_reach(from, p) {
                continue;
            }
            let is_apart = goals.iter().all(|goal| goal.distance(p) >= apart_m);
            let has_room = nearest(&mesh.sides_near(p, around_m), p).is_none_or(|at| at.distance(p) >= around_m);
            if is_apart && has_room { goals.push(p) } else { second_best.push(p) }
        }
        for p in second_best {
            if goals.len() < count && goals.iter().all(|goal| goal.distance(p) > 2.0 * reached_m) {
                goals.push(p);
            }
        }
        if kind == WanderStyle::Lapping {
            // In order around their middle, so that no goal lies on the way between two others if possible.
            let middle = goals.iter().sum::<Point>() / goals.len().max(1) as f64;
            let bearing = |goal: &Point| libm::atan2(goal.y - middle.y, goal.x - middle.x);
            goals.sort_by(|a, b| bearing(a).total_cmp(&bearing(b)));
        }
        goals
    }
}

/// A place that was not among the last ones.
fn unvisited(visited: &[usize], places: usize, stream: &mut Stream) -> usize {
    let recent = visited.iter().rev().take(LAP_PLACES.min(places.saturating_sub(1)));
    let mut weights = vec![1.0; places];
    for &place in recent {
        weights[place] = 0.0;
    }
    stream.pick(&weights)
}

struct Schemas {
    goal_gain: f64,
    avoid_gain: f64,
    avoid_from_m: f64,
    avoid_most_m: f64,
    noise_gain: [f64; 2],
    /// In steps.
    noise_lasts: [f64; 2],
    open_gain: f64,
    open_m: [f64; 2],
    people_gain: f64,
    people_from_m: f64,
    others: Vec<Point>,
}

struct Wanderer<'a> {
    mesh: &'a Mesh,
    step_s: f64,
    step_m: f64,
    schemas: Schemas,
    reached_m: f64,
    patience: f64,
    /// Per step.
    pause_chance: f64,
    pause_s: f64,
    noise: Point,
    /// Steps until the noise changes.
    noise_steps: u32,
    at: Point,
    now: RunTime,
    until: RunTime,
    moves: Vec<MotionSegment>,
}

impl Wanderer<'_> {
    fn is_over(&self) -> bool {
        self.now >= self.until && self.mesh.is_free(self.at)
    }

    /// False without a route.
    fn leg(&mut self, goal: Point, stream: &mut Stream) -> bool {
        let Some(mut way) = self.mesh.path(self.at, goal) else { return false };
        let length: f64 = [self.at].iter().chain(&way).zip(&way).map(|(a, b)| a.distance(*b)).sum();
        let mut steps_left = self.patience * length / self.step_m + 1.0;
        let mut next = 0;
        while !self.is_over() && self.at.distance(goal) > self.reached_m {
            steps_left -= 1.0;
            while next + 1 < way.len() && self.mesh.is_clear_way(self.at, way[next + 1]) {
                next += 1;
            }
            let steered = way.get(next).and_then(|&corner| self.steer(corner, stream));
            match steered.filter(|_| steps_left > 0.0) {
                Some(to) => {
                    self.step(to);
                    self.pause(stream);
                }
                None => {
                    let Some(planned) = self.mesh.path(self.at, goal) else { return false };
                    (way, next) = (planned, 0);
                    if self.follow(&mut way) {
                        break;
                    }
                }
            }
        }
        true
    }

    /// The target of the next step; `None` if the body does not fit there or on the way.
    fn steer(&mut self, corner: Point, stream: &mut Stream) -> Option<Point> {
        if self.noise_steps == 0 {
            let Schemas { noise_gain: [least, most], noise_lasts: [shortest, longest], .. } = self.schemas;
            let gain = stream.between(least, most);
            self.noise = geometry::direction(stream.between(0.0, 360.0)) * gain;
            self.noise_steps = stream.between(shortest, longest) as u32;
        }
        self.noise_steps -= 1;
        let reach_m = if self.schemas.open_gain > 0.0 { self.schemas.open_m[1] } else { self.schemas.avoid_from_m };
        let near = self.mesh.sides_near(self.at, reach_m + self.step_m);
        let mut to = self.at;
        for _ in 0..STEERINGS {
            let to_goal = (corner - to).normalize_or_zero() * self.schemas.goal_gain;
            let sum = to_goal + self.schemas.push(&near, to) + self.schemas.shy(&near, to) + self.noise;
            to += sum.normalize_or_zero() * (self.step_m / f64::from(STEERINGS));
        }
        (to != self.at && self.mesh.is_clear_way(self.at, to)).then_some(to)
    }

    /// Takes one step around the corners of a route and removes those behind; true at its end.
    fn follow(&mut self, way: &mut Vec<Point>) -> bool {
        let mut left = self.step_m;
        while let Some(&corner) = way.first() {
            let leg = self.at.distance(corner);
            if leg > left {
                self.step_within(self.at + (corner - self.at) * (left / leg), left);
                return false;
            }
            if leg > 0.0 {
                self.step_within(corner, leg);
            }
            left -= leg;
            way.remove(0);
            if left <= 0.0 {
                break;
            }
        }
        way.is_empty()
    }

    fn pause(&mut self, stream: &mut Stream) {
        const SPREAD: f64 = 0.6;
        if self.pause_chance <= 0.0 || !stream.chance(self.pause_chance) {
            return;
        }
        let end = self.now + Span::from_seconds(stream.lognormal(self.pause_s, SPREAD)).max(Span::MICROSECOND);
        let doing = MotionState::Rest { at: self.at };
        self.moves.push(MotionSegment { begin: self.now, end, doing, posture: Posture::Standing });
        self.now = end;
    }

    fn step(&mut self, to: Point) {
        self.step_within(to, self.step_m);
    }

    fn step_within(&mut self, to: Point, length_m: f64) {
        let end = self.now + Span::from_seconds(length_m / self.step_m * self.step_s).max(Span::MICROSECOND);
        let doing = MotionState::Stride { from: self.at, to };
        self.moves.push(MotionSegment { begin: self.now, end, doing, posture: Posture::Standing });
        (self.at, self.now) = (to, end);
    }
}

impl Schemas {
    fn push(&self, sides: &[(Point, Point)], at: Point) -> Point {
        let Some(obstacle) = nearest(sides, at) else { return Point::ZERO };
        let nearness = (self.avoid_from_m - at.distance(obstacle)) / (self.avoid_from_m - self.avoid_most_m);
        (at - obstacle).normalize_or_zero() * (self.avoid_gain * nearness.clamp(0.0, 1.0))
    }

    fn shy(&self, sides: &[(Point, Point)], at: Point) -> Point {
        let mut sum = Point::ZERO;
        if self.open_gain > 0.0
            && let Some(wall) = nearest(sides, at)
        {
            let [least_m, from_m] = self.open_m;
            let openness = (at.distance(wall) - least_m) / (from_m - least_m);
            sum += (wall - at).normalize_or_zero() * (self.open_gain * openness.clamp(0.0, 1.0));
        }
        if self.people_gain > 0.0 {
            for other in &self.others {
                let nearness = 1.0 - at.distance(*other) / self.people_from_m;
                sum += (at - *other).normalize_or_zero() * (self.people_gain * nearness.max(0.0));
            }
        }
        sum
    }
}

fn nearest(sides: &[(Point, Point)], p: Point) -> Option<Point> {
    let nearest = sides.iter().map(|&(a, b)| geometry::nearest_on_segment(p, a, b));
    nearest.min_by(|a, b| a.distance(p).total_cmp(&b.distance(p)))
}

#[cfg(test)]
mod tests;
