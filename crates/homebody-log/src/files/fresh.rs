//! New files: nothing that is there already is overwritten unasked, nothing new is half written.

use super::lock::is_at;
use super::open::{OpenMode, open};
use super::replaced::may_be_replaced;
use crate::error::{LogError, place_of};
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// The present content of a path for a new file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ExistingFile {
    /// Nothing yet.
    Free,
    /// A file that may be replaced. A symbolic link is replaced itself, and its target stays unchanged.
    Replaced,
    /// A pipe or a device, which is written to directly.
    Device,
}

impl ExistingFile {
    /// Looks at a path, and refuses it where a log could not or should not be written.
    pub fn at(path: &Path, force: bool) -> Result<ExistingFile, LogError> {
        let kind = match fs::symlink_metadata(path) {
            Ok(found) if found.is_symlink() => fs::metadata(path).unwrap_or(found).file_type(),
            Ok(found) => found.file_type(),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                let folder = folder(path);
                return if folder.is_dir() {
                    Ok(ExistingFile::Free)
                } else {
                    Err(LogError::NoFolder { place: place_of(path) })
                };
            }
            Err(error) if error.kind() == io::ErrorKind::NotADirectory => {
                return Err(LogError::NoFolder { place: place_of(path) });
            }
            Err(error) => return Err(LogError::file(path, error)),
        };
        if kind.is_dir() {
            Err(LogError::IsFolder { place: place_of(path) })
        } else if !kind.is_file() && !kind.is_symlink() {
            Ok(ExistingFile::Device)
        } else if force {
            may_be_replaced(path)?;
            Ok(ExistingFile::Replaced)
        } else {
            Err(LogError::Exists { place: place_of(path) })
        }
    }
}

/// Looks at all files that a program is going to write, before the first of them is touched: each can be
/// written, none is there already or `force` is given, no two are one.
pub fn all_can_be_written(paths: &[&Path], force: bool) -> Result<(), LogError> {
    for (index, path) in paths.iter().enumerate() {
        ExistingFile::at(path, force)?;
        if paths[..index].iter().any(|other| same_file(other, path)) {
            return Err(LogError::SameFile { place: place_of(path) });
        }
    }
    Ok(())
}

/// Whether two paths lead to one file, which need not exist.
pub fn same_file(one: &Path, other: &Path) -> bool {
    let led = |path: &Path| path.canonicalize().ok().or_else(|| whole(path));
    one == other || led(one).is_some_and(|one| Some(one) == led(other))
}

/// A file's path from the root on, without detours; of a link it is the link's. None where its folder is not there.
pub(crate) fn whole(path: &Path) -> Option<PathBuf> {
    Some(folder(path).canonicalize().ok()?.join(path.file_name()?))
}

/// A text file that takes its name only when it is whole; dropped before, it leaves nothing behind.
pub struct FreshFile {
    path: PathBuf,
    place: ExistingFile,
    /// Its temporary path in the same folder, so that renaming moves no data.
    part: Option<PathBuf>,
    out: BufWriter<File>,
}

impl FreshFile {
    /// Begins a file under another name in its folder; with `force`, it may replace a file. A device, such as a pipe, is written to at
    /// once.
    pub fn create(path: &Path, force: bool) -> Result<FreshFile, LogError> {
        FreshFile::create_as(path, "", force)
    }

    /// The same; until it is whole, its name begins with a dot, so that programs that read all files of the folder skip it.
    pub fn create_hidden(path: &Path, force: bool) -> Result<FreshFile, LogError> {
        FreshFile::create_as(path, ".", force)
    }

    fn create_as(path: &Path, dot: &str, force: bool) -> Result<FreshFile, LogError> {
        let place = ExistingFile::at(path, force)?;
        let begun = match place {
            ExistingFile::Device => OpenOptions::new().write(true).open(path).map(|file| (None, file)),
            _ => {
                remove_stale_parts(path);
                begin_part(path, dot).map(|(part, file)| (Some(part), file))
            }
        };
        let (part, file) = begun.map_err(|error| LogError::file(path, error))?;
        Ok(FreshFile { path: path.into(), place, part, out: BufWriter::with_capacity(1 << 16, file) })
    }

    /// Writes a whole file under its name or not at all; `force` allows that one with its name is replaced.
    pub fn write_whole(path: &Path, bytes: &[u8], force: bool) -> Result<(), LogError> {
        let mut file = FreshFile::create(path, force)?;
        file.write(bytes)?;
        file.finish()
    }

