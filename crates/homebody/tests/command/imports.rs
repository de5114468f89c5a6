//! Creating a scenario from a plan of Sweet Home 3D.

use crate::drawn_plans::{door, room, wall};
use crate::folder::Folder;
use std::f64::consts::FRAC_PI_2;
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

/// Further furniture for an ordinary routine.
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
fn a_home_that_lacks_something_says_so_until_it_is_there() {
    let folder = Folder::new();
    folder.write("room.sh3d", plan(ROOM));
    let said = folder.run("import room.sh3d mine").ok().err;
    let lack = "warning[new-home::routine-lacks]: the ordinary routine cannot run yet: the home has no place to sleep\n  hint: add an enterable piece";
    assert!(said.contains(lack) && said.contains("--furnish adds"), "{said}");
    assert!(folder.path("mine/anna.routine").is_file());
    folder.run("check mine").fails(2, "error[need::no-bed]").says(&["error[need::no-toilet]", "error[need::no-seat]"]);
    folder.run("run mine --for 1h --quiet --out csv:log.csv").fails(2, "error[need::no-bed]");
    folder.run("plan mine --svg plan.svg").ok();
    // A room that is all furniture.
    let full = "<pieceOfFurniture name='Block' x='300' y='200' width='580' depth='380' height='90'/>";
    folder.write("full.sh3d", plan(&format!("{ROOM}{full}")));
    for words in ["import full.sh3d full", "import full.sh3d furnished --furnish"] {
        folder.run(words).ok().says(&["no room has space to stand"]);
    }
    folder.run("check full").fails(2, "error[need::no-bed]");
}

/// Hours asleep, meals and visits to the bathroom on the first day of a run.
pub fn day(folder: &Folder, home: &str) -> [f64; 3] {
    folder.run(&format!("run {home} --for 1d --quiet --out csv:{home}.csv --truth sqlite:{home}.db")).ok();
    let number = |sql: &str| folder.query(&format!("{home}.db"), sql)[0].parse().unwrap_or(0.0);
    [
        number("SELECT sum(julianday(end_at) - julianday(begin_at)) * 24 FROM activity WHERE name = 'sleeping'"),
        number("SELECT count(*) FROM activity WHERE name LIKE 'eating_%'"),
        number("SELECT count(*) FROM activity WHERE name = 'using_bathroom'"),
    ]
}

/// Three rooms in a row, each with a door to the next, and a door out of the first. A fourth room has no door.
fn four_rooms(names: [&str; 4]) -> String {
    let corners = [[0.0, 0.0], [1600.0, 0.0], [1600.0, 400.0], [0.0, 400.0]];
    let outer = (0..4).map(|side| wall(corners[side], corners[(side + 1) % 4], 20.0));
    let inner = [400.0, 800.0, 1200.0].map(|x| wall([x, 0.0], [x, 400.0], 20.0));
    let walls: String = outer.chain(inner).collect();
    let lefts = [0.0, 400.0, 800.0, 1200.0];
    let rooms: String =
        names.iter().zip(lefts).map(|(name, x)| room(name, [x + 10.0, 10.0, x + 390.0, 390.0])).collect();
    let front = door("Front door", [200.0, 400.0], 0.0);
    let inside = ["A", "B"].iter().zip([400.0, 800.0]).map(|(name, x)| door(name, [x, 200.0], FRAC_PI_2));
    [walls, rooms, front].into_iter().chain(inside).collect()
}

#[test]
fn adds_what_a_plan_lacks_in_the_rooms_and_the_language_of_the_plan() {
    let folder = Folder::new();
    for (plan_of, named) in [
        (["Küche", "Schlafzimmer", "Bad", "Wohnzimmer"], ["Bett", "Sessel"]),
        (["cucina", "camera da letto", "bagno", "soggiorno"], ["letto", "poltrona"]),
    ] {
        folder.write("plan.sh3d", plan(&four_rooms(plan_of)));
        let name = plan_of[2].to_lowercase();
        let said = folder.run(&format!("import plan.sh3d {name} --furnish")).ok().err;
        assert!(!said.contains("ordinary routine cannot run yet"), "{said}");
        let added = |thing: &str, room: &str| {
            let told = format!("added, which the plan does not have: {thing:?} in {room:?}");
            assert!(said.contains(&told), "{told} is not in {said}");
        };
        let [bed, armchair] = named;
        added(bed, plan_of[1]);
        // Nobody gets into the living room, so that the armchair is elsewhere.
        assert!(said.contains(&format!("no resident can enter {:?}", plan_of[3])), "{said}");
        assert!(
            said.contains(&format!("{armchair:?} in ")) && !said.contains(&format!("{armchair:?} in {:?}", plan_of[3]))
        );
        // The kitchen and the bathroom are known by their names, so that neither fridge nor toilet is needed.
        folder.run(&format!("check {name}")).ok().says(&[&format!("no resident can enter {:?}", plan_of[3])]);
        let [asleep_h, meals, visits] = day(&folder, &name);
        assert!(asleep_h >= 4.0 && meals >= 2.0 && visits >= 2.0, "{asleep_h} {meals} {visits}");
        // The routine needs these pieces.
        folder.run(&format!("import plan.sh3d bare-{name}")).ok();
        let lacks = format!("there is room in {:?}: add to \"furniture\" {{\"name\": {bed:?}", plan_of[1]);
        folder.run(&format!("check bare-{name}")).fails(2, &lacks);
    }
}

