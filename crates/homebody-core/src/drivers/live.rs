//! Moves a body by held keys through the physics.
//!
//! Sixty times a second the body tries to move the way the keys point, runs into walls, furniture, closed doors and
//! other people, and slides along them.
//!
//! We assume that a body is a ball seen from above, and that its obstacles do not give way. A body that sits or lies
//! does not walk, and things are used from any place.
//!
//! `obstacles` computes the way of a body in a step. A step ends at a whole microsecond counted from the scenario's
//! start, so steps never drift. A door within the home lets the body through while it is open, and does not shut on a
//! body in it.
//!
//! A door that leads out lets the body out while it is open: pushed through it the body is away, until the keys point back in and the
//! door is open.
//!
//! Left out: turning and getting up to speed. Beams, and residents without keys, find doors in the state of the plan.

mod obstacles;

use crate::drivers::input::{Input, InputFile, KeysFile};
use crate::drivers::{Driver, Next, Surroundings};
use crate::event::ThingUse;
use crate::geometry::Point;
use crate::ids::ThingId;
use crate::motion::{MotionSegment, MotionState};
use crate::plan::{Origin, Plan};
use crate::posture::Posture;
use crate::time::{RunTime, SECOND, Span};
use obstacles::Obstacles;
use std::collections::VecDeque;

/// As the paper's game engine: sixty updates a second.
const STEPS_PER_SECOND: i64 = 60;

/// Less than this in a step is the noise of the engine's `f32`, not movement: a body that pushes
/// against a wall keeps still.
const STILL_M: f64 = 1e-5;

/// A resident whose body is moved by held keys.
#[derive(Clone, Debug)]
pub struct LiveDriver {
    keys: KeyTrack,
    pace_mps: f64,
    at: Point,
    obstacles: Obstacles,
    exits: Vec<Exit>,
    out: Option<Exit>,
}

impl LiveDriver {
    /// The driver of a body that stands at `start`.
    pub fn new(plan: &Plan, start: Point, radius_m: f64, pace_mps: f64, keys: KeyTrack) -> LiveDriver {
        let exits = Exit::all(plan, radius_m);
        LiveDriver { keys, pace_mps, at: start, obstacles: Obstacles::new(plan, radius_m), exits, out: None }
    }
}

impl Driver for LiveDriver {
    fn next(&mut self, around: &Surroundings) -> Next {
        let now = around.now();
        let Input { held, posture, .. } = *self.keys.at(now);
        if let Some(act) = self.keys.uses.pop_front() {
            return Next::Use(act);
        }
        let velocity =
            if posture == Posture::Standing { held.direction() * (self.pace_mps * held.haste()) } else { Point::ZERO };
        let end = if velocity != Point::ZERO || self.keys.open {
            step_from(now.saturating_add(Span::MICROSECOND))
        } else {
            self.keys.next_change().map_or(RunTime::NEVER, step_from)
        };
        if let Some(exit) = self.out {
            let comes = velocity.dot(exit.outward) < 0.0 && around.is_on(exit.door);
            if !comes {
                return Next::Segment(MotionSegment {
                    begin: now,
                    end,
                    doing: MotionState::Away,
                    posture: Posture::Standing,
                });
            }
            self.out = None;
        }
        let mut doing = MotionState::Rest { at: self.at };
        if velocity != Point::ZERO {
            self.obstacles.set_doors(self.at, |door| around.is_on(door));
            let way = velocity * (end - now).seconds();
            let (from, to) = (self.at, self.obstacles.slide(self.at, way, around.others()));
            if from.distance(to) >= STILL_M {
                self.at = to;
                doing = MotionState::Stride { from, to };
            } else if let Some(exit) =
                self.exits.iter().find(|exit| exit.takes(self.at, velocity) && around.is_on(exit.door))
            {
                self.out = Some(*exit);
                doing = MotionState::Away;
            }
        }
        Next::Segment(MotionSegment { begin: now, end, doing, posture })
    }

    fn copy(&self) -> Box<dyn Driver> {
        Box::new(self.clone())
    }

    fn open_input(&mut self) -> bool {
        self.keys.open = true;
        true
    }

    /// All later input is forgotten. A body that rests until the next line of a file is not asked before.
    fn input(&mut self, at: RunTime, input: Input) {
        self.keys.input(at, input);
    }
}

/// A door that leads out, as a body finds it from within.
#[derive(Clone, Copy, Debug)]
struct Exit {
    door: ThingId,
    /// The jambs on the inner side.
    from: Point,
    to: Point,
    /// Across the door, of length 1.
    outward: Point,
    radius_m: f64,
}

