//! Every scenario of the repository is valid, and its files name their schemas.

use super::{expect_none, repository};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

#[test]
fn every_scenario_passes_the_check() {
    let folders = scenarios();
    assert!(!folders.is_empty());
    expect_none(folders.iter().filter_map(|folder| problems(folder)).collect());
}

#[test]
fn a_wrong_scenario_does_not_pass_the_check() {
    let folder = tempfile::tempdir().expect("a folder for a scenario");
    let scenario = r#"{ "name": "wrong", "start": "noon", "days": 1, "home": "home.json", "residents": [] }"#;
    fs::write(folder.path().join("scenario.json"), scenario).expect("the scenario is written");
    assert!(problems(folder.path()).is_some_and(|problems| problems.contains("scenario.json:1")));
}

#[test]
fn every_file_of_a_scenario_names_its_schema() {
    let files: Vec<PathBuf> = scenarios().iter().flat_map(|folder| entries(folder)).collect();
    let json = files.iter().filter(|path| path.extension().is_some_and(|extension| extension == "json"));
    let text = |path: &Path| fs::read_to_string(path).expect("the file can be read");
    let wrong = json.filter_map(|path| without_schema(path, &text(path)));
    expect_none(wrong.collect());
}

#[test]
fn a_file_without_a_schema_is_found() {
    let file = repository().join("scenarios/tigerplace/home.json");
    let wrong = |text| without_schema(&file, text).is_some();
    assert!(!wrong(r#"{ "$schema": "../../schemas/home.schema.json" }"#));
    assert!(wrong(r#"{ "$schema": "../../schemas/house.schema.json" }"#));
    assert!(wrong("{}"));
    assert!(wrong("{"));
}

/// The problems that `homebody check` reports.
fn problems(folder: &Path) -> Option<String> {
    let output = Command::new(env!("CARGO_BIN_EXE_homebody")).arg("check").arg(folder).output();
    let output = output.expect("homebody can be started");
    (!output.status.success()).then(|| String::from_utf8_lossy(&output.stderr).into_owned())
}

/// The problem with the `$schema` of a file, which is a path from the file's own folder.
fn without_schema(path: &Path, text: &str) -> Option<String> {
    let schema =
        serde_json::from_str::<Value>(text).ok().and_then(|file| Some(file.get("$schema")?.as_str()?.to_owned()));
    let Some(schema) = schema else { return Some(format!("{}: it names no $schema", path.display())) };
    let is_there = path.parent().is_some_and(|folder| folder.join(&schema).is_file());
    (!is_there).then(|| format!("{}: the $schema {schema} is not there", path.display()))
}

fn scenarios() -> Vec<PathBuf> {
    entries(&repository().join("scenarios")).into_iter().filter(|path| path.is_dir()).collect()
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("the folder can be read");
    entries.map(|entry| entry.expect("the entry can be read").path()).collect()
}

/// A scenario is a folder by itself, so these are copies; they must not drift apart.
#[test]
fn the_tigerplace_scenarios_have_one_home() {
    let read = |scenario: &str, file: &str| {
        let path = repository().join("scenarios").join(scenario).join(file);
        std::fs::read_to_string(path).expect("a file of a scenario")
    };
    for copy in ["tigerplace-depression", "tigerplace-decline"] {
        for file in ["home.json", "logger.json", "margaret.json"] {
            assert!(read("tigerplace", file) == read(copy, file), "{file} of {copy} is not that of tigerplace");
        }
    }
}
