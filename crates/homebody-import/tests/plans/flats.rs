//! Plausible flats.

use crate::plans::plan::{Home, door, piece, room, two_rooms, two_rooms_walls, wall};
use homebody_core::geometry::{self, Point, point};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

#[test]
fn a_flat_of_two_rooms_comes_out_as_it_was_drawn() {
    let drawn = two_rooms()
        + &piece("Double bed", [800.0, 300.0], [160.0, 200.0, 50.0], "angle='1.5707964' catalogId='eTeks#bed140x190'")
        + &piece("Table", [300.0, 300.0], [120.0, 80.0, 74.0], "")
        + &piece("Vase", [300.0, 300.0], [20.0, 20.0, 30.0], "elevation='74'");
    let home = Home::of(&drawn);
    assert_eq!(home.remarks, [""; 0]);
    let expected = r#"{
  "$schema": "./schemas/home.schema.json",
  "name": "test",
  "about": "From a plan made with Sweet Home 3D.",
  "latitude_deg": 38.95,
  "rooms": [
    { "name": "Living room", "outline": [[0, 4], [5, 4], [5, 0], [0, 0]] },
    { "name": "Bedroom", "outline": [[5, 4], [8, 4], [8, 0], [5, 0]] }
  ],
  "walls": [
    { "from": [0, 4], "to": [8, 4], "thickness_m": 0.2 },
    { "from": [8, 4], "to": [8, 0], "thickness_m": 0.2 },
    { "from": [8, 0], "to": [0, 0], "thickness_m": 0.2 },
    { "from": [0, 0], "to": [0, 4], "thickness_m": 0.2 },
    { "from": [5, 4], "to": [5, 0], "thickness_m": 0.2 }
  ],
  "doors": [
    { "name": "Front door", "from": [1.45, 0], "to": [0.55, 0], "open": false, "outside": true },
    { "name": "Bedroom door", "from": [5, 3.45], "to": [5, 2.55] }
  ],
  "furniture": [
    { "name": "Double bed", "at": [7, 2], "size_m": [1.6, 2], "turn_deg": -90, "height_m": 0.5, "enterable": true },
    { "name": "Table", "at": [2, 2], "size_m": [1.2, 0.8], "height_m": 0.74 },
    { "name": "Vase", "at": [2, 2], "size_m": [0.2, 0.2], "height_m": 1.04 }
  ]
}
"#;
    assert_eq!(home.text, expected);
    assert_eq!(home.joins("Bedroom door"), [Some("Living room"), Some("Bedroom")]);
    assert_eq!(home.joins("Front door"), [None, Some("Living room")]);
}

#[test]
fn rooms_that_are_not_drawn_are_found_within_walls() {
    let walls = two_rooms_walls()
        + &wall([300.0, 100.0], [300.0, 250.0])
        + &door("Door", [600.0, 200.0], FRAC_PI_2, "")
        + &door("Door", [200.0, 500.0], PI, "");
    let home = Home::of(&walls);
    assert_eq!(home.rooms(), ["room 1", "room 2"]);
    home.remarks("2 spaces that walls enclose are rooms now");
    let mut areas: Vec<f64> = home.plan.rooms.iter().map(|room| geometry::signed_area(&room.outline).abs()).collect();
    areas.sort_by(f64::total_cmp);
    assert_eq!(areas, [12.0, 20.0]);
    // The way out is first.
    assert!(home.file.doors[0].outside && !home.file.doors[1].outside);
    assert_eq!((&home.file.doors[0].name[..], &home.file.doors[1].name[..]), ("Door 2", "Door"));
}

#[test]
fn the_ground_around_a_house_is_no_room() {
    let corners = [[-900.0, -900.0], [1900.0, -900.0], [1900.0, 1500.0], [-900.0, 1500.0]];
    let fence: String = (0..4).map(|side| wall(corners[side], corners[(side + 1) % 4])).collect();
    let front = door("Front door", [200.0, 500.0], 0.0, "");
    let home = Home::of(&(two_rooms_walls() + &fence + &front));
    assert_eq!(home.rooms(), ["room 1", "room 2"]);
    assert!(home.file.doors[0].outside);
}

