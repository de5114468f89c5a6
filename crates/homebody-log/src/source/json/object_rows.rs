//! Rows as objects of JSON have them: what an object's keys are taken for, and the rows that it makes.
//!
//! An object has a time, and then a sensor and a value; or a value alone, whose sensor is named above it; or a sensor, whose readings
//! are all its other keys; or a topic and a payload of MQTT. Keys in inner objects count as keys of their own, such as `device.id`.

use super::above::Above;
use super::devices::{DeviceReport, report};
use super::one_home::{OneHome, is_home};
use super::payload::{GatewayMessage, Payloads};
use super::said::{Object, entity, instant, is_entity, member, text};
use crate::error::LogError;
use crate::log::ColumnRole;
use crate::source::columns::{CERTAIN, ColumnPlaces, plain, role_of};
use crate::source::gathered::Gathered;
use crate::source::instant::LogInstant;
use crate::source::instant::date_parts::no_instant;
use foldhash::HashMap;
use homebody_core::scenario::logger::LoggerFile;
use serde_json::Value;

/// The parts of a row, by their places among an object's keys.
#[derive(Clone, Copy, Debug)]
enum ObjectShape {
    /// Time, sensor and value.
    Whole(ColumnPlaces),
    /// The same, by their places alone: sensor and value are right behind the time.
    Guessed(ColumnPlaces),
    /// Time and value.
    Reading(ColumnPlaces),
    Device {
        time: usize,
        sensor: usize,
    },
    Wide {
        time: usize,
    },
    Message {
        time: usize,
        topic: usize,
        payload: usize,
    },
}

/// By which names keys are looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum KeyNames {
    /// By their own, and those of inner objects not at all.
    Own,
    /// With those of inner objects, all the way down: `device_id` of `{"device": {"id": 1}}`.
    Whole,
    /// With those of inner objects, by the last of them alone: `id`.
    Last,
    /// As their own, by any name that a table's column may have for its role.
    Roles,
    /// As the last of inner objects, by any such name.
    LastRoles,
}

