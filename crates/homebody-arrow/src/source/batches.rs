//! The rows of a file, some at a time: of Parquet page by page, of Arrow IPC one record batch after the other.

use super::guard::guarded;
use super::ipc::IpcRows;
use crate::fault::broken;
use crate::layout::ABOUT;
use arrow_array::RecordBatch;
use arrow_schema::SchemaRef;
use homebody_log::{LogError, plain};
use parquet::arrow::ProjectionMask;
use parquet::arrow::arrow_reader::{ParquetRecordBatchReader, ParquetRecordBatchReaderBuilder};
use std::fs::File;
use std::io::{ErrorKind, Read, Seek};
use std::path::{Path, PathBuf};

/// How files begin.
pub(super) const PARQUET: &[u8] = b"PAR1";
pub(super) const ARROW: &[u8] = b"ARROW1";

/// Rows that are decoded together (ours).
const ROWS_AT_ONCE: usize = 8192;

/// The rows of a file.
pub(crate) struct Batches {
    path: PathBuf,
    rows: Rows,
}

enum Rows {
    Parquet(Box<ParquetRecordBatchReader>),
    Arrow(Box<IpcRows>),
}

/// What there is to know of a file before its rows are read.
pub(super) struct Opened {
    path: PathBuf,
    pub schema: SchemaRef,
    /// What it tells of itself, if it is one of ours.
    pub about: Option<String>,
    rows: Unread,
}

enum Unread {
    Parquet(Box<ParquetRecordBatchReaderBuilder<File>>),
    Arrow(Box<IpcRows>),
}

impl Opened {
    /// Opens a file by how it begins.
    pub fn open(path: &Path) -> Result<Opened, LogError> {
        let mut file = plain::open(path).map_err(|error| match error.kind() {
            ErrorKind::NotFound => LogError::Missing { place: path.display().to_string() },
            _ => LogError::reading(path, error),
        })?;
        let mut begins = Vec::new();
        let read = file.by_ref().take(ARROW.len() as u64).read_to_end(&mut begins).and_then(|_| file.rewind());
        read.map_err(|error| LogError::reading(path, error))?;
        if begins == ARROW {
            let rows = IpcRows::open(file).map_err(|why| broken(path, "Arrow IPC", why))?;
            let about = rows.schema.metadata().get(ABOUT).cloned();
            return Ok(Opened {
                path: path.into(),
                schema: rows.schema.clone(),
                about,
                rows: Unread::Arrow(Box::new(rows)),
            });
        }
        if !begins.starts_with(PARQUET) {
            let why = "it is neither Parquet nor Arrow IPC".to_owned();
            return Err(LogError::NoLog { place: path.display().to_string(), why });
        }
        let opened = guarded(|| ParquetRecordBatchReaderBuilder::try_new(file));
        let rows = opened.map_err(|why| broken(path, "Parquet", why))?;
        let told = rows.metadata().file_metadata().key_value_metadata();
        let about = told.and_then(|all| all.iter().find(|told| told.key == ABOUT)?.value.clone());
        Ok(Opened { path: path.into(), schema: rows.schema().clone(), about, rows: Unread::Parquet(Box::new(rows)) })
    }

    /// Its rows, with these columns in the order that they have in the file; all for None.
    pub fn rows(self, columns: Option<&[usize]>) -> Result<Batches, LogError> {
        let Opened { path, rows, .. } = self;
        let rows = match rows {
            Unread::Arrow(mut rows) => {
                rows.project(columns);
                Rows::Arrow(rows)
            }
            Unread::Parquet(builder) => {
                let mask = match columns {
                    Some(columns) => ProjectionMask::roots(builder.parquet_schema(), columns.iter().copied()),
                    None => ProjectionMask::all(),
                };
                let reader = guarded(|| builder.with_projection(mask).with_batch_size(ROWS_AT_ONCE).build());
                Rows::Parquet(Box::new(reader.map_err(|why| broken(&path, "Parquet", why))?))
            }
        };
        Ok(Batches { path, rows })
    }
}

/// All rows of a file of Parquet or Arrow IPC, with its columns.
///
/// # Errors
///
/// If there is no such file, or it is none of these.
pub fn whole_file(path: &Path) -> Result<(SchemaRef, Vec<RecordBatch>), LogError> {
    let opened = Opened::open(path)?;
    let schema = opened.schema.clone();
    let batches = opened.rows(None)?.collect::<Result<Vec<_>, _>>()?;
    // How texts are packed only the rows say.
    Ok((batches.first().map_or(schema, RecordBatch::schema), batches))
}

impl Batches {
    /// The rows of a file, with these columns.
    pub fn open(path: &Path, columns: Option<&[usize]>) -> Result<Batches, LogError> {
        Opened::open(path)?.rows(columns)
    }
}

impl Iterator for Batches {
    type Item = Result<RecordBatch, LogError>;

    fn next(&mut self) -> Option<Self::Item> {
        let (what, next) = match &mut self.rows {
            Rows::Parquet(reader) => ("Parquet", guarded(|| reader.next().transpose()).transpose()),
            Rows::Arrow(rows) => ("Arrow IPC", guarded(|| rows.next().transpose()).transpose()),
        };
        next.map(|rows| rows.map_err(|why| broken(&self.path, what, why)))
    }
}
