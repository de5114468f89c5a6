//! What the file form of a device says of it: its kind, what it hangs on, what is wrong with it.
//!
//! Each device has a file of its own, with its row in the list of kinds, its form in `home.json` and its model.
//!
//! We assume that a device hangs on a thing, lies on the floor or stands in a room, and on nothing else.
//!
//! The check asks a form what it can know without the home, and compares the rest with the home by the form's row.
//!
//! Left out: what depends on other sensors, which the check and its remarks see to.

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
    /// What `home.json` calls it, such as `stove_temperature`.
    pub key: &'static str,
    /// What people call it, such as `motion, on a wall`.
    pub label: &'static str,
    /// Where it hangs or lies.
    pub mount: Mount,
    /// Of its readings; nothing for a kind that never says a number.
    pub unit: Option<Unit>,
    /// What it can say besides readings.
    pub values: &'static [Value],
    /// What it is drawn as, so that neither shape nor colour stands alone.
    pub shape: Shape,
    /// Its colour on plans and in legends; several kinds share one.
    pub colour: Colour,
    /// What its ids begin with in the homes of CASAS: `M` for motion, `D` for doors, `I` for items.
    pub casas: &'static str,
}

impl KindRow {
    /// Whether it looks for movement, rather than being told what happens.
    pub fn senses_motion(&self) -> bool {
        matches!(self.mount, Mount::Wall | Mount::Ceiling)
    }
}

/// Where a kind of sensor hangs or lies.
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

/// What a sensor can hang on or lie in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bearer {
    /// A door, or an open passage.
    Door,
    /// Any piece of furniture.
    Furniture,
    /// A piece of furniture in which people can be.
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

/// The form of a device in `home.json`.
pub trait DeviceForm {
    /// Its kind.
    fn row(&self) -> &'static KindRow;

    /// The name of the thing that it hangs on or lies in, where it does.
    fn on(&self) -> Option<&str> {
        None
    }

    /// The name of the room that it measures, where it does.
    fn room(&self) -> Option<&str> {
        None
    }

    /// The corners of the floor that it covers, where it lies on the floor.
    fn area(&self) -> Option<&[At]> {
        None
    }

    /// Where it hangs, where the file says the point.
    fn spot(&self) -> Option<At> {
        None
    }

    /// The names of the sensors whose words wake it, where it sleeps.
    fn woken_by(&self) -> &[String] {
        &[]
    }

    /// What is wrong with it whatever the home is like.
    fn wrong(&self) -> Vec<FormProblem> {
        Vec::new()
    }

    /// What it tells the very instant of; two sensors that do so of the same always speak at once.
    fn moment(&self) -> Option<ReportedInstant<'_>>;

    /// Whether this one says readings, where its kind has a unit.
    fn gives_readings(&self) -> bool {
        true
    }
}

/// Something wrong with a form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FormProblem {
    /// Where in the form, as the rest of a JSON pointer, such as `/levels_s/1`; empty for the whole of it.
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

/// What sensors tell the instant of, if they tell it as it happens.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ReportedInstant<'a> {
    /// Somebody has come into a piece of furniture, or left it, so long ago.
    Pressed(&'a str, Span),
    /// A thing is used.
    Used(&'a str),
}

/// Where a device is in the home: on a thing, in a room with its lamp, or on the floor.
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
    /// How high the piece of furniture is; 0 for the floor.
    pub height_m: f64,
    /// Of what looks around: what there is to see.
    pub outlook: Arc<Outlook>,
}

/// For keys of forms that are 0 unless they are given.
pub(super) fn is_zero(value: &f64) -> bool {
    *value == 0.0
}
