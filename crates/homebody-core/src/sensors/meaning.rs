//! The meaning of a word for a kind of sensor in logs of other systems.

use serde::Serialize;

crate::worded::worded! {
    /// The kinds that a sensor may be taken for.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
    #[serde(rename_all = "snake_case")]
    pub enum Kind {
        /// It sees movement.
        Motion = "motion",
        /// A door, a drawer, a window.
        Contact = "contact",
        /// A light's switch, a mattress, an item: it is used, but no movement is seen.
        Used = "used",
        /// A temperature, a battery, a brightness.
        Reading = "reading",
        /// It tells of no person: an update, an automation, the sun.
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
    /// It is of this kind.
    Is(Kind),
    /// A person is seen, or lies or sits on it. The name of a bed or a chair decides.
    Somebody,
    /// It is used; where it tells numbers, it is a reading.
    Measured,
    /// A reading; where it says that something begins and ends, the word says nothing of it.
    Readings,
}
