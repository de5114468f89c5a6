//! Unreachable as drawn: chairs under a table, pieces that stand into a wall, and rooms without a door.

use crate::plans::plan::{Home, door, piece, room, two_rooms, two_rooms_walls};
use homebody_core::geometry;
use homebody_walk::Mesh;
use homebody_walk::places::HomePlaces;
use std::f64::consts::FRAC_PI_2;

const CHAIR: [f64; 3] = [40.0, 40.0, 90.0];
const TABLE: [f64; 3] = [100.0, 100.0, 75.0];

/// The names of the unreachable places.
fn unreached(home: &Home) -> Vec<String> {
    let places = HomePlaces::new(&home.file, &home.plan, &Mesh::new(&home.plan, 0.22), "anna");
    places.all().iter().filter(|spot| !spot.is_reachable).map(|spot| spot.name.clone()).collect()
}

/// The flat with a table in its living room and chairs, so far from the table's middle on each side.
fn table_and_chairs(away_cm: f64, names: [&str; 4]) -> String {
    let at = [[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 1.0]];
    let chairs = at.iter().zip(names).map(|([x, y], name)| {
        piece(
            name,
            [330.0 + x * away_cm, 300.0 + y * away_cm],
            CHAIR,
            &format!("angle='{}'", if *y == 0.0 { FRAC_PI_2 } else { 0.0 }),
        )
    });
    two_rooms() + &piece("Tisch", [330.0, 300.0], TABLE, "") + &chairs.collect::<String>()
}

#[test]
fn chairs_under_a_table_are_pulled_out() {
    for away_cm in [25.0, 35.0, 45.0] {
        let home = Home::of(&table_and_chairs(away_cm, ["Stuhl", "Chair", "Sedia", "Hocker"]));
        assert_eq!(unreached(&home), [""; 0], "{away_cm} {:?}", home.remarks);
        home.remarks("moved away from furniture or walls, so that residents can reach them");
        let table = geometry::point(home.file.furniture[0].at.unwrap());
        for chair in &home.file.furniture[1..] {
            let away_m = geometry::point(chair.at.unwrap()).distance(table);
            assert!((0.5..1.0).contains(&away_m), "{} is {away_m} m from the table's middle", chair.name);
        }
    }
}

#[test]
fn chairs_that_people_get_to_stay_where_they_are() {
    let home = Home::of(&table_and_chairs(60.0, ["Chair", "Chair", "Chair", "Chair"]));
    assert_eq!(unreached(&home), [""; 0]);
    assert!(!home.remarks.iter().any(|remark| remark.contains("moved out")), "{:?}", home.remarks);
    let table = geometry::point(home.file.furniture[0].at.unwrap());
    for chair in &home.file.furniture[1..] {
        assert!((geometry::point(chair.at.unwrap()).distance(table) - 0.6).abs() < 1e-9);
    }
    // A piece without a use stays, too.
    let boxed = two_rooms() + &piece("Tisch", [330.0, 300.0], TABLE, "") + &piece("Box", [330.0, 300.0], CHAIR, "");
    let home = Home::of(&boxed);
    assert_eq!(home.file.furniture[0].at, home.file.furniture[1].at);
}

#[test]
fn a_chair_between_a_table_and_a_wall_goes_to_another_side() {
    let table = piece("Table", [330.0, 150.0], [200.0, 80.0, 75.0], "");
    let home = Home::of(&(two_rooms() + &table + &piece("Chair", [330.0, 130.0], CHAIR, "")));
    assert_eq!(unreached(&home), [""; 0], "{:?}", home.remarks);
    let [table, chair] = [0, 1].map(|index| geometry::point(home.file.furniture[index].at.unwrap()));
    assert!(chair.distance(table) > 0.45, "{chair}");
}

#[test]
fn moves_pieces_out_of_walls() {
    // The middle of the fridge is in the wall between the rooms, and a cupboard is on its other side.
    let fridge = piece("Fridge", [596.0, 450.0], [60.0, 60.0, 180.0], "");
    let bed = piece("Bed", [150.0, 220.0], [90.0, 200.0, 50.0], "");
    let home = Home::of(&(two_rooms() + &bed + &fridge));
    assert_eq!(unreached(&home), [""; 0], "{:?}", home.remarks);
}

#[test]
fn rooms_that_nobody_gets_into_are_named() {
    let shut = two_rooms().replace(&door("Bedroom door", [600.0, 200.0], FRAC_PI_2, ""), "");
    let chair = piece("Chair", [300.0, 300.0], CHAIR, "");
    Home::of(&(shut + &chair)).remarks("no resident can enter \"Bedroom\"");
    let open = Home::of(&(two_rooms() + &chair));
    assert!(!open.remarks.iter().any(|remark| remark.contains("no resident can enter")), "{:?}", open.remarks);
    // The same of a room of another name.
    let whole = room("Studio", &[[110.0, 110.0], [590.0, 110.0], [590.0, 490.0], [110.0, 490.0]]);
    let east = room("East", &[[610.0, 110.0], [890.0, 110.0], [890.0, 490.0], [610.0, 490.0]]);
    let drawn = two_rooms_walls() + &whole + &east + &door("Front door", [200.0, 500.0], 0.0, "") + &chair;
    Home::of(&drawn).remarks("no resident can enter \"East\"");
}
