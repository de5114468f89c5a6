//! Plans of several levels: a home is one of them, or all that stairs connect.

use crate::plans::plan::{Home, file, import, piece, room, two_rooms, wall};
use homebody_import::{ImportError, sweet_home};

/// A house: a cellar of one room, the flat above it, and an attic without walls.
fn house() -> String {
    let corners = [[0.0, 0.0], [300.0, 0.0], [300.0, 300.0], [0.0, 300.0]];
    let cellar: String = (0..4).map(|side| wall(corners[side], corners[(side + 1) % 4])).collect();
    [
        "<level id='l2' name='Attic' elevation='500' floorThickness='12' height='250' elevationIndex='0'/>".to_owned(),
        "<level id='l0' name='Cellar' elevation='-250' floorThickness='12' height='250' elevationIndex='0'/>"
            .to_owned(),
        "<level id='l1' name='Ground floor' elevation='0' floorThickness='12' height='250' elevationIndex='0'/>"
            .to_owned(),
        on("l0", &cellar),
        on("l0", &room("Cellar", &corners)),
        on("l1", &two_rooms()),
        on("l1", "<furnitureGroup level='l0' id='g'>"),
        piece("Shelf", [150.0, 150.0], [40.0, 40.0, 90.0], ""),
        "</furnitureGroup>".to_owned(),
    ]
    .concat()
}

#[test]
fn the_level_is_taken_by_which_people_come_home() {
    let home = Home::of(&house());
    assert_eq!(home.rooms(), ["Living room", "Bedroom"]);
    home.remarks(
        "of 3 levels, this is 2 \"Ground floor\", by which people come home; left out are 1 \"Cellar\", 3 \"Attic\"",
    );
    assert_eq!(home.file.about, "The level \"Ground floor\" of a plan made with Sweet Home 3D.");
    assert!(home.file.furniture.is_empty(), "a group's pieces are on its level");
    assert!(home.file.rooms.iter().all(|room| room.floor.is_none()));
    // An upper floor may have more walls.
    let walls: String =
        (0..6).map(|n| wall([120.0 + 10.0 * f64::from(n), 150.0], [120.0 + 10.0 * f64::from(n), 200.0])).collect();
    let cellar = walls.replace("<wall id=", "<wall level='l0' id=");
    assert_eq!(Home::of(&(house() + &cellar)).rooms(), ["Living room", "Bedroom"]);
    // Without a way out anywhere, walls decide; invisible things are ignored.
    let shut = house().replace("name='Front door'", "name='Window' elevation='87'");
    Home::of(&shut).remarks("this is 2 \"Ground floor\", which has the most walls");
    let hidden = house().replace("<level id='l1'", "<level id='l1' viewable='false'");
    assert_eq!(Home::of(&hidden).rooms(), ["Cellar"]);
}

/// A drawing on a level.
fn on(level: &str, drawn: &str) -> String {
    let tags = ["wall", "room", "doorOrWindow", "pieceOfFurniture"];
    let with = |text: String, tag: &&str| text.replace(&format!("<{tag} id="), &format!("<{tag} level='{level}' id="));
    tags.iter().fold(drawn.to_owned(), with)
}

/// Two floors of two rooms each, with stairs in the bedroom below; those above have other names.
fn two_floors(stairs: &str) -> String {
    let above =
        two_rooms().replace("Living room", "Studio").replace("Bedroom", "Landing").replace("Front door", "Balcony");
    [
        "<level id='a' name='Ground floor' elevation='0'/><level id='b' name='First floor' elevation='260'/>"
            .to_owned(),
        on("a", &two_rooms()),
        on("a", stairs),
        on("b", &above),
        on("b", &piece("Bed", [200.0, 250.0], [140.0, 200.0, 50.0], "")),
    ]
    .concat()
}

#[test]
fn floors_that_stairs_join_are_drawn_beside_each_other() {
    let stairs = piece("Staircase", [840.0, 250.0], [80.0, 240.0, 280.0], "catalogId='eTeks#staircase'");
    let home = Home::of(&two_floors(&stairs));
    assert_eq!(home.rooms(), ["Living room", "Bedroom", "stairs", "Studio", "Landing"]);
    home.remarks("the floors \"Ground floor\", \"First floor\" are drawn beside each other");
    let floors: Vec<Option<&str>> = home.file.rooms.iter().map(|room| room.floor.as_deref()).collect();
    let (below, above) = (Some("Ground floor"), Some("First floor"));
    assert_eq!(floors, [below, below, None, above, above]);
    let frames = homebody_core::plan::floors(&home.file.rooms);
    assert_eq!(frames.len(), 2);
    assert!(frames[0].bounds.1.x < frames[1].bounds.0.x, "{frames:?}");
    // The passage replaces the stairs, and has their length.
    assert_eq!(home.file.furniture.len(), 1);
    assert_eq!(home.joins("foot of the stairs"), [Some("Bedroom"), Some("stairs")]);
    assert_eq!(home.joins("head of the stairs"), [Some("stairs"), Some("Landing")]);
    let stairs = homebody_core::geometry::signed_area(&home.plan.rooms[2].outline).abs();
    assert!((stairs - 2.4_f64.hypot(2.6)).abs() < 0.01, "{stairs}");
    // The way out is that of the lower floor.
    assert!(home.file.doors[0].name == "Front door" && home.file.doors[0].outside);
    // Rooms keep their size.
    let area = |room: usize| homebody_core::geometry::signed_area(&home.plan.rooms[room].outline).abs();
    assert_eq!([area(0), area(1), area(3), area(4)].map(|area| (area * 1e3).round() / 1e3), [20.0, 12.0, 20.0, 12.0]);
}

