//! A scenario with an empty home.

use crate::residents::{NewScenario, inhabited_texts};
use crate::texts::ScenarioTexts;
use serde_json::json;

/// The files of a scenario with an empty home. Its resident has an ordinary routine; the check reports the parts of the
/// home that it lacks.
pub fn empty(name: &str) -> ScenarioTexts {
    let lists = ["rooms", "walls", "doors", "furniture", "sensors"];
    let lists: String = lists.iter().map(|list| format!(",\n  \"{list}\": []")).collect();
    let home = format!("{{\n  \"$schema\": \"./schemas/home.schema.json\",\n  \"name\": {}{lists}\n}}\n", json!(name));
    inhabited_texts(&NewScenario::week(name, home))
}
