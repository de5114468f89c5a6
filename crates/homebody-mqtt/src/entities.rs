//! The entities of a sensor in a monitoring system: one for each kind of value, such as bed occupancy and restlessness.
//!
//! We assume that a motion sensor without OFF in the log sends ON alone, as in TigerPlace, and that a sensor of unknown kind sends text.
//!
//! Left out: batteries and the quality of links, which no log has.

use homebody_core::names::words;
use homebody_log::SensorInfo;

/// One thing that a sensor tells.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Entity {
    /// Its part of topics and ids; empty for what a sensor mainly tells.
    pub key: &'static str,
    /// The name behind that of the sensor; None for the main entity.
    pub name: Option<&'static str>,
    pub says: EntityType,
    /// Home Assistant's device class.
    pub class: Option<&'static str>,
    /// The key in a device's JSON of Zigbee2MQTT.
    pub property: &'static str,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum EntityType {
    Binary {
        /// Whether it sends ON alone, again and again.
        on_only: bool,
        /// The words of Zigbee2MQTT for on and off.
        zigbee: [Word; 2],
    },
    Number {
        unit: Option<String>,
    },
    Choice(&'static [&'static str]),
    Text,
}

/// A word of Zigbee2MQTT's JSON.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Word {
    Truth(bool),
    Text(&'static str),
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum EntityValue<'a> {
    Switched(bool),
    Number(f64),
    Word(&'a str),
}

/// Bands of a bed sensor.
const BANDS: &[&str] = &["low", "normal", "high"];

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Device {
    pub entities: Vec<Entity>,
}

impl Device {
    /// By its kind.
    pub fn for_sensor(sensor: &SensorInfo) -> Device {
        let is_held = sensor.values.iter().any(|value| value == "OFF");
        let truth = [Word::Truth(true), Word::Truth(false)];
        let binary = |class, property, zigbee, on_only| Entity {
            key: "",
            name: None,
            says: EntityType::Binary { on_only, zigbee },
            class: Some(class),
            property,
        };
        let number = |key, name, class, property| Entity {
            key,
            name,
            says: EntityType::Number { unit: sensor.unit.clone() },
            class: Some(class),
            property,
        };
        let reading = |entity| sensor.unit.is_some().then_some(entity);
        let choice = |key, name, property| Entity {
            key,
            name: Some(name),
            says: EntityType::Choice(BANDS),
            class: Some("enum"),
            property,
        };
        let mut entities = match sensor.kind.as_str() {
            "motion" | "ceiling_motion" => vec![binary("motion", "occupancy", truth, !is_held)],
            "contact" => {
                // Zigbee2MQTT says whether it is closed.
                let closed = [Word::Truth(false), Word::Truth(true)];
                vec![binary(opens(sensor), "contact", closed, false)]
            }
            "bed" => {
                let restless = EntityType::Number { unit: None };
                let restlessness = Entity {
                    key: "restlessness",
                    name: Some("Restlessness"),
                    says: restless,
                    class: None,
                    property: "restlessness",
                };
                vec![
                    binary("occupancy", "occupancy", truth, false),
                    restlessness,
                    choice("pulse", "Pulse", "pulse"),
                    choice("respiration", "Respiration", "respiration"),
                ]
            }
            "pressure" => vec![binary("occupancy", "occupancy", truth, false)],
            "flow" => vec![binary("running", "water_flow", truth, false)],
            "stove_temperature" => {
                let temperature = number("temperature", Some("Temperature"), "temperature", "temperature");
                [Some(binary("heat", "heat", truth, false)), reading(temperature)].into_iter().flatten().collect()
            }
            "power" => {
                let watts = number("power", Some("Power"), "power", "power");
                let on = [Word::Text("ON"), Word::Text("OFF")];
                [Some(binary("power", "state", on, false)), reading(watts)].into_iter().flatten().collect()
            }
            "light" => vec![number("", None, "illuminance", "illuminance")],
            "temperature" => vec![number("", None, "temperature", "temperature")],
            _ => Vec::new(),
        };
        if entities.is_empty() {
            entities.push(Entity { key: "", name: None, says: EntityType::Text, class: None, property: "value" });
        }
        Device { entities }
    }

    /// The entity and the value that a row's text means. A text that the kind does not know is a value of the main entity.
    pub fn hears<'a>(&self, said: &'a str) -> (usize, EntityValue<'a>) {
        let at = |key: &str| self.entities.iter().position(|entity| entity.key == key).unwrap_or(0);
        let switched = match said {
            "ON" | "true" | "OPEN" | "IN" => Some(true),
            "OFF" | "false" | "CLOSE" | "OUT" => Some(false),
            _ => None,
        };
        match (switched, &self.entities[0].says) {
            (Some(on), EntityType::Binary { .. }) => return (0, EntityValue::Switched(on)),
            (_, EntityType::Text) => return (0, EntityValue::Word(said)),
            _ => {}
        }
        if let Some((first, rest)) = said.split_once('_') {
            let key = match first {
                "RESTLESS" => "restlessness",
                "PULSE" => "pulse",
                "RESPIRATION" => "respiration",
                _ => "",
            };
            let entity = at(key);
            match (&self.entities[entity].says, rest.parse::<f64>()) {
                (EntityType::Number { .. }, Ok(number)) if entity > 0 => return (entity, EntityValue::Number(number)),
                (EntityType::Choice(words), _) => {
                    if let Some(word) = words.iter().find(|word| word.eq_ignore_ascii_case(rest)) {
                        return (entity, EntityValue::Word(word));
                    }
                }
                _ => {}
            }
        }
        match said.parse::<f64>() {
            Ok(number) if number.is_finite() => (self.number(), EntityValue::Number(number)),
            _ => (0, EntityValue::Word(said)),
        }
    }

    /// The entity that tells readings.
    pub fn number(&self) -> usize {
        self.entities.iter().position(|entity| matches!(entity.says, EntityType::Number { .. })).unwrap_or(0)
    }
}

