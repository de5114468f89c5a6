//! The entities of a sensor in a monitoring system: one for each kind of value, such as bed occupancy and restlessness.
//!
//! We assume that a motion sensor without OFF in the log sends ON alone, as in TigerPlace, and that a sensor of unknown kind sends text.
//!
//! Left out: batteries and the quality of links, which no log has.

use homebody_core::names::words;
use homebody_core::sensors::entities::{EntityForm, EntityRow, OPENING, SwitchWord};
use homebody_core::sensors::kinds::KINDS;
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
    /// The first word of its values in a log; empty if they have none.
    pub prefix: &'static str,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum EntityType {
    Binary {
        /// Whether it sends ON alone, again and again.
        on_only: bool,
        /// The words of Zigbee2MQTT for on and off.
        zigbee: [SwitchWord; 2],
    },
    Number {
        unit: Option<String>,
    },
    Choice(&'static [&'static str]),
    Text,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum EntityValue<'a> {
    Switched(bool),
    Number(f64),
    Word(&'a str),
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Device {
    pub entities: Vec<Entity>,
}

impl Device {
    /// By its kind.
    pub fn for_sensor(sensor: &SensorInfo) -> Device {
        let kind = KINDS.iter().find(|kind| kind.key == sensor.kind);
        let rows = kind.map_or(&[EntityRow::TEXT][..], |kind| kind.entities);
        let is_held = sensor.values.iter().any(|value| value == "OFF");
        let on_only = kind.is_some_and(|kind| kind.senses_motion()) && !is_held;
        let is_sent =
            |row: &&EntityRow| sensor.unit.is_some() || row.key.is_empty() || !matches!(row.form, EntityForm::Reading);
        let entity = |row: &EntityRow| Entity {
            key: row.key,
            name: row.name,
            says: match row.form {
                EntityForm::Switch(zigbee) => EntityType::Binary { on_only, zigbee },
                EntityForm::Reading => EntityType::Number { unit: sensor.unit.clone() },
                EntityForm::Number => EntityType::Number { unit: None },
                EntityForm::Choice(words) => EntityType::Choice(words),
                EntityForm::Text => EntityType::Text,
            },
            class: row.class.map(|class| if class == OPENING { opens(sensor) } else { class }),
            property: row.property,
            prefix: row.prefix,
        };
        Device { entities: rows.iter().filter(is_sent).map(entity).collect() }
    }

    /// The entity and the value that a row's text means. A text that the kind does not know is a value of the main entity.
    pub fn hears<'a>(&self, said: &'a str) -> (usize, EntityValue<'a>) {
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
            let entity = self.entities.iter().position(|entity| entity.prefix == first).unwrap_or(0);
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
        () if is("fridge") || is("drawer") || is("cabinet") || is("closet") || is("cupboard") => OPENING,
        () if is("door") || sensor.room.is_none() => "door",
        () => OPENING,
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::generated::is_generated_between;
    use homebody_core::sensors::form::KindRow;

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

    #[test]
    fn the_page_of_mqtt_has_all_entities() {
        let marked = |text: &str| format!("`{text}`");
        let row = |kind: &KindRow, entity: &EntityRow| {
            let key = if entity.key.is_empty() { "main".into() } else { marked(entity.key) };
            let class = entity.class.map_or("none".into(), marked);
            let values = match entity.form {
                EntityForm::Switch(words) => {
                    let [on, off] = words.map(|word| match word {
                        SwitchWord::Truth(truth) => truth.to_string(),
                        SwitchWord::Text(text) => text.into(),
                    });
                    format!("on or off: `{on}` or `{off}` in Zigbee2MQTT")
                }
                EntityForm::Reading => format!("readings in {}", kind.unit.expect("a unit of readings").symbol),
                EntityForm::Number => "numbers".into(),
                EntityForm::Choice(words) => words.iter().map(|word| marked(word)).collect::<Vec<_>>().join(", "),
                EntityForm::Text => "text".into(),
            };
            format!("| `{}` | {key} | {class} | `{}` | {values} |\n", kind.key, entity.property)
        };
        let rows: String =
            KINDS.iter().flat_map(|kind| kind.entities.iter().map(move |entity| row(kind, entity))).collect();
        let heading =
            "| sensor | entity | class in Home Assistant | key in Zigbee2MQTT | values |\n|---|---|---|---|---|";
        let begin = "<!-- made from the kinds of sensors -->";
        is_generated_between("docs/how-to/mqtt-and-home-assistant.md", begin, &format!("{heading}\n{rows}"));
    }
}
