//! The naive way agrees: over random homes and walks the paper's own loop, its rays cast by the physics
//! engine sixty times a second, fires as the world does to within one update. Any other difference is traced,
//! and counted: to a detection that begins or ends within one update of a decision of either (whose decisions
//! are themselves up to an update apart), or to a movement that no ray's length can show, because the visible part
//! of the beam lies wholly inside the body or the body touches it less than a millimetre deep.

use crate::random_home::{self, Model};
use homebody_core::event::{Events, Fact, Firing};
use homebody_core::geometry::Point;
use homebody_core::home::Home;
use homebody_core::home::resolved::ResolvedHome;
use homebody_core::ids::ResidentId;
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::posture::Posture;
use homebody_core::resident::Build;
use homebody_core::time::{Interval, MINUTE, RunTime, SECOND, Span, joined};
use homebody_core::world::World;
use homebody_oracle::paper::PaperEye;
use homebody_oracle::{Loop, Player, Remainder, brute::BruteEye};
use std::sync::Arc;

/// A sixtieth of a second, rounded up.
const UPDATE: Span = Span::from_micros(SECOND.micros() / 60 + 1);
const LENGTH: Span = MINUTE;
const END: RunTime = RunTime::START.saturating_add(LENGTH);

/// The result of all comparisons.
#[derive(Debug, Default)]
struct Tally {
    firings: usize,
    sensors: usize,
    /// Sensors whose firings part after a detection that began or ended within an update of a decision.
    close_calls: usize,
    /// Sensors whose firings part after a movement that no ray's length shows.
    invisible: usize,
    unexplained: Vec<String>,
}

struct Case {
    number: u64,
    home: Arc<Home>,
    build: Build,
    life: Vec<MotionSegment>,
}

impl Case {
    fn new(number: u64) -> Case {
        Case::crowded(number, 0)
    }

    /// A case with so many sensors more.
    fn crowded(number: u64, more: i64) -> Case {
        let build = random_home::builds(number, 1)[0];
        let home = ResolvedHome::new(random_home::crowded(number, Model::Paper, more)).unwrap();
        let home = Arc::new(Home::bake(&home, &[build]));
        let mut life = random_home::life(number, 0, &home, LENGTH, 0.3);
        let (least, most) = home.plan.bounds();
        let mut at = (least + most) / 2.0;
        for next in &mut life {
            next.posture = Posture::Standing;
            match next.doing {
                MotionState::Stride { to, .. } => at = to,
                MotionState::InPlace { at: here, .. } | MotionState::Rest { at: here } => at = here,
                // The paper's loop would take the end of a body for movement.
                MotionState::Away => next.doing = MotionState::Rest { at },
            }
        }
        Case { number, home, build, life }
    }

    fn exact(&self) -> Events {
        let mut world = World::new(self.home.clone(), 1, self.number);
        let mut events = Events::default();
        for next in &self.life {
            world.begin(ResidentId(0), next);
            world.advance(next.end.min(END), &mut events);
        }
        events
    }

    fn paper(&self) -> Vec<Firing> {
        let eye = PaperEye::new(&self.home, self.build.size(Posture::Standing, &self.home.numbers), 1);
        self.looped(Loop::new(eye, &self.home, self.number, 1, Remainder::Kept))
    }

    fn brute(&self) -> Vec<Firing> {
        let eye = BruteEye::new(&self.home, self.home.field(0, Posture::Standing));
        self.looped(Loop::new(eye, &self.home, self.number, 1, Remainder::Kept))
    }

    fn looped<E: homebody_oracle::Eye>(&self, mut naive: Loop<E>) -> Vec<Firing> {
        let mut firings = Vec::new();
        let mut lives = [Player::new(&self.life, self.build.radius_m)];
        naive.run(&mut lives, END, &mut firings);
        firings
    }

