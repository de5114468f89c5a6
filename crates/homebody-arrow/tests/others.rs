//! DuckDB, Polars and PyArrow read our files, and we read the files of Polars and pandas. Tests skip the programs that Python lacks.

use crate::stage::{self, Folder};
use homebody_core::scenario::logger::{LoggerFile, TimeFormat};
use homebody_core::time::{HOUR, Interval, RunTime, WallTime};
use homebody_log::registry::{Registry, install};
use homebody_log::{LogError, LogSource, Logger, RunInfo, TruthLog, WriteMode, read};
use std::process::Command;
use std::sync::Arc;

/// The Python program; it prints the results for the test.
const ASKS: &str = r#"
import duckdb, glob, json, polars, sys
set_, log, arrow, truth, out = sys.argv[1:]
files = set_ + "/*/*/*.parquet"
duck = duckdb.sql(f"select count(*), count(distinct run), count(distinct day), min(fired_at) from read_parquet('{files}', hive_partitioning = true)").fetchall()[0]
one_day = duckdb.sql(f"select count(*) from read_parquet('{files}', hive_partitioning = true) where run = 5 and day = '2009-03-08'").fetchall()[0][0]
lazy = polars.scan_parquet(files, hive_partitioning=True)
by_polars = lazy.select(polars.len()).collect().item()
polars_day = lazy.filter((polars.col("run") == 5) & (polars.col("day").cast(polars.String) == "2009-03-08")).select(polars.len()).collect().item()
whole = polars.read_parquet(log)
feather = polars.read_ipc(arrow)
about = duckdb.sql(f"select decode(value) from parquet_kv_metadata('{log}') where decode(key) = 'homebody'").fetchall()[0][0]
empty = duckdb.sql(f"select count(*) from read_parquet('{truth}/movement/*/*/*.parquet', hive_partitioning = true)").fetchall()[0][0]
print(json.dumps({
    "duck": [duck[0], duck[1], duck[2], str(duck[3].astimezone(__import__('datetime').timezone.utc))],
    "one_day": [one_day, polars_day],
    "polars": by_polars,
    "types": [str(whole.schema[name]) for name in ["seq", "fired_at", "sensor", "value"]],
    "feather_is_same": feather.equals(whole),
    "name": json.loads(about)["name"],
    "empty": empty,
}))
whole.select("fired_at", "sensor", "value").write_parquet(out + "/polars.parquet")
whole.select("fired_at", "sensor", "value").write_ipc(out + "/polars.arrow")
whole.select("fired_at", "sensor", "value").write_ipc(out + "/packed.arrow", compression="zstd")
try:
    import pyarrow, pyarrow.dataset, pyarrow.feather, pandas
    assert pyarrow.dataset.dataset(set_, partitioning="hive").count_rows() == duck[0]
    assert pyarrow.feather.read_table(arrow).num_rows == whole.height
    table = pandas.read_parquet(log)
    assert str(table["sensor"].dtype) == "category", table.dtypes
    table[["fired_at", "sensor", "value"]].to_parquet(out + "/pandas.parquet")
    pandas.read_feather(arrow)[["fired_at", "sensor", "value"]].to_feather(out + "/pandas.arrow", compression="zstd")
except ImportError:
    print("no pandas and pyarrow", file=sys.stderr)
"#;

fn has_python() -> bool {
    let asked = Command::new("python3").args(["-c", "import duckdb, polars"]).output();
    asked.is_ok_and(|done| done.status.success())
}

#[test]
fn exchanges_files_with_duckdb_and_polars() {
    if !has_python() {
        let required = std::env::var("HOMEBODY_READERS").is_ok_and(|wanted| wanted == "required");
        assert!(!required, "python3 has no duckdb and polars");
        println!("skipped: python3 has no duckdb and polars (pip install duckdb polars)");
        return;
    }
    install(Registry::new(vec![homebody_arrow::PLUGIN]));
    let folder = Folder::new("others");
    let urls = ["parquet:lives", "parquet:log.parquet", "arrow:log.arrow"].map(|url| folder.url(url));
    let firings = stage::firings(50_000);
    let live = |id, urls: &[_]| -> Result<_, LogError> {
        let run = Arc::new(RunInfo { id, ..stage::run() });
        let places = homebody_log::run_log::destinations(urls, WriteMode::Create)?;
        let mapping = LoggerFile { time: TimeFormat::Utc, ..LoggerFile::default() };
        stage::store(Logger::open(places, &mapping, &run, WriteMode::Create)?, &firings, 1000)
    };
    live(5, &urls).unwrap();
    live(6, &urls[..1]).unwrap();
    let truth = folder.url("parquet:truth");
    let run = Arc::new(stage::run());
    TruthLog::open(&truth, &[], &LoggerFile::default(), &run, WriteMode::Create)
        .unwrap()
        .finish(RunTime::from_micros(1))
        .unwrap();
    let asked = Command::new("python3")
        .args(["-c", ASKS])
        .args(urls.iter().map(|url| url.path()).chain([truth.path(), folder.path()]))
        .output()
        .unwrap();
    assert!(asked.status.success(), "{}", String::from_utf8_lossy(&asked.stderr));
    let told: serde_json::Value = serde_json::from_slice(&asked.stdout).unwrap();
    println!("{told}");
    let log = read(&urls[0].within(folder.path()), &LoggerFile::default());
    assert!(log.is_err(), "it holds two runs");
    let log = read(&urls[1], &LoggerFile::default()).unwrap();
    assert_eq!(told["duck"][0], 100_000);
    assert_eq!((&told["duck"][1], &told["polars"]), (&2.into(), &100_000.into()));
    assert_eq!(told["duck"][3], "2009-03-08 04:00:00.000001+00:00");
    let day = Interval::starting(WallTime::from_micros(1_236_492_000_000_000), 23 * HOUR);
    let of_day = log.events.iter().filter(|event| day.contains(event.at)).count();
    // The 8th had 23 hours in Chicago.
    assert_eq!(told["one_day"], serde_json::json!([of_day, of_day]));
    assert_eq!(told["types"][0], "Int64");
    assert_eq!(told["types"][1], "Datetime(time_unit='us', time_zone='UTC')");
    assert!(told["types"][2].as_str().unwrap().starts_with("Categorical"), "{}", told["types"]);
    assert_eq!(
        (&told["feather_is_same"], &told["name"], &told["empty"]),
        (&true.into(), &"a quiet night".into(), &0.into())
    );
    for name in ["polars.parquet", "polars.arrow", "packed.arrow", "pandas.parquet", "pandas.arrow"] {
        let path = folder.path().join(name);
        if !path.exists() && name.starts_with("pandas") {
            println!("skipped: python3 has no pandas and pyarrow");
            continue;
        }
        let back = read(LogSource::recognise(&path).unwrap(), &LoggerFile::default()).unwrap();
        assert!(back.events == log.events && back.sensors == log.sensors && back.values == log.values, "{name}");
    }
}
