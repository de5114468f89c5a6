//! The folder of a scenario that begins: new, whole or not there, with the schemas of its files.

use crate::failure::Failure;
use crate::print::{json_text, write_file};
use homebody_core::scenario::schema::schemas;
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

/// Makes a folder that was not there and has it written, by a function that gets the name of what is in it.
pub fn begin(folder: &Path, write: impl FnOnce(&str) -> Result<(), Failure>) -> Result<(), Failure> {
    let exists = || Failure::Io(format!("{} exists already\n  hint: name a folder that does not", folder.display()));
    // What ends in `.` or `..` has no name of its own.
    let name = folder.file_name().ok_or_else(exists)?;
    let parent = folder.parent().filter(|parent| !parent.as_os_str().is_empty());
    parent.map_or(Ok(()), fs::create_dir_all).map_err(|error| Failure::io(folder, error))?;
    fs::create_dir(folder).map_err(|error| match error.kind() {
        ErrorKind::AlreadyExists => exists(),
        _ => Failure::io(folder, error),
    })?;
    let written = write_schemas(folder).and_then(|()| write(&name.to_string_lossy()));
    if written.is_err() {
        // It is ours: nothing is left half made.
        let _ = fs::remove_dir_all(folder);
    }
    written
}

fn write_schemas(folder: &Path) -> Result<(), Failure> {
    let schemas_folder = folder.join("schemas");
    fs::create_dir(&schemas_folder).map_err(|error| Failure::io(&schemas_folder, error))?;
    for (name, schema) in schemas() {
        write_file(&schemas_folder.join(name), json_text(&schema)?.as_bytes(), false)?;
    }
    Ok(())
}
