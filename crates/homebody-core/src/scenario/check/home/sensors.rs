//! Sensors: possible timing, and a free place.

use super::areas::{check_convex, is_flat, keeps_within};
use super::devices;
use super::messages::HomeMessage;
use super::{ProblemReport, TOLERANCE_M, cameras, is_within, solid_name};
use crate::geometry::{self, Point, point, points};
use crate::home::form::HomeFile;
use crate::plan::{Plan, Solid};
use crate::sensors::form::Orientation;
use crate::sensors::kinds::SensorFile;
use crate::sensors::messages::SensorMessage;
use crate::sensors::motion::LENS_OFF_WALL_M;

/// Largest number of beams of all sensors together (our choice): as many as the largest number of sensors has by
/// default.
const MOST_BEAMS: u32 = 32_768;

/// Smallest depth and length of the part beyond a wall of an area that reaches through it (our choice).
const REACH_THROUGH_M: f64 = 0.05;

/// Checks what does not depend on the building.
pub fn check_alone(report: &mut ProblemReport, home: &HomeFile) {
    let mut beams = 0;
    for (index, sensor) in home.sensors.iter().enumerate() {
        let place = format!("/sensors/{index}");
        check_timing(report, &place, sensor);
        let of_sensor = sensor.beam_count();
        if beams <= MOST_BEAMS && beams + of_sensor > MOST_BEAMS {
            report.add(&place, SensorMessage::TooManyBeams { most: MOST_BEAMS });
        }
        beams += of_sensor;
        if let Some(area) = sensor.area_below() {
            let what = format!("the area of {:?}", sensor.name());
            check_convex(report, &format!("{place}/area"), &points(area), &what);
        }
        devices::check_alone(report, &place, sensor, home);
        cameras::check_alone(report, &place, sensor, home);
    }
}

fn check_timing(report: &mut ProblemReport, place: &str, sensor: &SensorFile) {
    let Some(settings) = sensor.settings() else { return };
    for (key, range) in [("first_fire_s", settings.first_fire_s), ("refire_s", settings.refire_s)] {
        if let Some(range) = range {
            report.range(&format!("{place}/{key}"), key, range);
        }
    }
    let timing = sensor.timing();
    let least_refire_s = timing.refire_s[0].min(timing.refire_s[1]);
    if timing.persist_s > least_refire_s {
        let key = if settings.persist_s.is_some() { "persist_s" } else { "refire_s" };
        let message = SensorMessage::PersistTooLong { persist_s: timing.persist_s, least_refire_s };
        report.add(&format!("{place}/{key}"), message);
    }
}

/// Checks the places of sensors in a building that is sound.
pub fn check_within(report: &mut ProblemReport, home: &HomeFile, plan: &Plan) {
    for (index, sensor) in home.sensors.iter().enumerate() {
        let place = format!("/sensors/{index}");
        if let Some(camera) = sensor.camera() {
            cameras::check_within(report, &place, camera, home, plan);
        } else if sensor.orientation().is_some() {
            check_mounting(report, &place, sensor, home, plan);
        } else if let Some(area) = sensor.area_below().map(points) {
            check_view_below(report, &format!("{place}/area"), sensor.name(), &area, home, plan);
        } else {
            devices::check_within(report, &place, sensor, plan);
        }
    }
}

fn check_view_below(
    report: &mut ProblemReport,
    place: &str,
    sensor: &str,
    area: &[Point],
    home: &HomeFile,
    plan: &Plan,
) {
    if !is_flat(area) && !keeps_within(plan, area) {
        report.add(place, HomeMessage::ReachesOut { what: format!("the area of {sensor:?}") });
    } else if let Some(solid) = plan.solids.iter().find(|solid| reaches_through(area, solid)) {
        let (sensor, by) = (sensor.to_owned(), solid_name(home, solid));
        report.add(place, SensorMessage::ReachesThrough { sensor, by });
    }
}

/// Whether a wall or closed door has parts of the area on both of its sides.
fn reaches_through(area: &[Point], solid: &Solid) -> bool {
    let &[a, b, c, d] = &solid.outline[..] else { return false };
    if solid.height_m.is_finite() {
        return false;
    }
    // The corners run along the wall, then across it.
    let middle = [(a + d) / 2.0, (b + c) / 2.0];
    let inside = geometry::segment_inside_convex(area, middle[0], middle[1]);
    let shared_m = inside.map_or(0.0, |(enter, leave)| (leave - enter) * middle[0].distance(middle[1]));
    let across = (c - b) / 2.0;
    let half_m = across.length();
    let side_m = |corner: &Point| (*corner - middle[0]).dot(across / half_m);
    let beyond = |side: f64| area.iter().any(|corner| side * side_m(corner) > half_m + REACH_THROUGH_M);
    shared_m > REACH_THROUGH_M && beyond(1.0) && beyond(-1.0)
}

/// Checks the place of a wall sensor, which the file gives at the pointer `place`.
pub(in crate::scenario::check) fn check_mounting(
    report: &mut ProblemReport,
    place: &str,
    sensor: &SensorFile,
    home: &HomeFile,
    plan: &Plan,
) {
    let Some(Orientation { at, height_m, facing_deg, .. }) = sensor.orientation() else { return };
    let (sensor, lens) = (sensor.name().to_owned(), point(at));
    let tall = || plan.solids.iter().filter(|solid| solid.height_m >= height_m);
    if let Some(solid) = tall().find(|solid| is_within(solid, lens)) {
        report.add(&format!("{place}/at"), SensorMessage::Inside { sensor, by: solid_name(home, solid) });
    } else if plan.distance_outside(lens) > TOLERANCE_M {
        report.add(&format!("{place}/at"), SensorMessage::Outside { sensor, at: lens });
    } else {
        let ahead = lens + geometry::direction(facing_deg) * LENS_OFF_WALL_M;
        if let Some(solid) = tall().find(|solid| is_within(solid, ahead)) {
            let by = solid_name(home, solid);
            report.add(&format!("{place}/facing_deg"), SensorMessage::FacesSolid { sensor, by });
        }
    }
}
