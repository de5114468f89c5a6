//! Reading files that may be anybody's: plain ones only, of a size that is named for each kind.
//!
//! A pipe or a device keeps a reader waiting for ever, or never ends; a link may lead to what its author was never to see.

use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::path::Path;

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

/// The text of a plain file that has no more than `largest` bytes. A byte order mark says nothing and is left out.
///
/// # Errors
///
/// As [`read`], and [`ErrorKind::InvalidData`] where it is no text.
pub fn read_text(path: &Path, largest: u64) -> io::Result<String> {
    let text = String::from_utf8(read(path, largest)?)
        .map_err(|_| io::Error::new(ErrorKind::InvalidData, "it is not text in UTF-8"))?;
    Ok(text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text))
}

/// Whether a path leads to a place in a folder, links followed. What is not there is nowhere.
pub fn is_inside(folder: &Path, path: &Path) -> bool {
    // The current folder has no name.
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    matches!((folder.canonicalize(), path.canonicalize()), (Ok(folder), Ok(path)) if path.starts_with(&folder))
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
        assert!(!is_inside(&inner, &link) && is_inside(folder.path(), &link));
        assert!(is_inside(&inner, &inner.join("own")) && !is_inside(&inner, &inner.join("none")));
    }
}
