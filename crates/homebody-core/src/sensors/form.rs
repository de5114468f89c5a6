//! The form of a sensor in its file: its kind, its place, its problems.
//!
//! Each device has a file of its own, with its row in the list of kinds, its form in `home.json` and its model.
//!
//! We assume that a device hangs on a thing, lies on the floor or stands in a room, and on nothing else.
//!
//! The check asks a form what it can know without the home, and compares the rest with the home by the form's row.
//!
//! Left out: what depends on other sensors, which the check and its remarks see to.

use super::entities::EntityRow;
use super::meaning::Meaning;
use crate::camera::outlook::Outlook;
use crate::event::Value;
use crate::geometry::{At, Point};
use crate::ids::ThingId;
use crate::problem::Diagnostic;
use crate::time::Span;
use std::sync::Arc;

/// A kind of sensor, as check, page and the destinations of logs have to know it. All are in
/// [`KINDS`](super::kinds::KINDS).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KindRow {
    /// The key in `home.json`, such as `stove_temperature`.
    pub key: &'static str,
    /// The name for people, such as `motion, on a wall`.
    pub label: &'static str,
    /// The mounting.
    pub mount: Mount,
    /// Of its readings; nothing for a kind that never says a number.
    pub unit: Option<Unit>,
    /// The values other than readings.
    pub values: &'static [Value],
    /// The shape on plans, so that neither shape nor colour stands alone.
    pub shape: Shape,
    /// Its colour on plans and in legends; several kinds share one.
    pub colour: Colour,
    /// The beginning of its ids in the homes of CASAS: `M` for motion, `D` for doors, `I` for items.
    pub casas: &'static str,
    /// The meaning of its key as a word in logs of other systems, where it may stand for another sensor.
    pub meaning: Meaning,
    /// Its entities in monitoring systems; the main one comes first.
    pub entities: &'static [EntityRow],
}

impl KindRow {
    /// Whether it looks for movement, rather than being told what happens.
    pub fn senses_motion(&self) -> bool {
        matches!(self.mount, Mount::Wall | Mount::Ceiling)
    }
}

/// A mounting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mount {
    /// On a wall, looking into the room.
    Wall,
    /// On the ceiling, above an area.
    Ceiling,
    /// On or in a thing that the file names; where the kind allows it, on an area of the floor instead.
    Thing(&'static [Bearer]),
    /// Anywhere in a room that the file names.
    Room,
    /// At a point in a room, at a height that the file says.
    Free,
}

/// A bearer of a sensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bearer {
    /// A door, or an open passage.
    Door,
    /// Any piece of furniture.
    Furniture,
    /// An enterable piece of furniture.
    Enterable,
    /// A room's lamp, by the name of the room.
    Lamp,
}

/// A unit of readings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unit {
    /// Such as `°C`.
    pub symbol: &'static str,
    /// Such as `degrees Celsius`.
    pub name: &'static str,
}

impl Unit {
    /// Of temperatures.
    pub const CELSIUS: Unit = Unit { symbol: "°C", name: "degrees Celsius" };
    /// Of light on a surface.
    pub const LUX: Unit = Unit { symbol: "lx", name: "lux" };
    /// Of electric power.
    pub const WATTS: Unit = Unit { symbol: "W", name: "watts" };
}

/// The outline that stands for a kind on plans, in legends and before its rows. The page draws each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Of `motion`: it points to where the lens looks.
    Arrow,
    /// Of `ceiling_motion`.
    Ring,
    /// Of `bed`.
    Pill,
    /// Of `contact`: two halves with a gap between them.
    Gap,
    /// Of `pressure`.
    Hexagon,
    /// Of `power`.
    Bolt,
    /// Of `stove_temperature`.
    Flame,
    /// Of `flow`.
    Drop,
    /// Of `light`.
    Star,
    /// Of `temperature`.
    Cross,
    /// Of `camera`: it looks to where the lens does.
    Eye,
}

/// A colour of Okabe and Ito's palette, which the colour-blind tell apart, too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colour {
    /// RGB 230, 159, 0.
    Orange,
    /// RGB 86, 180, 233.
    Sky,
    /// RGB 0, 158, 115.
    Green,
    /// RGB 240, 228, 66.
    Yellow,
    /// RGB 0, 114, 178.
    Blue,
    /// RGB 213, 94, 0.
    Vermillion,
    /// RGB 204, 121, 167.
    Purple,
}