#[test]
fn curved_walls_become_chords_that_keep_doors_whole() {
    // The east is a half circle around (5 m, 3 m), which the arc goes through at (7 m, 3 m).
    let walls = wall([100.0, 100.0], [500.0, 100.0])
        + &wall([500.0, 500.0], [100.0, 500.0])
        + &wall([100.0, 500.0], [100.0, 100.0])
        + "<wall id='a' xStart='500' yStart='100' xEnd='500' yEnd='500' thickness='10' height='250' arcExtent='3.1415927'/>"
        + &door("Balcony door", [500.0 + 200.0 * FRAC_PI_4.cos(), 300.0 + 200.0 * FRAC_PI_4.sin()], -FRAC_PI_4, "")
        + &door("Front door", [200.0, 500.0], 0.0, "");
    let home = Home::of(&walls);
    home.remarks("1 curved wall is of straight chords now");
    let chords: Vec<_> = home.file.walls.iter().filter(|wall| wall.thickness_m == 0.1).collect();
    assert!((8..40).contains(&chords.len()), "{}", chords.len());
    let middle = Point::new(4.0, 2.0);
    for chord in &chords {
        assert!((point(chord.from).distance(middle) - 2.0).abs() < 0.001);
        assert!(point(chord.from).x > 3.999, "it bulges to the east");
    }
    let length: f64 = chords.iter().map(|chord| point(chord.from).distance(point(chord.to))).sum();
    assert!(length > 6.2 && length < 2.0 * PI, "{length}");
    let balcony = &home.file.doors[1];
    let width = point(balcony.from).distance(point(balcony.to));
    assert!((width - 0.9).abs() < 0.0015, "{width}");
    assert!(balcony.outside);
    let area = geometry::signed_area(&home.plan.rooms[0].outline).abs();
    assert!((area - (16.0 + 2.0 * PI)).abs() < 0.1, "{area}");
}

#[test]
fn windows_groups_lamps_and_what_is_hidden() {
    let drawn = two_rooms()
        + &door("Window", [400.0, 100.0], 0.0, "elevation='85'")
        + &door("", [700.0, 100.0], 0.0, "catalogId='eTeks#doubleWindow126x123' elevation='25'")
        + &door("French window", [800.0, 500.0], PI, "catalogId='eTeks#doubleFrenchWindow126x200'")
        + "<furnitureGroup id='g' name='Dining' x='300' y='300' width='200' depth='200' height='90' angle='0'>"
        + &piece("Chair", [250.0, 300.0], [40.0, 40.0, 90.0], "")
        + "<furnitureGroup name='more'>"
        + &piece("Chair", [350.0, 300.0], [40.0, 40.0, 90.0], "")
        + &door("Door", [890.0, 300.0], FRAC_PI_2, "")
        + "</furnitureGroup></furnitureGroup>"
        + "<furnitureGroup visible='false'>"
        + &piece("Ghost", [350.0, 200.0], [40.0, 40.0, 90.0], "")
        + "</furnitureGroup>"
        + "<light id='l' name='Ceiling lamp' x='300' y='300' width='30' depth='30' height='40' elevation='200'/>"
        + &piece("Tree", [2000.0, 300.0], [40.0, 40.0, 90.0], "")
        + &piece("Bedside table", [800.0, 150.0], [40.0, 40.0, 50.0], "catalogId='eTeks#bedsideTable'")
        + "<label x='1' y='1'/><polyline/><dimensionLine/>";
    let home = Home::of(&drawn);
    let pieces: Vec<_> = home.file.furniture.iter().map(|piece| (&piece.name[..], piece.enterable)).collect();
    assert_eq!(pieces, [("Bedside table", false), ("Chair", true), ("Chair 2", true)]);
    let doors: Vec<_> = home.file.doors.iter().map(|door| (&door.name[..], door.outside)).collect();
    assert_eq!(doors, [("Front door", true), ("Bedroom door", false), ("French window", true), ("Door", true)]);
    home.remarks("left out: 2 windows");
    home.remarks("left out: 1 piece of furniture hidden");
    home.remarks("left out: 1 piece of furniture more than 1.5 m above the floor");
    home.remarks("left out: 1 piece of furniture not within a room");
}

