//! A wall-mounted passive infrared sensor.
//!
//! The device watches warm bodies move through a lens that spreads its view over a fan, 145 degrees
//! wide and 50 degrees high at TigerPlace, finer in the middle than at the edges (Godsey & Skubic 2009,
//! section III.D).
//!
//! We assume that every moving body is warm and large enough; that the lens stands two centimetres off
//! the wall; and that the fan is made of upright blades, each at one bearing, as high as the field is.
//! Bearings are spread as sign(u) |u|^1.5 over u in -1..1: of 32 over 145 degrees the middle two are 0.8 degrees
//! apart, the outermost two 6.9 (the exponent is ours; the paper's figure 3 only says that the middle is dense and the
//! edge sparse). The rows of the level `zones` are spread evenly.
//!
//! From a lens at height h, a body of height t at range r shows itself between the depressions
//! atan((h - t) / r) and atan(h / r). It is in a blade where that span meets the blade's own, so each
//! blade is a straight span of the floor plan, one per height of body. Walls, closed doors and furniture
//! as high as the lens end it; lower furniture casts a shadow behind it on bodies lower than itself.
//!
//! Left out: temperature and its contrast, the lens' gain by angle, mirrors and glass; a blade's
//! steep lower limit behind low furniture.

use super::entities::EntityRow;
use super::form::{Colour, FormProblem, KindRow, Mount, Orientation, SensorForm, Shape};
use super::looking::{DetectionLevel, LookingModel};
use super::meaning::{Kind, Meaning};
use super::messages::SensorMessage;
use super::notice::View;
use super::rays::SightObstacles;
use crate::event::Value;
use crate::geometry::{self, At, Point, point};
use crate::plan::{Plan, Solid};
use crate::sensors::preset::MotionSettings;
use crate::stride::Beam;
use crate::time::Span;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The row of the kind.
pub static ROW: KindRow = KindRow {
    key: "motion",
    label: "motion, on a wall",
    mount: Mount::Wall,
    unit: None,
    values: &[Value::Fire],
    shape: Shape::Arrow,
    colour: Colour::Blue,
    casas: "M",
    meaning: Meaning::Is(Kind::Motion),
    entities: &[EntityRow::switch("motion", "occupancy")],
};

/// Distance of the lens from the wall.
pub const LENS_OFF_WALL_M: f64 = 0.02;

/// A wall sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// The position of the lens on the plan, in metres: [`LENS_OFF_WALL_M`] in front of the wall.
    pub lens: Point,
    /// The height of the lens above the floor, in metres.
    pub height_m: f64,
    /// The range along the floor, in metres.
    pub reach_m: f64,
    /// The fan from right to left; at the level `zones`, row after row from the top.
    pub blades: Vec<Blade>,
    /// The changes that count as movement.
    pub level: DetectionLevel,
}

/// One bearing of the fan, before anything in the home limits it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blade {
    /// The direction on the plan, of length one.
    pub direction: Point,
    /// Tangents of the least and the greatest depression, positive below the horizon.
    pub least_depression: f64,
    /// The tangent of the greatest depression: how far below the horizon, per metre along the floor, it still looks.
    pub greatest_depression: f64,
    /// At the `zones` level, whether the zone is the positive one of its pair.
    pub positive: bool,
}

