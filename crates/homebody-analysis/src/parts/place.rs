//! Places and directions in the words of who puts sensors up.

use homebody_core::geometry::{self, Point};
use homebody_core::plan::{Origin, Plan};
use std::cmp::Ordering;

/// Distance from a wall within which a sensor hangs on it, in metres (our choice).
const ON_WALL_M: f64 = 0.12;
/// Length below which a side of a room is not used to measure from, in metres (our choice).
const SHORTEST_M: f64 = 0.3;
/// Angle within which a sensor looks straight out, in degrees (our choice).
const STRAIGHT_DEG: f64 = 3.0;

struct FacingWall {
    towards: Point,
    distance_m: f64,
}

impl FacingWall {
    fn name(&self) -> &'static str {
        geometry::compass(self.towards)
    }

    fn words(&self) -> String {
        format!("{:.2} m from the {} wall", self.distance_m, self.name())
    }
}

/// The distances of a place from the two nearest walls that are not side by side; empty outside rooms.
pub fn from_walls(plan: &Plan, at: Point) -> String {
    match &two_walls(plan, at)[..] {
        [one, other] => format!("{} and {}", one.words(), other.words()),
        [one] => one.words(),
        _ => "between rooms".into(),
    }
}

pub fn on_wall(plan: &Plan, at: Point) -> String {
    match &two_walls(plan, at)[..] {
        [one, other] if one.distance_m <= ON_WALL_M && other.distance_m <= ON_WALL_M => {
            format!("in the corner of the {} and the {} wall", one.name(), other.name())
        }
        [one, other] if one.distance_m <= ON_WALL_M => format!("on the {} wall, {}", one.name(), other.words()),
        [one] if one.distance_m <= ON_WALL_M => format!("on the {} wall", one.name()),
        _ => from_walls(plan, at),
    }
}

/// The direction of a lens: by the compass, and from its wall.
pub fn looks(plan: &Plan, at: Point, facing_deg: f64) -> String {
    let ahead = geometry::direction(facing_deg);
    let compass = geometry::compass(ahead);
    let Some(wall) = two_walls(plan, at).into_iter().next().filter(|wall| wall.distance_m <= ON_WALL_M) else {
        return compass.into();
    };
    let out = -wall.towards;
    let aside_deg = out.perp_dot(ahead).atan2(out.dot(ahead)).to_degrees();
    match aside_deg {
        aside if aside.abs() <= STRAIGHT_DEG => format!("{compass}, straight out from the wall"),
        aside if aside > 0.0 => format!("{compass}, {aside:.0}° to the left of straight out"),
        aside => format!("{compass}, {:.0}° to the right of straight out", -aside),
    }
}

/// The nearest wall, and the nearest of those that stand across it.
fn two_walls(plan: &Plan, at: Point) -> Vec<FacingWall> {
    let Some(room) = plan.room_at(at) else { return Vec::new() };
    let outline = &plan.rooms[room].outline;
    let inward = if geometry::signed_area(outline) > 0.0 { 1.0 } else { -1.0 };
    let opposite = geometry::sides(outline).filter_map(|(a, b)| {
        let along = (b - a).normalize_or_zero();
        let foot = (at - a).dot(along);
        let length = a.distance(b);
        if length < SHORTEST_M || !(-0.01..=length + 0.01).contains(&foot) {
            return None;
        }
        let towards = -along.perp() * inward;
        let border = (a - at).dot(towards);
        (border >= 0.0).then(|| FacingWall { towards, distance_m: face(plan, at, towards, border) })
    });
    let mut walls: Vec<FacingWall> = opposite.collect();
    let nearer = |a: &FacingWall, b: &FacingWall| a.distance_m.partial_cmp(&b.distance_m).unwrap_or(Ordering::Equal);
    walls.sort_by(nearer);
    let mut walls = walls.into_iter();
    let Some(nearest) = walls.next() else { return Vec::new() };
    let across = walls.find(|wall| wall.towards.dot(nearest.towards).abs() < 0.7);
    [Some(nearest), across].into_iter().flatten().collect()
}

/// The distance of the face of a wall, or of the border of the room without a wall near it.
fn face(plan: &Plan, at: Point, towards: Point, border: f64) -> f64 {
    /// Largest distance of a wall from the border of its room, in metres (our choice): walls may be this thick.
    const NEAR_BORDER_M: f64 = 0.35;
    let far = at + towards * (border + NEAR_BORDER_M);
    let walls = plan.solids.iter().filter(|solid| matches!(solid.origin, Origin::Wall(_) | Origin::Door(_)));
    let hits = walls.flat_map(|solid| geometry::sides(&solid.outline)).filter_map(|(a, b)| {
        let (way, side) = (far - at, b - a);
        let turn = way.perp_dot(side);
        let (along, across) = ((a - at).perp_dot(side) / turn, (a - at).perp_dot(way) / turn);
        let is_hit = turn != 0.0 && (0.0..=1.0).contains(&along) && (0.0..=1.0).contains(&across);
        is_hit.then(|| along * way.length())
    });
    let near = hits.filter(|distance| *distance >= border - NEAR_BORDER_M);
    near.min_by(f64::total_cmp).unwrap_or(border)
}
