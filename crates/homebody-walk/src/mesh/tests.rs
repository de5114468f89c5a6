use super::*;
use crate::homes::{TIGERPLACE, plan, random_home, sphere_house, tangled_home, tigerplace};
use serde_json::json;

const RADIUS_M: f64 = 0.22;

/// The smallest distance of a path from obstacles, without a first and last step off free ground; and whether it stays in
/// the home.
fn clearance(mesh: &Mesh, from: Point, path: &[Point]) -> (f64, bool) {
    let mut stops = vec![from];
    stops.extend(path);
    let legs: Vec<(Point, Point)> = stops.windows(2).map(|pair| (pair[0], pair[1])).collect();
    let is_open = |end: Option<&Point>| end.is_none_or(|&end| mesh.is_free(end));
    let first = usize::from(!is_open(stops.first()));
    let count = legs.len().saturating_sub(first + usize::from(!is_open(stops.last())));
    let inner = legs.iter().skip(first).take(count);
    let outlines = || mesh.obstacles.iter().map(|obstacle| &obstacle.outline);
    let distances = inner.flat_map(|&(a, b)| outlines().map(move |outline| distance_in_segment(outline, a, b)));
    let steps =
        |(a, b): &(Point, Point)| (0..=20).map(|step| *a + (*b - *a) * (f64::from(step) / 20.0)).collect::<Vec<_>>();
    let is_inside = legs.iter().flat_map(steps).all(|p| mesh.plan.is_inside(p));
    (distances.fold(f64::INFINITY, f64::min), is_inside)
}

/// No step crosses an obstacle.
fn hits_nothing(mesh: &Mesh, from: Point, path: &[Point]) -> bool {
    let mut stops = vec![from];
    stops.extend(path);
    stops.windows(2).all(|pair| !mesh.blocks(pair[0], pair[1], |obstacle| !obstacle.is_seat))
}

#[test]
fn every_two_places_of_a_home_are_connected() {
    for plan in [tigerplace(), sphere_house()] {
        let mesh = Mesh::new(&plan, RADIUS_M);
        // The middle of the landing's outline is in a wall, where no body fits.
        let places = || plan.places.iter().filter(|(name, _)| name != "stairs");
        let mut corners = 0;
        for ((name, from), (other, to)) in places().flat_map(|from| places().map(move |to| (from, to))) {
            let path = mesh.path(*from, *to).unwrap_or_else(|| panic!("no way from {name} to {other}"));
            assert_eq!(path.last().copied().unwrap_or(*from), *to);
            let (clearance_m, is_inside) = clearance(&mesh, *from, &path);
            assert!(from == to || clearance_m >= RADIUS_M - 1e-3, "{name} to {other}: {clearance_m}");
            assert!(is_inside && hits_nothing(&mesh, *from, &path), "{name} to {other}: {path:?}");
            corners += path.len();
        }
        let pairs = places().count() * places().count();
        assert!(corners < 9 * pairs, "{corners} corners in {pairs} paths");
    }
}

/// The negative control.
#[test]
fn a_thinner_body_comes_nearer() {
    let plan = tigerplace();
    let mesh = Mesh::new(&plan, RADIUS_M / 2.0);
    let (from, to) = (Point::new(2.0, 4.05), Point::new(1.95, 0.95));
    let (clearance_m, _) = clearance(&mesh, from, &mesh.path(from, to).unwrap());
    assert!((RADIUS_M / 2.0 - 1e-3..RADIUS_M / 2.0 + 0.01).contains(&clearance_m), "{clearance_m}");
    assert!(!mesh.is_clear(from, to, RADIUS_M / 2.0), "straight through the wall");
}

