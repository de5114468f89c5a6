//! Straight walls, as in the file of a home. Curved ones become chords, cut so that each door is in one of them.

use crate::drawing::{self, PlanPiece};
use crate::error::ImportError;
use homebody_core::geometry::{self, Point};
use homebody_core::problem::counted;
use std::f64::consts::TAU;

#[derive(Clone, Debug, PartialEq)]
pub struct StraightWall {
    pub from: Point,
    pub to: Point,
    pub thickness_m: f64,
}

/// Shorter walls are slips of the mouse: the check refuses those under a millimetre, and ends are rounded to one.
const LEAST_LENGTH_M: f64 = 0.003;

/// The range of the thickness of walls in a home.
const THICKNESS_M: [f64; 2] = [0.001, 2.0];

/// Largest distance of a chord from its arc (our choice): less than the plaster.
const CHORD_OFF_M: f64 = 0.01;

/// Largest number of chords of one wall (our choice).
const MOST_CHORDS: f64 = 64.0;

/// Angles between which an arc is drawn as one (our choice): flatter arcs are straight, and fuller ones are circles
/// without distinct ends.
const ARC_RAD: [f64; 2] = [1e-3, TAU - 1e-3];

/// Largest distance of the middle of a door from its wall, beyond half the wall's thickness (our choice).
pub const DOOR_OFF_M: f64 = 0.3;

/// Largest number of walls of a floor that is searched for exits, gaps, open-air rooms or moves (our choice): the time
/// grows with its square.
pub const MOST_SEARCHED: usize = 400;

/// Largest number of walls of a home.
const MOST_WALLS: usize = 5_000;

pub fn straight(
    walls: &[drawing::PlanWall],
    doors: &[PlanPiece],
    remarks: &mut Vec<String>,
) -> Result<Vec<StraightWall>, ImportError> {
    let (mut straight, mut curved) = (Vec::new(), 0);
    for wall in walls {
        let thickness_m = wall.thickness_m.clamp(THICKNESS_M[0], THICKNESS_M[1]);
        let points = match Arc::from_wall(wall) {
            Some(arc) => {
                curved += 1;
                arc.points(doors)
            }
            None => vec![wall.from, wall.to],
        };
        straight.extend(points.windows(2).map(|ends| StraightWall { from: ends[0], to: ends[1], thickness_m }));
        if straight.len() > MOST_WALLS {
            let hint = "import one level of it, or a plan of one home";
            let count = walls.len().max(straight.len());
            return Err(ImportError::TooMany { what: "walls", count, most: MOST_WALLS, hint });
        }
    }
    let all = straight.len();
    straight.retain(|wall| wall.from.distance(wall.to) >= LEAST_LENGTH_M);
    if curved > 0 {
        remarks.push(format!("{} of straight chords now", counted(curved, "curved wall is", "curved walls are")));
    }
    if straight.len() < all {
        let short = counted(all - straight.len(), "wall without length", "walls without length");
        remarks.push(format!("left out: {short}"));
    }
    Ok(straight)
}

/// Largest distance beyond the face of a wall at which another one was meant to meet it (our choice).
pub const OFF_FACE_M: f64 = 0.06;

/// Sine of the smallest angle between walls that meet rather than run in parallel (our choice): 15 degrees.
const MEET_SINE: f64 = 0.26;

/// Largest number of walls that are joined (our choice): each end is compared with all, and plans of homes have some
/// tens.
const MOST_JOINED: usize = 1_000;

/// The walls, with those that end at the face of another, or inside of it, extended to its middle line: rooms meet
/// there.
pub fn joined(walls: Vec<StraightWall>) -> Vec<StraightWall> {
    if walls.len() > MOST_JOINED {
        return walls;
    }
    let end = |wall: &StraightWall, end: Point, along: Point| {
        let middle_lines = walls.iter().filter(|other| *other != wall).filter_map(|other| {
            let reach_m = other.thickness_m / 2.0 + OFF_FACE_M;
            let turn = along.perp_dot(other.along());
            let is_met = turn.abs() >= MEET_SINE && geometry::distance_to_segment(end, other.from, other.to) <= reach_m;
            let way = (other.from - end).perp_dot(other.along()) / turn;
            // Beyond the end, or before it if the wall reaches through the other's middle.
            let is_near = way.abs() <= reach_m / MEET_SINE && way > -wall.length() / 2.0;
            let meeting = end + along * way;
            let is_on = geometry::distance_to_segment(meeting, other.from, other.to) <= reach_m;
            (is_met && is_near && is_on).then_some((way.abs(), meeting))
        });
        let nearest = middle_lines.min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map_or(end, |(_, meeting)| meeting)
    };
    let join = |wall: &StraightWall| {
        let along = wall.along();
        StraightWall { from: end(wall, wall.from, -along), to: end(wall, wall.to, along), ..wall.clone() }
    };
    let joined = walls.iter().map(|wall| Some(join(wall)).filter(|joined| joined.length() >= LEAST_LENGTH_M));
    joined.zip(&walls).map(|(joined, wall)| joined.unwrap_or_else(|| wall.clone())).collect()
}

