//! Follows one body: what the world tells of it becomes joints at any instant.
//!
//! We assume that a new posture takes its time from the instant at which the world has it, also where the body walks on
//! meanwhile, and that steps are as long as the height lets them be.
//!
//! The input is a segment with a posture. If either changes, the body moves from its present joints to the new ones, so
//! it never jumps. The distance walked gives the phase of a step.
//!
//! Left out: turning on the spot step by step, limping, walking aids.

use super::figure::{Figure, Stature, person};
use super::ground::Ground;
use super::joints::{Joints, Stance, turn};
use super::quadruped::{LOWEST_PERSON_M, animal};
use crate::geometry::Point;
use crate::ids::ResidentId;
use crate::motion::{MotionSegment, MotionState};
use crate::numbers::Numbers;
use crate::posture::Posture;
use crate::random::DrawnValue;
use crate::stride::Stride;
use crate::time::{RunTime, SECOND, Span};
use std::f64::consts::{FRAC_PI_2, PI};

crate::numbers! {
    /// Duration of sitting down.
    static SITS_DOWN_S = "body.sits_down": 2.0, "s", [0.3, 10.0];
    /// Duration of rising from a seat for a person who walks at 1.2 m/s; up to twice as long for a slower one. Healthy
    /// old people take about 2 s (Kerr et al. 1997), frail ones 3 to 4.
    static RISES_S = "body.rises": 2.0, "s", [0.3, 20.0];
    /// Duration of lying down from a seat, and of sitting up.
    static LIES_DOWN_S = "body.lies_down": 3.0, "s", [0.3, 20.0];
    /// Duration of bending, and of kneeling down.
    static BENDS_S = "body.bends": 1.5, "s", [0.3, 10.0];
    /// Duration of a fall from standing to the floor: free falls of a stiff body of 1.65 m take 0.7 s, measured ones
    /// 0.5 to 1 (Hsiao and Robinovitch 1998).
    static FALLS_S = "body.falls": 0.8, "s", [0.3, 5.0];
    /// Duration of getting up from the floor for a person who walks at 1.2 m/s, after timed tests of old people.
    static GETS_UP_S = "body.gets_up": 6.0, "s", [1.0, 60.0];
    /// Length of a step as a share of the body's height (Winter: stride 0.83 of the height).
    static STEP = "body.step": 0.41, "1", [0.1, 0.8];
}

/// The speed at which people rise in the time that [`RISES_S`] says, in m/s.
const USUAL_MPS: f64 = 1.2;

/// Duration of a turn, or of a small shift without a stride (our choice).
const SHIFTS: Span = Span::from_millis(500);

/// Distance above which a change of position without a stride is a shift, in metres (our choice).
const SHIFT_M: f64 = 0.02;

/// Angle from straight ahead of a fall to a side after tripping (our choice).
const TRIPS_ASIDE_RAD: f64 = 0.5;

/// Angle from straight ahead of a fall to a side from another posture (our choice).
const TOPPLES_ASIDE_RAD: f64 = FRAC_PI_2;

/// Speed of a turn on hands and knees, in rad/s (our choice).
const CRAWLER_TURNS_RADPS: f64 = 1.0;

/// Swing of thighs and arms to either side in crawling, and smallest speed with the full swing, in m/s (our choice).
const CRAWL_SWING: f64 = 0.85;
const CRAWLS_MPS: f64 = 0.3;

/// The length of a crawler's step as a share of the height: the reach of thighs with that swing.
const CRAWL_STEP: f64 = 0.16;

/// Durations of changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Durations {
    sits_down: Span,
    rises_s: f64,
    lies_down: Span,
    bends: Span,
    falls: Span,
    gets_up_s: f64,
    step: f64,
}

impl Durations {
    /// As the scenario has them.
    pub fn new(numbers: &Numbers) -> Durations {
        let of = |number| Span::from_seconds(numbers.of(number));
        Durations {
            sits_down: of(&SITS_DOWN_S),
            rises_s: numbers.of(&RISES_S),
            lies_down: of(&LIES_DOWN_S),
            bends: of(&BENDS_S),
            falls: of(&FALLS_S),
            gets_up_s: numbers.of(&GETS_UP_S),
            step: numbers.of(&STEP),
        }
    }

