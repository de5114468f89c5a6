//! The keys and members above a row in a text of JSON: they name its sensor if the row does not.

use super::hint::step;
use super::said::{Object, is_entity, member};
use crate::log::{ColumnRole, SensorInfo};
use serde_json::Value;
use std::collections::BTreeMap;

/// The lists and objects that a row is in, the outermost first.
#[derive(Default)]
pub(crate) struct Above {
    levels: Vec<JsonLevel>,
    /// By what stands above their rows, the names that sensors have got.
    named: BTreeMap<String, String>,
    taken: BTreeMap<String, String>,
}

/// A list or an object.
#[derive(Default)]
pub(crate) struct JsonLevel {
    /// Under which key it is in the object around it.
    pub key: Option<String>,
    pub is_list: bool,
    /// Of an object, its members but for long lists.
    pub members: Object,
    /// Of a list, the sensor of the row before: later rows may leave it out.
    pub last: Option<String>,
}

/// The name of each value of a list, as in jq.
pub(crate) const LIST: &str = "[]";

/// Keys that name lists of rows and nothing else, in lower case.
const GENERIC: [&str; 40] = [
    "daily", "data", "dataarray", "datapoints", "datastream", "datastreams", "entities", "entries", "event", "events",
    "fields", "history", "hourly", "items", "list", "log", "logs", "measurements", "messages", "objects",
    "observations", "output", "payload", "points", "readings", "records", "response", "result", "results", "rows",
    "samples", "sensors", "series", "state", "states", "things", "timeseries", "value", "values", "devices",
];

/// Members of an object that name a sensor, and those that tell objects of one name apart.
const NAMES: [&str; 8] = ["entity_id", "sensor", "device", "name", "target", "label", "sensor_id", "device_id"];
const IDS: [&str; 3] = ["@iot.id", "id", "uuid"];

/// Members whose own members name a series: of Prometheus and of InfluxDB.
const TAGS: [&str; 2] = ["metric", "tags"];

/// Members that describe a sensor.
const KINDS: [&str; 6] = ["device_class", "kind", "sensor_type", "sensorType", "deviceType", "device_type"];
const UNITS: [&str; 3] = ["unit", "unit_of_measurement", "uom"];
const ROOMS: [&str; 3] = ["room", "area", "location"];

impl Above {
    /// The role of a member that describes a sensor.
    pub fn role(name: &str) -> Option<ColumnRole> {
        let roles: [(&[&str], ColumnRole); 3] =
            [(&KINDS, ColumnRole::Kind), (&UNITS, ColumnRole::Unit), (&ROOMS, ColumnRole::Room)];
        roles.into_iter().find(|(names, _)| names.contains(&name)).map(|(_, role)| role)
    }

    pub fn enter(&mut self, level: JsonLevel) {
        self.levels.push(level);
    }

    pub fn leave(&mut self) {
        self.levels.pop();
    }

    pub fn depth(&self) -> usize {
        self.levels.len()
    }

    pub fn innermost(&mut self) -> Option<&mut JsonLevel> {
        self.levels.last_mut()
    }

    pub fn key(&self) -> Option<&str> {
        self.levels.last()?.key.as_deref()
    }

    /// The place of the next value, as jq writes it: `.rows[]`.
    pub fn path(&self) -> String {
        let step = |level: &JsonLevel| {
            let key = level.key.as_deref().map(step).unwrap_or_default();
            if level.is_list { key + LIST } else { key }
        };
        let path: String = self.levels.iter().map(step).collect();
        if path.starts_with('[') { format!(".{path}") } else { path }
    }

    /// The nearest list of names that columns of rows have.
    pub fn columns(&self) -> Option<Vec<String>> {
        let of_level = |level: &JsonLevel| {
            let names = ["columns", "components"].iter().find_map(|key| level.members.get(*key))?.as_array()?;
            names.iter().map(|name| name.as_str().map(str::to_owned)).collect()
        };
        self.levels.iter().rev().find_map(of_level)
    }

