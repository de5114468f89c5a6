//! Opening files to write them: one function for all, which follows no link.
//!
//! A run's folder may come from a stranger. Below it, neither a file nor a folder on the way may be a link: each is opened from the
//! handle of the folder before it. Above the run's folder, and outside of any, links are the user's own and are followed; the file itself
//! is never one.

use crate::error::FileRefusal;
use homebody_core::scenario::inside::{LIST, RECORDING, SENSORS};
use std::fs::{File, Metadata};
use std::io;
use std::path::{Path, PathBuf};

/// The way in which a file is opened for writing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OpenMode {
    /// A new file: nothing may be there.
    New,
    /// A file that need not be there yet; what it holds stays.
    Kept,
    /// A file that a run has left. It has one name only, and belongs to this user or to who owns its folder.
    Left,
}

/// Opens a plain file to read and write it, from its beginning.
///
/// # Errors
///
/// Those of the system; also if it is a link, lies behind a link in a run's folder, or is a folder, pipe or device. A file that is
/// [`Left`](OpenMode::Left) has neither a second name nor another owner.
pub fn open(path: &Path, opening: OpenMode) -> io::Result<File> {
    let (root, inner) = beneath(path)?;
    let file = open_beneath(&root, &inner, opening)?;
    let found = file.metadata()?;
    if !found.is_file() {
        return Err(FileRefusal::NoPlain.into());
    }
    if opening == OpenMode::Left {
        is_of_run(&found, &root)?;
    }
    Ok(file)
}

/// Refuses a companion of a database that is another file of the user or belongs to another user, since SQLite would write into it.
/// The error has its name.
pub(crate) fn are_own(database: &Path) -> Result<(), (PathBuf, io::Error)> {
    for companion in companions(database) {
        match open(&companion, OpenMode::Left) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err((companion, error)),
            _ => {}
        }
    }
    Ok(())
}

/// The files that SQLite keeps next to a database while it is open.
pub(crate) fn companions(database: &Path) -> [PathBuf; 3] {
    ["-wal", "-shm", "-journal"].map(|ending| {
        let mut name = database.as_os_str().to_owned();
        name.push(ending);
        PathBuf::from(name)
    })
}

/// The write-ahead log of a database that another program still reads: it goes when that is done.
pub fn log_beside(database: &Path) -> Option<PathBuf> {
    let [log, ..] = companions(database);
    Some(log).filter(|path| path.exists())
}

/// The folder below which no link is followed, and the path from there: the folder of the run or cohort, else the file's own.
fn beneath(path: &Path) -> io::Result<(PathBuf, PathBuf)> {
    let name = path.file_name().ok_or(io::ErrorKind::InvalidInput)?;
    let here = |folder: &Path| if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder.to_owned() };
    let of_run = path.ancestors().skip(1).find(|folder| is_of_run_or_cohort(folder));
    let folder = match of_run {
        Some(folder) => folder,
        None => path.parent().unwrap_or(Path::new("")),
    };
    let inner = path.strip_prefix(folder).map_or_else(|_| name.into(), Path::to_owned);
    Ok((here(folder), inner))
}

/// Whether a folder, which need not exist, lies behind a link in the folder of a run or cohort.
pub(crate) fn leads_out(folder: &Path) -> bool {
    let mut above = folder.ancestors();
    let Some(root) = above.find(|folder| is_of_run_or_cohort(folder)) else { return false };
    folder.ancestors().take_while(|folder| *folder != root).any(Path::is_symlink)
}

/// Whether a folder is that of a run or of a cohort, by its content. A recording alone may lie in any folder.
fn is_of_run_or_cohort(folder: &Path) -> bool {
    let has = |name: &str| folder.join(name).is_file();
    has(RECORDING) && has(SENSORS) || has(LIST)
}

