//! The JSON Schemas in the folder `schemas` agree with the types.
//!
//! `HOMEBODY_REWRITE=1 cargo test -p homebody-core --test all schemas::` writes them anew.

use crate::generated::is_generated;
use homebody_core::scenario::schema::schemas;

#[test]
fn the_schemas_checked_in_are_the_generated_ones() {
    for (name, schema) in schemas() {
        is_generated(&format!("schemas/{name}"), &format!("{}\n", serde_json::to_string_pretty(&schema).unwrap()));
    }
}
