//! Features of real plans, each in a small plan: flat things, names in other languages, low windows, thick walls, gaps.

use crate::plans::plan::{Home, archive, door, import, piece, room, two_rooms, two_rooms_walls, wall};
use homebody_core::geometry::{self, Point};
use homebody_core::plan::form::FurnitureFile;
use homebody_core::role::Role;
use homebody_import::ImportError;
use std::f64::consts::FRAC_PI_2;

/// The furniture that one piece in the flat becomes.
fn of(name: &str, catalog: &str, size: [f64; 3]) -> FurnitureFile {
    let drawn = piece(name, [300.0, 300.0], size, &format!("catalogId='{catalog}'"));
    Home::of(&(two_rooms() + &drawn)).file.furniture[0].clone()
}

#[test]
fn flat_pieces_are_no_obstacles() {
    let carpet = |height: f64| piece("Box", [600.0, 200.0], [200.0, 200.0, height], "catalogId='eTeks#texturableBox'");
    let is_open = |height: f64| Home::of(&(two_rooms() + &carpet(height))).plan.is_walkable(Point::new(5.0, 3.0), 0.22);
    assert!(is_open(0.5) && is_open(5.0) && !is_open(6.0));
    // Its top counts, not its thickness.
    let shelf = "catalogId='eTeks#texturableBox' elevation='90'";
    let home = Home::of(&(two_rooms() + &piece("Box", [600.0, 200.0], [200.0, 200.0, 2.0], shelf)));
    assert!(!home.plan.is_walkable(Point::new(5.0, 3.0), 0.22));
}

#[test]
fn identifies_pieces_by_catalogue_then_name_and_shape() {
    let seat = [45.0, 45.0, 90.0];
    for (name, catalog, size, role) in [
        ("Letto", "eTeks#bed140x190", [140.0, 190.0, 60.0], Role::Bed),
        ("Bed cherry", "", [140.0, 190.0, 60.0], Role::Bed),
        ("Doppelbett", "", [180.0, 200.0, 60.0], Role::Bed),
        ("Toilet unit", "eTeks#toiletUnit", [40.0, 80.0, 62.0], Role::Toilet),
        ("Fridge &amp; Freezer", "eTeks#fridgeFreezer", [60.0, 66.0, 185.0], Role::Fridge),
        ("Kühlschrank", "", [60.0, 66.0, 185.0], Role::Fridge),
        ("冰箱", "", [60.0, 66.0, 185.0], Role::Fridge),
        ("Corner sofa", "eTeks#cornerSofa", [230.0, 160.0, 87.0], Role::Sofa),
        ("Oma", "Scopia#arm_chair", [80.0, 80.0, 90.0], Role::Armchair),
        ("Kitchen chair 2", "", seat, Role::DiningSeat),
        ("Stool", "eTeks#stool", [40.0, 40.0, 46.0], Role::DiningSeat),
        ("Flat TV", "eTeks#flatTV", [110.0, 17.0, 67.0], Role::Television),
        ("Clothes washer", "eTeks#clothesWasher", [60.0, 63.0, 85.0], Role::WashingMachine),
    ] {
        assert_eq!(of(name, catalog, size).role, Some(role), "{name}");
    }
    // A doll's bed does not count.
    assert_eq!(of("Old bed", "eTeks#bed", [30.0, 50.0, 20.0]).role, None);
    for (name, catalog, size) in [
        ("Bed table", "", [60.0, 200.0, 60.0]),
        ("Toilet paper", "", [40.0, 40.0, 40.0]),
        ("TV bench", "", [150.0, 45.0, 50.0]),
        ("Box", "eTeks#texturableBox", [140.0, 190.0, 60.0]),
        ("Chairman desk", "", [140.0, 70.0, 75.0]),
    ] {
        let role = of(name, catalog, size).role;
        assert!(role.is_none_or(|role| role == Role::Television), "{name} {role:?}");
        assert!(!of(name, catalog, size).enterable, "{name}");
    }
    // If its own name gives the role, nothing is added.
    assert_eq!(of("Sofa", "eTeks#sofa", [147.0, 87.0, 87.0]).role, None);
    // A stool is for the table only without a chair.
    let both = piece("Stool", [300.0, 300.0], [40.0, 40.0, 46.0], "") + &piece("Stuhl", [200.0, 300.0], seat, "");
    let roles: Vec<_> = Home::of(&(two_rooms() + &both)).file.furniture.iter().map(|piece| piece.role).collect();
    assert_eq!(roles, [None, Some(Role::DiningSeat)]);
}

