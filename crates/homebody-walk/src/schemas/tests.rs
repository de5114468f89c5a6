use super::*;
use crate::homes::{random_home, sphere_house, tigerplace};
use crate::pattern::{Pattern, travel_pattern};
use homebody_core::time::SECOND;
use std::sync::LazyLock;

const RADIUS_M: f64 = 0.22;
const KINDS: [WanderStyle; 3] = [WanderStyle::Random, WanderStyle::Lapping, WanderStyle::Pacing];
static GAIT: Gait = Gait {
    speed_mps: 0.65,
    acceleration_mps2: 1.0,
    half_turn_s: 2.0,
    sharp_turn_rad: std::f64::consts::FRAC_PI_3,
    turn_amplitude_m: 0.3,
};

static NUMBERS: LazyLock<Numbers> = LazyLock::new(Numbers::default);

fn wandering<'a>(kind: WanderStyle, plan: &'a Plan, mesh: &'a Mesh, from: Point, lasting: Span) -> Wandering<'a> {
    let (begin, who) = (RunTime::START, Wanderers::default());
    Wandering { kind, mesh, plan, from, begin, lasting, gait: &GAIT, numbers: &NUMBERS, who }
}

fn start(plan: &Plan, mesh: &Mesh) -> Point {
    let stream = &mut Stream::named(1, "start");
    (0..plan.rooms.len()).map(|room| mesh.free_point(room, stream)).find(|&at| mesh.is_free(at)).unwrap()
}

