//! Files hold the stored rows with the documented types, for any sizes of batches.

use crate::data_sets::ready;
use crate::stage;
use arrow_array::cast::AsArray;
use arrow_schema::{DataType, TimeUnit};
use homebody_core::scenario::logger::{LoggerFile, TimeFormat};
use homebody_core::time::{RunTime, WallTime};
use homebody_log::log::Clock;
use homebody_log::{Log, LogError, LogSource, Url, WriteMode, read};
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use std::fs::{self, File};

fn stored(url: &Url, file: &LoggerFile, firings: u64, step: usize) {
    let logger = stage::open(std::slice::from_ref(url), file, false).unwrap();
    stage::store(logger, &stage::firings(firings), step).unwrap();
}

fn told(log: &Log) -> Vec<(WallTime, String, String)> {
    log.events.iter().map(|event| (event.at, log.sensor(event).to_owned(), log.value(event).to_owned())).collect()
}

#[test]
fn all_kinds_of_files_hold_the_same_log() {
    let folder = ready("same-log");
    let places = ["csv:log.csv", "parquet:log.parquet", "arrow:log.arrow", "parquet:log"].map(|url| folder.url(url));
    let logger = stage::open(&places, &LoggerFile { time: TimeFormat::Utc, ..LoggerFile::default() }, false).unwrap();
    stage::store(logger, &stage::firings(70_000), 777).unwrap();
    let logs = places.each_ref().map(|url| read(url, &LoggerFile::default()).unwrap());
    assert_eq!(logs[0].rows, 70_000);
    assert_eq!(logs[0].clock, Clock::Utc);
    for (place, log) in places.iter().zip(&logs).skip(1) {
        assert_eq!(log.clock, Clock::Utc, "{place}");
        assert!(told(log) == told(&logs[0]), "{place} tells another log");
        assert!(log.problems.is_empty() && log.remarks.is_empty(), "{place}");
        // By how it begins, or by the names of its folders.
        let found = LogSource::recognise(place.path()).unwrap();
        assert_eq!(found.form().name, place.to_string().split(':').next().unwrap());
    }
}

#[test]
fn columns_have_their_types_and_the_file_its_description() {
    let folder = ready("types");
    for (time, zone) in
        [(TimeFormat::LocalOffset, Some("UTC")), (TimeFormat::EpochMs, Some("UTC")), (TimeFormat::Local, None)]
    {
        let name = format!("{time:?}.parquet");
        stored(&folder.url(&format!("parquet:{name}")), &LoggerFile { time, ..LoggerFile::default() }, 10, 3);
        let file = File::open(folder.path().join(&name)).unwrap();
        let reader = ParquetRecordBatchReaderBuilder::try_new(file).unwrap();
        let types: Vec<(String, DataType)> =
            reader.schema().fields().iter().map(|field| (field.name().clone(), field.data_type().clone())).collect();
        let texts = DataType::Dictionary(Box::new(DataType::Int32), Box::new(DataType::Utf8));
        let wanted = [
            ("run_id", DataType::Int64),
            ("seq", DataType::Int64),
            ("fired_at", DataType::Timestamp(TimeUnit::Microsecond, zone.map(Into::into))),
            ("sensor", texts.clone()),
            ("value", texts),
        ];
        assert_eq!(types, wanted.map(|(name, kind)| (name.to_owned(), kind)));
        let told = reader.metadata().file_metadata().key_value_metadata().unwrap();
        let about = told.iter().find(|told| told.key == "homebody").unwrap().value.clone().unwrap();
        let about: serde_json::Value = serde_json::from_str(&about).unwrap();
        assert_eq!(about["name"], "a quiet night");
        // A log that was only read has no run, so its file names none.
        assert_eq!(about.get("synthetic"), None);
        let rows = reader.build().unwrap().next().unwrap().unwrap();
        let first = rows.column(2).as_primitive::<arrow_array::types::TimestampMicrosecondType>().value(0);
        // 22:00 in Chicago is 04:00 in UTC of the next day; the first row comes 1 us later.
        let midnight = 1_236_470_400_000_000;
        let hours = if zone.is_some() { 4 } else { -2 };
        assert_eq!(first, midnight + hours * 3_600_000_000 + 1);
    }
}

