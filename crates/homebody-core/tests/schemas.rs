//! The JSON Schemas in the folder `schemas` are those of the types.
//!
//! `HOMEBODY_REWRITE=1 cargo test -p homebody-core --test schemas` writes them anew.

#![allow(clippy::disallowed_methods, reason = "a test may read and write files; the core may not")]

use homebody_core::scenario::schema::schemas;
use std::path::Path;

#[test]
fn the_schemas_checked_in_are_the_generated_ones() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../schemas");
    for (name, schema) in schemas() {
        let generated = format!("{}\n", serde_json::to_string_pretty(&schema).unwrap());
        let path = folder.join(name);
        if std::env::var_os("HOMEBODY_REWRITE").is_some() {
            std::fs::create_dir_all(&folder).unwrap();
            std::fs::write(&path, &generated).unwrap();
        }
        let checked_in = std::fs::read_to_string(&path).unwrap_or_default();
        assert!(checked_in == generated, "schemas/{name} is not what the types give; see the head of this test");
    }
}
