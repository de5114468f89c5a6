//! A home for drawing and measuring: two rooms with a door between them, furniture and three sensors.

use homebody_core::geometry::{Point, direction, point};
use homebody_core::home::form::HomeFile;
use homebody_core::ids::SensorId;
use homebody_core::plan::Plan;
use homebody_core::sensor_set::SensorSet;
use homebody_core::sensors::kinds::SensorFile;
use serde_json::{Value, json};

/// The home, with the given furniture and sensors.
pub fn two_rooms(furniture: Value, sensors: Value) -> HomeFile {
    let home = json!({
        "name": "Two rooms & a <door>",
        "rooms": [
            { "name": "living room", "outline": [[0, 0], [5, 0], [5, 4], [0, 4]] },
            { "name": "bedroom", "outline": [[5, 0], [8, 0], [8, 4], [5, 4]] }
        ],
        "walls": [
            { "from": [0, 0], "to": [8, 0] },
            { "from": [8, 0], "to": [8, 4] },
            { "from": [8, 4], "to": [0, 4] },
            { "from": [0, 4], "to": [0, 0] },
            { "from": [5, 0], "to": [5, 4] }
        ],
        "doors": [
            { "name": "bedroom door", "from": [5, 1.5], "to": [5, 2.4] },
            { "name": "front door", "from": [1, 0], "to": [1.9, 0], "open": false, "outside": true }
        ],
        "furniture": furniture,
        "sensors": sensors
    });
    serde_json::from_value(home).expect("a home")
}

#[allow(dead_code, reason = "each test that shares this file uses a part of it")]
pub fn furnished() -> HomeFile {
    two_rooms(
        json!([
            { "name": "bed", "at": [7.2, 3.0], "size_m": [1.4, 1.8], "height_m": 0.6, "enterable": true },
            { "name": "table", "at": [2.5, 2.6], "size_m": [1.4, 0.8], "turn_deg": 20, "height_m": 0.75 },
            { "name": "tall cupboard", "at": [4.7, 3.4], "size_m": [0.4, 1.0], "height_m": 2.0 }
        ]),
        json!([
            { "kind": "motion", "name": "living room motion", "at": [0.06, 3.94], "facing_deg": -45, "reach_m": 5 },
            { "kind": "motion", "name": "bedroom motion", "at": [7.94, 0.06], "facing_deg": 135, "reach_m": 4 },
            { "kind": "ceiling_motion", "name": "bed \"ceiling\" <1>", "area": [[6.4, 2], [7.9, 2], [7.9, 3.9], [6.4, 3.9]] }
        ]),
    )
}

/// A made-up way to see: wall sensors see a fan up to their reach unless something tall stands between,
/// ceiling sensors see their areas.
#[allow(dead_code, reason = "each test that shares this file uses a part of it")]
pub fn sees(home: &HomeFile, plan: &Plan, p: Point) -> SensorSet {
    let seen = home.sensors.iter().enumerate().filter(|(_, sensor)| match sensor {
        SensorFile::Motion(motion) => {
            let lens = point(motion.at);
            let ahead = (p - lens).normalize_or_zero().dot(direction(motion.facing_deg));
            let in_fan = ahead >= direction(motion.field_deg[0] / 2.0).x && p.distance(lens) <= motion.reach_m;
            in_fan && beam_end(plan, lens + (p - lens) * 0.001, p) == p
        }
        SensorFile::CeilingMotion(ceiling) => {
            let area: Vec<Point> = ceiling.area.iter().map(|&at| point(at)).collect();
            homebody_core::geometry::contains(&area, p)
        }
        _ => false,
    });
    seen.map(|(index, _)| SensorId::new(index)).collect()
}

/// The end of a beam from `a` to `b` at something tall.
#[allow(dead_code, reason = "each test that shares this file uses a part of it")]
pub fn beam_end(plan: &Plan, a: Point, b: Point) -> Point {
    let tall = plan.solids.iter().filter(|solid| solid.height_m > 1.0);
    let hits = tall.filter_map(|solid| homebody_core::geometry::segment_inside_convex(&solid.outline, a, b));
    let first = hits.map(|(enter, _)| enter).fold(f64::INFINITY, f64::min);
    if first <= 1.0 { a + (b - a) * first } else { b }
}
