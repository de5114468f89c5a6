//! The text of a home in the usual layout: a line for each room, wall, door and piece of furniture.

use homebody_core::geometry::At;
use homebody_core::home::form::HomeFile;
use homebody_core::plan::form::{DoorFile, FurnitureFile, PlaceFile, RoomFile, WallFile};
use homebody_core::role::Role;
use homebody_core::sensors::kinds::SensorFile;
use serde_json::Value;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum List {
    Rooms,
    Walls,
    Doors,
    Furniture,
    Places,
    Sensors,
}

pub fn home_text(home: &HomeFile) -> String {
    with_elements(home).0
}

/// The text, and by line, its list and its index in that list.
pub fn with_elements(home: &HomeFile) -> (String, Vec<Option<(List, usize)>>) {
    let mut lines: Vec<(String, Option<(List, usize)>)> = vec![("{".into(), None)];
    let heads = [("$schema", home.schema.as_deref().unwrap_or_default()), ("name", &home.name), ("about", &home.about)];
    for (key, text) in heads.into_iter().filter(|(_, text)| !text.is_empty()) {
        lines.push((format!("  {}: {},", quoted(key), quoted(text)), None));
    }
    lines.push((format!("  \"latitude_deg\": {},", home.latitude_deg), None));
    let mut lists = vec![
        (List::Rooms, "rooms", home.rooms.iter().map(room).collect::<Vec<_>>()),
        (List::Walls, "walls", home.walls.iter().map(wall).collect()),
        (List::Doors, "doors", home.doors.iter().map(door).collect()),
        (List::Furniture, "furniture", home.furniture.iter().map(furniture).collect()),
    ];
    if !home.places.is_empty() {
        lists.push((List::Places, "places", home.places.iter().map(place).collect()));
    }
    if !home.sensors.is_empty() {
        lists.push((List::Sensors, "sensors", home.sensors.iter().map(sensor).collect()));
    }
    let mut lists = lists.into_iter().peekable();
    while let Some((list, key, elements)) = lists.next() {
        let comma = if lists.peek().is_some() { "," } else { "" };
        if elements.is_empty() {
            lines.push((format!("  {}: []{comma}", quoted(key)), None));
            continue;
        }
        lines.push((format!("  {}: [", quoted(key)), None));
        let last = elements.len() - 1;
        for (index, element) in elements.into_iter().enumerate() {
            let comma = if index < last { "," } else { "" };
            lines.push((format!("    {{ {element} }}{comma}"), Some((list, index))));
        }
        lines.push((format!("  ]{comma}"), None));
    }
    lines.push(("}".into(), None));
    let text = lines.iter().map(|(line, _)| format!("{line}\n")).collect();
    (text, lines.into_iter().map(|(_, element)| element).collect())
}

fn room(room: &RoomFile) -> String {
    let corners: Vec<String> = room.outline.iter().map(at).collect();
    let floor = room.floor.iter().map(|floor| format!(", \"floor\": {}", quoted(floor))).collect::<String>();
    format!("\"name\": {}, \"outline\": [{}]{floor}", quoted(&room.name), corners.join(", "))
}

fn wall(wall: &WallFile) -> String {
    format!("\"from\": {}, \"to\": {}, \"thickness_m\": {}", at(&wall.from), at(&wall.to), wall.thickness_m)
}

fn door(door: &DoorFile) -> String {
    let state = if door.open { "" } else { ", \"open\": false" };
    let outside = if door.outside { ", \"outside\": true" } else { "" };
    format!("\"name\": {}, \"from\": {}, \"to\": {}{state}{outside}", quoted(&door.name), at(&door.from), at(&door.to))
}

fn furniture(piece: &FurnitureFile) -> String {
    let mut text = format!("\"name\": {}", quoted(&piece.name));
    if let Some(middle) = &piece.at {
        text += &format!(", \"at\": {}", at(middle));
    }
    if let Some(size) = &piece.size_m {
        text += &format!(", \"size_m\": {}", at(size));
    }
    if piece.turn_deg != 0.0 {
        text += &format!(", \"turn_deg\": {}", piece.turn_deg);
    }
    text += &format!(", \"height_m\": {}", piece.height_m);
    if piece.enterable {
        text += ", \"enterable\": true";
    }
    if let Some(role) = piece.role.and_then(Role::key) {
        text += &format!(", \"role\": {}", quoted(&role));
    }
    text
}

fn place(place: &PlaceFile) -> String {
    format!("\"name\": {}, \"at\": {}", quoted(&place.name), at(&place.at))
}

/// In the layout of the file, with blanks between.
fn sensor(sensor: &SensorFile) -> String {
    let text = serde_json::to_string(sensor).unwrap_or_default();
    let inner = text.strip_prefix('{').and_then(|text| text.strip_suffix('}')).unwrap_or_default();
    let mut in_quotes = false;
    let mut spaced = String::with_capacity(inner.len() + 32);
    for letter in inner.chars() {
        in_quotes ^= letter == '"';
        spaced.push(letter);
        if !in_quotes && [',', ':'].contains(&letter) {
            spaced.push(' ');
        }
    }
    spaced
}

fn at(at: &At) -> String {
    format!("[{}, {}]", at[0], at[1])
}

fn quoted(text: &str) -> String {
    Value::from(text).to_string()
}
