//! A file that keeps the port and the token for the next server. Only its owner may read it.

use crate::guard::TOKEN_BYTES;
use homebody_log::files::plain;
use std::fs;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Largest size of such a file (our choice): it is one address.
const LARGEST_BYTES: u64 = 1000;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KeptAddress {
    pub port: u16,
    pub token: String,
}

homebody_core::messages! {
    /// Problems with the file that keeps the address of the page.
    pub enum AddressFileError in "address-file" {
        /// The file holds the token of the page. A person who can read it can do everything that the page can.
        Open(path: PathBuf) error "readable-by-others" ("{}: other users can read this file, so its token is not secret", path.display())
            hint ("remove the file; the server writes a new one with a new token");
        /// The owner of a file can read it at any time, and so can a person who has another name of it.
        NotOwn {
            /// The file.
            path: PathBuf,
            /// The kind of file, as a part of the sentence.
            what: &'static str,
        } error "not-own" ("{}: this file is {what}, so other users may know its token", path.display())
            hint ("remove the file; the server writes a new one with a new token");
        /// The server replaces the file when it has a new address. It does not replace a file that holds something else.
        NoAddress(path: PathBuf) error "not-an-address" ("{}: this is not an address file of Homebody", path.display())
            hint ("pass a new file to --address-file; the server writes an address with a new token into it");
        /// The file cannot be read or written.
        Io {
            /// The file.
            path: PathBuf,
            /// The message of the system.
            error: io::Error,
        } error "file" ("{}: {error}", path.display())
            cause (Some(error));
    }
}

/// `None` without a file.
pub fn read(path: &Path) -> Result<Option<KeptAddress>, AddressFileError> {
    let io = |error: io::Error| AddressFileError::Io { path: path.to_owned(), error };
    let found = match fs::symlink_metadata(path) {
        Ok(found) => found,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(io(error)),
    };
    if let Some(what) = not_own(&found) {
        return Err(AddressFileError::NotOwn { path: path.to_owned(), what });
    }
    if plain::others_may_read(&found) {
        return Err(AddressFileError::Open(path.to_owned()));
    }
    let text = match plain::read_text(path, LARGEST_BYTES) {
        Ok(text) => text,
        Err(error) if matches!(error.kind(), ErrorKind::InvalidData | ErrorKind::FileTooLarge) => String::new(),
        Err(error) => return Err(io(error)),
    };
    kept_in(&text).map(Some).ok_or_else(|| AddressFileError::NoAddress(path.to_owned()))
}

/// The reason why a file is not this user's own, if there is one: the owner of a file can read it at any time.
fn not_own(found: &fs::Metadata) -> Option<&'static str> {
    if found.is_symlink() {
        return Some("a link");
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        if homebody_log::files::open::owner_of_new_files().is_some_and(|own| own != found.uid()) {
            return Some("owned by another user");
        }
        if found.is_file() && found.nlink() > 1 {
            return Some("hard-linked under a second name");
        }
    }
    None
}

/// Replaces the file by one that only its owner may read.
pub fn write(path: &Path, address: &str) -> Result<(), AddressFileError> {
    let io = |error: io::Error| AddressFileError::Io { path: path.to_owned(), error };
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    // Temporary files belong to their owner only, from the beginning.
    let mut fresh = tempfile::Builder::new().prefix(".address-").tempfile_in(folder).map_err(io)?;
    fresh.write_all(format!("{address}\n").as_bytes()).map_err(io)?;
    fresh.as_file().sync_all().map_err(io)?;
    fresh.persist(path).map_err(|error| io(error.error))?;
    Ok(())
}

/// `http://HOST:PORT/#token=HEX`, with an optional path before the `#`.
fn kept_in(text: &str) -> Option<KeptAddress> {
    let (place, token) = text.trim().strip_prefix("http://")?.split_once("#token=")?;
    let is_token = token.len() == 2 * TOKEN_BYTES && token.bytes().all(|byte| byte.is_ascii_hexdigit());
    let port = place.split('/').next()?.rsplit_once(':')?.1.parse().ok().filter(|&port| port > 0)?;
    is_token.then(|| KeptAddress { port, token: token.to_owned() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs::OpenOptions;

    #[test]
    fn keeps_the_address_for_its_owner_only() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("address");
        assert_eq!(read(&path).unwrap(), None);
        let token = "0f".repeat(TOKEN_BYTES);
        for place in ["127.0.0.1:8642/", "[::1]:8642/library/"] {
            write(&path, &format!("http://{place}#token={token}")).unwrap();
            assert_eq!(read(&path).unwrap(), Some(KeptAddress { port: 8642, token: token.clone() }));
        }
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o600);
            fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
            assert!(matches!(read(&path), Err(AddressFileError::Open(_))));
        }
    }

    #[cfg(unix)]
    #[test]
    fn rejects_address_files_of_other_users() {
        let folder = tempfile::tempdir().unwrap();
        let (path, link, other) =
            (folder.path().join("address"), folder.path().join("link"), folder.path().join("other"));
        write(&path, &format!("http://127.0.0.1:8642/#token={}", "0f".repeat(TOKEN_BYTES))).unwrap();
        assert!(read(&path).unwrap().is_some());
        std::os::unix::fs::symlink(&path, &link).unwrap();
        assert!(matches!(read(&link), Err(AddressFileError::NotOwn { what: "a link", .. })));
        fs::hard_link(&path, &other).unwrap();
        assert!(matches!(read(&path), Err(AddressFileError::NotOwn { what: "hard-linked under a second name", .. })));
        fs::remove_file(&other).unwrap();
        // The test needs the right to give a file away.
        if std::os::unix::fs::chown(&path, Some(12345), None).is_ok() {
            assert!(matches!(read(&path), Err(AddressFileError::NotOwn { what: "owned by another user", .. })));
        }
    }

    #[test]
    fn replaces_no_file_of_another_kind() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("notes");
        let wrong = ["", "my notes", "http://127.0.0.1:8642/#token=short", "http://127.0.0.1:0/#token="];
        for text in wrong.map(str::to_owned).into_iter().chain(["x".repeat(2000)]) {
            let mut options = OpenOptions::new();
            options.write(true).create(true).truncate(true);
            #[cfg(unix)]
            std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
            options.open(&path).unwrap().write_all(text.as_bytes()).unwrap();
            assert!(matches!(read(&path), Err(AddressFileError::NoAddress(_))), "{text}");
        }
        assert!(matches!(read(folder.path()), Err(AddressFileError::Open(_) | AddressFileError::Io { .. })));
    }
}
