//! Habits of people who draw plans, each in a small plan: ceilings, names as text, holes, double doors, rooms without walls, one room
//! around all others, terraces.

use crate::plans::plan::{Home, door, piece, room, two_rooms, two_rooms_walls, wall};
use homebody_core::geometry::{self, Point};
use std::f64::consts::FRAC_PI_2;

const LIVING: [[f64; 2]; 4] = [[110.0, 110.0], [590.0, 110.0], [590.0, 490.0], [110.0, 490.0]];
const BEDROOM: [[f64; 2]; 4] = [[610.0, 110.0], [890.0, 110.0], [890.0, 490.0], [610.0, 490.0]];

fn doors() -> String {
    door("Front door", [200.0, 500.0], 0.0, "") + &door("Bedroom door", [600.0, 200.0], FRAC_PI_2, "")
}

#[test]
fn leaves_out_rooms_drawn_for_their_ceiling() {
    let ceiling = |corners: &[[f64; 2]]| room("", corners).replace("<room ", "<room floorVisible='false' ");
    let over = ceiling(&[[110.0, 110.0], [890.0, 110.0], [890.0, 300.0], [110.0, 300.0]]);
    let home = Home::of(&(over.clone() + &two_rooms()));
    assert_eq!(home.rooms(), ["Living room", "Bedroom"]);
    assert_eq!(geometry::signed_area(&home.plan.rooms[0].outline).abs(), 20.0);
    home.remarks("left out: 1 room drawn without a floor");
    // Without a room with a floor, they count as rooms.
    let alone = two_rooms_walls() + &ceiling(&LIVING) + &ceiling(&BEDROOM) + &doors();
    assert_eq!(Home::of(&alone).rooms(), ["room 1", "room 2"]);
}

#[test]
fn rooms_are_called_as_what_is_written_in_them() {
    let label = |text: &str, [x, y]: [f64; 2]| format!("<label id='l' x='{x}' y='{y}'><text>{text}</text></label>");
    let unnamed = two_rooms().replace("Living room", "").replace("'Bedroom'", "''");
    let written = label("客厅", [300.0, 300.0]) + &label("Two rooms", [500.0, 60.0]);
    let two = label("old", [700.0, 200.0]) + &label("new", [700.0, 300.0]);
    assert_eq!(Home::of(&(unnamed.clone() + &written + &two)).rooms(), ["客厅", "room 1"]);
    // So are spaces that walls enclose; a name that a room has stays.
    assert!(Home::of(&(two_rooms_walls() + &doors() + &written)).rooms().contains(&"客厅"));
    assert_eq!(Home::of(&(two_rooms() + &written)).rooms(), ["Living room", "Bedroom"]);
}

#[test]
fn a_side_that_goes_on_beyond_a_wall_is_drawn_out_to_its_middle_only_along_it() {
    let whole = wall([600.0, 100.0], [600.0, 500.0]);
    let walls = two_rooms_walls().replace(&whole, &wall([600.0, 100.0], [600.0, 300.0]));
    let west = [[110.0, 110.0], [590.0, 110.0], [590.0, 300.0], [590.0, 490.0], [110.0, 490.0]];
    let east = [[610.0, 110.0], [890.0, 110.0], [890.0, 490.0], [590.0, 490.0], [590.0, 300.0], [610.0, 300.0]];
    let front = door("Front door", [200.0, 500.0], 0.0, "");
    let home = Home::of(&[walls, room("West", &west), room("East", &east), front].concat());
    assert!(!home.remarks.iter().any(|remark| remark.contains("overlapped")), "{:?}", home.remarks);
    let areas = home.plan.rooms.iter().map(|room| geometry::signed_area(&room.outline).abs());
    assert_eq!(areas.map(|area| (area * 100.0).round() / 100.0).collect::<Vec<_>>(), [19.8, 12.2]);
}

#[test]
fn holes_in_rooms_are_filled() {
    // To the hole from the middle of a side, around it, and back by the same way.
    let corners = [
        [890.0, 110.0],
        [890.0, 490.0],
        [610.0, 490.0],
        [610.0, 110.0],
        [700.0, 110.0],
        [700.0, 300.0],
        [800.0, 300.0],
        [800.0, 200.0],
        [700.0, 200.0],
        [700.0, 110.0],
    ];
    let home = Home::of(&two_rooms().replace(&room("Bedroom", &BEDROOM), &room("Bedroom", &corners)));
    let bedroom = &home.plan.rooms[1];
    assert_eq!(geometry::signed_area(&bedroom.outline).abs(), 12.0, "{:?}", bedroom.outline);
    home.remarks("1 hole is filled in \"Bedroom\"");
    assert!(!home.remarks.iter().any(|remark| remark.contains("crossed itself")));
}

#[test]
fn two_leaves_of_a_door_stand_beside_each_other() {
    let leaf = |name: &str, x: f64| door(name, [x, 500.0], 0.0, "");
    let front = leaf("Front door", 200.0);
    // They overlap by 4 cm, like two frames.
    let home = Home::of(&two_rooms().replace(&front, &(front.clone() + &leaf("Other leaf", 286.0))));
    let leaf_of = |name: &str| home.file.doors.iter().find(|door| door.name == name).unwrap();
    let [front_door, other] = ["Front door", "Other leaf"].map(leaf_of);
    let width =
        |door: &homebody_core::plan::form::DoorFile| geometry::point(door.from).distance(geometry::point(door.to));
    assert!((width(front_door) - 0.9).abs() < 1e-9 && (width(other) - 0.86).abs() < 1e-9, "{}", home.text);
    assert!(front_door.outside && other.outside);
    home.remarks("the door \"Other leaf\" overlapped \"Front door\" and ends at it now");
    // The cut is reported once, and not as a wall that is too short.
    let home = Home::of(&two_rooms().replace(&front, &(front.clone() + &leaf("Other leaf", 278.0))));
    home.remarks("the door \"Other leaf\" overlapped \"Front door\"");
    assert!(!home.remarks.iter().any(|remark| remark.contains("wall is short")), "{:?}", home.remarks);
    // A frame and the door in it are one.
    let home = Home::of(&two_rooms().replace(&front, &(front.clone() + &leaf("Frame", 205.0))));
    assert_eq!(home.file.doors.len(), 2);
    home.remarks("left out: the doors \"Front door\" and \"Frame\" overlap");
}