/// The end of each segment; checks that they follow each other.
fn ends(moves: &[MotionSegment], from: Point, begin: RunTime) -> Vec<Point> {
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

/// Indices of the goals that a walk reaches.
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
fn wandering_has_the_requested_pattern() {
    for plan in [tigerplace(), sphere_house()] {
        let mesh = Mesh::new(&plan, RADIUS_M);
        let from = start(&plan, &mesh);
        let meant = [(Pattern::Random, 0), (Pattern::Lapping, 10), (Pattern::Pacing, 18)];
        for (kind, (pattern, least_passing)) in KINDS.into_iter().zip(meant) {
            let mut passing_as_meant = 0;
            for case in 0..20 {
                let mut stream = Stream::named(case, "wandering");
                let wandering = wandering(kind, &plan, &mesh, from, 900 * SECOND);
                let goals = wandering.goals(&mut stream);
                let (moves, visited) = wandering.between(&goals, &mut stream);
                assert_eq!(travel_pattern(&visited), pattern, "case {case}: {visited:?}");
                // Passing a goal on the way counts as a visit.
                let passed = travel_pattern(&visits(&ends(&moves, from, RunTime::START), &goals));
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
            let (begin, lasting) = (RunTime::from_micros(7), 130 * SECOND);
            let wandering = Wandering { begin, ..wandering(kind, &plan, &mesh, from, lasting) };
            let moves = wandering.moves(&mut stream.clone());
            assert_eq!(moves, wandering.moves(&mut stream));
            let ends = ends(&moves, from, begin);
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
            let length = moves[moves.len() - 1].end - begin;
            assert!((lasting..lasting + 60 * SECOND).contains(&length), "case {case}: {kind:?} takes {length}");
        }
    }
}

#[test]
#[ignore = "a measurement"]
#[expect(clippy::disallowed_types, clippy::disallowed_methods, reason = "a measurement needs a clock")]
fn prints_the_patterns_between_rooms_and_the_time() {
    for plan in [tigerplace(), sphere_house()] {
        let mesh = Mesh::new(&plan, RADIUS_M);
        let from = start(&plan, &mesh);
        for kind in KINDS {
            let begin = std::time::Instant::now();
            let mut moves = 0;
            let patterns: Vec<Pattern> = (0..20)
                .map(|case| {
                    let mut stream = Stream::named(case, "wandering");
                    let wandering = wandering(kind, &plan, &mesh, from, 132 * SECOND).moves(&mut stream);
                    moves += wandering.len();
                    let rooms = ends(&wandering, from, RunTime::START).into_iter().filter_map(|at| plan.room_at(at));
                    travel_pattern(&rooms.collect::<Vec<_>>())
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
        let moves = wandering(kind, &plan, &mesh, from, 600 * SECOND).moves(&mut stream);
        let mut stops = vec![from];
        stops.extend(ends(&moves, from, RunTime::START));
        let turn = |stops: &[Point]| {
            let (before, after) = (stops[1] - stops[0], stops[2] - stops[1]);
            libm::atan2(before.perp_dot(after), before.dot(after)).abs()
        };
        stops.windows(3).map(turn).sum::<f64>() / stops.len() as f64
    };
    let (random, pacing) = (turns(WanderStyle::Random), turns(WanderStyle::Pacing));
    assert!(random > 1.5 * pacing, "{random} {pacing}");
}

#[test]
fn wanderer_without_a_goal_moves_on_the_spot() {
    let plan = tigerplace();
    let mesh = Mesh::new(&plan, RADIUS_M);
    let outside = Point::new(20.0, 20.0);
    let begin = RunTime::from_micros(5);
    let wandering = Wandering { begin, ..wandering(WanderStyle::Pacing, &plan, &mesh, outside, SECOND) };
    let moves = wandering.moves(&mut Stream::named(1, "lost"));
    assert!(matches!(moves[..], [MotionSegment { doing: MotionState::InPlace { .. }, .. }]));
    assert_eq!([moves[0].begin, moves[0].end].map(RunTime::micros), [5, 1_000_005]);
}

/// One large empty room.
fn hall() -> Plan {
    let home = r#"{
        "name": "hall",
        "rooms": [{ "name": "hall", "outline": [[0, 0], [8, 0], [8, 8], [0, 8]] }],
        "walls": [
            { "from": [0, 0], "to": [8, 0] },
            { "from": [8, 0], "to": [8, 8] },
            { "from": [8, 8], "to": [0, 8] },
            { "from": [0, 8], "to": [0, 0] }
        ]
    }"#;
    Plan::new(&serde_json::from_str(home).unwrap())
}

/// The share of time farther than `far_m` metres from any wall.
fn far_from_walls(moves: &[MotionSegment], mesh: &Mesh, far_m: f64) -> f64 {
    let stands = moves.iter().filter_map(|step| match step.doing {
        MotionState::Stride { to, .. } => Some(to),
        _ => None,
    });
    let stands: Vec<Point> = stands.collect();
    let is_far =
        |at: &&Point| nearest(&mesh.sides_near(**at, 3.0), **at).is_none_or(|wall| wall.distance(**at) > far_m);
    stands.iter().filter(is_far).count() as f64 / stands.len() as f64
}

#[test]
fn each_gain_has_its_effect() {
    let plan = hall();
    let mesh = Mesh::new(&plan, RADIUS_M);
    let from = start(&plan, &mesh);
    let other = [Point::new(4.0, 4.0)];
    let walk = |gains: Gains| {
        let (mut far, mut near, mut still, mut whole) = (0.0, 0.0, Span::ZERO, Span::ZERO);
        for case in 0..12 {
            let mut stream = Stream::named(case, "gains");
            let who = Wanderers { gains, others: &other };
            let wandering = Wandering { who, ..wandering(WanderStyle::Random, &plan, &mesh, from, 600 * SECOND) };
            let moves = wandering.moves(&mut stream);
            ends(&moves, from, RunTime::START);
            far += far_from_walls(&moves, &mesh, 1.5) / 12.0;
            let is_near = |step: &&MotionSegment| matches!(step.doing, MotionState::Stride { to, .. } if to.distance(other[0]) < 0.8);
            near += moves.iter().filter(is_near).count() as f64 / moves.len() as f64 / 12.0;
            let rests = moves.iter().filter(|step| matches!(step.doing, MotionState::Rest { .. }));
            still += rests.map(|step| step.end - step.begin).sum::<Span>();
            whole += moves[moves.len() - 1].end.since_zero();
        }
        (far, near, still.ratio(whole))
    };
    let usual = walk(Gains::USUAL);
    let shy = walk(Gains { open_floor: 1.5, ..Gains::USUAL });
    let alone = walk(Gains { people: 2.0, ..Gains::USUAL });
    let halting = walk(Gains { pauses: 4.0, ..Gains::USUAL });
    assert!(shy.0 < 0.6 * usual.0, "far from walls: {} usually, {} in fear", usual.0, shy.0);
    assert!(alone.1 < 0.5 * usual.1, "near somebody: {} usually, {} who avoids them", usual.1, alone.1);
    assert!(usual.2 == 0.0 && halting.2 > 0.1, "{} {}", usual.2, halting.2);
}
