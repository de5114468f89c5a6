//! The seeds of mutants: files written for each target, and the scenarios of the program.

use crate::target::CaseFiles;
use homebody_simulation::Template;
use std::fs;
use std::path::{Path, PathBuf};

/// The cases in the folder of a target, in the order of their names: each a file, or a folder of files.
pub fn named(target: &str) -> Vec<CaseFiles> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(target);
    entries(&folder).iter().map(|path| if path.is_dir() { all_in(path) } else { one(path) }).collect()
}

/// The same for a target whose cases are one file of this name.
pub fn files(target: &str, name: &str) -> Vec<CaseFiles> {
    let texts = named(target).into_iter().flat_map(CaseFiles::into_values);
    texts.map(|text| CaseFiles::from([(name.to_owned(), text)])).collect()
}

/// The files with an ending in the cases of a target, and in the scenarios, each as a case with this name.
pub fn with_ending(target: &str, ending: &str, name: &str) -> Vec<CaseFiles> {
    let all = named(target).into_iter().chain(scenarios()).flatten().filter(|(own, _)| own.ends_with(ending));
    all.map(|(_, text)| CaseFiles::from([(name.to_owned(), text)])).collect()
}

/// The scenarios that come with the program, and the flat that tests share.
pub fn scenarios() -> Vec<CaseFiles> {
    let files = |template: Template| template.files().map(|(name, text)| (name, text.into_bytes())).collect();
    Template::all().map(files).chain([flat()]).collect()
}

/// The flat that tests share: one resident follows a path, keys move the other.
pub fn flat() -> CaseFiles {
    let mut flat = all_in(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/flat"));
    flat.insert("bob.keys.json".to_owned(), br#"{ "keys": [{ "at_s": 1, "held": ["right"] }] }"#.to_vec());
    flat
}

fn one(path: &Path) -> CaseFiles {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    CaseFiles::from([(name, fs::read(path).unwrap_or_default())])
}

fn all_in(folder: &Path) -> CaseFiles {
    entries(folder).iter().filter(|path| path.is_file()).flat_map(|path| one(path)).collect()
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut entries: Vec<PathBuf> = entries.collect();
    entries.sort();
    entries
}
