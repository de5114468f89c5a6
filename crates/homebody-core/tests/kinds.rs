//! The list of sensor kinds agrees with the sensors and with the documents.

use homebody_core::home::Home;
use homebody_core::home::form::HomeFile;
use homebody_core::home::resolved::ResolvedHome;
use homebody_core::resident::Build;
use homebody_core::sensors::form::KindRow;
use homebody_core::sensors::kinds::{KINDS, SensorFile};
use serde_json::{Value, json};
use std::collections::BTreeSet;

#[test]
fn every_kind_has_a_key_and_a_label_of_its_own() {
    let keys: BTreeSet<&str> = KINDS.iter().map(|kind| kind.key).collect();
    let labels: BTreeSet<&str> = KINDS.iter().map(|kind| kind.label).collect();
    assert_eq!((keys.len(), labels.len()), (KINDS.len(), KINDS.len()));
    let looks: BTreeSet<String> = KINDS.iter().map(|kind| format!("{:?}", kind.shape)).collect();
    assert_eq!(looks.len(), KINDS.len(), "two kinds have one shape");
}

#[test]
fn the_key_of_a_row_is_that_of_its_form() {
    let schema = serde_json::to_value(schemars::schema_for!(SensorFile)).expect("a schema is JSON");
    let forms = schema["oneOf"].as_array().expect("a choice of forms");
    let keys: Vec<&str> = forms.iter().filter_map(|form| form["properties"]["kind"]["const"].as_str()).collect();
    assert_eq!(keys, KINDS.iter().map(|kind| kind.key).collect::<Vec<_>>());
}

/// The parts of a kind that `docs/reference/sensors.md` lacks: its line, or one of its messages.
fn missing(document: &str, kind: &KindRow) -> Vec<String> {
    let first = format!("| `{}` |", kind.key);
    let lines = document.lines().skip_while(|line| !line.starts_with(&first));
    let own = lines.enumerate().take_while(|(index, line)| *index == 0 || line.starts_with("| |"));
    let text: String = own.map(|(_, line)| line).collect();
    let has = |value: &str| {
        let family = value.rfind('_').is_some_and(|end| text.contains(&format!("`{}`", &value[..=end])));
        let counted = value.ends_with(|last: char| last.is_ascii_digit()) && text.contains(&value[..value.len() - 1]);
        text.contains(&format!("`{value}`")) || family || counted
    };
    let values = kind.values.iter().map(ToString::to_string).filter(|value| !has(value));
    let unit = kind.unit.map(|unit| unit.name.to_owned()).filter(|name| !text.contains(name.as_str()));
    values.chain(unit).chain(text.is_empty().then_some(first)).collect()
}

#[test]
fn the_document_of_sensors_has_every_kind_and_what_it_says() {
    let document = include_str!("../../../docs/reference/sensors.md");
    for kind in KINDS {
        assert_eq!(missing(document, kind), [""; 0], "docs/reference/sensors.md on {}", kind.key);
    }
    // The control: without its lines, or with other words, it lacks something.
    let without = document.replace("| `flow` |", "| flow |").replace("watts", "horsepower").replace("`OPEN`", "`AJAR`");
    let lacking: Vec<&str> =
        KINDS.iter().filter(|kind| !missing(&without, kind).is_empty()).map(|kind| kind.key).collect();
    assert_eq!(lacking, ["contact", "power", "flow"]);
}

#[test]
fn a_home_says_of_each_sensor_where_it_is_and_what_it_can_say() {
    let mut home: Value = serde_json::from_str(include_str!("../../../tests/flat/home.json")).expect("JSON");
    home["furniture"] = json!([{ "name": "stove", "at": [1, 1], "size_m": [0.6, 0.6], "height_m": 0.9 }]);
    home["sensors"] = json!([
        { "kind": "motion", "name": "kitchen motion", "at": [0.05, 2], "facing_deg": 0 },
        { "kind": "stove_temperature", "name": "silent", "on": "stove" },
        { "kind": "stove_temperature", "name": "stove", "on": "stove", "readings_every_s": 60 },
        { "kind": "pressure", "name": "mat", "area": [[5, 1], [5.5, 1], [5.5, 1.5]] },
        { "kind": "light", "name": "lux", "room": "bedroom" },
    ]);
    let home: HomeFile = serde_json::from_value(home).expect("a home");
    let home = ResolvedHome::new(home).expect("all that it names is there");
    let infos = Home::bake(&home, &[Build::adult()]).sensor_infos();
    let plan = home.plan();
    let said = infos.iter().map(|info| {
        let values: Vec<String> = info.values.iter().map(ToString::to_string).collect();
        let room = info.room.as_deref().unwrap_or_default();
        assert_eq!(plan.room_at(info.at).map(|room| plan.rooms[room].name.as_str()), Some(room));
        let unit = info.unit.map_or("", |unit| unit.symbol);
        format!("{}: {}, {room}, {} {unit}", info.name, info.kind.key, values.join(" "))
    });
    let expected = [
        "kitchen motion: motion, kitchen, ON ",
        "silent: stove_temperature, kitchen, ON OFF ",
        "stove: stove_temperature, kitchen, ON OFF °C",
        "mat: pressure, bedroom, ON OFF ",
        "lux: light, bedroom,  lx",
    ];
    assert_eq!(said.collect::<Vec<_>>(), expected);
}
