//! A place for a log, as a user writes it: `sqlite:log.db`, `csv:log.csv`, `casas:log.txt`.

use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// A place for a log: what it is, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Url {
    /// A database file.
    Sqlite(PathBuf),
    /// Comma-separated values with a header line.
    Csv(PathBuf),
    /// The text the CASAS smart homes write: time, sensor and value, parted by tabs.
    Casas(PathBuf),
}

/// Why a text is no [`Url`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum UrlError {
    #[error("{0:?} does not say what to write\n  hint: put sqlite:, csv: or casas: before the file's name")]
    NoScheme(String),
    #[error("{0:?} is no kind of log that is known\n  hint: the known ones are sqlite:, csv: and casas:")]
    UnknownScheme(String),
    #[error("{0:?} names no file\n  hint: write it as {0}log")]
    NoPath(String),
}

impl Url {
    /// The file.
    pub fn path(&self) -> &Path {
        match self {
            Url::Sqlite(path) | Url::Csv(path) | Url::Casas(path) => path,
        }
    }

    /// The same place, its path taken from `base` if it is relative.
    pub fn within(&self, base: &Path) -> Url {
        self.at(base.join(self.path()))
    }

    /// The same kind of log at another path.
    pub fn at(&self, path: PathBuf) -> Url {
        match self {
            Url::Sqlite(_) => Url::Sqlite(path),
            Url::Csv(_) => Url::Csv(path),
            Url::Casas(_) => Url::Casas(path),
        }
    }
}

impl FromStr for Url {
    type Err = UrlError;

    fn from_str(text: &str) -> Result<Url, UrlError> {
        let (scheme, path) = text.split_once(':').ok_or_else(|| UrlError::NoScheme(text.into()))?;
        let place: fn(PathBuf) -> Url = match scheme {
            "sqlite" => Url::Sqlite,
            "csv" => Url::Csv,
            "casas" => Url::Casas,
            // One letter before a colon is a drive, not a scheme.
            _ if scheme.len() < 2 => return Err(UrlError::NoScheme(text.into())),
            _ => return Err(UrlError::UnknownScheme(format!("{scheme}:"))),
        };
        // `sqlite:///data/log.db` is how many tools write `sqlite:/data/log.db`.
        let path = path.strip_prefix("//").unwrap_or(path);
        if path.is_empty() {
            return Err(UrlError::NoPath(text.into()));
        }
        Ok(place(path.into()))
    }
}

impl fmt::Display for Url {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let scheme = match self {
            Url::Sqlite(_) => "sqlite",
            Url::Csv(_) => "csv",
            Url::Casas(_) => "casas",
        };
        write!(f, "{scheme}:{}", self.path().display())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_url_is_read_and_written() {
        assert_eq!("sqlite:log.db".parse(), Ok(Url::Sqlite("log.db".into())));
        assert_eq!("sqlite:///data/log.db".parse(), Ok(Url::Sqlite("/data/log.db".into())));
        assert_eq!("csv:a:b.csv".parse(), Ok(Url::Csv("a:b.csv".into())));
        assert_eq!("casas:x y.txt".parse::<Url>().unwrap().to_string(), "casas:x y.txt");
    }

    #[test]
    fn a_wrong_url_says_what_is_known() {
        for (text, told) in [
            ("log.db", "put sqlite:, csv: or casas: before"),
            ("C:\\log.db", "put sqlite:"),
            ("mysql:log", "the known ones are sqlite:, csv: and casas:"),
            ("csv:", "write it as csv:log"),
        ] {
            let error = text.parse::<Url>().unwrap_err().to_string();
            assert!(error.contains(told), "{error}");
        }
    }

    #[test]
    fn a_relative_path_is_taken_from_the_base() {
        let base = Path::new("/runs/1");
        assert_eq!(Url::Csv("log.csv".into()).within(base), Url::Csv("/runs/1/log.csv".into()));
        assert_eq!(Url::Csv("/logs/log.csv".into()).within(base), Url::Csv("/logs/log.csv".into()));
    }
}