    /// From one posture to another, at this walking speed.
    fn between(&self, from: Posture, to: Posture, walks_mps: f64) -> Span {
        use Posture::{Bending, Down, Kneeling, Lying, Sitting, Standing};
        let slower = (USUAL_MPS / walks_mps.max(0.1)).clamp(1.0, 2.0);
        match (from, to) {
            (_, Down) => self.falls,
            (Down, _) => Span::from_seconds(self.gets_up_s * slower),
            (Sitting, Lying) | (Lying, Sitting) => self.lies_down,
            (Standing, Sitting) => self.sits_down,
            (Sitting, Standing) => Span::from_seconds(self.rises_s * slower),
            (_, Lying) => self.sits_down + self.lies_down,
            (Lying, _) => self.lies_down + Span::from_seconds(self.rises_s * slower),
            (Bending | Kneeling, _) | (_, Bending | Kneeling) => self.bends,
            (Standing, Standing) | (Sitting, Sitting) => SHIFTS,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ByWayOf {
    /// It gets up from the floor over its knees.
    Knees,
    /// It comes up on hands and knees, and turns on them.
    HandsAndKnees,
}

/// The track of a body. Its state at an instant does not depend on the number of questions, or of pieces of the input.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyTrack {
    resident: ResidentId,
    stature: Stature,
    durations: Durations,
    segment: Option<MotionSegment>,
    /// The start of the change: joints, instant and duration.
    from: Joints,
    changed_at: RunTime,
    takes: Span,
    by_way_of: Option<ByWayOf>,
    facing_rad: f64,
    stance: Stance,
    /// The distance of the limbs from their usual places, as in [`Joints::sprawled`].
    sprawl: [f64; 4],
    support_m: f64,
    /// The distance walked before the present segment, and the last walking speed.
    walked_m: f64,
    walks_mps: f64,
}

impl BodyTrack {
    /// A body that has not come yet.
    pub fn new(resident: ResidentId, stature: Stature, durations: Durations) -> BodyTrack {
        BodyTrack {
            resident,
            stature,
            durations,
            segment: None,
            from: Joints::new(Stance::Standing, stature.height_m, 0.0),
            changed_at: RunTime::START,
            takes: Span::ZERO,
            by_way_of: None,
            facing_rad: 0.0,
            stance: Stance::Standing,
            sprawl: [0.0; 4],
            support_m: 0.0,
            walked_m: 0.0,
            walks_mps: USUAL_MPS,
        }
    }

    /// From `now` on the body does this, with a random number of the movement, for example for the direction of a fall.
    /// A movement that is the present one changes nothing.
    pub fn begin(&mut self, now: RunTime, next: &MotionSegment, chance: DrawnValue, ground: &Ground) {
        if self.segment.as_ref().is_some_and(|before| is_same(before, next)) {
            self.segment = Some(next.clone());
            return;
        }
        let was = self.joints_at(now);
        let before = self.segment.replace(next.clone());
        if let Some(MotionSegment { doing: MotionState::Stride { from, to }, begin, end, .. }) = before {
            let stride = Stride::new(from, to, begin, end);
            self.walked_m += stride.position(now).distance(from);
        }
        let Some(at) = place(next, now) else { return };
        if let MotionState::Stride { from, to } = next.doing {
            let way = to - from;
            if way.length_squared() > 1e-12 {
                self.facing_rad = libm::atan2(way.y, way.x);
                self.walks_mps = Stride::new(from, to, next.begin, next.end).speed_mps();
            }
        }
        let Some(was) = was else {
            // It comes through the door in its present posture.
            self.take_stance(next, chance, at, before.map(|before| before.posture), ground);
            (self.changed_at, self.takes) = (next.begin.min(now), Span::ZERO);
            return;
        };
        let posture_before = before.as_ref().map_or(Posture::Standing, |before| before.posture);
        let left_over = (self.changed_at + self.takes - now).max(Span::ZERO);
        let crawled = before.as_ref().is_some_and(crawls);
        let begins_to_crawl = crawls(next) && !crawled;
        let is_on_knees = was.hips.up_m >= Joints::new(Stance::Kneeling, self.stature.height_m, 0.0).hips.up_m;
        let goes_on_up = self.by_way_of == Some(ByWayOf::Knees)
            && left_over > Span::ZERO
            && posture_before == next.posture
            && !is_on_knees;
        let gets_up = posture_before == Posture::Down && matches!(next.posture, Posture::Standing | Posture::Sitting);
        self.by_way_of = if begins_to_crawl {
            Some(ByWayOf::HandsAndKnees)
        } else if goes_on_up || gets_up {
            Some(ByWayOf::Knees)
        } else {
            None
        };
        if posture_before != next.posture || crawled != crawls(next) {
            self.take_stance(next, chance, at, Some(posture_before), ground);
        }
        let takes = if begins_to_crawl {
            self.durations.bends + Span::from_seconds(turn(was.facing_rad, self.facing_rad).abs() / CRAWLER_TURNS_RADPS)
        } else if posture_before != next.posture {
            self.durations.between(posture_before, next.posture, self.walks_mps)
        } else if crawled != crawls(next) {
            self.durations.bends
        } else if was.hips.at.distance(at) > SHIFT_M || turn(was.facing_rad, self.facing_rad).abs() > 0.05 {
            self.support_m = ground.support_m(at);
            left_over.max(SHIFTS)
        } else {
            left_over
        };
        (self.from, self.changed_at, self.takes) = (was, now, takes);
    }

    fn take_stance(
        &mut self,
        next: &MotionSegment,
        chance: DrawnValue,
        at: Point,
        before: Option<Posture>,
        ground: &Ground,
    ) {
        self.support_m = match next.posture {
            Posture::Down => 0.0,
            _ => ground.support_m(at),
        };
        self.sprawl = [0.0; 4];
        let length_m = self.stature.height_m * 1.05;
        self.stance = match next.posture {
            _ if crawls(next) => Stance::Crawling,
            Posture::Standing => Stance::Standing,
            Posture::Sitting => Stance::Sitting,
            Posture::Bending => Stance::Bending,
            Posture::Kneeling => Stance::Kneeling,
            Posture::Lying => {
                self.facing_rad = ground.lies_facing(at, self.facing_rad, length_m);
                Stance::Lying
            }
            // A crawler lies down on the spot.
            Posture::Down if before == Some(Posture::Down) => Stance::Prone,
            Posture::Down => {
                let (turned_rad, stance) = landing(before, chance);
                self.facing_rad = ground.free_direction(at, self.facing_rad + turned_rad, length_m);
                self.sprawl = [1, 2, 3, 4].map(|limb| chance.unit(limb));
                stance
            }
        };
    }

    /// The joints at an instant from the last change on; None while it is away.
    pub fn joints_at(&self, now: RunTime) -> Option<Joints> {
        let segment = self.segment.as_ref()?;
        let at = place(segment, now)?;
        let height_m = self.stature.height_m;
        let stance = Joints::new(self.stance, height_m, self.support_m).at(at, self.facing_rad);
        let mut target = stance.sprawled(self.sprawl);
        match segment.doing {
            MotionState::Stride { .. } => {
                let (phase, swing) = self.step_at(segment, now);
                target = target.walking(phase, swing);
            }
            MotionState::InPlace { amplitude_m, .. } => sway(&mut target, now, amplitude_m),
            MotionState::Rest { .. } | MotionState::Away => {}
        }
        let passed = now - self.changed_at;
        if passed >= self.takes {
            return Some(target);
        }
        let share = passed.ratio(self.takes);
        let eased = match segment.posture {
            // It is gravity that hurries.
            Posture::Down => share * share,
            _ => share * share * (3.0 - 2.0 * share),
        };
        let between = match self.by_way_of {
            None => return Some(self.from.towards(&target, eased)),
            Some(ByWayOf::Knees) => Joints::new(Stance::Kneeling, height_m, 0.0).at(target.hips.at, target.facing_rad),
            Some(ByWayOf::HandsAndKnees) => {
                Joints::new(Stance::Crawling, height_m, 0.0).at(target.hips.at, self.from.facing_rad)
            }
        };
        Some(match eased < 0.5 {
            true => self.from.towards(&between, 2.0 * eased),
            false => between.towards(&target, 2.0 * eased - 1.0),
        })
    }

    /// The body as capsules at an instant; None while it is away.
    pub fn figure_at(&self, now: RunTime) -> Option<Figure> {
        let joints = self.joints_at(now)?;
        if self.stature.height_m >= LOWEST_PERSON_M {
            return Some(person(&self.stature, &joints));
        }
        let segment = self.segment.as_ref()?;
        let (phase, swing) = match segment.doing {
            MotionState::Stride { .. } => self.step_at(segment, now),
            _ => (0.0, 0.0),
        };
        let lies = segment.posture != Posture::Standing;
        Some(animal(&self.stature, joints.hips.at, joints.facing_rad, self.support_m, lies, phase, swing))
    }

    /// The resident with this body.
    pub fn resident(&self) -> ResidentId {
        self.resident
    }

    /// The largest distance of a part of the body from its position, in metres.
    pub fn reach_m(&self) -> f64 {
        self.stature.height_m * 1.3
    }

    /// The position of the body seen from above; `None` while it is away.
    pub fn place_at(&self, now: RunTime) -> Option<Point> {
        place(self.segment.as_ref()?, now)
    }

    /// The phase of a step of a stride, and the swing of the limbs: less for slow walks and crawls.
    fn step_at(&self, segment: &MotionSegment, now: RunTime) -> (f64, f64) {
        let MotionState::Stride { from, to } = segment.doing else { return (0.0, 0.0) };
        let stride = Stride::new(from, to, segment.begin, segment.end);
        let walked_m = self.walked_m + stride.position(now).distance(from);
        let (step, usual_mps, swing) = match crawls(segment) {
            true => (CRAWL_STEP, CRAWLS_MPS, CRAWL_SWING),
            false => (self.durations.step, USUAL_MPS, 1.0),
        };
        let step_m = step * self.stature.height_m;
        (PI * walked_m / step_m, swing * (stride.speed_mps() / usual_mps).clamp(0.0, 1.0))
    }
}

fn crawls(segment: &MotionSegment) -> bool {
    let is_low = matches!(segment.posture, Posture::Down | Posture::Lying | Posture::Kneeling);
    is_low && matches!(segment.doing, MotionState::Stride { .. })
}

fn is_same(before: &MotionSegment, next: &MotionSegment) -> bool {
    before.posture == next.posture && before.begin == next.begin && before.doing == next.doing
}

fn place(segment: &MotionSegment, now: RunTime) -> Option<Point> {
    segment.position(now.clamp(segment.begin, segment.end))
}

/// Arms and trunk during a movement on the spot: by its amplitude, about once in two seconds.
fn sway(joints: &mut Joints, now: RunTime, amplitude_m: f64) {
    let phase = (now.since_zero() % (2 * SECOND)).ratio(2 * SECOND) * 2.0 * PI;
    let far = (amplitude_m / 0.3).clamp(0.0, 2.0);
    joints.trunk_rad += 0.06 * far * libm::sin(phase);
    joints.left.arm_rad += 0.5 * far * (1.0 + libm::sin(phase)) / 2.0;
    joints.right.arm_rad += 0.5 * far * (1.0 + libm::cos(phase)) / 2.0;
}

/// The way in which a body lies after falling out of a posture: the direction of the head from the facing before, and
/// the stance. All are equally likely.
fn landing(before: Option<Posture>, chance: DrawnValue) -> (f64, Stance) {
    let aside_rad = match before {
        Some(Posture::Standing) | None => TRIPS_ASIDE_RAD,
        Some(_) => TOPPLES_ASIDE_RAD,
    };
    let (left, right) = ((aside_rad, Stance::OnLeftSide), (-aside_rad, Stance::OnRightSide));
    let ways = [(0.0, Stance::Prone), left, right, (0.0, Stance::Lying)];
    ways[(chance.unit(0) * ways.len() as f64) as usize]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Marks;

    const BUILD: Stature = Stature { radius_m: 0.2, height_m: 1.65 };

    fn at(seconds: i64) -> RunTime {
        RunTime::START + seconds * SECOND
    }

    fn rests(begin: i64, end: i64, x: f64, posture: Posture) -> MotionSegment {
        let doing = MotionState::Rest { at: Point::new(x, 2.0) };
        MotionSegment { begin: at(begin), end: at(end), doing, posture }
    }

    fn chance(number: u64) -> DrawnValue {
        Marks::named(7, "test").of(number)
    }

    /// Falls, crawls two metres, lies there, and gets up.
    fn figures() -> Vec<(RunTime, Figure)> {
        let crawl = MotionState::Stride { from: Point::new(1.0, 2.0), to: Point::new(3.0, 2.0) };
        let segments = [
            rests(0, 5, 1.0, Posture::Standing),
            rests(5, 10, 1.0, Posture::Down),
            MotionSegment { begin: at(10), end: at(20), doing: crawl, posture: Posture::Down },
            rests(20, 30, 3.0, Posture::Down),
            rests(30, 60, 3.0, Posture::Standing),
        ];
        let mut track = BodyTrack::new(ResidentId(0), BUILD, Durations::new(&Numbers::default()));
        let mut figures = Vec::new();
        for segment in segments {
            track.begin(segment.begin, &segment, chance(0), &Ground::floor());
            let count = (segment.end - segment.begin) / (SECOND / 50);
            let instants = (0..count).map(|index| segment.begin + index * (SECOND / 50));
            figures.extend(instants.map(|at| (at, track.figure_at(at).unwrap())));
        }
        figures
    }

    #[test]
    fn a_body_that_falls_crawls_lies_and_gets_up_never_jumps() {
        for pair in figures().windows(2) {
            let [(_, before), (at, after)] = pair else { continue };
            for (before, after) in before.iter().zip(after) {
                let far_m = before.to.distance(after.to).max(before.from.distance(after.from));
                assert!(far_m < 0.2, "{far_m} m in a fiftieth of a second at {at}");
            }
        }
    }

    #[test]
    fn a_body_gets_up_over_its_knees() {
        let all = figures();
        let top = |figure: &Figure| figure.iter().map(|capsule| capsule.from.z.max(capsule.to.z)).fold(0.0, f64::max);
        let upright: Vec<f64> = all.iter().filter(|(now, _)| *now > at(45)).map(|(_, figure)| top(figure)).collect();
        assert!(upright.iter().all(|top| *top > 1.5));
        // On the way the head is as high as that of who kneels, for longer than it takes to pass.
        let kneels = all.iter().filter(|(now, figure)| *now > at(30) && (1.0..1.35).contains(&top(figure))).count();
        assert!(kneels > 10, "{kneels} fiftieths of a second");
    }

    #[test]
    fn a_body_crawls_head_first() {
        let crawling = figures().into_iter().filter(|(now, _)| (at(14)..at(20)).contains(now));
        for (at, figure) in crawling {
            let (head, left_foot, right_foot) = (figure[0].to, figure[6].to, figure[11].to);
            assert!(head.x > left_foot.x + 0.5 && head.x > right_foot.x + 0.5, "at {at} the head is at {head}");
        }
    }

    #[test]
    fn falls_end_in_different_ways() {
        let lies = |number: u64| {
            let mut track = BodyTrack::new(ResidentId(0), BUILD, Durations::new(&Numbers::default()));
            for segment in [rests(0, 5, 1.0, Posture::Sitting), rests(5, 20, 1.0, Posture::Down)] {
                track.begin(segment.begin, &segment, chance(number), &Ground::floor());
            }
            track.joints_at(at(15)).unwrap()
        };
        let all: Vec<Joints> = (0..100).map(lies).collect();
        for stance in [Stance::Prone, Stance::Lying, Stance::OnLeftSide, Stance::OnRightSide] {
            let of = Joints::new(stance, BUILD.height_m, 0.0);
            let ends_so = |joints: &&Joints| joints.roll_rad == of.roll_rad && joints.trunk_rad == of.trunk_rad;
            assert!((10..45).contains(&all.iter().filter(ends_so).count()), "{stance:?}");
        }
        assert!(all.iter().skip(1).all(|joints| joints.left != all[0].left), "limbs are never the same");
    }
}
