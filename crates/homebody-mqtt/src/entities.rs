//! What a sensor is to a monitoring system: one entity for each thing that it tells, such as whether somebody is in the bed, and how
//! restless.
//!
//! We assume that a motion sensor of which the log says no OFF says ON alone, as in TigerPlace, and that what is not known by its
//! kind is a text.
//!
//! Left out: batteries and the quality of links, which no log tells of.

use homebody_core::names::words;
use homebody_log::SensorInfo;

/// One thing that a sensor tells.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Entity {
    /// Its part of topics and ids; empty for what a sensor mainly tells.
    pub key: &'static str,
    /// What it is called beside the sensor's name; None for what a sensor mainly tells.
    pub name: Option<&'static str>,
    pub says: Says,
    /// Home Assistant's device class.
    pub class: Option<&'static str>,
    /// What Zigbee2MQTT calls it in a device's JSON.
    pub property: &'static str,
}

/// What an entity says.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Says {
    /// On or off.
    Binary {
        /// Whether it says ON alone, again and again.
        on_only: bool,
        /// What Zigbee2MQTT says for on, and for off.
        zigbee: [Word; 2],
    },
    /// A number, in this unit.
    Number { unit: Option<String> },
    /// One of these words.
    Choice(&'static [&'static str]),
    /// Whatever it says.
    Text,
}

/// A word of Zigbee2MQTT's JSON.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Word {
    Truth(bool),
    Text(&'static str),
}

/// What was heard of a sensor: which of its entities, and what.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Heard<'a> {
    Switched(bool),
    Number(f64),
    Word(&'a str),
}

/// Bands of a bed sensor.
const BANDS: &[&str] = &["low", "normal", "high"];

/// What a sensor is.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Device {
    pub entities: Vec<Entity>,
}

impl Device {
    /// By its kind.
    pub fn of(sensor: &SensorInfo) -> Device {
        let is_held = sensor.values.iter().any(|value| value == "OFF");
        let truth = [Word::Truth(true), Word::Truth(false)];
        let binary = |class, property, zigbee, on_only| Entity {
            key: "",
            name: None,
            says: Says::Binary { on_only, zigbee },
            class: Some(class),
            property,
        };
        let number = |key, name, class, property| Entity {
            key,
            name,
            says: Says::Number { unit: sensor.unit.clone() },
            class: Some(class),
            property,
        };
        let reading = |entity| sensor.unit.is_some().then_some(entity);
        let choice = |key, name, property| Entity {
            key,
            name: Some(name),
            says: Says::Choice(BANDS),
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
                let restless = Says::Number { unit: None };
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
            entities.push(Entity { key: "", name: None, says: Says::Text, class: None, property: "value" });
        }
        Device { entities }
    }

    /// What a row says, by the text of its value: of which entity, and what. A text that the kind does not know is told as it is, of
    /// what the sensor mainly tells.
    pub fn hears<'a>(&self, said: &'a str) -> (usize, Heard<'a>) {
        let at = |key: &str| self.entities.iter().position(|entity| entity.key == key).unwrap_or(0);
        let switched = match said {
            "ON" | "true" | "OPEN" | "IN" => Some(true),
            "OFF" | "false" | "CLOSE" | "OUT" => Some(false),
            _ => None,
        };
        match (switched, &self.entities[0].says) {
            (Some(on), Says::Binary { .. }) => return (0, Heard::Switched(on)),
            (_, Says::Text) => return (0, Heard::Word(said)),
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
                (Says::Number { .. }, Ok(number)) if entity > 0 => return (entity, Heard::Number(number)),
                (Says::Choice(words), _) => {
                    if let Some(word) = words.iter().find(|word| word.eq_ignore_ascii_case(rest)) {
                        return (entity, Heard::Word(word));
                    }
                }
                _ => {}
            }
        }
        match said.parse::<f64>() {
            Ok(number) if number.is_finite() => (self.number(), Heard::Number(number)),
            _ => (0, Heard::Word(said)),
        }
    }

    /// The entity that tells readings.
    pub fn number(&self) -> usize {
        self.entities.iter().position(|entity| matches!(entity.says, Says::Number { .. })).unwrap_or(0)
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

    /// A sensor of a kind, in the kitchen.
    pub(crate) fn sensor(name: &str, kind: &str, unit: Option<&str>, values: &[&str]) -> SensorInfo {
        let (unit, room) = (unit.map(Into::into), Some("kitchen".into()));
        SensorInfo { unit, room, ..SensorInfo::of_kind(name, kind, values) }
    }

    #[test]
    fn what_a_sensor_says_is_heard_by_the_entity_that_tells_it() {
        let bed = Device::of(&sensor("bed", "bed", None, &["IN", "OUT"]));
        assert_eq!(bed.hears("IN"), (0, Heard::Switched(true)));
        assert_eq!(bed.hears("OUT"), (0, Heard::Switched(false)));
        assert_eq!(bed.hears("RESTLESS_3"), (1, Heard::Number(3.0)));
        assert_eq!(bed.hears("PULSE_HIGH"), (2, Heard::Word("high")));
        assert_eq!(bed.hears("RESPIRATION_NORMAL"), (3, Heard::Word("normal")));
        let stove = Device::of(&sensor("stove", "stove_temperature", Some("\u{b0}C"), &["ON", "OFF"]));
        assert_eq!(stove.hears("21.5"), (1, Heard::Number(21.5)));
        assert_eq!(stove.hears("false"), (0, Heard::Switched(false)));
        let cold = Device::of(&sensor("stove", "stove_temperature", None, &["ON", "OFF"]));
        assert_eq!(cold.entities.len(), 1);
        let unknown = Device::of(&sensor("T3", "", None, &[]));
        assert_eq!(unknown.hears("ON"), (0, Heard::Word("ON")));
    }

    #[test]
    fn motion_is_on_only_unless_it_says_off_and_what_opens_has_a_class() {
        let on_only = |values: &[&str]| match Device::of(&sensor("hall", "motion", None, values)).entities[0].says {
            Says::Binary { on_only, .. } => on_only,
            _ => panic!("a motion sensor is on or off"),
        };
        assert!(on_only(&["ON"]) && !on_only(&["ON", "OFF"]));
        let class = |name: &str| Device::of(&sensor(name, "contact", None, &["OPEN", "CLOSE"])).entities[0].class;
        let classes = ["front door", "fridge door", "window", "medicine cabinet", "box"].map(class);
        assert_eq!(classes, ["door", "opening", "window", "opening", "opening"].map(Some));
    }
}
