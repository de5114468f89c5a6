//! Homes for the tests of this crate.

use homebody_core::geometry::point;
use homebody_core::home::form::HomeFile;
use homebody_core::plan::Plan;
use homebody_core::random::Stream;
use serde_json::{Value, json};

pub const TIGERPLACE: &str = include_str!("../../../scenarios/tigerplace/home.json");

pub fn tigerplace() -> Plan {
    plan(TIGERPLACE)
}

pub fn sphere_house() -> Plan {
    plan(include_str!("../../../scenarios/sphere-house/home.json"))
}

pub fn plan(text: &str) -> Plan {
    Plan::new(&serde_json::from_str::<HomeFile>(text).unwrap())
}

/// A rectangle with three rooms, doors of 0.8 m, some closed, some outer, and furniture anywhere.
pub fn random_home(case: u64) -> Plan {
    let stream = &mut Stream::named(case, "home");
    let (width, depth) = (stream.between(5.0, 12.0), stream.between(4.0, 9.0));
    let (x, y) = (stream.between(0.35, 0.65) * width, stream.between(0.35, 0.65) * depth);
    let room = |name, a: [f64; 2], b: [f64; 2]| json!({ "name": name, "outline": [a, [b[0], a[1]], b, [a[0], b[1]]] });
    let rooms = json!([
        room("south-west", [0.0, 0.0], [x, y]),
        room("south-east", [x, 0.0], [width, y]),
        room("north", [0.0, y], [width, depth]),
    ]);
    let mut walls = vec![
        json!({ "from": [0, 0], "to": [width, 0] }),
        json!({ "from": [width, 0], "to": [width, depth] }),
        json!({ "from": [0, depth], "to": [0, 0] }),
        json!({ "from": [x, 0], "to": [x, y], "thickness_m": stream.between(0.05, 0.3) }),
        json!({ "from": [0, y], "to": [width, y] }),
    ];
    if stream.chance(0.7) {
        walls.push(json!({ "from": [width, depth], "to": [0, depth] }));
    }
    let mut door = |name, from: [f64; 2], along: [f64; 2], most: f64| {
        let start = stream.between(0.1, most - 0.95);
        let at = |way: f64| [from[0] + along[0] * way, from[1] + along[1] * way];
        json!({ "name": name, "from": at(start), "to": at(start + 0.8), "open": stream.chance(0.8) })
    };
    let doors = json!([
        door("between", [x, 0.0], [0.0, 1.0], y),
        door("west", [0.0, y], [1.0, 0.0], x),
        door("east", [x, y], [1.0, 0.0], width - x),
        door("out", [0.0, 0.0], [1.0, 0.0], x),
    ]);
    let furniture: Vec<Value> = (0..stream.poisson(7.0))
        .map(|index| {
            let height_m = if stream.chance(0.15) { 0.02 } else { stream.between(0.3, 2.0) };
            json!({ "name": format!("piece {index}"), "height_m": height_m, "enterable": stream.chance(0.4),
                "at": [stream.between(0.4, width - 0.4), stream.between(0.4, depth - 0.4)],
                "size_m": [stream.between(0.2, 1.8), stream.between(0.2, 1.0)], "turn_deg": stream.between(-90.0, 90.0) })
        })
        .collect();
    let home = json!({ "name": "home", "rooms": rooms, "walls": walls, "doors": doors, "furniture": furniture });
    plan(&home.to_string())
}

/// Walls and furniture cross at all angles, many nearly in line or nearly touching.
pub fn tangled_home(case: u64, walls: usize, pieces: usize) -> String {
    let stream = &mut Stream::named(case, "tangle");
    let size = [4.0, 8.0, 15.0, 40.0, 95.0][stream.between(0.0, 5.0) as usize];
    let round = |value: f64| (value * 1e3).round() / 1e3;
    let mut drawn: Vec<[[f64; 2]; 2]> = Vec::new();
    while drawn.len() < walls {
        let mut anywhere = || [round(stream.between(0.0, size)), round(stream.between(0.0, size))];
        let (from, to) = (anywhere(), anywhere());
        let known = drawn.get(stream.between(0.0, drawn.len().max(1) as f64) as usize).copied().unwrap_or([from, to]);
        let mut near = |at: [f64; 2]| at.map(|part| round((part + stream.between(-0.004, 0.004)).clamp(0.0, size)));
        let wall = match drawn.len() % 8 {
            0 => [near(known[0]), near(known[1])],
            1 => [near(known[1]), to],
            2 => [from, [from[0], to[1]]],
            3 => [from, [to[0], from[1]]],
            4 => [known[0], known[1]],
            _ => [from, to],
        };
        if point(wall[0]).distance(point(wall[1])) > 0.002 {
            drawn.push(wall);
        }
    }
    let walls: Vec<Value> = drawn
        .iter()
        .map(|[from, to]| json!({ "from": from, "to": to, "thickness_m": round(stream.between(0.001, 0.2)) }))
        .collect();
    let furniture: Vec<Value> = (0..pieces)
        .map(|index| {
            json!({ "name": format!("piece {index}"), "height_m": 0.5, "enterable": stream.chance(0.4),
                "at": [round(stream.between(0.2, 0.8) * size), round(stream.between(0.2, 0.8) * size)],
                "size_m": [round(stream.between(0.1, 0.2) * size), round(stream.between(0.1, 0.2) * size)],
                "turn_deg": stream.between(-90.0, 90.0).round() })
        })
        .collect();
    let room = json!({ "name": "room", "outline": [[0, 0], [size, 0], [size, size], [0, size]] });
    json!({ "name": "home", "rooms": [room], "walls": walls, "furniture": furniture }).to_string()
}
