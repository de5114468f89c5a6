//! Cameras: what wakes them must be there, and there must be something to see.

use super::{ProblemReport, blocking, devices::known, solid_name};
use crate::camera::outlook::Outlook;
use crate::camera::scenery::Scenery;
use crate::geometry::point;
use crate::home::form::HomeFile;
use crate::plan::Plan;
use crate::sensors::camera::CameraFile;
use crate::sensors::kinds::SensorFile;
use crate::sensors::messages::SensorMessage;

/// Share of a camera's picture with floor below which the camera sees nothing useful (our choice).
const LEAST_FLOOR: f64 = 0.05;

/// Distance beyond which the floor is left out, in metres (our choice): a body there is some pixels high.
const FAR_M: f32 = 12.0;

/// Checks what does not depend on the building.
pub fn check_alone(report: &mut ProblemReport, place: &str, sensor: &SensorFile, home: &HomeFile) {
    let others = || home.sensors.iter().filter(|other| other.camera().is_none()).map(SensorFile::name);
    for (index, name) in sensor.woken_by().iter().enumerate() {
        known(report, place, &format!("woken_by/{index}"), "sensor that can wake a camera, named", name, others());
    }
}

/// Checks that it hangs in a room and looks at something.
pub fn check_within(report: &mut ProblemReport, place: &str, camera: &CameraFile, home: &HomeFile, plan: &Plan) {
    let (name, spot) = (camera.name.clone(), point(camera.at));
    let Some(room) = plan.room_at(spot) else {
        return report.add(&format!("{place}/at"), SensorMessage::CameraOutside { camera: name, at: spot });
    };
    if let Some(ceiling_m) = home.rooms[room].ceiling_m.filter(|ceiling_m| *ceiling_m < camera.height_m) {
        let (camera, room) = (name.clone(), home.rooms[room].name.clone());
        report.add(&format!("{place}/height_m"), SensorMessage::AboveCeiling { camera, room, ceiling_m });
    }
    let in_way = blocking(plan, spot).filter(|solid| solid.height_m >= camera.height_m);
    if let Some(solid) = in_way {
        let by = solid_name(home, solid);
        return report.add(&format!("{place}/at"), SensorMessage::CameraInside { camera: name, by });
    }
    // A coarse picture will do.
    let coarse = CameraFile { pixels: [32, 24], ..camera.clone() };
    let lens = coarse.lens();
    let scenery = Scenery::new(&lens, &Outlook::new(plan).prisms);
    let is_floor = |column: u32, row: u32| {
        let depth_m = scenery.depth_m(column as usize, row as usize);
        let hit = lens.at + lens.ray_in_home(column, row) * f64::from(depth_m);
        depth_m < FAR_M && hit.z < 0.7
    };
    let pixels = (0..lens.rows).flat_map(|row| (0..lens.columns).map(move |column| (column, row)));
    let seen = pixels.filter(|&(column, row)| is_floor(column, row)).count();
    if (seen as f64) < LEAST_FLOOR * f64::from(lens.columns * lens.rows) {
        report.add(&format!("{place}/facing_deg"), SensorMessage::SeesNothing { camera: name });
    }
}
