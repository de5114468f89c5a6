//! A small flat with movement from the first moment, so that short runs have firings.
//!
//! Ann walks up and down the kitchen by a path, and Bob moves in the bedroom by keys. The study is empty, and its door is shut. The sensors
//! of the floor fire more often than real ones.

use crate::folder::Folder;

/// For an hour, four seconds to and four fro.
fn bobs_keys() -> String {
    let changes = (0..450).map(|turn| {
        let at = turn * 8;
        format!(
            r#"{{ "at_s": {at}, "held": ["right"] }}, {{ "at_s": {}, "held": ["left", "up"] }}, {{ "at_s": {}, "held": [] }}"#,
            at + 4,
            at + 6
        )
    });
    format!("{{ \"keys\": [\n{}\n] }}\n", changes.collect::<Vec<_>>().join(",\n"))
}

pub fn build(folder: &Folder) {
    let keys = bobs_keys();
    for (name, text) in [
        ("scenario.json", include_str!("../../../../tests/flat/scenario.json")),
        ("home.json", include_str!("../../../../tests/flat/home.json")),
        ("logger.json", include_str!("../../../../tests/flat/logger.json")),
        ("ann.json", include_str!("../../../../tests/flat/ann.json")),
        ("ann.path.json", include_str!("../../../../tests/flat/ann.path.json")),
        ("bob.json", include_str!("../../../../tests/flat/bob.json")),
        ("bob.keys.json", &keys),
    ] {
        folder.write(&format!("flat/{name}"), text);
    }
}

pub fn flat() -> Folder {
    let folder = Folder::new();
    build(&folder);
    folder
}
