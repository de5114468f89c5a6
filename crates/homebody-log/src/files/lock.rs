//! One program at a time writes into the folder of a run, and one into a file.

use super::open::{OpenMode, open};
use super::plain;
use crate::error::{FileRefusal, LogError, place_of};
use std::fs::{self, File, TryLockError};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

/// Keeps other writers out of a folder. It ends with the program, for any reason.
#[derive(Debug)]
pub struct FolderLock {
    _held: Option<File>,
}

impl FolderLock {
    /// Takes the folder.
    ///
    /// # Errors
    ///
    /// [`LogError::Busy`] if another program, or another run of this one, has it.
    pub fn take(folder: &Path) -> Result<FolderLock, LogError> {
        // Some systems cannot lock folders.
        let Ok(file) = File::open(folder) else { return Ok(FolderLock { _held: None }) };
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => Err(LogError::Busy { place: place_of(folder) }),
            Err(TryLockError::Error(_)) => Ok(FolderLock { _held: None }),
            Ok(()) => Ok(FolderLock { _held: Some(file) }),
        }
    }
}

/// Keeps other writers away from a file, by a lock file in the same folder, which is removed with it. The lock file of a killed program
/// blocks no one.
#[derive(Debug)]
pub struct FileLock {
    /// The lock file and its handle, which is closed after the file is removed; `None` where nothing is held.
    held: Option<(PathBuf, File)>,
}

impl FileLock {
    /// Locks a file before it is written, whether it exists or not. Devices, pipes and systems without locks need no lock.
    ///
    /// # Errors
    ///
    /// [`LogError::Busy`] if another program, or another run of this one, writes it; [`LogError::Denied`] if its folder is read-only,
    /// since each file needs a second one while it is written; [`LogError::NotOwn`] if the lock file is a link.
    pub fn take(path: &Path) -> Result<FileLock, LogError> {
        let nothing = Ok(FileLock { held: None });
        if fs::metadata(path).is_ok_and(|found| !found.is_file()) {
            return nothing;
        }
        let beside = lock_of(path);
        loop {
            let file = match open(&beside, OpenMode::Kept) {
                Ok(file) => file,
                Err(error) if FileRefusal::from_error(&error).is_some() => return Err(LogError::file(&beside, error)),
                Err(error) if matches!(error.kind(), ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem) => {
                    return Err(LogError::file(path, error));
                }
                Err(_) => return nothing,
            };
            match file.try_lock() {
                Err(TryLockError::WouldBlock) => return Err(LogError::Busy { place: place_of(path) }),
                Err(TryLockError::Error(_)) => {
                    let _ = fs::remove_file(&beside);
                    return nothing;
                }
                Ok(()) if is_at(&file, &beside) => return Ok(FileLock { held: Some((beside, file)) }),
                // The earlier holder has removed it since it was opened.
                Ok(()) => {}
            }
        }
    }
}

/// The time and the interval of attempts to lock a small file that another program writes.
const WAIT: Duration = Duration::from_secs(10);
const ASK: Duration = Duration::from_millis(2);

impl FileLock {
    /// Takes a file, and waits while another program has it: a server that reads a small file, compares it and writes it anew.
    ///
    /// # Errors
    ///
    /// As [`FileLock::take`]; [`LogError::Busy`] only after ten seconds.
    pub fn wait(path: &Path) -> Result<FileLock, LogError> {
        let begun = Instant::now();
        loop {
            match FileLock::take(path) {
                Err(LogError::Busy { .. }) if begun.elapsed() < WAIT => thread::sleep(ASK),
                taken => return taken,
            }
        }
    }
}

impl Drop for FileLock {
    fn drop(&mut self) {
        if let Some((beside, _file)) = self.held.take() {
            let _ = fs::remove_file(beside);
        }
    }
}

