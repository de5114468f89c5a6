//! A place for a log, as a user writes it: `sqlite:log.db`, `csv:log.csv`, `casas:log.txt`.

use crate::table::Table;
use homebody_core::scenario::scheme::{NoPlace, Scheme};
use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// A place for a log: of what kind, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Url {
    scheme: Scheme,
    at: PathBuf,
}

impl Url {
    /// A place of this kind.
    pub fn new(scheme: Scheme, at: impl Into<PathBuf>) -> Url {
        Url { scheme, at: at.into() }
    }

    /// What kind of place it is.
    pub fn scheme(&self) -> Scheme {
        self.scheme
    }

    /// The file; None for places that are no files.
    pub fn file(&self) -> Option<&Path> {
        match self.scheme {
            Scheme::Sqlite | Scheme::Csv | Scheme::Casas => Some(&self.at),
        }
    }

    /// The files of what is made of these tables: of several, comma-separated values have one for each, such as
    /// `truth.room.csv`. None for places that are no files.
    pub fn files(&self, tables: &[Table]) -> Vec<PathBuf> {
        let of_table = |table: &Table| table_file(&self.at, &table.name);
        match self.scheme {
            Scheme::Csv if tables.len() > 1 => tables.iter().map(of_table).collect(),
            Scheme::Sqlite | Scheme::Csv | Scheme::Casas => vec![self.at.clone()],
        }
    }

    /// The same place; a file's path is taken from `base` if it is relative.
    pub fn within(&self, base: &Path) -> Url {
        match self.file() {
            Some(file) => Url::new(self.scheme, base.join(file)),
            None => self.clone(),
        }
    }

    /// The same kind of place elsewhere.
    pub fn at(&self, at: PathBuf) -> Url {
        Url::new(self.scheme, at)
    }
}

/// The file of one table of several, which have the name of `path` between them.
pub(crate) fn table_file(path: &Path, table: &str) -> PathBuf {
    let ending = path.extension().map_or("csv".into(), |ending| ending.to_string_lossy().into_owned());
    path.with_extension(format!("{table}.{ending}"))
}

impl FromStr for Url {
    type Err = NoPlace;

    fn from_str(text: &str) -> Result<Url, NoPlace> {
        let (scheme, at) = Scheme::split(text)?;
        // `sqlite:///data/log.db` is how many tools write `sqlite:/data/log.db`.
        Ok(Url::new(scheme, at.strip_prefix("//").unwrap_or(at)))
    }
}

impl fmt::Display for Url {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}:{}", self.scheme.row().name, self.at.display())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_url_is_read_and_written() {
        assert_eq!("sqlite:log.db".parse(), Ok(Url::new(Scheme::Sqlite, "log.db")));
        assert_eq!("sqlite:///data/log.db".parse(), Ok(Url::new(Scheme::Sqlite, "/data/log.db")));
        assert_eq!("csv:a:b.csv".parse(), Ok(Url::new(Scheme::Csv, "a:b.csv")));
        assert_eq!("casas:x y.txt".parse::<Url>().unwrap().to_string(), "casas:x y.txt");
    }

    #[test]
    fn tables_have_files_of_their_own() {
        assert_eq!(table_file(Path::new("a/truth.csv"), "room"), Path::new("a/truth.room.csv"));
        assert_eq!(table_file(Path::new("truth"), "room"), Path::new("truth.room.csv"));
    }

    #[test]
    fn a_relative_path_is_taken_from_the_base() {
        let base = Path::new("/runs/1");
        assert_eq!(Url::new(Scheme::Csv, "log.csv").within(base), Url::new(Scheme::Csv, "/runs/1/log.csv"));
        assert_eq!(Url::new(Scheme::Csv, "/logs/log.csv").within(base), Url::new(Scheme::Csv, "/logs/log.csv"));
    }
}
