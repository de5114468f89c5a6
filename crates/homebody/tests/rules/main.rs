//! The rules of the repository, as tests by name.
//!
//! A rule is a function from what it reads to what is wrong with it. One test gives it the repository and expects
//! nothing; another, the negative control, gives it a piece that breaks the rule and expects that to be found.

mod arrows;
mod circles;
mod commands;
mod documents;
#[path = "../../../../tests/generated.rs"]
mod generated;
mod labels;
mod limits;
mod markdown;
mod messages;
mod names;
mod numbers;
mod picture_of_crates;
mod prose;
mod purity;
mod reference;
mod rust;
mod source;
mod words;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// The rules name what they forbid, so those that look for words leave this folder out.
const RULES: &str = "crates/homebody/tests/rules/";

struct File {
    /// From the repository's folder, with slashes.
    path: String,
    text: String,
}

impl File {
    fn new(path: &str, text: &str) -> File {
        File { path: path.into(), text: text.into() }
    }

    fn is(&self, extension: &str) -> bool {
        self.path.rsplit_once('.').is_some_and(|(_, end)| end == extension)
    }
}

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// All files that are text, in order of their paths.
fn files() -> Vec<File> {
    let read = |path: String| fs::read_to_string(repository().join(&path)).ok().map(|text| File { path, text });
    paths().into_iter().filter(|path| !path.ends_with('/')).filter_map(read).collect()
}

/// All files and folders, in order; a folder ends with a slash. Entries of `.gitignore` are left out.
fn paths() -> Vec<String> {
    let mut paths = Vec::new();
    walk("", &ignored(), &mut paths);
    paths.sort();
    paths
}

fn ignored() -> Vec<String> {
    let text = fs::read_to_string(repository().join(".gitignore")).expect(".gitignore is there");
    let names = text.lines().map(|line| line.trim().trim_matches('/').to_owned());
    names.filter(|name| !name.is_empty() && !name.starts_with('#')).collect()
}

fn walk(folder: &str, ignored: &[String], paths: &mut Vec<String>) {
    for entry in fs::read_dir(repository().join(folder)).expect("the folder can be read") {
        let entry = entry.expect("the entry can be read");
        let name = entry.file_name().into_string().expect("a name in UTF-8");
        let is_hidden = name.starts_with('.') && ![".ci", ".github", ".gitignore"].contains(&name.as_str());
        if is_hidden || ignored.contains(&name) {
            continue;
        }
        let path = format!("{folder}{name}");
        if entry.file_type().expect("the entry has a type").is_dir() {
            let folder = path + "/";
            walk(&folder, ignored, paths);
            paths.push(folder);
        } else {
            paths.push(path);
        }
    }
}

/// Fails with all that is wrong, a line each.
#[track_caller]
fn expect_none(wrong: Vec<String>) {
    assert!(wrong.is_empty(), "{} to mend:\n  {}", wrong.len(), wrong.join("\n  "));
}

/// The lines of a text with their numbers from 1.
fn numbered(text: &str) -> impl Iterator<Item = (usize, &str)> {
    (1..).zip(text.lines())
}

/// All that one needs, with what these need, and so on.
fn reached<T: Ord + Clone>(from: T, needed: impl Fn(&T) -> Vec<T>) -> BTreeSet<T> {
    let mut reached = BTreeSet::new();
    let mut open = vec![from];
    while let Some(next) = open.pop() {
        open.extend(needed(&next).into_iter().filter(|other| reached.insert(other.clone())));
    }
    reached
}

/// True if `text` has `word` without a letter, digit or underscore next to it.
fn has_word(text: &str, word: &str) -> bool {
    let joins = |c: char| c.is_alphanumeric() || c == '_';
    text.match_indices(word).any(|(at, _)| !text[..at].ends_with(joins) && !text[at + word.len()..].starts_with(joins))
}