#[test]
fn a_way_around_a_corner_is_hardly_longer_than_it_must_be() {
    let mesh = Mesh::new(&tigerplace(), RADIUS_M);
    // The door's east jamb is in the way from the bedroom to the coats.
    let (from, to) = (Point::new(2.0, 4.05), Point::new(4.7, 1.6));
    let path = mesh.path(from, to).unwrap();
    let length: f64 = [from].iter().chain(&path).zip(&path).map(|(a, b)| a.distance(*b)).sum();
    assert!(length < 1.01 * from.distance(to), "{length} {path:?}");
}

#[test]
fn ways_lead_over_rugs_and_not_over_beds() {
    let home = |height_m: f64| {
        let home = json!({
            "name": "a room", "rooms": [{ "name": "room", "outline": [[0, 0], [6, 0], [6, 3], [0, 3]] }],
            "walls": [{ "from": [0, 0], "to": [6, 0] }, { "from": [6, 0], "to": [6, 3] }, { "from": [6, 3], "to": [0, 3] },
                { "from": [0, 3], "to": [0, 0] }],
            "furniture": [{ "name": "thing", "at": [3, 1.1], "size_m": [2, 1.4], "height_m": height_m, "enterable": true }],
        });
        plan(&home.to_string())
    };
    let (west, east) = (Point::new(0.5, 1.1), Point::new(5.5, 1.1));
    assert_eq!(Mesh::new(&home(0.02), RADIUS_M).path(west, east), Some(vec![east]));
    let bed = Mesh::new(&home(0.6), RADIUS_M);
    assert!(bed.path(west, east).is_some_and(|path| path.len() >= 3));
    // Into the bed by its longer side, which has room.
    let middle = Point::new(3.0, 1.1);
    let side = bed.approach(middle).unwrap();
    assert!((side.x - 3.0).abs() < 1e-3 && (side.y - 2.02).abs() < 2e-3, "{side}");
    assert_eq!(bed.path(middle, Point::new(2.5, 1.1)), Some(vec![Point::new(2.5, 1.1)]), "turning in bed");
    assert_eq!(bed.path(middle, middle), Some(vec![]));
}

