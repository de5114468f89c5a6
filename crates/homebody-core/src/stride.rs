//! A straight movement at constant speed.

use crate::geometry::Point;
use crate::time::{Micros, SECOND};

/// A straight movement at constant speed from one instant to another.
///
/// Positions always come from the whole stride's ends, so that looking at a part of it, or cutting
/// it, changes no position by a single bit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stride {
    pub from: Point,
    pub to: Point,
    pub begin: Micros,
    pub end: Micros,
    /// Metres per microsecond.
    pub(crate) velocity: Point,
    /// Microseconds per metre along each axis; infinite where it stays.
    pub(crate) slowness: Point,
}

impl Stride {
    /// A stride; `end` is after `begin`.
    pub fn new(from: Point, to: Point, begin: Micros, end: Micros) -> Stride {
        let velocity = (to - from) / (end - begin) as f64;
        Stride { from, to, begin, end, velocity, slowness: velocity.abs().recip() }
    }

    /// Where the body is at an instant of the stride.
    pub fn position(&self, at: Micros) -> Point {
        self.from + self.velocity * (at - self.begin) as f64
    }

    /// Metres per second.
    pub fn speed_mps(&self) -> f64 {
        self.velocity.length() * SECOND as f64
    }

    /// The first instant not before `after` at which a body of this radius touches the beam; nothing
    /// if it does not from then on. The stride's end does not limit the answer.
    ///
    /// The body's centre against the beam is a point against a capsule: it is entered through the
    /// strip's side, or through the disc at the beam's start or end. The capsule is convex, so exactly one
    /// applies, and it is left once only.
    pub fn first_touch(&self, beam: &Beam, radius: f64, after: Micros) -> Option<Micros> {
        let radius = radius + GRAZING_M;
        if beam.touches(self.position(after), radius) {
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

    /// The span in which the centre is within `radius` of `point`, closed, as instants that may lie
    /// outside the stride.
    pub(crate) fn span_within(&self, point: Point, radius: f64) -> Option<(Micros, Micros)> {
        let start = self.from - point;
        let a = self.velocity.length_squared();
        let b = start.dot(self.velocity);
        let c = start.length_squared() - radius * radius;
        if a == 0.0 {
            return (c <= 0.0).then_some((self.begin, self.end));
        }
        let root = b * b - a * c;
        if root < 0.0 {
            return None;
        }
        let root = libm::sqrt(root);
        let instant = |t: f64| self.begin.saturating_add(t as Micros);
        Some((instant(libm::ceil((-b - root) / a)), instant(libm::floor((-b + root) / a))))
    }

    /// `after_begin` microseconds as an instant, unless it lies before `after`.
    fn not_before(&self, after_begin: f64, after: Micros) -> Option<Micros> {
        let at = self.begin.saturating_add(libm::ceil(after_begin) as Micros);
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
    pub start: Point,
    /// Of length one.
    pub direction: Point,
    pub length: f64,
    /// Which of the sensor's beams this is a visible part of.
    pub number: u32,
}

impl Beam {
    pub fn end(&self) -> Point {
        self.start + self.direction * self.length
    }

    /// Distance from a point to the beam.
    pub fn distance(&self, p: Point) -> f64 {
        p.distance(self.nearest(p))
    }

    pub(crate) fn touches(&self, p: Point, radius: f64) -> bool {
        p.distance_squared(self.nearest(p)) <= radius * radius
    }

    fn nearest(&self, p: Point) -> Point {
        self.start + self.direction * (p - self.start).dot(self.direction).clamp(0.0, self.length)
    }
}

/// Whether a body standing at `p` touches the beam.
pub(crate) fn touches(beam: &Beam, p: Point, radius: f64) -> bool {
    beam.touches(p, radius + GRAZING_M)
}