impl Motion {
    /// The sensor of a file that has passed its checks.
    pub fn new(file: &MotionFile) -> Motion {
        let lens = point(file.at) + geometry::direction(file.facing_deg) * LENS_OFF_WALL_M;
        let [width, height] = file.field_deg;
        let bottom = file.tilt_deg + height / 2.0;
        let blade = |bearing: f64, top: f64, bottom: f64, positive| Blade {
            direction: geometry::direction(file.facing_deg + bearing),
            least_depression: tangent(top),
            greatest_depression: tangent(bottom),
            positive,
        };
        let (blades, level) = match &file.level {
            LevelFile::Zones(zones) => {
                let row_height = height / 3.0;
                let uppermost = zones.rows.iter().copied().find(|&count| count > 0).unwrap_or(0);
                let rows = zones.rows.iter().enumerate();
                let blades = rows.flat_map(|(row, &count)| {
                    let top = file.tilt_deg - height / 2.0 + row as f64 * row_height;
                    spread(count, 1.0).map(move |(index, u)| {
                        blade(u * width / 2.0, top, top + row_height, (index + row as u32).is_multiple_of(2))
                    })
                });
                let level = DetectionLevel::Zones {
                    pulses: zones.pulses,
                    window: Span::from_seconds(zones.window_s),
                    pitch_rad: width.to_radians() / f64::from(uppermost.saturating_sub(1).max(1)),
                };
                (blades.collect(), level)
            }
            level => {
                let top = file.tilt_deg - height / 2.0;
                let blades = spread(file.beams, 1.5).map(|(_, u)| blade(u * width / 2.0, top, bottom, true));
                let level = match level {
                    LevelFile::Sensitivity(file) => {
                        DetectionLevel::Sensitivity { reach_per_m: 1.0 / libm::tan(file.threshold_deg.to_radians()) }
                    }
                    _ => DetectionLevel::Paper,
                };
                (blades.collect(), level)
            }
        };
        Motion { lens, height_m: file.height_m, reach_m: file.reach_m, blades, level }
    }

    /// The ranges at which a blade meets a body of this height where nothing stands in between:
    /// least and most, in metres; nothing if it never does.
    pub fn ranges(&self, blade: &Blade, body_m: f64) -> Option<(f64, f64)> {
        let (mut near, mut far) = (0.0_f64, self.reach_m);
        let above = self.height_m - body_m;
        if blade.greatest_depression > 0.0 {
            near = near.max(above / blade.greatest_depression);
        } else if above > 0.0 {
            return None;
        } else if blade.greatest_depression < 0.0 {
            far = far.min(above / blade.greatest_depression);
        }
        if blade.least_depression > 0.0 {
            far = far.min(self.height_m / blade.least_depression);
        }
        (near < far).then_some((near, far))
    }

    /// The ranges at which furniture hides a body of this height: it stands on the blade from
    /// `enter` to `leave` and is lower than the lens. A body is not hidden by what it lies on.
    pub fn shadow(
        &self,
        furniture_m: f64,
        enterable: bool,
        (enter, leave): (f64, f64),
        body_m: f64,
    ) -> Option<(f64, f64)> {
        if body_m >= furniture_m {
            return None;
        }
        let start = if enterable { leave } else { enter };
        Some((start, leave * (self.height_m - body_m) / (self.height_m - furniture_m)))
    }
}

impl LookingModel for Motion {
    fn lens(&self) -> Point {
        self.lens
    }

    fn beams(&self, plan: &Plan, body_m: f64) -> Vec<Beam> {
        let (tall, low): (Vec<&Solid>, Vec<&Solid>) =
            plan.solids.iter().partition(|solid| solid.height_m >= self.height_m);
        let obstacles = SightObstacles::around(self.lens, self.reach_m, tall.into_iter());
        let mut beams = Vec::new();
        for (number, blade) in self.blades.iter().enumerate() {
            let Some((near, far)) = self.ranges(blade, body_m) else { continue };
            let far = far.min(obstacles.cast(blade.direction, far));
            let mut shadows: Vec<(f64, f64)> = low
                .iter()
                .filter_map(|solid| {
                    let end = self.lens + blade.direction * self.reach_m;
                    let (enter, leave) = geometry::segment_inside_convex(&solid.outline, self.lens, end)?;
                    let span = (enter * self.reach_m, leave * self.reach_m);
                    self.shadow(solid.height_m, !solid.stops_bodies, span, body_m)
                })
                .collect();
            shadows.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut start = near;
            for (dark, light) in shadows.into_iter().chain([(far, far)]) {
                let end = dark.min(far);
                if end > start {
                    beams.push(Beam {
                        start: self.lens + blade.direction * start,
                        direction: blade.direction,
                        length: end - start,
                        number: number as u32,
                    });
                }
                start = start.max(light);
            }
        }
        beams
    }

    /// A body as the lens sees it: its depth is its distance from the end of the fan, at its reach and at its two
    /// sides.
    fn view(&self, at: Point) -> View {
        let from_lens = at - self.lens;
        let distance_m = from_lens.length();
        let mut depth_m = self.reach_m - distance_m;
        // A fan of half a turn and more has no sides to speak of. Blades run from right to left.
        if let (Some(first), Some(last)) = (self.blades.first(), self.blades.last())
            && first.direction.perp_dot(last.direction) > 0.0
        {
            let (right, left) = (first.direction.perp_dot(from_lens), -last.direction.perp_dot(from_lens));
            depth_m = depth_m.min(right).min(left);
        }
        View { distance_m, depth_m }
    }

