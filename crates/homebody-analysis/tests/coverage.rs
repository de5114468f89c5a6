//! Coverage measured against homes whose coverage is known.

use crate::home;
use homebody_analysis::coverage::{Coverage, CoverageGrid, LEAST_DEAD_ZONE_M2, STEP_M, coverage};
use homebody_core::geometry::{Point, point, signed_area};
use homebody_core::home::form::HomeFile;
use homebody_core::ids::SensorId;
use homebody_core::plan::Plan;
use homebody_core::sensor_set::SensorSet;
use serde_json::json;

const RADIUS_M: f64 = 0.2;

/// One room of this width and depth between the middle lines of its walls, which are 0.1 m thick.
fn one_room(width: f64, depth: f64) -> Plan {
    let corners = [[0.0, 0.0], [width, 0.0], [width, depth], [0.0, depth]];
    let walls: Vec<_> = (0..4).map(|i| json!({ "from": corners[i], "to": corners[(i + 1) % 4] })).collect();
    let home = json!({ "name": "box", "rooms": [{ "name": "box", "outline": corners }], "walls": walls });
    let home: HomeFile = serde_json::from_value(home).expect("a home");
    Plan::new(&home)
}

fn measured(plan: &Plan, sensors: usize, sees: &dyn Fn(Point) -> SensorSet) -> Coverage {
    let names: Vec<String> = (0..sensors).map(|sensor| format!("sensor {sensor}")).collect();
    coverage(plan, RADIUS_M, &names, STEP_M, sees)
}

/// The numbers of the sensors that see it.
fn seeing<const N: usize>(sensors: [bool; N]) -> SensorSet {
    (0..).map(SensorId).zip(sensors).filter(|&(_, sees)| sees).map(|(sensor, _)| sensor).collect()
}

#[test]
fn the_floor_of_a_rectangle_is_within_the_stated_error() {
    for (width, depth) in [(4.0, 3.0), (3.37, 2.41), (5.019, 1.333), (0.71, 2.0), (6.66, 4.321)] {
        let plan = one_room(width, depth);
        let truth = (width - 0.1 - 2.0 * RADIUS_M) * (depth - 0.1 - 2.0 * RADIUS_M);
        for step_m in [0.02, 0.05, 0.13] {
            let whole = coverage(&plan, RADIUS_M, &[], step_m, &|_| seeing([])).whole;
            let off = (whole.floor_m2 - truth).abs();
            assert!(off <= whole.floor_error_m2, "{width} x {depth} in {step_m}: {off} > {}", whole.floor_error_m2);
            assert!(whole.floor_error_m2 < 20.0 * step_m, "an error that says something");
        }
    }
}

#[test]
fn shares_are_those_of_the_areas_seen() {
    // The floor is 0.25..4.25 by 0.25..3.25: 12 m2.
    let plan = one_room(4.5, 3.5);
    let west = |p: Point| p.x < 1.25;
    let south = |p: Point| p.y < 1.75;
    let corner = |p: Point| p.x < 1.25 && p.y < 1.25;
    let seen = measured(&plan, 3, &|p| seeing([west(p), south(p), corner(p)]));
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-9, "{a} is not {b}");
    close(seen.whole.floor_m2, 12.0);
    close(seen.whole.seen_by.none, 4.5 / 12.0);
    close(seen.whole.seen_by.one, 6.0 / 12.0);
    close(seen.whole.seen_by.two, 0.5 / 12.0);
    close(seen.whole.seen_by.three_or_more, 1.0 / 12.0);
    close(seen.sensors[0].seen_m2, 3.0);
    close(seen.sensors[0].alone_m2, 1.5);
    close(seen.sensors[1].alone_m2, 4.5);
    close(seen.sensors[2].alone_m2, 0.0);
    let shared: Vec<_> = seen.overlaps.iter().map(|overlap| (overlap.sensors.clone(), overlap.shared_m2)).collect();
    assert_eq!(shared.len(), 3);
    assert_eq!(shared[0].0, ["sensor 0", "sensor 1"]);
    close(shared[0].1, 1.5);
    assert_eq!(seen.dead_zones.len(), 1);
    assert_eq!(seen.dead_zones[0].room.as_deref(), Some("box"));
    let corners: Vec<Point> = seen.dead_zones[0].outline.iter().map(|&at| point(at)).collect();
    assert_eq!(corners.len(), 4);
    for corner in [[1.25, 1.75], [4.25, 1.75], [4.25, 3.25], [1.25, 3.25]] {
        assert!(corners.contains(&point(corner)), "{corner:?} is no corner of {corners:?}");
    }
}

#[test]
fn rooms_add_up_to_the_whole() {
    let file = home::furnished();
    let plan = Plan::new(&file);
    let seen = measured(&plan, 3, &|p| home::sees(&file, &plan, p));
    let parts: f64 = seen.rooms.iter().chain(&seen.doorways).map(|floor| floor.floor_m2).sum();
    assert!((parts - seen.whole.floor_m2).abs() < 1e-9);
    for floor in seen.floors() {
        let by = floor.seen_by;
        assert!((by.none + by.one + by.two + by.three_or_more - 1.0).abs() < 1e-9);
    }
}

