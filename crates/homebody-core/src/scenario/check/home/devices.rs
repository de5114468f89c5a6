//! Sensors that hang on things, lie under people or stand in rooms: what they need must be there, limits must be in order.

use super::Report;
use super::areas::{check_convex, is_flat, keeps_within};
use crate::geometry::{At, Point, point};
use crate::home::plan::Plan;
use crate::scenario::home::{FurnitureFile, HomeFile, SensorFile};
use crate::sensors::form::{Bearer, Mount};

/// Checks what does not depend on the building.
pub fn check_alone(report: &mut Report, place: &str, sensor: &SensorFile, home: &HomeFile) {
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
        let at = format!("{place}{}", wrong.at);
        match wrong.hint {
            Some(hint) => report.hinted(&at, wrong.what, hint),
            None => report.add(&at, wrong.what),
        }
    }
    if let Some(area) = sensor.area().filter(|_| report.count() == before) {
        check_convex(report, &format!("{place}/area"), &corners(area), &format!("the area of {:?}", sensor.name()));
    }
}

/// Checks what lies on the floor of a building that is sound.
pub fn check_within(report: &mut Report, place: &str, sensor: &SensorFile, plan: &Plan) {
    let Some(area) = sensor.area().map(corners) else { return };
    if !is_flat(&area) && !keeps_within(plan, &area) {
        report.add(&format!("{place}/area"), format!("the area of {:?} reaches out of the home", sensor.name()));
    }
}

/// What a sensor is on or in must be there.
pub fn known<'a>(
    report: &mut Report,
    place: &str,
    key: &str,
    noun: &str,
    name: &str,
    names: impl Iterator<Item = &'a str> + Clone,
) {
    if !names.clone().any(|known| known == name) {
        let what = format!("the home has no {noun} {name:?}");
        let hint = report.did_you_mean(name, names);
        report.problem(&format!("{place}/{key}"), what, hint);
    }
}

/// Nobody is ever in furniture that is not for people.
fn enterable(report: &mut Report, place: &str, piece: Option<&FurnitureFile>) {
    if let Some(piece) = piece.filter(|piece| !piece.enterable) {
        let what = format!("nobody can be where {:?} stands, so that this sensor would never feel anybody", piece.name);
        report.hinted(&format!("{place}/on"), what, format!("write \"enterable\": true for {:?}", piece.name));
    }
}

fn corners(area: &[At]) -> Vec<Point> {
    area.iter().map(|&at| point(at)).collect()
}
