//! The JSON Schemas of the scenario's files, generated from their types.
//!
//! Editors complete and check with them, and the loader checks against the very same.

use super::ScenarioFile;
use super::logger::LoggerFile;
use crate::drivers::input::InputFile;
use crate::drivers::path::form::PathFile;
use crate::home::form::HomeFile;
use crate::link::form::LinkFile;
use crate::resident::ResidentFile;
use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde_json::Value;

crate::worded::worded! {
    /// A kind of file of a scenario.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum FileKind {
        /// `scenario.json`, which links the others.
        Scenario = "a scenario",
        /// `home.json`: the building and its sensors.
        Home = "a home",
        /// `link.json`: the way from the sensors to the logger.
        Link = "a link",
        /// `logger.json`: where the log goes, and how it looks there.
        Logger = "a logger",
        /// A resident's file: body, pace and driver.
        Resident = "a resident",
        /// A path description: walks, waits, repeats.
        Path = "a path",
        /// Keys that are held over time.
        Input = "a file of live input",
    }
    /// All kinds; the scenario's own file comes first.
    ALL
    /// The name of such a file in messages.
    fn noun
}

impl FileKind {
    /// The schema's file name in the folder `schemas`.
    pub fn schema_name(self) -> &'static str {
        match self {
            FileKind::Scenario => "scenario.schema.json",
            FileKind::Home => "home.schema.json",
            FileKind::Link => "link.schema.json",
            FileKind::Logger => "logger.schema.json",
            FileKind::Resident => "resident.schema.json",
            FileKind::Path => "path.schema.json",
            FileKind::Input => "input.schema.json",
        }
    }

    /// The JSON Schema (draft 7) of such a file, made from its type.
    pub fn schema(self) -> Value {
        match self {
            FileKind::Scenario => schema::<ScenarioFile>(),
            FileKind::Home => schema::<HomeFile>(),
            FileKind::Link => schema::<LinkFile>(),
            FileKind::Logger => schema::<LoggerFile>(),
            FileKind::Resident => schema::<ResidentFile>(),
            FileKind::Path => schema::<PathFile>(),
            FileKind::Input => schema::<InputFile>(),
        }
    }
}

/// Every schema with its file name.
pub fn schemas() -> Vec<(&'static str, Value)> {
    FileKind::ALL.into_iter().map(|kind| (kind.schema_name(), kind.schema())).collect()
}

/// Draft 7 is the newest that all editors understand.
fn schema<T: JsonSchema>() -> Value {
    SchemaSettings::draft07().into_generator().into_root_schema_for::<T>().to_value()
}
