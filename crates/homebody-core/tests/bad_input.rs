//! Each problem of a scenario is reported with its place and its code.

mod all_at_once;
mod data;
mod devices;
mod good;
mod limits;
mod link;
mod meaning;
mod mutations;
mod shape;
mod text;

use good::good;
use homebody_core::problem::{Problem, Problems};
use homebody_core::scenario::load::Scenario;
use std::collections::BTreeMap;

/// A file of the good scenario, a part of its text, the text in its place, and the problems that this causes: a line that begins with a
/// number is a problem of this file, and other lines name their file.
type Case<'a> = (&'a str, &'a str, &'a str, &'a str);

fn check(cases: &[Case]) {
    for (file, old, new, expected) in cases {
        let found = reported(&broken(&[(file, old, new)]));
        assert_eq!(found, with_file(file, expected), "after {new:?} for {old:?} in {file}");
    }
}

/// The problems of a case, each with its file.
fn with_file(file: &str, expected: &str) -> String {
    let whole = |line: &str| match line.starts_with(|first: char| first.is_ascii_digit()) {
        true => format!("{file}:{line}"),
        false => line.to_owned(),
    };
    expected.lines().map(whole).collect::<Vec<_>>().join("\n")
}

/// The good scenario with some of its text replaced.
fn broken(changes: &[(&str, &str, &str)]) -> BTreeMap<String, String> {
    changed(good(), changes)
}

/// Files with some of their text replaced.
fn changed(mut files: BTreeMap<String, String>, changes: &[(&str, &str, &str)]) -> BTreeMap<String, String> {
    for (file, old, new) in changes {
        let text = files.get_mut(*file).unwrap();
        assert_eq!(text.matches(old).count(), 1, "{old:?} must be in {file} once");
        *text = text.replace(old, new);
    }
    files
}

fn problems(files: &BTreeMap<String, String>) -> Problems {
    Scenario::load(files, "scenario.json").map_or_else(|problems| problems, |_| Problems::default())
}

/// The problems of the files, one on each line, as [`listed`] writes them.
fn reported(files: &BTreeMap<String, String>) -> String {
    listed(&problems(files))
}

/// Problems, one on each line: the place, the code, and the name that was probably meant.
fn listed(problems: &Problems) -> String {
    let line = |problem: &Problem| {
        let place = match problem.line {
            0 => problem.file.clone(),
            line => format!("{}:{line}:{}", problem.file, problem.column),
        };
        let nearest = problem.data.get("nearest").filter(|name| !name.is_null());
        format!("{place}: {}{}", problem.code, nearest.map_or(String::new(), |name| format!(" {name}")))
    };
    problems.0.iter().map(line).collect::<Vec<_>>().join("\n")
}