    fn level(&self) -> DetectionLevel {
        self.level
    }
}

/// `count` numbers over -1..1, dense in the middle for an exponent above 1.
fn spread(count: u32, exponent: f64) -> impl Iterator<Item = (u32, f64)> {
    (0..count).map(move |index| {
        let u = if count == 1 { 0.0 } else { 2.0 * f64::from(index) / f64::from(count - 1) - 1.0 };
        (index, u.signum() * libm::pow(u.abs(), exponent))
    })
}

/// The tangent of an angle in degrees; infinite straight down or steeper, minus infinity straight up.
fn tangent(angle_deg: f64) -> f64 {
    if angle_deg >= 90.0 {
        f64::INFINITY
    } else if angle_deg <= -90.0 {
        f64::NEG_INFINITY
    } else {
        libm::tan(angle_deg.to_radians())
    }
}

/// A passive infrared sensor on a wall. Its field of view is a fan of beams.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "motion sensor")]
pub struct MotionFile {
    /// Name of the sensor, unique in the home. The log uses it unless `logger.json` gives another id.
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// Position of the sensor: a point of a wall. The lens is 2 cm in front of it.
    #[schemars(inner(range(min = -10_000, max = 10_000)))]
    pub at: At,
    /// Height of the lens above the floor.
    #[serde(default = "mounting_height")]
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 10))]
    pub height_m: f64,
    /// Direction of the lens: 0 is east, 90 is north.
    #[schemars(range(min = -360, max = 360))]
    pub facing_deg: f64,
    /// Downward tilt of the lens axis. A positive angle looks down.
    #[serde(default = "tilt")]
    #[schemars(range(min = -90, max = 90))]
    pub tilt_deg: f64,
    /// Horizontal and vertical angle of view.
    #[serde(default = "field")]
    #[schemars(inner(range(min = 0.1, max = 360)))]
    pub field_deg: [f64; 2],
    /// Largest distance along the floor at which the sensor sees a body.
    #[serde(default = "reach")]
    #[schemars(range(min = 0.01, max = 100))]
    pub reach_m: f64,
    /// Number of beams in the fan.
    #[serde(default = "beams")]
    #[schemars(range(min = 1, max = 256))]
    pub beams: u32,
    /// Model of detection: which changes in a beam count as movement.
    #[serde(default)]
    pub level: LevelFile,
    /// Its device model and what overrides it.
    #[serde(flatten)]
    pub settings: MotionSettings,
}

impl MotionFile {
    /// A sensor as it comes, at a point of a wall, that looks to where `facing_deg` says: 0 is east, 90 is north.
    pub fn new(name: &str, at: At, facing_deg: f64) -> MotionFile {
        MotionFile {
            name: name.into(),
            at,
            height_m: mounting_height(),
            facing_deg,
            tilt_deg: tilt(),
            field_deg: field(),
            reach_m: reach(),
            beams: beams(),
            level: LevelFile::default(),
            settings: MotionSettings::default(),
        }
    }
}

impl SensorForm for MotionFile {
    fn orientation(&self) -> Option<Orientation> {
        let MotionFile { at, height_m, facing_deg, tilt_deg, field_deg, reach_m, .. } = *self;
        Some(Orientation { at, height_m, facing_deg, tilt_deg, field_deg, reach_m: Some(reach_m) })
    }

    fn beam_count(&self) -> u32 {
        match &self.level {
            LevelFile::Zones(zones) => zones.rows.iter().sum(),
            _ => self.beams,
        }
    }

    fn counts_pulses(&self) -> bool {
        matches!(self.level, LevelFile::Zones(_))
    }

    fn wrong(&self) -> Vec<FormProblem> {
        let mut wrong = Vec::new();
        let field_deg = self.field_deg[1];
        if field_deg > 180.0 {
            wrong.push(FormProblem::new("/field_deg/1", SensorMessage::VerticalField { field_deg }));
        }
        if matches!(&self.level, LevelFile::Zones(zones) if zones.rows == [0; 3]) {
            wrong.push(FormProblem::new("/level/zones/rows", SensorMessage::NoZones));
        }
        wrong
    }