#[test]
fn rooms_with_other_names_have_places_that_roles_know() {
    let drawn = |room: &str, more: &str| Home::of(&(two_rooms().replace("Living room", room) + more));
    let places = |home: &Home| home.file.places.iter().map(|place| place.name.clone()).collect::<Vec<_>>();
    assert_eq!(places(&drawn("Kitchen/Dining", "")), ["kitchen"]);
    assert_eq!(places(&drawn("Bagno", "")), ["bathroom"]);
    assert_eq!(places(&drawn("Wohnzimmer", "")), ["living room"]);
    assert_eq!(places(&drawn("Kitchen", "")), [""; 0]);
    // A room with a fridge need not be a kitchen; a room with a cooker is one, whatever its name.
    let fridge = piece("Kühlschrank", [200.0, 200.0], [60.0, 60.0, 180.0], "");
    assert_eq!(places(&drawn("Cucina", &fridge)), [""; 0]);
    let cooker = piece("Cooker", [850.0, 460.0], [60.0, 60.0, 85.0], "catalogId='eTeks#cooker'");
    let home = drawn("Flat", &cooker);
    assert_eq!(places(&home), ["kitchen"]);
    let at = geometry::point(home.file.places[0].at);
    assert_eq!(home.plan.room_at(at), home.file.rooms.iter().position(|room| room.name == "Bedroom"));
    assert!(at.distance(Point::new(7.5, 0.4)) < 1.0 && home.plan.is_walkable(at, 0.25), "{at}");
}

#[test]
fn windows_that_reach_the_floor_are_doors_unless_they_are_fixed() {
    let opening = |name: &str, catalog: &str, more: &str| {
        let more = format!("catalogId='{catalog}' {more}");
        Home::of(&(two_rooms() + &door(name, [400.0, 100.0], 0.0, &more))).file.doors.len() == 3
    };
    assert!(opening("Slider window", "eTeks#sliderWindow126x200", "elevation='11'"));
    assert!(opening("Finestra", "eTeks#doubleWindow126x163", ""));
    assert!(!opening("Fixed window", "eTeks#fixedWindow85x123", "elevation='10'"));
    assert!(!opening("Window", "eTeks#window85x123", "elevation='87'"));
    assert!(!opening("Slider window", "eTeks#sliderWindow126x200", "elevation='25'"));
    let low = door("Window", [400.0, 100.0], 0.0, "catalogId='eTeks#window'").replace("height='210'", "height='120'");
    assert_eq!(Home::of(&(two_rooms() + &low)).file.doors.len(), 2);
    // People come home by a door rather than by such a window, and by a front door rather than by another.
    let window = door("Finestra", [400.0, 100.0], 0.0, "catalogId='eTeks#doubleWindow126x163'");
    let back = door("Back door", [800.0, 100.0], 0.0, "");
    let home = Home::of(&(window + &back + &two_rooms()));
    let names: Vec<_> = home.file.doors.iter().map(|door| (&door.name[..], door.outside)).collect();
    assert_eq!(names, [("Front door", true), ("Finestra", true), ("Back door", true), ("Bedroom door", false)]);
}

