//! The meaning of a word for a kind of sensor in logs of other systems.
//!
//! Logs have such words in columns, in topics and in names, such as `occupancy`.
//!
//! We assume that a word has the same meaning in all systems.
//!
//! The word decides the kind alone, or with the name or the values of the sensor.
//!
//! Left out: the words of other systems, which `sensed.rs` lists.

use serde::Serialize;

crate::worded::worded! {
    /// The kinds that a sensor may be taken for.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
    #[serde(rename_all = "snake_case")]
    pub enum Kind {
        /// A sensor of movement.
        Motion = "motion",
        /// A contact of a door, a drawer or a window.
        Contact = "contact",
        /// A sensor of use without movement, as of a light's switch, a mattress or an item.
        Used = "used",
        /// A source of numbers, such as a temperature, a battery or a brightness.
        Reading = "reading",
        /// A source without signs of people, such as an update, an automation or the sun.
        Other = "other",
    }
    /// All of them.
    ALL
    /// In a word.
    fn word
}

/// The meaning of a word for a kind of sensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// The word alone decides: the sensor has this kind.
    Is(Kind),
    /// The name decides. A bed or a seat by its name is used; any other sensor detects motion.
    PresenceByName,
    /// The values decide. A sensor with numbers gives readings; any other is used.
    UseOrReading,
    /// The values decide. A sensor with numbers, or without states that begin and end, gives readings. For any other sensor, the word
    /// decides nothing.
    ReadingOnly,
}
