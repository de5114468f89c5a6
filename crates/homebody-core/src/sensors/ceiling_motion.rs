//! A passive infrared sensor on the ceiling.
//!
//! The device looks straight down through a narrow lens on one spot: a shower, a drawer, a closet.
//!
//! We assume that it sees every movement of a body over the area, even in part, and no other (Godsey & Skubic 2009,
//! section III.D: a rectangular area that, when intersected, makes the sensor active). A body that keeps still is not
//! seen.
//!
//! The area is a convex outline. A body of radius r touches it while its centre is within r of the
//! area, which begins, from outside, at one of the outline's sides: each side is a beam.
//!
//! Left out: the height of the body (the beam widens downward), furniture above the area, and walls: the checks refuse
//! an area that reaches through one.

use super::entities::EntityRow;
use super::form::{Colour, KindRow, Mount, SensorForm, Shape};
use super::looking::LookingModel;
use super::meaning::{Kind, Meaning};
use super::notice::View;
use crate::event::Value;
use crate::geometry::{self, At, Point};
use crate::plan::Plan;
use crate::sensors::preset::MotionSettings;
use crate::stride::Beam;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The row of the kind.
pub static ROW: KindRow = KindRow {
    key: "ceiling_motion",
    label: "motion, from the ceiling",
    mount: Mount::Ceiling,
    unit: None,
    values: &[Value::Fire],
    shape: Shape::Ring,
    colour: Colour::Sky,
    casas: "M",
    meaning: Meaning::Is(Kind::Motion),
    entities: &[EntityRow::switch("motion", "occupancy")],
};

/// A passive infrared sensor on the ceiling that looks straight down on an area.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "ceiling motion sensor")]
pub struct CeilingMotionFile {
    /// Name of the sensor, unique in the home. The log uses it unless `logger.json` gives another id.
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// Convex area of the floor that the sensor sees: its corners in order.
    #[schemars(length(min = 3, max = 64), inner(inner(range(min = -10_000, max = 10_000))))]
    pub area: Vec<At>,
    /// Its device model and what overrides it.
    #[serde(flatten)]
    pub settings: MotionSettings,
}

impl SensorForm for CeilingMotionFile {
    fn area_below(&self) -> Option<&[At]> {
        Some(&self.area)
    }

    fn beam_count(&self) -> u32 {
        self.area.len() as u32
    }

    fn scale_reach(&mut self, factor: f64) -> bool {
        let corners = geometry::points(&self.area);
        let middle = geometry::inner_point(&corners);
        let away = |at: f64, from: f64| geometry::whole_millimetres(from + (at - from) * factor);
        self.area = corners.iter().map(|at| [away(at.x, middle.x), away(at.y, middle.y)]).collect();
        true
    }
}

/// Height of a lens at 2.4 m above the middle of a person who stands or sits (our choice).
const LENS_ABOVE_M: f64 = 1.5;

/// A ceiling sensor's area.
#[derive(Clone, Debug, PartialEq)]
pub struct CeilingMotion {
    /// Convex, corners counter-clockwise.
    pub outline: Vec<Point>,
    /// Below the lens: a point inside the area.
    pub middle: Point,
}

impl CeilingMotion {
    /// The area of a file that has passed its checks, in whichever order it has the corners.
    pub fn new(file: &CeilingMotionFile) -> CeilingMotion {
        let mut outline = geometry::points(&file.area);
        if geometry::signed_area(&outline) < 0.0 {
            outline.reverse();
        }
        CeilingMotion { middle: geometry::inner_point(&outline), outline }
    }
}

impl LookingModel for CeilingMotion {
    fn lens(&self) -> Point {
        self.middle
    }

    /// The sides of the area.
    fn beams(&self, _plan: &Plan, _body_m: f64) -> Vec<Beam> {
        let sides = geometry::sides(&self.outline).enumerate();
        sides
            .map(|(number, (a, b))| Beam {
                start: a,
                direction: (b - a).normalize_or_zero(),
                length: a.distance(b),
                number: number as u32,
            })
            .collect()
    }

    fn view(&self, at: Point) -> View {
        let distance_m = libm::hypot(at.distance(self.middle), LENS_ABOVE_M);
        View { distance_m, depth_m: geometry::depth_in_area(&self.outline, at) }
    }

    fn area_below(&self) -> Option<&[Point]> {
        Some(&self.outline)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depth_in_the_area_is_the_distance_from_its_border() {
        let file = serde_json::json!({ "name": "m", "area": [[0, 0], [0, 2], [2, 2], [2, 0]] });
        let area = CeilingMotion::new(&serde_json::from_value(file).expect("a ceiling sensor"));
        assert_eq!(area.view(Point::ONE), View { distance_m: 1.5, depth_m: 1.0 });
        // 2 m to the east of the middle: sqrt(1.5^2 + 2^2) = 2.5, and 1 m outside.
        assert_eq!(area.view(Point::new(3.0, 1.0)), View { distance_m: 2.5, depth_m: -1.0 });
    }
}
