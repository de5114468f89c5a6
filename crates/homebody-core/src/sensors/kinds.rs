//! The kinds of sensors: the one list of them.
//!
//! It says of each kind what check, page and the destinations of logs have to know.
//!
//! We assume that all sensors of a kind say the same things, but for readings that a sensor's form turns off.
//!
//! A device is one line of `devices!`: the variant that it is of [`SensorFile`](crate::scenario::home::SensorFile) and of
//! [`Device`](super::device::Device), and its module, which has its row, its form and its model.
//!
//! Left out: how a sensor works, which its module says.

use super::form::{Colour, KindRow, Mount, Shape};
use crate::event::Value;

/// Hands the devices to a macro, in the order in which documents list them.
macro_rules! devices {
    ($to:ident) => {
        $to! {
            Contact(contact, ContactFile)
            Bed(bed, BedFile)
            StoveTemperature(stove_temperature, StoveTemperatureFile)
            Pressure(pressure, PressureFile)
            Power(power, PowerFile)
            Flow(flow, FlowFile)
            Light(light, LightFile)
            Temperature(temperature, TemperatureFile)
            Camera(camera, CameraFile)
        }
    };
}
pub(crate) use devices;

macro_rules! rows {
    ($($kind:ident($module:ident, $form:ident))*) => {
        /// All kinds of sensors: those that look for movement, then those that are told what happens.
        pub static KINDS: &[&KindRow] = &[&MOTION, &CEILING_MOTION, $(&super::$module::ROW),*];
    };
}
devices!(rows);

/// A sensor on a wall.
pub static MOTION: KindRow = KindRow {
    key: "motion",
    label: "motion, on a wall",
    mount: Mount::Wall,
    unit: None,
    values: &[Value::Fire],
    shape: Shape::Arrow,
    colour: Colour::Blue,
    casas: "M",
};

/// A sensor on the ceiling.
pub static CEILING_MOTION: KindRow = KindRow {
    key: "ceiling_motion",
    label: "motion, from the ceiling",
    mount: Mount::Ceiling,
    unit: None,
    values: &[Value::Fire],
    shape: Shape::Ring,
    colour: Colour::Sky,
    casas: "M",
};
