//! The picture of the crates in `ARCHITECTURE.md`, made from their `Cargo.toml`.

use super::arrows::{manifests, name, ours};
use super::generated::is_generated;
use super::{reached, repository};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;

const BEGIN: &str =
    "<!-- The picture of the crates: made by HOMEBODY_REWRITE=1 and the test `the_picture_shows_the_crates`. -->\n";
const END: &str = "<!-- The end of the picture. -->\n";

/// For each crate the crates that it depends on.
type Arrows = BTreeMap<String, BTreeSet<String>>;

#[test]
fn the_picture_shows_the_crates() {
    let manifests = manifests();
    let arrows = manifests.iter().map(|manifest| {
        let needed = ours(manifest).into_iter().filter(|(kind, _)| *kind != "dev-dependencies").map(|(_, to)| to);
        (name(manifest).to_owned(), needed.collect())
    });
    let page = fs::read_to_string(repository().join("ARCHITECTURE.md")).expect("ARCHITECTURE.md");
    let (before, rest) = page.split_once(BEGIN).expect("the beginning of the picture");
    let (_, after) = rest.split_once(END).expect("the end of the picture");
    is_generated("ARCHITECTURE.md", &format!("{before}{BEGIN}\n{}\n{END}{after}", picture(&arrows.collect())));
}

#[test]
fn the_picture_leaves_out_arrows_that_follow_from_others() {
    let arrows = |of: &[(&str, &[&str])]| -> Arrows {
        of.iter().map(|(from, to)| ((*from).into(), to.iter().map(|to| (*to).into()).collect())).collect()
    };
    let all = arrows(&[
        ("homebody", &["homebody-core", "homebody-log"]),
        ("homebody-log", &["homebody-core"]),
        ("homebody-core", &[]),
    ]);
    let text = picture(&all);
    assert!(text.contains("homebody --> log\n") && text.contains("log --> core\n"), "{text}");
    assert!(!text.contains("homebody --> core"), "{text}");
}

/// A flow chart in Mermaid's language: each crate above those that it needs.
fn picture(arrows: &Arrows) -> String {
    let short = |name: &str| name.strip_prefix("homebody-").unwrap_or(name).to_owned();
    let mut text = String::from("```mermaid\nflowchart TD\n");
    for (from, needed) in arrows {
        // The dependencies of a needed crate are drawn there.
        let needs = |other: &String| arrows.get(other).into_iter().flatten().cloned().collect();
        let by_others: BTreeSet<String> = needed.iter().flat_map(|other| reached(other.clone(), needs)).collect();
        for to in needed.iter().filter(|to| !by_others.contains(*to)) {
            text += &format!("    {} --> {}\n", short(from), short(to));
        }
    }
    text + "```\n"
}
