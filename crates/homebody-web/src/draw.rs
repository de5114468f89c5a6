//! Views of a home for the page.

use crate::wire::{
    At, BodyView, CameraView, DoorView, HomeView, MapPosture, RoomView, SensorView, SolidKind, SolidView, ThingKind,
    ThingView,
};
use homebody_analysis::coverage::cameras::CameraFloor;
use homebody_core::geometry::{self, Point};
use homebody_core::home::form::HomeFile;
use homebody_core::plan::form::FurnitureFile;
use homebody_core::plan::{Origin, Plan};
use homebody_core::posture;
use homebody_core::role::Role;
use homebody_core::sensors::Sensor;
use homebody_core::sensors::camera::CameraFile;
use homebody_core::sensors::form::{Bearer, Mount};
use homebody_core::sensors::kinds::SensorFile;

/// The height of the body for beams: a standing adult.
const BODY_M: f64 = 1.65;

/// A sensor that is moved during a run has its first place.
pub fn home(file: &HomeFile, plan: &Plan, sensors: &[Sensor]) -> HomeView {
    let (least, most) = plan.bounds();
    let doors = file.doors.len();
    let kind = |index: usize| match index {
        index if index < doors => ThingKind::Door,
        index if index < plan.things.len() - plan.rooms.len() => ThingKind::Furniture,
        _ => ThingKind::Lamp,
    };
    HomeView {
        name: file.name.clone(),
        bounds: [at(least), at(most)],
        rooms: plan
            .rooms
            .iter()
            .zip(&file.rooms)
            .map(|(room, file)| RoomView {
                name: room.name.clone(),
                outline: outline(&room.outline),
                middle: at(geometry::inner_point(&room.outline)),
                floor: file.floor.clone(),
            })
            .collect(),
        solids: plan
            .solids
            .iter()
            .map(|solid| {
                let (kind, name) = match solid.origin {
                    Origin::Wall(_) => (SolidKind::Wall, None),
                    Origin::Door(door) => (SolidKind::Door, Some(file.doors[door].name.clone())),
                    Origin::Furniture(piece) => (SolidKind::Furniture, Some(file.furniture[piece].name.clone())),
                };
                SolidView { kind, name, outline: outline(&solid.outline), enterable: !solid.stops_bodies }
            })
            .collect(),
        doors: file
            .doors
            .iter()
            .map(|door| DoorView {
                name: door.name.clone(),
                from: door.from,
                to: door.to,
                open: door.open,
                outside: door.outside,
            })
            .collect(),
        things: plan
            .things
            .iter()
            .enumerate()
            .map(|(index, thing)| ThingView {
                name: thing.name.clone(),
                kind: kind(index),
                at: at(thing.at),
                verbs: verbs(kind(index), index.checked_sub(doors).and_then(|piece| file.furniture.get(piece))),
            })
            .collect(),
        sensors: sensors.iter().zip(&file.sensors).map(|(sensor, file)| self::sensor(sensor, file, plan)).collect(),
    }
}

/// The verbs for a thing and their opposites. A wardrobe is opened and a stove turned on; a thing without such a role is used.
fn verbs(kind: ThingKind, piece: Option<&FurnitureFile>) -> [String; 2] {
    const IS_ON: [Role; 5] = [Role::Stove, Role::FoodWarmer, Role::Television, Role::WashingMachine, Role::Dryer];
    const OPENS: [Role; 4] = [Role::Fridge, Role::Wardrobe, Role::Drawers, Role::Medicine];
    let roles = |piece: &FurnitureFile| match piece.role {
        Some(role) => vec![role],
        None => Role::from_name(&piece.name.to_lowercase()).collect(),
    };
    let roles = piece.map(roles).unwrap_or_default();
    let is_one = |of: &[Role]| roles.iter().any(|role| of.contains(role));
    let [on, off] = match kind {
        ThingKind::Door => ["Open", "Close"],
        ThingKind::Lamp => ["Turn on", "Turn off"],
        ThingKind::Furniture if is_one(&IS_ON) => ["Turn on", "Turn off"],
        ThingKind::Furniture if is_one(&OPENS) => ["Open", "Close"],
        ThingKind::Furniture => ["Use", "Stop using"],
    };
    [on.to_owned(), off.to_owned()]
}

fn sensor(sensor: &Sensor, file: &SensorFile, plan: &Plan) -> SensorView {
    let beams = if sensor.is_on_wall() { sensor.kind.beams(plan, BODY_M) } else { Vec::new() };
    let on = file.on().and_then(|thing| plan.piece(thing)).map(|piece| outline(&piece.outline));
    let area = match sensor.kind.area_below() {
        Some(below) => Some(outline(below)),
        _ if file.row().mount == Mount::Thing(&[Bearer::Enterable]) => file.area().map(<[_]>::to_vec).or(on),
        _ => None,
    };
    SensorView {
        name: sensor.name.clone(),
        kind: file.row().key.into(),
        room: sensor.info(plan).room,
        at: at(sensor.at),
        facing_deg: file.orientation().map(|lens| lens.facing_deg),
        beams: beams.iter().map(|beam| [at(beam.start), at(beam.start + beam.direction * beam.length)]).collect(),
        area,
        camera: file.camera().map(|file| camera(file, plan)),
    }
}

fn camera(file: &CameraFile, plan: &Plan) -> CameraView {
    let CameraFloor { seen, hidden } = CameraFloor::from_lens(plan, &file.lens());
    CameraView { pixels: file.pixels, period_us: file.period().micros(), always: file.always, seen, hidden }
}

pub fn body(seen: &homebody_core::scene::Presence, activity: Option<String>) -> BodyView {
    BodyView {
        at: at(seen.at),
        heading_deg: seen.heading.to_angle().to_degrees(),
        posture: posture(seen.posture),
        room: seen.room.map(|room| room.0),
        activity,
    }
}

pub fn posture(posture: posture::Posture) -> MapPosture {
    match posture {
        posture::Posture::Standing | posture::Posture::Bending => MapPosture::Standing,
        posture::Posture::Sitting | posture::Posture::Kneeling => MapPosture::Sitting,
        posture::Posture::Lying | posture::Posture::Down => MapPosture::Lying,
    }
}

pub fn at(p: Point) -> At {
    [p.x, p.y]
}

fn outline(points: &[Point]) -> Vec<At> {
    points.iter().map(|&p| at(p)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verbs_follow_the_role() {
        let piece = |name: &str| {
            serde_json::from_value::<FurnitureFile>(serde_json::json!({
                "name": name, "at": [1.0, 1.0], "size_m": [1.0, 1.0], "height_m": 1.0,
            }))
        };
        for (name, on) in
            [("wardrobe", "Open"), ("Margaret's wardrobe", "Open"), ("stove", "Turn on"), ("toy stove", "Use")]
        {
            assert_eq!(verbs(ThingKind::Furniture, Some(&piece(name).unwrap()))[0], on, "{name}");
        }
    }
}
