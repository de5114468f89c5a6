//! Plans of several levels: a home is one of them.

use crate::plan::{Home, file, import, piece, room, two_rooms, wall};
use homebody_import::{NotImported, sweet_home};

/// A house: a cellar of one room, the flat above it, and an attic without walls.
fn house() -> String {
    let on = |level: &str, drawn: &str| {
        let with = |tag: &str| (format!("<{tag} id="), format!("<{tag} level='{level}' id="));
        ["wall", "room", "doorOrWindow", "pieceOfFurniture"]
            .into_iter()
            .map(with)
            .fold(drawn.to_owned(), |text, (a, b)| text.replace(&a, &b))
    };
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
fn the_level_with_the_most_walls_is_taken() {
    let home = Home::of(&house());
    assert_eq!(home.rooms(), ["Living room", "Bedroom"]);
    home.remarks(
        "of 3 levels, this is 2 \"Ground floor\", which has the most walls; left out are 1 \"Cellar\", 3 \"Attic\"",
    );
    assert_eq!(home.file.about, "The level \"Ground floor\" of a plan made with Sweet Home 3D.");
    assert!(home.file.furniture.is_empty(), "a group's pieces are on its level");
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
        assert!(matches!(error, NotImported::NoSuchLevel { .. }));
        let known = "hint: it has 1 \"Cellar\", 2 \"Ground floor\", 3 \"Attic\"";
        assert!(error.to_string().ends_with(known), "{error}");
    }
    assert!(none(&two_rooms(), "1").to_string().ends_with("hint: it has no levels"));
    let error = sweet_home(&file(&house()), "test", Some("attic")).unwrap_err();
    assert_eq!(error, NotImported::NoRooms);
}

#[test]
fn one_level_is_not_worth_a_remark() {
    let drawn = "<level id='l' name='Level' elevation='0'/>".to_owned() + &two_rooms();
    assert_eq!(import(&file(&drawn)).unwrap().remarks, [""; 0]);
}
