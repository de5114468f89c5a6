//! How somebody wanders: motor schemas on top of planned ways.
//!
//! A wanderer goes from place to place without an errand: at random, in laps over three to five places, or to and fro
//! between two (Martino-Saltzman et al. 1991). The planned way gives the direction; what is in the way pushes aside, and
//! noise makes the way crooked.
//!
//! We assume that a wanderer keeps one speed for the whole of it, and does not stop to turn. The order is one of the
//! places come to. Where all rooms open on one hall, any order of places is to and fro between rooms.
//!
//! Three vectors are added (Arkin 1989): toward the next corner of the way that can be seen, away from the
//! nearest obstacle (the largest repulsion, not the sum, so that walls of many points do not dominate), and into a random
//! direction that persists for a while. The sum is taken anew at every tenth of a second; where that leads within half a
//! second is one straight step, if the body fits there with its whole radius. If not, the step follows the way planned
//! anew from there, which leads to the goal through any gap; so does the rest of a leg that takes too long.
//!
//! Left out: other people, pauses, setting off and slowing down, and what the wanderer looks for.

use crate::gait::Gait;
use crate::mesh::Mesh;
use crate::pattern::LAP_PLACES;
use homebody_core::drivers::MotionSegment;
use homebody_core::event::MotionState;
use homebody_core::geometry::{self, Point};
use homebody_core::home::plan::Plan;
use homebody_core::numbers::Numbers;
use homebody_core::random::Stream;
use homebody_core::scenario::path::Posture;
use homebody_core::time::{Micros, micros};

/// How somebody wanders.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Wandering {
    /// Here and there in no order.
    Random,
    /// The same circuit of places again and again.
    Lapping,
    /// To and fro between two places.
    Pacing,
}

homebody_core::numbers! {
    /// How long a step lasts.
    static STEP_S = "wandering.step": 0.5, "s", [0.1, 2.0];
    /// The gain of the schema that leads to the goal (the form is that of Arkin 1989).
    static GOAL_GAIN = "wandering.goal_gain": 1.0, "1", [0.1, 10.0];
    /// The gain of the schema that avoids obstacles (the form is that of Arkin 1989).
    static AVOID_GAIN = "wandering.avoid_gain": 1.5, "1", [0.0, 10.0];
    /// The gain of the noise in laps and in pacing, at least (the form is that of Arkin 1989).
    static NOISE_LEAST = "wandering.noise_least": 0.1, "1", [0.0, 5.0];
    /// The gain of the noise in laps and in pacing, at most.
    static NOISE_MOST = "wandering.noise_most": 0.3, "1", [0.0, 5.0];
    /// The gain of the noise in random wandering, at least.
    static RANDOM_NOISE_LEAST = "wandering.random_noise_least": 0.6, "1", [0.0, 5.0];
    /// The gain of the noise in random wandering, at most.
    static RANDOM_NOISE_MOST = "wandering.random_noise_most": 1.0, "1", [0.0, 5.0];
    /// Obstacles further than this do not push.
    static AVOID_FROM_M = "wandering.avoid_from": 0.6, "m", [0.4, 3.0];
    /// Obstacles nearer than this push as much as any.
    static AVOID_MOST_M = "wandering.avoid_most": 0.25, "m", [0.0, 0.35];
    /// The noise keeps its direction for so many steps at least.
    static NOISE_STEPS_LEAST = "wandering.noise_steps_least": 1.0, "1", [1.0, 50.0];
    /// The noise keeps its direction for fewer steps than this.
    static NOISE_STEPS_MOST = "wandering.noise_steps_most": 5.0, "1", [1.0, 50.0];
    /// A goal is reached by a body that is this near to it.
    static REACHED_M = "wandering.reached": 0.35, "m", [0.05, 1.0];
    /// A leg may take so many times what the planned way takes before it follows that way.
    static PATIENCE = "wandering.patience": 3.0, "1", [1.0, 20.0];
    /// Places to wander between are this far from each other, if such are found.
    static APART_M = "wandering.apart": 1.5, "m", [0.1, 10.0];
    /// Places to wander between are this far from things, if such are found.
    static ROOM_AROUND_M = "wandering.room_around": 0.5, "m", [0.0, 3.0];
    /// How far somebody who does not know where to go moves on the spot.
    static LOST_AMPLITUDE_M = "wandering.lost_amplitude": 0.3, "m", [0.0, 1.0];
}

