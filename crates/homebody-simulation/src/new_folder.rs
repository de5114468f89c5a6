//! Folders that get their names when they are complete.

use crate::error::SimulationError;
use homebody_log::files::lock::FolderLock;
use std::ffi::OsString;
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

/// Makes `.home.part` for `home`, has it written by a function, and renames it. The function gets that folder and the name of the place. A folder that a killed program left under that name is replaced. The place may hold an empty
/// folder.
///
/// # Errors
///
/// [`SimulationError::Exists`] if the name is taken, [`SimulationError::File`] after an error of the system, [`SimulationError::Log`] if another
/// program writes it, and the errors of the function. Nothing is left behind after an error.
pub fn new_folder<T, E: From<SimulationError>>(
    folder: &Path,
    write: impl FnOnce(&Path, &str) -> Result<T, E>,
) -> Result<T, E> {
    let exists = || SimulationError::Exists { path: folder.into() };
    // A path that ends in `.` or `..` has no name of its own.
    let name = folder.file_name().ok_or_else(exists)?;
    let parent = folder.parent().filter(|parent| !parent.as_os_str().is_empty());
    parent.map_or(Ok(()), fs::create_dir_all).map_err(|error| SimulationError::io(folder, error))?;
    let mut hidden = OsString::from(".");
    hidden.push(name);
    hidden.push(".part");
    let part = folder.with_file_name(hidden);
    let _lock = take(&part, folder)?;
    let made = write(&part, &name.to_string_lossy()).and_then(|made| {
        fs::rename(&part, folder).map_err(|error| match error.kind() {
            ErrorKind::AlreadyExists | ErrorKind::DirectoryNotEmpty | ErrorKind::NotADirectory => exists(),
            _ => SimulationError::io(folder, error),
        })?;
        Ok(made)
    });
    if made.is_err() {
        // Removes the incomplete folder.
        let _ = fs::remove_dir_all(&part);
    }
    made
}

/// Creates the temporary folder for `folder` again, and locks it.
fn take(part: &Path, folder: &Path) -> Result<FolderLock, SimulationError> {
    loop {
        match fs::create_dir(part) {
            Ok(()) => {
                let lock = FolderLock::take(part)?;
                // Another program may have deleted it as a leftover before it was locked.
                if part.is_dir() {
                    return Ok(lock);
                }
            }
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {
                let is_folder = fs::symlink_metadata(part).is_ok_and(|found| found.is_dir());
                if !is_folder {
                    return Err(SimulationError::Exists { path: part.into() });
                }
                let _left = FolderLock::take(part)?;
                fs::remove_dir_all(part).map_err(|error| SimulationError::io(part, error))?;
            }
            Err(error) => return Err(SimulationError::io(folder, error)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_file(folder: &Path) -> Result<(), SimulationError> {
        new_folder(folder, |part, _| {
            fs::write(part.join("file"), "new").map_err(|error| SimulationError::io(part, error))
        })
    }

    #[test]
    fn replaces_the_folder_of_a_killed_program() {
        let within = tempfile::tempdir().unwrap();
        let (folder, part) = (within.path().join("home"), within.path().join(".home.part"));
        fs::create_dir_all(part.join("schemas")).unwrap();
        fs::write(part.join("file"), "half").unwrap();
        with_file(&folder).unwrap();
        assert_eq!(fs::read_to_string(folder.join("file")).unwrap(), "new");
        let names: Vec<_> = fs::read_dir(within.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        assert_eq!(names, ["home"]);
        // A complete folder stays.
        assert!(matches!(with_file(&folder), Err(SimulationError::Exists { .. })));
        assert!(!part.exists());
    }

    #[test]
    #[cfg(unix)]
    fn leaves_alone_what_another_program_writes_and_what_is_a_link() {
        let within = tempfile::tempdir().unwrap();
        let (folder, part) = (within.path().join("home"), within.path().join(".home.part"));
        fs::create_dir(&part).unwrap();
        let lock = FolderLock::take(&part).unwrap();
        assert!(matches!(with_file(&folder), Err(SimulationError::Log(_))));
        assert!(part.is_dir());
        drop(lock);
        with_file(&folder).unwrap();
        let (mine, other) = (within.path().join("mine"), within.path().join("other"));
        fs::create_dir(&mine).unwrap();
        fs::write(mine.join("letter"), "").unwrap();
        std::os::unix::fs::symlink(&mine, within.path().join(".other.part")).unwrap();
        assert!(with_file(&other).is_err() && mine.join("letter").is_file());
    }
}
