//! Files of other programs are readable with any column types; errors name what is damaged.

use crate::data_sets::ready;
use crate::stage;
use arrow_array::builder::StringViewBuilder;
use arrow_array::types::Int8Type;
use arrow_array::*;
use arrow_schema::{DataType, Field, Schema, TimeUnit};
use homebody_core::scenario::logger::LoggerFile;
use homebody_log::log::Clock;
use homebody_log::{Log, LogError, LogSource, read};
use parquet::arrow::ArrowWriter;
use std::fs::{self, File};
use std::path::Path;
use std::sync::Arc;

fn read_at(path: &Path) -> Result<Log, LogError> {
    read(LogSource::recognise(path)?, &LoggerFile::default())
}

fn write(path: &Path, columns: Vec<(&str, ArrayRef)>) {
    let fields: Vec<Field> =
        columns.iter().map(|(name, array)| Field::new(*name, array.data_type().clone(), true)).collect();
    let schema = Arc::new(Schema::new(fields));
    let arrays = columns.into_iter().map(|(_, array)| array).collect();
    let rows = RecordBatch::try_new(schema.clone(), arrays).unwrap();
    let file = File::create(path).unwrap();
    match path.extension().is_some_and(|ending| ending == "parquet") {
        true => {
            let mut writer = ArrowWriter::try_new(file, schema, None).unwrap();
            writer.write(&rows).unwrap();
            writer.close().unwrap();
        }
        false => {
            let mut writer = arrow_ipc::writer::FileWriter::try_new(file, &schema).unwrap();
            writer.write(&rows).unwrap();
            writer.finish().unwrap();
        }
    }
}

/// 2009-03-02 07:12:03.25, in microseconds since 1970.
const AT: i64 = 1_235_977_923_250_000;

#[test]
fn any_types_that_pandas_and_polars_write_are_read() {
    let folder = ready("types");
    let seconds = |all: [i64; 2]| all.map(|at| at as f64 / 1e6);
    let both = [AT, AT + 1_000_000];
    let times: Vec<(&str, ArrayRef, Clock)> = vec![
        ("us", Arc::new(TimestampMicrosecondArray::from(both.to_vec())), Clock::Local),
        ("us_utc", Arc::new(TimestampMicrosecondArray::from(both.to_vec()).with_timezone("UTC")), Clock::Utc),
        ("zoned", Arc::new(TimestampMicrosecondArray::from(both.to_vec()).with_timezone("Europe/Berlin")), Clock::Utc),
        ("ns", Arc::new(TimestampNanosecondArray::from(both.map(|at| at * 1000 + 999).to_vec())), Clock::Local),
        ("ms", Arc::new(TimestampMillisecondArray::from(both.map(|at| at / 1000).to_vec())), Clock::Local),
        ("text", Arc::new(StringArray::from(vec!["2009-03-02 07:12:03.25", "2009-03-02 07:12:04.25"])), Clock::Local),
        ("epoch", Arc::new(Float64Array::from(seconds(both).to_vec())), Clock::Utc),
        ("epoch_us", Arc::new(Int64Array::from(both.to_vec())), Clock::Utc),
    ];
    let sensors: Vec<ArrayRef> = vec![
        Arc::new(StringArray::from(vec!["hall", "7"])),
        Arc::new(LargeStringArray::from(vec!["hall", "7"])),
        Arc::new({
            let mut views = StringViewBuilder::new();
            ["hall", "7"].iter().for_each(|text| views.append_value(text));
            views.finish()
        }),
        Arc::new(vec!["hall", "7"].into_iter().collect::<DictionaryArray<Int8Type>>()),
    ];
    let values: Vec<(ArrayRef, [&str; 2])> = vec![
        (Arc::new(StringArray::from(vec!["ON", "21.5"])), ["ON", "21.5"]),
        (Arc::new(Float64Array::from(vec![21.5, 20.0])), ["21.5", "20"]),
        (Arc::new(Float32Array::from(vec![21.5, 0.1])), ["21.5", "0.1"]),
        (Arc::new(UInt8Array::from(vec![1, 0])), ["1", "0"]),
        (Arc::new(Int64Array::from(vec![-1, 0])), ["-1", "0"]),
        (Arc::new(BooleanArray::from(vec![true, false])), ["true", "false"]),
    ];
    for ending in ["parquet", "arrow"] {
        for (index, (name, time, clock)) in times.iter().enumerate() {
            for (sensor, (value, told)) in sensors.iter().zip(values.iter().cycle().skip(index)) {
                let path = folder.path().join(format!("log.{ending}"));
                let other: ArrayRef = Arc::new(Date32Array::from(vec![1, 2]));
                write(
                    &path,
                    vec![("value", value.clone()), ("day", other), ("Time", time.clone()), ("device", sensor.clone())],
                );
                let log = read_at(&path).unwrap_or_else(|error| panic!("{name}: {error}"));
                assert_eq!((log.clock, log.rows, log.skipped), (*clock, 2, 0), "{name}");
                assert_eq!(log.events.iter().map(|event| event.at.micros()).collect::<Vec<_>>(), both, "{name}");
                assert_eq!(log.sensors, ["hall", "7"]);
                assert_eq!(log.events.iter().map(|event| log.value(event)).collect::<Vec<_>>(), told);
            }
        }
    }
}

