//! What is wrong with a scenario is said with its place, in words that help.

mod all_at_once;
mod devices;
mod good;
mod limits;
mod link;
mod meaning;
mod mutations;
mod shape;
mod text;

use good::good;
use homebody_core::problem::Problems;
use homebody_core::scenario::load::Scenario;
use std::collections::BTreeMap;

/// A file of the good scenario, a part of its text, what stands there instead, and what is said of it.
type Case<'a> = (&'a str, &'a str, &'a str, &'a str);

fn check(cases: &[Case]) {
    for (file, old, new, expected) in cases {
        assert_eq!(said(&broken(&[(file, old, new)])), *expected, "after {new:?} for {old:?} in {file}");
    }
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

/// What is said of the files, a problem a line: place, what, hint.
fn said(files: &BTreeMap<String, String>) -> String {
    let said = problems(files).0.into_iter().map(|problem| problem.to_string().replace("\n  hint: ", "; "));
    said.collect::<Vec<_>>().join("\n")
}