#[test]
fn a_closed_closet_cannot_be_reached() {
    let door = r#""name": "laundry closet door","#;
    let closed = plan(&TIGERPLACE.replace(door, &format!(r#"{door} "open": false,"#)));
    let (dryer, bedside) = (Point::new(3.55, 1.05), Point::new(1.5, 4.05));
    assert!(Mesh::new(&tigerplace(), RADIUS_M).can_reach(bedside, dryer));
    let mesh = Mesh::new(&closed, RADIUS_M);
    assert_eq!((mesh.path(bedside, dryer), mesh.path(dryer, bedside)), (None, None));
    assert!(mesh.can_reach(dryer, Point::new(2.95, 1.05)), "within the closet there are ways");
    assert_eq!(mesh.approach(Point::new(0.9, 3.15)), None, "the inside of the wardrobe");
    assert_eq!(mesh.path(bedside, Point::new(0.9, 3.15)), None);
    assert_eq!(mesh.path(bedside, Point::new(20.0, 3.0)), None, "out of doors");
}

#[test]
fn a_body_turns_sideways_in_a_narrow_gap() {
    // The door of 0.9 m is blocked to 0.4 m.
    let crate_in_door = r#"{ "name": "crate", "at": [3.4, 2.8], "size_m": [0.5, 0.1], "height_m": 1.0 }"#;
    let narrow = TIGERPLACE.replacen(r#""furniture": ["#, &format!(r#""furniture": [{crate_in_door},"#), 1);
    let mesh = Mesh::new(&plan(&narrow), RADIUS_M);
    let (hall, bedside) = (Point::new(4.7, 1.6), Point::new(1.5, 4.05));
    let path = mesh.path(hall, bedside).unwrap();
    let (clearance_m, is_inside) = clearance(&mesh, hall, &path);
    assert!(is_inside && (0.75 * RADIUS_M..RADIUS_M).contains(&clearance_m), "{clearance_m}");
    assert!(mesh.grounds[0].area_at(hall) != mesh.grounds[0].area_at(bedside));
}

#[test]
fn a_door_that_leads_out_is_left_from_inside() {
    let open = TIGERPLACE.replace(r#""open": false, "outside": true"#, r#""outside": true"#);
    for plan in [tigerplace(), plan(&open)] {
        let mesh = Mesh::new(&plan, RADIUS_M);
        let inside = mesh.inside_of(Point::new(4.65, 0.0)).unwrap();
        assert_eq!(plan.room_at(inside), Some(3), "{inside}");
        assert!(inside.y < 0.6 && mesh.can_reach(Point::new(1.5, 4.05), inside), "{inside}");
        assert_eq!(mesh.path(inside, Point::new(4.65, -0.5)), None, "the street is no part of the home");
    }
}

#[test]
fn random_points_of_a_room_are_free_and_all_over_it() {
    for plan in [tigerplace(), sphere_house()] {
        let mesh = Mesh::new(&plan, RADIUS_M);
        let mut stream = Stream::named(3, "points");
        for (index, room) in plan.rooms.iter().enumerate() {
            let points: Vec<Point> = (0..200).map(|_| mesh.free_point(index, &mut stream)).collect();
            assert!(points.iter().all(|&p| mesh.is_free(p) && geometry::contains(&room.outline, p)), "{}", room.name);
            assert!(points.iter().all(|&p| mesh.can_reach(points[0], p)), "{}", room.name);
            let (least, most) = geometry::bounds(points.iter().copied());
            assert!(least.distance(most) > 0.8, "{}: {least} to {most}", room.name);
        }
    }
}

#[test]
fn ways_keep_off_everything_in_random_homes() {
    let (mut found, mut none) = (0, 0);
    for case in 0..60 {
        let plan = random_home(case);
        let (mesh, again) = (Mesh::new(&plan, RADIUS_M), Mesh::new(&plan, RADIUS_M));
        let mut stream = Stream::named(case, "ends");
        let (least, most) = plan.bounds();
        let mut ends: Vec<Point> = plan.places.iter().map(|(_, at)| *at).collect();
        ends.extend((0..8).map(|_| Point::new(stream.between(least.x, most.x), stream.between(least.y, most.y))));
        for (&from, &to) in ends.iter().flat_map(|from| ends.iter().map(move |to| (from, to))) {
            let path = mesh.path(from, to);
            assert_eq!(path, again.path(from, to));
            assert_eq!(path.is_some(), mesh.path(to, from).is_some(), "case {case}: {from} to {to}, and back");
            let Some(path) = path else {
                none += 1;
                continue;
            };
            let (clearance_m, is_inside) = clearance(&mesh, from, &path);
            // No walk within a seat or on the spot.
            let walks = path.len() > 1 || mesh.is_free(from) && mesh.is_free(to);
            let is_right = !walks || clearance_m >= RADIUS_M * SIDEWAYS.value - 1e-3;
            assert!(is_right, "case {case}: {from} to {to}: {clearance_m} {path:?}");
            assert!(from == to || is_inside, "case {case}: {from} to {to}: {path:?}");
            assert!(hits_nothing(&mesh, from, &path), "case {case}: {from} to {to}: {path:?}");
            found += 1;
        }
    }
    assert!(found > 2_000 && none > 500, "{found} ways, {none} without");
}

#[test]
fn free_ground_agrees_with_the_plan() {
    for case in 0..40 {
        let plan = random_home(case);
        let mesh = Mesh::new(&plan, RADIUS_M);
        let mut stream = Stream::named(case, "points");
        let (least, most) = plan.bounds();
        for _ in 0..200 {
            let p = Point::new(stream.between(least.x, most.x), stream.between(least.y, most.y));
            // Corners are rounded from outside, with a margin: ground of the mesh is free, and floor with some more room is
            // ground.
            let on_mesh = mesh.grounds[0].area_at(p).is_some();
            assert!(!on_mesh || plan.is_walkable(p, RADIUS_M - 1e-3), "case {case}: {p}");
            let has_room = mesh.room_around(p) > 1.1 * RADIUS_M && plan.is_inside(p);
            assert!(
                on_mesh
                    || !has_room
                    || mesh.borders.iter().any(|&(a, b)| geometry::distance_to_segment(p, a, b) < 0.01)
            );
        }
    }
}

#[test]
#[ignore = "a measurement"]
#[expect(clippy::disallowed_types, clippy::disallowed_methods, reason = "a measurement needs a clock")]
fn prints_the_time_of_meshes_and_ways() {
    for plan in [tigerplace(), sphere_house()] {
        let begin = std::time::Instant::now();
        let meshes: Vec<Mesh> = (0..20).map(|_| Mesh::new(&plan, RADIUS_M)).collect();
        println!("{:?} a mesh", begin.elapsed() / 20);
        let pairs = || plan.places.iter().flat_map(|from| plan.places.iter().map(move |to| (from.1, to.1)));
        let begin = std::time::Instant::now();
        let corners: usize = pairs().filter_map(|(from, to)| meshes[0].path(from, to)).map(|path| path.len()).sum();
        let count = pairs().count();
        println!("{:?} a path of {:.1} corners", begin.elapsed() / count as u32, corners as f64 / count as f64);
    }
}

#[test]
fn tangled_walls_break_nothing() {
    // Few obstacles are triangulated as drawn; many are combined first.
    for (walls, cases) in [(3, 30), (20, 30), (60, 20), (200, 6), (400, 2)] {
        let mut ways = 0;
        for case in 0..cases {
            let plan = plan(&tangled_home(case, walls, 6));
            let mesh = Mesh::new(&plan, RADIUS_M);
            let (least, most) = plan.bounds();
            let stream = &mut Stream::named(case, "ends");
            let mut anywhere = || Point::new(stream.between(least.x, most.x), stream.between(least.y, most.y));
            for _ in 0..60 {
                let (from, to) = (anywhere(), anywhere());
                let on_ground = mesh.grounds[0].area_at(from).is_some();
                assert!(!on_ground || mesh.room_around(from) >= RADIUS_M - 1e-3, "{walls} walls, case {case}: {from}");
                let Some(path) = mesh.path(from, to) else { continue };
                ways += 1;
                let (clearance_m, is_inside) = clearance(&mesh, from, &path);
                // The narrowest ground is for half the radius.
                let is_wide = path.len() == 1 || clearance_m >= 0.5 * RADIUS_M - 2e-3;
                let is_way = is_wide && is_inside && hits_nothing(&mesh, from, &path);
                assert!(is_way, "{walls} walls, case {case}: {from} to {to} at {clearance_m}: {path:?}");
            }
        }
        assert!(ways > 0, "{walls} walls leave no way");
    }
}

/// By rounding, a door as wide as its wall leaves a piece of wall of length zero.
#[test]
fn a_door_as_wide_as_its_wall_blocks_no_seat() {
    let home = |to: f64| {
        let chair =
            r#"{ "name": "chair", "at": [7.4, 2.6], "size_m": [0.5, 0.5], "height_m": 0.9, "enterable": true }"#;
        plan(&format!(
            r#"{{ "name": "a", "rooms": [{{ "name": "room", "outline": [[4, 1], [9, 1], [9, 9], [4, 9]] }}],
                "walls": [{{ "from": [4.361, 7.67], "to": [5.262, 7.67], "thickness_m": 0.1 }}],
                "doors": [{{ "name": "door", "from": [5.262, 7.67], "to": [{to}, 7.67] }}], "furniture": [{chair}] }}"#
        ))
    };
    for to in [4.361, 4.6] {
        let mesh = Mesh::new(&home(to), 0.22);
        assert!(mesh.can_reach(Point::new(8.0, 5.0), Point::new(7.4, 2.6)), "{to}");
    }
}
