//! Which sink stands at a place.

use super::Sink;
use super::casas::Casas;
use super::csv::Csv;
use super::sqlite::Sqlite;
use crate::url::Url;
use homebody_core::scenario::scheme::Scheme;

/// The sink of a place. Nothing is touched before it is begun.
pub fn open(url: &Url) -> Box<dyn Sink> {
    let at = url.file().map(Into::into).unwrap_or_default();
    match url.scheme() {
        Scheme::Sqlite => Box::new(Sqlite::new(at)),
        Scheme::Csv => Box::new(Csv::new(at)),
        Scheme::Casas => Box::new(Casas::new(at)),
    }
}
