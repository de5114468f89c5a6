//! The entities of a kind of sensor in monitoring systems.
//!
//! A sensor has one for each sort of value, such as bed occupancy and restlessness.
//!
//! We assume that Home Assistant, Zigbee2MQTT and their like have the same entities, under names of their own.
//!
//! The row of each kind lists its entities. A sensor of unknown kind has one entity of text.
//!
//! Left out: batteries and the quality of links, which no log has.

/// One sort of value of a sensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EntityRow {
    /// Its part of topics and ids; empty for the main entity.
    pub key: &'static str,
    /// The name behind that of the sensor; none for the main entity.
    pub name: Option<&'static str>,
    /// The form of its values.
    pub form: EntityForm,
    /// Home Assistant's device class. A sensor of the class [`OPENING`] may be of a closer one by its name and its room.
    pub class: Option<&'static str>,
    /// The key in a device's JSON of Zigbee2MQTT.
    pub property: &'static str,
    /// The first word of its values in a log, such as `PULSE` of `PULSE_LOW`; empty if they have no such word.
    pub prefix: &'static str,
}

/// The form of the values of an entity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EntityForm {
    /// On or off, with Zigbee2MQTT's words for both.
    Switch([SwitchWord; 2]),
    /// A reading in the unit of the sensor. A sensor without readings lacks this entity, unless it is the main one.
    Reading,
    /// A number without a unit.
    Number,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// Any text.
    Text,
}

/// A word of Zigbee2MQTT's JSON for on or off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SwitchWord {
    /// A truth value.
    Truth(bool),
    /// A text.
    Text(&'static str),
}

impl From<SwitchWord> for serde_json::Value {
    fn from(word: SwitchWord) -> serde_json::Value {
        match word {
            SwitchWord::Truth(truth) => truth.into(),
            SwitchWord::Text(text) => text.into(),
        }
    }
}

/// Home Assistant's class of doors, windows and lids in general.
pub const OPENING: &str = "opening";

impl EntityRow {
    /// The main entity of a kind whose values monitoring systems do not know.
    pub const TEXT: EntityRow = EntityRow::new("", None, EntityForm::Text, None, "value");

    /// Whether a contact is open. Zigbee2MQTT says whether it is closed.
    pub const CONTACT: EntityRow = EntityRow {
        form: EntityForm::Switch([SwitchWord::Truth(false), SwitchWord::Truth(true)]),
        ..EntityRow::switch(OPENING, "contact")
    };

    /// Whether something is on, as a main entity.
    pub const fn switch(class: &'static str, property: &'static str) -> EntityRow {
        let form = EntityForm::Switch([SwitchWord::Truth(true), SwitchWord::Truth(false)]);
        EntityRow::new("", None, form, Some(class), property)
    }

    /// A main entity of readings.
    pub const fn reading(class: &'static str) -> EntityRow {
        EntityRow::new("", None, EntityForm::Reading, Some(class), class)
    }

    /// Readings behind a main entity, under the name of their class.
    pub const fn further_reading(class: &'static str, name: &'static str) -> EntityRow {
        EntityRow::new(class, Some(name), EntityForm::Reading, Some(class), class)
    }

    /// Values with a first word of their own, behind a main entity.
    pub const fn prefixed(
        prefix: &'static str,
        key: &'static str,
        name: &'static str,
        form: EntityForm,
        class: Option<&'static str>,
    ) -> EntityRow {
        EntityRow { prefix, ..EntityRow::new(key, Some(name), form, class, key) }
    }

    const fn new(
        key: &'static str,
        name: Option<&'static str>,
        form: EntityForm,
        class: Option<&'static str>,
        property: &'static str,
    ) -> EntityRow {
        EntityRow { key, name, form, class, property, prefix: "" }
    }
}