#[test]
fn doors_at_an_angle_go_into_the_wall_nearest() {
    let drawn = two_rooms_walls()
        + &wall([100.0, 100.0], [600.0, 500.0])
        + &door("across", [350.0, 300.0], 0.6747, "")
        + &door("beside", [613.0, 300.0], FRAC_PI_2 + 0.05, "")
        + &door("in the corner", [895.0, 120.0], FRAC_PI_2, "")
        + &door("far away", [720.0, 300.0], 0.0, "")
        + &door("broad", [600.0, 470.0], FRAC_PI_2, "width='500'")
        + &door("front", [200.0, 500.0], 0.0, "");
    let home = Home::of(&drawn);
    let names: Vec<&str> = home.file.doors.iter().map(|door| &door.name[..]).collect();
    assert_eq!(names, ["front", "across", "beside", "in the corner"]);
    home.remarks("left out: the door \"far away\", which is in no wall");
    home.remarks("\"in the corner\" moved by");
    home.remarks("the door \"broad\" is 4.00 m wide, not 5.00 m");
    home.remarks("left out: the doors \"beside\" and \"broad\" overlap");
    assert_eq!(home.joins("across"), [Some("room 1"), Some("room 2")]);
    assert_eq!(home.file.doors[2].from[0], 5.0);
    assert_eq!(home.joins("beside").iter().flatten().count(), 2);
}

#[test]
fn a_door_is_as_wide_as_its_hole() {
    let drawn = two_rooms() + &door("Hole", [800.0, 100.0], 0.0, "width='100' wallWidth='0.8' wallLeft='0.2'");
    let home = Home::of(&drawn);
    let hole = &home.file.doors[2];
    assert_eq!((hole.from, hole.to), ([6.7, 4.0], [7.5, 4.0]));
}

#[test]
fn a_door_is_where_its_hole_is() {
    // A quarter of its depth is in the wall, at its back, which is to the north of the plan.
    let more = "depth='40' wallThickness='0.25' wallDistance='0'";
    let aside = format!("<doorOrWindow name='Hole' x='800' y='115' width='90' height='210' {more}/>");
    let home = Home::of(&(two_rooms() + &aside));
    assert_eq!((home.file.doors[2].from, home.file.doors[2].to), ([6.55, 4.0], [7.45, 4.0]));
    assert_eq!(home.remarks, [""; 0]);
}

#[test]
fn a_door_through_two_walls_is_two_doors() {
    let walls: String = [
        wall([0.0, 0.0], [400.0, 0.0]),
        wall([400.0, 0.0], [400.0, 400.0]),
        wall([400.0, 400.0], [0.0, 400.0]),
        wall([0.0, 400.0], [0.0, 0.0]),
    ]
    .concat();
    let beside =
        walls.replace("='400'", "='820'").replace("xStart='0'", "xStart='420'").replace("xEnd='0'", "xEnd='420'");
    let beside = beside.replace("yStart='820'", "yStart='400'").replace("yEnd='820'", "yEnd='400'");
    let door =
        format!("<doorOrWindow name='Door' x='410' y='200' angle='{FRAC_PI_2}' width='90' depth='40' height='210'/>");
    let home = Home::of(&(walls + &beside + &door));
    let doors: Vec<_> = home.file.doors.iter().map(|door| (&door.name[..], door.from[0], door.outside)).collect();
    assert_eq!(doors, [("Door", 4.0, false), ("Door 2", 4.2, false)]);
    home.remarks("the door \"Door\" goes through two walls");
    // Through both there is a way.
    for x in [4.05, 4.09, 4.11, 4.15] {
        assert!(home.plan.is_inside(Point::new(x, 2.0)) && !home.plan.is_inside(Point::new(x, 3.0)), "{x}");
    }
}

