//! A name of a type has one meaning in the whole workspace.

use super::rust::words;
use super::source::is_for_tests;
use super::{File, files};
use std::collections::{BTreeMap, BTreeSet};

#[test]
fn types_share_no_name() {
    let shared = shared(&files());
    let places: Vec<String> = shared.iter().map(|(name, paths)| format!("{name}: {}", paths.join(", "))).collect();
    assert!(places.is_empty(), "rename the less general types of these names:\n{}", places.join("\n"));
}

#[test]
fn finds_names_that_types_share() {
    let one = File::new(
        "crates/a/src/one.rs",
        "pub struct Row;\nenum Cell { Row }\n#[cfg(test)]\nmod tests { struct Cell; }",
    );
    let two = File::new("crates/b/src/two.rs", "struct Row(u32); fn f(type_: Cell) {} trait Other { type Cell; }");
    let shared = shared(&[one, two]);
    assert_eq!(
        shared.into_iter().collect::<Vec<_>>(),
        [("Row".to_owned(), vec!["a/src/one.rs".into(), "b/src/two.rs".into()])]
    );
}

/// The names of types that several files define, with the files.
fn shared(files: &[File]) -> BTreeMap<String, Vec<String>> {
    let mut all: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for file in files.iter().filter(|file| !is_for_tests(&file.path, files)) {
        let Some(path) = file.path.strip_prefix("crates/").filter(|path| path.contains("/src/")) else { continue };
        let text = file.text.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
        for pair in words(text).windows(2) {
            let is_type = ["struct", "enum", "union", "trait"].contains(&pair[0].as_str());
            if is_type && pair[1].starts_with(|first: char| first.is_ascii_uppercase()) {
                all.entry(pair[1].clone()).or_default().insert(path.to_owned());
            }
        }
    }
    let several = all.into_iter().filter(|(_, paths)| paths.len() > 1);
    several.map(|(name, paths)| (name, paths.into_iter().collect())).collect()
}
