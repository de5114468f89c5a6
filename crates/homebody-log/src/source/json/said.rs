//! Values of JSON as instants, as texts that a sensor reported, and as entities of Home Assistant.

use crate::log::SensorInfo;
use crate::source::instant::{InstantReader, LogInstant, since_1970, since_1970_whole};
use serde_json::{Map, Value};
use std::borrow::Cow;

pub(crate) type Object = Map<String, Value>;

/// An instant: a text with a date and a time, or a number since 1970. Of an interval, as SensorThings has them, the beginning.
pub(crate) fn instant(value: &Value, instants: &mut InstantReader) -> Option<LogInstant> {
    match value {
        Value::String(text) => instant_of_text(text, instants),
        Value::Number(number) => match number.as_i64() {
            Some(whole) => since_1970_whole(whole),
            None => number.as_f64().and_then(since_1970),
        },
        _ => None,
    }
}

fn instant_of_text(text: &str, instants: &mut InstantReader) -> Option<LogInstant> {
    if let Some(instant) = instants.read(text).or_else(|| since_1970_whole(text.parse().ok()?)) {
        return Some(instant);
    }
    if let Some((begin, _)) = text.split_once('/') {
        return instants.read(begin);
    }
    // mosquitto_sub writes the clock of the wall, a Z, and the offset.
    let (time, offset) = text.split_once('Z').filter(|(_, offset)| offset.starts_with(['+', '-']))?;
    instants.read(&format!("{time}{offset}"))
}

/// A value as the text that a sensor reported; null reports nothing.
pub(crate) fn text(value: &Value) -> Cow<'_, str> {
    match value {
        Value::Null => Cow::Borrowed(""),
        Value::String(text) => Cow::Borrowed(text),
        other => Cow::Owned(other.to_string()),
    }
}

/// The first of these members that is a text or a number.
pub(crate) fn member(object: &Object, names: &[&str]) -> Option<String> {
    let said = |name: &&str| match object.get(*name) {
        Some(Value::String(text)) => Some(text.trim().to_owned()).filter(|text| !text.is_empty()),
        Some(Value::Number(number)) => Some(number.to_string()),
        _ => None,
    };
    names.iter().find_map(said)
}

/// An entity as a sensor, by its id and its attributes: its kind is its `device_class`, or without one its domain.
pub(crate) fn entity(id: &str, attributes: Option<&Object>) -> SensorInfo {
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
pub(crate) fn is_entity(id: &str) -> bool {
    let is_word = |word: &str| {
        !word.is_empty() && word.bytes().all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'_')
    };
    id.split_once('.').is_some_and(|(domain, name)| {
        is_word(domain) && domain.starts_with(|letter: char| letter.is_ascii_lowercase()) && is_word(name)
    })
}
