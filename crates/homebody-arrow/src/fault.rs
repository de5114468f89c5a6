//! Translates errors of the libraries.

use crate::messages::ColumnsMessage;
use arrow_schema::ArrowError;
use homebody_log::LogError;
use homebody_log::error::HoldMessage;
use parquet::errors::ParquetError;
use std::error::Error;
use std::io;
use std::path::Path;

pub(crate) fn unwritten(path: &Path, error: impl Into<Box<dyn Error + Send + Sync>>) -> LogError {
    LogError::file(path, by_system(error.into()))
}

fn by_system(error: Box<dyn Error + Send + Sync>) -> io::Error {
    let kind = {
        let mut cause: Option<&(dyn Error + 'static)> = Some(&*error);
        loop {
            match cause {
                None => break None,
                Some(found) => match found.downcast_ref::<io::Error>() {
                    Some(found) => break Some((found.kind(), found.to_string())),
                    None => cause = inner(found),
                },
            }
        }
    };
    match kind {
        Some((kind, said)) => io::Error::new(kind, said),
        None => io::Error::other(error),
    }
}

/// The inner error; some errors of the libraries do not name theirs as the source.
fn inner<'e>(error: &'e (dyn Error + 'static)) -> Option<&'e (dyn Error + 'static)> {
    if let Some(ArrowError::IoError(_, inner)) = error.downcast_ref::<ArrowError>() {
        return Some(inner);
    }
    if let Some(ParquetError::External(inner)) = error.downcast_ref::<ParquetError>() {
        return Some(&**inner);
    }
    error.source()
}

/// A file that cannot be read as what it says it is.
pub(crate) fn broken(path: &Path, form: &'static str, why: impl ToString) -> LogError {
    let damaged = ColumnsMessage::Damaged { form, reason: why.to_string() };
    LogError::no_log(path.display().to_string(), damaged)
}

/// The error for the URL of an object store in a build without object stores.
#[cfg_attr(feature = "cloud", expect(dead_code, reason = "stores are known"))]
pub(crate) fn no_store(url: &Path) -> LogError {
    LogError::cannot_hold(format!("parquet:{}", url.display()), HoldMessage::NoObjectStore)
}
