//! Which sink stands at a place.

use super::Sink;
use super::casas::Casas;
use super::csv::Csv;
use super::jsonl::Jsonl;
use super::sqlite::Sqlite;
use super::text::At;
use crate::elsewhere::{self, Absent};
use crate::url::Url;
use homebody_core::scenario::scheme::Scheme;

/// The sink of a place. Nothing is touched before it is begun.
pub fn open(url: &Url) -> Box<dyn Sink> {
    open_as(url, false)
}

/// The same; a text file that `is_followed` has its name from its first line on, so that it can be read while it grows.
pub fn open_as(url: &Url, is_followed: bool) -> Box<dyn Sink> {
    match url.scheme() {
        Scheme::Sqlite => Box::new(Sqlite::new(url.file().map(Into::into).unwrap_or_default())),
        Scheme::Csv => Box::new(Csv::new(At::of(url), is_followed)),
        Scheme::Casas => Box::new(Casas::new(At::of(url), is_followed)),
        Scheme::Jsonl => Box::new(Jsonl::new(At::of(url))),
        scheme => match elsewhere::of(scheme) {
            Some(elsewhere) => (elsewhere.open)(url),
            None => Box::new(Absent(url.clone())),
        },
    }
}