/// Distance beyond its radius at which a body pushes a door (our choice): the gap that the physics keeps, and the noise
/// of a step.
const REACH_M: f64 = 0.03;

impl Exit {
    fn all(plan: &Plan, radius_m: f64) -> Vec<Exit> {
        let shut = plan.solids.iter().filter_map(|solid| match solid.origin {
            Origin::Door(door) => Some((door, &solid.outline)),
            _ => None,
        });
        let open = plan.openings.iter().map(|opening| (opening.door, &opening.outline));
        let exit = |(door, outline): (usize, &Vec<Point>)| {
            let &[a, b, c, d] = &outline[..] else { return None };
            let (near, far) = ((a + b) / 2.0, (c + d) / 2.0);
            let across = (far - near).normalize_or_zero();
            // One side of it is in the home.
            let (is_near, is_far) = (plan.is_inside(near - across * radius_m), plan.is_inside(far + across * radius_m));
            let (from, to, outward) = if is_near { (a, b, across) } else { (c, d, -across) };
            (is_near != is_far).then_some(Exit { door: ThingId::new(door), from, to, outward, radius_m })
        };
        shut.chain(open).filter_map(exit).collect()
    }

    /// Whether a body that pushes like this leaves: mostly outward, and between the jambs.
    fn takes(&self, at: Point, velocity: Point) -> bool {
        let along = self.to - self.from;
        let share = (at - self.from).dot(along) / along.length_squared();
        let far = (self.from - at).dot(self.outward);
        let pushes = velocity.dot(self.outward) > 0.5 * velocity.length();
        pushes && (0.0..=1.0).contains(&share) && (0.0..=self.radius_m + REACH_M).contains(&far)
    }
}

/// The first end of a step at or after an instant.
fn step_from(at: RunTime) -> RunTime {
    let within = at.since_zero() % SECOND;
    let steps = (within * STEPS_PER_SECOND + SECOND - Span::MICROSECOND) / SECOND;
    (at - within).saturating_add(steps * SECOND / STEPS_PER_SECOND)
}

/// The input of a user at the keys, with the instants of its changes.
#[derive(Clone, Debug)]
pub struct KeyTrack {
    now: Input,
    uses: VecDeque<ThingUse>,
    coming: VecDeque<(RunTime, Input)>,
    /// Whether input may still come: then no rest is longer than a step.
    open: bool,
}

impl KeyTrack {
    /// The input of a file; nothing comes after its last line.
    pub fn written(input: &InputFile, plan: &Plan) -> KeyTrack {
        let at = |line: &KeysFile| RunTime::START + Span::from_seconds(line.at_s);
        let mut coming: Vec<_> = input.keys.iter().map(|line| (at(line), Input::written(line, plan))).collect();
        coming.sort_by_key(|&(at, _)| at);
        KeyTrack { coming: coming.into(), open: false, ..KeyTrack::live() }
    }

    /// No input yet: it comes during the run.
    pub fn live() -> KeyTrack {
        KeyTrack { now: Input::default(), uses: VecDeque::new(), coming: VecDeque::new(), open: true }
    }

    fn input(&mut self, at: RunTime, input: Input) {
        while self.coming.back().is_some_and(|&(later, _)| later > at) {
            self.coming.pop_back();
        }
        self.coming.push_back((at, input));
    }

    fn at(&mut self, now: RunTime) -> &Input {
        while let Some((at, _)) = self.coming.front()
            && *at <= now
            && let Some((_, input)) = self.coming.pop_front()
        {
            self.uses.extend(input.uses.iter().copied());
            self.now = input;
        }
        &self.now
    }

