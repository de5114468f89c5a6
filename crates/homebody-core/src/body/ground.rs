//! The surfaces that bodies stand, sit and lie on, and free floor to lie on.
//!
//! We assume that a seat or a mattress is where people can be in a piece of furniture, as high as the piece but no higher than a
//! usual bed: what is higher of an armchair is its back.
//!
//! Left out: pillows, arms of chairs, how far a mattress gives way.

use crate::geometry::{self, Point};
use std::f64::consts::TAU;

/// Greatest height of a seat or mattress, in metres (our choice).
pub const HIGHEST_SUPPORT_M: f64 = 0.55;

/// The places of people in furniture, and the obstacles to lying down.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ground {
    supports: Vec<Support>,
    /// Walls, and furniture that is not enterable.
    obstacles: Vec<Vec<Point>>,
}

#[derive(Clone, Debug, PartialEq)]
struct Support {
    outline: Vec<Point>,
    height_m: f64,
    /// Along its longest side.
    along_rad: f64,
}

/// Number of directions that are tried for a person who lies on the floor (our choice).
const DIRECTIONS: usize = 16;

impl Ground {
    /// Nothing but floor.
    pub fn floor() -> Ground {
        Ground::default()
    }

    /// The same with a piece of furniture that people can be in: its outline, and how high the piece is.
    pub fn and_support(mut self, outline: Vec<Point>, height_m: f64) -> Ground {
        let (height_m, along_rad) = (height_m.min(HIGHEST_SUPPORT_M), longest_side_rad(&outline));
        self.supports.push(Support { outline, height_m, along_rad });
        self
    }

    /// The same with another obstacle.
    pub fn and_obstacle(mut self, outline: Vec<Point>) -> Ground {
        self.obstacles.push(outline);
        self
    }

    /// The height of the surface at a point, in metres: 0 for the floor.
    pub fn support_m(&self, at: Point) -> f64 {
        let under = self.supports.iter().filter(|support| geometry::contains(&support.outline, at));
        under.map(|support| support.height_m).fold(0.0, f64::max)
    }

    /// The facing of a body that lies down at a point, toward its feet: along the bed, or along the free floor nearest
    /// to the present facing. `length_m` is the length of the body.
    pub fn lies_facing(&self, at: Point, facing_rad: f64, length_m: f64) -> f64 {
        if let Some(bed) = self.supports.iter().find(|support| geometry::contains(&support.outline, at)) {
            let turned = bed.along_rad + TAU / 2.0;
            let is_nearer =
                super::joints::turn(facing_rad, bed.along_rad).abs() <= super::joints::turn(facing_rad, turned).abs();
            return if is_nearer { bed.along_rad } else { turned };
        }
        self.free_direction(at, facing_rad, length_m)
    }

    /// The direction nearest to a wished one along which a body of this length has room on the floor, half of it on
    /// either side of the point; the wished one if there is no room at all.
    pub fn free_direction(&self, at: Point, wished_rad: f64, length_m: f64) -> f64 {
        let is_free = |angle: f64| {
            let half = Point::new(libm::cos(angle), libm::sin(angle)) * (length_m / 2.0);
            self.obstacles.iter().all(|outline| {
                !geometry::contains(outline, at)
                    && geometry::sides(outline)
                        .all(|side| !geometry::segments_meet(at - half, at + half, side.0, side.1))
            })
        };
        let step = TAU / DIRECTIONS as f64;
        // First the wished one, then further and further to both sides.
        let turns = (0..DIRECTIONS).map(|index| {
            let steps = index.div_ceil(2) as f64 * step;
            if index % 2 == 0 { wished_rad + steps } else { wished_rad - steps }
        });
        turns.into_iter().find(|&angle| is_free(angle)).unwrap_or(wished_rad)
    }
}

fn longest_side_rad(outline: &[Point]) -> f64 {
    let longest = geometry::sides(outline).map(|(a, b)| b - a).fold(Point::ZERO, |longest, side| {
        if side.length_squared() > longest.length_squared() { side } else { longest }
    });
    libm::atan2(longest.y, longest.x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    fn rectangle([x, y]: [f64; 2], [width, depth]: [f64; 2]) -> Vec<Point> {
        let corner = |right: f64, up: f64| Point::new(x + right * width / 2.0, y + up * depth / 2.0);
        vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)]
    }

    fn ground() -> Ground {
        Ground::floor()
            .and_support(rectangle([1.0, 1.0], [0.9, 1.6]), 0.5)
            .and_support(rectangle([3.0, 1.0], [0.8, 0.8]), 1.0)
            .and_obstacle(rectangle([3.0, 0.0], [6.0, 0.1]))
            .and_obstacle(rectangle([3.0, 2.0], [6.0, 0.1]))
            .and_obstacle(rectangle([5.5, 1.0], [0.6, 0.8]))
    }

    #[test]
    fn a_mattress_is_as_high_as_its_bed_and_a_seat_lower_than_its_back() {
        let ground = ground();
        let [bed, chair, floor] = [1.0, 3.0, 4.5].map(|x| ground.support_m(Point::new(x, 1.0)));
        assert_eq!([bed, chair, floor], [0.5, HIGHEST_SUPPORT_M, 0.0]);
    }

    #[test]
    fn one_lies_along_a_bed_and_along_free_floor() {
        let ground = ground();
        let facing = |x: f64, facing| ground.lies_facing(Point::new(x, 1.0), facing, 1.65);
        assert!((facing(1.0, 1.2) - FRAC_PI_2).abs() < 1e-9);
        // Half of 1.65 m is more than the 0.65 m to the wall.
        let along = ground.lies_facing(Point::new(4.2, 0.7), FRAC_PI_2, 1.65);
        assert!((along - FRAC_PI_2).abs() > 0.1, "{along}");
        assert!(libm::sin(along).abs() * 1.65 / 2.0 < 0.65);
        assert_eq!(facing(4.2, 0.1), 0.1);
    }
}
