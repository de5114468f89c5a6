//! A straight movement at constant speed.

use crate::geometry::Point;
use crate::time::{RunTime, SECOND, Span};
use std::ops::RangeInclusive;

/// A straight movement at constant speed from one instant to another.
///
/// Positions always come from the whole stride's ends, so that looking at a part of it, or cutting
/// it, changes no position by a single bit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stride {
    /// The start, in metres.
    pub from: Point,
    /// The end, in metres.
    pub to: Point,
    /// When it begins.
    pub begin: RunTime,
    /// When it ends, later than it begins.
    pub end: RunTime,
    /// Metres per microsecond.
    pub(crate) velocity: Point,
    /// Microseconds per metre along each axis; infinite where it stays.
    pub(crate) slowness: Point,
}

impl Stride {
    /// A stride; `end` is after `begin`.
    pub fn new(from: Point, to: Point, begin: RunTime, end: RunTime) -> Stride {
        let velocity = (to - from) / (end - begin).micros() as f64;
        Stride { from, to, begin, end, velocity, slowness: velocity.abs().recip() }
    }

    /// The position of the body at an instant of the stride.
    pub fn position(&self, at: RunTime) -> Point {
        self.from + self.velocity * (at - self.begin).micros() as f64
    }

    /// Metres per second.
    pub fn speed_mps(&self) -> f64 {
        self.velocity.length() * SECOND.micros() as f64
    }

    /// The first instant not before `after` at which a body of this radius touches the beam; nothing
    /// if it does not from then on. The stride's end does not limit the answer.
    ///
    /// The body's centre against the beam is a point against a capsule: it is entered through the
    /// strip's side, or through the disc at the beam's start or end. The capsule is convex, so exactly one
    /// applies, and it is left once only.
    pub fn first_touch(&self, beam: &Beam, radius: f64, after: RunTime) -> Option<RunTime> {
        let radius = radius + GRAZING_M;
        if beam.is_within(self.position(after), radius) {
            return Some(after);
        }
        let start = self.from - beam.start;
        let (along, along_change) = (start.dot(beam.direction), self.velocity.dot(beam.direction));
        let (side, side_change) = (start.perp_dot(beam.direction), self.velocity.perp_dot(beam.direction));
        let at_origin = if side_change == 0.0 {
            if side.abs() > radius || along_change == 0.0 {
                return None;
            }
            along_change > 0.0
        } else {
            let strip = (-radius - side * side_change.signum()) / side_change.abs();
            let reached = along + along_change * strip;
            if (0.0..=beam.length).contains(&reached) {
                return self.not_before(strip, after);
            }
            reached < 0.0
        };
        let centre = if at_origin { start } else { self.from - beam.end() };
        self.not_before(enter_disc(centre, self.velocity, radius)?, after)
    }

    /// The span of the centre within `radius` of `point`, as instants that may lie outside the stride.
    pub(crate) fn span_within(&self, point: Point, radius: f64) -> Option<RangeInclusive<RunTime>> {
        let start = self.from - point;
        let a = self.velocity.length_squared();
        let b = start.dot(self.velocity);
        let c = start.length_squared() - radius * radius;
        if a == 0.0 {
            return (c <= 0.0).then_some(self.begin..=self.end);
        }
        let root = b * b - a * c;
        if root < 0.0 {
            return None;
        }
        let root = libm::sqrt(root);
        let instant = |t: f64| self.begin.saturating_add(Span::from_micros(t as i64));
        Some(instant(libm::ceil((-b - root) / a))..=instant(libm::floor((-b + root) / a)))
    }

    /// `after_begin` microseconds as an instant, unless it lies before `after`.
    fn not_before(&self, after_begin: f64, after: RunTime) -> Option<RunTime> {
        let at = self.begin.saturating_add(Span::from_micros(libm::ceil(after_begin) as i64));
        (at >= after).then_some(at)
    }
}

/// Touching is a hit, whatever the last bit of a product says.
const GRAZING_M: f64 = 1e-9;

/// When a point that starts at `centre` from a disc's middle enters the disc; nothing if never, or
/// if it starts inside.
fn enter_disc(centre: Point, velocity: Point, radius: f64) -> Option<f64> {
    let a = velocity.length_squared();
    let b = centre.dot(velocity);
    let c = centre.length_squared() - radius * radius;
    let root = b * b - a * c;
    // The stable form of the smaller root: no difference of nearly equal numbers.
    (b < 0.0 && c > 0.0 && root >= 0.0).then(|| c / (libm::sqrt(root) - b))
}

/// A straight line of sight: what a wall sensor sees in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam {
    /// The start, in metres.
    pub start: Point,
    /// Of length one.
    pub direction: Point,
    /// The length, in metres.
    pub length: f64,
    /// Which of the sensor's beams this is a visible part of.
    pub number: u32,
}