/// A step is steered so often (ours).
const STEERINGS: u32 = 5;

/// So many points are tried as places to wander between (ours).
const TRIES: usize = 24;

/// Wanders for about `lasting` microseconds: until they are over and the body is in a free place, which is at most one leg more.
///
/// The moves follow each other from `begin` on. Where there is nowhere to go, it is movement on the spot.
#[expect(clippy::too_many_arguments, reason = "they are the whole of what wandering depends on")]
pub fn wander(
    kind: Wandering,
    mesh: &Mesh,
    plan: &Plan,
    from: Point,
    begin: Micros,
    lasting: Micros,
    gait: &Gait,
    numbers: &Numbers,
    stream: &mut Stream,
) -> Vec<MotionSegment> {
    let goals = goals(kind, mesh, plan, from, numbers, stream);
    between(kind, mesh, &goals, from, begin, lasting, gait, numbers, stream).0
}

/// Wanders between goals; also, which of them it has come to, in order.
#[expect(clippy::too_many_arguments, reason = "they are the whole of what wandering depends on")]
fn between(
    kind: Wandering,
    mesh: &Mesh,
    goals: &[Point],
    from: Point,
    begin: Micros,
    lasting: Micros,
    gait: &Gait,
    numbers: &Numbers,
    stream: &mut Stream,
) -> (Vec<MotionSegment>, Vec<usize>) {
    if goals.len() < 2 {
        let doing = MotionState::InPlace { at: from, amplitude_m: numbers.of(&LOST_AMPLITUDE_M) };
        let end = begin.saturating_add(lasting.max(1));
        return (vec![MotionSegment { begin, end, doing, posture: Posture::Standing }], Vec::new());
    }
    let noise_gain = match kind {
        Wandering::Random => [&RANDOM_NOISE_LEAST, &RANDOM_NOISE_MOST],
        Wandering::Lapping | Wandering::Pacing => [&NOISE_LEAST, &NOISE_MOST],
    };
    let step_s = numbers.of(&STEP_S);
    let mut wanderer = Wanderer {
        mesh,
        step_s,
        step_m: gait.speed_mps * step_s,
        schemas: Schemas {
            goal_gain: numbers.of(&GOAL_GAIN),
            avoid_gain: numbers.of(&AVOID_GAIN),
            avoid_from_m: numbers.of(&AVOID_FROM_M),
            avoid_most_m: numbers.of(&AVOID_MOST_M),
            noise_gain: noise_gain.map(|gain| numbers.of(gain)),
            noise_lasts: [&NOISE_STEPS_LEAST, &NOISE_STEPS_MOST].map(|steps| numbers.of(steps)),
        },
        reached_m: numbers.of(&REACHED_M),
        patience: numbers.of(&PATIENCE),
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
            Wandering::Random => unvisited(&visited, goals.len(), stream),
            _ => visited.last().map_or(0, |last| (last + 1) % goals.len()),
        };
        if !wanderer.leg(goals[next], stream) {
            break;
        }
        visited.push(next);
    }
    (wanderer.moves, visited)
}