#[test]
fn dead_zones_add_up_to_the_unseen_floor() {
    let file = home::furnished();
    let plan = Plan::new(&file);
    let seen = measured(&plan, 3, &|p| home::sees(&file, &plan, p));
    let unseen = seen.whole.seen_by.none * seen.whole.floor_m2;
    let listed: f64 = seen.dead_zones.iter().map(|zone| zone.area_m2).sum();
    assert!(seen.dead_zones.len() >= 2 && listed > 0.5);
    assert!(listed <= unseen + 1e-9 && unseen - listed < LEAST_DEAD_ZONE_M2, "{listed} of {unseen}");
    for zone in &seen.dead_zones {
        let area = |ring: &Vec<[f64; 2]>| signed_area(&ring.iter().map(|&at| point(at)).collect::<Vec<_>>());
        let polygon = area(&zone.outline) + zone.holes.iter().map(area).sum::<f64>();
        assert!((polygon - zone.area_m2).abs() < 1e-9, "the polygon of zone {} has its area", zone.number);
    }
    assert!(seen.dead_zones.is_sorted_by(|a, b| a.area_m2 >= b.area_m2));
}

#[test]
fn an_island_that_is_seen_is_a_hole_in_the_dead_zone() {
    let plan = one_room(4.5, 3.5);
    let seen = measured(&plan, 1, &|p| seeing([p.distance(Point::new(2.25, 1.75)) < 0.8]));
    let [zone] = &seen.dead_zones[..] else { panic!("one dead zone around the island") };
    assert_eq!((zone.outline.len(), zone.holes.len()), (4, 1));
    assert!((zone.area_m2 - (12.0 - std::f64::consts::PI * 0.64)).abs() < zone.area_error_m2);
    let middle = point(zone.middle);
    assert!(middle.distance(Point::new(2.25, 1.75)) > 0.8, "the label lies in the zone, not in its hole");
}

#[test]
fn small_dead_zones_count_but_are_not_listed() {
    let plan = one_room(4.5, 3.5);
    let seen = measured(&plan, 1, &|p| seeing([(p - Point::new(2.0, 2.0)).abs().max_element() > 0.05]));
    assert!(seen.dead_zones.is_empty());
    assert!(seen.whole.seen_by.none > 0.0);
}

#[test]
fn rings_touch_but_never_cross() {
    // Holes that touch the outside and each other at corners.
    let rows = ["#########", "#.#.#.#.#", "##.###.##", "#.#.#####", "#####.#.#", "###.##.##", ".########"];
    let bounds = (Point::ZERO, Point::new(9.0, 7.0));
    let grid = CoverageGrid::sample(bounds, 1.0, |p| {
        let cell = rows[6 - p.y as usize].as_bytes()[p.x as usize];
        (cell == b'#').then(SensorSet::default)
    });
    let mut cells = 0;
    for region in grid.regions(|cell| grid.cells[cell].is_some()) {
        cells += region.cells.len();
        let mut area = 0.0;
        for (index, ring) in region.rings.iter().enumerate() {
            let mut once = ring.clone();
            once.sort_unstable();
            once.dedup();
            assert_eq!(once.len(), ring.len(), "a ring touches itself");
            let ring: Vec<Point> = ring.iter().map(|&corner| grid.corner(corner)).collect();
            assert_eq!(signed_area(&ring) > 0.0, index == 0, "the first ring goes around the others");
            area += signed_area(&ring);
        }
        assert_eq!(area, region.cells.len() as f64);
    }
    assert_eq!(cells, rows.concat().matches('#').count());
}

#[test]
fn a_home_without_sensors_is_one_dead_zone() {
    let seen = measured(&one_room(4.5, 3.5), 0, &|_| seeing([]));
    assert_eq!(seen.whole.seen_by.none, 1.0);
    assert_eq!(seen.dead_zones.len(), 1);
}

#[test]
fn a_home_too_narrow_to_stand_in_has_no_floor() {
    let seen = measured(&one_room(0.4, 0.4), 1, &|_| seeing([true]));
    assert_eq!(seen.whole.floor_m2, 0.0);
    assert_eq!(seen.whole.seen_by.none, 0.0);
    assert!(seen.to_string().contains("No dead zone"));
}

#[test]
fn the_table_says_what_the_json_says() {
    let file = home::furnished();
    let plan = Plan::new(&file);
    let seen = measured(&plan, 3, &|p| home::sees(&file, &plan, p));
    let table = seen.to_string();
    let json = serde_json::to_value(&seen).expect("json");
    assert!(table.contains(&format!("{:.2}", json["whole"]["floor_m2"].as_f64().expect("a number"))));
    for zone in json["dead_zones"].as_array().expect("a list") {
        assert!(table.contains(&format!("{:.2}", zone["area_m2"].as_f64().expect("a number"))), "{table}");
    }
    assert!(json.get("grid").is_none());
}
