//! A place for a log, as a user writes it: `sqlite:log.db`, `csv:log.csv`, `jsonl:-`, `postgresql://ann@host/homes`.

use crate::table::Table;
use homebody_core::scenario::scheme::{NoPlace, OUTPUT, Scheme, SchemeRow, Stands, TablePlacement};
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

    /// The kind of place.
    pub fn scheme(&self) -> Scheme {
        self.scheme
    }

    /// The file; None for other places.
    pub fn file(&self) -> Option<&Path> {
        let stands = self.scheme.row().stands;
        (stands != Stands::Server && !self.is_output() && !self.is_data_set()).then_some(&*self.at)
    }

    /// Whether it is a folder of files, in an object store or not: Parquet without the extension `.parquet`.
    pub fn is_data_set(&self) -> bool {
        self.scheme == Scheme::Parquet
            && (self.is_in_store() || self.at.extension().is_none_or(|ending| ending != "parquet"))
    }

    /// Whether the text after the colon is itself a URL: that of an object store.
    pub fn is_in_store(&self) -> bool {
        self.at.to_string_lossy().contains("://")
    }

    /// The text after the colon, as a path.
    pub fn path(&self) -> &Path {
        &self.at
    }

    /// Whether it is standard output.
    pub fn is_output(&self) -> bool {
        self.scheme.row().stands == Stands::Text && self.at == Path::new(OUTPUT)
    }

    /// The whole URL of a server: `postgresql://ann@host/homes`. None for other places.
    pub fn server(&self) -> Option<String> {
        (self.scheme.row().stands == Stands::Server).then(|| self.to_string())
    }

    /// The files of these tables: if there are several, comma-separated values have a file for each, such as `truth.room.csv`. Empty for
    /// places other than files.
    pub fn files(&self, tables: &[Table]) -> Vec<PathBuf> {
        let of_table = |table: &Table| table_file(&self.at, &table.name);
        match self.file() {
            None => Vec::new(),
            Some(_) if tables.len() > 1 && self.scheme.row().tables == TablePlacement::FileEach => {
                tables.iter().map(of_table).collect()
            }
            Some(_) => vec![self.at.clone()],
        }
    }

    /// The same place; a file's path is taken from `base` if it is relative.
    pub fn within(&self, base: &Path) -> Url {
        match self.file().is_some() || self.is_data_set() && !self.is_in_store() {
            true => Url::new(self.scheme, base.join(&self.at)),
            false => self.clone(),
        }
    }

    /// The same kind of place elsewhere.
    pub fn at(&self, at: PathBuf) -> Url {
        Url::new(self.scheme, at)
    }
}

/// The file of one table of several, which have the name of `path` between them.
pub fn table_file(path: &Path, table: &str) -> PathBuf {
    // The packing is the last extension: `truth.csv.gz` has `truth.room.csv.gz`.
    if let Some(packing @ ("gz" | "zst")) = path.extension().and_then(|ending| ending.to_str())
        && let Some(text) = path.file_stem().filter(|stem| Path::new(stem).extension().is_some())
    {
        let mut named = table_file(&path.with_file_name(text), table).into_os_string();
        named.push(format!(".{packing}"));
        return named.into();
    }
    let ending = path.extension().map_or("csv".into(), |ending| ending.to_string_lossy().into_owned());
    path.with_extension(format!("{table}.{ending}"))
}

/// Decodes percent signs in a part of a URL; None if one lacks its two digits.
pub fn percent_decoded(text: &str) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        rest = after;
        if first != b'%' {
            bytes.push(first);
            continue;
        }
        let (digits, after) = after.split_at_checked(2).filter(|(two, _)| two.iter().all(u8::is_ascii_hexdigit))?;
        bytes.push(u8::from_str_radix(str::from_utf8(digits).ok()?, 16).ok()?);
        rest = after;
    }
    Some(bytes)
}

impl FromStr for Url {
    type Err = NoPlace;

    fn from_str(text: &str) -> Result<Url, NoPlace> {
        let (scheme, at) = Scheme::split(text)?;
        // `sqlite:///data/log.db` is how many tools write `sqlite:/data/log.db`; servers always have it.
        Ok(Url::new(scheme, at.strip_prefix("//").unwrap_or(at)))
    }
}

impl fmt::Display for Url {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let SchemeRow { name, stands, .. } = self.scheme.row();
        let slashes = if *stands == Stands::Server { "//" } else { "" };
        write!(f, "{name}:{slashes}{}", self.at.display())
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
    fn servers_and_standard_output_are_no_files() {
        let server: Url = "postgresql://ann@host/homes".parse().unwrap();
        assert_eq!((server.file(), server.is_output()), (None, false));
        assert_eq!(server.server().as_deref(), Some("postgresql://ann@host/homes"));
        assert_eq!(server.within(Path::new("/runs/1")), server);
        let output: Url = "jsonl:-".parse().unwrap();
        assert_eq!((output.file(), output.is_output(), output.server()), (None, true, None));
        assert_eq!(output.to_string(), "jsonl:-");
        let set: Url = "parquet:lives".parse().unwrap();
        assert_eq!((set.file(), set.is_data_set()), (None, true));
        assert_eq!(set.within(Path::new("/runs")).path(), Path::new("/runs/lives"));
        let store: Url = "parquet:s3://bucket/lives".parse().unwrap();
        assert_eq!(store.within(Path::new("/runs")), store);
        assert_eq!("parquet:s3://bucket/a.parquet".parse::<Url>().unwrap().file(), None);
        assert_eq!("parquet:a.parquet".parse::<Url>().unwrap().file(), Some(Path::new("a.parquet")));
    }

    #[test]
    fn tables_have_files_of_their_own() {
        assert_eq!(table_file(Path::new("a/truth.csv"), "room"), Path::new("a/truth.room.csv"));
        assert_eq!(table_file(Path::new("truth"), "room"), Path::new("truth.room.csv"));
        assert_eq!(table_file(Path::new("a/truth.csv.gz"), "room"), Path::new("a/truth.room.csv.gz"));
        assert_eq!(table_file(Path::new("truth.jsonl.zst"), "room"), Path::new("truth.room.jsonl.zst"));
        assert_eq!(table_file(Path::new("truth.gz"), "room"), Path::new("truth.room.gz"));
    }

    #[test]
    fn a_relative_path_is_taken_from_the_base() {
        let base = Path::new("/runs/1");
        assert_eq!(Url::new(Scheme::Csv, "log.csv").within(base), Url::new(Scheme::Csv, "/runs/1/log.csv"));
        assert_eq!(Url::new(Scheme::Csv, "/logs/log.csv").within(base), Url::new(Scheme::Csv, "/logs/log.csv"));
    }
}
