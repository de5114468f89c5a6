//! A line of jq that makes rows of other objects of JSON, by their keys.

use super::said::{Object, instant};
use crate::log::ColumnRole;
use crate::source::columns::role_of;
use crate::source::instant::InstantReader;
use serde_json::Value;

/// The most objects within each other that are looked into.
const DEEPEST: usize = 4;

/// Such a line, for objects at a place such as `.rows[]`: an empty one is the text itself.
pub(crate) fn hint(place: &str, object: Option<&Object>, instants: &mut InstantReader) -> String {
    let each = if place.is_empty() { String::new() } else { format!("{place} | ") };
    let [time, sensor, value] = object
        .and_then(|object| keys(object, instants))
        .unwrap_or_else(|| [".when", ".who", ".what"].map(str::to_owned));
    format!("jq -c '{each}{{time: {time}, sensor: {sensor}, value: {value}}}'")
}

/// The keys of an object's time, of what may be its sensor, and of what may be its value; `None` where one of them is not there.
fn keys(object: &Object, instants: &mut InstantReader) -> Option<[String; 3]> {
    let mut all = Vec::new();
    paths("", object, DEEPEST, &mut all);
    let is_of = |path: &str, role: ColumnRole| {
        let key = path.rsplit(['.', '"']).find(|part| !part.is_empty()).unwrap_or_default();
        role_of(key).is_some_and(|(of, _)| of == role)
    };
    let time = all.iter().position(|(_, said)| instant(said, instants).is_some());
    let time =
        time.or_else(|| all.iter().position(|(path, said)| is_of(path, ColumnRole::Time) && said.is_string()))?;
    let (time, said) = all.remove(time);
    let time = if is_short_date(said) { format!("({time} | strptime({SHORT:?}) | todate)") } else { time };
    let find = |all: &[(String, &Value)], role: ColumnRole, may_be: &dyn Fn(&Value) -> bool| {
        let of_role = all.iter().position(|(path, said)| is_of(path, role) && !said.is_null());
        of_role.or_else(|| all.iter().position(|(path, said)| may_be(said) && !is_of(path, ColumnRole::Unused)))
    };
    let sensor = match find(&all, ColumnRole::Sensor, &|said| said.is_string()) {
        Some(sensor) => all.remove(sensor).0,
        None => "\"sensor\"".to_owned(),
    };
    let value = find(&all, ColumnRole::Value, &|said| said.is_number() || said.is_boolean())
        .or_else(|| all.iter().position(|(_, said)| said.is_string()))?;
    Some([time, sensor, all.remove(value).0])
}

/// A date whose year has two digits, as Fitbit writes it in jq's words: which number is the month is its own rule.
const SHORT: &str = "%m/%d/%y %H:%M:%S";

fn is_short_date(said: &Value) -> bool {
    let parts = said.as_str().map(|text| text.split(['/', ' ', ':']).map(str::len).collect::<Vec<_>>());
    parts == Some(vec![2; 6])
}

/// The texts, numbers and booleans in an object, each with its path as jq writes it.
fn paths<'o>(above: &str, object: &'o Object, deepest: usize, all: &mut Vec<(String, &'o Value)>) {
    for (key, said) in object {
        let path = format!("{above}{}", step(key));
        match said {
            Value::Object(inner) if deepest > 0 => paths(&path, inner, deepest - 1, all),
            Value::Object(_) | Value::Array(_) => {}
            said => all.push((path, said)),
        }
    }
}

/// A step of a path of jq: a key stands in quotes unless it is a plain word.
pub(crate) fn step(key: &str) -> String {
    let is_letter = |c: char| c.is_ascii_alphabetic() || c == '_';
    let is_word = key.starts_with(is_letter) && key.chars().all(|c| is_letter(c) || c.is_ascii_digit());
    // A quote of the shell in a key would end what jq is given.
    if is_word { format!(".{key}") } else { format!(".{}", Value::from(key.replace('\'', "?"))) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn the_line_names_the_keys_of_the_object() {
        let hint = |place: &str, object: Value| super::hint(place, object.as_object(), &mut InstantReader::default());
        let object = json!({"seq": 4, "at what time": "2026-02-02T06:00:00Z", "of": {"room-name": "hall"}, "is": {"warm": 21.5}});
        assert_eq!(
            hint(".rows[]", object),
            "jq -c '.rows[] | {time: .\"at what time\", sensor: .of.\"room-name\", value: .is.warm}'"
        );
        let named = json!({"note": "x", "stamp": 1770012000, "device": "hall", "extra": 1, "wert": "an"});
        assert_eq!(hint("", named), "jq -c '{time: .stamp, sensor: .device, value: .wert}'");
        assert_eq!(
            hint(".[]", json!({"dateTime": "01/05/20 23:00:00", "value": {"bpm": 51}})),
            "jq -c '.[] | {time: (.dateTime | strptime(\"%m/%d/%y %H:%M:%S\") | todate), sensor: \"sensor\", value: .value.bpm}'"
        );
        assert_eq!(hint(".[]", json!({"a": 1})), "jq -c '.[] | {time: .when, sensor: .who, value: .what}'");
    }
}
