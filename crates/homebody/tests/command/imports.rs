//! Beginning a scenario from a plan of Sweet Home 3D.

use crate::folder::Folder;
use std::io::{Cursor, Write};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// A room of 6 by 4 metres with a front door.
const ROOM: &str = "
    <wall xStart='0' yStart='0' xEnd='600' yEnd='0' thickness='20'/>
    <wall xStart='600' yStart='0' xEnd='600' yEnd='400' thickness='20'/>
    <wall xStart='600' yStart='400' xEnd='0' yEnd='400' thickness='20'/>
    <wall xStart='0' yStart='400' xEnd='0' yEnd='0' thickness='20'/>
    <room name='Kitchen'><point x='10' y='10'/><point x='590' y='10'/><point x='590' y='390'/><point x='10' y='390'/></room>
    <doorOrWindow name='Front door' x='300' y='400' width='90' depth='20' height='210'/>
    <doorOrWindow name='Window' x='300' y='0' width='90' depth='20' height='110' elevation='90'/>";

/// What an ordinary life needs besides.
const FURNITURE: &str = "
    <pieceOfFurniture name='Bed' x='110' y='80' width='140' depth='200' height='50' angle='1.5707964'/>
    <pieceOfFurniture name='Toilet' x='550' y='50' width='40' depth='60' height='45'/>
    <pieceOfFurniture name='Armchair' x='500' y='300' width='80' depth='80' height='90'/>";

pub fn plan(drawn: &str) -> Vec<u8> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    writer.start_file("Home.xml", SimpleFileOptions::default()).unwrap();
    write!(writer, "<?xml version='1.0'?><home version='7200'>{drawn}</home>").unwrap();
    writer.finish().unwrap().into_inner()
}

#[test]
fn a_plan_becomes_a_scenario_in_which_somebody_lives() {
    let folder = Folder::new();
    folder.write("flat.sh3d", plan(&format!("{ROOM}{FURNITURE}")));
    let said = folder.run("import flat.sh3d homes/mine").ok().err;
    assert!(said.contains("flat.sh3d: left out: 1 window"), "{said}");
    assert!(said.contains("homes/mine is ready: 1 room, 1 door, 3 pieces of furniture"), "{said}");
    assert!(said.ends_with("\n  homebody check homes/mine\n  homebody serve homes/mine\n"), "{said}");
    assert!(folder.path("homes/mine/schemas/home.schema.json").is_file());
    assert!(folder.read("homes/mine/scenario.json").contains("\"name\": \"mine\""));
    folder.run("check homes/mine").ok();
    folder.run("routine explain homes/mine").ok();
    let home = folder.read("homes/mine/home.json");
    let sensor =
        "\"sensors\": [{ \"kind\": \"motion\", \"name\": \"motion\", \"at\": [5.88, 3.88], \"facing_deg\": 225 }]";
    folder.write("homes/mine/home.json", home.replace("\n  ]\n}", &format!("\n  ],\n  {sensor}\n}}")));
    folder.run("run homes/mine --for 1d --quiet --out csv:log.csv").ok();
    assert!(folder.read("log.csv").lines().count() > 100, "a day has firings");
}

#[test]
fn where_nobody_can_live_somebody_stands() {
    let folder = Folder::new();
    folder.write("room.sh3d", plan(ROOM));
    let said = folder.run("import room.sh3d mine").ok().err;
    let lack =
        "nobody can live an ordinary life here yet: there is nowhere in this home to sleep\n  hint: give it a piece";
    assert!(said.contains(lack), "{said}");
    assert!(folder.path("mine/anna.path.json").is_file() && !folder.path("mine/anna.routine").exists());
    folder.run("check mine").ok();
    folder.run("run mine --for 1h --quiet --out csv:log.csv").ok();
    // A room that is all furniture.
    let full = "<pieceOfFurniture name='Block' x='300' y='200' width='580' depth='380' height='90'/>";
    folder.write("full.sh3d", plan(&format!("{ROOM}{full}")));
    folder.run("import full.sh3d full").ok();
    assert!(folder.read("full/scenario.json").contains("\"residents\": []"));
    folder.run("check full").ok();
}

