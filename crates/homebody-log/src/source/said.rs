//! Values of JSON as instants and as texts that a sensor reported.

use super::instant::{Instant, Instants, since_1970, since_1970_whole};
use serde_json::{Map, Value};
use std::borrow::Cow;

pub(super) type Object = Map<String, Value>;

/// An instant: a text with a date and a time, or a number since 1970. Of an interval, as SensorThings has them, the beginning.
pub(super) fn instant(value: &Value, instants: &mut Instants) -> Option<Instant> {
    match value {
        Value::String(text) => instant_of_text(text, instants),
        Value::Number(number) => match number.as_i64() {
            Some(whole) => since_1970_whole(whole),
            None => number.as_f64().and_then(since_1970),
        },
        _ => None,
    }
}

fn instant_of_text(text: &str, instants: &mut Instants) -> Option<Instant> {
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
pub(super) fn text(value: &Value) -> Cow<'_, str> {
    match value {
        Value::Null => Cow::Borrowed(""),
        Value::String(text) => Cow::Borrowed(text),
        other => Cow::Owned(other.to_string()),
    }
}

/// The first of these members that is a text or a number.
pub(super) fn member(object: &Object, names: &[&str]) -> Option<String> {
    let said = |name: &&str| match object.get(*name) {
        Some(Value::String(text)) => Some(text.trim().to_owned()).filter(|text| !text.is_empty()),
        Some(Value::Number(number)) => Some(number.to_string()),
        _ => None,
    };
    names.iter().find_map(said)
}
