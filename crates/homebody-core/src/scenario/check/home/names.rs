//! Names of a home: what has the same one, and what paths could not tell apart.

use super::ProblemReport;
use super::messages::HomeMessage;
use crate::home::form::HomeFile;
use crate::scenario::check::folded;
use std::collections::BTreeMap;

pub fn check(report: &mut ProblemReport, home: &HomeFile) {
    report.name("/name", &home.name);
    let rooms: Vec<_> = home.rooms.iter().map(|room| room.name.as_str()).collect();
    let doors: Vec<_> = home.doors.iter().map(|door| door.name.as_str()).collect();
    let furniture: Vec<_> = home.furniture.iter().map(|piece| piece.name.as_str()).collect();
    let places: Vec<_> = home.places.iter().map(|place| place.name.as_str()).collect();
    let sensors: Vec<_> = home.sensors.iter().map(|sensor| sensor.name()).collect();
    check_list(report, "rooms", "room", &rooms);
    for (index, floor) in home.rooms.iter().enumerate().filter_map(|(index, room)| Some((index, room.floor.as_ref()?)))
    {
        report.name(&format!("/rooms/{index}/floor"), floor);
    }
    check_list(report, "doors", "door", &doors);
    check_list(report, "furniture", "piece of furniture", &furniture);
    check_list(report, "places", "place", &places);
    check_list(report, "sensors", "sensor", &sensors);
    check_spots(report, home);
}

fn check_list(report: &mut ProblemReport, list: &str, noun: &'static str, names: &[&str]) {
    let mut first = BTreeMap::new();
    for (index, name) in names.iter().enumerate() {
        let pointer = format!("/{list}/{index}/name");
        report.name(&pointer, name);
        let Some(other) = first.insert(folded(name), *name) else { continue };
        let (is_same, name, other) = (other == *name, (*name).to_owned(), other.to_owned());
        report.add(
            &pointer,
            match is_same {
                true => HomeMessage::SameName { noun, name },
                false => HomeMessage::SimilarName { noun, name, other },
            },
        );
    }
}

/// Paths go to places, enterable furniture and rooms by name, so no two of these may share one.
fn check_spots(report: &mut ProblemReport, home: &HomeFile) {
    let rooms = home.rooms.iter().map(|room| folded(&room.name)).map(|name| (name, "room"));
    let mut known: BTreeMap<String, &'static str> = rooms.collect();
    let seats = home.furniture.iter().enumerate().filter(|(_, piece)| piece.enterable);
    let seats = seats.map(|(index, piece)| (format!("/furniture/{index}/name"), &piece.name, "piece of furniture"));
    let places = home.places.iter().enumerate();
    let places = places.map(|(index, place)| (format!("/places/{index}/name"), &place.name, "place"));
    for (pointer, name, noun) in seats.chain(places) {
        let other = known.insert(folded(name), noun);
        if let Some(other) = other.filter(|other| *other != noun) {
            report.add(&pointer, HomeMessage::SharedName { noun: other, name: name.clone() });
        }
    }
}
