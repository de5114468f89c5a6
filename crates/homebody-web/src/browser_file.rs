//! A file that leads a browser to the page. The token is not on the browser's command line, which every user of a machine may read.
//!
//! Only its user can read the file, which redirects the browser. Its path need not be secret, because the folder is closed to others,
//! too. A code on the command line that is valid once would not do: a program that watches the list of processes can be faster than a
//! browser that has to start.

use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Removed when this is dropped.
pub struct BrowserFile {
    /// Removed with its contents.
    _folder: TempDir,
    file: PathBuf,
}

impl BrowserFile {
    /// Leads to an address with its token. The file is in the user's runtime folder (`XDG_RUNTIME_DIR`), or among temporary files.
    pub fn to(address: &str) -> io::Result<BrowserFile> {
        let own = std::env::var_os("XDG_RUNTIME_DIR").map(PathBuf::from).filter(|folder| folder.is_absolute());
        let folder = own.and_then(|own| folder_in(&own).ok()).map_or_else(|| folder_in(&std::env::temp_dir()), Ok)?;
        let file = folder.path().join("homebody.html");
        let mut options = OpenOptions::new();
        options.write(true).create_new(true);
        #[cfg(unix)]
        std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
        options.open(&file)?.write_all(text(address).as_bytes())?;
        Ok(BrowserFile { _folder: folder, file })
    }

    pub fn file(&self) -> &Path {
        &self.file
    }
}

/// A new folder that is closed to others.
fn folder_in(place: &Path) -> io::Result<TempDir> {
    let folder = tempfile::Builder::new().prefix("homebody-").tempdir_in(place)?;
    #[cfg(unix)]
    fs::set_permissions(folder.path(), std::os::unix::fs::PermissionsExt::from_mode(0o700))?;
    Ok(folder)
}

/// An address has no signs that HTML escapes.
fn text(address: &str) -> String {
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<meta name=\"referrer\" content=\"no-referrer\">\n\
         <meta http-equiv=\"refresh\" content=\"0; url={address}\">\n<title>Homebody</title>\n\
         <p><a href=\"{address}\">Open the page</a></p>\n</html>\n"
    )
}
