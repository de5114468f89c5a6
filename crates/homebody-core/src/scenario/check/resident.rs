//! A resident's file: a unique name, and a free place to stand for a body under held keys.

use super::{HomeInCheck, ProblemReport, at as written, blocking, folded, solid_name};
use crate::geometry::{self, Point, point};
use crate::home::form::HomeFile;
use crate::plan::form::RoomFile;
use crate::problem::Problem;
use crate::resident::{LiveFile, ResidentFile};
use crate::scenario::source::JsonSource;
use std::collections::BTreeMap;

crate::messages! {
    /// Problems with residents.
    pub enum ResidentMessage in "resident" {
        /// The ground truth and all reports tell residents apart by their names.
        SameName { name: String, file: String }
            error "duplicate-name" ("the resident of {file:?} is also named {name:?}")
            hint ("rename one of them");
        /// A body fits under the ceilings of all rooms. Residents do not stoop all the time.
        TooTall { resident: String, height_m: f64, room: String, ceiling_m: f64 }
            error "too-tall" ("{resident} is {height_m} m tall, and the ceiling of {room:?} is at {ceiling_m} m")
            hint ("raise \"ceiling_m\" of the room, or lower \"height_m\"");
        /// A resident starts in a room.
        StartOutside { resident: String, at: Point }
            error "start-outside" ("{resident} starts at {at}, outside the home", at = written(*at))
            hint ("move the start into a room");
        /// A resident starts where a person can stand.
        StartBlocked {
            resident: String,
            /// The wall, door or piece of furniture.
            by: String,
        } error "start-blocked" ("{resident} starts inside {by}")
            hint ("move the start to a point where a person can stand");
        /// The body is a circle on the floor. It has to fit between walls, closed doors and furniture.
        StartTooNear {
            resident: String,
            /// The wall, door or piece of furniture.
            by: String,
            radius_m: f64,
        } error "start-too-near" ("{resident} starts too near to {by}")
            hint ("move the start at least {radius_m} m away, the radius of the body");
        /// Held keys move a body within the home only, so a body cannot start in a door that leads out.
        StartInDoor { resident: String, radius_m: f64 }
            error "start-in-door" ("{resident} starts in a door that leads out, where held keys do not move a body")
            hint ("move the start at least {radius_m} m inside, the radius of the body");
    }
}

/// The names of the residents so far, folded, and the file of each.
#[derive(Default)]
pub struct ResidentNames(BTreeMap<String, String>);

impl ResidentNames {
    pub fn check(&mut self, source: &JsonSource, file: &ResidentFile, problems: &mut Vec<Problem>) {
        let report = &mut ProblemReport { source, problems };
        report.name("/name", &file.name);
        if let Some(other) = self.0.insert(folded(&file.name), source.file.clone()) {
            report.add("/name", ResidentMessage::SameName { name: file.name.clone(), file: other });
        }
    }
}

/// Whether the body fits under the ceilings of all rooms: people do not stoop for good.
pub fn check_height(source: &JsonSource, file: &ResidentFile, home: &HomeFile, problems: &mut Vec<Problem>) {
    let report = &mut ProblemReport { source, problems };
    let low = |room: &&RoomFile| room.ceiling_m.is_some_and(|ceiling_m| ceiling_m < file.height_m);
    if let Some(room) = home.rooms.iter().find(low) {
        let ceiling_m = room.ceiling_m.unwrap_or_default();
        let (resident, room, height_m) = (file.name.clone(), room.name.clone(), file.height_m);
        report.add("/height_m", ResidentMessage::TooTall { resident, height_m, room, ceiling_m });
    }
}

/// Whether the body has room at the start of live input.
pub fn check_start(
    source: &JsonSource,
    live: &LiveFile,
    file: &ResidentFile,
    surroundings: &HomeInCheck,
    problems: &mut Vec<Problem>,
) {
    let report = &mut ProblemReport { source, problems };
    let (Some(home), Some(plan)) = (surroundings.home, surroundings.plan) else { return };
    let (start, pointer) = (point(live.start), "/driver/live/start");
    let (resident, radius_m) = (file.name.clone(), file.radius_m);
    if plan.distance_outside(start) > super::TOLERANCE_M {
        return report.add(pointer, ResidentMessage::StartOutside { resident, at: start });
    }
    if let Some(solid) = blocking(plan, start) {
        return report.add(pointer, ResidentMessage::StartBlocked { resident, by: solid_name(home, solid) });
    }
    let distance = |outline: &[Point]| geometry::distance_to_area(outline, start);
    let touched = plan.solids.iter().find(|solid| solid.stops_bodies && distance(&solid.outline) < file.radius_m);
    if let Some(solid) = touched {
        report.add(pointer, ResidentMessage::StartTooNear { resident, by: solid_name(home, solid), radius_m });
    } else if plan
        .openings
        .iter()
        .any(|opening| plan.leads_out(&opening.outline, file.radius_m) && distance(&opening.outline) < file.radius_m)
    {
        report.add(pointer, ResidentMessage::StartInDoor { resident, radius_m });
    }
}
