//! Points to stand, sit or lie at the things of a home.

use homebody_core::geometry::{self, Point};
use homebody_core::plan::Plan;
use homebody_core::posture::Posture;

/// A point in a room half a metre or so from a door; farther in a thick wall.
pub fn just_inside(plan: &Plan, door: Point) -> Point {
    /// Distances from it at which places are tried, in metres (our choice).
    const FROM_DOOR_M: [f64; 4] = [0.5, 0.75, 1.0, 1.25];
    let around =
        |from_door_m: f64| (0..16).map(move |part| door + geometry::direction(f64::from(part) * 22.5) * from_door_m);
    let is_free = |at: &Point| plan.room_at(*at).is_some() && plan.is_walkable(*at, 0.25);
    let nearest = FROM_DOOR_M.into_iter().find(|&from_door_m| around(from_door_m).any(|at| is_free(&at)));
    let free = nearest.into_iter().flat_map(around).filter(is_free);
    // The farther from walls, the better: straight ahead.
    let room = |at: &Point| {
        let solids = plan.solids.iter().filter(|solid| solid.stops_bodies);
        solids.map(|solid| geometry::distance_to_area(&solid.outline, *at)).fold(f64::INFINITY, f64::min)
    };
    free.max_by(|a, b| room(a).total_cmp(&room(b))).unwrap_or(door)
}

/// Points in a room whose middle is blocked, such as by a kitchen island; the nearest to the middle first.
pub fn around_in_room(plan: &Plan, room: usize, middle: Point) -> Vec<Point> {
    /// Number of parts of a side of the room (our choice).
    const STEPS: u32 = 20;
    /// Room that a body needs, in metres (our choice).
    const BODY_M: f64 = 0.25;
    let (least, most) = geometry::bounds(plan.rooms[room].outline.iter().copied());
    let steps = (1..STEPS).flat_map(|x| (1..STEPS).map(move |y| Point::new(f64::from(x), f64::from(y))));
    let places = steps.map(|step| least + (most - least) * step / f64::from(STEPS));
    let mut free: Vec<Point> =
        places.filter(|&at| plan.room_at(at) == Some(room) && plan.is_walkable(at, BODY_M)).collect();
    free.sort_by(|a, b| a.distance(middle).total_cmp(&b.distance(middle)));
    free
}

/// Points before the middles of the sides of furniture with enough room, the nearest to its middle first.
pub fn beside(plan: &Plan, outline: &[Point]) -> Vec<Point> {
    /// Distance from its edge, in metres (our choice): a body and a hand's breadth.
    const OFF_M: f64 = 0.32;
    let middle = geometry::inner_point(outline);
    let side = |(a, b): (Point, Point)| {
        let off = (b - a).normalize_or_zero().perp() * -OFF_M;
        (a + b) / 2.0 + off
    };
    let free = geometry::sides(outline).map(side).filter(|&at| plan.is_walkable(at, OFF_M - 0.05));
    let mut free: Vec<Point> = free.collect();
    free.sort_by(|a, b| a.distance(middle).total_cmp(&b.distance(middle)));
    free.extend(reaching(plan, outline));
    free
}

/// Points for a person who reaches over from the edge, with no room to spare, as in small bathrooms.
fn reaching(plan: &Plan, outline: &[Point]) -> Vec<Point> {
    /// Distances from the edge, and room for a body, in metres (our choice): an arm's length at most.
    const OFF_M: [f64; 3] = [0.32, 0.45, 0.6];
    const BODY_M: f64 = 0.23;
    /// As a share of the side.
    const ALONG: [f64; 3] = [0.5, 0.25, 0.75];
    let spots = OFF_M.into_iter().flat_map(|off_m| {
        geometry::sides(outline).flat_map(move |(a, b)| {
            let off = (b - a).normalize_or_zero().perp() * -off_m;
            ALONG.map(|share| a + (b - a) * share + off)
        })
    });
    spots.filter(|&at| plan.is_walkable(at, BODY_M)).collect()
}

/// Places side by side in a bed or on a sofa; empty for one person.
pub fn sides_of(outline: &[Point], posture: Posture) -> Vec<Point> {
    /// Width below which a bed is for one person, and width that a sitting person takes on a sofa (our choice).
    const BED_M: f64 = 1.1;
    const SEAT_M: f64 = 0.6;
    let Some((a, b)) = geometry::sides(outline).max_by(|(a, b), (c, d)| a.distance(*b).total_cmp(&c.distance(*d)))
    else {
        return Vec::new();
    };
    let along = (b - a).normalize_or_zero();
    let across = along.perp();
    let middle = geometry::inner_point(outline);
    let extent = |direction: Point| {
        let shares = outline.iter().map(|corner| (*corner - middle).dot(direction));
        shares.fold((0.0, 0.0), |(least, most): (f64, f64), share| (least.min(share), most.max(share)))
    };
    let direction = if posture == Posture::Lying { across } else { along };
    let (least, most) = extent(direction);
    let count = match posture {
        Posture::Lying => {
            if most - least < BED_M {
                1
            } else {
                2
            }
        }
        _ => ((most - least) / SEAT_M) as usize,
    };
    let place = |index| middle + direction * (least + (most - least) * (index as f64 + 0.5) / count as f64);
    if count < 2 { Vec::new() } else { (0..count).map(place).collect() }
}