impl Beam {
    /// The end, in metres.
    pub fn end(&self) -> Point {
        self.start + self.direction * self.length
    }

    /// Distance from a point to the beam.
    pub fn distance(&self, p: Point) -> f64 {
        p.distance(self.nearest(p))
    }

    pub(crate) fn is_within(&self, p: Point, radius: f64) -> bool {
        p.distance_squared(self.nearest(p)) <= radius * radius
    }

    fn nearest(&self, p: Point) -> Point {
        self.start + self.direction * (p - self.start).dot(self.direction).clamp(0.0, self.length)
    }
}

/// Whether a body standing at `p` touches the beam.
pub(crate) fn touches(beam: &Beam, p: Point, radius: f64) -> bool {
    beam.is_within(p, radius + GRAZING_M)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry;
    use crate::random::{SpanRange, Stream};

    /// Along the x axis from the origin to 4.
    const BEAM: Beam = Beam { start: Point::ZERO, direction: Point::X, length: 4.0, number: 0 };
    const RADIUS_M: f64 = 0.25;

    /// A stride at 1 m/s from instant 0 on.
    fn stride(from: (f64, f64), to: (f64, f64)) -> Stride {
        let (from, to) = (Point::from(from), Point::from(to));
        Stride::new(from, to, RunTime::START, RunTime::START + Span::from_seconds(from.distance(to)))
    }

    fn touch(from: (f64, f64), to: (f64, f64)) -> Option<Span> {
        stride(from, to).first_touch(&BEAM, RADIUS_M, RunTime::START).map(RunTime::since_zero)
    }

    #[test]
    fn a_beam_is_entered_at_its_side() {
        // 1.25 m from the beam, a radius of 0.25: after 1 m.
        assert_eq!(touch((2.0, -1.25), (2.0, 0.75)), Some(SECOND));
        assert_eq!(touch((2.0, 1.25), (2.0, -0.75)), Some(SECOND));
        // Down at 3 in 5: 1.5 m are 0.9 m down, from 1.15 to 0.25, and 1.2 m along.
        assert_eq!(touch((1.0, 1.15), (5.0, -1.85)), Some(Span::from_millis(1_500)));
    }

    #[test]
    fn a_beam_is_entered_at_its_end() {
        assert_eq!(touch((6.25, 0.0), (0.0, 0.0)), Some(2 * SECOND));
        // 0.15 off the axis the disc of 0.25 begins 0.2 before its middle.
        assert_eq!(touch((6.2, 0.15), (1.2, 0.15)), Some(2 * SECOND));
        // Straight at the end from 1.5 m: 1.25 m to go; the side would be reached beyond the end, at x = 4.1875.
        assert_eq!(touch((4.9, 1.2), (4.0, 0.0)), Some(Span::from_millis(1_250)));
    }

    #[test]
    fn a_beam_is_entered_at_its_start() {
        assert_eq!(touch((-1.25, 0.0), (3.0, 0.0)), Some(SECOND));
        assert_eq!(touch((-1.2, -0.15), (3.8, -0.15)), Some(SECOND));
        assert_eq!(touch((-0.9, -1.2), (0.0, 0.0)), Some(Span::from_millis(1_250)));
    }

    #[test]
    fn a_parallel_stride_touches_within_the_strip_alone() {
        assert_eq!(touch((6.0, 0.26), (-2.0, 0.26)), None);
        assert_eq!(touch((-2.0, -0.26), (6.0, -0.26)), None);
        // Within, but going away.
        assert_eq!(touch((5.0, 0.1), (7.0, 0.1)), None);
        assert_eq!(touch((-1.0, 0.1), (-3.0, 0.1)), None);
    }

    #[test]
    fn grazing_is_a_touch() {
        // Within 1e-9 m of touching counts: on a circle of 0.25 m that begins sqrt(2 * 0.25 * 1e-9) = 2.2e-5 m before.
        let graze =
            |touched: Option<Span>| touched.is_some_and(|at| (SECOND - Span::from_micros(24)..=SECOND).contains(&at));
        assert!(graze(touch((4.25, -1.0), (4.25, 1.0))));
        assert!(graze(touch((5.0, 0.25), (2.0, 0.25))));
        assert_eq!(touch((4.250_01, -1.0), (4.250_01, 1.0)), None);
        assert_eq!(touch((5.0, 0.250_01), (2.0, 0.250_01)), None);
    }

    #[test]
    fn a_touch_is_not_before_the_instant_asked_for() {
        // Touched from 1 s, 0.25 m before the beam, to 1.5 s, 0.25 m behind it.
        let stride = stride((2.0, -1.25), (2.0, 2.75));
        let asked = |after| stride.first_touch(&BEAM, RADIUS_M, RunTime::from_micros(after)).map(RunTime::micros);
        assert_eq!(asked(999_999), Some(1_000_000));
        assert_eq!(asked(1_000_000), Some(1_000_000));
        assert_eq!(asked(1_234_567), Some(1_234_567));
        assert_eq!(asked(1_500_000), Some(1_500_000));
        assert_eq!(asked(1_500_001), None);
        assert_eq!(asked(3_000_000), None);
    }

    #[test]
    fn the_end_of_a_stride_does_not_limit_the_answer() {
        assert_eq!(touch((2.0, -1.25), (2.0, -1.0)), Some(SECOND));
    }

    #[test]
    fn a_stride_without_length_touches_what_it_stands_on() {
        let middle = RunTime::START + SECOND / 2;
        let still = |y| {
            let at = Point::new(2.0, y);
            Stride::new(at, at, RunTime::START, RunTime::START + SECOND).first_touch(&BEAM, RADIUS_M, middle)
        };
        assert_eq!(still(0.2), Some(middle));
        assert_eq!(still(0.3), None);
    }

    /// The distance to the beam, by another way and at each millisecond, says the same of some thousand random
    /// strides: the beam is touched at the answer, not a microsecond earlier, and at no sample before.
    #[test]
    fn the_first_touch_is_the_one_that_dense_samples_find() {
        const WIDTH_M: f64 = 1e-12;
        let mut stream = Stream::named(1, "strides");
        let mut between = |least: f64, most: f64| {
            least + (most - least) * stream.span(SpanRange { least: Span::ZERO, most: SECOND }).micros() as f64 / 1e6
        };
        let (mut touched, mut missed, mut at_once) = (0, 0, 0);
        for case in 0..8_000 {
            // Every fourth runs along an axis; of the beams every third does, and every fourth is short.
            let from = Point::new(between(-2.0, 2.0), between(-2.0, 2.0));
            let to = match case % 4 {
                0 => Point::new(from.x, between(-2.0, 2.0)),
                _ => Point::new(between(-2.0, 2.0), between(-2.0, 2.0)),
            };
            let beam = Beam {
                start: Point::new(between(-1.5, 1.5), between(-1.5, 1.5)),
                direction: geometry::direction(if case % 3 == 0 { 90.0 } else { between(0.0, 360.0) }),
                length: if case % 4 == 1 { between(0.0, 0.1) } else { between(0.5, 4.0) },
                number: 0,
            };
            let radius = between(0.05, 0.4);
            let begin = RunTime::from_micros(between(0.0, 1e9) as i64);
            let length = Span::from_micros((between(0.2, 4.0) * 1e6) as i64);
            let end = begin + length;
            let late = if case % 5 == 0 { (length.micros() as f64 * between(0.0, 1.0)) as i64 } else { 0 };
            let after = begin + Span::from_micros(late);
            let stride = Stride::new(from, to, begin, end);
            let away = |at: RunTime| {
                let share = (at - begin).ratio(length);
                geometry::distance_to_segment(from + (to - from) * share, beam.start, beam.end()) - radius - GRAZING_M
            };
            let found = stride.first_touch(&beam, radius, after);
            let first = (after.micros()..=end.micros())
                .step_by(1000)
                .map(RunTime::from_micros)
                .find(|&at| away(at) <= -WIDTH_M);
            let what =
                || format!("case {case}: {stride:?} {beam:?} {radius} after {after}: {found:?}, samples {first:?}");
            match found.filter(|&at| at <= end) {
                Some(at) => {
                    assert!(away(at) <= WIDTH_M, "{}", what());
                    assert!(at == after || away(at - Span::MICROSECOND) > -WIDTH_M, "{}", what());
                    assert!(first.is_none_or(|first| at <= first), "{}", what());
                    touched += 1;
                    at_once += u32::from(at == after);
                }
                None => {
                    assert_eq!(first, None, "{}", what());
                    missed += 1;
                }
            }
        }
        assert!(
            touched > 1_000 && missed > 1_000 && at_once > 100,
            "{touched} touched, {at_once} of them at once, {missed} not"
        );
    }

    #[test]
    fn the_span_within_a_circle_is_closed_and_in_whole_microseconds() {
        let at = |millis| RunTime::START + Span::from_millis(millis);
        // A chord at 0.6 of a circle of 1: 0.8 to either side of x = 2.
        let stride = stride((0.0, 0.6), (1.0, 0.6));
        assert_eq!(stride.span_within(Point::new(2.0, 0.0), 1.0), Some(at(1_200)..=at(2_800)));
        assert_eq!(stride.span_within(Point::new(2.0, 0.0), 0.5), None);
    }

    #[test]
    fn distance_to_a_beam_is_that_to_its_nearest_point() {
        assert_eq!(BEAM.distance(Point::new(1.0, -2.0)), 2.0);
        assert_eq!(BEAM.distance(Point::new(7.0, 4.0)), 5.0);
        assert_eq!(BEAM.distance(Point::new(-3.0, 4.0)), 5.0);
        assert_eq!(BEAM.end(), Point::new(4.0, 0.0));
    }
}
