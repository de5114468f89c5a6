//! Labels of activities are in their table alone; all other code names the constants, so that no label is misspelt.

use super::source::is_for_tests;
use super::{File, expect_none, files, numbered};
use homebody_core::activity::ACTIVITIES;

/// The table, and what is made from it.
const TABLE: [&str; 2] = ["crates/homebody-core/src/activity.rs", "web/src/activities.ts"];

/// Words that are labels, too, and mean something else where they stand.
const OTHER_MEANINGS: [(&str, &str, &str); 23] = [
    ("crates/homebody-analysis/src/measures/registry.rs", "pacing", "a measure"),
    ("crates/homebody-analysis/src/measures/registry.rs", "walking", "a measure"),
    ("crates/homebody-core/src/role.rs", "laundry", "a room"),
    ("crates/homebody-core/src/sensors/meaning.rs", "reading", "the value of a sensor"),
    ("crates/homebody-lab/src/daily_life/published.rs", "reading", "a line of a table for people"),
    ("crates/homebody-import/src/from_log/words.rs", "laundry", "a room"),
    ("crates/homebody-import/src/from_log/words.rs", "washing", "a word of the names of machines"),
    ("crates/homebody-log/src/source/columns.rs", "reading", "a heading over readings of sensors"),
    ("crates/homebody-log/src/source/json/object_rows.rs", "reading", "a key over readings of sensors"),
    ("crates/homebody-log/src/truth/movements.rs", "away", "a motion state"),
    ("crates/homebody-log/src/run_log/truth_log.rs", "away", "a motion state"),
    ("crates/homebody-log/src/run_log/truth_log.rs", "reading", "what a sensor measures"),
    ("crates/homebody-picture/src/density_map.rs", "away", "nobody at home"),
    ("crates/homebody-routine/src/language/changes.rs", "away", "a word of the language"),
    ("crates/homebody-routine/src/behaviour/keys.rs", "away", "what a rule waits for"),
    ("web/src/views/library/Library.svelte", "waiting", "a state of the page"),
    ("web/src/views/life/Life.svelte", "waiting", "a state of the page"),
    ("web/src/views/life/Life.svelte", "writing", "a part of the page"),
    ("web/src/views/live/Live.svelte", "waiting", "a state of the page"),
    ("web/src/views/playback/Playback.svelte", "waiting", "a state of the page"),
    ("web/src/views/playback/locating.svelte.ts", "walking", "a motion state"),
    ("web/src/wire.ts", "away", "a motion state"),
    ("web/src/wire.ts", "walking", "a motion state"),
];

#[test]
fn labels_of_activities_stand_in_their_table_alone() {
    let files = files();
    let found: Vec<(&File, usize, &str)> = files
        .iter()
        .filter(|file| is_code(&file.path) && !TABLE.contains(&file.path.as_str()) && !is_for_tests(&file.path, &files))
        .flat_map(|file| labels(file).into_iter().map(move |(line, label)| (file, line, label)))
        .collect();
    let is_meant = |path: &str, label: &str| OTHER_MEANINGS.iter().any(|(of, word, _)| *of == path && *word == label);
    let wrong = found.iter().filter(|(file, _, label)| !is_meant(&file.path, label));
    let wrong =
        wrong.map(|(file, line, label)| format!("{}:{line}: name the constant instead of {label:?}", file.path));
    let is_there = |path: &str, word: &str| found.iter().any(|(file, _, label)| file.path == path && *label == word);
    let needless = OTHER_MEANINGS.iter().filter(|(path, word, _)| !is_there(path, word));
    let needless = needless.map(|(path, word, _)| format!("{path} has no {word:?}: OTHER_MEANINGS need not name it"));
    expect_none(wrong.chain(needless).collect());
}

#[test]
fn a_label_that_is_written_out_is_found() {
    let found = |text: &str| labels(&File::new("crates/a/src/a.rs", text)).len();
    assert_eq!(found("if name == \"sleeping\" {\nname = 'washing_up';\n"), 2);
    assert_eq!(found("// \"sleeping\"\nlet sleeping = \"sleeping soundly\";\n"), 0);
    assert_eq!(found("a();\n#[cfg(test)]\nmod tests {\n    \"sleeping\"\n}\n"), 0);
}

/// Code of the program and of its page, without their tests.
fn is_code(path: &str) -> bool {
    let is_of_page = path.starts_with("web/src/") && (path.ends_with(".ts") || path.ends_with(".svelte"));
    let is_for_tests = path.contains(".test.") || path.starts_with("web/src/testing/");
    path.starts_with("crates/") && path.contains("/src/") && path.ends_with(".rs") || is_of_page && !is_for_tests
}

/// The labels that are texts of a file by themselves, with their lines; comments and tests at its end are left out.
fn labels(file: &File) -> Vec<(usize, &'static str)> {
    let lines = numbered(&file.text).take_while(|(_, line)| *line != "#[cfg(test)]");
    let lines = lines.filter(|(_, line)| !line.trim_start().starts_with("//"));
    let on = |line: &str| {
        let has = |label: &&str| ['"', '\''].iter().any(|quote| line.contains(&format!("{quote}{label}{quote}")));
        ACTIVITIES.iter().map(|known| known.label).filter(has).collect::<Vec<_>>()
    };
    lines.flat_map(|(number, line)| on(line).into_iter().map(move |label| (number, label))).collect()
}
