//! The detection of the paper: on each update every sensor casts its rays, the physics engine returns their lengths,
//! and a changed length is movement (Godsey & Skubic 2009, section III.D).
//!
//! We assume the paper's plane. Rays start at the beginning of a beam for bodies of one size. Their only rule about
//! heights is that solids lower than the home's highest lens stop no ray. A ceiling sensor sees a body that has changed
//! and intersects its area.
//!
//! rapier2d holds walls, doors and furniture as fixed colliders and bodies as kinematic balls, is stepped once an
//! update, and casts each ray against all of them. Rays are not solid: from inside a body they run to its far side.
//!
//! Left out: shadows of furniture lower than the lens; the paper has none.

use crate::{Eye, Pose};
use homebody_core::geometry::Point;
use homebody_core::home::Home;
use homebody_core::plan::Solid;
use homebody_core::resident::BodySize;
use homebody_core::sensors::Sensor;
use homebody_core::sensors::rays::vector;
use rapier2d::parry::query;
use rapier2d::parry::shape::{Ball, ConvexPolygon};
use rapier2d::prelude::*;

pub struct PaperEye {
    physics: PhysicsWorld,
    bodies: Vec<(RigidBodyHandle, ColliderHandle)>,
    last: Vec<Pose>,
    sensors: Vec<Seeing>,
}

enum Seeing {
    Rays(Vec<SensorRay>, QueryFilter<'static>),
    Area(ConvexPolygon),
}

struct SensorRay {
    ray: Ray,
    reach: f32,
    length: f32,
}

/// Membership of the solids that stop every ray, and of those lower than some lens.
const TALL: Group = Group::GROUP_1;
const LOW: Group = Group::GROUP_2;

impl PaperEye {
    pub fn new(home: &Home, size: BodySize, bodies: usize) -> PaperEye {
        let mut physics = PhysicsWorld { gravity: Vector::ZERO, ..PhysicsWorld::default() };
        physics.integration_parameters.dt = 1.0 / 60.0;
        let lens = |sensor: &Sensor| sensor.kind.fan().map_or(0.0, |fan| fan.height_m);
        let highest = home.sensors.iter().map(lens).fold(0.0, f64::max);
        for solid in &home.plan.solids {
            let group = if solid.height_m >= highest { TALL } else { LOW };
            if let Some(collider) = collider(solid) {
                physics.insert_collider(collider.collision_groups(groups(group)), None);
            }
        }
        physics.step();
        let sensors = home.sensors.iter().map(|sensor| seeing(sensor, size, &physics)).collect();
        let far = Point::splat(1e6);
        let bodies = (0..bodies)
            .map(|_| {
                let body = RigidBodyBuilder::kinematic_position_based().translation(vector(far));
                let ball = ColliderBuilder::ball(size.radius_m as f32).collision_groups(groups(TALL));
                physics.insert(body, ball)
            })
            .collect();
        PaperEye { physics, bodies, last: Vec::new(), sensors }
    }
}

impl Eye for PaperEye {
    fn look(&mut self, bodies: &[Pose], changed: &mut [bool]) {
        for (pose, &(body, ball)) in bodies.iter().zip(&self.bodies) {
            self.physics.bodies[body].set_next_kinematic_translation(vector(pose.at));
            let shape = SharedShape::ball(pose.radius_m as f32);
            if self.physics.colliders[ball].shape().as_ball() != shape.as_ball() {
                self.physics.colliders[ball].set_shape(shape);
            }
        }
        self.physics.step();
        for (sensor, changed) in self.sensors.iter_mut().zip(changed) {
            *changed = match sensor {
                Seeing::Rays(rays, filter) => {
                    let query = self.physics.query_pipeline_with_filter(*filter);
                    let mut any = false;
                    for SensorRay { ray, reach, length } in rays {
                        let new = query.cast_ray(ray, *reach, false).map_or(*reach, |(_, hit)| hit);
                        any |= new != *length;
                        *length = new;
                    }
                    any
                }
                Seeing::Area(area) => bodies.iter().enumerate().any(|(index, pose)| {
                    // A stirring body counts with its larger size at either look.
                    let radius = |last: &Pose| last.radius_m.max(pose.radius_m);
                    let change = self.last.get(index).filter(|last| *last != pose);
                    change.is_some_and(|last| intersects(area, pose.at, radius(last)))
                }),
            };
        }
        self.last.clear();
        self.last.extend_from_slice(bodies);
    }
}

fn groups(member: Group) -> InteractionGroups {
    InteractionGroups::new(member, Group::ALL, InteractionTestMode::And)
}

fn seeing(sensor: &Sensor, size: BodySize, walls: &PhysicsWorld) -> Seeing {
    if let Some(area) = sensor.kind.area_below() {
        let corners = area.iter().map(|&corner| vector(corner)).collect();
        return Seeing::Area(ConvexPolygon::from_convex_polyline_unmodified(corners).expect("an area with corners"));
    }
    let Some(fan) = sensor.kind.fan() else { return Seeing::Rays(Vec::new(), QueryFilter::default()) };
    let tall = QueryFilter::default().groups(InteractionGroups::new(Group::ALL, TALL, InteractionTestMode::And));
    let rays = fan.blades.iter().filter_map(|blade| {
        let (near, far) = fan.ranges(blade, size.top_m)?;
        // Closer to the lens, the beam passes over bodies, but not over walls.
        let from_lens = Ray::new(vector(fan.lens), vector(blade.direction));
        if walls.cast_ray(&from_lens, near as f32, false, tall).is_some() {
            return None;
        }
        let ray = Ray::new(vector(fan.lens + blade.direction * near), vector(blade.direction));
        Some(SensorRay { ray, reach: (far - near) as f32, length: 0.0 })
    });
    Seeing::Rays(rays.collect(), tall)
}

/// A rectangle becomes a cuboid, which is fastest for rays.
fn collider(solid: &Solid) -> Option<ColliderBuilder> {
    let [a, b, c, d] = solid.outline[..] else {
        return ColliderBuilder::convex_hull(&solid.outline.iter().map(|&p| vector(p)).collect::<Vec<_>>());
    };
    let (x, y) = (b - a, d - a);
    if x.dot(y).abs() > 1e-9 || (a + c).distance(b + d) > 1e-9 {
        return ColliderBuilder::convex_hull(&[a, b, c, d].map(vector));
    }
    let cuboid = ColliderBuilder::cuboid((x.length() / 2.0) as f32, (y.length() / 2.0) as f32);
    Some(cuboid.translation(vector((a + c) / 2.0)).rotation(libm::atan2(x.y, x.x) as f32))
}

fn intersects(area: &ConvexPolygon, at: Point, radius_m: f64) -> bool {
    let place = Pose2::from_translation(vector(at));
    let ball = Ball::new(radius_m as f32);
    query::intersection_test(&Pose2::IDENTITY, area, &place, &ball).is_ok_and(|test| test.intersecting)
}
