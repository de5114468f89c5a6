//! Plans written for tests, and the homes made from them.

use homebody_core::home::form::HomeFile;
use homebody_core::plan::Plan as FloorPlan;
use homebody_core::scenario::load::Scenario;
use homebody_import::{ImportError, Imported, sweet_home};
use std::collections::BTreeMap;
use std::io::{Cursor, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

pub fn archive(entries: &[(&str, &[u8])]) -> Vec<u8> {
    packed(entries, CompressionMethod::Deflated)
}

pub fn packed(entries: &[(&str, &[u8])], method: CompressionMethod) -> Vec<u8> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in entries {
        writer.start_file(*name, SimpleFileOptions::default().compression_method(method)).unwrap();
        writer.write_all(bytes).unwrap();
    }
    writer.finish().unwrap().into_inner()
}

/// A file with a drawing and unused entries.
pub fn file(drawn: &str) -> Vec<u8> {
    let xml =
        format!("<?xml version='1.0'?>\n<home version='7200' name='test.sh3d' wallHeight='250'>\n{drawn}\n</home>");
    archive(&[("Home", b"\xac\xed\x00\x05"), ("Home.xml", xml.as_bytes()), ("1/chair.obj", b"v 0 0 0")])
}

pub fn wall(from: [f64; 2], to: [f64; 2]) -> String {
    let ([x1, y1], [x2, y2]) = (from, to);
    format!(
        "<wall id='w{x1}{y1}{x2}{y2}' xStart='{x1}' yStart='{y1}' xEnd='{x2}' yEnd='{y2}' height='250' thickness='20'/>\n"
    )
}

pub fn room(name: &str, corners: &[[f64; 2]]) -> String {
    let points: String = corners.iter().map(|[x, y]| format!("<point x='{x}' y='{y}'/>")).collect();
    format!("<room id='r' name='{name}'>{points}</room>\n")
}

/// A door 90 cm wide, unless `more` overrides it.
pub fn door(name: &str, [x, y]: [f64; 2], angle: f64, more: &str) -> String {
    let width = if more.contains("width=") { "" } else { "width='90'" };
    format!(
        "<doorOrWindow id='d' name='{name}' x='{x}' y='{y}' angle='{angle}' {width} depth='20' height='210' {more}/>\n"
    )
}

pub fn piece(name: &str, [x, y]: [f64; 2], [width, depth, height]: [f64; 3], more: &str) -> String {
    format!(
        "<pieceOfFurniture id='p' name='{name}' x='{x}' y='{y}' width='{width}' depth='{depth}' height='{height}' {more}/>\n"
    )
}

/// The walls of a flat 8 m wide and 4 m deep, with a wall between its rooms at 5 m.
pub fn two_rooms_walls() -> String {
    [
        wall([100.0, 100.0], [900.0, 100.0]),
        wall([900.0, 100.0], [900.0, 500.0]),
        wall([900.0, 500.0], [100.0, 500.0]),
        wall([100.0, 500.0], [100.0, 100.0]),
        wall([600.0, 100.0], [600.0, 500.0]),
    ]
    .concat()
}

/// The flat with its rooms, drawn between the faces of the walls, and two doors.
pub fn two_rooms() -> String {
    [
        two_rooms_walls(),
        room("Living room", &[[110.0, 110.0], [590.0, 110.0], [590.0, 490.0], [110.0, 490.0]]),
        room("Bedroom", &[[610.0, 110.0], [890.0, 110.0], [890.0, 490.0], [610.0, 490.0]]),
        door("Front door", [200.0, 500.0], 0.0, ""),
        door("Bedroom door", [600.0, 200.0], std::f64::consts::FRAC_PI_2, ""),
    ]
    .concat()
}

pub fn import(file: &[u8]) -> Result<Imported, ImportError> {
    sweet_home(file, "test", None)
}

/// A home that was imported and has passed the check, with the remarks.
pub struct Home {
    pub file: HomeFile,
    pub plan: FloorPlan,
    pub text: String,
    pub remarks: Vec<String>,
}

impl Home {
    #[track_caller]
    pub fn of(drawn: &str) -> Home {
        Home::from(import(&file(drawn)).unwrap_or_else(|error| panic!("{error}\n{drawn}")))
    }

    #[track_caller]
    pub fn from(Imported { home_json, remarks }: Imported) -> Home {
        let scenario =
            r#"{ "name": "a", "start": "2026-01-05T00:00:00", "days": 1, "home": "home.json", "residents": [] }"#;
        let files = [("scenario.json", scenario), ("home.json", &home_json)];
        let files: BTreeMap<String, String> = files.map(|(name, text)| (name.to_owned(), text.to_owned())).into();
        let scenario = Scenario::load(&files, "scenario.json");
        let file = scenario.unwrap_or_else(|problems| panic!("{}\n{home_json}", problems.render())).home;
        Home { plan: file.plan().clone(), file: HomeFile::clone(&file), text: home_json, remarks }
    }

    pub fn rooms(&self) -> Vec<&str> {
        self.file.rooms.iter().map(|room| room.name.as_str()).collect()
    }

    /// The rooms on both sides of a door, by name, in their order.
    pub fn joins(&self, door: &str) -> [Option<&str>; 2] {
        let door = self.file.doors.iter().find(|known| known.name == door).unwrap();
        let (from, to) = (homebody_core::geometry::point(door.from), homebody_core::geometry::point(door.to));
        let out = (to - from).normalize().perp() * 0.3;
        let mut rooms = [1.0, -1.0].map(|side| self.plan.room_at((from + to) / 2.0 + out * side));
        rooms.sort();
        rooms.map(|room| room.map(|room| self.file.rooms[room].name.as_str()))
    }

    #[track_caller]
    pub fn remarks(&self, wanted: &str) {
        assert!(self.remarks.iter().any(|remark| remark.contains(wanted)), "{wanted:?} is not in {:#?}", self.remarks);
    }
}
