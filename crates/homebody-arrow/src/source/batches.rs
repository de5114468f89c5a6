//! The rows of a file, some at a time: of Parquet page by page, of Arrow IPC one record batch after the other.

use super::guard::guarded;
use super::ipc::IpcRows;
use super::pages;
use crate::fault::broken;
use crate::layout::ABOUT;
use crate::messages::ColumnsMessage;
use arrow_array::RecordBatch;
use arrow_schema::{DataType, Field, Schema, SchemaRef};
use homebody_log::LogError;
use homebody_log::files::plain;
use parquet::arrow::ProjectionMask;
use parquet::arrow::arrow_reader::{
    ArrowReaderMetadata, ArrowReaderOptions, ParquetRecordBatchReader, ParquetRecordBatchReaderBuilder,
};
use std::fs::File;
use std::io::{ErrorKind, Read, Seek};
use std::path::{Path, PathBuf};

pub(super) const PARQUET: &[u8] = b"PAR1";
pub(super) const ARROW: &[u8] = b"ARROW1";

/// Rows that are decoded together.
const ROWS_AT_ONCE: usize = 8192;

/// The same where texts share their beginnings: each of them may be as long as its page.
const ROWS_THAT_SHARE: usize = 64;

pub(crate) struct Batches {
    path: PathBuf,
    rows: BatchReader,
}

enum BatchReader {
    Parquet(Box<ParquetRecordBatchReader>),
    Arrow(Box<IpcRows>),
}

pub(super) struct OpenedTable {
    path: PathBuf,
    pub schema: SchemaRef,
    pub about: Option<String>,
    rows: Unread,
}

enum Unread {
    Parquet(File, ArrowReaderMetadata),
    Arrow(Box<IpcRows>),
}

impl OpenedTable {
    /// Opens a file by how it begins.
    pub fn open(path: &Path) -> Result<OpenedTable, LogError> {
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
            return Ok(OpenedTable {
                path: path.into(),
                schema: rows.schema.clone(),
                about,
                rows: Unread::Arrow(Box::new(rows)),
            });
        }
        if !begins.starts_with(PARQUET) {
            return Err(LogError::no_log(path.display().to_string(), ColumnsMessage::OtherForm));
        }
        let opened = guarded(|| ArrowReaderMetadata::load(&file, ArrowReaderOptions::new()));
        let metadata = opened.map_err(|why| broken(path, "Parquet", why))?;
        let keys = metadata.metadata().file_metadata().key_value_metadata();
        let about = keys.and_then(|all| all.iter().find(|entry| entry.key == ABOUT)?.value.clone());
        let schema = metadata.schema().clone();
        Ok(OpenedTable { path: path.into(), schema, about, rows: Unread::Parquet(file, metadata) })
    }

    /// Its rows, with these columns in the order that they have in the file; all for None.
    pub fn rows(self, columns: Option<&[usize]>) -> Result<Batches, LogError> {
        let OpenedTable { path, rows, .. } = self;
        let rows = match rows {
            Unread::Arrow(mut rows) => {
                rows.project(columns);
                BatchReader::Arrow(rows)
            }
            Unread::Parquet(file, metadata) => {
                let reader = parquet_rows(file, metadata, columns);
                BatchReader::Parquet(Box::new(reader.map_err(|why| broken(&path, "Parquet", why))?))
            }
        };
        Ok(Batches { path, rows })
    }
}

/// Reads these columns of a Parquet file, all for `None`, once the sizes of its pages are known to be sane.
fn parquet_rows(
    file: File,
    metadata: ArrowReaderMetadata,
    columns: Option<&[usize]>,
) -> Result<ParquetRecordBatchReader, String> {
    let shares = guarded(|| pages::check(&file, metadata.metadata(), columns))?;
    let rows_at_once = if shares { ROWS_THAT_SHARE } else { ROWS_AT_ONCE };
    guarded(|| {
        let metadata = match columns {
            Some(_) => {
                let options = ArrowReaderOptions::new().with_schema(with_views(metadata.schema()));
                ArrowReaderMetadata::try_new(metadata.metadata().clone(), options)?
            }
            None => metadata,
        };
        let builder = ParquetRecordBatchReaderBuilder::new_with_metadata(file, metadata);
        let mask = match columns {
            Some(columns) => ProjectionMask::roots(builder.parquet_schema(), columns.iter().copied()),
            None => ProjectionMask::all(),
        };
        builder.with_projection(mask).with_batch_size(rows_at_once).build()
    })
}

/// A schema whose texts refer to their page: a long text that many rows repeat is in memory once.
fn with_views(schema: &Schema) -> SchemaRef {
    let view = |field: &Field| match field.data_type() {
        DataType::Utf8 | DataType::LargeUtf8 => field.clone().with_data_type(DataType::Utf8View),
        _ => field.clone(),
    };
    let fields: Vec<Field> = schema.fields().iter().map(|field| view(field)).collect();
    Schema::new_with_metadata(fields, schema.metadata().clone()).into()
}

/// All rows of a file of Parquet or Arrow IPC, with its columns.
pub fn whole_file(path: &Path) -> Result<(SchemaRef, Vec<RecordBatch>), LogError> {
    let opened = OpenedTable::open(path)?;
    let schema = opened.schema.clone();
    let batches = opened.rows(None)?.collect::<Result<Vec<_>, _>>()?;
    // Only the rows say how texts are packed.
    Ok((batches.first().map_or(schema, RecordBatch::schema), batches))
}

impl Batches {
    pub fn open(path: &Path, columns: Option<&[usize]>) -> Result<Batches, LogError> {
        OpenedTable::open(path)?.rows(columns)
    }
}

impl Iterator for Batches {
    type Item = Result<RecordBatch, LogError>;

    fn next(&mut self) -> Option<Self::Item> {
        let (what, next) = match &mut self.rows {
            BatchReader::Parquet(reader) => ("Parquet", guarded(|| reader.next().transpose()).transpose()),
            BatchReader::Arrow(rows) => ("Arrow IPC", guarded(|| rows.next().transpose()).transpose()),
        };
        next.map(|rows| rows.map_err(|why| broken(&self.path, what, why)))
    }
}