#[test]
fn adds_reachable_pieces_for_unreachable_ones() {
    let folder = Folder::new();
    let beds = |x: u32| format!("<pieceOfFurniture name='Bed' x='{x}' y='110' width='140' depth='200' height='50'/>");
    let toilet = "<pieceOfFurniture name='Toilet' x='1560' y='350' width='40' depth='60' height='45'/>";
    let drawn = four_rooms(["Kitchen", "Bedroom", "Bathroom", "Guest room"]);
    folder.write("plan.sh3d", plan(&format!("{drawn}{}{toilet}", beds(1400))));
    folder.run("import plan.sh3d mine").ok().says(&["ordinary routine cannot run yet: anna cannot get from"]);
    folder
        .run("import plan.sh3d other --furnish")
        .ok()
        .says(&["\"bed 2\" in \"Bedroom\"", "\"toilet 2\" in \"Bathroom\""]);
    let [asleep_h, meals, visits] = day(&folder, "other");
    assert!(asleep_h >= 4.0 && meals >= 2.0 && visits >= 2.0, "{asleep_h} {meals} {visits}");
}

#[test]
fn the_check_says_what_keeps_a_life_or_a_log_from_coming() {
    let folder = Folder::new();
    folder.write("plan.sh3d", plan(&format!("{ROOM}{FURNITURE}")));
    folder.run("import plan.sh3d mine").ok();
    let said = folder.run("check mine").ok().err;
    assert!(said.contains("the home has no sensors") && !said.contains("no problems"), "{said}");
    // The proposed sensor is a valid line.
    let (_, sensor) = said.split_once("such as {").unwrap();
    let (sensor, _) = sensor.split_once("}; run `homebody suggest-sensors`").unwrap();
    let home = folder.read("mine/home.json");
    folder.write("mine/home.json", home.replace("\n  ]\n}", &format!("\n  ],\n  \"sensors\": [{{{sensor}}}]\n}}")));
    folder.run("check mine").ok().says(&["mine: no problems. 1 room, 1 door, 3 pieces of furniture, 1 sensor"]);
    // The check names a resident that waits forever, with the line that gives it a life.
    let wait = r#"{ "start": [3, 2], "steps": [{ "repeat": { "steps": [{ "wait": { "for_s": 60 } }] } }] }"#;
    folder.write("mine/anna.path.json", wait);
    folder.write("mine/anna.json", r#"{ "name": "anna", "driver": { "path": "anna.path.json" } }"#);
    let said = folder.run("check mine").ok().err;
    let what = "warning[life::waits]: anna.json: ";
    assert!(said.contains(what) && !said.contains("no problems"), "{said}");
    assert!(said.contains("write \"driver\": {\"routine\":\"anna.routine\"} in anna.json"), "{said}");
    folder.write("mine/anna.json", r#"{ "name": "anna", "driver": {"routine":"anna.routine"} }"#);
    assert!(folder.run("check mine").ok().err.contains("no problems"));
    let json = folder.run("check mine --json").ok().json();
    assert_eq!(json["warnings"].as_array().unwrap().len(), 0, "{json}");
    // Somebody who walks does not wait.
    let walk = r#"{ "start": [3, 2], "steps": [{ "repeat": { "steps": [{ "go": { "to": [[3, 2.5], [3, 2]] } }, { "wait": { "for_s": 60 } }] } }] }"#;
    folder.write("mine/anna.path.json", walk);
    folder.write("mine/anna.json", r#"{ "name": "anna", "driver": { "path": "anna.path.json" } }"#);
    assert!(folder.run("check mine").ok().err.contains("no problems"));
    folder.edit("mine/scenario.json", "\"residents\": [\"anna.json\"]", "\"residents\": []");
    assert!(folder.run("check mine").ok().err.contains("warning[life::no-residents]: scenario.json: "));
}

#[test]
fn following_all_hints_gives_a_habitable_home() {
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
        // A resident without a bed sleeps in an armchair.
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
    folder.run("import star.sh3d mine").ok().says(&["the ordinary routine cannot run yet: anna cannot get from"]);
    folder.run("check mine").fails(2, "anna cannot get from");
    folder.write("star.sh3d", star(2_000));
    folder.run("import star.sh3d other").fails(2, "meet or cross each other more than 20000 times\n  hint:");
}

#[test]
fn keeps_existing_files_and_leaves_nothing_after_an_error() {
    let folder = Folder::new();
    folder.write("flat.sh3d", plan(ROOM));
    folder.write("text.sh3d", "no plan");
    folder.write("old.sh3d", plan("<level id='a' name='Ground floor' elevation='0'/>"));
    folder.write("mine/home.json", "precious");
    let given = folder.files();
    folder.run("import flat.sh3d mine").fails(1, "[kit::exists]: mine");
    folder.run("import none.sh3d new").fails(1, "none.sh3d: ");
    folder.run("import . new").fails(1, "error[log::is-folder]");
    folder.run("import text.sh3d new").fails(2, "error[import::not-an-archive]: text.sh3d: ");
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
    folder
        .run("import house.sh3d above")
        .ok()
        .says(&["of 2 levels, this is 2 \"Above\", by which people come home; left out are 1 \"Below\""]);
    folder.run("import house.sh3d below --level below").ok();
    assert!(folder.read("below/home.json").contains("Cellar") && folder.read("above/home.json").contains("Kitchen"));
    folder.run("check below").fails(2, "error[need::no-bed]");
}
