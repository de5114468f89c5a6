//! Crates depend toward `homebody-core` only, and no crate has unsafe code.

use super::{expect_none, repository};
use std::fs;
use toml::{Table, Value};

/// The crates on which each crate may depend, without the prefix `homebody-`.
const ARROWS: &str = "\
core:
import: core walk
walk: core
oracle: core
log: core timeline
postgres: core log
arrow: core log
mqtt: core log
infer: core log walk
script: core walk
routine: core script walk
analysis: core log timeline
picture: analysis core
timeline: core
placement: analysis core log routine timeline
lab: homebody analysis core infer log oracle picture placement query routine simulation timeline walk
simulation: analysis arrow core log mqtt postgres routine walk
query: analysis core log routine simulation timeline walk
tracking: analysis core infer log query routine simulation timeline walk
fleet: core log routine simulation
life: core routine simulation
scaffold: analysis core import log query routine simulation
web: analysis core import life log picture placement query routine scaffold simulation timeline tracking
homebody: analysis core fleet import infer life log picture placement query routine scaffold simulation timeline tracking web
python: homebody analysis arrow core life log picture query simulation tracking
fuzz: analysis arrow core import log mqtt picture postgres query routine simulation walk web";

/// Dev-dependencies besides, and why.
const BACKWARD: [(&str, &str, &str); 6] = [
    ("homebody-core", "homebody-oracle", "the tests compare the kernel with the update loop of the paper"),
    ("homebody", "homebody-lab", "the rules read the messages and the command line of the experiments"),
    ("homebody", "homebody-walk", "the tests count to how much of an imported plan there is a way"),
    ("homebody-core", "homebody-log", "the benchmarks hold the kernel beside the database that stores its firings"),
    ("homebody-picture", "homebody-log", "the tests draw what was analysed of logs"),
    ("homebody-picture", "homebody-timeline", "the tests draw the activities of a day"),
];

#[test]
fn crate_arrows_point_toward_the_core() {
    expect_none(manifests().iter().flat_map(astray).collect());
}

#[test]
fn an_arrow_away_from_the_core_is_found() {
    let core = "[package]\nname = 'homebody-core'\n";
    let wrong = |text: &str| astray(&table(text)).len();
    assert_eq!(wrong(core), 0);
    assert_eq!(wrong(&format!("{core}[dependencies]\nhomebody-log.workspace = true\nserde = '1'")), 1);
    assert_eq!(wrong(&format!("{core}[dependencies]\nlog = {{ package = 'homebody-log', path = '' }}")), 1);
    assert_eq!(wrong(&format!("{core}[target.'cfg(unix)'.build-dependencies]\nhomebody-picture = '1'")), 1);
    assert_eq!(wrong(&format!("{core}[dev-dependencies]\nhomebody-log = '1'")), 0);
    assert_eq!(wrong(&format!("{core}[dev-dependencies]\nhomebody-picture = '1'")), 1);
    assert_eq!(wrong("[package]\nname = 'homebody-new'"), 1);
}

#[test]
fn unsafe_code_is_forbidden_everywhere() {
    let workspace = table(&fs::read_to_string(repository().join("Cargo.toml")).expect("the workspace's Cargo.toml"));
    let level = at(&workspace, &["workspace", "lints", "rust", "unsafe_code"]).and_then(Value::as_str);
    assert_eq!(level, Some("forbid"), "Cargo.toml forbids unsafe code for all crates");
    expect_none(manifests().iter().filter_map(without_lints).collect());
}

#[test]
fn a_crate_without_the_lints_of_the_workspace_is_found() {
    assert!(without_lints(&table("[package]\nname = 'a'\n[lints]\nworkspace = true")).is_none());
    assert!(without_lints(&table("[package]\nname = 'a'\n[lints.clippy]\nall = 'warn'")).is_some());
    assert!(without_lints(&table("[package]\nname = 'a'")).is_some());
}

/// The problems with the dependencies of a crate.
fn astray(manifest: &Table) -> Vec<String> {
    let name = name(manifest);
    let short = |name: &str| name.strip_prefix("homebody-").unwrap_or(name).to_owned();
    let own = format!("{}:", short(name));
    let Some(allowed) = ARROWS.lines().find_map(|line| line.strip_prefix(&own)) else {
        return vec![format!("{name}: ARROWS in {} does not say on which crates it may depend", file!())];
    };
    let may = |to: &str, dev: bool| {
        allowed.split_whitespace().any(|allowed| allowed == short(to))
            || dev && BACKWARD.iter().any(|(from, back, _)| (*from, *back) == (name, to))
    };
    let mut wrong = Vec::new();
    for (kind, to) in ours(manifest) {
        if !may(&to, kind == "dev-dependencies") {
            wrong.push(format!("{name} must not have {to} in its {kind}"));
        }
    }
    wrong
}

/// The dependencies of a crate on crates of the workspace, with their kind.
pub fn ours(manifest: &Table) -> Vec<(&'static str, String)> {
    let targets = manifest.get("target").and_then(Value::as_table);
    let targets = targets.into_iter().flat_map(Table::values).filter_map(Value::as_table);
    let tables: Vec<&Table> = std::iter::once(manifest).chain(targets).collect();
    let mut ours = Vec::new();
    for kind in ["dependencies", "build-dependencies", "dev-dependencies"] {
        let dependencies = tables.iter().filter_map(|table| table.get(kind)).filter_map(Value::as_table);
        for (key, value) in dependencies.flatten() {
            let package = value.get("package").and_then(Value::as_str).unwrap_or(key);
            if package == "homebody" || package.starts_with("homebody-") {
                ours.push((kind, package.to_owned()));
            }
        }
    }
    ours
}

fn without_lints(manifest: &Table) -> Option<String> {
    let takes = at(manifest, &["lints", "workspace"]).and_then(Value::as_bool);
    (takes != Some(true)).then(|| format!("{}: [lints] workspace = true is missing", name(manifest)))
}

/// The `Cargo.toml` of every crate.
pub fn manifests() -> Vec<Table> {
    let crates = fs::read_dir(repository().join("crates")).expect("the folder crates");
    let paths = crates.map(|entry| entry.expect("an entry").path().join("Cargo.toml"));
    paths.filter_map(|path| fs::read_to_string(path).ok()).map(|text| table(&text)).collect()
}

fn table(text: &str) -> Table {
    text.parse().expect("a file in TOML")
}

pub fn name(manifest: &Table) -> &str {
    at(manifest, &["package", "name"]).and_then(Value::as_str).expect("a package has a name")
}

fn at<'a>(table: &'a Table, keys: &[&str]) -> Option<&'a Value> {
    let (last, tables) = keys.split_last()?;
    tables.iter().try_fold(table, |table, key| table.get(*key)?.as_table())?.get(*last)
}