    fn relocate(&mut self, at: At, facing_deg: f64) -> bool {
        (self.at, self.facing_deg) = (at, facing_deg);
        true
    }

    fn set_field(&mut self, height_m: f64, field_deg: [f64; 2], reach_m: f64) {
        (self.height_m, self.field_deg, self.reach_m) = (height_m, field_deg, reach_m);
    }

    fn scale_reach(&mut self, factor: f64) -> bool {
        self.reach_m = geometry::whole_millimetres(self.reach_m * factor);
        true
    }
}

/// Model of detection of a wall sensor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Default)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Level", title = "level")]
pub enum LevelFile {
    /// Any change in a beam is a movement, as in Godsey & Skubic 2009.
    #[default]
    Paper,
    /// A change in a beam is a movement if it is large enough as seen from the sensor.
    Sensitivity(SensitivityFile),
    /// The field has alternating positive and negative zones. The sensor counts pulses of alternating sign.
    Zones(ZonesFile),
}

/// The `sensitivity` level.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "sensitivity level")]
pub struct SensitivityFile {
    /// Smallest movement that counts: the angle, seen from the lens, that the moving part of the body spans within one
    /// second.
    #[serde(default = "threshold")]
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 90))]
    pub threshold_deg: f64,
}

/// The `zones` level.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "zones level")]
pub struct ZonesFile {
    /// Number of zones in the far, the middle and the near row.
    #[serde(default = "zone_rows")]
    #[schemars(inner(range(max = 64)))]
    pub rows: [u32; 3],
    /// Number of pulses of alternating sign that make a detection.
    #[serde(default = "pulses")]
    #[schemars(range(min = 1, max = 8))]
    pub pulses: u32,
    /// Time within which these pulses have to come.
    #[serde(default = "pulse_window")]
    #[schemars(range(min = 0.001, max = 60))]
    pub window_s: f64,
}

