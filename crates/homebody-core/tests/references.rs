//! `docs/reference/home.md`, `docs/reference/logger.md` and `docs/reference/scenario.md` agree with the types of the files: each key with
//! its type, unit, range, default and sentence.
//!
//! `HOMEBODY_REWRITE=1 cargo test -p homebody-core --test all references::` writes them anew.

use crate::generated::is_generated;
use homebody_core::home::form::HomeFile;
use homebody_core::home::resolved::ResolvedHome;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::scenario::schema::FileKind;
use homebody_core::scenario::scheme::Scheme;
use serde_json::{Value, json};

/// A page: its name, what stands above the tables, and the files that it is about, each under a heading.
struct Page {
    name: &'static str,
    head: &'static str,
    files: &'static [(&'static str, FileKind)],
    tail: fn() -> String,
}

const PAGES: [Page; 3] = [
    Page { name: "docs/reference/home.md", head: HOME, files: &[("The file", FileKind::Home)], tail: String::new },
    Page { name: "docs/reference/logger.md", head: LOGGER, files: &[("The file", FileKind::Logger)], tail: places },
    Page {
        name: "docs/reference/scenario.md",
        head: SCENARIO,
        files: &[
            ("`scenario.json`", FileKind::Scenario),
            ("Resident", FileKind::Resident),
            ("Path", FileKind::Path),
            ("Input file", FileKind::Input),
        ],
        tail: String::new,
    },
];

const HOME: &str = "\
# `home.json`

This page lists every key of `home.json`, the file that describes a home: its rooms, walls, doors, furniture and sensors.

- Lengths are in metres. A point is `[x, y]`: `x` grows to the east, `y` to the north.
- Angles are in degrees, counter-clockwise. A direction of 0 is east, 90 is north.
- Names are compared without regard to case and to surrounding spaces.

`homebody check` reports errors that the tables cannot express, such as a door outside any wall, with the line and a hint. The events
of each kind of sensor are in [sensors](sensors.md), the roles of furniture in [activities and roles](activities.md). For editors,
`schemas/home.schema.json` has the same content as this page. Both are made from the types in
`crates/homebody-core/src/home/form.rs`, `crates/homebody-core/src/plan/form.rs` and `crates/homebody-core/src/sensors/`.

```json
{
  \"name\": \"one room\",
  \"rooms\": [{ \"name\": \"room\", \"outline\": [[0, 0], [5, 0], [5, 4], [0, 4]] }],
  \"walls\": [{ \"from\": [0, 0], \"to\": [5, 0] }, { \"from\": [5, 0], \"to\": [5, 4] }, { \"from\": [5, 4], \"to\": [0, 4] }, { \"from\": [0, 4], \"to\": [0, 0] }],
  \"doors\": [{ \"name\": \"front door\", \"from\": [1, 0], \"to\": [1.9, 0], \"outside\": true }],
  \"furniture\": [{ \"name\": \"bed\", \"at\": [4, 3], \"size_m\": [1.8, 1], \"height_m\": 0.5, \"enterable\": true }],
  \"sensors\": [
    { \"kind\": \"motion\", \"name\": \"room motion\", \"at\": [0.05, 2], \"facing_deg\": 0 },
    { \"kind\": \"contact\", \"name\": \"door contact\", \"on\": \"front door\" }
  ]
}
```
";

const LOGGER: &str = "\
# `logger.json`

This page lists every key of `logger.json`, the file that sets where the log goes, its columns, its sensor ids and its times. A scenario
without the file uses all the defaults.

```json
{
  \"to\": [\"sqlite:log.db\", \"csv:log.csv\"],
  \"table\": \"event\",
  \"columns\": { \"time\": \"ts_local\", \"sensor\": \"sensor_id\", \"value\": \"event_code\" },
  \"ids\": { \"bedroom motion\": \"A1\", \"bed sensor\": \"C1\" },
  \"messages\": { \"on_off\": { \"hold_s\": 4 } },
  \"time\": \"utc\"
}
```

