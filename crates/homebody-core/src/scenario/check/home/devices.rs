//! Sensors that hang on things, lie under people or stand in rooms: what they need must be there, limits must be in order.

use super::ProblemReport;
use super::areas::{check_convex, is_flat, keeps_within};
use super::messages::HomeMessage;
use crate::geometry::points;
use crate::home::form::HomeFile;
use crate::plan::Plan;
use crate::plan::form::FurnitureFile;
use crate::sensors::form::{Bearer, Mount};
use crate::sensors::kinds::SensorFile;
use crate::sensors::messages::SensorMessage;

/// Checks what does not depend on the building.
pub fn check_alone(report: &mut ProblemReport, place: &str, sensor: &SensorFile, home: &HomeFile) {
    let rooms = || home.rooms.iter().map(|room| room.name.as_str());
    if let (Mount::Thing(bearers), Some(on)) = (sensor.row().mount, sensor.on()) {
        let doors = || home.doors.iter().map(|door| door.name.as_str());
        let furniture = || home.furniture.iter().map(|piece| piece.name.as_str());
        let names = bearers.iter().flat_map(|bearer| match bearer {
            Bearer::Door => doors().collect::<Vec<_>>(),
            Bearer::Furniture | Bearer::Enterable => furniture().collect(),
            Bearer::Lamp => rooms().collect(),
        });
        let nouns = bearers.iter().map(|bearer| match bearer {
            Bearer::Door => "door",
            Bearer::Furniture | Bearer::Enterable => "piece of furniture",
            Bearer::Lamp => "room",
        });
        known(report, place, "on", &nouns.collect::<Vec<_>>().join(" or "), on, names);
        if bearers == [Bearer::Enterable] {
            enterable(report, place, home.furniture.iter().find(|piece| piece.name == on));
        }
    }
    if let Some(room) = sensor.room() {
        known(report, place, "room", "room", room, rooms());
    }
    let before = report.count();
    for wrong in sensor.wrong() {
        report.add(&format!("{place}{}", wrong.at), wrong.message);
    }
    if let Some(area) = sensor.area().filter(|_| report.count() == before) {
        check_convex(report, &format!("{place}/area"), &points(area), &format!("the area of {:?}", sensor.name()));
    }
}

/// Checks what lies on the floor of a building that is sound.
pub fn check_within(report: &mut ProblemReport, place: &str, sensor: &SensorFile, plan: &Plan) {
    let Some(area) = sensor.area().map(points) else { return };
    if !is_flat(&area) && !keeps_within(plan, &area) {
        let what = format!("the area of {:?}", sensor.name());
        report.add(&format!("{place}/area"), HomeMessage::ReachesOut { what });
    }
}

/// Checks that the thing or room of a sensor exists.
pub fn known<'a>(
    report: &mut ProblemReport,
    place: &str,
    key: &str,
    noun: &str,
    name: &str,
    names: impl Iterator<Item = &'a str> + Clone,
) {
    if !names.clone().any(|known| known == name) {
        let (nearest, known) = report.names_for(name, names);
        let (noun, name) = (noun.to_owned(), name.to_owned());
        report.add(&format!("{place}/{key}"), SensorMessage::UnknownPart { noun, name, nearest, known });
    }
}

/// Residents never enter furniture that is not for people.
fn enterable(report: &mut ProblemReport, place: &str, piece: Option<&FurnitureFile>) {
    if let Some(piece) = piece.filter(|piece| !piece.enterable) {
        report.add(&format!("{place}/on"), SensorMessage::NotEnterable { furniture: piece.name.clone() });
    }
}