#[test]
fn the_same_rows_are_the_same_bytes_whatever_the_batches() {
    let folder = ready("same-bytes");
    for (ending, kind) in [("parquet", "parquet"), ("arrow", "arrow")] {
        let files = [1, 333, 9_000].map(|step| {
            let name = format!("{step}.{ending}");
            stored(&folder.url(&format!("{kind}:{name}")), &LoggerFile::default(), 20_000, step);
            fs::read(folder.path().join(name)).unwrap()
        });
        assert!(files[0] == files[1] && files[1] == files[2], "{ending}");
        assert!(files[0].len() < 20_000 * 8, "{} bytes", files[0].len());
    }
}

#[test]
fn groups_of_rows_are_bounded() {
    let folder = ready("groups");
    stored(&folder.url("parquet:log.parquet"), &LoggerFile::default(), 300_000, 5_000);
    let file = File::open(folder.path().join("log.parquet")).unwrap();
    let reader = ParquetRecordBatchReaderBuilder::try_new(file).unwrap();
    let groups: Vec<i64> = reader.metadata().row_groups().iter().map(|group| group.num_rows()).collect();
    assert_eq!(groups, [131_072, 131_072, 37_856]);
}

#[test]
fn a_file_has_its_name_only_once_it_is_whole_and_nothing_is_replaced_unasked() {
    let folder = ready("whole");
    for url in ["parquet:log.parquet", "arrow:log.arrow"].map(|url| folder.url(url)) {
        let open = |how| stage::open_of(std::slice::from_ref(&url), &LoggerFile::default(), &stage::sensors(), how);
        let mut logger = open(WriteMode::Create).unwrap();
        logger.store(&stage::firings(10), RunTime::from_micros(i64::MAX / 2)).unwrap();
        logger.make_durable().unwrap();
        logger.wait_durable().unwrap();
        assert!(!url.path().exists());
        drop(logger);
        assert_eq!(folder.files(), Vec::<String>::new(), "what was given up leaves nothing");
        stage::store(open(WriteMode::Create).unwrap(), &stage::firings(10), 3).unwrap();
        let before = fs::read(url.path()).unwrap();
        assert!(matches!(open(WriteMode::Create), Err(LogError::Exists { .. })));
        stage::store(open(WriteMode::Overwrite).unwrap(), &stage::firings(20), 3).unwrap();
        assert_ne!(fs::read(url.path()).unwrap(), before);
        fs::remove_file(url.path()).unwrap();
    }
}

#[test]
fn tables_of_the_truth_have_files_of_their_own() {
    let folder = ready("truth-files");
    for url in ["parquet:truth.parquet", "arrow:truth.arrow"].map(|url| folder.url(url)) {
        let run = std::sync::Arc::new(stage::run());
        let truth = homebody_log::TruthLog::open(&url, &[], &LoggerFile::default(), &run, WriteMode::Create).unwrap();
        truth.finish(RunTime::from_micros(1)).unwrap();
    }
    let names = folder.files();
    assert!(names.contains(&"truth.room.parquet".to_owned()) && names.contains(&"truth.cause.arrow".to_owned()));
    assert_eq!(names.len(), 2 * homebody_log::table::truth::tables().len());
    // None of them is taken for a log.
    for name in names.iter().filter(|name| !name.contains(".activity.")) {
        let read = read(LogSource::recognise(&folder.path().join(name)).unwrap(), &LoggerFile::default());
        assert!(matches!(read, Err(LogError::NoLog { .. })), "{name}");
    }
}
