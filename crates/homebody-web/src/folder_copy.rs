//! Copies of folders of any origin: plain files and folders only, within limits.

use crate::messages::LibraryMessage;
use std::fs;
use std::path::Path;

/// Largest number of files that are copied, and of their bytes (our choice).
const MOST_FILES: usize = 2000;
const MOST_BYTES: u64 = 256 << 20;

/// Largest depth of nested folders (our choice).
const DEEPEST: usize = 8;

/// Copies everything except hidden entries and the entries `but` of the outermost folder. `to` must not exist; an error leaves it
/// incomplete.
pub fn copy_folder(from: &Path, to: &Path, but: &[&str]) -> Result<(), LibraryMessage> {
    let mut done = CopyTotal { files: 0, bytes: 0 };
    done.copy(from, to, but, 0)
}

struct CopyTotal {
    files: usize,
    bytes: u64,
}

impl CopyTotal {
    fn copy(&mut self, from: &Path, to: &Path, but: &[&str], depth: usize) -> Result<(), LibraryMessage> {
        let name = |path: &Path| path.display().to_string();
        let failed =
            |path: &Path, error: std::io::Error| LibraryMessage::NotCopied { path: name(path), why: error.to_string() };
        if depth > DEEPEST {
            return Err(LibraryMessage::TooDeep { folder: name(from), limit: DEEPEST });
        }
        fs::create_dir(to).map_err(|error| failed(to, error))?;
        for entry in fs::read_dir(from).map_err(|error| failed(from, error))? {
            let entry = entry.map_err(|error| failed(from, error))?;
            let (path, own) = (entry.path(), entry.file_name());
            if own.as_encoded_bytes().starts_with(b".") || but.iter().any(|but| own == *but) {
                continue;
            }
            let found = fs::symlink_metadata(&path).map_err(|error| failed(&path, error))?;
            if found.is_dir() {
                self.copy(&path, &to.join(own), &[], depth + 1)?;
                continue;
            }
            if !found.is_file() {
                return Err(LibraryMessage::NotPlain { path: name(&path) });
            }
            self.files += 1;
            self.bytes += found.len();
            if self.files > MOST_FILES || self.bytes > MOST_BYTES {
                let (files, limit_mb) = (MOST_FILES, MOST_BYTES >> 20);
                return Err(LibraryMessage::TooLarge { folder: name(from), files, limit_mb });
            }
            fs::copy(&path, to.join(own)).map_err(|error| failed(&path, error))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn copies_plain_files_and_rejects_links() {
        let folder = tempfile::tempdir().unwrap();
        let (from, to) = (folder.path().join("from"), folder.path().join("to"));
        for name in ["conditions", "runs/a-1", ".put-aside"] {
            fs::create_dir_all(from.join(name)).unwrap();
            fs::write(from.join(name).join("file"), name).unwrap();
        }
        copy_folder(&from, &to, &["runs"]).unwrap();
        assert_eq!(fs::read_to_string(to.join("conditions/file")).unwrap(), "conditions");
        assert_eq!(fs::read_dir(&to).unwrap().count(), 1);
        assert!(copy_folder(&from, &to, &[]).is_err(), "an existing folder is not replaced");
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("/etc/hostname", from.join("conditions/link")).unwrap();
            let refused = copy_folder(&from, &folder.path().join("again"), &["runs"]);
            assert!(matches!(refused, Err(LibraryMessage::NotPlain { .. })), "{refused:?}");
        }
        let mut deep = folder.path().join("deep");
        fs::create_dir_all((0..=DEEPEST).fold(deep.clone(), |path, _| path.join("in"))).unwrap();
        deep.push("");
        assert!(copy_folder(&deep, &folder.path().join("deeper"), &[]).is_err());
    }
}