    /// Opens what a program that died has left of a file, be it whole already or not; None where there is nothing. Its
    /// text is read from its beginning, and may be cut and added to.
    pub fn reopen(path: &Path) -> Result<Option<(FreshFile, File)>, LogError> {
        let is_whole = fs::symlink_metadata(path).is_ok();
        let unread = |error| LogError::reading(path, error);
        if is_whole {
            // A program that died as it gave the file its name has left it under both.
            remove_parts(path)?;
        }
        let left = if is_whole { Some(path.to_owned()) } else { largest_part(path).map_err(unread)? };
        let Some(left) = left else { return Ok(None) };
        let unwritten = |error| LogError::file(&left, error);
        let file = open(&left, OpenMode::Left).map_err(unwritten)?;
        // Both are at one place of the file, until it is cut.
        let read = file.try_clone().map_err(unwritten)?;
        let part = (!is_whole).then_some(left);
        let out = BufWriter::with_capacity(1 << 16, file);
        Ok(Some((FreshFile { path: path.into(), place: ExistingFile::Free, part, out }, read)))
    }

    /// Cuts the file to so many bytes, and continues behind them.
    pub fn cut(&mut self, bytes: u64) -> Result<(), LogError> {
        let file = self.out.get_mut();
        let cut = file.set_len(bytes).and_then(|()| file.seek(SeekFrom::Start(bytes)));
        cut.map(|_| ()).map_err(|error| LogError::file(&self.path, error))
    }

    /// Keeps the file unchanged, with its present name.
    pub fn keep(&mut self) {
        self.part = None;
    }

    /// Its temporary path until it has its name; None for a device.
    pub fn part(&self) -> Option<&Path> {
        self.part.as_deref()
    }

    /// The name that the file gets once it is whole.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Adds bytes at its end. They may wait in memory until [`FreshFile::flush`].
    #[inline]
    pub fn write(&mut self, bytes: &[u8]) -> Result<(), LogError> {
        self.out.write_all(bytes).map_err(|error| LogError::file(&self.path, error))
    }

    /// Hands all bytes to the system.
    pub fn flush(&mut self) -> Result<(), LogError> {
        self.out.flush().map_err(|error| LogError::file(&self.path, error))
    }

    /// Gives the file its name before it is whole, so that it can be read while it grows. From then on it stays.
    pub fn name_early(&mut self) -> Result<(), LogError> {
        self.flush()?;
        match self.part.take() {
            Some(part) => self.name(&part),
            None => Ok(()),
        }
    }

    /// Makes sure of the data, then gives the file its name.
    pub fn finish(mut self) -> Result<(), LogError> {
        self.flush()?;
        if self.place != ExistingFile::Device {
            self.out.get_ref().sync_all().map_err(|error| LogError::file(&self.path, error))?;
        }
        match self.part.take() {
            Some(part) => self.name(&part),
            None => Ok(()),
        }
    }

    fn name(&self, part: &Path) -> Result<(), LogError> {
        let named = match self.place {
            ExistingFile::Replaced => replace(part, &self.path),
            _ => name_if_free(part, &self.path),
        };
        match named {
            Ok(()) => sync_folder(&self.path),
            Err(error) => {
                let _ = fs::remove_file(part);
                match error.kind() {
                    io::ErrorKind::AlreadyExists => Err(LogError::Exists { place: place_of(&self.path) }),
                    _ => Err(LogError::file(&self.path, error)),
                }
            }
        }
    }
}

impl Write for FreshFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.out.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

impl Drop for FreshFile {
    fn drop(&mut self) {
        if let Some(part) = &self.part {
            let _ = fs::remove_file(part);
        }
    }
}

/// A new file in the folder of a path; several programs may write the same path. It is locked while it is written: an unlocked part is one
/// that a killed program left.
fn begin_part(path: &Path, dot: &str) -> io::Result<(PathBuf, File)> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let mut number = 0;
    loop {
        let part = path.with_file_name(format!("{dot}{name}.{}-{number}.part", std::process::id()));
        match open(&part, OpenMode::New) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => number += 1,
            Err(error) => return Err(error),
            Ok(file) if is_locked_at(&file, &part) => return Ok((part, file)),
            // Another program has taken it for one that is left, before it was locked.
            Ok(_) => number += 1,
        }
    }
}

/// Locks a part that was just made, and says whether it is still there. Elsewhere than on Unix, who reads a locked file fails.
fn is_locked_at(file: &File, part: &Path) -> bool {
    !cfg!(unix) || {
        // On a system without locks no part is removed.
        let _ = file.try_lock();
        is_at(file, part)
    }
}

/// Removes the parts of a file that programs which died have left.
pub fn remove_parts(path: &Path) -> Result<(), LogError> {
    let removed = largest_part(path).and_then(|part| part.map_or(Ok(()), fs::remove_file));
    removed.map_err(|error| LogError::file(path, error))
}

