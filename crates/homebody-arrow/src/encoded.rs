//! Writes a file of one table: rows come in, bytes go out.
//!
//! Full groups of rows are written at once, so that memory stays bounded. In Arrow IPC, record batches hold numbers instead of texts, and
//! the dictionaries follow all batches, once all texts are known. The format allows this, since the footer has their positions.

use crate::columns::Columns;
use crate::fault::unwritten;
use crate::layout::{self, ABOUT, ROWS_BEFORE};
use arrow_array::RecordBatch;
use arrow_ipc::convert::IpcSchemaEncoder;
use arrow_ipc::writer::{
    DictionaryTracker, EncodedData, IpcDataGenerator, IpcWriteContext, IpcWriteOptions, write_message,
};
use arrow_ipc::{Block, CompressionType, FooterBuilder, MetadataVersion};
use arrow_schema::{ArrowError, DataType, Field, Schema, SchemaRef};
use flatbuffers::FlatBufferBuilder;
use homebody_log::files::fresh::FreshFile;
use homebody_log::table::InstantWriter;
use homebody_log::table::{Cell, Table};
use homebody_log::{Begin, LogError};
use parquet::arrow::ArrowWriter;
use parquet::basic::{Compression, Encoding, ZstdLevel};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::schema::types::ColumnPath;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    Parquet,
    Arrow,
}

/// Rows of a row group in Parquet, which are read and held in memory together (our choice).
const ROWS_OF_GROUP: usize = 1 << 17;

/// Rows that are encoded together, whatever the batches, so that the same rows give the same bytes (our choice).
const ROWS_AT_ONCE: [usize; 2] = [1 << 13, 1 << 16];

pub(crate) struct FileLayout {
    format: Format,
    schema: SchemaRef,
    about: serde_json::Map<String, serde_json::Value>,
    run: Option<i64>,
}

impl FileLayout {
    /// Of a table; `has_run` says whether the run's id is a column.
    pub fn new(format: Format, table: &Table, begin: &Begin, has_run: bool) -> FileLayout {
        FileLayout {
            format,
            schema: Arc::new(layout::schema(table, begin, has_run)),
            about: layout::about(table, begin),
            run: has_run.then_some(begin.run.id),
        }
    }

    fn about(&self, rows_before: u64) -> String {
        let mut about = self.about.clone();
        about.insert(ROWS_BEFORE.into(), rows_before.into());
        serde_json::Value::Object(about).to_string()
    }
}

pub(crate) struct TableFile {
    path: PathBuf,
    columns: Columns,
    at_once: usize,
    to: TableWriter,
    pub rows: u64,
}

enum TableWriter {
    Parquet(Box<ArrowWriter<FreshFile>>),
    Arrow(Box<IpcFile>),
}

