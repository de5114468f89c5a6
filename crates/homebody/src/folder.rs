//! A scenario folder: on disk, or one of those that came with the program.

use crate::failure::Failure;
use homebody_core::scenario::load::{Files, Scenario};
use homebody_routine::household::{Household, RoutineLanguage};
use include_dir::{Dir, include_dir};
use std::collections::BTreeMap;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// The scenarios that came with the program.
pub static OWN: Dir = include_dir!("$CARGO_MANIFEST_DIR/../../scenarios");

/// The files of a folder.
struct Folder(PathBuf);

impl Files for Folder {
    fn read(&self, name: &str) -> Result<String, String> {
        let bytes = fs::read(self.0.join(name)).map_err(|error| match error.kind() {
            ErrorKind::NotFound => "there is no such file".to_owned(),
            ErrorKind::IsADirectory => "it is a folder".to_owned(),
            _ => error.to_string(),
        })?;
        let text = String::from_utf8(bytes).map_err(|_| "it is not text in UTF-8")?;
        // A byte order mark says nothing.
        Ok(text.strip_prefix('\u{feff}').map_or(text.clone(), str::to_owned))
    }
}

/// Loads a scenario from its folder, or from its `scenario.json`; returns also the entry's name.
pub fn load(path: &Path) -> Result<(Scenario, String), Failure> {
    let meta = fs::metadata(path).map_err(|error| match error.kind() {
        ErrorKind::NotFound => {
            Failure::io(path, "there is no such scenario\n  hint: name its folder, or its scenario.json")
        }
        _ => Failure::io(path, error),
    })?;
    let entry = match meta.is_dir() {
        true => "scenario.json".to_owned(),
        false => path.file_name().unwrap_or_default().to_string_lossy().into_owned(),
    };
    let folder = folder_of(path);
    let file = folder.join(&entry);
    if !file.is_file() {
        return Err(Failure::io(&file, "there is no such file\n  hint: a scenario folder holds a scenario.json"));
    }
    Ok((Scenario::load_in(&RoutineLanguage, &Folder(folder.to_owned()), &entry)?, entry))
}

/// Loads a scenario with the routines of those who live there; conditions named in `without` are left out.
pub fn load_lives(path: &Path, without: &[String]) -> Result<(Scenario, String, Household), Failure> {
    let (mut scenario, entry) = load(path)?;
    let household = Household::read(&mut scenario, &Folder(folder_of(path).to_owned()), without)?;
    Ok((scenario, entry, household))
}

/// The files of the folder in which a scenario is.
pub fn files_beside(path: &Path) -> impl Files + Sync + use<> {
    Folder(folder_of(path).to_owned())
}

/// The files that a scenario was loaded from.
pub fn files(path: &Path, scenario: &Scenario) -> Vec<PathBuf> {
    scenario.sources.keys().map(|name| folder_of(path).join(name)).collect()
}

/// The folder of a scenario that is named by its folder or by a file in it.
pub fn folder_of(path: &Path) -> &Path {
    if path.is_dir() { path } else { path.parent().unwrap_or(Path::new("")) }
}

/// Loads a scenario that came with the program; returns also the entry's name.
pub fn load_own(name: &str) -> Result<(Scenario, String), Failure> {
    let entry = "scenario.json";
    Ok((Scenario::load(&own(name), entry)?, entry.to_owned()))
}

/// Loads a scenario that came with the program, with the routines of those who live there.
pub fn load_own_lives(name: &str) -> Result<(Scenario, Household), Failure> {
    let (mut scenario, _) = load_own(name)?;
    let household = Household::read(&mut scenario, &own(name), &[])?;
    Ok((scenario, household))
}

/// The files of a scenario that came with the program.
fn own(name: &str) -> BTreeMap<String, String> {
    let files = OWN.get_dir(name).into_iter().flat_map(Dir::files);
    let text = |file: &include_dir::File| {
        let name = file.path().file_name().unwrap_or_default().to_string_lossy().into_owned();
        (name, String::from_utf8_lossy(file.contents()).into_owned())
    };
    files.map(text).collect()
}