/// Removes the parts of a file that killed programs left.
fn remove_stale_parts(path: &Path) {
    // A part that cannot be opened stays.
    for (_, part) in parts(path).into_iter().flatten().filter(|_| cfg!(unix)) {
        if let Ok(file) = open(&part, OpenMode::Left)
            && file.try_lock().is_ok()
            && is_at(&file, &part)
        {
            let _ = fs::remove_file(part);
        }
    }
}

/// The largest of the parts of a file that programs which died have left; the others are removed.
fn largest_part(path: &Path) -> io::Result<Option<PathBuf>> {
    let mut parts = parts(path)?;
    parts.sort();
    let largest = parts.pop();
    parts.iter().try_for_each(|(_, part)| fs::remove_file(part))?;
    Ok(largest.map(|(_, part)| part))
}

/// The parts of a file, each with its size: `log.csv.4711-0.part` of `log.csv`, and no file of another name.
fn parts(path: &Path) -> io::Result<Vec<(u64, PathBuf)>> {
    let begins = format!("{}.", path.file_name().unwrap_or_default().to_string_lossy());
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let is_numbered =
        |rest: &str| rest.split_once('-').is_some_and(|(process, number)| is_number(process) && is_number(number));
    let mut parts = Vec::new();
    for entry in fs::read_dir(folder(path))? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let of_it = [&name[..], name.trim_start_matches('.')].into_iter().find_map(|name| name.strip_prefix(&begins));
        if of_it.and_then(|rest| rest.strip_suffix(".part")).is_some_and(is_numbered) {
            parts.push((entry.metadata()?.len(), entry.path()));
        }
    }
    Ok(parts)
}

/// Renames over a file, and keeps its permissions.
fn replace(part: &Path, path: &Path) -> io::Result<()> {
    if let Ok(old) = fs::symlink_metadata(path)
        && old.is_file()
    {
        fs::set_permissions(part, old.permissions())?;
    }
    fs::rename(part, path)
}

/// Renames, but not over a file that has come in the meantime.
pub(crate) fn name_if_free(part: &Path, path: &Path) -> io::Result<()> {
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

#[cfg(unix)]
#[cfg(test)]
mod tests {
    use super::*;
    use std::os::unix::fs::symlink;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> =
            fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn resumes_through_no_link() {
        let folder = tempfile::tempdir().unwrap();
        let (log, mine) = (folder.path().join("log.csv"), folder.path().join("mine"));
        fs::write(&mine, "").unwrap();
        for link in ["log.csv.77-0.part", "log.csv"] {
            symlink(&mine, folder.path().join(link)).unwrap();
            assert!(matches!(FreshFile::reopen(&log), Err(LogError::NotOwn { .. })), "{link}");
            fs::remove_file(folder.path().join(link)).unwrap();
        }
        assert_eq!(fs::read_to_string(&mine).unwrap(), "");
        // The control: a plain part is taken up, and gets its name.
        fs::write(folder.path().join("log.csv.77-0.part"), "time\nhalf").unwrap();
        let (mut file, mut left) = FreshFile::reopen(&log).unwrap().unwrap();
        let mut text = String::new();
        io::Read::read_to_string(&mut left, &mut text).unwrap();
        assert_eq!(text, "time\nhalf");
        file.cut(5).unwrap();
        file.write(b"1\n").unwrap();
        file.finish().unwrap();
        assert_eq!(
            (fs::read_to_string(&log).unwrap().as_str(), names(folder.path())),
            ("time\n1\n", vec!["log.csv".into(), "mine".into()])
        );
    }

    #[test]
    fn a_file_with_both_its_names_is_one() {
        let folder = tempfile::tempdir().unwrap();
        let (log, part) = (folder.path().join("log.csv"), folder.path().join("log.csv.77-0.part"));
        fs::write(&part, "time\n").unwrap();
        fs::hard_link(&part, &log).unwrap();
        assert!(FreshFile::reopen(&log).unwrap().is_some());
        assert_eq!(names(folder.path()), ["log.csv"]);
    }

    #[test]
    fn parts_of_killed_programs_go_and_those_of_others_stay() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("out");
        for left in ["out.77-0.part", ".out.78-3.part", "out.csv.77-0.part", "out.old.part"] {
            fs::write(folder.path().join(left), "").unwrap();
        }
        let file = FreshFile::create(&out, false).unwrap();
        let own = file.part().unwrap().file_name().unwrap().to_str().unwrap().to_owned();
        let mut there = ["out.csv.77-0.part", "out.old.part", &own];
        there.sort();
        assert_eq!(names(folder.path()), there);
        // Another writer of the same file leaves the part that is being written.
        let other = FreshFile::create(&out, false).unwrap();
        assert!(file.part().unwrap().exists() && other.part() != file.part());
        drop(other);
        file.finish().unwrap();
        assert_eq!(names(folder.path()), ["out", "out.csv.77-0.part", "out.old.part"]);
    }
}
