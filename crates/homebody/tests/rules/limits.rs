//! `docs/reference/limits.md` has every limit on input: those of scenario files and those of the code.
//!
//! `HOMEBODY_REWRITE=1 cargo test -p homebody --test rules limits` writes it anew.

use super::generated::is_generated;
use super::numbers::{Fixed, cell, fixed, is_limit};
use super::{File, files};
use homebody_core::scenario::schema::FileKind;
use serde_json::Value;

const HEAD: &str = "\
# Limits

This page lists the limits on the input that Homebody reads and on the work that it does.

Scenarios, recordings, logs and plans may come from strangers. Therefore:

- Homebody reads plain files only, each up to a limit of size.
- Files that a scenario names are read and written inside its folder only.
- Every list, text and count has an upper limit. Homebody reports a value beyond its limit, with the place in the file.

Pass `--trust` for a scenario of your own: Homebody then reads its files whatever their size, and follows links out of its folder.
`homebody run --out` writes to any destination that you name.

This page is made from the code by the test in `crates/homebody/tests/rules/limits.rs`.

## Files of a scenario

The largest number of items in a list, of keys in an object, and of characters in a text.
";

const CODE: &str = "
## Program

Limits of reading, checking, drawing and simulating. A name begins with `MOST`, `LARGEST`, `LONGEST` or `GREATEST`. The unit `1` is that
of a count, a share or a factor.
";

#[test]
fn the_table_of_limits_is_that_of_the_code() {
    is_generated("docs/reference/limits.md", &document(&files()));
}

#[test]
fn every_list_and_every_map_of_a_scenario_is_bounded() {
    let unbounded = FileKind::ALL.into_iter().flat_map(|kind| {
        let schema = kind.schema();
        let of = |(object, key, value): (String, String, Value)| {
            let is_open = |of: &str, most: &str| value["type"] == of && value.get(most).is_none();
            let is_map = value["additionalProperties"].is_object() && value.get("maxProperties").is_none();
            (is_open("array", "maxItems") || is_map).then(|| format!("{} of {object} in {}", key, kind.schema_name()))
        };
        properties(&schema).into_iter().filter_map(of).collect::<Vec<_>>()
    });
    super::expect_none(unbounded.collect());
}

#[test]
fn a_limit_is_told_by_its_name() {
    let file = File::new(
        "crates/a/src/a.rs",
        "/// No more (ours).\nconst MOST_DOORS: usize = 3;\n/// At least (ours).\nconst LEAST: u8 = 1;\n\
         /// As far as a reader goes.\nconst GREATEST_DEPTH: usize = 64;\n",
    );
    let names: Vec<String> = limits(&[file]).map(|limit| limit.name).collect();
    assert_eq!(names, ["MOST_DOORS", "GREATEST_DEPTH"]);
}

fn limits(files: &[File]) -> impl Iterator<Item = Fixed> {
    fixed(files).filter(|constant| is_limit(&constant.path, &constant.name))
}

/// The keys of a schema's objects: the object, the key, and what the schema says of it.
fn properties(schema: &Value) -> Vec<(String, String, Value)> {
    let own = |object: &str, schema: &Value| {
        let branches = ["oneOf", "anyOf"].into_iter().filter_map(|key| schema[key].as_array()).flatten();
        let all = std::iter::once(schema).chain(branches).filter_map(|branch| branch["properties"].as_object());
        let of = |(key, value): (&String, &Value)| (object.to_owned(), key.clone(), value.clone());
        all.flatten().map(of).collect::<Vec<_>>()
    };
    let title = |schema: &Value, name: &str| schema["title"].as_str().unwrap_or(name).to_owned();
    let mut all = own(&title(schema, "file"), schema);
    for (name, definition) in schema["definitions"].as_object().into_iter().flatten() {
        all.extend(own(&title(definition, name), definition));
    }
    all
}

fn document(files: &[File]) -> String {
    let mut text = HEAD.to_owned();
    for kind in FileKind::ALL {
        let mut rows = String::new();
        for (object, key, value) in properties(&kind.schema()) {
            let most = [("maxItems", "items"), ("maxProperties", "keys"), ("maxLength", "characters")];
            let most = most.into_iter().filter_map(|(most, of)| Some((value.get(most)?.as_u64()?, of)));
            // A point is always two numbers.
            for (most, of) in
                most.filter(|_| value.get("minItems") != value.get("maxItems") || value.get("maxItems").is_none())
            {
                rows += &format!("| {object} | `{key}` | {most} {of} |\n");
            }
        }
        if !rows.is_empty() {
            text += &format!("\n### {}\n\n| in | key | at most |\n|---|---|---|\n{rows}", capitalised(kind.noun()));
        }
    }
    text += CODE;
    text += "\n| name | limit | unit | description | file |\n|---|---|---|---|---|\n";
    for Fixed { path, name, value, unit, what } in limits(files) {
        text += &format!("| `{name}` | `{}` | {unit} | {} | `{path}` |\n", cell(&value), cell(&what));
    }
    text
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}
