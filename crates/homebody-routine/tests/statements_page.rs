//! `docs/reference/statements.md`, made from the types and from examples. `HOMEBODY_REWRITE=1` writes it anew.

use crate::generated::is_generated;
use crate::home::understood;
use homebody_routine::statement::{Statement, statements};
use serde_json::Value;
use std::fmt::Write;

const HEAD: &str = "# Statements

A statement is one sentence of a routine as data. `homebody routine explain --json` prints the statement of each sentence, and
in Python `hb.life()` makes the sentences of statements. `schemas/statements.schema.json` is their JSON Schema.

Numbers that vary are trapezoids: no value is below `low` or above `high`, and those from `from` to `to` are the most frequent.
Times of day are in seconds since midnight. Activities are the labels of the [table of activities](activities.md), or words of
your own with a place and a length.

This page is made from the types.
";

/// A sentence of each kind.
const EXAMPLES: &str = "Margaret is 82 years old.
On Tuesday and Friday, she reads in the armchair at 19:30 for 30 to 40 minutes.
She goes to bed in the bed at 22:30, give or take 15 minutes.
Every other Thursday, she leaves the apartment at 10:00 for 2 hours.
On Sunday, her daughter visits at 14:00 for 2 hours.
Once a week, she falls on the way to the bathroom mostly at night.
From day 40, over 14 days, she goes to bed 1 hour later.
On 5 % of days, she forgets the stove.
Whenever the stove has been on for 20 minutes and she is not in the kitchen, she turns off the stove.
She prepares lunch at 12:00.
";

#[test]
fn the_reference_of_statements_is_generated() {
    let (_, schema) = Statement::list_schema();
    let types = schema["definitions"].as_object().unwrap();
    let read = statements(&understood(EXAMPLES));
    let examples: Vec<(Value, String)> =
        read.iter().map(|(_, one)| (serde_json::to_value(one).unwrap(), one.sentences().join(" "))).collect();
    let mut text = format!("{HEAD}\n## Kinds\n");
    for kind in types["Statement"]["oneOf"].as_array().unwrap() {
        let name = kind["properties"]["kind"]["const"].as_str().unwrap();
        writeln!(text, "\n### {name}\n\n{}\n", description(kind)).unwrap();
        if let Some((json, sentence)) = examples.iter().find(|(json, _)| json["kind"] == name) {
            let json = serde_json::to_string(json).unwrap();
            writeln!(text, "{sentence}\n\n```json\n{json}\n```\n").unwrap();
        }
        fields(&mut text, kind);
    }
    for (name, of) in types.iter().filter(|(name, _)| *name != "Statement") {
        writeln!(text, "\n## {name}\n\n{}\n", description(of)).unwrap();
        match (of["properties"].is_object(), of["oneOf"].as_array(), of["enum"].as_array()) {
            (true, ..) => fields(&mut text, of),
            (_, Some(variants), _) => variants.iter().for_each(|variant| choice(&mut text, variant)),
            (_, _, Some(words)) => {
                words.iter().for_each(|word| writeln!(text, "- `{}`", word.as_str().unwrap()).unwrap())
            }
            _ => writeln!(text, "A {}.", type_of(of)).unwrap(),
        }
    }
    is_generated("docs/reference/statements.md", &text.replace("\n\n\n", "\n\n"));
}

fn description(of: &Value) -> String {
    of["description"].as_str().unwrap_or_default().replace('\n', " ")
}

/// A table of the fields; the kind itself is no field.
fn fields(text: &mut String, of: &Value) {
    let needed: Vec<&str> = of["required"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
    text.push_str("| field | type | meaning |\n|---|---|---|\n");
    for (name, field) in of["properties"].as_object().unwrap().iter().filter(|(name, _)| *name != "kind") {
        let needed = if needed.contains(&name.as_str()) { ", needed" } else { "" };
        writeln!(text, "| `{name}` | {}{needed} | {} |", type_of(field), description(field)).unwrap();
    }
}

/// A variant of a choice: a word, or an object with one field.
fn choice(text: &mut String, variant: &Value) {
    let meaning = description(variant);
    let meaning = if meaning.is_empty() { String::new() } else { format!(": {meaning}") };
    if let Some(words) = variant["enum"].as_array() {
        words.iter().for_each(|word| writeln!(text, "- `\"{}\"`{meaning}", word.as_str().unwrap()).unwrap());
    } else if let Some(word) = variant["const"].as_str() {
        writeln!(text, "- `\"{word}\"`{meaning}").unwrap();
    } else {
        for (name, field) in variant["properties"].as_object().unwrap() {
            writeln!(text, "- `{name}`, {}{meaning}", type_of(field)).unwrap();
        }
    }
}

fn type_of(field: &Value) -> String {
    if let Some(name) = field["$ref"].as_str().and_then(|of| of.strip_prefix("#/definitions/")) {
        return format!("[{name}](#{})", name.to_lowercase());
    }
    if let Some(either) = field["anyOf"].as_array() {
        return either.iter().filter(|of| of["type"] != "null").map(type_of).collect::<Vec<_>>().join(" or ");
    }
    if let Some(either) = field["allOf"].as_array() {
        return either.iter().map(type_of).collect();
    }
    if let Some(items) = field["items"].as_array() {
        return format!("list of {}", items.iter().map(type_of).collect::<Vec<_>>().join(" and "));
    }
    if let Some(fields) = field["properties"].as_object() {
        let fields = fields.iter().map(|(name, of)| format!("`{name}` ({})", type_of(of)));
        return format!("object with {}", fields.collect::<Vec<_>>().join(", "));
    }
    match &field["type"] {
        Value::String(name) if name == "array" => format!("list of {}", type_of(&field["items"])),
        Value::String(name) => name.clone(),
        Value::Array(names) => names.iter().filter_map(Value::as_str).filter(|name| *name != "null").collect(),
        _ => "value".to_owned(),
    }
}