#[test]
fn outlines_are_put_in_order() {
    let drawn = two_rooms_walls()
        + &room("", &[[110.0, 110.0], [590.0, 490.0], [590.0, 110.0], [110.0, 490.0]])
        + &room("Bedroom", &[[605.0, 110.0], [605.0, 110.0], [890.0, 110.0], [890.0, 490.0], [605.0, 490.0]])
        + &room("bedroom ", &[[700.0, 150.0], [750.0, 150.0], [750.0, 200.0]])
        + &room("Flat", &[[90.0, 90.0], [910.0, 90.0], [910.0, 510.0], [90.0, 510.0]])
        + &room("Line", &[[110.0, 110.0], [590.0, 110.0], [300.0, 110.0]])
        + &door("Front door", [200.0, 500.0], 0.0, "");
    let home = Home::of(&drawn);
    assert_eq!(home.rooms(), ["room 1", "Bedroom"]);
    home.remarks("the outline of \"room 1\" crossed itself");
    home.remarks("left out: the room \"Flat\", most of which other rooms cover");
    home.remarks("left out: the room \"bedroom 2\", which overlaps \"Bedroom\"");
    home.remarks("left out: the room \"Line\", whose outline encloses nothing");
    let areas: Vec<f64> = home.plan.rooms.iter().map(|room| geometry::signed_area(&room.outline).abs()).collect();
    assert_eq!(areas, [20.0, 12.0]);
}

#[test]
fn rooms_with_steps_in_doorways_end_in_the_middle_of_walls() {
    // The room reaches into the doorway, as it does when it is made by a double click.
    let living = [
        [110.0, 110.0],
        [590.0, 110.0],
        [590.0, 155.0],
        [600.0, 155.0],
        [600.0, 245.0],
        [590.0, 245.0],
        [590.0, 490.0],
        [110.0, 490.0],
    ];
    let drawn = two_rooms_walls() + &room("Living room", &living) + &door("Door", [600.0, 200.0], FRAC_PI_2, "");
    let home = Home::of(&drawn);
    assert_eq!(home.file.rooms[0].outline, [[0.0, 4.0], [5.0, 4.0], [5.0, 0.0], [0.0, 0.0]]);
    // The other is not drawn, but there.
    home.remarks("1 space that walls enclose is a room now");
    assert_eq!(home.rooms(), ["Living room", "room 1"]);
    assert_eq!(home.joins("Door"), [Some("Living room"), Some("room 1")]);
}

#[test]
fn names_show_which_furniture_people_can_enter() {
    let is_enterable = |name: &str, catalog: &str| {
        let piece = piece(name, [300.0, 300.0], [20.0, 20.0, 30.0], &format!("catalogId='{catalog}'"));
        Home::of(&(two_rooms() + &piece)).file.furniture[0].enterable
    };
    let seats = [
        ("Lit", "eTeks#bed140x190"),
        ("Oma", "Scopia#arm_chair"),
        ("Toilet unit", ""),
        ("WC", ""),
        ("Wall mounted toilet", ""),
        ("", "eTeks#shower"),
        ("Persian rug", ""),
        ("Old sofa", "custom"),
    ];
    for (name, catalog) in seats {
        assert!(is_enterable(name, catalog), "{name} {catalog}");
    }
    let others = [
        ("Bedside table", "eTeks#bedsideTable"),
        ("Table", "eTeks#table"),
        ("Shower curtain", ""),
        ("Bathroom sink", ""),
        ("Embedded oven", ""),
        ("Toilet paper", ""),
        ("", ""),
    ];
    for (name, catalog) in others {
        assert!(!is_enterable(name, catalog), "{name} {catalog}");
    }
}

#[test]
fn names_are_made_fit() {
    let drawn = two_rooms()
        + &piece("Bedroom", [300.0, 300.0], [20.0, 20.0, 30.0], "catalogId='eTeks#bed'")
        + &piece("a&#10;&quot;b&quot; &lt;ö&gt;", [300.0, 300.0], [20.0, 20.0, 30.0], "")
        + &piece("", [300.0, 300.0], [20.0, 20.0, 30.0], "")
        + &piece(&"x".repeat(300), [300.0, 300.0], [20.0, 20.0, 30.0], "");
    let home = Home::of(&drawn);
    let names: Vec<&str> = home.file.furniture.iter().map(|piece| &piece.name[..]).collect();
    assert_eq!(names[..3], ["Bedroom 2", "a \"b\" <ö>", "piece 1"]);
    assert_eq!(names[3].len(), 90);
}

#[test]
fn the_compass_says_how_far_north_it_is() {
    let home = Home::of(&(two_rooms() + "<compass x='0' y='0' diameter='100' northDirection='0' latitude='0.8779'/>"));
    assert_eq!(home.file.latitude_deg, 50.3);
}
