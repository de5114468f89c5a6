//! The numbers of all models of this crate, in reading order.

use crate::body::track;
use crate::camera::noise;
use crate::numbers::Number;
use crate::sensors::{bed, camera, light, power, stove_temperature, temperature};
use crate::{link, outside, plan, resident, world};

/// All of them: of sensors and what they see, and of the link.
pub fn numbers() -> Vec<Number> {
    let modules = [
        resident::NUMBERS,
        plan::sun::NUMBERS,
        world::NUMBERS,
        bed::NUMBERS,
        stove_temperature::NUMBERS,
        power::NUMBERS,
        light::NUMBERS,
        temperature::NUMBERS,
        camera::NUMBERS,
        noise::NUMBERS,
        track::NUMBERS,
        link::NUMBERS,
        link::radio::NUMBERS,
        outside::NUMBERS,
    ];
    modules.concat().into_iter().cloned().collect()
}
