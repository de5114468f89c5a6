//! Reads files of unknown origin: plain ones only, up to a size for each kind.
//!
//! A pipe or a device keeps a reader waiting for ever, or never ends; a link may lead to a file that its author must not see.

use std::borrow::Cow;
use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::path::{Component, Path, PathBuf};

/// Opens a plain file to be read.
///
/// # Errors
///
/// Those of the system; [`ErrorKind::IsADirectory`] for a folder, [`ErrorKind::InvalidInput`] for what is neither.
pub fn open(path: &Path) -> io::Result<File> {
    // Looked at before: opening a pipe waits for who writes into it.
    let found = fs::metadata(path)?;
    if found.is_dir() {
        return Err(ErrorKind::IsADirectory.into());
    }
    if !found.is_file() {
        return Err(io::Error::new(ErrorKind::InvalidInput, "it is no plain file, but a device or a pipe"));
    }
    File::open(path)
}

/// All of a plain file that has no more than `largest` bytes.
///
/// # Errors
///
/// As [`open`], and [`ErrorKind::FileTooLarge`].
pub fn read(path: &Path, largest: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open(path)?.take(largest.saturating_add(1)).read_to_end(&mut bytes)?;
    match bytes.len() as u64 > largest {
        true => Err(io::Error::new(ErrorKind::FileTooLarge, format!("it is larger than {} MB", largest >> 20))),
        false => Ok(bytes),
    }
}

/// The text of a plain file with at most `largest` bytes, without a byte order mark.
///
/// # Errors
///
/// As [`read`], and [`ErrorKind::InvalidData`] if it is not text.
pub fn read_text(path: &Path, largest: u64) -> io::Result<String> {
    let text = String::from_utf8(read(path, largest)?).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
        io::Error::new(ErrorKind::InvalidData, format!("line {line} is not text in UTF-8"))
    })?;
    Ok(text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text))
}

/// Whether a path is a file, or free: a device and a pipe have no companions.
pub(crate) fn may_have_beside(path: &Path) -> bool {
    fs::metadata(path).map_or(true, |found| found.is_file())
}

/// Whether other users can read a file, such as one with a password in it; false if the system does not say.
pub fn others_may_read(found: &fs::Metadata) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        found.permissions().mode() & 0o077 != 0
    }
    #[cfg(not(unix))]
    {
        let _ = found;
        false
    }
}

/// Bytes as text; invalid UTF-8 is replaced. Valid UTF-8, the usual case, is quick.
pub(crate) fn text(bytes: &[u8]) -> Cow<'_, str> {
    str::from_utf8(bytes).map_or_else(|_| String::from_utf8_lossy(bytes), Cow::Borrowed)
}

/// The target of a path below a folder, which need not exist; `None` if it leads out, by its own parts or along a link. A link that stays
/// inside is followed.
pub fn within(folder: &Path, path: &Path) -> Option<PathBuf> {
    if !path.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir)) {
        return None;
    }
    let whole = folder.join(path);
    let is_there = |place: &&Path| !place.as_os_str().is_empty() && fs::symlink_metadata(place).is_ok();
    // A missing file will be in its folder.
    let there = whole.ancestors().find(is_there).unwrap_or(folder);
    is_inside(folder, there).then_some(whole)
}

/// Whether a path leads to a place in a folder, links followed; false for a missing one.
fn is_inside(folder: &Path, path: &Path) -> bool {
    // The current folder has no name.
    let real = |path: &Path| if path.as_os_str().is_empty() { Path::new(".") } else { path }.canonicalize();
    matches!((real(folder), real(path)), (Ok(folder), Ok(path)) if path.starts_with(&folder))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_up_to_its_limit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        fs::write(&path, "\u{feff}four").unwrap();
        assert_eq!(read_text(&path, 7).unwrap(), "four");
        assert_eq!(read(&path, 6).unwrap_err().kind(), ErrorKind::FileTooLarge);
        assert_eq!(read(folder.path(), 7).unwrap_err().kind(), ErrorKind::IsADirectory);
        fs::write(&path, [0xff]).unwrap();
        assert_eq!(read_text(&path, 7).unwrap_err().kind(), ErrorKind::InvalidData);
    }

    #[cfg(unix)]
    #[test]
    fn devices_are_not_read_and_links_do_not_lead_out() {
        assert_eq!(read(Path::new("/dev/zero"), 7).unwrap_err().kind(), ErrorKind::InvalidInput);
        let folder = tempfile::tempdir().unwrap();
        let (inner, link) = (folder.path().join("inner"), folder.path().join("inner/link"));
        fs::create_dir(&inner).unwrap();
        fs::write(folder.path().join("secret"), "").unwrap();
        fs::write(inner.join("own"), "").unwrap();
        std::os::unix::fs::symlink("../secret", &link).unwrap();
        std::os::unix::fs::symlink("own", inner.join("other")).unwrap();
        std::os::unix::fs::symlink("none", inner.join("dangling")).unwrap();
        std::os::unix::fs::symlink("..", inner.join("up")).unwrap();
        let leads = |path: &str| within(&inner, Path::new(path));
        for inside in ["own", "./own", "other", "none", "new/none", "a b"] {
            assert_eq!(leads(inside), Some(inner.join(inside)));
        }
        for out in ["link", "up/secret", "up/none", "dangling", "../secret", "new/../own", "/etc", "link/none"] {
            assert_eq!(leads(out), None, "{out}");
        }
        assert_eq!(within(folder.path(), Path::new("inner/link")), Some(link));
        assert_eq!(within(Path::new(""), Path::new("none")), Some("none".into()));
    }
}
