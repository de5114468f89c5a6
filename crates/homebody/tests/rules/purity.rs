//! The core stays pure: no clock, no file, no thread, no order of a hash map.
//!
//! Clippy checks it by the core's own `clippy.toml`. These rules check that the file stays complete, and they search the text, because
//! clippy sees calls and types but no mere `use`.

use super::{File, expect_none, files, has_word, numbered};
use toml::{Table, Value};

const LINTS: &str = "crates/homebody-core/clippy.toml";
const CORE: &str = "crates/homebody-core/src/";

/// The entries that `clippy.toml` must have.
const FORBIDDEN: &str = "std::collections::HashMap std::collections::HashSet std::time::Instant std::time::SystemTime \
    std::time::Instant::now std::time::SystemTime::now std::fs::File std::fs::OpenOptions std::fs::read \
    std::fs::read_to_string std::fs::read_dir std::fs::write std::thread::spawn std::thread::scope \
    std::thread::sleep std::env::var f64::sin f64::cos f64::atan2 f64::exp";

const TYPES: [&str; 6] = ["HashMap", "HashSet", "Instant", "SystemTime", "Mutex", "RwLock"];
const MODULES: [&str; 5] = ["fs", "thread", "net", "process", "env"];

#[test]
fn the_lint_file_of_the_core_forbids_what_is_impure() {
    let files = files();
    let lints = files.iter().find(|file| file.path == LINTS).expect("the core has its own clippy.toml");
    expect_none(not_forbidden(&lints.text));
}

#[test]
fn a_lint_that_was_dropped_is_found() {
    let entry = |path: &str| format!("{{ path = '{path}', reason = 'it is impure' }}");
    let all: Vec<String> = FORBIDDEN.split(' ').map(entry).collect();
    let file = |entries: &[String]| format!("disallowed-methods = [{}]", entries.join(","));
    assert_eq!(not_forbidden(&file(&all)).len(), 0);
    assert_eq!(
        not_forbidden(&file(&all[1..])),
        ["std::collections::HashMap is not forbidden, with a reason, in any list"]
    );
    assert_eq!(not_forbidden(&file(&all).replacen("it is impure", "", 1)).len(), 1);
}

#[test]
fn the_core_is_pure() {
    expect_none(files().iter().filter(|file| file.path.starts_with(CORE)).flat_map(impure).collect());
}

#[test]
fn impure_code_is_found() {
    let wrong = |text: &str| impure(&File::new("a.rs", text)).len();
    assert_eq!(wrong("use std::time::Instant;"), 1);
    assert_eq!(wrong("let text = std::fs::read_to_string(path);"), 1);
    assert_eq!(wrong("use std::{fmt, fs};"), 1);
    assert_eq!(wrong("let seen: HashSet<u32> = HashSet::new();"), 1);
    assert_eq!(wrong("thread::spawn(|| ());\nenv::var(\"HOME\");"), 2);
    assert_eq!(
        wrong("// An Instant is what we have none of.\nlet instants = offset::of(env!(\"CARGO_PKG_NAME\"));"),
        0
    );
    assert_eq!(wrong("#[expect(clippy::disallowed_types, reason = \"for once\")]\nuse std::time::Instant;"), 0);
    assert_eq!(wrong("#[expect(clippy::disallowed_types)]\nuse std::time::Instant;"), 1);
}

/// The forbidden things that a `clippy.toml` does not list with a reason.
fn not_forbidden(lints: &str) -> Vec<String> {
    let lints: Table = lints.parse().expect("clippy.toml is in TOML");
    let lists = ["disallowed-types", "disallowed-methods"].map(|list| lints.get(list).and_then(Value::as_array));
    let entries: Vec<&Value> = lists.into_iter().flatten().flatten().collect();
    let text = |entry: &Value, key| entry.get(key).and_then(Value::as_str).unwrap_or_default().to_owned();
    let is_there = |path: &str| entries.iter().any(|e| text(e, "path") == path && !text(e, "reason").is_empty());
    let missing = FORBIDDEN.split(' ').filter(|path| !is_there(path));
    missing.map(|path| format!("{path} is not forbidden, with a reason, in any list")).collect()
}

/// The lines of a file that name what is impure, unless the file allows itself a disallowed thing and says why.
fn impure(file: &File) -> Vec<String> {
    let allows = file.text.split("#[").chain(file.text.split("#![")).any(|attribute| {
        let attribute = attribute.split(']').next().unwrap_or_default();
        let is_lint = attribute.starts_with("allow(") || attribute.starts_with("expect(");
        is_lint && attribute.contains("clippy::disallowed") && attribute.contains("reason =")
    });
    let lines = numbered(&file.text).filter(|(_, line)| !allows && is_impure(line));
    lines.map(|(number, line)| format!("{}:{number}: {}", file.path, line.trim())).collect()
}

fn is_impure(line: &str) -> bool {
    let line = line.trim();
    if line.starts_with("//") {
        return false;
    }
    let uses = |module: &&str| {
        has_word(line, &format!("std::{module}"))
            || line.starts_with("use std::{") && has_word(line, module)
            || line
                .match_indices(&format!("{module}::"))
                .any(|(at, _)| !line[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ':'))
    };
    TYPES.iter().any(|name| has_word(line, name)) || MODULES.iter().any(uses)
}
