//! Entities of Home Assistant: what their ids and attributes report of a sensor.

use super::said::{Object, member};
use crate::sensor_info::SensorInfo;

/// An entity as a sensor, by its id and its attributes: its kind is its `device_class`, or without one its domain.
pub(super) fn entity(id: &str, attributes: Option<&Object>) -> SensorInfo {
    let attribute = |names: &[&str]| attributes.and_then(|attributes| member(attributes, names));
    let domain = id.split_once('.').map_or("", |(domain, _)| domain);
    let kind = attribute(&["device_class"]).unwrap_or_else(|| domain.to_owned());
    SensorInfo {
        name: attribute(&["friendly_name"]).unwrap_or_else(|| id.to_owned()),
        is_motion: kind == "motion",
        kind,
        unit: attribute(&["unit_of_measurement"]),
        room: attribute(&["area", "area_name", "area_id"]),
        ..SensorInfo::named(id)
    }
}

/// Whether a text is an entity's id, such as `binary_sensor.hall`.
pub(super) fn is_entity(id: &str) -> bool {
    let is_word = |word: &str| {
        !word.is_empty() && word.bytes().all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'_')
    };
    id.split_once('.').is_some_and(|(domain, name)| {
        is_word(domain) && domain.starts_with(|letter: char| letter.is_ascii_lowercase()) && is_word(name)
    })
}
