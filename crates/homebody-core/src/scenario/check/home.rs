//! `home.json`: names, then the building, then what hangs in it.

mod areas;
mod cameras;
mod devices;
mod furniture;
pub mod messages;
mod names;
mod rooms;
mod sensors;
mod walls;

pub(in crate::scenario::check) use sensors::check_mounting;

use super::{ProblemReport, TOLERANCE_M, at, blocking, is_within, solid_name};
use crate::geometry::{At, point};
use crate::home::form::{GREATEST_SIZE_M, HomeFile};
use crate::plan::Plan;
use crate::problem::Problem;
use crate::scenario::source::JsonSource;
use messages::HomeMessage;

/// Checks the file; gives the plan if the building is sound.
pub fn check(source: &JsonSource, home: &HomeFile, problems: &mut Vec<Problem>) -> Option<Plan> {
    let report = &mut ProblemReport { source, problems };
    names::check(report, home);
    furniture::check_roles(report, home);
    let before = report.count();
    check_size(report, home);
    rooms::check(report, home);
    walls::check(report, home);
    let shapes = furniture::check_shapes(report, home);
    if report.count() > before || !shapes {
        sensors::check_alone(report, home);
        return None;
    }
    let plan = Plan::new(home);
    furniture::check_within(report, home, &plan);
    let sound = report.count() == before;
    check_places(report, home, &plan);
    sensors::check_alone(report, home);
    sensors::check_within(report, home, &plan);
    sound.then_some(plan)
}

fn check_size(report: &mut ProblemReport, home: &HomeFile) {
    let rooms = home.rooms.iter().enumerate().flat_map(|(room, file)| {
        let corner = move |(corner, &at)| (format!("/rooms/{room}/outline/{corner}"), at);
        file.outline.iter().enumerate().map(corner)
    });
    let walls = home.walls.iter().enumerate().flat_map(|(index, wall)| {
        [(format!("/walls/{index}/from"), wall.from), (format!("/walls/{index}/to"), wall.to)]
    });
    let Some(first) = home.rooms.first().and_then(|room| room.outline.first()) else { return };
    let far = |at: At| (point(at) - point(*first)).abs().max_element() > GREATEST_SIZE_M;
    if let Some((pointer, _)) = rooms.chain(walls).find(|(_, at)| far(*at)) {
        report.add(&pointer, HomeMessage::TooLarge { most_m: GREATEST_SIZE_M });
    }
}

fn check_places(report: &mut ProblemReport, home: &HomeFile, plan: &Plan) {
    for (index, place) in home.places.iter().enumerate() {
        let (pointer, place, at) = (format!("/places/{index}/at"), place.name.clone(), point(place.at));
        if plan.distance_outside(at) > TOLERANCE_M {
            report.add(&pointer, HomeMessage::PlaceOutside { place, at });
        } else if let Some(solid) = blocking(plan, at) {
            report.add(&pointer, HomeMessage::PlaceBlocked { place, by: solid_name(home, solid) });
        }
    }
}