#[test]
fn rows_without_an_instant_a_sensor_or_a_value_are_named() {
    let folder = ready("nulls");
    let path = folder.path().join("log.parquet");
    let time: ArrayRef =
        Arc::new(TimestampMicrosecondArray::from(vec![Some(AT), None, Some(AT), Some(i64::MAX), Some(AT)]));
    let sensor: ArrayRef = Arc::new(
        vec![Some("a"), Some("a"), None, Some("a"), Some("a")].into_iter().collect::<DictionaryArray<Int8Type>>(),
    );
    let value: ArrayRef = Arc::new(Float64Array::from(vec![Some(1.0), Some(1.0), Some(1.0), Some(1.0), None]));
    write(&path, vec![("time", time), ("sensor", sensor), ("value", value)]);
    let log = read_at(&path).unwrap();
    let said: Vec<String> = log.problems.iter().map(|problem| format!("{}: {}", problem.line, problem.why)).collect();
    assert_eq!(
        said,
        ["2: there is no time", "3: there is no sensor", "4: the time is out of range", "5: there is no value"]
    );
    assert_eq!(log.rows, 1);
}

#[test]
fn reads_labels_and_a_table_of_activities() {
    let folder = ready("labels");
    let stamps = |all: Vec<i64>| Arc::new(TimestampMicrosecondArray::from(all)) as ArrayRef;
    let texts = |all: Vec<&str>| Arc::new(StringArray::from(all)) as ArrayRef;
    for ending in ["parquet", "arrow"] {
        let path = folder.path().join(format!("week.{ending}"));
        let rows = || {
            vec![
                ("time", stamps(vec![AT, AT + 10, AT + 20])),
                ("sensor", texts(vec!["a", "b", "a"])),
                ("value", texts(vec!["ON", "ON", "OFF"])),
                ("activity", texts(vec!["cooking", "cooking", ""])),
            ]
        };
        write(&path, rows());
        let log = read_at(&path).unwrap();
        let told: Vec<_> =
            log.activities.iter().map(|one| (one.label.as_str(), one.begin().micros(), one.end().micros())).collect();
        assert_eq!(told, [("cooking", AT, AT + 20)]);
        let beside = folder.path().join(format!("week.activity.{ending}"));
        let spans = vec![
            ("start_time", stamps(vec![AT - 5])),
            ("end_time", stamps(vec![AT + 15])),
            ("activity", texts(vec!["breakfast"])),
        ];
        write(&beside, spans);
        let log = read_at(&path).unwrap();
        let told: Vec<_> =
            log.activities.iter().map(|one| (one.label.as_str(), one.begin().micros(), one.end().micros())).collect();
        assert_eq!(told, [("breakfast", AT - 5, AT + 15)]);
    }
}