impl TableFile {
    pub fn begin(file: FreshFile, layout: &FileLayout, rows_before: u64) -> Result<TableFile, LogError> {
        let path = file.path().to_owned();
        let about = layout.about(rows_before);
        let to = match layout.format {
            Format::Parquet => {
                let properties = properties(&layout.schema, about);
                let begun = ArrowWriter::try_new(file, layout.schema.clone(), Some(properties));
                TableWriter::Parquet(Box::new(begun.map_err(|error| unwritten(&path, error))?))
            }
            Format::Arrow => {
                let begun = IpcFile::begin(file, &layout.schema, about);
                TableWriter::Arrow(Box::new(begun.map_err(|error| unwritten(&path, error))?))
            }
        };
        let columns = Columns::new(layout.schema.clone(), layout.run, layout.format == Format::Arrow);
        Ok(TableFile { path, columns, at_once: ROWS_AT_ONCE[layout.format as usize], to, rows: 0 })
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Adds a row; `texts` are those of the run.
    pub fn push(&mut self, cells: &[Cell], clock: &mut InstantWriter, texts: &[Arc<str>]) -> Result<(), LogError> {
        self.columns.push(cells, clock, texts);
        self.rows += 1;
        match self.columns.rows() == self.at_once {
            true => self.encode(),
            false => Ok(()),
        }
    }

    fn encode(&mut self) -> Result<(), LogError> {
        let TableFile { path, columns, to, .. } = self;
        match to {
            TableWriter::Parquet(writer) => {
                let rows = columns.take().map_err(|error| unwritten(path, error))?;
                writer.write(&rows).map_err(|error| unwritten(path, error))
            }
            TableWriter::Arrow(file) => {
                let rows = columns.take_numbers(file.numbers.clone());
                rows.and_then(|rows| file.write(&rows)).map_err(|error| unwritten(path, error))
            }
        }
    }

    /// The whole file, which has no name yet.
    pub fn end(mut self) -> Result<FreshFile, LogError> {
        if self.columns.rows() > 0 {
            self.encode()?;
        }
        let TableFile { path, columns, to, .. } = self;
        let mut file = match to {
            TableWriter::Parquet(writer) => {
                writer.into_inner().map_err(|error: ParquetError| unwritten(&path, error))?
            }
            TableWriter::Arrow(file) => {
                columns.texts().and_then(|texts| file.end(&texts)).map_err(|error| unwritten(&path, error))?
            }
        };
        file.flush()?;
        Ok(file)
    }
}

/// The encodings of Parquet: rising numbers as their differences, all else as dictionaries.
fn properties(schema: &Schema, about: String) -> WriterProperties {
    let mut properties = WriterProperties::builder()
        .set_compression(Compression::ZSTD(ZstdLevel::default()))
        .set_max_row_group_row_count(Some(ROWS_OF_GROUP))
        .set_key_value_metadata(Some(vec![KeyValue::new(ABOUT.to_owned(), about)]));
    for field in schema.fields() {
        let path = ColumnPath::from(field.name().as_str());
        let rises = matches!(field.data_type(), DataType::Timestamp(..)) || !field.is_nullable();
        if rises {
            properties = properties
                .set_column_dictionary_enabled(path.clone(), false)
                .set_column_encoding(path, Encoding::DELTA_BINARY_PACKED);
        }
    }
    properties.build()
}

struct IpcFile {
    file: FreshFile,
    schema: Schema,
    /// The same with numbers in place of texts: how record batches have them.
    numbers: SchemaRef,
    options: IpcWriteOptions,
    context: IpcWriteContext,
    dictionaries: DictionaryTracker,
    batches: Vec<Block>,
    bytes: usize,
}

/// The first and last bytes of a file, padded up to the first message.
const MAGIC: &[u8; 6] = b"ARROW1";
const BEGINS_BYTES: usize = 64;

/// The end of the messages.
const NO_MORE: [u8; 8] = [0xff, 0xff, 0xff, 0xff, 0, 0, 0, 0];

impl IpcFile {
    fn begin(mut file: FreshFile, schema: &Schema, about: String) -> Result<IpcFile, ArrowError> {
        let schema = schema.clone().with_metadata([(ABOUT.to_owned(), about)].into());
        let numbered = |field: &Arc<Field>| match field.data_type() {
            DataType::Dictionary(..) => Arc::new(Field::new(field.name(), DataType::Int32, true)),
            _ => field.clone(),
        };
        let numbers = Schema::new(schema.fields().iter().map(numbered).collect::<Vec<_>>());
        let options = IpcWriteOptions::default().try_with_compression(Some(CompressionType::ZSTD))?;
        let mut dictionaries = DictionaryTracker::new(true);
        let told =
            IpcDataGenerator::default().schema_to_bytes_with_dictionary_tracker(&schema, &mut dictionaries, &options);
        let mut begins = [0; BEGINS_BYTES];
        begins[..MAGIC.len()].copy_from_slice(MAGIC);
        Write::write_all(&mut file, &begins)?;
        let (message, body) = write_message(&mut file, told, &options)?;
        let context = IpcWriteContext::default();
        let (numbers, batches, bytes) = (Arc::new(numbers), Vec::new(), BEGINS_BYTES + message + body);
        Ok(IpcFile { file, schema, numbers, options, context, dictionaries, batches, bytes })
    }

    fn write(&mut self, rows: &RecordBatch) -> Result<(), ArrowError> {
        // The message has no dictionaries.
        let mut none = DictionaryTracker::new(true);
        let (_, rows) = IpcDataGenerator::default().encode(rows, &mut none, &self.options, &mut self.context)?;
        let block = self.message(rows)?;
        self.batches.push(block);
        Ok(())
    }

    fn message(&mut self, message: EncodedData) -> Result<Block, ArrowError> {
        let (header, body) = write_message(&mut self.file, message, &self.options)?;
        let block = Block::new(self.bytes as i64, header as i32, body as i64);
        self.bytes += header + body;
        Ok(block)
    }

    fn end(mut self: Box<IpcFile>, texts: &RecordBatch) -> Result<FreshFile, ArrowError> {
        let (messages, _) =
            IpcDataGenerator::default().encode(texts, &mut self.dictionaries, &self.options, &mut self.context)?;
        let mut dictionaries = Vec::new();
        for message in messages {
            dictionaries.push(self.message(message)?);
        }
        Write::write_all(&mut self.file, &NO_MORE)?;
        let mut footer = FlatBufferBuilder::new();
        let dictionaries = footer.create_vector(&dictionaries);
        let batches = footer.create_vector(&self.batches);
        let mut numbers = DictionaryTracker::new(true);
        let mut schema = IpcSchemaEncoder::new().with_dictionary_tracker(&mut numbers);
        let schema = schema.schema_to_fb_offset(&mut footer, &self.schema);
        let mut root = FooterBuilder::new(&mut footer);
        root.add_version(MetadataVersion::V5);
        root.add_schema(schema);
        root.add_dictionaries(dictionaries);
        root.add_recordBatches(batches);
        let root = root.finish();
        footer.finish(root, None);
        let footer = footer.finished_data();
        Write::write_all(&mut self.file, footer)?;
        Write::write_all(&mut self.file, &(footer.len() as i32).to_le_bytes())?;
        Write::write_all(&mut self.file, MAGIC)?;
        Ok(self.file)
    }
}
