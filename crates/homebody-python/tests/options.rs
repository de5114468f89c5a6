//! The functions of Python have the options of a run as keywords.

#[path = "../../../tests/generated.rs"]
mod generated;

use generated::is_generated;
use homebody_simulation::RunOptions;
use serde_json::Value;
use std::fs;
use std::path::Path;

/// The functions with options of a run: file, name, and the options that they do not have.
const FUNCTIONS: [(&str, &str, &[&str]); 3] = [
    ("python/homebody/scenario.py", "run", &[]),
    ("python/homebody/scenario.py", "live", &["one_of_many"]),
    ("python/homebody/_cohort.py", "cohort", &["start", "numbers", "one_of_many"]),
];

/// Options before the others, in an order of their own.
const FIRST: [&str; 2] = ["days", "seed"];

const BEGIN: &str = "# The options of a run, made from RunOptions in crates/homebody-simulation/src/run_options.rs.\n";
const END: &str = "# The end of the options.\n";

#[test]
fn functions_have_the_options_of_a_run() {
    for (path, function, lacking) in FUNCTIONS {
        let place = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path);
        let text = fs::read_to_string(place).unwrap();
        is_generated(path, &with_options(&text, function, lacking));
    }
}

#[test]
fn writes_options_as_keywords() {
    let text = format!("def f(\n    {BEGIN}    old: int,\n    {END}    last: int,\n) -> None:");
    let made = with_options(&text, "f", &["numbers", "one_of_many", "start"]);
    assert_eq!(made, text.replace("old: int,", "without: Sequence[str] = (),"));
}

/// The text of a module with the options between the two comments of a function.
fn with_options(text: &str, function: &str, lacking: &[&str]) -> String {
    let signature = text.find(&format!("def {function}(")).expect("the function exists");
    let begin = signature + text[signature..].find(BEGIN).expect("the options have a beginning") + BEGIN.len();
    let end = begin + text[begin..].find(END).expect("the options have an end");
    let indent = &text[begin..][..text[begin..].len() - text[begin..].trim_start().len()];
    let schema = RunOptions::schema().to_value();
    let options = schema["properties"].as_object().expect("the options are an object");
    let is_listed = |name: &str| !FIRST.contains(&name) && !lacking.contains(&name);
    let keywords = options.iter().filter(|(name, _)| is_listed(name));
    let keywords: String =
        keywords.map(|(name, option)| format!("{indent}{name}: {},\n", annotation(option))).collect();
    format!("{}{keywords}{indent}{}", &text[..begin], &text[end..])
}

/// The type and the default of an option in Python.
fn annotation(option: &Value) -> &'static str {
    let kind = option["type"].as_str().or(option["type"][0].as_str()).expect("an option has a type");
    match kind {
        "integer" => "int | None = None",
        "number" => "float | None = None",
        "string" => "str | None = None",
        "boolean" => "bool = False",
        "array" => "Sequence[str] = ()",
        "object" => "Mapping[str, float] | None = None",
        other => panic!("Python has no keyword of the type {other}"),
    }
}