#[test]
fn rejects_a_file_that_is_not_a_log_and_names_its_columns() {
    let folder = ready("no-log");
    let path = folder.path().join("table.parquet");
    write(&path, vec![("a\u{1b}[31m", Arc::new(Int64Array::from(vec![1])) as ArrayRef)]);
    let error = read_at(&path).unwrap_err();
    let said = error.to_string();
    assert_eq!(error.code(), "parquet::missing-columns", "{said}");
    assert!(said.contains("table.parquet") && !said.contains('\u{1b}'), "{said:?}");
    let kind: ArrayRef = Arc::new(NullArray::new(1));
    write(&path, vec![("time", kind.clone()), ("sensor", kind.clone()), ("value", kind)]);
    let error = read_at(&path).unwrap_err();
    assert!(error.code() == "parquet::column-type" && error.to_string().contains("\"time\""), "{error}");
}

/// Cut anywhere, and with any byte another: a clear error that names the file, or rows, but never a panic.
#[test]
fn a_damaged_file_is_refused_by_its_name() {
    let folder = ready("damaged");
    for ending in ["parquet", "arrow"] {
        let good = folder.url(&format!("{ending}:good.{ending}"));
        let logger = stage::open(std::slice::from_ref(&good), &LoggerFile::default(), false).unwrap();
        stage::store(logger, &stage::firings(300), 100).unwrap();
        let bytes = fs::read(good.path()).unwrap();
        let path = folder.path().join(format!("bad.{ending}"));
        let looked_at = |bytes: &[u8]| {
            fs::write(&path, bytes).unwrap();
            LogSource::recognise(&path).and_then(|source| read(&source, &LoggerFile::default()))
        };
        let name = |error: &LogError| assert!(error.to_string().contains(&format!("bad.{ending}")), "{error}");
        for length in (8..bytes.len()).step_by(29) {
            let error = looked_at(&bytes[..length]).expect_err("it is cut short");
            name(&error);
            assert_eq!(error.code(), "parquet::damaged", "{error}");
        }
        let (mut refused, mut read) = (0, 0);
        for at in (0..bytes.len()).step_by(5) {
            let mut changed = bytes.clone();
            changed[at] ^= 1 << (at % 8);
            match looked_at(&changed) {
                Ok(_) => read += 1,
                Err(error) => {
                    name(&error);
                    refused += 1;
                }
            }
        }
        println!("{ending}: of {} changes {refused} are refused, {read} read", refused + read);
        assert!(refused > 0 && read > 0);
    }
}

#[test]
fn data_sets_of_others_are_read_in_the_order_of_their_names() {
    let folder = ready("others");
    let parts = [("home=1/year=2009/a.parquet", AT), ("home=1/year=2010/b.parquet", AT + 10), ("c.parquet", AT + 20)];
    for (name, at) in parts {
        let path = folder.path().join("set").join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        let text = |text: &str| Arc::new(StringArray::from(vec![text])) as ArrayRef;
        let time: ArrayRef = Arc::new(TimestampMicrosecondArray::from(vec![at]));
        write(&path, vec![("time", time), ("sensor", text(name)), ("value", text("ON"))]);
    }
    // The extra files of Spark and others, and unfinished ones.
    fs::write(folder.path().join("set/_SUCCESS"), "").unwrap();
    fs::write(folder.path().join("set/home=1/.part.parquet"), "no parquet").unwrap();
    let log = read_at(&folder.path().join("set")).unwrap();
    assert_eq!(log.sensors, ["c.parquet", "home=1/year=2009/a.parquet", "home=1/year=2010/b.parquet"]);
    fs::write(folder.path().join("set/home=1/year=2010/torn.parquet"), "PAR1 torn").unwrap();
    let error = read_at(&folder.path().join("set")).unwrap_err();
    assert!(error.code() == "parquet::damaged" && error.to_string().contains("torn.parquet"), "{error}");
    fs::create_dir_all(folder.path().join("empty/run=1")).unwrap();
    assert_eq!(read_at(&folder.path().join("empty")).unwrap_err().code(), "parquet::no-files");
}

#[test]
fn does_not_take_durations_for_instants() {
    let folder = ready("units");
    let path = folder.path().join("log.parquet");
    let text = Arc::new(StringArray::from(vec!["a"])) as ArrayRef;
    let time: ArrayRef = Arc::new(Time64MicrosecondArray::from(vec![1]));
    assert_eq!(time.data_type(), &DataType::Time64(TimeUnit::Microsecond));
    write(&path, vec![("time", time), ("sensor", text.clone()), ("value", text)]);
    assert_eq!(read_at(&path).unwrap_err().code(), "parquet::column-type");
}