#[test]
fn who_does_all_that_is_said_has_a_home_to_live_in() {
    let folder = Folder::new();
    let bare = ROOM.replace("Kitchen", "Room");
    folder.write("room.sh3d", plan(&bare));
    let said = folder.run("import room.sh3d mine").ok().err;
    let hints = said.lines().filter_map(|line| line.split_once("there is room in \"Room\": add to \"furniture\" "));
    let pieces: Vec<&str> = hints.map(|(_, piece)| piece).collect();
    assert_eq!(pieces.len(), 4, "a bed, a toilet, a seat, a fridge: {said}");
    let home = folder.read("mine/home.json");
    let furnished = home.replacen("\"furniture\": []", &format!("\"furniture\": [{}]", pieces.join(", ")), 1);
    folder.write("mine/home.json", furnished);
    folder.write("mine/anna.json", r#"{ "name": "anna", "driver": { "routine": "anna.routine" } }"#);
    folder.write("mine/anna.routine", "Anna is 80.\n");
    folder.run("check mine").ok();
    // Each is needed.
    for index in 0..pieces.len() {
        let others: Vec<&str> =
            pieces.iter().enumerate().filter(|(other, _)| *other != index).map(|(_, piece)| *piece).collect();
        folder.write(
            "mine/home.json",
            home.replacen("\"furniture\": []", &format!("\"furniture\": [{}]", others.join(", ")), 1),
        );
        let is_bed = pieces[index].contains("\"bed\"");
        // Whoever has no bed sleeps in an armchair.
        assert_eq!(folder.run("check mine").code, Some(if is_bed { 0 } else { 2 }), "{}", pieces[index]);
    }
}

#[test]
fn walls_across_each_other_do_not_break_it_down() {
    let folder = Folder::new();
    let across = |index: u32| {
        let (sin, cos) = f64::from(index).sin_cos();
        let ([x, y], [to_x, to_y]) =
            ([300.0 - 250.0 * cos, 200.0 - 150.0 * sin], [300.0 + 250.0 * cos, 200.0 + 150.0 * sin]);
        format!("<wall xStart='{x}' yStart='{y}' xEnd='{to_x}' yEnd='{to_y}' thickness='1'/>")
    };
    let star = |count: u32| plan(&format!("{ROOM}{FURNITURE}{}", (0..count).map(across).collect::<String>()));
    folder.write("star.sh3d", star(150));
    let said = folder.run("import star.sh3d mine").ok().err;
    assert!(said.contains("nobody can live an ordinary life here yet: anna cannot get from"), "{said}");
    folder.run("check mine").ok();
    folder.write("star.sh3d", star(2_000));
    folder.run("import star.sh3d other").fails(2, "meet or cross each other more than 20000 times\n  hint:");
}

#[test]
fn what_is_there_stays_and_what_fails_leaves_nothing() {
    let folder = Folder::new();
    folder.write("flat.sh3d", plan(ROOM));
    folder.write("text.sh3d", "no plan");
    folder.write("old.sh3d", plan("<level id='a' name='Ground floor' elevation='0'/>"));
    folder.write("mine/home.json", "precious");
    let given = folder.files();
    folder.run("import flat.sh3d mine").fails(1, "mine exists already\n  hint: name a folder that does not");
    folder.run("import none.sh3d new").fails(1, "none.sh3d: ");
    folder.run("import . new").fails(1, ".: ");
    folder
        .run("import text.sh3d new")
        .fails(2, "text.sh3d: this is no Sweet Home 3D file: it is no zip archive\n  hint: ");
    folder.run("import old.sh3d new").fails(2, "the plan has no rooms");
    folder
        .run("import old.sh3d new --level attic")
        .fails(2, "has no level \"attic\"\n  hint: it has 1 \"Ground floor\"");
    folder.run("import flat.sh3d").fails(2, "<FOLDER>");
    assert_eq!(folder.files(), given);
}

#[test]
fn a_level_is_chosen_by_its_name() {
    let folder = Folder::new();
    let level = "<level id='a' name='Below' elevation='-250'/><level id='b' name='Above' elevation='0'/>";
    let below =
        "<room name='Cellar' level='a'><point x='0' y='0'/><point x='0' y='300'/><point x='300' y='300'/></room>";
    let above = ROOM.replace("<wall ", "<wall level='b' ").replace("<room ", "<room level='b' ");
    folder.write("house.sh3d", plan(&format!("{level}{below}{above}{FURNITURE}")));
    let said = folder.run("import house.sh3d above").ok().err;
    assert!(
        said.contains("of 2 levels, this is 2 \"Above\", by which people come home; left out are 1 \"Below\""),
        "{said}"
    );
    folder.run("import house.sh3d below --level below").ok();
    assert!(folder.read("below/home.json").contains("Cellar") && folder.read("above/home.json").contains("Kitchen"));
    folder.run("check below").ok();
}