- Each row is one event of a sensor. The events of each kind are in [sensors](sensors.md).
- Rows of a run are numbered from 0. The run's id and this number are the key of the table, so no row is stored twice.
- Names of tables and columns have up to 63 characters of `a` to `z`, `0` to `9` and `_`, and do not begin with a digit.
- Only firings of motion sensors are held. The log has the events of other sensors unchanged.
- The [truth](truth.md) has its own destination. It uses the sensor ids and the time format of this file.

For editors, `schemas/logger.schema.json` has the same content as this page. Both are made from the types in
`crates/homebody-core/src/scenario/logger.rs`.
";

const SCENARIO: &str = "\
# `scenario.json`, residents and paths

This page lists the files of a scenario, the example scenarios, and every key of `scenario.json`, of residents, of paths and of input
files.

A scenario is a folder. Its files name each other relative to the folder, with `/` between folders; Homebody reads nothing outside it.
For editors, the files in `schemas/` have the same content as this page. Both are made from the types in
`crates/homebody-core/src/scenario/`.

## Files

Only `scenario.json` has a fixed name. The other names below are those of the examples.

| file | content | reference |
|---|---|---|
| `scenario.json` | links to the files below; start, days, time zone and seed of a run; parameters of the models | this page |
| `home.json` | rooms, walls, doors, furniture and its roles, sensors | [home](home.md) |
| `logger.json` | destination of the log; its table, columns, sensor ids, messages and time format | [logger](logger.md) |
| `link.json` | network between the sensors and the logger: delay, loss, faults and their times | [link](link.md) |
| `margaret.json` | a resident: body, pace and driver | [resident](#resident) |
| `margaret.routine` | a driver: the resident's days, in sentences | [routine language](routine-language.md) |
| `clara.rhai` | a driver: a script, for behaviour that sentences cannot describe | [scripts](scripts.md) |
| `walk.path.json` | a driver: walks, waits, postures, activities and repeats | [path](#path) |
| `keys.json` | a driver: keys held over time | [input file](#input-file) |

## Example scenarios

| folder in `scenarios/` | content |
|---|---|
| `tigerplace` | ninety ordinary days of a woman of 82 in a one-bedroom apartment, with the sensors of TigerPlace |
| `tigerplace-depression` | the same home for 120 days, with a depression from the sixth week on |
| `tigerplace-decline` | the same home for two years: cognitive decline, a urinary tract infection, frailty with falls, and a recovery |
| `older-adult` | an ordinary life in a one-bedroom apartment with twenty motion sensors, wired like a CASAS home |
| `couple-with-cat` | four weeks of a couple, their cat and visitors; only the truth knows which of them a motion sensor saw |
| `house-two-floors` | three months of a woman who grows frail, with stairs, an X10 network, a fading battery and an outage |
| `studio` | two weeks of a man in one room who is out for hours, logged like a CASAS home |
| `sphere-house` | the house of the SPHERE challenge, whose real sensors were recorded, and a walk through its rooms |
| `cameras` | a week of a woman of 86 in one room who falls now and then, with three cameras that keep silhouettes only |
| `postures` | one room and three cameras; a resident stands, walks, bends, kneels, sits, lies, falls and crawls |
| `by-hand` | two rooms whose visitor is driven by held keys from a file, turns on a lamp and sits down |
| `dark-hall` | an evening by a script: a lamp is lit whenever the resident crosses the dark hall |
| `door-bell` | an afternoon by two scripts: a neighbour rings, and the resident opens the door and reads on |
| `robot` | a robot by a script: three layers of control, after Brooks (1986) |
";

/// The places that a log can go to.
fn places() -> String {
    let mut text = "\n## Destinations\n\n| `to` | description |\n|---|---|\n".to_owned();
    text.extend(Scheme::of_scenarios().map(|row| format!("| `{}:{}` | {} |\n", row.name, row.at, row.what)));
    text
}

/// The unit of a key's numbers, by the end of its name.
const UNITS: [(&str, &str); 15] = [
    ("_per_s", "1/s"),
    ("_m", "m"),
    ("_deg", "°"),
    ("_s", "s"),
    ("_c", "°C"),
    ("_lux", "lx"),
    ("_percent", "%"),
    ("watts", "W"),
    ("_mps", "m/s"),
    ("_bpm", "1/min"),
    ("_pm", "1/min"),
    ("days", "days"),
    ("at", "m"),
    ("outline", "m"),
    ("area", "m"),
];

/// Keys of points whose names do not end so.
const POINTS: [&str; 3] = ["from", "to", "start"];

/// Keys of counts and shares, and of numbers that each have a unit of their own.
const COUNTS: &str =
    "pixels beams rows pulses times seed numbers missed share parts goal walls noise people open_floor";

/// Definitions that another page has, and where.
const ELSEWHERE: [(&str, &str); 1] = [("Role", "[role](activities.md#roles-of-furniture)")];

#[test]
fn the_pages_are_what_the_types_say() {
    for page in PAGES {
        is_generated(page.name, &document(&page));
    }
}

#[test]
fn every_link_within_a_page_leads_to_a_heading() {
    for page in PAGES {
        assert_eq!(astray(&document(&page)), [""; 0], "{}", page.name);
    }
    // The control.
    assert_eq!(astray("## Piece of furniture\n[a](#piece-of-furniture) [b](#pieces)\n"), ["pieces"]);
}

/// The links to headings that a page does not have.
fn astray(page: &str) -> Vec<String> {
    let titles = page.lines().filter_map(|line| line.strip_prefix("## "));
    let anchors: Vec<String> = titles.map(|title| title.to_lowercase().replace(' ', "-").replace('`', "")).collect();
    let links = page.split("](#").skip(1).filter_map(|rest| rest.split(')').next());
    links.filter(|link| !anchors.iter().any(|anchor| anchor == link)).map(str::to_owned).collect()
}

#[test]
fn the_examples_of_the_pages_are_sound() {
    let example = |head: &str| head.split("```json\n").nth(1).unwrap().split("```").next().unwrap().to_owned();
    let home: HomeFile = serde_json::from_str(&example(HOME)).unwrap();
    assert!(ResolvedHome::new(home).is_ok());
    let logger: LoggerFile = serde_json::from_str(&example(LOGGER)).unwrap();
    assert_eq!(logger.to.len(), 2);
}

/// No key of any file is without a sentence, and no number without a unit.
#[test]
fn every_key_says_what_it_is() {
    let files = PAGES.iter().flat_map(|page| page.files);
    assert_eq!(files.flat_map(|&(_, kind)| silent(&kind.schema())).collect::<Vec<_>>(), [""; 0]);
    // The control.
    let schema = json!({ "properties": {
        "told_s": { "type": "number", "description": "A wait." },
        "silent": { "type": "string" },
        "how_much": { "type": "number", "description": "A number of what?" },
    } });
    assert_eq!(silent(&schema), ["silent", "how_much"]);
}

#[test]
fn ranges_and_defaults_are_in_words() {
    let required = json!({ "required": ["a"] });
    let cells = |key: &str, schema: Value| row(key, &schema, &required, &Value::Null);
    let number = json!({ "type": "number", "description": "So.", "exclusiveMinimum": 0, "maximum": 2.5 });
    assert_eq!(cells("a", number), "| `a` | So. | number | | above 0, up to 2.5 | required |\n");
    let list = json!({ "type": "array", "items": { "type": "number", "minimum": 0 }, "minItems": 1, "maxItems": 4,
        "description": "So\nmany.", "default": [0.0, 3.5] });
    assert_eq!(
        cells("b_s", list),
        "| `b_s` | So many. | list of numbers | s | 1 to 4 of them, each at least 0 | `[0, 3.5]` |\n"
    );
}

/// The keys of a schema without a sentence, or with numbers without a unit.
fn silent(schema: &Value) -> Vec<String> {
    let mut silent = Vec::new();
    for (key, value) in schema["properties"].as_object().into_iter().flatten().filter(|(key, _)| *key != "kind") {
        let is_number = number_of(value).is_some();
        if value["description"].is_null() || is_number && unit(key).is_none() {
            silent.push(key.clone());
        }
    }
    let inner = [&schema["oneOf"], &schema["anyOf"], &schema["definitions"]].map(children);
    silent.extend(inner.into_iter().flatten().flat_map(silent_unless_a_choice));
    silent
}

/// The only key of `{ "on_off": ... }` is a choice, which says itself what it is.
fn silent_unless_a_choice(schema: &Value) -> Vec<String> {
    if choice(schema).is_some() && !schema["description"].is_null() { Vec::new() } else { silent(schema) }
}

fn children(value: &Value) -> Vec<&Value> {
    match value {
        Value::Array(all) => all.iter().collect(),
        Value::Object(all) => all.values().collect(),
        _ => Vec::new(),
    }
}

/// The whole page.
fn document(page: &Page) -> String {
    let mut text = page.head.to_owned();
    let mut told: Vec<String> = Vec::new();
    for (heading, kind) in page.files {
        let schema = kind.schema();
        text += &format!("\n## {heading}\n\n{}", keys(&schema, &schema["definitions"]));
        for (name, definition) in schema["definitions"].as_object().into_iter().flatten() {
            if ELSEWHERE.iter().any(|(elsewhere, _)| elsewhere == name) || told.contains(name) {
                continue;
            }
            told.push(name.clone());
            text += &section(definition, &schema["definitions"]);
        }
    }
    text + &(page.tail)()
}

/// A heading, what it is, and its keys or choices.
fn section(definition: &Value, all: &Value) -> String {
    let title = definition["title"].as_str().expect("each type has a title");
    let mut text = format!("\n## {}{}\n\n", title[..1].to_uppercase(), &title[1..]);
    text += &format!("{}\n\n", said(definition));
    let variants = ["oneOf", "anyOf"].into_iter().find_map(|key| definition[key].as_array());
    let Some(variants) = variants else { return text + &keys(definition, all) };
    let kind = |variant: &Value| variant["properties"]["kind"]["const"].as_str().map(str::to_owned);
    if variants.iter().all(|variant| kind(variant).is_some()) {
        let mut parts = Vec::new();
        for variant in variants {
            let name = kind(variant).expect("all have one");
            parts.push(format!("### `{name}`\n\n{}\n\n{}", said(variant), keys(variant, all)));
        }
        return text + &parts.join("\n");
    }
    text += "| value | description |\n|---|---|\n";
    for variant in variants {
        let value = match (choice(variant), variant["const"].as_str()) {
            (Some((key, inner)), _) => format!("`{{ \"{key}\": ... }}`: {}", kind_of(key, inner, all)),
            (None, Some(word)) => format!("`{word}`"),
            (None, None) => kind_of("at", variant, all),
        };
        text += &format!("| {value} | {} |\n", said(variant));
    }
    text
}

/// The key of an object that has but one, and what is in it.
fn choice(variant: &Value) -> Option<(&str, &Value)> {
    let properties = variant["properties"].as_object().filter(|all| all.len() == 1)?;
    properties.iter().next().map(|(key, inner)| (key.as_str(), inner))
}

/// The table of an object's keys.
fn keys(object: &Value, all: &Value) -> String {
    let mut text = "| key | description | type | unit | range | default |\n|---|---|---|---|---|---|\n".to_owned();
    let properties = object["properties"].as_object().into_iter().flatten();
    text.extend(properties.filter(|(key, _)| *key != "kind").map(|(key, value)| row(key, value, object, all)));
    text
}

fn row(key: &str, value: &Value, object: &Value, all: &Value) -> String {
    let unit = number_of(value).and(unit(key)).unwrap_or_default();
    let is_required = object["required"].as_array().is_some_and(|names| names.iter().any(|name| name == key));
    let default = match &value["default"] {
        _ if is_required => "required".to_owned(),
        Value::Null => "none".to_owned(),
        Value::Object(keys) if !keys.is_empty() => "see its keys".to_owned(),
        default => format!("`{}`", plain(default)),
    };
    let cells = [format!("`{key}`"), said(value), kind_of(key, value, all), unit.to_owned(), range(value), default];
    let cells = cells.map(|cell| if cell.is_empty() { " ".to_owned() } else { format!(" {cell} ") });
    format!("|{}|\n", cells.join("|"))
}

/// The description in one line.
fn said(schema: &Value) -> String {
    schema["description"].as_str().unwrap_or_default().replace('\n', " ").replace('|', "\\|")
}

/// The schema of the numbers that a value is made of.
fn number_of(value: &Value) -> Option<&Value> {
    match word(value) {
        "number" | "integer" => Some(value),
        "array" => number_of(&value["items"]),
        "object" => number_of(&value["additionalProperties"]),
        _ => None,
    }
}

/// The type, whether it may be `null` or not.
fn word(value: &Value) -> &str {
    let words = value["type"].as_array().and_then(|words| words.first());
    words.unwrap_or(&value["type"]).as_str().unwrap_or_default()
}

fn unit(key: &str) -> Option<&'static str> {
    let end = UNITS.iter().find(|(end, _)| key.ends_with(end)).map(|(_, unit)| *unit);
    let point = POINTS.contains(&key).then_some("m");
    end.or(point).or(COUNTS.split(' ').any(|count| count == key).then_some(""))
}

/// The kind of a value, with a link to its parts.
fn kind_of(key: &str, value: &Value, all: &Value) -> String {
    let inner = [&value["allOf"][0], &value["anyOf"][0], value].into_iter().find_map(|inner| inner["$ref"].as_str());
    if let Some(name) = inner.and_then(|link| link.rsplit('/').next()) {
        let elsewhere = ELSEWHERE.iter().find(|(elsewhere, _)| *elsewhere == name).map(|(_, link)| (*link).to_owned());
        let title = all[name]["title"].as_str().unwrap_or(name);
        return elsewhere.unwrap_or_else(|| format!("[{title}](#{})", title.replace(' ', "-").replace('\'', "")));
    }
    let is_fixed = !value["minItems"].is_null() && value["minItems"] == value["maxItems"];
    let items = &value["items"];
    match word(value) {
        "boolean" => "`true` or `false`".into(),
        "string" => "text".into(),
        "integer" => "whole number".into(),
        "array" if is_fixed && unit(key) == Some("m") && !key.ends_with("_m") => "point".into(),
        "array" if is_fixed => format!("{} {}s", plain(&value["minItems"]), kind_of(key, items, all)),
        "array" if word(items) == "array" => "list of points".into(),
        "array" if items["$ref"].is_null() => format!("list of {}s", kind_of(key, items, all)),
        "array" => format!("list, each a {}", kind_of(key, items, all)),
        "object" => format!("{}s by name", kind_of(key, &value["additionalProperties"], all)),
        word => word.to_owned(),
    }
}

/// From what to what, in words.
fn range(value: &Value) -> String {
    let counted = |text: String, of: &str| if text.is_empty() { text } else { text + of };
    match word(value) {
        "string" if value["minLength"] == 1 && value["maxLength"].is_null() => "not empty".to_owned(),
        "string" => counted(span(value, ["minLength", "", "maxLength"]), " characters"),
        "array" => {
            let is_fixed = value["minItems"] == value["maxItems"];
            let count = if is_fixed { String::new() } else { span(value, ["minItems", "", "maxItems"]) };
            let each = number_of(&value["items"]).map(range).unwrap_or_default();
            let each = if each.is_empty() { each } else { format!("each {each}") };
            let parts = [counted(count, " of them"), each];
            parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(", ")
        }
        _ => span(value, ["minimum", "exclusiveMinimum", "maximum"]),
    }
}

/// The limits of a schema by their keys: the least, what it has to be above, the most.
fn span(value: &Value, keys: [&str; 3]) -> String {
    match keys.map(|key| &value[key]) {
        [Value::Null, Value::Null, Value::Null] => String::new(),
        [Value::Null, Value::Null, most] => format!("at most {}", plain(most)),
        [Value::Null, above, Value::Null] => format!("above {}", plain(above)),
        [Value::Null, above, most] => format!("above {}, up to {}", plain(above), plain(most)),
        [least, _, Value::Null] => format!("at least {}", plain(least)),
        [least, _, most] => format!("{} to {}", plain(least), plain(most)),
    }
}

/// JSON without the `.0` of whole numbers.
fn plain(value: &Value) -> String {
    match value {
        Value::Number(number) => {
            let text = number.to_string();
            text.strip_suffix(".0").map(str::to_owned).unwrap_or(text)
        }
        Value::Array(items) => format!("[{}]", items.iter().map(plain).collect::<Vec<_>>().join(", ")),
        other => other.to_string(),
    }
}