impl KeyNames {
    /// Whether inner objects are left whole.
    fn is_own(self) -> bool {
        matches!(self, KeyNames::Own | KeyNames::Roles)
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ObjectUse {
    Row,
    /// It was to be a row, and something in it is wrong, which is reported.
    Broken,
    Nothing,
}

#[derive(Default)]
pub(crate) struct ObjectRows {
    /// By the keys of the last object: nearly all have the same. Beside the shape stand the names that led to it.
    known: Option<(Vec<String>, (ObjectShape, KeyNames))>,
    payloads: Payloads,
    /// The last state of each entity of Home Assistant, and since when it is.
    states: HashMap<String, (LogInstant, String)>,
    /// The home or person whose rows are read.
    homes: OneHome,
    /// Whether the places of keys decide if their names do not.
    by_place: bool,
}

/// Keys of other programs, and the names that tables have for them.
const ALIASES: [(&str, &str); 34] = [
    ("when", "time"),
    ("tst", "time"),
    ("_time", "time"),
    ("phenomenonTime", "time"),
    ("resultTime", "time"),
    ("event_time", "time"),
    ("created_at", "time"),
    ("observed_at", "time"),
    ("recorded_at", "time"),
    ("date", "time"),
    ("datum", "time"),
    ("zeit", "time"),
    ("zeitstempel", "time"),
    ("last_updated", "last_changed"),
    ("entity", "sensor"),
    ("sensor_name", "sensor"),
    ("sensorName", "sensor"),
    ("sensorId", "sensor"),
    ("device_name", "sensor"),
    ("deviceName", "sensor"),
    ("deviceId", "sensor"),
    ("geraet", "sensor"),
    ("gerät", "sensor"),
    ("capteur", "sensor"),
    ("result", "value"),
    ("_value", "value"),
    ("reading", "value"),
    ("wert", "value"),
    ("zustand", "value"),
    ("valeur", "value"),
    ("newState", "value"),
    ("new_state", "value"),
    ("newValue", "value"),
    ("new_value", "value"),
];

/// Keys that tell which of a device's readings a value is. One that is called so is the device's own.
const ATTRIBUTES: [&str; 5] = ["propertyName", "property_name", "property", "attribute", "capability"];
const OWN: &str = "value";

/// Pairs of keys: if an object has both, the second is passed over.
const RATHER: [(&str, &str); 2] = [("phenomenonTime", "resultTime"), ("last_changed", "last_updated")];

const NAMELESS: &str = "nothing names its sensor: no key such as sensor, device or entity_id, and no name above it";

/// The most objects within each other in a row.
const DEEPEST: usize = 4;

impl ObjectRows {
    /// Objects of lines: if names say nothing, places do.
    pub fn of_lines() -> ObjectRows {
        ObjectRows { by_place: true, ..ObjectRows::default() }
    }

    /// Takes an object as a row, if it is one. If it names no sensor, the members `above` it do.
    pub fn take(
        &mut self,
        line: u64,
        object: &Object,
        above: &mut Above,
        file: &LoggerFile,
        out: &mut Gathered<'_, '_>,
    ) -> Result<ObjectUse, LogError> {
        if let Some(instant) = of_recorder(object, out) {
            return Ok(instant);
        }
        if let Some(state) = changed(object) {
            return self.take(line, state, above, file, out);
        }
        if let Some(report) = report(object, &|key| above.member(&|name| name == key).map(|(_, said)| said)) {
            return self.report(line, &report, object, above, out);
        }
        let Some((shape, names)) = self.shape(object, file, out) else { return Ok(ObjectUse::Nothing) };
        let members = members(object, names);
        let said = |place: usize| members.get(place).map_or(&Value::Null, |(_, said)| *said);
        let (ObjectShape::Whole(ColumnPlaces { time, .. })
        | ObjectShape::Guessed(ColumnPlaces { time, .. })
        | ObjectShape::Reading(ColumnPlaces { time, .. })
        | ObjectShape::Device { time, .. }
        | ObjectShape::Wide { time }
        | ObjectShape::Message { time, .. }) = shape;
        let Some(at) = instant_of(&members, time, out) else {
            out.reading.skip(line, no_instant(&text(said(time))));
            return Ok(ObjectUse::Broken);
        };
        if !self.homes.admit(&members, above, out)? {
            return Ok(ObjectUse::Row);
        }
        match shape {
            ObjectShape::Whole(places) | ObjectShape::Guessed(places) => {
                let sensor = with_attribute(text(said(places.sensor)).into_owned(), object);
                if !is_entity(&sensor) && !out.knows(&sensor) {
                    out.know(above.info(&sensor, object));
                }
                let list = above.innermost().filter(|_| is_entity(&sensor));
                if let Some(list) = list {
                    list.last = Some(sensor.clone());
                }
                self.state(line, at, &sensor, &members, &places, object, out)?;
            }
            ObjectShape::Reading(places) => {
                let before = above.innermost().and_then(|list| list.last.clone());
                let named = before.or_else(|| above.sensor(object)).or_else(|| out.named_by_file());
                let Some(sensor) = named.map(|named| with_attribute(named, object)) else {
                    out.reading.skip(line, NAMELESS.into());
                    return Ok(ObjectUse::Broken);
                };
                if !is_entity(&sensor) && !out.knows(&sensor) {
                    out.know(above.info(&sensor, object));
                }
                self.state(line, at, &sensor, &members, &places, object, out)?;
            }
            ObjectShape::Message { topic, payload, .. } => {
                let topic = text(said(topic));
                let message = GatewayMessage { line, instant: at, topic: &topic, is_zigbee: false };
                self.payloads.value(&message, said(payload), out)?;
            }
            ObjectShape::Device { sensor, .. } => {
                let device = text(said(sensor));
                let message = GatewayMessage { line, instant: at, topic: "", is_zigbee: false };
                self.payloads.readings(&message, &device, &without(&members, &[time, sensor]), out)?;
            }
            ObjectShape::Wide { .. } => {
                let message = GatewayMessage { line, instant: at, topic: "", is_zigbee: false };
                let device = above.sensor(object).unwrap_or_default();
                self.payloads.readings(&message, &device, &without(&members, &[time]), out)?;
            }
        }
        Ok(ObjectUse::Row)
    }

    /// The shape of an object, and the names that led to it.
    fn shape(
        &mut self,
        object: &Object,
        file: &LoggerFile,
        out: &mut Gathered<'_, '_>,
    ) -> Option<(ObjectShape, KeyNames)> {
        if !self.known.as_ref().is_some_and(|(keys, _)| keys.iter().eq(object.keys())) {
            let by_names = |names| Some((shape(&members(object, names), names, file, out)?, names));
            let mut shape = [KeyNames::Own, KeyNames::Whole, KeyNames::Last, KeyNames::Roles, KeyNames::LastRoles]
                .into_iter()
                .find_map(by_names);
            if shape.is_none() && self.by_place {
                shape = guessed(&members(object, KeyNames::Own), out).map(|shape| (shape, KeyNames::Own));
            }
            if let Some((shape, names)) = shape {
                tell(shape, &members(object, names), out);
            }
            // An object without a shape decides nothing: the next one may have other values under the same keys.
            self.known = shape.map(|shape| (object.keys().cloned().collect(), shape));
        }
        self.known.as_ref().map(|(_, shape)| *shape)
    }

    /// Ends the rows.
    ///
    /// # Errors
    ///
    /// If none of them is of the home that was asked for.
    pub fn end(&self, out: &Gathered<'_, '_>) -> Result<(), LogError> {
        self.homes.end(out)
    }

    fn report(
        &mut self,
        line: u64,
        report: &DeviceReport,
        object: &Object,
        above: &Above,
        out: &mut Gathered<'_, '_>,
    ) -> Result<ObjectUse, LogError> {
        let Some(at) = instant(&report.time, &mut out.reading.instants) else {
            out.reading.skip(line, no_instant(&text(&report.time)));
            return Ok(ObjectUse::Broken);
        };
        if !self.homes.admit(&members(object, KeyNames::Own), above, out)? {
            return Ok(ObjectUse::Row);
        }
        out.column("the keys of readings", ColumnRole::OneSensor, "each is a reading of the device");
        if let Some(state) = &report.state {
            out.row(line, at, [&report.device, state], None)?;
        }
        let message = GatewayMessage { line, instant: at, topic: "", is_zigbee: false };
        self.payloads.readings(&message, &report.device, &report.readings, out)?;
        Ok(ObjectUse::Row)
    }

    /// Takes what a sensor reported; of Home Assistant, what its attributes report of the entity, too.
    #[expect(clippy::too_many_arguments, reason = "all of them are parts of one row")]
    fn state(
        &mut self,
        line: u64,
        at: LogInstant,
        sensor: &str,
        members: &[(String, &Value)],
        places: &ColumnPlaces,
        object: &Object,
        out: &mut Gathered<'_, '_>,
    ) -> Result<(), LogError> {
        let said = members.get(places.value).map_or(&Value::Null, |(_, said)| *said);
        if said.is_null() {
            out.reading.skip(line, "there is no value".into());
            return Ok(());
        }
        if let Some(inner) = said.as_object().filter(|inner| inner.values().any(|said| !said.is_array())) {
            let message = GatewayMessage { line, instant: at, topic: "", is_zigbee: false };
            return self.payloads.readings(&message, sensor, inner, out);
        }
        let value = text(said);
        if is_entity(sensor) {
            let attributes = object.get("attributes").or_else(|| object.get("a")).and_then(Value::as_object);
            if attributes.is_some() || !out.knows(sensor) {
                out.know(entity(sensor, attributes));
            }
            // Home Assistant writes a state anew when its attributes change.
            let is_same = self.states.get(sensor).is_some_and(|(since, state)| *since == at && *state == value);
            if is_same && members[places.time].0 != "time" {
                out.count("rows in which only attributes changed, passed over");
                return Ok(());
            }
            self.states.insert(sensor.to_owned(), (at, value.clone().into_owned()));
        }
        let label = places.label.map(|place| members.get(place).map_or(&Value::Null, |(_, said)| *said));
        let label = label.map(text);
        out.row(line, at, [sensor, &value], label.as_deref().map(|label| Some(label).filter(|label| !label.is_empty())))
    }
}

/// The sensor of a value that is one of several of a device.
fn with_attribute(sensor: String, object: &Object) -> String {
    match member(object, &ATTRIBUTES).filter(|attribute| attribute != OWN && *attribute != sensor) {
        Some(attribute) => format!("{sensor} {attribute}"),
        None => sensor,
    }
}

/// Takes a row of Home Assistant's logbook that its recorder stopped or started.
fn of_recorder(object: &Object, out: &mut Gathered<'_, '_>) -> Option<ObjectUse> {
    let domain = object.get("domain")?.as_str()?;
    let message = object.get("message")?.as_str()?;
    if domain != "homeassistant" || object.contains_key("entity_id") {
        return None;
    }
    let at = instant(object.get("when")?, &mut out.reading.instants)?;
    match message {
        "stopped" => out.stop(at),
        "started" => out.start(at),
        _ => {}
    }
    out.count("rows of the logbook that are about Home Assistant itself");
    Some(ObjectUse::Row)
}

/// The new state in an event of Home Assistant's that an entity has changed.
fn changed(object: &Object) -> Option<&Object> {
    let event = object.get("event").and_then(Value::as_object).unwrap_or(object);
    event.get("data")?.get("new_state")?.as_object()
}

/// The instant of a row; a date in a member of its own is put before a time of day.
fn instant_of(members: &[(String, &Value)], time: usize, out: &mut Gathered<'_, '_>) -> Option<LogInstant> {
    let (_, said) = members.get(time)?;
    instant(said, &mut out.reading.instants).or_else(|| {
        let (_, date) = members.iter().find(|(name, _)| name.eq_ignore_ascii_case("date"))?;
        out.reading.instants.read(&format!("{} {}", date.as_str()?, said.as_str()?))
    })
}

/// The members of an object, by the names that tables would give them.
fn members(object: &Object, names: KeyNames) -> Vec<(String, &Value)> {
    let is_state = object.contains_key("s") && (object.contains_key("lu") || object.contains_key("lc"));
    let mut members = Vec::with_capacity(object.len());
    for (key, said) in object {
        match said {
            Value::Object(inner) if !names.is_own() => flatten(key, inner, names, DEEPEST, &mut members),
            said => {
                let key = match key.as_str() {
                    "s" if is_state => "state",
                    "lc" if is_state => "last_changed",
                    "lu" if is_state && !object.contains_key("lc") => "last_changed",
                    key => key,
                };
                members.push((key.to_owned(), said));
            }
        }
    }
    for at in 0..members.len() {
        let has = |name: &str| members.iter().any(|(other, _)| other == name);
        let key = &*members[at].0;
        let is_second = RATHER.iter().any(|(first, second)| *second == key && has(first));
        let alias =
            ALIASES.iter().find(|(other, usual)| other.eq_ignore_ascii_case(key) && !has(usual)).filter(|_| !is_second);
        if let Some((_, usual)) = alias {
            (*usual).clone_into(&mut members[at].0);
        }
    }
    if matches!(names, KeyNames::Roles | KeyNames::LastRoles) {
        name_by_roles(&mut members);
    }
    members
}

/// Names members that may be a time, a sensor or a value so, the most certain one first, where none is called so.
fn name_by_roles(members: &mut [(String, &Value)]) {
    for (role, usual) in [(ColumnRole::Time, "time"), (ColumnRole::Sensor, "sensor"), (ColumnRole::Value, "value")] {
        let may_be = |said: &Value| match role {
            ColumnRole::Value => !said.is_null() && !said.is_array(),
            ColumnRole::Time => said.is_string() || said.is_number(),
            _ => said.is_string() || said.is_u64(),
        };
        let rank = |(name, said): &(String, &Value)| {
            role_of(name).filter(|(of, _)| *of == role && may_be(said)).map(|(_, rank)| rank)
        };
        let best = members.iter().enumerate().filter_map(|(at, member)| Some((rank(member)?, at))).min();
        if let Some((CERTAIN.., at)) = best {
            usual.clone_into(&mut members[at].0);
        }
    }
}

/// Adds the members of inner objects.
fn flatten<'o>(
    above: &str,
    object: &'o Object,
    names: KeyNames,
    deepest: usize,
    members: &mut Vec<(String, &'o Value)>,
) {
    for (key, said) in object {
        let name = if names == KeyNames::Whole { format!("{above}_{key}") } else { key.clone() };
        match said {
            Value::Object(inner) if deepest > 0 => flatten(&name, inner, names, deepest - 1, members),
            said => members.push((name, said)),
        }
    }
}

/// The shape of an object with these members, by the usual names of a table's columns.
fn shape(
    members: &[(String, &Value)],
    by: KeyNames,
    file: &LoggerFile,
    out: &mut Gathered<'_, '_>,
) -> Option<ObjectShape> {
    // An object with lists of rows makes no row of its own, and an entity of SensorThings has to have a result.
    let is_list = |(_, said): &(String, &Value)| {
        said.as_array().is_some_and(|list| list.iter().any(|said| said.is_object() || said.is_array()))
    };
    let is_thing = |(name, _): &(String, &Value)| name.contains("@iot.");
    if members.iter().any(is_list) || members.iter().any(is_thing) && members.iter().all(|(name, _)| name != "value") {
        return None;
    }
    let names: Vec<String> = members.iter().map(|(name, _)| name.clone()).collect();
    let is_twice = |name: &String| names.iter().filter(|other| *other == name).count() > 1;
    let with = |more: &[&str]| {
        let names: Vec<String> = names.iter().cloned().chain(more.iter().map(ToString::to_string)).collect();
        // Two keys of one name are ambiguous.
        ColumnPlaces::by_name(&names, file)
            .filter(|places| ![places.time, places.sensor, places.value].iter().any(|&at| is_twice(&names[at])))
    };
    let place = |wanted: &str| names.iter().position(|name| name == wanted);
    let scalar = |place: usize| members.get(place).is_some_and(|(_, said)| !said.is_object() && !said.is_array());
    let mut is_instant =
        |place: usize| members.get(place).is_some_and(|(_, said)| instant(said, &mut out.reading.instants).is_some());
    let time = with(&["sensor", "value"]).map(|places| places.time).filter(|&time| time < names.len());
    if let (Some(time), Some(topic), Some(payload)) = (time, place("topic"), place("payload")) {
        return Some(ObjectShape::Message { time, topic, payload });
    }
    if let Some(places) = with(&[]).filter(|places| scalar(places.time) && scalar(places.sensor)) {
        return members
            .get(places.value)
            .is_some_and(|(_, said)| !said.is_array())
            .then_some(ObjectShape::Whole(places));
    }
    // A key such as `start` names the time of a row with a sensor and a value. On its own it says too little: settings have it, too.
    if matches!(by, KeyNames::Roles | KeyNames::LastRoles) {
        return None;
    }
    let others = |apart: &[usize]| (0..names.len()).filter(|at| !apart.contains(at)).collect::<Vec<_>>();
    match time.filter(|&time| is_instant(time)) {
        None => None,
        Some(time) => {
            let reading =
                with(&["sensor"]).filter(|places| places.value < names.len() && !members[places.value].1.is_array());
            let device = with(&["value"]).map(|places| places.sensor).filter(|&sensor| sensor < names.len());
            match (reading, device.filter(|&device| scalar(device))) {
                (Some(places), _) if by == KeyNames::Own => Some(ObjectShape::Reading(places)),
                (Some(_), _) => None,
                (None, Some(sensor)) if !others(&[time, sensor]).is_empty() => {
                    Some(ObjectShape::Device { time, sensor })
                }
                (None, Some(_)) => None,
                (None, None) => {
                    let is_reading =
                        |&at: &usize| matches!(members[at].1, Value::Bool(_) | Value::Number(_) | Value::Null);
                    let rest = others(&[time]);
                    let is_wide = !rest.is_empty() && rest.iter().all(is_reading);
                    if is_wide { Some(ObjectShape::Wide { time }) } else { None }
                }
            }
        }
    }
}

/// The parts of a row under names that say nothing: the first instant, and right behind it a sensor and a value. A number
/// with other numbers around it is one of a device's readings, and an id never is.
fn guessed(members: &[(String, &Value)], out: &mut Gathered<'_, '_>) -> Option<ObjectShape> {
    let mut is_instant = |said: &Value| instant(said, &mut out.reading.instants).is_some();
    let time = members.iter().position(|(_, said)| is_instant(said))?;
    let mut behind = members.iter().skip(time + 1).take(2);
    let ((_, sensor), (name, value)) = (behind.next()?, behind.next()?);
    let is_log =
        sensor.is_string() && !is_instant(sensor) && !value.is_object() && !value.is_array() && !is_instant(value);
    if !is_log {
        return None;
    }
    let is_reading = |(name, said): &(String, &Value)| (said.is_number() || said.is_boolean()) && !is_id(name);
    let others = members.iter().enumerate().filter(|(at, member)| *at != time + 2 && is_reading(member));
    if is_id(name) || is_reading(&(name.clone(), value)) && others.count() > 0 {
        return Some(ObjectShape::Device { time, sensor: time + 1 });
    }
    Some(ObjectShape::Guessed(ColumnPlaces { time, sensor: time + 1, value: time + 2, label: None, is_mapped: false }))
}

/// Whether a key names a thing rather than what is measured of it.
fn is_id(name: &str) -> bool {
    let plain = plain(name);
    role_of(name).is_some_and(|(role, _)| role == ColumnRole::Unused) || plain.ends_with("id") && plain.len() < 12
}

fn tell(shape: ObjectShape, members: &[(String, &Value)], out: &mut Gathered<'_, '_>) {
    let (parts, because): (Vec<(usize, ColumnRole)>, &str) = match shape {
        ObjectShape::Whole(ColumnPlaces { time, sensor, value, label, .. }) => {
            let label = label.map(|label| (label, ColumnRole::Label));
            let parts = [(time, ColumnRole::Time), (sensor, ColumnRole::Sensor), (value, ColumnRole::Value)];
            (parts.into_iter().chain(label).collect(), "its key")
        }
        ObjectShape::Guessed(ColumnPlaces { time, sensor, value, .. }) => (
            vec![(time, ColumnRole::Time), (sensor, ColumnRole::Sensor), (value, ColumnRole::Value)],
            "its place: the first instant, and what is right behind it",
        ),
        ObjectShape::Reading(ColumnPlaces { time, value, .. }) => {
            out.column("the names above the rows", ColumnRole::Sensor, "the rows name no sensor");
            (vec![(time, ColumnRole::Time), (value, ColumnRole::Value)], "its key")
        }
        ObjectShape::Device { time, sensor } => {
            out.column("all other keys", ColumnRole::OneSensor, "each is a reading of the device");
            (vec![(time, ColumnRole::Time), (sensor, ColumnRole::Sensor)], "its key")
        }
        ObjectShape::Wide { time } => {
            out.column(
                "all other keys",
                ColumnRole::OneSensor,
                "no key is a sensor, and all values are numbers or booleans",
            );
            (vec![(time, ColumnRole::Time)], "its key")
        }
        ObjectShape::Message { time, topic, payload } => {
            out.column("the keys of payloads", ColumnRole::OneSensor, "each is a reading of the device");
            let parts = [(time, ColumnRole::Time), (topic, ColumnRole::Sensor), (payload, ColumnRole::Value)];
            (parts.to_vec(), "its key")
        }
    };
    let is_all = matches!(shape, ObjectShape::Device { .. } | ObjectShape::Wide { .. });
    let is_guessed = matches!(shape, ObjectShape::Guessed(_));
    for (place, (name, _)) in members.iter().enumerate() {
        match parts.iter().find(|(part, _)| *part == place) {
            Some((_, role)) => out.column(name, *role, because),
            None if is_all || is_home(name) => {}
            None if is_guessed && members[place].1.is_number() && !is_id(name) => {
                out.remark(format!("the numbers under {name:?} are no part of a row, and are left out"));
                out.column(name, ColumnRole::Unused, "it is no part of a row")
            }
            None if name == "attributes" || name == "a" => {
                out.column(name, ColumnRole::Kind, "Home Assistant's attributes, with the class, the unit and the name")
            }
            None => match Above::role(name) {
                Some(role) => out.column(name, role, "its key"),
                None => out.column(name, ColumnRole::Unused, "it is no part of a row"),
            },
        }
    }
}

fn without(members: &[(String, &Value)], apart: &[usize]) -> Object {
    let kept = members.iter().enumerate().filter(|(at, (name, _))| !apart.contains(at) && !is_home(name));
    kept.map(|(_, (name, said))| (name.clone(), (*said).clone())).collect()
}