#[test]
fn floors_that_no_stairs_join_are_not() {
    let shelf = piece("Shelf", [840.0, 250.0], [80.0, 240.0, 280.0], "");
    let home = Home::of(&two_floors(&shelf));
    assert_eq!(home.rooms(), ["Living room", "Bedroom"]);
    home.remarks("of 2 levels, this is 1 \"Ground floor\", by which people come home");
    let one = sweet_home(&file(&two_floors(&shelf)), "test", Some("First floor")).unwrap();
    assert_eq!(Home::from(one).rooms(), ["Studio", "Landing"]);
    // Steps do not count as stairs.
    let steps = piece("Staircase", [840.0, 250.0], [80.0, 100.0, 60.0], "catalogId='eTeks#staircase'");
    assert_eq!(Home::of(&two_floors(&steps)).rooms().len(), 2);
}

/// Two floors with stairs in the bedroom below, and a level between them that is so high and has one room.
fn with_level_between(name: &str, elevation: f64, height: f64, stairs: &str) -> String {
    let corners = [[110.0, 110.0], [890.0, 110.0], [890.0, 490.0], [110.0, 490.0]];
    let between = room("", &corners).replace("<room id=", "<room level='c' id=");
    let level = format!("<level id='c' name='{name}' elevation='{elevation}' floorThickness='12' height='{height}'/>");
    level + &two_floors(stairs) + &between
}

const STAIRS: [f64; 3] = [80.0, 240.0, 280.0];

#[test]
fn a_level_in_which_nobody_can_stand_keeps_nobody_from_those_above() {
    let stairs = piece("Staircase", [840.0, 250.0], STAIRS, "catalogId='eTeks#staircase'");
    let both = ["Living room", "Bedroom", "stairs", "Studio", "Landing"];
    for (elevation, height) in [(235.0, 18.0), (250.0, 5.0), (120.0, 60.0)] {
        let home = Home::of(&with_level_between("False ceiling", elevation, height, &stairs));
        assert_eq!(home.rooms(), both, "{elevation} {height} {:?}", home.remarks);
        home.remarks("left out are 2 \"False ceiling\"");
    }
    // It is used on request.
    let asked = file(&with_level_between("False ceiling", 235.0, 18.0, &stairs));
    assert_eq!(Home::from(sweet_home(&asked, "test", Some("2")).unwrap()).rooms().len(), 1);
    // Without stairs the floor above stays out.
    let home = Home::of(&with_level_between("False ceiling", 235.0, 18.0, ""));
    assert_eq!(home.rooms(), ["Living room", "Bedroom"]);
}

#[test]
fn a_gallery_to_which_no_stairs_lead_keeps_nobody_from_those_above() {
    let stairs = piece("Staircase", [840.0, 250.0], STAIRS, "catalogId='eTeks#staircase'");
    let home = Home::of(&with_level_between("Mezzanine", 130.0, 125.0, &stairs));
    for room in ["Living room", "Bedroom", "Studio", "Landing"] {
        assert!(home.rooms().contains(&room), "{room}: {:?} {:?}", home.rooms(), home.remarks);
    }
}

#[test]
fn a_level_is_taken_by_name_or_number() {
    for wanted in ["cellar", " Cellar", "1"] {
        let home = Home::from(sweet_home(&file(&house()), "test", Some(wanted)).unwrap());
        assert_eq!((home.rooms(), home.file.walls.len()), (vec!["Cellar"], 4));
        assert_eq!(home.file.furniture[0].name, "Shelf");
        home.remarks("as was asked");
    }
}

#[test]
fn a_level_that_is_not_there_is_told() {
    let none = |drawn: &str, wanted: &str| sweet_home(&file(drawn), "test", Some(wanted)).unwrap_err();
    for wanted in ["roof", "0", "4", "-1", ""] {
        let error = none(&house(), wanted);
        assert!(matches!(error, ImportError::NoSuchLevel { .. }));
        let known = "hint: it has 1 \"Cellar\", 2 \"Ground floor\", 3 \"Attic\"";
        assert!(error.to_string().ends_with(known), "{error}");
    }
    assert!(none(&two_rooms(), "1").to_string().ends_with("hint: it has no levels"));
    let error = sweet_home(&file(&house()), "test", Some("attic")).unwrap_err();
    assert_eq!(error, ImportError::NoRooms);
}

#[test]
fn one_level_is_not_worth_a_remark() {
    let drawn = "<level id='l' name='Level' elevation='0'/>".to_owned() + &two_rooms();
    assert_eq!(import(&file(&drawn)).unwrap().remarks, [""; 0]);
}
