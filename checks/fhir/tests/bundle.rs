//! The example of a bundle is of the published form, and what is not is found.

use fhirbolt::model::r4::resources::Bundle;
use fhirbolt::serde::{DeserializationConfig, DeserializationMode};
use serde_json::{Value, json};

/// What the program makes: its own tests hold this file against it.
const EXAMPLE: &str = include_str!("../observations.json");

/// How many entries a bundle has, if it is of the form. The reader takes one entry at a time, without line breaks.
fn entries(bundle: &Value) -> Result<usize, String> {
    let all = bundle["entry"].as_array().expect("entries");
    for entry in all {
        let mut alone = bundle.clone();
        alone["entry"] = json!([entry]);
        let strict = DeserializationConfig { mode: DeserializationMode::Strict };
        let read: Result<Bundle, _> = fhirbolt::json::from_str(&alone.to_string(), Some(strict));
        read.map_err(|error| error.to_string())?;
    }
    Ok(all.len())
}

fn example() -> Value {
    serde_json::from_str(EXAMPLE).unwrap()
}

#[test]
fn the_example_is_of_the_published_form() {
    assert_eq!(entries(&example()), Ok(28));
}

#[test]
fn what_is_not_of_the_form_is_found() {
    let spoiled = |spoil: &dyn Fn(&mut Value)| {
        let mut bundle = example();
        spoil(&mut bundle["entry"][0]["resource"]);
        entries(&bundle)
    };
    assert!(spoiled(&|of| of["value"] = json!(3)).is_err(), "a field that there is not");
    assert!(spoiled(&|of| of["status"] = json!(3)).is_err(), "a number for a word");
    assert!(spoiled(&|of| of["effectivePeriod"] = json!("2024-02-29")).is_err(), "a date for a period");
    let without = |of: &mut Value| drop(of.as_object_mut().unwrap().remove("code"));
    assert!(spoiled(&without).is_err(), "no code");
}