    /// The sensor of a row that does not name it, by all that stands above; None where nothing names one.
    pub fn sensor(&mut self, row: &Object) -> Option<String> {
        let of_row = || match row.get("Datastream") {
            Some(Value::Object(datastream)) => Some(named(datastream)),
            _ => Some(("".to_owned(), link(row)?)),
        };
        if let Some(entity) = self.key().filter(|key| is_entity(key)) {
            return Some(entity.to_owned());
        }
        let (mut names, mut ids, mut path) = (Vec::new(), Vec::new(), String::new());
        for level in &self.levels {
            let (name, id) = named(&level.members);
            let key = level.key.as_ref().filter(|key| !is_generic(key));
            path = format!("{path}\u{0}{}\u{0}{id}", key.map_or("", |key| key));
            names.push(if name.is_empty() { key.cloned().unwrap_or_default() } else { name });
            ids.push(id);
            ids.extend(link(&level.members));
        }
        if let Some((name, id)) = of_row() {
            path = format!("{path}\u{0}{id}");
            names.push(name);
            ids.push(id);
        }
        names.retain(|name| !name.is_empty());
        if names.is_empty() {
            names = ids.into_iter().filter(|id| !id.is_empty()).collect();
        }
        names.dedup();
        (!names.is_empty()).then(|| self.apart(names.join(" "), path))
    }

    /// A name that no other place in the text has got.
    fn apart(&mut self, name: String, path: String) -> String {
        let place = format!("{name}{path}");
        if let Some(known) = self.named.get(&place) {
            return known.clone();
        }
        let free = |name: &String, taken: &BTreeMap<String, String>| !taken.contains_key(name);
        let id = path.rsplit('\u{0}').find(|id| !id.is_empty()).unwrap_or("2").to_owned();
        let mut own = name.clone();
        let mut number = 2;
        if !free(&own, &self.taken) {
            own = format!("{name} ({id})");
        }
        while !free(&own, &self.taken) {
            own = format!("{name} ({id}, {number})");
            number += 1;
        }
        self.taken.insert(own.clone(), place.clone());
        self.named.insert(place, own.clone());
        own
    }

    /// The first member of these names in an object around a row, the innermost first, and what it says.
    pub fn member(&self, is_wanted: &dyn Fn(&str) -> bool) -> Option<(&str, &Value)> {
        let members = self.levels.iter().rev().flat_map(|level| &level.members);
        members.map(|(key, said)| (key.as_str(), said)).find(|(key, said)| is_wanted(key) && !said.is_null())
    }

    /// The sensor of a row, by the members above it and its own.
    pub fn info(&self, sensor: &str, row: &Object) -> SensorInfo {
        let datastream = row.get("Datastream").and_then(Value::as_object);
        let objects: Vec<&Object> =
            [row].into_iter().chain(datastream).chain(self.levels.iter().rev().map(|level| &level.members)).collect();
        let first = |names: &[&str]| objects.iter().find_map(|object| member(object, names));
        let inner =
            |key: &str, names: &[&str]| objects.iter().find_map(|object| member(object.get(key)?.as_object()?, names));
        let kind = first(&KINDS);
        let kind = kind.or_else(|| inner("ObservedProperty", &["name"])).unwrap_or_default().to_lowercase();
        SensorInfo {
            is_motion: kind.ends_with("motion"),
            kind,
            unit: inner("unitOfMeasurement", &["symbol", "name"]).or_else(|| first(&UNITS)),
            room: first(&ROOMS),
            ..SensorInfo::named(sensor)
        }
    }
}

fn is_generic(key: &str) -> bool {
    GENERIC.iter().any(|generic| generic.eq_ignore_ascii_case(key))
}

/// The name of an object, and the id that parts it from others of that name.
fn named(object: &Object) -> (String, String) {
    let tags = TAGS.iter().filter_map(|key| object.get(*key)?.as_object());
    let tags: Vec<String> = tags.flat_map(|tags| tags.keys().filter_map(|key| member(tags, &[key]))).collect();
    let name: Vec<String> = member(object, &NAMES).into_iter().chain(tags).collect();
    (name.join(" "), member(object, &IDS).unwrap_or_default())
}

/// Which datastream of SensorThings a link leads to, such as `Datastreams(12)`.
fn link(object: &Object) -> Option<String> {
    let links = ["Datastream@iot.navigationLink", "@iot.nextLink", "@iot.selfLink"];
    let link = links.iter().filter_map(|key| object.get(*key)?.as_str());
    // A link that leads by way of an observation names no datastream.
    link.filter(|link| !link.contains("Observations(")).find_map(|link| {
        let own = &link[link.find("Datastreams(")?..];
        own.find(')').map(|end| own[..=end].to_owned())
    })
}