    fn compare(&self, events: &Events, naive: &[Firing], tally: &mut Tally) {
        for sensor in 0..self.home.sensors.len() {
            let of = |firings: &[Firing]| -> Vec<RunTime> {
                let mine = firings.iter().filter(|firing| firing.sensor.index() == sensor);
                mine.map(|firing| firing.at).collect()
            };
            let (exact, naive) = (of(&events.firings), of(naive));
            tally.sensors += 1;
            tally.firings += exact.len();
            let parted = (0..exact.len().max(naive.len())).find(|&i| match (exact.get(i), naive.get(i)) {
                (Some(&a), Some(&b)) => (a - b).abs() > UPDATE,
                _ => true,
            });
            let Some(index) = parted else { continue };
            let first = [exact.get(index), naive.get(index)].into_iter().flatten().min().copied();
            // One of the two may not reach events of the last updates.
            if first.is_some_and(|at| at > END - 4 * UPDATE) {
                continue;
            }
            if self.is_close_call(sensor, &exact, &naive, index) {
                tally.close_calls += 1;
            } else if self.is_invisible(sensor, seen_at(events, sensor, index)) {
                tally.invisible += 1;
            } else {
                let around = first.unwrap_or_default();
                tally.unexplained.push(format!(
                    "case {} sensor {sensor} from firing {index}: exact {:?}, naive {:?}, seen {:?}",
                    self.number,
                    &exact[index.saturating_sub(1)..exact.len().min(index + 2)],
                    &naive[index.saturating_sub(1)..naive.len().min(index + 2)],
                    self.seen(sensor, Interval::new(around - 4 * SECOND, around + SECOND)),
                ));
            }
        }
    }

    /// Whether a detection begins or ends within an update of the decision at which two runs part.
    fn is_close_call(&self, sensor: usize, exact: &[RunTime], naive: &[RunTime], index: usize) -> bool {
        let parted = [exact.get(index), naive.get(index)].into_iter().flatten().min().copied().unwrap_or(END);
        // The firing before may have come of different decisions at the same time: of the end of a wait in one run, and of a
        // first delay of next to nothing in the other, which draw different numbers.
        let before = index.checked_sub(1).map(|before| exact[before].min(naive[before]));
        self.decides_closely(sensor, parted) || before.is_some_and(|before| self.decides_closely(sensor, before))
    }

    /// Whether a detection begins or ends within an update of what decided that the sensor fires, or not, at an instant.
    fn decides_closely(&self, sensor: usize, parted: RunTime) -> bool {
        let timing = self.home.sensors[sensor].timing;
        // Either a decision to fire again was taken then, or a first detection came up to `first_fire` before.
        let wait = Interval::new(parted - timing.persist, parted);
        let first = Interval {
            begin: parted - timing.first_fire.most - UPDATE,
            end: parted - timing.first_fire.least + UPDATE,
        };
        let around =
            Interval { begin: parted - timing.persist - timing.first_fire.most - 4 * UPDATE, end: parted + 4 * UPDATE };
        let near = |a: RunTime, b: RunTime| (a - b).abs() <= 2 * UPDATE + SAMPLE;
        let touch = |seen: Interval<RunTime>, when: Interval<RunTime>| seen.begin <= when.end && seen.end >= when.begin;
        self.seen(sensor, around).iter().any(|&seen| {
            let short = seen.length() <= UPDATE + SAMPLE;
            [seen.begin, seen.end].iter().any(|&edge| near(edge, wait.begin) || near(edge, wait.end))
                || (short && (touch(seen, wait) || touch(seen, first)))
        })
    }

    /// Whether the movement that was seen at `from` shows in a ray's length for less than one of its first three
    /// updates: else the beams it touches lie wholly inside the body, or are touched less than a millimetre deep.
    fn is_invisible(&self, sensor: usize, from: Option<RunTime>) -> bool {
        let Some(from) = from else { return false };
        let field = self.home.field(0, Posture::Standing);
        let radius = self.build.radius_m;
        let spans = self.seen(sensor, Interval::starting(from, SECOND));
        spans.first().is_some_and(|&Interval { begin, end }| {
            let shows = |place: &Point| {
                let touched = field.beams[field.range(sensor)].iter().filter(|beam| beam.distance(*place) <= radius);
                touched.clone().any(|beam| {
                    let inside = beam.start.distance(*place).max(beam.end().distance(*place)) <= radius;
                    !inside && beam.distance(*place) < radius - 0.001
                })
            };
            let end = end.min(begin + 3 * UPDATE) + Span::MICROSECOND;
            let places = samples(Interval { begin, end }).filter_map(|at| self.moving_at(at));
            places.filter(shows).count() as i64 * SAMPLE <= UPDATE
        })
    }