super::form::usual! {
    /// Ours, above the 6 ft (1.83 m) that the manual of the X10 HawkEye MS13A asks for.
    pub(crate) fn mounting_height() -> f64 = 2.1;
    /// The axis meets the floor at 2.355 mounting heights (spaceti.com installation guide).
    pub(crate) fn tilt() -> f64 = 23.0;
    /// Godsey & Skubic 2009, section III.D.
    pub(crate) fn field() -> [f64; 2] = [145.0, 50.0];
    /// 9.6 m for a walking person in an installation guide (spaceti.com), rounded.
    pub(crate) fn reach() -> f64 = 10.0;
    /// Ours: at 3 m the middle two beams are 0.04 m apart and the outermost two 0.36 m, less than a body is wide.
    fn beams() -> u32 = 32;
    /// Ours: a stir of 0.3 m is seen to 5.7 m, as "small motion within 6 m" (spaceti.com).
    fn threshold() -> f64 = 3.0;
    /// Ours: 11 far, 6 middle, 5 near. That lenses have three rows of different counts: Sensors 2016, 16(1), 126.
    fn zone_rows() -> [u32; 3] = [11, 6, 5];
    /// The simulator antioch (`PirSensorConfig`) asks for two pulses of alternating sign within two seconds.
    fn pulses() -> u32 = 2;
    /// See [`pulses`].
    fn pulse_window() -> f64 = 2.0;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{SpanRange, Stream};
    use crate::time::SECOND;

    fn sensor(height_m: f64, depressions_deg: (f64, f64)) -> Motion {
        let blade = Blade {
            direction: Point::X,
            least_depression: tangent(depressions_deg.0),
            greatest_depression: tangent(depressions_deg.1),
            positive: true,
        };
        Motion { lens: Point::ZERO, height_m, reach_m: 10.0, blades: vec![blade], level: DetectionLevel::Paper }
    }

    fn close(found: Option<(f64, f64)>, expected: (f64, f64)) -> bool {
        found.is_some_and(|found| (found.0 - expected.0).abs() < 1e-6 && (found.1 - expected.1).abs() < 1e-6)
    }

    fn file(json: serde_json::Value) -> MotionFile {
        serde_json::from_value(json).expect("a motion sensor")
    }

    #[test]
    fn a_blade_meets_a_body_between_where_its_ends_pass_its_top_and_its_feet() {
        // The lower end falls 2.4 - 1.6 = 0.8 m to the top within 0.8 / tan 45; the upper 2.4 m to the floor
        // within 2.4 / tan 30 = 4.156922.
        let motion = sensor(2.4, (30.0, 45.0));
        assert!(close(motion.ranges(&motion.blades[0], 1.6), (0.8, 4.156922)));
        // The default fan: from 0.45 / tan 48 = 0.405182 for who stands, 0.78 / tan 48 = 0.702315 for who sits, and as
        // the upper end looks up, to the end of the reach.
        let motion = sensor(2.1, (-2.0, 48.0));
        assert!(close(motion.ranges(&motion.blades[0], 1.65), (0.405182, 10.0)));
        assert!(close(motion.ranges(&motion.blades[0], 1.32), (0.702315, 10.0)));
    }

    #[test]
    fn a_blade_that_looks_up_meets_only_what_is_higher_than_the_lens() {
        // Its lower end rises the 0.6 m to the top within 0.6 / tan 30 = 1.039230.
        let motion = sensor(1.0, (-45.0, -30.0));
        assert!(close(motion.ranges(&motion.blades[0], 1.6), (0.0, 1.039230)));
        assert_eq!(motion.ranges(&motion.blades[0], 0.9), None);
        assert_eq!(motion.ranges(&motion.blades[0], 1.0), None);
    }

    #[test]
    fn a_level_lower_end_meets_no_body_below_it_and_a_steep_upper_end_no_far_one() {
        let level = sensor(1.5, (-20.0, 0.0));
        assert_eq!(level.ranges(&level.blades[0], 1.4), None);
        assert_eq!(level.ranges(&level.blades[0], 1.6), Some((0.0, 10.0)));
        let down = sensor(1.5, (90.0, 120.0));
        assert_eq!(down.ranges(&down.blades[0], 1.4), None);
    }

    #[test]
    fn a_shadow_ends_where_the_sight_line_over_the_far_edge_comes_down_to_the_top_of_the_body() {
        // From 2.1 m over an edge 1.5 m high 3 m away the line falls 0.2 m a metre: it is at 1.32 m after 3.9 m.
        let motion = sensor(2.1, (-90.0, 90.0));
        assert!(close(motion.shadow(1.5, false, (2.0, 3.0), 1.32), (2.0, 3.9)));
        // From 2.4 m over an edge 0.8 m high 2 m away it falls 0.8 m a metre: it is at 0.4 m after 2.5 m.
        let motion = sensor(2.4, (-90.0, 90.0));
        assert!(close(motion.shadow(0.8, false, (1.0, 2.0), 0.4), (1.0, 2.5)));
        // A body on it is seen.
        assert!(close(motion.shadow(0.8, true, (1.0, 2.0), 0.4), (2.0, 2.5)));
    }

    #[test]
    fn furniture_hides_no_body_of_its_own_height() {
        let motion = sensor(2.1, (-90.0, 90.0));
        assert_eq!(motion.shadow(0.75, false, (2.0, 3.0), 0.75), None);
        assert_eq!(motion.shadow(0.75, false, (2.0, 3.0), 1.32), None);
    }

    /// Against the sight line itself, walked in steps of a millimetre: random heights, and bodies on random places behind
    /// or before a piece of furniture.
    #[test]
    fn a_body_is_hidden_where_the_furniture_cuts_the_sight_line_to_its_top() {
        let mut stream = Stream::named(1, "sight lines");
        let mut between = |least: f64, most: f64| {
            least + (most - least) * stream.span(SpanRange { least: Span::ZERO, most: SECOND }).micros() as f64 / 1e6
        };
        let mut hidden = 0;
        for _ in 0..2_000 {
            let height_m = between(1.5, 2.5);
            let furniture_m = between(0.2, height_m - 0.05);
            let body_m = between(0.1, height_m);
            let enter = between(0.1, 3.0);
            let leave = enter + between(0.1, 2.0);
            let range = if between(0.0, 1.0) < 0.2 { between(0.01, enter) } else { between(leave, 9.0) };
            let motion = sensor(height_m, (-90.0, 90.0));
            let shadow = motion.shadow(furniture_m, false, (enter, leave), body_m);
            let cut = (0..(range * 1000.0) as u32).any(|step| {
                let r = f64::from(step) / 1000.0;
                let sight_m = height_m + (body_m - height_m) * r / range;
                (enter..=leave).contains(&r) && sight_m < furniture_m
            });
            let edge = shadow.is_some_and(|(start, end)| (range - start).abs() < 0.02 || (range - end).abs() < 0.02);
            assert!(
                edge || cut == shadow.is_some_and(|(start, end)| range > start && range < end),
                "lens {height_m}, furniture {furniture_m} from {enter} to {leave}, body {body_m} at {range}: {shadow:?}"
            );
            hidden += u32::from(cut);
        }
        assert!(hidden > 200, "only {hidden} were hidden");
    }

    #[test]
    fn a_fan_ends_at_its_reach_and_its_sides() {
        let motion = Motion::new(&file(serde_json::json!({ "name": "m", "at": [-LENS_OFF_WALL_M, 0], "facing_deg": 0,
            "field_deg": [90, 50], "reach_m": 6 })));
        let depth = |x: f64, y: f64| motion.view(Point::new(x, y)).depth_m;
        // The sides are the diagonals.
        let off = 0.1 * 2.0_f64.sqrt();
        for (x, y) in [(5.9, 0.0), (2.0, 2.0 - off), (2.0, off - 2.0)] {
            assert!((depth(x, y) - 0.1).abs() < 1e-9, "({x}, {y}): {}", depth(x, y));
        }
        assert!(
            (depth(2.0, 2.0 + off) + 0.1).abs() < 1e-9 && (motion.view(Point::X * 3.0).distance_m - 3.0).abs() < 1e-9
        );
    }

    #[test]
    fn bearings_are_dense_in_the_middle() {
        // 72.5 * (1 / 31)^1.5 = 0.420 to either side; 72.5 * (1 - (29 / 31)^1.5) = 6.902 at the edge.
        let motion = Motion::new(&file(serde_json::json!({ "name": "m", "at": [0, 0], "facing_deg": 0 })));
        let gap_deg =
            |a: usize, b: usize| libm::acos(motion.blades[a].direction.dot(motion.blades[b].direction)).to_degrees();
        assert_eq!(motion.blades.len(), 32);
        assert!((gap_deg(15, 16) - 0.840).abs() < 5e-4);
        assert!((gap_deg(0, 1) - 6.902).abs() < 5e-4 && (gap_deg(30, 31) - 6.902).abs() < 5e-4);
        assert!((gap_deg(0, 31) - 145.0).abs() < 1e-6);
    }

    #[test]
    fn rows_of_zones_divide_the_height_and_alternate() {
        // Tilt 23 and height 50: rows from -2 over 14.667 and 31.333 to 48 degrees.
        let motion = Motion::new(&file(serde_json::json!({
            "name": "m", "at": [0, 0], "facing_deg": 0, "level": { "zones": { "rows": [3, 2, 1] } },
        })));
        let rows: [(f64, f64); 3] = [(-2.0, 44.0 / 3.0), (44.0 / 3.0, 94.0 / 3.0), (94.0 / 3.0, 48.0)];
        let row = [0, 0, 0, 1, 1, 2].map(|row| rows[row]);
        let positive = [true, false, true, false, true, true];
        let bearings_deg: [f64; 6] = [-72.5, 0.0, 72.5, -72.5, 72.5, 0.0];
        assert_eq!(motion.blades.len(), 6);
        for (index, blade) in motion.blades.iter().enumerate() {
            assert!((blade.least_depression - libm::tan(row[index].0.to_radians())).abs() < 1e-9, "blade {index}");
            assert!((blade.greatest_depression - libm::tan(row[index].1.to_radians())).abs() < 1e-9, "blade {index}");
            assert_eq!(blade.positive, positive[index], "blade {index}");
            assert!(blade.direction.distance(geometry::direction(bearings_deg[index])) < 1e-9, "blade {index}");
        }
        let DetectionLevel::Zones { pitch_rad, .. } = motion.level else { panic!("not zones") };
        assert!((pitch_rad.to_degrees() - 72.5).abs() < 1e-9);
    }
}
