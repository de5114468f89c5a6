//! Writes rows: one file for each table, or a data set of files by run and day.

mod data_set;
mod days;
#[cfg(feature = "cloud")]
mod in_store;
mod named;
mod one_file;

use crate::encoded::Format;
use data_set::DataSet;
use homebody_core::scenario::scheme::Scheme;
use homebody_log::{Sink, Url};
use one_file::OneFile;

pub(crate) fn open(url: &Url) -> Box<dyn Sink> {
    match (url.scheme(), url.is_data_set()) {
        (Scheme::Arrow, _) => Box::new(OneFile::new(url.clone(), Format::Arrow)),
        (_, false) => Box::new(OneFile::new(url.clone(), Format::Parquet)),
        #[cfg(feature = "cloud")]
        (_, true) if url.is_in_store() => Box::new(in_store::InStore::new(url.path().into())),
        (_, true) => Box::new(DataSet::new(url.path().into())),
    }
}