#[test]
fn walls_that_end_at_the_face_of_a_thick_wall_are_joined() {
    let thick = |from, to| wall(from, to).replace("thickness='20'", "thickness='60'");
    let drawn = [
        thick([100.0, 100.0], [900.0, 100.0]),
        thick([900.0, 100.0], [900.0, 500.0]),
        thick([900.0, 500.0], [100.0, 500.0]),
        thick([100.0, 500.0], [100.0, 100.0]),
        // From face to face.
        wall([600.0, 130.0], [600.0, 470.0]),
        door("Front door", [300.0, 500.0], 0.0, ""),
        door("Bedroom door", [600.0, 200.0], FRAC_PI_2, ""),
    ];
    let home = Home::of(&drawn.concat());
    let mut areas: Vec<f64> = home.plan.rooms.iter().map(|room| geometry::signed_area(&room.outline).abs()).collect();
    areas.sort_by(f64::total_cmp);
    assert_eq!(areas, [12.0, 20.0]);
    assert!(!home.file.doors[1].outside && home.joins("Bedroom door").iter().all(Option::is_some));
    // Pillars are short thick walls, which others meet from all sides.
    let pillar = "<wall id='p' xStart='80' yStart='100' xEnd='130' yEnd='100' height='250' thickness='50'/>";
    let around = [
        wall([130.0, 84.0], [900.0, 84.0]),
        wall([900.0, 84.0], [900.0, 500.0]),
        wall([900.0, 500.0], [100.0, 500.0]),
        wall([100.0, 500.0], [100.0, 125.0]),
        wall([600.0, 84.0], [600.0, 500.0]),
        door("Front door", [300.0, 500.0], 0.0, ""),
    ];
    let around = around.concat() + pillar;
    assert_eq!(Home::of(&around).file.rooms.len(), 2);
    // One that ends a hand's breadth before it encloses nothing.
    let apart = drawn.concat().replace("yStart='130'", "yStart='150'");
    assert_eq!(Home::of(&apart).file.rooms.len(), 1);
}

#[test]
fn doors_in_gaps_between_walls_are_doors() {
    let gap = wall([600.0, 100.0], [600.0, 160.0]) + &wall([600.0, 245.0], [600.0, 500.0]);
    let walls = two_rooms_walls().replace(&wall([600.0, 100.0], [600.0, 500.0]), &gap);
    let drawn =
        walls.clone() + &door("Front door", [200.0, 500.0], 0.0, "") + &door("Door", [600.0, 200.0], FRAC_PI_2, "");
    let home = Home::of(&drawn);
    home.remarks("1 door is drawn in a gap between walls");
    home.remarks("2 spaces that walls enclose are rooms now");
    assert_eq!(home.file.rooms.len(), 2);
    assert!(home.joins("Door").iter().all(Option::is_some) && home.file.doors[0].name == "Front door");
    // From the end of a wall to the face of another.
    let corner = walls.replace(&gap, &wall([600.0, 200.0], [600.0, 500.0]));
    let drawn = corner + &door("Front door", [200.0, 500.0], 0.0, "") + &door("Door", [600.0, 155.0], FRAC_PI_2, "");
    assert!(Home::of(&drawn).joins("Door").iter().all(Option::is_some));
}

#[test]
fn gaps_between_rooms_without_a_door_are_passages() {
    let gap = wall([600.0, 100.0], [600.0, 200.0]) + &wall([600.0, 350.0], [600.0, 500.0]);
    let drawn = two_rooms().replace(&wall([600.0, 100.0], [600.0, 500.0]), &gap);
    let drawn = drawn.replace(&door("Bedroom door", [600.0, 200.0], FRAC_PI_2, ""), "");
    let home = Home::of(&drawn);
    home.remarks("1 gap between walls is a passage");
    assert_eq!(home.joins("passage"), [Some("Living room"), Some("Bedroom")]);
    // A room that continues through the gap needs none.
    let through = room("Flat", &[[110.0, 110.0], [890.0, 110.0], [890.0, 490.0], [110.0, 490.0]]);
    let front = door("Front door", [200.0, 500.0], 0.0, "");
    let walls = two_rooms_walls().replace(&wall([600.0, 100.0], [600.0, 500.0]), &gap);
    assert_eq!(Home::of(&(walls + &through + &front)).file.doors.len(), 1);
}

#[test]
fn proposes_a_way_out_if_no_door_leads_out() {
    let front = door("Front door", [200.0, 500.0], 0.0, "");
    let home = Home::of(&two_rooms().replace(&front, "").replace("Living room", "Hall"));
    let remark = home.remarks.iter().find(|remark| remark.contains("no door leads out")).unwrap();
    assert!(remark.ends_with("for which there is room in \"Hall\""), "{remark}");
    let (_, door) = remark.split_once("add to \"doors\" ").unwrap();
    let (door, _) = door.split_once(", for which").unwrap();
    // The suggested line is valid.
    let text = home.text.replacen("\"doors\": [\n", &format!("\"doors\": [\n    {door},\n"), 1);
    assert_ne!(text, home.text);
    let mended = Home::from(homebody_import::Imported { home_json: text, remarks: Vec::new() });
    assert!(mended.file.doors[0].outside && mended.joins("front door").contains(&Some("Hall")));
}