#[cfg(unix)]
fn open_beneath(root: &Path, inner: &Path, opening: OpenMode) -> io::Result<File> {
    use rustix::fs::{CWD, Mode, OFlags, openat};
    use std::os::fd::OwnedFd;
    use std::path::Component;
    // Opening a pipe does not wait for who reads it.
    let always = OFlags::CLOEXEC | OFlags::NOCTTY | OFlags::NONBLOCK;
    // Linux opens a folder that this user may enter and not read.
    #[cfg(any(target_os = "linux", target_os = "android"))]
    const ENTER: OFlags = OFlags::PATH.union(OFlags::DIRECTORY);
    #[cfg(not(any(target_os = "linux", target_os = "android")))]
    const ENTER: OFlags = OFlags::RDONLY.union(OFlags::DIRECTORY);
    let mut folder: OwnedFd = openat(CWD, root, ENTER | OFlags::CLOEXEC, Mode::empty())?;
    let mut parts = Vec::new();
    for part in inner.components() {
        match part {
            Component::Normal(part) => parts.push(part),
            Component::CurDir => {}
            _ => return Err(FileRefusal::Link.into()),
        }
    }
    let (name, folders) = parts.split_last().ok_or(io::ErrorKind::InvalidInput)?;
    for &part in folders {
        let flags = ENTER | OFlags::CLOEXEC | OFlags::NOFOLLOW;
        folder = openat(&folder, part, flags, Mode::empty()).map_err(|error| refused(&folder, part, error))?;
    }
    let flags = match opening {
        OpenMode::New => OFlags::CREATE | OFlags::EXCL,
        OpenMode::Kept => OFlags::CREATE,
        OpenMode::Left => OFlags::empty(),
    };
    let flags = always | OFlags::RDWR | OFlags::NOFOLLOW | flags;
    let opened = openat(&folder, *name, flags, Mode::from_raw_mode(0o666));
    opened.map(File::from).map_err(|error| refused(&folder, name, error))
}

/// The meaning of an error: each system has its own for a link that is not followed.
#[cfg(unix)]
fn refused(folder: &impl std::os::fd::AsFd, name: &std::ffi::OsStr, error: rustix::io::Errno) -> io::Error {
    use rustix::fs::{AtFlags, FileType, statat};
    use rustix::io::Errno;
    if matches!(error, Errno::EXIST | Errno::NOENT | Errno::ACCESS) {
        return error.into();
    }
    match statat(folder, name, AtFlags::SYMLINK_NOFOLLOW).map(|found| FileType::from_raw_mode(found.st_mode)) {
        Ok(FileType::Symlink) => FileRefusal::Link.into(),
        Ok(FileType::Fifo | FileType::Socket) => FileRefusal::NoPlain.into(),
        _ => error.into(),
    }
}

/// Elsewhere each part of the path is looked at before the file is opened.
#[cfg(not(unix))]
fn open_beneath(root: &Path, inner: &Path, opening: OpenMode) -> io::Result<File> {
    use std::fs::{OpenOptions, symlink_metadata};
    let mut place = root.to_owned();
    for part in inner.components() {
        place.push(part);
        if symlink_metadata(&place).is_ok_and(|found| found.is_symlink()) {
            return Err(FileRefusal::Link.into());
        }
    }
    let mut options = OpenOptions::new();
    options.read(true).write(true).create(opening == OpenMode::Kept).create_new(opening == OpenMode::New);
    options.open(place)
}

/// Makes sure that a file is one that a run has left, and no other file under a second name.
#[cfg(unix)]
fn is_of_run(found: &Metadata, root: &Path) -> io::Result<()> {
    use std::os::unix::fs::MetadataExt;
    if found.nlink() > 1 {
        return Err(FileRefusal::TwoNames.into());
    }
    let is_known = [owner_of_new_files(), std::fs::metadata(root).ok().map(|folder| folder.uid())];
    match is_known.contains(&Some(found.uid())) || is_known[0].is_none() {
        true => Ok(()),
        false => Err(FileRefusal::Foreign.into()),
    }
}

#[cfg(not(unix))]
fn is_of_run(_found: &Metadata, _root: &Path) -> io::Result<()> {
    Ok(())
}

/// The owner of new files of this program; None if the system does not report it.
#[cfg(unix)]
pub fn owner_of_new_files() -> Option<u32> {
    use std::os::unix::fs::MetadataExt;
    // The system describes a process in a folder that the process owns.
    std::fs::metadata("/proc/self").ok().map(|own| own.uid())
}