/// The places to wander between, all of which can be reached: two for pacing, three to five for laps, and for random
/// wandering so many that there is always one that was not among the last ones.
fn goals(kind: Wandering, mesh: &Mesh, plan: &Plan, from: Point, numbers: &Numbers, stream: &mut Stream) -> Vec<Point> {
    let [apart_m, around_m, reached_m] = [&APART_M, &ROOM_AROUND_M, &REACHED_M].map(|number| numbers.of(number));
    let count = match kind {
        Wandering::Random => LAP_PLACES + 2,
        Wandering::Lapping => 3 + stream.pick(&[1.0; 3]),
        Wandering::Pacing => 2,
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
    if kind == Wandering::Lapping {
        // Around their middle, so that nobody comes by one on the way between two others, if it can be helped.
        let middle = goals.iter().sum::<Point>() / goals.len().max(1) as f64;
        let bearing = |goal: &Point| libm::atan2(goal.y - middle.y, goal.x - middle.x);
        goals.sort_by(|a, b| bearing(a).total_cmp(&bearing(b)));
    }
    goals
}

/// A place that was not among the last ones, so that the way has no order.
fn unvisited(visited: &[usize], places: usize, stream: &mut Stream) -> usize {
    let recent = visited.iter().rev().take(LAP_PLACES.min(places.saturating_sub(1)));
    let mut weights = vec![1.0; places];
    for &place in recent {
        weights[place] = 0.0;
    }
    stream.pick(&weights)
}

/// What the schemas are made by, asked for once for a walk.
struct Schemas {
    goal_gain: f64,
    avoid_gain: f64,
    avoid_from_m: f64,
    avoid_most_m: f64,
    noise_gain: [f64; 2],
    /// In steps.
    noise_lasts: [f64; 2],
}

struct Wanderer<'a> {
    mesh: &'a Mesh,
    step_s: f64,
    step_m: f64,
    schemas: Schemas,
    reached_m: f64,
    patience: f64,
    noise: Point,
    /// For so many steps more the noise stays as it is.
    noise_steps: u32,
    at: Point,
    now: Micros,
    until: Micros,
    moves: Vec<MotionSegment>,
}

impl Wanderer<'_> {
    fn is_over(&self) -> bool {
        self.now >= self.until && self.mesh.is_free(self.at)
    }

    /// Goes to a goal, or as far as the time allows; false if no way leads there.
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
                Some(to) => self.step(to),
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

    /// Where the schemas lead to within a step; nothing if the body does not fit there or in between.
    fn steer(&mut self, corner: Point, stream: &mut Stream) -> Option<Point> {
        if self.noise_steps == 0 {
            let Schemas { noise_gain: [least, most], noise_lasts: [shortest, longest], .. } = self.schemas;
            let gain = stream.between(least, most);
            self.noise = geometry::direction(stream.between(0.0, 360.0)) * gain;
            self.noise_steps = stream.between(shortest, longest) as u32;
        }
        self.noise_steps -= 1;
        let near = self.mesh.sides_near(self.at, self.schemas.avoid_from_m + self.step_m);
        let mut to = self.at;
        for _ in 0..STEERINGS {
            let to_goal = (corner - to).normalize_or_zero() * self.schemas.goal_gain;
            let sum = to_goal + self.schemas.push(&near, to) + self.noise;
            to += sum.normalize_or_zero() * (self.step_m / f64::from(STEERINGS));
        }
        (to != self.at && self.mesh.is_clear_way(self.at, to)).then_some(to)
    }

    /// Takes one step along a way, around its corners, and removes those that are behind; true once it is over.
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

    fn step(&mut self, to: Point) {
        self.step_within(to, self.step_m);
    }

    /// A stride of this length, in its share of a step's time.
    fn step_within(&mut self, to: Point, length_m: f64) {
        let end = self.now + micros(length_m / self.step_m * self.step_s).max(1);
        let doing = MotionState::Stride { from: self.at, to };
        self.moves.push(MotionSegment { begin: self.now, end, doing, posture: Posture::Standing });
        (self.at, self.now) = (to, end);
    }
}

impl Schemas {
    /// Away from the nearest of the sides of obstacles.
    fn push(&self, sides: &[(Point, Point)], at: Point) -> Point {
        let Some(obstacle) = nearest(sides, at) else { return Point::ZERO };
        let nearness = (self.avoid_from_m - at.distance(obstacle)) / (self.avoid_from_m - self.avoid_most_m);
        (at - obstacle).normalize_or_zero() * (self.avoid_gain * nearness.clamp(0.0, 1.0))
    }
}