    fn next_change(&self) -> Option<RunTime> {
        self.coming.front().map(|&(at, _)| at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drivers::Occupant;
    use crate::drivers::input::{DriveKey, HeldKeys};
    use crate::geometry::{self, point};
    use crate::ids::ResidentId;
    use crate::resident::Build;
    use crate::time::{HOUR, LONGEST};
    use rand_chacha::ChaCha8Rng;
    use rand_core::{Rng, SeedableRng};
    use serde_json::json;
    use std::collections::BTreeSet;
    use std::sync::LazyLock;

    const RADIUS_M: f64 = 0.22;
    const PACE_MPS: f64 = 0.6;

    /// Two rooms south of a hall. The doors to the hall are open, as is the one that leads out;
    /// the one between the rooms is closed.
    fn plan() -> &'static Plan {
        static PLAN: LazyLock<Plan> = LazyLock::new(|| {
            let home = json!({
                "name": "three rooms",
                "rooms": [
                    { "name": "living room", "outline": [[0, 0], [5, 0], [5, 4], [0, 4]] },
                    { "name": "bedroom", "outline": [[5, 0], [8, 0], [8, 4], [5, 4]] },
                    { "name": "hall", "outline": [[0, 4], [8, 4], [8, 6], [0, 6]] },
                ],
                "walls": [
                    { "from": [0, 0], "to": [8, 0] }, { "from": [8, 0], "to": [8, 6] }, { "from": [8, 6], "to": [0, 6] },
                    { "from": [0, 6], "to": [0, 0] }, { "from": [0, 4], "to": [8, 4] }, { "from": [5, 0], "to": [5, 4] },
                ],
                "doors": [
                    { "name": "living room door", "from": [2, 4], "to": [2.9, 4] },
                    { "name": "bedroom door", "from": [6, 4], "to": [6.9, 4] },
                    { "name": "front door", "from": [0, 4.6], "to": [0, 5.5], "outside": true },
                    { "name": "closed door", "from": [5, 1.5], "to": [5, 2.4], "open": false },
                ],
                "furniture": [
                    { "name": "table", "at": [2.3, 1.8], "size_m": [1.2, 0.8], "turn_deg": 30, "height_m": 0.75 },
                    { "name": "shelf", "at": [4.75, 3.4], "size_m": [0.3, 1], "height_m": 1.8 },
                    { "name": "stool", "outline": [[4, 5], [4.3, 5.2], [4.1, 5.5]], "height_m": 0.5 },
                    { "name": "bed", "at": [7, 1], "size_m": [1.4, 2], "height_m": 0.5, "enterable": true },
                ],
            });
            Plan::new(&serde_json::from_value(home).unwrap())
        });
        &PLAN
    }

    /// The bodies that a driver is asked with: its own, which it knows, and the others.
    fn bodies(others: &[(Point, f64)]) -> Vec<Occupant> {
        let occupant = |&(at, radius_m): &(Point, f64)| {
            let doing = MotionState::Rest { at };
            let segment =
                MotionSegment { begin: RunTime::START, end: RunTime::NEVER, doing, posture: Posture::Standing };
            Occupant { build: Build { radius_m, ..Build::adult() }, segment }
        };
        [Occupant::new(Build::adult())].into_iter().chain(others.iter().map(occupant)).collect()
    }

    fn doors_as_planned() -> Vec<bool> {
        plan().things.iter().map(|thing| thing.on).collect()
    }

    fn ask(driver: &mut LiveDriver, now: RunTime, others: &[(Point, f64)], on: &[bool]) -> Next {
        driver.next(&Surroundings::new(now, ResidentId(0), plan(), &bodies(others), on))
    }

    fn standing_at(x: f64, y: f64) -> LiveDriver {
        LiveDriver::new(plan(), Point::new(x, y), RADIUS_M, PACE_MPS, KeyTrack::live())
    }

    fn holding(keys: &[DriveKey]) -> Input {
        Input { held: keys.iter().copied().collect(), ..Input::default() }
    }

    fn second(seconds: i64) -> RunTime {
        RunTime::START + seconds * SECOND
    }

    /// Holds the keys for a time among others and doors like these, and returns what the body did.
    fn hold(
        driver: &mut LiveDriver,
        keys: &[DriveKey],
        (from, to): (i64, i64),
        others: &[(Point, f64)],
        on: &[bool],
    ) -> Vec<MotionSegment> {
        driver.input(second(from), holding(keys));
        let (mut now, mut spans) = (second(from), Vec::new());
        while now < second(to) {
            let Next::Segment(span) = ask(driver, now, others, on) else { panic!("live movement has ended") };
            assert!(span.begin == now && span.end > now);
            now = span.end;
            spans.push(span);
        }
        spans
    }

    /// The same alone, with the doors of the plan.
    fn walk(driver: &mut LiveDriver, keys: &[DriveKey], span: (i64, i64)) -> Vec<MotionSegment> {
        hold(driver, keys, span, &[], &doors_as_planned())
    }

    /// Steps with keys changed at random every now and then.
    fn wander(driver: &mut LiveDriver, seed: u64, steps: usize, mut each: impl FnMut(&MotionSegment)) {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut now = RunTime::START;
        for _ in 0..steps {
            if random.next_u32() % 25 == 0 {
                let bits = random.next_u32();
                let keys =
                    [DriveKey::Up, DriveKey::Down, DriveKey::Left, DriveKey::Right, DriveKey::Fast, DriveKey::Slow];
                let held = keys.into_iter().filter(|&key| bits >> key as u32 & 1 == 1).collect();
                driver.input(now, Input { held, ..Input::default() });
            }
            let Next::Segment(span) = ask(driver, now, &[], &doors_as_planned()) else {
                panic!("live movement has ended")
            };
            now = span.end;
            each(&span);
        }
    }

    #[test]
    fn steps_do_not_drift() {
        let spans = walk(&mut standing_at(1.0, 1.0), &[DriveKey::Up], (0, 1));
        assert_eq!(spans.len(), 60);
        assert_eq!([0, 1, 2, 59].map(|step: usize| spans[step].end.micros()), [16_666, 33_333, 50_000, 1_000_000]);
        let a_century = RunTime::START + LONGEST;
        let (little, step) = (Span::MICROSECOND, Span::from_micros(16_666));
        assert_eq!([step_from(a_century), step_from(a_century + little)], [a_century, a_century + step]);
        assert_eq!(step_from(RunTime::MAX), RunTime::MAX);
    }

    #[test]
    fn keys_set_the_way_and_the_pace() {
        let moved_in_a_second = |keys: &[DriveKey]| {
            let mut driver = standing_at(1.0, 2.0);
            walk(&mut driver, keys, (0, 1));
            driver.at - point([1.0, 2.0])
        };
        let close =
            |keys: &[DriveKey], x: f64, y: f64| assert!(moved_in_a_second(keys).distance(Point::new(x, y)) < 1e-5);
        close(&[DriveKey::Up], 0.0, 0.6);
        close(&[DriveKey::Up, DriveKey::Fast], 0.0, 1.2);
        close(&[DriveKey::Down, DriveKey::Slow], 0.0, -0.3);
        close(&[DriveKey::Down, DriveKey::Slow, DriveKey::Fast], 0.0, -0.6);
        close(&[DriveKey::Left, DriveKey::Up], -0.6 / 2_f64.sqrt(), 0.6 / 2_f64.sqrt());
        close(&[DriveKey::Left, DriveKey::Right], 0.0, 0.0);
        close(&[DriveKey::Fast], 0.0, 0.0);
    }

    #[test]
    fn written_keys_take_effect_at_the_next_step() {
        let input = json!({ "keys": [
            { "at_s": 0.51, "held": ["right"] }, { "at_s": 0.56, "held": [] }, { "at_s": 3600, "held": ["up"] },
            { "at_s": 3600.1, "held": ["up", "down"] },
        ] });
        let keys = KeyTrack::written(&serde_json::from_value(input).unwrap(), plan());
        let mut driver = LiveDriver::new(plan(), point([1.0, 1.0]), RADIUS_M, PACE_MPS, keys);
        let (mut now, mut rests, mut strides) = (RunTime::START, Vec::new(), 0);
        while let Next::Segment(span) = ask(&mut driver, now, &[], &doors_as_planned())
            && span.end < RunTime::NEVER
        {
            now = span.end;
            match span.doing {
                MotionState::Rest { .. } => rests.push((span.begin, span.end)),
                _ => strides += 1,
            }
        }
        let hour = RunTime::START + HOUR;
        let [rests_at, rests_again] = [516_666, 566_666].map(RunTime::from_micros);
        assert_eq!(rests, [(RunTime::START, rests_at), (rests_again, hour)]);
        assert_eq!((strides, now), (3 + 6, hour + SECOND / 10), "opposite keys end the movement for good");
    }

    #[test]
    fn a_body_stays_clear_of_what_stops_it() {
        let plan = plan();
        let mut driver = standing_at(1.0, 1.0);
        let (mut rooms, mut at) = (BTreeSet::new(), driver.at);
        wander(&mut driver, 1, 100_000, |span| {
            if let MotionState::Stride { from, to } = span.doing {
                assert_eq!(from, at);
                at = to;
            }
            assert!(plan.is_inside(at), "{at} is outside");
            for solid in plan.solids.iter().filter(|solid| solid.stops_bodies) {
                assert!(geometry::distance_to_area(&solid.outline, at) >= RADIUS_M - 1e-6, "{at}, {:?}", solid.origin);
            }
            rooms.extend(plan.room_at(at));
        });
        assert_eq!(rooms.len(), 3);
    }

    #[test]
    fn a_body_slides_along_a_wall() {
        let mut driver = standing_at(1.0, 0.4);
        walk(&mut driver, &[DriveKey::Down, DriveKey::Right], (0, 2));
        let at = driver.at;
        assert!((at.y - (0.05 + RADIUS_M)).abs() < 0.01);
        assert!((at.x - (1.0 + 2.0 * PACE_MPS / 2_f64.sqrt())).abs() < 0.01, "{at}");
    }

    #[test]
    fn a_body_that_pushes_against_a_wall_or_into_a_corner_rests() {
        let corner = [DriveKey::Down, DriveKey::Left, DriveKey::Fast];
        for keys in [
            &[DriveKey::Down][..],
            &[DriveKey::Left, DriveKey::Fast],
            &corner,
            &[DriveKey::Down, DriveKey::Left, DriveKey::Slow],
        ] {
            let mut driver = standing_at(0.4, 0.4);
            walk(&mut driver, keys, (0, 2));
            let pushes = walk(&mut driver, keys, (2, 10));
            assert!(pushes.iter().all(|span| matches!(span.doing, MotionState::Rest { .. })), "{keys:?}");
        }
    }

    #[test]
    fn closed_doors_stop_a_body_and_open_ones_do_not() {
        let mut at_closed = standing_at(4.5, 1.95);
        walk(&mut at_closed, &[DriveKey::Right], (0, 5));
        assert!((at_closed.at.x - (4.95 - RADIUS_M)).abs() < 0.01);

        let mut at_open = standing_at(2.45, 3.5);
        walk(&mut at_open, &[DriveKey::Up], (0, 3));
        assert!((at_open.at.y - 5.3).abs() < 0.01);
    }

    #[test]
    fn a_body_that_leaves_by_the_front_door_is_away_until_the_keys_point_back() {
        let mut open = doors_as_planned();
        open[plan().thing("front door").unwrap()] = true;
        let is_away = |span: &MotionSegment| span.doing == MotionState::Away;
        let shut = doors_as_planned();
        let mut stays = standing_at(1.0, 5.05);
        assert!(!hold(&mut stays, &[DriveKey::Left], (0, 5), &[], &shut).iter().any(is_away));
        let mut at_front = standing_at(1.0, 5.05);
        assert!(hold(&mut at_front, &[DriveKey::Left], (0, 5), &[], &open).last().is_some_and(is_away));
        let out = hold(&mut at_front, &[], (5, 6), &[], &open);
        assert!(out.iter().all(|span| is_away(span) && span.end - span.begin <= SECOND / 60 + Span::MICROSECOND));
        // It was shut meanwhile.
        let mut copy = at_front.clone();
        assert!(hold(&mut copy, &[DriveKey::Right], (6, 7), &[], &shut).iter().all(is_away));
        let back = hold(&mut at_front, &[DriveKey::Right], (6, 8), &[], &open);
        assert!(matches!(back.last().map(|span| &span.doing), Some(MotionState::Stride { .. })));
        assert!(at_front.at.x > 1.0, "{}", at_front.at);
        // Beside the door there is a wall.
        let mut beside = standing_at(1.0, 4.3);
        assert!(!hold(&mut beside, &[DriveKey::Left], (0, 5), &[], &open).iter().any(is_away));
    }

    #[test]
    fn doors_are_as_they_have_been_left() {
        let door = |name: &str| plan().thing(name).unwrap();
        let set = |name: &str, open: bool| {
            let mut on = doors_as_planned();
            on[door(name)] = open;
            on
        };
        let end = |mut driver: LiveDriver, key: DriveKey, on: &[bool]| {
            hold(&mut driver, &[key], (0, 3), &[], on);
            driver.at
        };
        let opened = end(standing_at(4.5, 1.95), DriveKey::Right, &set("closed door", true));
        assert!(opened.x > 6.0, "{opened}");
        let shut = end(standing_at(2.45, 3.5), DriveKey::Up, &set("living room door", false));
        assert!((shut.y - (3.95 - RADIUS_M)).abs() < 0.01, "{shut}");
        // A body in the doorway is let out.
        let let_out = end(standing_at(2.45, 4.0), DriveKey::Up, &set("living room door", false));
        assert!(let_out.y > 5.0, "{let_out}");
        for open in [true, false] {
            let inside = end(standing_at(1.0, 5.05), DriveKey::Left, &set("front door", open));
            assert!((inside.x - (0.05 + RADIUS_M)).abs() < 0.01, "{inside}");
        }
    }

    #[test]
    fn others_are_run_into_and_slid_round() {
        let other = (point([2.0, 5.0]), 0.25);
        let mut head_on = standing_at(1.0, 5.0);
        hold(&mut head_on, &[DriveKey::Right], (0, 5), &[other], &doors_as_planned());
        let gap = head_on.at.distance(other.0) - RADIUS_M - other.1;
        assert!((0.0..0.01).contains(&gap), "{gap}");

        let mut aside = standing_at(1.0, 5.1);
        let spans = hold(&mut aside, &[DriveKey::Right], (0, 5), &[other], &doors_as_planned());
        let nearest = spans.iter().filter_map(|span| match span.doing {
            MotionState::Stride { to, .. } => Some(to.distance(other.0)),
            _ => None,
        });
        assert!(nearest.fold(f64::INFINITY, f64::min) > RADIUS_M + other.1 - 0.001);
        assert!(aside.at.x > 2.6, "{}", aside.at);

        let mut alone = head_on.clone();
        walk(&mut alone, &[DriveKey::Right], (5, 6));
        assert!(alone.at.x > head_on.at.x + 0.5, "who has left is in nobody's way");
    }

    #[test]
    fn the_same_keys_move_the_body_the_same_way() {
        let record = |driver: &mut LiveDriver| {
            let mut spans = Vec::new();
            wander(driver, 2, 20_000, |span| spans.push(span.clone()));
            spans
        };
        assert_eq!(record(&mut standing_at(1.0, 1.0)), record(&mut standing_at(1.0, 1.0)));
    }

    #[test]
    fn a_copy_continues_as_the_original() {
        let mut original = standing_at(1.0, 1.0);
        wander(&mut original, 3, 5_000, |_| {});
        let mut copy = original.clone();
        let mut spans = Vec::new();
        wander(&mut original, 4, 5_000, |span| spans.push(span.clone()));
        let mut copied = Vec::new();
        wander(&mut copy, 4, 5_000, |span| copied.push(span.clone()));
        assert_eq!(spans, copied);
    }

    #[test]
    fn later_keys_replace_what_was_to_come() {
        let mut driver = standing_at(1.0, 1.0);
        driver.input(second(10), holding(&[DriveKey::Up]));
        driver.input(second(1), holding(&[DriveKey::Right]));
        assert_eq!((driver.keys.at(second(0)).held, driver.keys.next_change()), (HeldKeys::default(), Some(second(1))));
        assert_eq!(
            (driver.keys.at(second(20)).held, driver.keys.next_change()),
            (HeldKeys::from_iter([DriveKey::Right]), None)
        );
    }

    #[test]
    fn a_sitting_body_does_not_walk_and_uses_things() {
        let mut driver = standing_at(1.0, 1.0);
        let lamp = ThingUse { thing: ThingId::new(plan().thing("hall").unwrap()), on: true };
        driver.input(
            second(0),
            Input { posture: Posture::Sitting, uses: vec![lamp, lamp], ..holding(&[DriveKey::Right]) },
        );
        let mut asked = |now| ask(&mut driver, now, &[], &doors_as_planned());
        assert_eq!([asked(second(0)), asked(second(0))], [Next::Use(lamp), Next::Use(lamp)]);
        let Next::Segment(sat) = asked(second(0)) else { panic!("no move") };
        assert_eq!((sat.doing, sat.posture), (MotionState::Rest { at: Point::new(1.0, 1.0) }, Posture::Sitting));
        driver.input(sat.end, holding(&[DriveKey::Right]));
        let Next::Segment(walked) = ask(&mut driver, sat.end, &[], &doors_as_planned()) else { panic!("no move") };
        assert!(matches!(walked.doing, MotionState::Stride { .. }) && walked.posture == Posture::Standing);
    }

    #[test]
    fn a_point_in_the_engine_stops_no_body() {
        let tiny = [point([1.0, 1.0]), point([1.0 + 1e-308, 1.0]), point([1.0, 1.0 + 1e-9])];
        assert_eq!(obstacles::corners(&tiny).len(), 1);
        let mut home = plan().clone();
        home.solids.iter_mut().for_each(|solid| solid.outline = tiny.to_vec());
        let mut driver = LiveDriver::new(&home, Point::new(1.0, 2.0), RADIUS_M, PACE_MPS, KeyTrack::live());
        assert!(!walk(&mut driver, &[DriveKey::Up], (0, 1)).is_empty());
    }
}
