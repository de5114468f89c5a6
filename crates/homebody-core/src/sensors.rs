//! The sensors: one file per kind, all in the same shape, and the timing they share. [`kinds`] lists them.

pub mod bed;
pub mod camera;
pub mod ceiling_motion;
pub mod contact;
pub mod entities;
pub mod flow;
pub mod form;
pub mod kinds;
pub mod light;
pub mod looking;
pub mod meaning;
pub mod messages;
pub mod motion;
pub mod notice;
pub mod outbox;
pub mod power;
pub mod preset;
pub mod pressure;
pub mod products;
pub mod rays;
mod rounds;
pub mod stove_temperature;
pub mod temperature;
pub mod timing;
pub(crate) mod zones;

use crate::camera::outlook::Outlook;
use crate::event::Value;
use crate::geometry::{self, Point};
use crate::ids::{RoomId, ThingId};
use crate::plan::Plan;
use form::{KindRow, Mount, Site, Unit};
use kinds::{SensorFile, SensorKind};
use notice::NoticeChance;
use outbox::DeviceModel;
use std::sync::Arc;
use timing::FiringTiming;

/// A sensor as a run uses it.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensor {
    /// Its name in the home's file.
    pub name: String,
    /// Of sensors that look for movement.
    pub timing: FiringTiming,
    /// The chance by which a sensor that looks for movement notices one; `None` if it notices all.
    pub chance: Option<NoticeChance>,
    /// The model.
    pub kind: SensorKind,
    /// The position, seen from above.
    pub at: Point,
    /// The row of its kind.
    pub row: &'static KindRow,
    /// The room that it is in; nothing between rooms, as on a door.
    pub room: Option<RoomId>,
    /// Of its readings; nothing for one that gives none.
    pub unit: Option<Unit>,
}

/// The description of a sensor for the destinations of a log, which get it at the beginning.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorPlacement {
    /// As the home's file has it; a log may know the sensor by an id besides.
    pub name: String,
    /// The row of its kind.
    pub kind: &'static KindRow,
    /// The name of the room that it is in; nothing between rooms, as on a door.
    pub room: Option<String>,
    /// Of its readings; nothing for one that gives none.
    pub unit: Option<Unit>,
    /// Its values other than readings; their texts are those of logs that are stored as sent.
    pub values: &'static [Value],
    /// The position on the floor plan, in metres.
    pub at: Point,
}

impl Sensor {
    /// The sensor that a file describes; nothing where the plan does not have what it is on, or the room that it is in.
    pub fn new(file: &SensorFile, plan: &Plan) -> Option<Sensor> {
        let (kind, at) = SensorKind::placed(file, || site(file, plan))?;
        Some(Sensor {
            name: file.name().to_owned(),
            timing: FiringTiming::new(file.timing()),
            chance: file.notice_chance(),
            kind,
            at,
            row: file.row(),
            room: plan.room_at(at).map(RoomId::new),
            unit: file.row().unit.filter(|_| file.gives_readings()),
        })
    }

    /// The description for logs. `plan` is the plan of its home.
    pub fn info(&self, plan: &Plan) -> SensorPlacement {
        SensorPlacement {
            name: self.name.clone(),
            kind: self.row,
            room: self.room.map(|room| plan.rooms[room.index()].name.clone()),
            unit: self.unit,
            values: self.row.values,
            at: self.at,
        }
    }

    /// Whether it has a fan of beams, rather than an area below it.
    pub fn is_on_wall(&self) -> bool {
        self.row.mount == Mount::Wall
    }

    /// Whether it looks for movement, unlike a device.
    pub fn senses_motion(&self) -> bool {
        self.row.senses_motion()
    }

    /// True if its reports mean that a body is there: it looks for movement, or is a device that feels bodies.
    pub fn detects_presence(&self) -> bool {
        match &self.kind {
            SensorKind::Looking(_) => true,
            SensorKind::Device(device) => device.feels_bodies(),
        }
    }
}

/// The site of a device; `None` if the plan lacks the thing or the room.
fn site(file: &SensorFile, plan: &Plan) -> Option<Site> {
    if let Some(spot) = file.spot() {
        let at = geometry::point(spot);
        let lamp = plan.room_at(at).and_then(|room| plan.lamp(&plan.rooms[room].name));
        let outlook = Arc::new(Outlook::new(plan));
        let thing = ThingId::new(lamp.unwrap_or(plan.things.len()));
        return Some(Site { thing, at, outlook, ..Site::default() });
    }
    if let Some(area) = file.area() {
        let outline = geometry::points(area);
        let at = geometry::inner_point(&outline);
        return Some(Site { thing: ThingId::new(plan.things.len()), is_open: false, at, outline, ..Site::default() });
    }
    let thing = match (file.on(), file.room()) {
        (Some(on), _) => plan.thing(on)?,
        (None, room) => plan.lamp(room?)?,
    };
    let found = &plan.things[thing];
    let piece = file.on().and_then(|on| plan.piece(on));
    Some(Site {
        thing: ThingId::new(thing),
        is_open: found.on,
        at: found.at,
        outline: piece.map(|piece| piece.outline.clone()).unwrap_or_default(),
        height_m: piece.map_or(f64::INFINITY, |piece| piece.height_m),
        ..Site::default()
    })
}