#[cfg(unix)]
#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;
    use std::io::Write;
    use std::os::unix::fs::symlink;

    /// A run's folder `run`, and an empty file `mine` outside, which no run may write.
    fn run() -> (tempfile::TempDir, PathBuf) {
        let folder = tempfile::tempdir().unwrap();
        let run = folder.path().join("run");
        fs::create_dir_all(run.join("logs")).unwrap();
        for name in [RECORDING, SENSORS] {
            fs::write(run.join(name), "").unwrap();
        }
        fs::write(folder.path().join("mine"), "").unwrap();
        fs::create_dir(folder.path().join("elsewhere")).unwrap();
        (folder, run)
    }

    fn refusal(path: &Path, opening: OpenMode) -> Option<FileRefusal> {
        open(path, opening).map_or_else(|error| FileRefusal::from_error(&error), |_| None)
    }

    #[test]
    fn follows_no_link_to_a_file() {
        let (folder, run) = run();
        for (link, to) in [("there", "../mine"), ("absent", "../absent"), ("logs/inner", "../../mine")] {
            symlink(to, run.join(link)).unwrap();
            for opening in [OpenMode::Kept, OpenMode::Left] {
                assert_eq!(refusal(&run.join(link), opening), Some(FileRefusal::Link), "{link} {opening:?}");
            }
            assert_eq!(open(&run.join(link), OpenMode::New).unwrap_err().kind(), io::ErrorKind::AlreadyExists);
        }
        assert!(!folder.path().join("absent").exists(), "a dangling link creates nothing");
        // The control: the system's own way follows it, and makes the file outside.
        fs::OpenOptions::new().write(true).create(true).truncate(false).open(run.join("absent")).unwrap();
        assert!(folder.path().join("absent").exists());
    }

    #[test]
    fn follows_no_link_to_a_folder_of_a_run() {
        let (folder, run) = run();
        symlink("../elsewhere", run.join("out")).unwrap();
        symlink("logs", run.join("in")).unwrap();
        for inner in ["out/log.csv", "in/log.csv"] {
            for opening in [OpenMode::New, OpenMode::Kept, OpenMode::Left] {
                assert_eq!(refusal(&run.join(inner), opening), Some(FileRefusal::Link), "{inner} {opening:?}");
            }
        }
        assert!(fs::read_dir(folder.path().join("elsewhere")).unwrap().next().is_none());
        // The user may reach a run's folder, or any other folder, through a link.
        symlink(&run, folder.path().join("way")).unwrap();
        symlink("elsewhere", folder.path().join("own")).unwrap();
        for open_as in ["way/logs/log.csv", "own/log.csv"] {
            assert!(open(&folder.path().join(open_as), OpenMode::New).is_ok(), "{open_as}");
        }
    }

    #[test]
    fn a_folder_behind_a_link_of_a_run_leads_out() {
        let (folder, run) = run();
        symlink("../elsewhere", run.join("out")).unwrap();
        symlink("elsewhere", folder.path().join("own")).unwrap();
        assert!(leads_out(&run.join("out/member=0001")) && leads_out(&run.join("out")));
        assert!(!leads_out(&run.join("logs/member=0001")) && !leads_out(&folder.path().join("own/new")));
    }

    #[test]
    fn opens_neither_pipes_nor_folders_and_does_not_wait() {
        let (_folder, run) = run();
        let pipe = run.join("pipe");
        let (kind, mode) = (rustix::fs::FileType::Fifo, rustix::fs::Mode::from_raw_mode(0o600));
        rustix::fs::mknodat(rustix::fs::CWD, &pipe, kind, mode, 0).unwrap();
        assert_eq!(refusal(&pipe, OpenMode::Kept), Some(FileRefusal::NoPlain));
        assert!(open(&run.join("logs"), OpenMode::Left).is_err());
    }

    #[test]
    fn takes_files_of_a_run_with_one_name_only() {
        let (folder, run) = run();
        let part = run.join("log.csv.77-0.part");
        fs::hard_link(folder.path().join("mine"), &part).unwrap();
        assert_eq!(refusal(&part, OpenMode::Left), Some(FileRefusal::TwoNames));
        fs::remove_file(folder.path().join("mine")).unwrap();
        open(&part, OpenMode::Left).unwrap().write_all(b"rows").unwrap();
        assert_eq!(fs::read_to_string(part).unwrap(), "rows");
    }
}