/// The nearest point of any of the sides.
fn nearest(sides: &[(Point, Point)], p: Point) -> Option<Point> {
    let nearest = sides.iter().map(|&(a, b)| geometry::nearest_on_segment(p, a, b));
    nearest.min_by(|a, b| a.distance(p).total_cmp(&b.distance(p)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::homes::{random_home, sphere_house, tigerplace};
    use crate::pattern::{Pattern, pattern_of};
    use homebody_core::time::SECOND;

    const RADIUS_M: f64 = 0.22;
    const KINDS: [Wandering; 3] = [Wandering::Random, Wandering::Lapping, Wandering::Pacing];
    const GAIT: Gait = Gait {
        speed_mps: 0.65,
        acceleration_mps2: 1.0,
        half_turn_s: 2.0,
        sharp_turn_rad: std::f64::consts::FRAC_PI_3,
        turn_amplitude_m: 0.3,
    };

    fn start(plan: &Plan, mesh: &Mesh) -> Point {
        let stream = &mut Stream::named(1, "start");
        (0..plan.rooms.len()).map(|room| mesh.free_point(room, stream)).find(|&at| mesh.is_free(at)).unwrap()
    }

    /// Where the body is at the end of each move, the moves checked to follow each other.
    fn ends(moves: &[MotionSegment], from: Point, begin: Micros) -> Vec<Point> {
        let (mut at, mut now) = (from, begin);
        let mut ends = Vec::new();
        for step in moves {
            assert!(step.begin == now && step.end > now);
            if let MotionState::Stride { from, to } = step.doing {
                assert_eq!(from, at);
                at = to;
            }
            now = step.end;
            ends.push(at);
        }
        ends
    }

    /// The goals that a walk comes to, in order, as indices.
    fn visits(ends: &[Point], goals: &[Point]) -> Vec<usize> {
        let mut visits: Vec<usize> = Vec::new();
        for at in ends {
            if let Some(goal) = goals.iter().position(|goal| goal.distance(*at) <= REACHED_M.value)
                && visits.last() != Some(&goal)
            {
                visits.push(goal);
            }
        }
        visits
    }

    #[test]
    fn wandering_is_of_the_kind_that_was_meant() {
        for plan in [tigerplace(), sphere_house()] {
            let mesh = Mesh::new(&plan, RADIUS_M);
            let from = start(&plan, &mesh);
            let meant = [(Pattern::Random, 0), (Pattern::Lapping, 10), (Pattern::Pacing, 18)];
            for (kind, (pattern, least_passing)) in KINDS.into_iter().zip(meant) {
                let mut passing_as_meant = 0;
                for case in 0..20 {
                    let mut stream = Stream::named(case, "wandering");
                    let goals = goals(kind, &mesh, &plan, from, &Numbers::default(), &mut stream);
                    let (moves, visited) =
                        between(kind, &mesh, &goals, from, 0, 900 * SECOND, &GAIT, &Numbers::default(), &mut stream);
                    assert_eq!(pattern_of(&visited), pattern, "case {case}: {visited:?}");
                    // Whoever passes another goal on the way there seems to have come to it.
                    let passed = pattern_of(&visits(&ends(&moves, from, 0), &goals));
                    passing_as_meant += usize::from(passed == pattern);
                }
                assert!(passing_as_meant >= least_passing, "{kind:?}: {passing_as_meant} of 20");
            }
        }
    }

    #[test]
    fn a_wanderer_never_enters_a_solid_and_ends_in_a_free_place() {
        let homes = (0..15).map(random_home).chain([tigerplace(), sphere_house()]);
        for (case, plan) in homes.enumerate() {
            let mesh = Mesh::new(&plan, RADIUS_M);
            let from = start(&plan, &mesh);
            for kind in KINDS {
                let mut stream = Stream::named(case as u64, "wandering");
                let lasting = 130 * SECOND;
                let moves =
                    wander(kind, &mesh, &plan, from, 7, lasting, &GAIT, &Numbers::default(), &mut stream.clone());
                assert_eq!(
                    moves,
                    wander(kind, &mesh, &plan, from, 7, lasting, &GAIT, &Numbers::default(), &mut stream)
                );
                let ends = ends(&moves, from, 7);
                let mut at = from;
                for &to in &ends {
                    for step in 0..=10 {
                        let p = at + (to - at) * (f64::from(step) / 10.0);
                        // In a narrow gap, half the radius.
                        assert!(plan.is_walkable(p, RADIUS_M / 2.0 - 1e-3), "case {case}: {kind:?} at {p}");
                    }
                    at = to;
                }
                assert!(mesh.is_free(at), "case {case}: {kind:?} ends at {at}");
                let end = moves[moves.len() - 1].end - 7;
                assert!((lasting..lasting + 60 * SECOND).contains(&end), "case {case}: {kind:?} takes {end}");
            }
        }
    }

    #[test]
    #[ignore = "a measurement"]
    #[expect(clippy::disallowed_types, clippy::disallowed_methods, reason = "a measurement needs a clock")]
    fn what_wandering_looks_like_from_room_to_room_and_how_long_it_takes() {
        for plan in [tigerplace(), sphere_house()] {
            let mesh = Mesh::new(&plan, RADIUS_M);
            let from = start(&plan, &mesh);
            for kind in KINDS {
                let begin = std::time::Instant::now();
                let mut moves = 0;
                let patterns: Vec<Pattern> = (0..20)
                    .map(|case| {
                        let mut stream = Stream::named(case, "wandering");
                        let wandering =
                            wander(kind, &mesh, &plan, from, 0, 132 * SECOND, &GAIT, &Numbers::default(), &mut stream);
                        moves += wandering.len();
                        let rooms = ends(&wandering, from, 0).into_iter().filter_map(|at| plan.room_at(at));
                        pattern_of(&rooms.collect::<Vec<_>>())
                    })
                    .collect();
                let all = [Pattern::Direct, Pattern::Random, Pattern::Lapping, Pattern::Pacing];
                let counts = all.map(|pattern| (pattern, patterns.iter().filter(|found| **found == pattern).count()));
                println!("{kind:?}: {:?} and {} moves each; rooms {counts:?}", begin.elapsed() / 20, moves / 20);
            }
        }
    }

    #[test]
    fn random_wandering_is_more_crooked_than_pacing() {
        let plan = tigerplace();
        let mesh = Mesh::new(&plan, RADIUS_M);
        let from = start(&plan, &mesh);
        let turns = |kind| {
            let mut stream = Stream::named(1, "wandering");
            let moves = wander(kind, &mesh, &plan, from, 0, 600 * SECOND, &GAIT, &Numbers::default(), &mut stream);
            let mut stops = vec![from];
            stops.extend(ends(&moves, from, 0));
            let turn = |stops: &[Point]| {
                let (before, after) = (stops[1] - stops[0], stops[2] - stops[1]);
                libm::atan2(before.perp_dot(after), before.dot(after)).abs()
            };
            stops.windows(3).map(turn).sum::<f64>() / stops.len() as f64
        };
        let (random, pacing) = (turns(Wandering::Random), turns(Wandering::Pacing));
        assert!(random > 1.5 * pacing, "{random} {pacing}");
    }

    #[test]
    fn who_has_nowhere_to_go_stirs_on_the_spot() {
        let plan = tigerplace();
        let mesh = Mesh::new(&plan, RADIUS_M);
        let outside = Point::new(20.0, 20.0);
        let moves = wander(
            Wandering::Pacing,
            &mesh,
            &plan,
            outside,
            5,
            SECOND,
            &GAIT,
            &Numbers::default(),
            &mut Stream::named(1, "lost"),
        );
        assert!(matches!(
            moves[..],
            [MotionSegment { begin: 5, end: 1_000_005, doing: MotionState::InPlace { .. }, .. }]
        ));
    }
}