#[test]
fn old_files_say_how_they_are_saved_anew() {
    let error = import(&archive(&[("Home", b"\xac\xed\x00\x05"), ("0", b"v 0 0 0")])).unwrap_err();
    assert_eq!(error, ImportError::OnlyJava);
    assert!(error.to_string().contains("File > Save as"), "{error}");
    assert_eq!(import(&archive(&[("readme.txt", b"no plan")])).unwrap_err(), ImportError::NoHomeXml);
}

#[test]
fn a_plan_without_its_archive_is_read() {
    let xml = |head: &str| format!("{head}<home version='7200' name='a'>{}</home>", two_rooms());
    for head in ["<?xml version='1.0'?>\n", "\u{feff}<?xml version='1.0'?>", "", "  \n"] {
        assert_eq!(Home::from(import(xml(head).as_bytes()).unwrap()).rooms(), ["Living room", "Bedroom"], "{head:?}");
    }
    assert_eq!(import(b"<?xml version='1.0'?><house name='a'/>").unwrap_err(), ImportError::NoArchive);
}

#[test]
fn files_of_other_forms_lead_to_what_takes_them() {
    let said = |bytes: &[u8]| import(bytes).unwrap_err().to_string();
    for (bytes, form, hint) in [
        (&b"\x89PNG\r\n\x1a\n\0"[..], "an image in PNG", "homebody new my-home --image plan.png"),
        (b"\xff\xd8\xff\xe1", "an image in JPEG", "homebody new my-home --image"),
        (b"%PDF-1.4\n", "a PDF", "save it as an image in PNG"),
        (b"<svg xmlns='http://www.w3.org/2000/svg'/>", "an image in SVG", "homebody serve"),
        (b"0\nSECTION\n2\nENTITIES\n", "a drawing in DXF", "draw the plan in Sweet Home 3D"),
        (b"ISO-10303-21;\n", "a building in IFC", "draw the plan in Sweet Home 3D"),
        (b"rooms:\n  - name: a\n    points:\n", "a floor plan of ESPresense in YAML", "draw the plan"),
        (b"{ \"walls\": [] }", "a plan in JSON", "draw the plan"),
    ] {
        let said = said(bytes);
        assert!(said.starts_with(&format!("this is not a Sweet Home 3D file: it is {form}")), "{said}");
        assert!(said.contains("\n  hint: ") && said.contains(hint), "{said}");
    }
    let packed = archive(&[("flat/mine.sh3d", b"PK")]);
    assert!(said(&packed).contains("unpack it, and name the .sh3d file"), "{}", said(&packed));
}

#[test]
fn rooms_that_nearly_meet_where_no_wall_is_are_joined() {
    let open = two_rooms_walls().replace(&wall([600.0, 100.0], [600.0, 500.0]), "");
    let west = room("West", &[[110.0, 110.0], [594.0, 110.0], [594.0, 490.0], [110.0, 490.0]]);
    let east = |from: f64| room("East", &[[from, 110.0], [890.0, 110.0], [890.0, 490.0], [from, 490.0]]);
    let front = door("Front door", [200.0, 500.0], 0.0, "");
    let is_joined = |from: f64| {
        let plan = Home::of(&[open.clone(), west.clone(), east(from), front.clone()].concat()).plan;
        (0..=40).all(|step| plan.is_walkable(Point::new(4.6 + 0.02 * f64::from(step), 2.0), 0.22))
    };
    assert!(is_joined(594.0) && is_joined(594.6) && is_joined(612.0));
    assert!(!is_joined(640.0));
    // A wall between them separates them.
    let walled = Home::of(&[two_rooms_walls(), west, east(606.0), front].concat());
    assert_eq!(walled.file.doors.len(), 1);
}
