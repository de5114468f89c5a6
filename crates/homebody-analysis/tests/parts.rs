//! The parts list of a home, with directions to each part, and the comparison of two layouts.

use crate::home::two_rooms;
use homebody_analysis::parts::{PartsList, SensorLayout, beside};
use homebody_core::home::form::HomeFile;
use homebody_core::resident::Build;
use serde_json::{Value, json};

/// The living room is 5 x 4 m from the south-west corner on; walls are 10 cm thick, half of it inside.
fn with(sensors: Value) -> HomeFile {
    two_rooms(
        json!([{ "name": "bed", "at": [7.2, 3.0], "size_m": [1.4, 1.8], "height_m": 0.6, "enterable": true }]),
        sensors,
    )
}

fn place(sensor: Value) -> String {
    PartsList::from_home(&with(json!([sensor]))).parts[0].place.clone()
}

#[test]
fn gives_places_by_two_walls() {
    let on_wall = |at: [f64; 2], facing: f64| {
        place(json!({ "kind": "motion", "name": "a", "at": at, "height_m": 2.0, "facing_deg": facing }))
    };
    assert_eq!(on_wall([1.2, 3.95], 270.0), "on the north wall, 1.15 m from the west wall");
    assert_eq!(on_wall([4.0, 3.95], 270.0), "on the north wall, 0.95 m from the east wall");
    assert_eq!(on_wall([4.95, 3.0], 180.0), "on the east wall, 0.95 m from the north wall");
    // In the bedroom, the same wall is its west wall.
    assert_eq!(on_wall([5.05, 0.8], 0.0), "on the west wall, 0.75 m from the south wall");
    assert!(on_wall([0.1, 0.1], 45.0).starts_with("in the corner of the "), "{}", on_wall([0.1, 0.1], 45.0));
    let ceiling = json!({ "kind": "ceiling_motion", "name": "a", "area": [[0.5, 2], [1.5, 2], [1.5, 3], [0.5, 3]] });
    let told = "on the ceiling, 0.95 m from the west wall and 1.45 m from the north wall; looks down on 1.0 x 1.0 m";
    assert_eq!(place(ceiling), told);
    assert_eq!(
        place(json!({ "kind": "bed", "name": "a", "on": "bed" })),
        "at bed, 0.75 m from the east wall and 0.95 m from the north wall"
    );
    assert_eq!(
        place(json!({ "kind": "contact", "name": "a", "on": "front door" })),
        "at front door, 0.05 m from the south wall and 1.40 m from the west wall"
    );
    assert_eq!(place(json!({ "kind": "light", "name": "a", "room": "bedroom" })), "anywhere in bedroom");
}

#[test]
fn gives_aims_by_wall_and_compass() {
    let looks = |facing: f64| {
        let sensor = json!({ "kind": "motion", "name": "a", "at": [2.0, 3.95], "height_m": 2.4, "facing_deg": facing });
        PartsList::from_home(&with(json!([sensor]))).parts[0].looks.clone().unwrap()
    };
    assert_eq!(looks(270.0), "south, straight out from the wall");
    // With the back to the north wall, the east is to the left.
    assert_eq!(looks(315.0), "south-east, 45° to the left of straight out");
    assert_eq!(looks(225.0), "south-west, 45° to the right of straight out");
}

#[test]
fn devices_are_counted_and_the_table_can_be_read() {
    let of = |name: &str, preset: &str| json!({ "kind": "motion", "name": name, "at": [2.0, 3.95], "facing_deg": 270, "preset": preset });
    let home = with(json!([of("a", "hue"), of("=b, \"c\"", "fibaro"), of("d", "fibaro")]));
    let parts = PartsList::from_home(&home);
    let counts: Vec<(&str, usize)> = parts.devices.iter().map(|count| (&*count.device, count.count)).collect();
    assert_eq!(counts, [("Fibaro FGMS-001", 2), ("Philips Hue motion sensor", 1)]);
    let csv = parts.csv();
    let rows: Vec<&str> = csv.lines().collect();
    assert_eq!(rows.len(), 4);
    // Quoted, and no formula where a spreadsheet opens it.
    assert!(rows[2].starts_with("2,\"'=b, \"\"c\"\"\",Fibaro FGMS-001,Z-Wave,,living room,"), "{}", rows[2]);
    assert!(parts.to_string().contains("   2  Fibaro FGMS-001\n"), "{parts}");
}

#[test]
fn two_layouts_differ_in_what_was_changed_and_in_nothing_else() {
    let motion = |name: &str, at: [f64; 2], facing: f64, preset: &str| json!({ "kind": "motion", "name": name, "at": at, "facing_deg": facing, "preset": preset });
    let first = with(json!([
        motion("stays", [2.0, 3.95], 270.0, "paper"),
        motion("turns", [5.05, 0.8], 0.0, "paper"),
        motion("goes", [1.0, 3.95], 270.0, "paper")
    ]));
    let second = with(json!([
        motion("stays", [2.0, 3.95], 270.0, "paper"),
        motion("turns", [5.05, 1.0], 30.0, "hue"),
        motion("comes", [3.0, 3.95], 270.0, "aqara")
    ]));
    let layout = |name, home| SensorLayout { name, home, build: Build::adult() };
    let both = beside([layout("one", &first), layout("two", &second)]);
    let differences: Vec<(&str, &str)> = both.differences.iter().map(|one| (&*one.sensor, &*one.what)).collect();
    assert_eq!(differences.iter().map(|one| one.0).collect::<Vec<_>>(), ["turns", "goes", "comes"]);
    assert!(differences[0].1.starts_with("is Philips Hue motion sensor instead of "), "{}", differences[0].1);
    assert!(differences[0].1.contains("looks to 30° instead of 0°"), "{}", differences[0].1);
    assert!(
        differences[1].1.starts_with("goes: ") && differences[2].1.starts_with("comes: Aqara RTCGQ11LM, on the north")
    );
    assert!(both.layouts.iter().all(|layout| layout.rooms.len() == 2 && layout.whole.floor_m2 > 20.0));
    // The control: a layout compared with itself.
    assert_eq!(beside([layout("one", &first), layout("one", &first)]).differences, []);
}