/// The position and direction of a lens, and its field of view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orientation {
    /// Seen from above.
    pub at: At,
    /// Height above the floor.
    pub height_m: f64,
    /// 0 is east, 90 is north.
    pub facing_deg: f64,
    /// Downward.
    pub tilt_deg: f64,
    /// Horizontal and vertical angle of view.
    pub field_deg: [f64; 2],
    /// Largest distance along the floor, if limited.
    pub reach_m: Option<f64>,
}

/// The form of a sensor in `home.json`. Most kinds need few of these methods.
pub trait SensorForm {
    /// The thing that it hangs on or lies in.
    fn on(&self) -> Option<&str> {
        None
    }

    /// The room that it measures.
    fn room(&self) -> Option<&str> {
        None
    }

    /// The corners of the floor that it covers, if it lies on the floor.
    fn area(&self) -> Option<&[At]> {
        None
    }

    /// The corners of the floor that it looks down on.
    fn area_below(&self) -> Option<&[At]> {
        None
    }

    /// The position of a device, if the file states it.
    fn spot(&self) -> Option<At> {
        None
    }

    /// The direction in which it looks, if it looks into a room.
    fn orientation(&self) -> Option<Orientation> {
        None
    }

    /// The number of lines that it sees along.
    fn beam_count(&self) -> u32 {
        0
    }

    /// Whether it counts pulses before it detects a movement.
    fn counts_pulses(&self) -> bool {
        false
    }

    /// The names of the sensors that wake it.
    fn woken_by(&self) -> &[String] {
        &[]
    }

    /// The problems of the form in any home.
    fn wrong(&self) -> Vec<FormProblem> {
        Vec::new()
    }

    /// The event that it reports at once. Two sensors that report the same one always send at the same instant.
    fn moment(&self) -> Option<ReportedInstant<'_>> {
        None
    }

    /// Whether it sends readings, if its kind has a unit.
    fn gives_readings(&self) -> bool {
        true
    }

    /// Hangs it elsewhere. False for a sensor that no fault of the link can move.
    fn relocate(&mut self, _at: At, _facing_deg: f64) -> bool {
        false
    }

    /// Sets height, angles of view and reach, if the form has them.
    fn set_field(&mut self, _height_m: f64, _field_deg: [f64; 2], _reach_m: f64) {}

    /// Multiplies the distance at which it looks for movement. False for a device.
    fn scale_reach(&mut self, _factor: f64) -> bool {
        false
    }
}

/// Something wrong with a form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FormProblem {
    /// The place in the form, as the rest of a JSON pointer, such as `/levels_s/1`; empty for the whole form.
    pub at: String,
    /// The message, such as a [`SensorMessage`](super::messages::SensorMessage).
    pub message: Diagnostic,
}

impl FormProblem {
    /// A problem at a place of the form.
    pub fn new(at: impl Into<String>, message: impl Into<Diagnostic>) -> FormProblem {
        FormProblem { at: at.into(), message: message.into() }
    }
}

/// An event whose instant a sensor reports at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ReportedInstant<'a> {
    /// A person has come into a piece of furniture, or left it; reported after this time.
    Pressed(&'a str, Span),
    /// A thing is used.
    Used(&'a str),
}

/// The place of a device in the home: on a thing, in a room with its lamp, or on the floor.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Site {
    /// The thing, or the lamp of the room.
    pub thing: ThingId,
    /// Whether the thing is open or on as a run begins.
    pub is_open: bool,
    /// Seen from above.
    pub at: Point,
    /// Of the piece of furniture, or of the area on the floor: convex.
    pub outline: Vec<Point>,
    /// The height of the piece of furniture; 0 for the floor.
    pub height_m: f64,
    /// Of what looks around: what there is to see.
    pub outlook: Arc<Outlook>,
}

/// For keys of forms that are 0 unless they are given.
pub(super) fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

/// Declares functions that give the usual values of keys, for serde.
macro_rules! usual {
    ($($(#[$doc:meta])* $vis:vis fn $name:ident() -> $type:ty = $value:expr;)*) => {
        $($(#[$doc])* $vis fn $name() -> $type { $value })*
    };
}

pub(super) use usual;
