//! A database file that has its name only once it is whole, as other files have.

use super::database::{put_aside, remove_database};
use crate::error::{LogError, place_of};
use crate::files::{ExistingFile, FileLock, WriteMode, name_if_free};
use crate::url::Url;
use homebody_core::scenario::scheme::Scheme;
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

/// A log that is written into `week.db.part` and renamed to `week.db` at the end. The part that a killed program left is replaced.
///
/// Other places do that themselves, or are written in place.
pub(crate) struct Whole<'u> {
    to: &'u Url,
    part: Option<Url>,
    replaces: bool,
    /// Of the place; that of the part is the database's own.
    _lock: Option<FileLock>,
}

impl<'u> Whole<'u> {
    pub fn begin(to: &'u Url, how: WriteMode) -> Result<Whole<'u>, LogError> {
        let file = to.file().filter(|_| to.scheme() == Scheme::Sqlite);
        let Some(file) = file else { return Ok(Whole { to, part: None, replaces: false, _lock: None }) };
        let lock = FileLock::take(file)?;
        let replaces = how == WriteMode::Overwrite;
        if ExistingFile::at(file, replaces)? == ExistingFile::Device {
            return Err(LogError::NoFile { place: place_of(file) });
        }
        let mut name = file.file_name().unwrap_or_default().to_owned();
        name.push(".part");
        let part = file.with_file_name(name);
        // Only the program with the lock of the place writes its part.
        remove_database(&part);
        let part = Some(to.at(part));
        Ok(Whole { to, part, replaces, _lock: Some(lock) })
    }

    /// The place to write to until then.
    pub fn part(&self) -> &Url {
        self.part.as_ref().unwrap_or(self.to)
    }

    /// Gives the whole file its name.
    pub fn name(mut self) -> Result<(), LogError> {
        let (Some(part), Some(file)) = (self.part.take(), self.to.file()) else { return Ok(()) };
        take_name(part.path(), file, self.replaces).inspect_err(|_| remove_database(part.path()))
    }
}

impl Drop for Whole<'_> {
    fn drop(&mut self) {
        if let Some(part) = &self.part {
            remove_database(part.path());
        }
    }
}

/// Renames a database that is whole, over what may be replaced.
fn take_name(part: &Path, file: &Path, replaces: bool) -> Result<(), LogError> {
    match ExistingFile::at(file, replaces)? {
        ExistingFile::Replaced => {
            // The old database's readers and writers are those of the new one.
            let named = fs::symlink_metadata(file).and_then(|old| match old.is_file() {
                true => fs::set_permissions(part, old.permissions()),
                false => Ok(()),
            });
            named.map_err(|error| LogError::file(file, error))?;
            let aside = put_aside(file)?;
            let named = fs::rename(part, file);
            match &named {
                Ok(()) => drop(fs::remove_file(aside)),
                Err(_) => drop(fs::rename(aside, file)),
            }
            named.map_err(|error| LogError::file(file, error))
        }
        _ => name_if_free(part, file).map_err(|error| match error.kind() {
            ErrorKind::AlreadyExists => LogError::Exists { place: place_of(file) },
            _ => LogError::file(file, error),
        }),
    }
}