    /// The position of the body, if it moves.
    fn moving_at(&self, at: RunTime) -> Option<Point> {
        let next = self.life.iter().find(|next| next.begin <= at && at < next.end)?;
        let moves = matches!(next.doing, MotionState::Stride { .. } | MotionState::InPlace { .. });
        next.position(at).filter(|_| moves)
    }

    /// When the sensor sees the body move, between two instants, to within [`SAMPLE`].
    fn seen(&self, sensor: usize, around: Interval<RunTime>) -> Vec<Interval<RunTime>> {
        let field = self.home.field(0, Posture::Standing);
        let around = Interval { begin: around.begin.max(RunTime::START), ..around };
        let sees = |at: &RunTime| self.moving_at(*at).is_some_and(|place| field.sees(sensor, place));
        joined(samples(around).filter(sees).map(Interval::instant), SAMPLE)
    }
}

/// When the movement was seen that made the sensor's firing of this number.
fn seen_at(events: &Events, sensor: usize, index: usize) -> Option<RunTime> {
    let seq = events.firings.iter().filter(|firing| firing.sensor.index() == sensor).nth(index)?.seq;
    events.facts.iter().find_map(|fact| match fact {
        Fact::Provenance { seq: of, provenance } if *of == seq => Some(provenance.seen_at),
        _ => None,
    })
}

const SAMPLE: Span = Span::from_micros(200);

/// Instants of an interval, one [`SAMPLE`] after the other.
fn samples(of: Interval<RunTime>) -> impl Iterator<Item = RunTime> {
    (of.begin.micros()..of.end.micros()).step_by(SAMPLE.micros() as usize).map(RunTime::from_micros)
}

fn naive_way_agrees(cases: std::ops::Range<u64>, more: i64, way: fn(&Case) -> Vec<Firing>) {
    let mut tally = Tally::default();
    let count = cases.end - cases.start;
    for number in cases {
        let case = Case::crowded(number, more);
        case.compare(&case.exact(), &way(&case), &mut tally);
    }
    println!(
        "{count} homes, {} sensors, {} firings: {} sensors part at a close call, {} at an invisible movement, {} unexplained",
        tally.sensors,
        tally.firings,
        tally.close_calls,
        tally.invisible,
        tally.unexplained.len()
    );
    assert!(tally.firings > 3 * count as usize, "{tally:?}");
    assert!(tally.unexplained.is_empty(), "{:#?}", tally.unexplained);
    assert!((tally.close_calls + tally.invisible) * 20 < tally.sensors, "too many close calls to believe: {tally:?}");
}

#[test]
fn the_naive_way_agrees_1() {
    naive_way_agrees(0..250, 0, Case::paper);
}

#[test]
fn the_naive_way_agrees_2() {
    naive_way_agrees(500..750, 0, Case::paper);
}

#[test]
fn the_brute_way_agrees() {
    naive_way_agrees(1000..1500, 0, Case::brute);
}

/// More sensors than a mask has bits.
#[test]
fn the_naive_ways_agree_in_a_home_of_200_sensors() {
    naive_way_agrees(2000..2002, 200, Case::paper);
    naive_way_agrees(2002..2006, 200, Case::brute);
}

/// The negative control: the paper's loop at a hundred times real time loses and gains firings.
#[test]
fn the_naive_way_at_a_hundredfold_speed_does_not_agree() {
    let mut tally = Tally::default();
    for number in 0..20 {
        let case = Case::new(number);
        let eye = PaperEye::new(&case.home, case.build.size(Posture::Standing, &case.home.numbers), 1);
        let naive = case.looped(Loop::new(eye, &case.home, number, 100, Remainder::Kept));
        case.compare(&case.exact(), &naive, &mut tally);
    }
    assert!(tally.unexplained.len() > 10, "{tally:?}");
}
