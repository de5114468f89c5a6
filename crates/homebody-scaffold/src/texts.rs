//! The folder of a new scenario and its files.

use crate::error::ScaffoldError;
use homebody_core::problem::is_unseen;
use homebody_core::scenario::schema::schemas;
use homebody_log::files::fresh::FreshFile;
use homebody_simulation::{SimulationError, Template, new_folder};
use serde_json::json;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

pub type ScenarioTexts = BTreeMap<String, String>;

/// Creates a folder with the schemas of a scenario's files, and passes the incomplete folder and the scenario's name to
/// a function that writes the rest.
///
/// # Errors
///
/// [`ScaffoldError::Simulation`] if the name exists or the system refuses, and errors of the function; the folder is
/// then removed.
pub fn create<T, E: From<ScaffoldError> + From<SimulationError>>(
    folder: &Path,
    write: impl FnOnce(&Path, &str) -> Result<T, E>,
) -> Result<T, E> {
    if fs::symlink_metadata(folder).is_ok() {
        return Err(SimulationError::Exists { path: folder.into() }.into());
    }
    if folder.file_name().is_some_and(|name| name.to_string_lossy().contains(is_unseen)) {
        return Err(ScaffoldError::UnseenName { path: folder.into() }.into());
    }
    new_folder(folder, |part, name| {
        write_schemas(part)?;
        write(part, name)
    })
}

/// Writes files into the folder of a new scenario.
pub fn write(folder: &Path, texts: &ScenarioTexts) -> Result<(), ScaffoldError> {
    for (file, text) in texts {
        FreshFile::write_whole(&folder.join(file), text.as_bytes(), false)?;
    }
    Ok(())
}

/// The files of a template, for a scenario with this name.
pub fn from_template(template: Template, name: &str) -> ScenarioTexts {
    let (name, own) = (json!(name), json!(template.name()));
    let text = |(file, text): (String, String)| {
        // In the repository, schemas are two folders up; here, they are in the folder. The scenario has a name of its
        // own.
        let text = text.replace("\"../../schemas/", "\"./schemas/");
        (file, text.replace(&format!("\"name\": {own}"), &format!("\"name\": {name}")))
    };
    template.files().map(text).collect()
}

fn write_schemas(folder: &Path) -> Result<(), ScaffoldError> {
    let schemas_folder = folder.join("schemas");
    fs::create_dir(&schemas_folder).map_err(|error| SimulationError::io(&schemas_folder, error))?;
    for (name, schema) in schemas() {
        let text = serde_json::to_string_pretty(&schema)
            .map_err(|error| SimulationError::file(&schemas_folder, error.to_string()))?;
        FreshFile::write_whole(&schemas_folder.join(name), (text + "\n").as_bytes(), false)?;
    }
    Ok(())
}
