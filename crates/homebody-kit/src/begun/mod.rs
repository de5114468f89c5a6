//! Scenarios that begin: a folder that is new, whole or not there, with the schemas of its files, and what goes into it.

mod empty;
mod from_log;
mod furnished;
mod inhabited;
mod messages;
mod sensor_table;
mod traced;

pub use empty::empty;
pub use from_log::{GivenLog, OfLog, of_log};
pub use furnished::furnish;
pub use inhabited::{Begun, Inhabited, inhabited, lack, lived_in};
pub use messages::NewMessage;
pub use sensor_table::{Row, read_table};
pub use traced::{Known, Traced};

use crate::error::Error;
use crate::source::Template;
use crate::whole_folder::whole_folder;
use homebody_core::problem::is_unseen;
use homebody_core::scenario::schema::schemas;
use homebody_log::fresh::FreshFile;
use serde_json::json;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// A scenario's files by name.
pub type Texts = BTreeMap<String, String>;

/// Makes a new folder with the schemas of a scenario's files, and has a function write the rest. The function gets the unfinished folder and
/// the scenario's name.
///
/// # Errors
///
/// [`Error::Exists`] where something has that name, [`Error::File`] where the system refuses, and what the function says; then
/// nothing is left behind.
pub fn begin<T, E: From<Error>>(folder: &Path, write: impl FnOnce(&Path, &str) -> Result<T, E>) -> Result<T, E> {
    if fs::symlink_metadata(folder).is_ok() {
        return Err(Error::Exists { path: folder.into() }.into());
    }
    if folder.file_name().is_some_and(|name| name.to_string_lossy().contains(is_unseen)) {
        return Err(Error::UnseenName { path: folder.into() }.into());
    }
    whole_folder(folder, |part, name| {
        write_schemas(part)?;
        write(part, name)
    })
}

/// Writes files into the folder of a scenario that begins.
///
/// # Errors
///
/// [`Error::Log`] where one is there already, or the system refuses.
pub fn write(folder: &Path, texts: &Texts) -> Result<(), Error> {
    for (file, text) in texts {
        FreshFile::write_whole(&folder.join(file), text.as_bytes(), false)?;
    }
    Ok(())
}

/// The files of a template as those of a scenario that is called so.
pub fn of_template(template: Template, name: &str) -> Texts {
    let (name, own) = (json!(name), json!(template.name()));
    let text = |(file, text): (String, String)| {
        // The schemas of the repository are two folders up, ours are right here; and it has a name of its own.
        let text = text.replace("\"../../schemas/", "\"./schemas/");
        (file, text.replace(&format!("\"name\": {own}"), &format!("\"name\": {name}")))
    };
    template.files().map(text).collect()
}

fn write_schemas(folder: &Path) -> Result<(), Error> {
    let schemas_folder = folder.join("schemas");
    fs::create_dir(&schemas_folder).map_err(|error| Error::io(&schemas_folder, error))?;
    for (name, schema) in schemas() {
        let text =
            serde_json::to_string_pretty(&schema).map_err(|error| Error::file(&schemas_folder, error.to_string()))?;
        FreshFile::write_whole(&schemas_folder.join(name), (text + "\n").as_bytes(), false)?;
    }
    Ok(())
}