impl StraightWall {
    pub fn length(&self) -> f64 {
        self.from.distance(self.to)
    }

    pub fn along(&self) -> Point {
        (self.to - self.from).normalize_or_zero()
    }
}

struct Arc {
    middle: Point,
    start: Point,
    end: Point,
    radius_m: f64,
    /// Counter-clockwise from start to end.
    extent_rad: f64,
    thickness_m: f64,
}

impl Arc {
    fn from_wall(wall: &drawing::PlanWall) -> Option<Arc> {
        let (half, extent_rad) = ((wall.to - wall.from) / 2.0, wall.arc_rad);
        if !(ARC_RAD[0]..=ARC_RAD[1]).contains(&extent_rad.abs()) {
            return None;
        }
        let middle = wall.from + half + half.perp() / (extent_rad / 2.0).tan();
        let radius_m = middle.distance(wall.from);
        let (start, end, thickness_m) = (wall.from, wall.to, wall.thickness_m);
        (radius_m > LEAST_LENGTH_M).then_some(Arc { middle, start, end, radius_m, extent_rad, thickness_m })
    }

    fn points(&self, doors: &[PlanPiece]) -> Vec<Point> {
        let mut cuts = vec![(0.0, 0.0), (1.0, 1.0)];
        cuts.extend(doors.iter().filter_map(|door| self.span(door)));
        cuts.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut shares: Vec<f64> = vec![0.0];
        for (start, end) in cuts {
            let last = shares[shares.len() - 1];
            // Of doors that overlap, the first has its chord.
            if start < last {
                continue;
            }
            let chords = self.chords(start - last);
            shares.extend((1..=chords as u32).map(|chord| last + (start - last) * f64::from(chord) / chords));
            shares.push(end);
        }
        shares.dedup();
        let last = shares.len() - 1;
        let place = |(index, share): (usize, &f64)| match index {
            0 => self.start,
            _ if index == last => self.end,
            _ => self.at(*share),
        };
        shares.iter().enumerate().map(place).collect()
    }

    fn chords(&self, share: f64) -> f64 {
        let flat = (1.0 - (CHORD_OFF_M / self.radius_m).min(1.0)).acos() * 2.0;
        (self.extent_rad.abs() * share / flat).ceil().clamp(1.0, MOST_CHORDS)
    }

    fn at(&self, share: f64) -> Point {
        self.middle + geometry::direction((self.extent_rad * share).to_degrees()).rotate(self.start - self.middle)
    }

    /// The start and end of a door as shares of the way, if it is in this wall as a whole.
    fn span(&self, door: &PlanPiece) -> Option<(f64, f64)> {
        let out = door.at - self.middle;
        if (out.length() - self.radius_m).abs() > self.thickness_m / 2.0 + DOOR_OFF_M {
            return None;
        }
        let way = self.extent_rad.signum() * (self.start - self.middle).angle_to(out);
        let middle = way.rem_euclid(TAU) / self.extent_rad.abs();
        let half = (door.width_m / 2.0 / self.radius_m).min(1.0).asin() / self.extent_rad.abs();
        (half > 0.0 && middle - half >= 0.0 && middle + half <= 1.0).then_some((middle - half, middle + half))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn half_circle() -> drawing::PlanWall {
        let (from, to) = (Point::new(0.0, 0.0), Point::new(4.0, 0.0));
        drawing::PlanWall { level: None, from, to, thickness_m: 0.1, arc_rad: std::f64::consts::PI }
    }

    #[test]
    fn an_arc_goes_around_its_middle_from_end_to_end() {
        // Counter-clockwise from the west to the east of the circle around (2, 0): through the south.
        let arc = Arc::from_wall(&half_circle()).unwrap();
        assert!(arc.middle.distance(Point::new(2.0, 0.0)) < 1e-12 && (arc.radius_m - 2.0).abs() < 1e-12);
        assert!(arc.at(0.5).distance(Point::new(2.0, -2.0)) < 1e-12);
        let points = arc.points(&[]);
        assert_eq!((points[0], points[points.len() - 1]), (arc.start, arc.end));
        for ends in points.windows(2) {
            let off = 2.0 - ((ends[0] + ends[1]) / 2.0).distance(arc.middle);
            assert!((0.0..CHORD_OFF_M).contains(&off), "{off}");
        }
        // A quarter of a circle of the other turn.
        let quarter = drawing::PlanWall { arc_rad: -TAU / 4.0, ..half_circle() };
        let arc = Arc::from_wall(&quarter).unwrap();
        assert!(arc.middle.distance(Point::new(2.0, -2.0)) < 1e-12, "{}", arc.middle);
        assert!(arc.at(0.5).distance(Point::new(2.0, 8.0_f64.sqrt() - 2.0)) < 1e-12);
        // Three quarters.
        let most = drawing::PlanWall { arc_rad: TAU * 0.75, ..half_circle() };
        assert!(Arc::from_wall(&most).unwrap().at(0.5).distance(Point::new(2.0, -2.0 - 8.0_f64.sqrt())) < 1e-12);
    }
}
