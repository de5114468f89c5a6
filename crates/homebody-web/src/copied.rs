//! Copying a folder that may be anybody's: plain files and folders, and not without end.

use std::fs;
use std::path::Path;

/// Largest number of files that are copied, and of their bytes (our choice).
const MOST_FILES: usize = 2000;
const MOST_BYTES: u64 = 256 << 20;

/// Largest depth of nested folders (our choice).
const DEEPEST: usize = 8;

/// Copies all but hidden things and those that are called so in the outermost folder. `to` is not there yet, and is left half made
/// where something is wrong.
pub fn copy(from: &Path, to: &Path, but: &[&str]) -> Result<(), String> {
    let mut done = Done { files: 0, bytes: 0 };
    done.copy(from, to, but, 0)
}

struct Done {
    files: usize,
    bytes: u64,
}

impl Done {
    fn copy(&mut self, from: &Path, to: &Path, but: &[&str], depth: usize) -> Result<(), String> {
        let failed = |path: &Path, error: std::io::Error| format!("{}: {error}", path.display());
        if depth > DEEPEST {
            return Err(format!("{}: folders are nested more than {DEEPEST} deep", from.display()));
        }
        fs::create_dir(to).map_err(|error| failed(to, error))?;
        for entry in fs::read_dir(from).map_err(|error| failed(from, error))? {
            let entry = entry.map_err(|error| failed(from, error))?;
            let (path, name) = (entry.path(), entry.file_name());
            if name.as_encoded_bytes().starts_with(b".") || but.iter().any(|but| name == *but) {
                continue;
            }
            let found = fs::symlink_metadata(&path).map_err(|error| failed(&path, error))?;
            if found.is_dir() {
                self.copy(&path, &to.join(name), &[], depth + 1)?;
                continue;
            }
            if !found.is_file() {
                let hint = "copy the folder yourself if you want it";
                return Err(format!("{} is a link or a device, which Homebody does not copy: {hint}.", path.display()));
            }
            self.files += 1;
            self.bytes += found.len();
            if self.files > MOST_FILES || self.bytes > MOST_BYTES {
                let megabytes = MOST_BYTES >> 20;
                return Err(format!("{} has more than {MOST_FILES} files or {megabytes} MB.", from.display()));
            }
            fs::copy(&path, to.join(name)).map_err(|error| failed(&path, error))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_files_are_copied_and_links_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let (from, to) = (folder.path().join("from"), folder.path().join("to"));
        for name in ["conditions", "runs/a-1", ".put-aside"] {
            fs::create_dir_all(from.join(name)).unwrap();
            fs::write(from.join(name).join("file"), name).unwrap();
        }
        copy(&from, &to, &["runs"]).unwrap();
        assert_eq!(fs::read_to_string(to.join("conditions/file")).unwrap(), "conditions");
        assert_eq!(fs::read_dir(&to).unwrap().count(), 1);
        assert!(copy(&from, &to, &[]).is_err(), "what is there is not replaced");
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("/etc/hostname", from.join("conditions/link")).unwrap();
            assert!(copy(&from, &folder.path().join("again"), &["runs"]).unwrap_err().contains("is a link"));
        }
        let mut deep = folder.path().join("deep");
        fs::create_dir_all((0..=DEEPEST).fold(deep.clone(), |path, _| path.join("in"))).unwrap();
        deep.push("");
        assert!(copy(&deep, &folder.path().join("deeper"), &[]).is_err());
    }
}
