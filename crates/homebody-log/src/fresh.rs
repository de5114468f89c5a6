//! New files: nothing that is there already is overwritten unasked, nothing new is half written.

use crate::error::LogError;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// What is at a path where a log shall be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// Nothing yet.
    Free,
    /// A file that may be replaced; of a symbolic link the link is, and what it leads to stays as it was.
    Replaced,
    /// A pipe or a device: it is written to as it is.
    Device,
}

impl Place {
    /// Looks at a path, and refuses it where a log could not or should not be written.
    pub fn at(path: &Path, force: bool) -> Result<Place, LogError> {
        let kind = match fs::symlink_metadata(path) {
            Ok(found) if found.is_symlink() => fs::metadata(path).unwrap_or(found).file_type(),
            Ok(found) => found.file_type(),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                let folder = folder(path);
                return if folder.is_dir() { Ok(Place::Free) } else { Err(LogError::NoFolder { path: path.into() }) };
            }
            Err(error) if error.kind() == io::ErrorKind::NotADirectory => {
                return Err(LogError::NoFolder { path: path.into() });
            }
            Err(error) => return Err(LogError::file(path, error)),
        };
        if kind.is_dir() {
            Err(LogError::IsFolder { path: path.into() })
        } else if !kind.is_file() && !kind.is_symlink() {
            Ok(Place::Device)
        } else if force {
            Ok(Place::Replaced)
        } else {
            Err(LogError::Exists { path: path.into() })
        }
    }
}

/// Looks at all files that a program is going to write, before the first of them is touched: each can be
/// written, none is there already or `force` is given, no two are one.
pub fn all_can_be_written(paths: &[&Path], force: bool) -> Result<(), LogError> {
    for (index, path) in paths.iter().enumerate() {
        Place::at(path, force)?;
        if paths[..index].iter().any(|other| same_file(other, path)) {
            return Err(LogError::SameFile { path: path.into() });
        }
    }
    Ok(())
}

/// Whether two paths lead to one file, be it there yet or not.
pub fn same_file(one: &Path, other: &Path) -> bool {
    let whole = |path: &Path| {
        let named = || Some(folder(path).canonicalize().ok()?.join(path.file_name()?));
        path.canonicalize().ok().or_else(named)
    };
    one == other || whole(one).is_some_and(|one| Some(one) == whole(other))
}

/// A text file that takes its name only when it is whole; dropped before, it leaves nothing behind.
pub struct FreshFile {
    path: PathBuf,
    place: Place,
    /// Where it is until then, beside its later place so that renaming it moves no data.
    part: Option<PathBuf>,
    out: BufWriter<File>,
}

impl FreshFile {
    pub fn create(path: &Path, force: bool) -> Result<FreshFile, LogError> {
        let place = Place::at(path, force)?;
        let begun = match place {
            Place::Device => OpenOptions::new().write(true).open(path).map(|file| (None, file)),
            _ => begin_part(path).map(|(part, file)| (Some(part), file)),
        };
        let (part, file) = begun.map_err(|error| LogError::file(path, error))?;
        Ok(FreshFile { path: path.into(), place, part, out: BufWriter::with_capacity(1 << 16, file) })
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    pub fn write(&mut self, bytes: &[u8]) -> Result<(), LogError> {
        self.out.write_all(bytes).map_err(|error| LogError::file(&self.path, error))
    }

    pub fn flush(&mut self) -> Result<(), LogError> {
        self.out.flush().map_err(|error| LogError::file(&self.path, error))
    }

    /// Makes sure of the data, then gives the file its name.
    pub fn finish(mut self) -> Result<(), LogError> {
        self.flush()?;
        let Some(part) = self.part.take() else {
            return Ok(());
        };
        let named = self.out.get_ref().sync_all().and_then(|()| match self.place {
            Place::Replaced => replace(&part, &self.path),
            _ => name_if_free(&part, &self.path),
        });
        match named {
            Ok(()) => sync_folder(&self.path),
            Err(error) => {
                let _ = fs::remove_file(&part);
                match error.kind() {
                    io::ErrorKind::AlreadyExists => Err(LogError::Exists { path: self.path.clone() }),
                    _ => Err(LogError::file(&self.path, error)),
                }
            }
        }
    }
}

impl Drop for FreshFile {
    fn drop(&mut self) {
        if let Some(part) = &self.part {
            let _ = fs::remove_file(part);
        }
    }
}

/// A new file beside a path: others may be on their way to the same one.
fn begin_part(path: &Path) -> io::Result<(PathBuf, File)> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let mut number = 0;
    loop {
        let part = path.with_file_name(format!("{name}.{}-{number}.part", std::process::id()));
        match OpenOptions::new().write(true).create_new(true).open(&part) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => number += 1,
            begun => return begun.map(|file| (part, file)),
        }
    }
}

/// Renames over a file, and who may read and write it stays as it was.
fn replace(part: &Path, path: &Path) -> io::Result<()> {
    if let Ok(old) = fs::symlink_metadata(path)
        && old.is_file()
    {
        fs::set_permissions(part, old.permissions())?;
    }
    fs::rename(part, path)
}

/// Renames, but not over a file that has come in the meantime.
fn name_if_free(part: &Path, path: &Path) -> io::Result<()> {
    match fs::hard_link(part, path) {
        Ok(()) => fs::remove_file(part),
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Err(error),
        // Not every file system has hard links.
        Err(_) if fs::symlink_metadata(path).is_ok() => Err(io::ErrorKind::AlreadyExists.into()),
        Err(_) => fs::rename(part, path),
    }
}

/// Makes sure of a file's name, where a folder can be synced at all.
fn sync_folder(path: &Path) -> Result<(), LogError> {
    if cfg!(unix) {
        let synced = File::open(folder(path)).and_then(|folder| folder.sync_all());
        synced.map_err(|error| LogError::file(path, error))?;
    }
    Ok(())
}

fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}