#[test]
fn rooms_with_doors_in_a_plan_without_walls_have_walls() {
    let drawn = room("West", &[[100.0, 100.0], [500.0, 100.0], [500.0, 400.0], [100.0, 400.0]])
        + &room("East", &[[500.0, 100.0], [900.0, 100.0], [900.0, 400.0], [500.0, 400.0]])
        + &room("Yard", &[[900.0, 600.0], [1200.0, 600.0], [1200.0, 900.0], [900.0, 900.0]]);
    let between = door("Between", [500.0, 300.0], FRAC_PI_2, "");
    let home = Home::of(&(drawn.clone() + &door("Front door", [300.0, 400.0], 0.0, "") + &between));
    home.remarks("the plan has doors but no walls");
    assert_eq!(home.file.walls.len(), 7, "the wall between is one, and the yard has none");
    assert_eq!(home.joins("Between"), [Some("West"), Some("East")]);
    assert!(home.file.doors[0].outside);
    assert!(home.plan.is_walkable(Point::new(4.0, 1.0), 0.22) && !home.plan.is_walkable(Point::new(4.0, 2.5), 0.22));
    // Without doors, people go from room to room as drawn.
    assert!(Home::of(&drawn).file.walls.is_empty());
}

#[test]
fn a_room_around_several_spaces_is_parted_by_the_walls() {
    let around = |name: &str| room(name, &[[60.0, 60.0], [940.0, 60.0], [940.0, 540.0], [60.0, 540.0]]);
    let of = |name: &str, more: &str| Home::of(&(two_rooms_walls() + more + &around(name) + &doors()));
    let home = of("", "");
    home.remarks("2 spaces that walls enclose are rooms now, instead of one around them");
    assert_eq!(home.rooms(), ["room 1", "room 2"]);
    assert_eq!(home.joins("Bedroom door"), [Some("room 1"), Some("room 2")]);
    assert!(home.file.doors[0].outside);
    // Two spaces may be one room, if it has a name; three may not.
    assert_eq!(of("Living room", "").rooms(), ["Living room"]);
    let third = wall([100.0, 300.0], [600.0, 300.0]);
    assert_eq!(of("Flat", &third).rooms(), ["Flat", "room 1", "room 2"]);
    // If the spaces have rooms of their own, it is left out as before; a closet does not split a room.
    assert_eq!(Home::of(&(two_rooms() + &around(""))).rooms(), ["Living room", "Bedroom"]);
    let closet = wall([100.0, 200.0], [200.0, 200.0]) + &wall([200.0, 200.0], [200.0, 100.0]);
    assert_eq!(Home::of(&(two_rooms() + &closet)).rooms(), ["Living room", "Bedroom"]);
}

#[test]
fn open_ground_before_the_front_door_is_outside() {
    let paving = room("Path", &[[150.0, 510.0], [250.0, 510.0], [250.0, 800.0], [150.0, 800.0]]);
    let chair = piece("Garden chair", [200.0, 700.0], [40.0, 40.0, 80.0], "");
    let home = Home::of(&(two_rooms() + &paving + &chair));
    assert_eq!(home.rooms(), ["Living room", "Bedroom"]);
    assert!(home.file.doors[0].name == "Front door" && home.file.doors[0].outside);
    home.remarks("left out: the room \"Path\", which lies in the open; doors to it lead out");
    home.remarks("left out: 1 piece of furniture not within a room");
    // So are rooms behind it.
    let garden = room("Garden", &[[150.0, 810.0], [250.0, 810.0], [250.0, 1100.0], [150.0, 1100.0]]);
    let gate = wall([150.0, 805.0], [250.0, 805.0]) + &door("Gate", [200.0, 805.0], 0.0, "");
    let home = Home::of(&(two_rooms() + &paving + &garden + &gate));
    assert_eq!(home.rooms(), ["Living room", "Bedroom"]);
    assert!(home.file.doors[0].outside);
    home.remarks("left out: the room \"Garden\", which lies in the open");
    // A balcony stays where there is another way out, and a room that walls enclose stays anyway.
    let balcony = room("Balcony", &[[650.0, 510.0], [850.0, 510.0], [850.0, 650.0], [650.0, 650.0]]);
    let window = door("Window", [750.0, 500.0], 0.0, "catalogId='eTeks#doubleFrenchWindow126x200'");
    assert_eq!(Home::of(&(two_rooms() + &balcony + &window)).rooms(), ["Living room", "Bedroom", "Balcony"]);
    let walls: String = [[150.0, 510.0], [150.0, 800.0], [250.0, 800.0], [250.0, 510.0]]
        .windows(2)
        .map(|ends| wall(ends[0], ends[1]))
        .collect();
    assert_eq!(Home::of(&(two_rooms() + &paving + &walls)).rooms(), ["Living room", "Bedroom", "Path"]);
}
