//! A scenario whose home is still to be drawn.

use super::Texts;
use super::inhabited::{Begun, lived_in};
use serde_json::json;

/// The files of a scenario with nothing in its home. Somebody lives an ordinary life there as soon as what that needs is drawn;
/// until then the check says what is missing.
pub fn empty(name: &str) -> Texts {
    let lists = ["rooms", "walls", "doors", "furniture", "sensors"];
    let lists: String = lists.iter().map(|list| format!(",\n  \"{list}\": []")).collect();
    let home = format!("{{\n  \"$schema\": \"./schemas/home.schema.json\",\n  \"name\": {}{lists}\n}}\n", json!(name));
    lived_in(&Begun::week(name, home))
}
