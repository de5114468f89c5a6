//! A resident's file: a name of their own, and a place to stand for a body that is driven live.

use super::{Report, Surroundings, at, blocking, folded, solid_name};
use crate::geometry::{self, point};
use crate::problem::Problem;
use crate::scenario::home::{HomeFile, RoomFile};
use crate::scenario::resident::{LiveFile, ResidentFile};
use crate::scenario::source::Source;
use std::collections::BTreeMap;

/// The names of the residents so far, folded, and the file of each.
#[derive(Default)]
pub struct Names(BTreeMap<String, String>);

impl Names {
    pub fn check(&mut self, source: &Source, file: &ResidentFile, problems: &mut Vec<Problem>) {
        let report = &mut Report { source, problems };
        report.name("/name", &file.name);
        if let Some(other) = self.0.insert(folded(&file.name), source.file.clone()) {
            report.add("/name", format!("the resident of {other:?} is also named {:?}", file.name));
        }
    }
}

/// Whether the body fits under the ceilings of all rooms: people do not stoop for good.
pub fn check_height(source: &Source, file: &ResidentFile, home: &HomeFile, problems: &mut Vec<Problem>) {
    let report = &mut Report { source, problems };
    let low = |room: &&RoomFile| room.ceiling_m.is_some_and(|ceiling_m| ceiling_m < file.height_m);
    if let Some(room) = home.rooms.iter().find(low) {
        let ceiling_m = room.ceiling_m.unwrap_or_default();
        let what = format!(
            "{} is {} m tall, and the ceiling of {:?} is at {ceiling_m} m",
            file.name, file.height_m, room.name
        );
        report.hinted("/height_m", what, "raise \"ceiling_m\" of the room, or lower \"height_m\"");
    }
}

/// Whether the body has room to stand where live input starts.
pub fn check_start(
    source: &Source,
    live: &LiveFile,
    file: &ResidentFile,
    surroundings: &Surroundings,
    problems: &mut Vec<Problem>,
) {
    let report = &mut Report { source, problems };
    let (Some(home), Some(plan)) = (surroundings.home, surroundings.plan) else { return };
    let (start, pointer) = (point(live.start), "/driver/live/start");
    if plan.distance_outside(start) > super::TOLERANCE_M {
        report.add(pointer, format!("{} starts at {}, outside the home", file.name, at(start)));
        return;
    }
    if let Some(solid) = blocking(plan, start) {
        report.add(pointer, format!("{} starts inside {}", file.name, solid_name(home, solid)));
        return;
    }
    let distance = |outline: &[geometry::Point]| geometry::distance_to_area(outline, start);
    let touched = plan.solids.iter().find(|solid| solid.stops_bodies && distance(&solid.outline) < file.radius_m);
    if let Some(solid) = touched {
        let what = format!("{} has no room to stand so near to {}", file.name, solid_name(home, solid));
        report.hinted(pointer, what, format!("the body's radius is {} m: move the start away", file.radius_m));
    } else if plan
        .openings
        .iter()
        .any(|opening| plan.leads_out(&opening.outline, file.radius_m) && distance(&opening.outline) < file.radius_m)
    {
        let what = format!("{} starts in a door that leads out, where held keys do not go", file.name);
        report.hinted(pointer, what, format!("the body's radius is {} m: move the start inside", file.radius_m));
    }
}
