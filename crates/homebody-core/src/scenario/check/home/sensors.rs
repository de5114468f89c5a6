//! Sensors: timing that can be, and a place from which they can see.

use super::areas::{check_convex, is_flat, keeps_within};
use super::{Report, TOLERANCE_M, at, cameras, devices, is_within, solid_name};
use crate::geometry::{self, Point, point};
use crate::home::plan::{Plan, Solid};
use crate::scenario::home::{HomeFile, Level, MotionFile, SensorFile};
use crate::sensors::motion::LENS_OFF_WALL_M;

/// Largest number of beams of all sensors together (our choice): as many as the largest number of sensors has by
/// default.
const MOST_BEAMS: u32 = 32_768;

/// Smallest depth and length of the part beyond a wall of an area that reaches through it (our choice).
const REACH_THROUGH_M: f64 = 0.05;

/// The lines that a sensor sees along: beams, the zones of all rows, or the sides of an area.
fn beams_of(sensor: &SensorFile) -> u32 {
    match sensor {
        SensorFile::Motion(MotionFile { level: Level::Zones(zones), .. }) => zones.rows.iter().sum(),
        SensorFile::Motion(motion) => motion.beams,
        SensorFile::CeilingMotion(ceiling) => ceiling.area.len() as u32,
        _ => 0,
    }
}

/// Checks what does not depend on the building.
pub fn check_alone(report: &mut Report, home: &HomeFile) {
    let mut beams = 0;
    for (index, sensor) in home.sensors.iter().enumerate() {
        let place = format!("/sensors/{index}");
        check_timing(report, &place, sensor);
        let of_sensor = beams_of(sensor);
        if beams <= MOST_BEAMS && beams + of_sensor > MOST_BEAMS {
            let what = format!("the sensors up to this one have more than {MOST_BEAMS} beams together");
            report.add(&place, what);
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

fn check_timing(report: &mut Report, place: &str, sensor: &SensorFile) {
    let (first, refire, persist) = match sensor {
        SensorFile::Motion(s) => (s.first_fire_s, s.refire_s, s.persist_s),
        SensorFile::CeilingMotion(s) => (s.first_fire_s, s.refire_s, s.persist_s),
        _ => return,
    };
    for (key, range) in [("first_fire_s", first), ("refire_s", refire)] {
        if let Some([least, most]) = range.filter(|[least, most]| least > most) {
            let what = format!("the least of {key:?}, {least}, is more than its most, {most}");
            report.hinted(&format!("{place}/{key}"), what, format!("write [{most}, {least}]"));
        }
    }
    let timing = sensor.timing();
    let least = timing.refire_s[0].min(timing.refire_s[1]);
    if timing.persist_s > least {
        let key = if persist.is_some() { "persist_s" } else { "refire_s" };
        let what = format!("\"persist_s\", {}, is more than the least of \"refire_s\", {least}", timing.persist_s);
        let hint = format!("a movement counts only within the wait: set \"persist_s\" to at most {least}");
        report.hinted(&format!("{place}/{key}"), what, hint);
    }
}

fn check_lens(report: &mut Report, place: &str, motion: &MotionFile) {
    if motion.field_deg[1] > 180.0 {
        let what = format!("the vertical angle of view must be at most 180, but is {}", motion.field_deg[1]);
        report.add(&format!("{place}/field_deg/1"), what);
    }
    if let Level::Zones(zones) = &motion.level
        && zones.rows == [0; 3]
    {
        report.add(&format!("{place}/level/zones/rows"), "a sensor needs at least one zone");
    }
}

/// Checks the places of sensors in a building that is sound.
pub fn check_within(report: &mut Report, home: &HomeFile, plan: &Plan) {
    for (index, sensor) in home.sensors.iter().enumerate() {
        match sensor {
            SensorFile::Motion(motion) => check_mounting(report, &format!("/sensors/{index}"), motion, home, plan),
            SensorFile::CeilingMotion(ceiling) => {
                let area: Vec<Point> = ceiling.area.iter().map(|&at| point(at)).collect();
                if !is_flat(&area) && !keeps_within(plan, &area) {
                    let what = format!("the area of {:?} reaches out of the home", ceiling.name);
                    report.add(&format!("/sensors/{index}/area"), what);
                } else if let Some(solid) = plan.solids.iter().find(|solid| reaches_through(&area, solid)) {
                    let what = format!("the area of {:?} reaches through {}", ceiling.name, solid_name(home, solid));
                    let hint = "a sensor on the ceiling sees one side of a wall: let its area end there";
                    report.hinted(&format!("/sensors/{index}/area"), what, hint);
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
    report: &mut Report,
    place: &str,
    motion: &MotionFile,
    home: &HomeFile,
    plan: &Plan,
) {
    let (name, lens) = (&motion.name, point(motion.at));
    let tall = || plan.solids.iter().filter(|solid| solid.height_m >= motion.height_m);
    let hint = "mount it on the surface, on the side from which it should see";
    if let Some(solid) = tall().find(|solid| is_within(solid, lens)) {
        let what = format!("the sensor {name:?} is inside {}", solid_name(home, solid));
        report.hinted(&format!("{place}/at"), what, hint);
    } else if plan.distance_outside(lens) > TOLERANCE_M {
        let what = format!("the sensor {name:?} at {} is outside the home", at(lens));
        report.hinted(&format!("{place}/at"), what, hint);
    } else {
        let ahead = lens + geometry::direction(motion.facing_deg) * LENS_OFF_WALL_M;
        if let Some(solid) = tall().find(|solid| is_within(solid, ahead)) {
            let what = format!("the sensor {name:?} faces into {}", solid_name(home, solid));
            report.hinted(&format!("{place}/facing_deg"), what, "0 is east, 90 north, 180 west, 270 south");
        }
    }
}
