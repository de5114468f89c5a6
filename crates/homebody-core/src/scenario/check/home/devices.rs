//! Sensors that hang on things, lie under people or stand in rooms: what they need must be there, limits must be in order.

use super::super::did_you_mean;
use super::Report;
use super::areas::{check_convex, is_flat, keeps_within};
use crate::geometry::{At, Point, point};
use crate::home::plan::Plan;
use crate::scenario::device::{BedFile, PowerFile, PressureFile, StoveTemperatureFile};
use crate::scenario::home::{FurnitureFile, HomeFile, SensorFile};
use crate::sensors::pressure::MAT_HEIGHT_M;
use crate::sensors::stove_temperature::ROOM_C;

/// Checks what does not depend on the building.
pub fn check_alone(report: &mut Report, place: &str, sensor: &SensorFile, home: &HomeFile) {
    let doors = || home.doors.iter().map(|door| door.name.as_str());
    let furniture = || home.furniture.iter().map(|piece| piece.name.as_str());
    let rooms = || home.rooms.iter().map(|room| room.name.as_str());
    let piece = |on: &str| home.furniture.iter().find(|piece| piece.name == on);
    match sensor {
        SensorFile::Motion(_) | SensorFile::CeilingMotion(_) => {}
        SensorFile::Contact(file) => {
            known(report, place, "on", "door or piece of furniture", &file.on, doors().chain(furniture()));
        }
        SensorFile::Bed(file) => {
            known(report, place, "on", "piece of furniture", &file.on, furniture());
            enterable(report, place, piece(&file.on));
            check_bed(report, place, file);
        }
        SensorFile::StoveTemperature(file) => {
            known(report, place, "on", "piece of furniture", &file.on, furniture());
            check_limits(report, place, file);
        }
        SensorFile::Pressure(file) => {
            if let Some(on) = &file.on {
                known(report, place, "on", "piece of furniture", on, furniture());
                enterable(report, place, piece(on));
            }
            check_pressure(report, place, file);
        }
        SensorFile::Power(file) => {
            known(report, place, "on", "piece of furniture or room", &file.on, furniture().chain(rooms()));
            check_power(report, place, file);
        }
        SensorFile::Flow(file) => known(report, place, "on", "piece of furniture", &file.on, furniture()),
        SensorFile::Light(file) => known(report, place, "room", "room", &file.room, rooms()),
        SensorFile::Temperature(file) => known(report, place, "room", "room", &file.room, rooms()),
    }
}

/// Checks a mat in a building that is sound.
pub fn check_within(report: &mut Report, place: &str, sensor: &SensorFile, plan: &Plan) {
    let SensorFile::Pressure(PressureFile { name, area: Some(area), .. }) = sensor else { return };
    let area = corners(area);
    if !is_flat(&area) && !keeps_within(plan, &area) {
        report.add(&format!("{place}/area"), format!("the area of {name:?} reaches out of the home"));
    }
}

/// What a sensor is on or in must be there.
fn known<'a>(
    report: &mut Report,
    place: &str,
    key: &str,
    noun: &str,
    name: &str,
    names: impl Iterator<Item = &'a str> + Clone,
) {
    if !names.clone().any(|known| known == name) {
        let what = format!("the home has no {noun} {name:?}");
        report.problem(&format!("{place}/{key}"), what, did_you_mean(name, names));
    }
}

/// Nobody is ever in furniture that is not for people.
fn enterable(report: &mut Report, place: &str, piece: Option<&FurnitureFile>) {
    if let Some(piece) = piece.filter(|piece| !piece.enterable) {
        let what = format!("nobody can be where {:?} stands, so that this sensor would never feel anybody", piece.name);
        report.hinted(&format!("{place}/on"), what, format!("write \"enterable\": true for {:?}", piece.name));
    }
}

fn check_bed(report: &mut Report, place: &str, file: &BedFile) {
    if let Some(index) = file.levels_s.windows(2).position(|pair| pair[0] >= pair[1]) {
        let (level, before) = (file.levels_s[index + 1], file.levels_s[index]);
        let what = format!("each of \"levels_s\" must be more than the one before, but {level} comes after {before}");
        report.add(&format!("{place}/levels_s/{}", index + 1), what);
    }
    for (key, [least, most]) in [("pulse_bpm", file.pulse_bpm), ("respiration_pm", file.respiration_pm)] {
        if least >= most {
            let what = format!(
                "what is low by {key:?} ends at {least}, and what is high must begin above that, not at {most}"
            );
            report.add(&format!("{place}/{key}"), what);
        }
    }
}

/// Each of the temperatures must be above the one before.
fn check_limits(report: &mut Report, place: &str, file: &StoveTemperatureFile) {
    let limits = [("off_below_c", file.off_below_c), ("on_above_c", file.on_above_c), ("hot_c", file.hot_c)];
    if file.off_below_c <= ROOM_C {
        let what = format!("\"off_below_c\" must be above the room's {ROOM_C}, or a stove never cools down past it");
        report.add(&format!("{place}/off_below_c"), what);
    }
    for pair in limits.windows(2) {
        let [(lower, low), (upper, high)] = [pair[0], pair[1]];
        if low >= high {
            let what = format!("{upper:?} must be more than {lower:?}, but {high} is not more than {low}");
            report.add(&format!("{place}/{upper}"), what);
        }
    }
}

fn check_pressure(report: &mut Report, place: &str, file: &PressureFile) {
    match (&file.on, &file.area) {
        (Some(_), Some(_)) => {
            report.hinted(
                &format!("{place}/area"),
                "this sensor is given in two places",
                "give either \"on\" or \"area\"",
            );
        }
        (None, None) => {
            let hint =
                format!("give \"on\", a piece of furniture (a mat if at most {MAT_HEIGHT_M} m high), or \"area\"");
            report.hinted(place, format!("{:?} is nowhere", file.name), hint);
        }
        (None, Some(area)) => {
            check_convex(report, &format!("{place}/area"), &corners(area), &format!("the area of {:?}", file.name));
        }
        (Some(_), None) => {}
    }
}

fn check_power(report: &mut Report, place: &str, file: &PowerFile) {
    let Some(watts) = file.watts else {
        let given =
            [("standby_watts", file.standby_watts > 0.0), ("readings_every_s", file.readings_every_s.is_some())];
        for (key, _) in given.into_iter().filter(|(_, given)| *given) {
            let what = format!("{key:?} says nothing without \"watts\"");
            report.hinted(&format!("{place}/{key}"), what, "give what it draws while it is on as \"watts\"");
        }
        return;
    };
    if file.standby_watts > watts {
        let what = format!("\"standby_watts\", {}, is more than \"watts\", {watts}", file.standby_watts);
        report.add(&format!("{place}/standby_watts"), what);
    }
}

fn corners(area: &[At]) -> Vec<Point> {
    area.iter().map(|&at| point(at)).collect()
}
