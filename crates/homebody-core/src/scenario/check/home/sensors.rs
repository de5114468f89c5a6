//! Sensors: timing that can be, and a place from which they can see.

use super::areas::{check_convex, is_flat, keeps_within};
use super::messages::HomeMessage;
use super::{ProblemReport, TOLERANCE_M, cameras, devices, is_within, solid_name};
use crate::geometry::{self, Point, point};
use crate::home::form::HomeFile;
use crate::plan::{Plan, Solid};
use crate::sensors::kinds::SensorFile;
use crate::sensors::messages::SensorMessage;
use crate::sensors::motion::{LENS_OFF_WALL_M, LevelFile, MotionFile};

/// Largest number of beams of all sensors together (our choice): as many as the largest number of sensors has by
/// default.
const MOST_BEAMS: u32 = 32_768;

/// Smallest depth and length of the part beyond a wall of an area that reaches through it (our choice).
const REACH_THROUGH_M: f64 = 0.05;

/// The lines that a sensor sees along: beams, the zones of all rows, or the sides of an area.
fn beams_of(sensor: &SensorFile) -> u32 {
    match sensor {
        SensorFile::Motion(MotionFile { level: LevelFile::Zones(zones), .. }) => zones.rows.iter().sum(),
        SensorFile::Motion(motion) => motion.beams,
        SensorFile::CeilingMotion(ceiling) => ceiling.area.len() as u32,
        _ => 0,
    }
}

/// Checks what does not depend on the building.
pub fn check_alone(report: &mut ProblemReport, home: &HomeFile) {
    let mut beams = 0;
    for (index, sensor) in home.sensors.iter().enumerate() {
        let place = format!("/sensors/{index}");
        check_timing(report, &place, sensor);
        let of_sensor = beams_of(sensor);
        if beams <= MOST_BEAMS && beams + of_sensor > MOST_BEAMS {
            report.add(&place, SensorMessage::TooManyBeams { most: MOST_BEAMS });
        }
        beams += of_sensor;
        match sensor {
            SensorFile::Motion(motion) => {
                check_lens(report, &place, motion);
            }
            SensorFile::CeilingMotion(ceiling) => {
                let area: Vec<Point> = ceiling.area.iter().map(|&at| point(at)).collect();
                check_convex(report, &format!("{place}/area"), &area, &format!("the area of {:?}", ceiling.name));
            }
            _ => {}
        }
        devices::check_alone(report, &place, sensor, home);
        cameras::check_alone(report, &place, sensor, home);
    }
}

fn check_timing(report: &mut ProblemReport, place: &str, sensor: &SensorFile) {
    let (first, refire, persist) = match sensor {
        SensorFile::Motion(s) => (s.first_fire_s, s.refire_s, s.persist_s),
        SensorFile::CeilingMotion(s) => (s.first_fire_s, s.refire_s, s.persist_s),
        _ => return,
    };
    for (key, range) in [("first_fire_s", first), ("refire_s", refire)] {
        if let Some(range) = range {
            report.range(&format!("{place}/{key}"), key, range);
        }
    }
    let timing = sensor.timing();
    let least_refire_s = timing.refire_s[0].min(timing.refire_s[1]);
    if timing.persist_s > least_refire_s {
        let key = if persist.is_some() { "persist_s" } else { "refire_s" };
        let message = SensorMessage::PersistTooLong { persist_s: timing.persist_s, least_refire_s };
        report.add(&format!("{place}/{key}"), message);
    }
}

fn check_lens(report: &mut ProblemReport, place: &str, motion: &MotionFile) {
    if motion.field_deg[1] > 180.0 {
        report.add(&format!("{place}/field_deg/1"), SensorMessage::VerticalField { field_deg: motion.field_deg[1] });
    }
    if let LevelFile::Zones(zones) = &motion.level
        && zones.rows == [0; 3]
    {
        report.add(&format!("{place}/level/zones/rows"), SensorMessage::NoZones);
    }
}

/// Checks the places of sensors in a building that is sound.
pub fn check_within(report: &mut ProblemReport, home: &HomeFile, plan: &Plan) {
    for (index, sensor) in home.sensors.iter().enumerate() {
        match sensor {
            SensorFile::Motion(motion) => check_mounting(report, &format!("/sensors/{index}"), motion, home, plan),
            SensorFile::CeilingMotion(ceiling) => {
                let area: Vec<Point> = ceiling.area.iter().map(|&at| point(at)).collect();
                if !is_flat(&area) && !keeps_within(plan, &area) {
                    let what = format!("the area of {:?}", ceiling.name);
                    report.add(&format!("/sensors/{index}/area"), HomeMessage::ReachesOut { what });
                } else if let Some(solid) = plan.solids.iter().find(|solid| reaches_through(&area, solid)) {
                    let (sensor, by) = (ceiling.name.clone(), solid_name(home, solid));
                    report.add(&format!("/sensors/{index}/area"), SensorMessage::ReachesThrough { sensor, by });
                }
            }
            SensorFile::Camera(camera) => {
                cameras::check_within(report, &format!("/sensors/{index}"), camera, home, plan)
            }
            device => devices::check_within(report, &format!("/sensors/{index}"), device, plan),
        }
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
    motion: &MotionFile,
    home: &HomeFile,
    plan: &Plan,
) {
    let (sensor, lens) = (motion.name.clone(), point(motion.at));
    let tall = || plan.solids.iter().filter(|solid| solid.height_m >= motion.height_m);
    if let Some(solid) = tall().find(|solid| is_within(solid, lens)) {
        report.add(&format!("{place}/at"), SensorMessage::Inside { sensor, by: solid_name(home, solid) });
    } else if plan.distance_outside(lens) > TOLERANCE_M {
        report.add(&format!("{place}/at"), SensorMessage::Outside { sensor, at: lens });
    } else {
        let ahead = lens + geometry::direction(motion.facing_deg) * LENS_OFF_WALL_M;
        if let Some(solid) = tall().find(|solid| is_within(solid, ahead)) {
            let by = solid_name(home, solid);
            report.add(&format!("{place}/facing_deg"), SensorMessage::FacesSolid { sensor, by });
        }
    }
}
