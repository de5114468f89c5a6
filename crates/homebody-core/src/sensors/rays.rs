//! Baking: what each sensor sees of a body of one height, clipped by walls, doors and furniture.

use crate::geometry::{self, Point};
use crate::plan::{Plan, Solid};
use crate::sensors::Sensor;
use crate::sensors::kinds::SensorKind;
use crate::sensors::motion::Motion;
use crate::stride::Beam;
use parry2d::math::Vector;
use parry2d::query::{Ray, RayCast};
use parry2d::shape::Segment;

/// The beams of a sensor on bodies of this height, in the order of the sensor's own blades.
pub fn beams(sensor: &Sensor, plan: &Plan, body_m: f64) -> Vec<Beam> {
    match &sensor.kind {
        SensorKind::Motion(motion) => blades(motion, plan, body_m),
        SensorKind::CeilingMotion(area) => area.beams(),
        SensorKind::Device(_) => Vec::new(),
    }
}

fn blades(motion: &Motion, plan: &Plan, body_m: f64) -> Vec<Beam> {
    let (tall, low): (Vec<&Solid>, Vec<&Solid>) =
        plan.solids.iter().partition(|solid| solid.height_m >= motion.height_m);
    let reached = |&(a, b): &(Point, Point)| {
        geometry::distance_to_segment(motion.lens, a, b) <= motion.reach_m + ENGINE_TOLERANCE_M
    };
    let walls: Vec<Segment> = tall
        .iter()
        .flat_map(|solid| geometry::sides(&solid.outline))
        .filter(reached)
        .map(|(a, b)| Segment::new(vector(a), vector(b)))
        .collect();
    let mut beams = Vec::new();
    for (number, blade) in motion.blades.iter().enumerate() {
        let Some((near, far)) = motion.ranges(blade, body_m) else { continue };
        let far = far.min(cast(&walls, motion.lens, blade.direction, far));
        let mut shadows: Vec<(f64, f64)> = low
            .iter()
            .filter_map(|solid| {
                let end = motion.lens + blade.direction * motion.reach_m;
                let (enter, leave) = geometry::segment_inside_convex(&solid.outline, motion.lens, end)?;
                let span = (enter * motion.reach_m, leave * motion.reach_m);
                motion.shadow(solid.height_m, !solid.stops_bodies, span, body_m)
            })
            .collect();
        shadows.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut start = near;
        for (dark, light) in shadows.into_iter().chain([(far, far)]) {
            let end = dark.min(far);
            if end > start {
                beams.push(Beam {
                    start: motion.lens + blade.direction * start,
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

/// Bound of the error of the physics engine, which computes in single precision.
const ENGINE_TOLERANCE_M: f64 = 0.01;

/// The length of a ray of the physics engine from `from` up to the first wall, at most `reach`.
fn cast(walls: &[Segment], from: Point, direction: Point, reach: f64) -> f64 {
    let ray = Ray::new(vector(from), vector(direction));
    let hits = walls.iter().filter_map(|wall| wall.cast_local_ray(&ray, reach as f32, true));
    hits.fold(reach, |nearest, hit| nearest.min(f64::from(hit)))
}

/// A point as the physics engine's.
pub fn vector(p: Point) -> Vector {
    Vector::new(p.x as f32, p.y as f32)
}
