//! Points of InfluxDB: a measurement with tags, whose fields are readings at an instant.
//!
//! Home Assistant writes an entity's id and domain as tags, its state as a word and as a number, and its attributes as further fields. Of
//! the two states the word is taken. Tags of other programs name a sensor if one of them is called so, and all together if not.

pub(crate) mod csv;
pub(crate) mod lines;

use super::gathered::Gathered;
use super::instant::LogInstant;
use crate::error::LogError;
use crate::log::{ColumnRole, SensorInfo};
use std::collections::{BTreeMap, BTreeSet};

#[derive(Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct InfluxPoint {
    pub measurement: String,
    pub tags: Vec<(String, String)>,
    pub fields: Vec<(String, String)>,
}

/// The tags that name a sensor.
const SENSORS: [&str; 8] = ["entity_id", "sensor", "sensor_id", "device", "device_id", "item", "name", "friendly_name"];

/// Those that tell its room, its kind and its unit.
const ROOMS: [&str; 3] = ["room", "area", "location"];
const KINDS: [&str; 3] = ["device_class", "kind", "sensor_type"];
const UNITS: [&str; 2] = ["unit", "unit_of_measurement"];

/// The field of a state as a number, and as a word.
const VALUE: &str = "value";
const STATE: &str = "state";

/// The ending of fields that are text attributes of Home Assistant.
const TEXT: &str = "_str";

#[derive(Default)]
pub(crate) struct Series {
    named: BTreeMap<InfluxPoint, String>,
    taken: BTreeSet<String>,
    /// The fields of each series, where they come in rows of their own.
    pub fields: BTreeMap<InfluxPoint, BTreeSet<String>>,
}

impl InfluxPoint {
    fn tag(&self, names: &[&str]) -> Option<&str> {
        let tag = |name: &&str| self.tags.iter().find(|(key, _)| key == name);
        names.iter().find_map(tag).map(|(_, value)| value.as_str()).filter(|value| !value.is_empty())
    }

    fn field(&self, name: &str) -> Option<&str> {
        self.fields.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
    }

    /// Its series: all but its fields.
    pub fn series(&self) -> InfluxPoint {
        let mut tags = self.tags.clone();
        tags.sort();
        InfluxPoint { measurement: self.measurement.clone(), tags, fields: Vec::new() }
    }

    /// The name of its sensor, which another series may have, too.
    fn name(&self) -> String {
        match (self.tag(&["entity_id"]), self.tag(&["domain"])) {
            (Some(entity), Some(domain)) if !entity.contains('.') => format!("{domain}.{entity}"),
            _ => match self.tag(&SENSORS) {
                Some(sensor) => sensor.to_owned(),
                None => {
                    let tags = self.tags.iter().map(|(_, value)| value.as_str());
                    [self.measurement.as_str()].into_iter().chain(tags).collect::<Vec<_>>().join(" ")
                }
            },
        }
    }
}

impl Series {
    pub fn take(
        &mut self,
        line: u64,
        at: LogInstant,
        point: &InfluxPoint,
        out: &mut Gathered<'_, '_>,
    ) -> Result<(), LogError> {
        let series = point.series();
        let is_entity = point.tag(&["entity_id"]).is_some();
        let beside = self.fields.get(&series);
        let has = |name: &str| point.field(name).is_some() || beside.is_some_and(|fields| fields.contains(name));
        let has_word = is_entity && has(STATE) && has(VALUE);
        let sensor = self.sensor(series);
        self.know(&sensor, point, out);
        for (field, value) in &point.fields {
            match field.as_str() {
                VALUE if has_word => out.count("states as numbers beside the same states as words, passed over"),
                VALUE | STATE => {
                    out.column(field, ColumnRole::Value, "the name of the field");
                    out.row(line, at, [&sensor, value], None)?;
                }
                field if field.ends_with(TEXT) || is_entity && point.tag(&["domain"]).is_some() => {
                    out.count("attributes of entities beside their states, passed over");
                }
                field => {
                    // A pivoted table may have no word of its series.
                    let own = format!("{sensor} {field}").trim_start().to_owned();
                    out.column(field, ColumnRole::OneSensor, "each field is a reading of its own");
                    if !out.knows(&own) {
                        let unit = point.tag(&UNITS).map(str::to_owned);
                        let room = point.tag(&ROOMS).map(str::to_owned);
                        out.know(SensorInfo { kind: field.to_lowercase(), unit, room, ..SensorInfo::named(&own) });
                    }
                    out.row(line, at, [&own, value], None)?;
                }
            }
        }
        Ok(())
    }

    fn sensor(&mut self, series: InfluxPoint) -> String {
        if let Some(known) = self.named.get(&series) {
            return known.clone();
        }
        let name = series.name();
        let mut own = name.clone();
        if self.taken.contains(&own) {
            let tags = series.tags.iter().map(|(key, value)| format!(", {key}={value}"));
            own = format!("{name} ({}{})", series.measurement, tags.collect::<String>());
        }
        self.taken.insert(own.clone());
        self.named.insert(series, own.clone());
        own
    }

    fn know(&self, sensor: &str, point: &InfluxPoint, out: &mut Gathered<'_, '_>) {
        let attribute = |name: &str| point.field(&format!("{name}{TEXT}")).or_else(|| point.field(name));
        let domain = point.tag(&["domain"]);
        let class = point.tag(&KINDS).or_else(|| attribute("device_class"));
        if out.knows(sensor) && class.is_none() {
            return;
        }
        out.column("the tags", ColumnRole::Sensor, "they name a series");
        let kind = class.or(domain).unwrap_or(&point.measurement).to_lowercase();
        // A measurement that is called so says nothing of the sensor.
        let kind = if kind == STATE { String::new() } else { kind };
        // So Home Assistant calls the measurement of a sensor that has a unit.
        let of_domain = Some(point.measurement.as_str()).filter(|name| domain == Some("sensor") && !is_word(name));
        let named = attribute("friendly_name").map_or_else(|| sensor.to_owned(), str::to_owned);
        out.know(SensorInfo {
            name: named,
            is_motion: kind == "motion",
            kind,
            unit: point.tag(&UNITS).or_else(|| attribute("unit_of_measurement")).or(of_domain).map(str::to_owned),
            room: point.tag(&ROOMS).map(str::to_owned),
            ..SensorInfo::named(sensor)
        });
    }
}

fn is_word(measurement: &str) -> bool {
    measurement == STATE || measurement == "sensor" || measurement.contains(['.', '_'])
}
