//! Every message has a code of its own, an explanation and one place for its words: `crates/homebody/tests/messages.snap` and
//! `docs/reference/diagnostics.md` are made from the declarations.
//!
//! `HOMEBODY_REWRITE=1 cargo test -p homebody --test rules messages` writes both anew.

use super::generated::is_generated;
use super::{File, expect_none, files};
use homebody_core::messages::CatalogueEntry;
use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

const SNAPSHOT: &str = "\
Every message of the program and of the experiments: its code, its text and its hint. Names in braces stand for data.
HOMEBODY_REWRITE=1 cargo test -p homebody --test rules messages writes this file anew.
";

const PAGE: &str = "\
# Diagnostics

This page explains every message by its code. `homebody explain CODE` prints the same text. For messages of
[experiments](../explanation/validation.md), `cargo run --release --package homebody-lab -- explain CODE` does. Names in braces stand for
data, which `--json` and Python carry under `data`.

They also carry the change that solves the problem under `fix`, if one change is enough:

- `{\"kind\": \"replace\", \"with\": NAME}` replaces the words or the JSON string at the place of the problem.
- `{\"kind\": \"let_enter\", \"furniture\": NAME}` sets `\"enterable\"` of that piece of furniture to `true`.
- `{\"kind\": \"add\", \"piece\": PIECE, \"room\": NAME}` adds the piece to the `\"furniture\"` of the home.

Made from the code by the test in `crates/homebody/tests/rules/messages.rs`.
";

fn all() -> impl Iterator<Item = &'static CatalogueEntry> + Clone {
    homebody::messages::all().chain(homebody_lab::catalogue::all())
}

#[test]
fn the_snapshot_is_what_the_code_says() {
    let mut text = SNAPSHOT.to_owned();
    for entry in all() {
        text += &format!("\n{}[{}]: {}\n", entry.severity.word(), entry.code, entry.text);
        text.extend(entry.hint.map(|hint| format!("  hint: {hint}\n")));
    }
    is_generated("crates/homebody/tests/messages.snap", &text);
}

#[test]
fn the_page_of_diagnostics_is_what_the_code_says() {
    let mut text = PAGE.to_owned();
    let mut heading = "";
    for entry in all() {
        let area = area(entry.code);
        if area != heading {
            heading = area;
            text += &format!("\n## {area}\n");
        }
        text += &format!("\n### `{}`\n\n{}\n\n```text\n", entry.code, about(entry));
        text += &format!("{}[{}]: {}\n", entry.severity.word(), entry.code, entry.text);
        text.extend(entry.hint.map(|hint| format!("  hint: {hint}\n")));
        text += "```\n";
    }
    is_generated("docs/reference/diagnostics.md", &text);
}

fn area(code: &str) -> &str {
    code.split("::").next().unwrap_or_default()
}

fn about(entry: &CatalogueEntry) -> String {
    let lines: Vec<&str> = entry.about.lines().map(|line| line.strip_prefix(' ').unwrap_or(line)).collect();
    lines.join("\n").trim().to_owned()
}

#[test]
fn explain_names_the_program_of_the_experiments_for_their_codes() {
    let explain = |code: &str| {
        let output = Command::new(env!("CARGO_BIN_EXE_homebody")).args(["explain", code]).output().unwrap();
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let of_experiments: BTreeSet<&str> = homebody_lab::catalogue::all().map(|entry| area(entry.code)).collect();
    assert!(of_experiments.contains("sphere"), "{of_experiments:?}");
    for area in &of_experiments {
        for code in [area.to_string(), format!("{area}::any")] {
            let (exit, text) = explain(&format!("[{code}]"));
            assert!(exit == Some(2) && text.contains("[explain::of-experiments]"), "{code}: {text}");
            let command = format!("`cargo run --release --package homebody-lab -- explain {code}`");
            assert!(text.contains(&command), "{text}");
        }
    }
    assert!(homebody::messages::all().all(|entry| !of_experiments.contains(area(entry.code))));
    assert_eq!(explain("log::exists").0, Some(0));
}

#[test]
fn messages_are_sound() {
    let mut wrong: Vec<String> = all().flat_map(faults).collect();
    let mut seen = BTreeMap::new();
    wrong.extend(
        all().filter(|entry| seen.insert(entry.code, ()).is_some()).map(|entry| format!("{}: twice", entry.code)),
    );
    expect_none(wrong);
}

#[test]
fn an_unsound_message_is_found() {
    let entry = CatalogueEntry { code: "Log:bad", text: "It is wrong.", about: "", ..*all().next().unwrap() };
    assert_eq!(faults(&entry).len(), 4, "{:?}", faults(&entry));
}

/// The faults of a declaration: its code is not `area::kebab-case`, its text is a sentence with a capital or a full stop, or it has no
/// explanation.
fn faults(entry: &CatalogueEntry) -> Vec<String> {
    let is_word = |word: &str| {
        !word.is_empty() && word.bytes().all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'-')
    };
    let is_code = entry.code.split_once("::").is_some_and(|(area, name)| is_word(area) && is_word(name));
    let begins_large = entry.text.starts_with(|c: char| c.is_ascii_uppercase())
        && !["CSV", "JSON", "PNG", "SQL", "MQTT", "Homebody", "Python", "PostgreSQL"]
            .iter()
            .any(|name| entry.text.starts_with(name));
    let all = [
        (!is_code, "its code is not area::kebab-case"),
        (begins_large, "its text begins with a capital letter"),
        (entry.text.ends_with('.'), "its text ends with a full stop"),
        (entry.about.trim().is_empty(), "it has no explanation"),
    ];
    all.into_iter().filter(|(is_so, _)| *is_so).map(|(_, why)| format!("{}: {why}", entry.code)).collect()
}

#[test]
fn every_declared_message_is_listed() {
    let files = files();
    expect_none(unlisted(&files));
}

#[test]
fn a_message_that_is_not_listed_is_found() {
    let file = File::new("crates/a/src/a.rs", "homebody_core::messages! {\n    /// A.\n    pub enum A in \"a\" {\n");
    assert_eq!(unlisted(&[file]), ["crates/a/src/a.rs: A is in no list of messages"]);
}

/// The enums of messages that no list of a crate names.
fn unlisted(files: &[File]) -> Vec<String> {
    let mut wrong = Vec::new();
    for file in
        files.iter().filter(|file| file.is("rs") && file.path.starts_with("crates/") && file.path.contains("/src/"))
    {
        for (_, rest) in file.text.match_indices(" enum ").map(|(at, word)| file.text.split_at(at + word.len())) {
            let Some((name, rest)) = rest.split_once(' ') else { continue };
            let is_listed = || {
                let entries =
                    [format!("{name}::ENTRIES"), format!("{name} as homebody_core::messages::Catalogue>::ENTRIES")];
                files.iter().any(|file| entries.iter().any(|entry| file.text.contains(entry)))
            };
            if rest.starts_with("in \"") && !file.text.contains(&format!("/// use {name}")) && !is_listed() {
                wrong.push(format!("{}: {name} is in no list of messages", file.path));
            }
        }
    }
    wrong
}
