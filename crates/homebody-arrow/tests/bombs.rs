//! Reading or refusing a small file that unpacks to much takes little memory.

use crate::alone::is_alone;
use arrow_array::{ArrayRef, DictionaryArray, Int32Array, RecordBatch, StringArray, TimestampMicrosecondArray};
use arrow_ipc::CompressionType;
use arrow_ipc::writer::{FileWriter, IpcWriteOptions};
use arrow_schema::{Field, Schema};
use homebody_core::scenario::logger::LoggerFile;
use homebody_log::registry::{Registry, install};
use homebody_log::{LogSource, read};
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_writer::ArrowWriterOptions;
use parquet::basic::{Compression, Encoding, ZstdLevel};
use parquet::file::properties::{WriterProperties, WriterPropertiesBuilder};
use std::fs::File;
use std::path::Path;
use std::sync::Arc;

const MB: usize = 1 << 20;

/// The most memory that this process has had, in megabytes.
fn peak_mb() -> Option<usize> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(line.split_whitespace().nth(1)?.parse::<usize>().ok()? / 1024)
}

fn rows(sensors: ArrayRef) -> RecordBatch {
    let count = sensors.len();
    let times = TimestampMicrosecondArray::from_iter_values((0..count as i64).map(|row| row * 1_000_000));
    let values = StringArray::from_iter_values((0..count).map(|_| "ON"));
    let columns: [(&str, ArrayRef); 3] = [("time", Arc::new(times)), ("sensor", sensors), ("value", Arc::new(values))];
    let fields: Vec<Field> =
        columns.iter().map(|(name, array)| Field::new(*name, array.data_type().clone(), false)).collect();
    let arrays = columns.map(|(_, array)| array).to_vec();
    RecordBatch::try_new(Arc::new(Schema::new(fields)), arrays).unwrap()
}

fn write_parquet(
    path: &Path,
    rows: &RecordBatch,
    set: impl FnOnce(WriterPropertiesBuilder) -> WriterPropertiesBuilder,
) {
    let zstd = Compression::ZSTD(ZstdLevel::default());
    let properties = set(WriterProperties::builder().set_compression(zstd)).build();
    // Without it a reader does not know that texts were dictionaries.
    let options = ArrowWriterOptions::new().with_properties(properties).with_skip_arrow_metadata(true);
    let mut writer = ArrowWriter::try_new_with_options(File::create(path).unwrap(), rows.schema(), options).unwrap();
    writer.write(rows).unwrap();
    writer.close().unwrap();
}

fn refusal(path: &Path) -> String {
    let read = LogSource::recognise(path).and_then(|source| read(&source, &LoggerFile::default()));
    read.expect_err("the file is no log").to_string()
}

#[test]
fn small_files_that_unpack_to_much_take_little_memory() {
    if !is_alone("bombs::small_files_that_unpack_to_much_take_little_memory", &[]) {
        return;
    }
    install(Registry::new(vec![homebody_arrow::PLUGIN]));
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    // This process makes the files, too: each is made of one text of 100 MB.
    let long = "x".repeat(100 * MB);
    let one = rows(Arc::new(StringArray::from_iter_values([&long])));
    write_parquet(&path("page.parquet"), &one, |builder| builder.set_dictionary_enabled(false));
    let options = IpcWriteOptions::default().try_with_compression(Some(CompressionType::ZSTD)).unwrap();
    let file = File::create(path("batch.arrow")).unwrap();
    let mut writer = FileWriter::try_new_with_options(file, &one.schema(), options).unwrap();
    writer.write(&one).unwrap();
    writer.finish().unwrap();
    drop((one, long));
    // A text of half a megabyte that 4,000 rows repeat: a dictionary holds it.
    let (count, text) = (4_000, "y".repeat(MB / 2));
    let keys = Int32Array::from(vec![0; count]);
    let repeated = DictionaryArray::new(keys, Arc::new(StringArray::from_iter_values([&text])));
    write_parquet(&path("repeated.parquet"), &rows(Arc::new(repeated)), |builder| builder);
    let beginnings = StringArray::from_iter_values((0..200).map(|_| &text));
    write_parquet(&path("beginnings.parquet"), &rows(Arc::new(beginnings)), |builder| {
        builder.set_dictionary_enabled(false).set_column_encoding("sensor".into(), Encoding::DELTA_BYTE_ARRAY)
    });
    let made = peak_mb();
    for name in ["page.parquet", "batch.arrow"] {
        let size = path(name).metadata().unwrap().len();
        assert!(size < MB as u64 / 4, "{name} is small: {size} bytes");
        assert!(refusal(&path(name)).contains("unpacks to more than 64 MB"), "{name}: {}", refusal(&path(name)));
    }
    for name in ["repeated.parquet", "beginnings.parquet"] {
        assert!(refusal(&path(name)).contains("more than 255 characters"), "{name}: {}", refusal(&path(name)));
    }
    let Some((made, read)) = made.zip(peak_mb()) else { return };
    assert!(read < made + 150, "{made} MB to make the files, {read} MB once they were read");
}