/// Home Assistant's class of what a contact is on: by its name, and a door where it is between two rooms.
fn opens(sensor: &SensorInfo) -> &'static str {
    let words = words(&sensor.name);
    let is = |word: &str| words.iter().any(|known| known == word);
    match () {
        () if is("window") => "window",
        () if is("fridge") || is("drawer") || is("cabinet") || is("closet") || is("cupboard") => "opening",
        () if is("door") || sensor.room.is_none() => "door",
        () => "opening",
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use homebody_core::sensors::kinds::KINDS;

    pub(crate) fn sensor(name: &str, kind: &str, unit: Option<&str>, values: &[&str]) -> SensorInfo {
        let (unit, room) = (unit.map(Into::into), Some("kitchen".into()));
        SensorInfo { unit, room, ..SensorInfo::of_kind(name, kind, values) }
    }

    #[test]
    fn each_value_belongs_to_its_entity() {
        let bed = Device::for_sensor(&sensor("bed", "bed", None, &["IN", "OUT"]));
        assert_eq!(bed.hears("IN"), (0, EntityValue::Switched(true)));
        assert_eq!(bed.hears("OUT"), (0, EntityValue::Switched(false)));
        assert_eq!(bed.hears("RESTLESS_3"), (1, EntityValue::Number(3.0)));
        assert_eq!(bed.hears("PULSE_HIGH"), (2, EntityValue::Word("high")));
        assert_eq!(bed.hears("RESPIRATION_NORMAL"), (3, EntityValue::Word("normal")));
        let stove = Device::for_sensor(&sensor("stove", "stove_temperature", Some("\u{b0}C"), &["ON", "OFF"]));
        assert_eq!(stove.hears("21.5"), (1, EntityValue::Number(21.5)));
        assert_eq!(stove.hears("false"), (0, EntityValue::Switched(false)));
        let cold = Device::for_sensor(&sensor("stove", "stove_temperature", None, &["ON", "OFF"]));
        assert_eq!(cold.entities.len(), 1);
        let unknown = Device::for_sensor(&sensor("T3", "", None, &[]));
        assert_eq!(unknown.hears("ON"), (0, EntityValue::Word("ON")));
    }

    #[test]
    fn every_kind_but_the_camera_has_entities_of_its_own() {
        let is_text = |key: &str, values: &[String]| {
            let values: Vec<&str> = values.iter().map(String::as_str).collect();
            Device::for_sensor(&sensor("it", key, Some("lx"), &values)).entities[0].says == EntityType::Text
        };
        let lacking = KINDS.iter().filter(|row| {
            let values: Vec<String> = row.values.iter().map(ToString::to_string).collect();
            is_text(row.key, &values)
        });
        assert_eq!(lacking.map(|row| row.key).collect::<Vec<_>>(), ["camera"], "add them to Device::for_sensor");
        // The control: a kind that is not listed sends text.
        assert!(is_text("unlisted", &[]));
    }

    #[test]
    fn motion_without_off_is_on_only_and_openings_have_a_class() {
        let on_only =
            |values: &[&str]| match Device::for_sensor(&sensor("hall", "motion", None, values)).entities[0].says {
                EntityType::Binary { on_only, .. } => on_only,
                _ => panic!("a motion sensor is on or off"),
            };
        assert!(on_only(&["ON"]) && !on_only(&["ON", "OFF"]));
        let class =
            |name: &str| Device::for_sensor(&sensor(name, "contact", None, &["OPEN", "CLOSE"])).entities[0].class;
        let classes = ["front door", "fridge door", "window", "medicine cabinet", "box"].map(class);
        assert_eq!(classes, ["door", "opening", "window", "opening", "opening"].map(Some));
    }
}