/// Whether another program writes a file: `None` without a lock file, and false if a killed program has left that. Nothing is changed.
pub fn is_held(path: &Path) -> Option<bool> {
    let file = plain::open(&lock_of(path)).ok()?;
    Some(matches!(file.try_lock_shared(), Err(TryLockError::WouldBlock)))
}

fn lock_of(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".lock");
    path.with_file_name(name)
}

#[cfg(unix)]
pub(crate) fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let which = |found: fs::Metadata| (found.dev(), found.ino());
    file.metadata().ok().map(which) == fs::metadata(path).ok().map(which)
}

/// Elsewhere a file that is removed while it is open cannot be opened again.
#[cfg(not(unix))]
pub(crate) fn is_at(_file: &File, _path: &Path) -> bool {
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    #[test]
    #[cfg(unix)]
    fn one_at_a_time_has_a_file() {
        let folder = std::env::temp_dir().join(format!("homebody-file-lock-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join("log.db");
        // The lock file of a killed program.
        fs::write(folder.join("log.db.lock"), "").unwrap();
        let lock = FileLock::take(&path).unwrap();
        assert!(matches!(FileLock::take(&path), Err(LogError::Busy { .. })));
        assert!(matches!(
            FileLock::take(&folder.join("../").join(folder.file_name().unwrap()).join("log.db")),
            Err(LogError::Busy { .. })
        ));
        assert!(FileLock::take(&folder.join("other.db")).is_ok());
        drop(lock);
        assert!(fs::read_dir(&folder).unwrap().next().is_none(), "no lock stays");
        // Many threads take it at once, and no two of them have it together.
        let inside = AtomicUsize::new(0);
        thread::scope(|scope| {
            for _ in 0..8 {
                scope.spawn(|| {
                    for _ in 0..500 {
                        let Ok(_lock) = FileLock::take(&path) else { continue };
                        assert_eq!(inside.fetch_add(1, Ordering::SeqCst), 0);
                        thread::yield_now();
                        inside.fetch_sub(1, Ordering::SeqCst);
                    }
                });
            }
        });
        fs::remove_dir(&folder).unwrap();
    }

    #[test]
    #[cfg(unix)]
    fn waits_for_the_holder_of_a_small_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("count");
        fs::write(&path, "0").unwrap();
        let count = |lock: fn(&Path) -> Option<FileLock>| {
            let _lock = lock(&path);
            let seen: u32 = fs::read_to_string(&path).unwrap().parse().unwrap();
            thread::yield_now();
            let part = folder.path().join(format!("{:?}", thread::current().id()));
            fs::write(&part, (seen + 1).to_string()).unwrap();
            fs::rename(part, &path).unwrap();
        };
        let all = |lock: fn(&Path) -> Option<FileLock>| {
            fs::write(&path, "0").unwrap();
            thread::scope(|scope| {
                for _ in 0..4 {
                    scope.spawn(|| (0..100).for_each(|_| count(lock)));
                }
            });
            fs::read_to_string(&path).unwrap()
        };
        assert_eq!(all(|path| Some(FileLock::wait(path).unwrap())), "400");
        // The control: without the lock some are lost.
        assert_ne!(all(|_| None), "400");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "no lock stays");
    }

    #[test]
    #[cfg(unix)]
    fn a_dangling_lock_creates_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let (path, outside) = (folder.path().join("log.db"), folder.path().join("outside"));
        std::os::unix::fs::symlink(&outside, folder.path().join("log.db.lock")).unwrap();
        assert!(matches!(FileLock::take(&path), Err(LogError::NotOwn { .. })));
        assert!(!outside.exists());
    }

    #[test]
    #[cfg(unix)]
    fn one_at_a_time_has_a_folder() {
        let folder = std::env::temp_dir().join(format!("homebody-lock-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let lock = FolderLock::take(&folder).unwrap();
        assert!(matches!(FolderLock::take(&folder), Err(LogError::Busy { .. })));
        drop(lock);
        assert!(FolderLock::take(&folder).is_ok());
        std::fs::remove_dir(&folder).unwrap();
    }
}
