//! A data set holds whole days of whole runs, whatever interrupts the program.

use crate::stage::{self, Folder};
use homebody_core::event::Firing;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::{DAY, HOUR, RunTime, SECOND, Span};
use homebody_log::fleet::FleetLayout;
use homebody_log::registry::{Registry, install};
use homebody_log::run_log::destinations;
use homebody_log::table::{Batch, Cell, TextPool};
use homebody_log::{Begin, LogError, LogSource, Logger, RunInfo, Sink, TruthLog, Url, WriteMode, read};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A folder, with the plugin in place.
pub fn ready(name: &str) -> Folder {
    install(Registry::new(vec![homebody_arrow::PLUGIN]));
    Folder::new(name)
}

/// Firings of some days: 22,000 of them are one.
fn days(count: f64) -> Vec<Firing> {
    stage::firings((count * 22_000.0) as u64)
}

fn of_run(id: i64, url: &Url, how: WriteMode) -> Result<Logger, LogError> {
    let run = Arc::new(RunInfo { id, ..stage::run() });
    Logger::open(destinations(std::slice::from_ref(url), how)?, &LoggerFile::default(), &run, how)
}

fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut all = BTreeMap::new();
    collect(folder, folder, &mut all);
    all
}

fn collect(base: &Path, folder: &Path, all: &mut BTreeMap<String, Vec<u8>>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        match path.is_dir() {
            true => collect(base, &path, all),
            false => {
                let name = path.strip_prefix(base).unwrap().to_string_lossy().into_owned();
                all.insert(name, fs::read(&path).unwrap());
            }
        }
    }
}

fn names(folder: &Path) -> Vec<String> {
    files(folder).into_keys().collect()
}

#[test]
fn each_day_has_its_file_once_it_is_over() {
    let folder = ready("days");
    let url = folder.url("parquet:lives");
    let mut logger = of_run(5, &url, WriteMode::Create).unwrap();
    let firings = days(2.5);
    let midnight = RunTime::START + 2 * HOUR;
    let first = firings.iter().position(|firing| firing.at >= midnight).unwrap();
    let mut settled = |firings: &[Firing]| {
        logger.store(firings, firings.last().unwrap().at + Span::MICROSECOND).unwrap();
        logger.make_durable().unwrap();
        logger.wait_durable().unwrap();
        let named: Vec<String> = names(url.path()).into_iter().filter(|name| !name.contains("/.")).collect();
        (named, logger.durable().of(0))
    };
    // The evening of the 7th; a run in real time asks to make it durable, and the day is not over.
    assert_eq!(settled(&firings[..first]), (vec![], 0));
    // The first row of the 8th. Unfinished files have names that programs skip.
    let evening = "run=5/day=2009-03-07/part-0.parquet".to_owned();
    assert_eq!(settled(&firings[first..first + 10]), (vec![evening], first as u64));
    assert!(names(url.path()).iter().any(|name| name.contains("day=2009-03-08/.part-0.parquet.")));
    assert_eq!(settled(&firings[first + 10..]).0.len(), 3);
    logger.finish().unwrap();
    let dates = ["07", "08", "09", "10"].map(|day| format!("run=5/day=2009-03-{day}/part-0.parquet"));
    assert_eq!(names(url.path()), dates);
    let log = read(LogSource::recognise(url.path()).unwrap(), &LoggerFile::default()).unwrap();
    assert_eq!(log.rows, firings.len() as u64);
    assert!(log.events.is_sorted_by_key(|event| event.at));
}

#[test]
fn runs_in_one_folder_leave_each_other_alone() {
    let folder = ready("runs");
    let url = folder.url("parquet:lives");
    let live = |id, how, count| of_run(id, &url, how).map(|logger| stage::store(logger, &days(count), 100).unwrap());
    live(5, WriteMode::Create, 1.5).unwrap();
    let before = files(url.path());
    live(6, WriteMode::Create, 0.5).unwrap();
    assert!(matches!(live(5, WriteMode::Create, 1.5), Err(LogError::Exists { .. })));
    let both = LogSource::recognise(url.path()).unwrap();
    let error = read(&both, &LoggerFile::default()).unwrap_err();
    let LogError::NoLog(reason) = &error else { panic!("{error}") };
    assert_eq!(
        (error.code(), &reason.why.data["runs"]),
        ("parquet::several-runs", &["run=5", "run=6"].to_vec().into())
    );
    let one = read(LogSource::recognise(&url.path().join("run=6")).unwrap(), &LoggerFile::default()).unwrap();
    assert_eq!(one.rows, 11_000);
    // Given up before its first day is whole, it has replaced nothing.
    let mut logger = of_run(5, &url, WriteMode::Overwrite).unwrap();
    logger.store(&days(0.01), RunTime::START + SECOND).unwrap();
    drop(logger);
    let now = files(url.path());
    assert!(before.iter().all(|(name, bytes)| now.get(name) == Some(bytes)));
    // A shorter one takes the place of all days of its run.
    live(5, WriteMode::Overwrite, 0.5).unwrap();
    let of_five = |name: &&String| name.starts_with("run=5/");
    assert_eq!(names(url.path()).iter().filter(of_five).count(), 2);
    assert_eq!(before.len(), 3);
}

#[test]
fn the_same_rows_are_the_same_files_whatever_the_batches() {
    let folder = ready("steps");
    let all = [1, 777, 50_000].map(|step| {
        let url = folder.url(&format!("parquet:{step}"));
        stage::store(of_run(5, &url, WriteMode::Create).unwrap(), &days(2.2), step).unwrap();
        files(url.path())
    });
    assert!(all[0] == all[1] && all[1] == all[2]);
}

/// The place for the child of the test below; its parent sets it.
const CHILD: &str = "HOMEBODY_TEST_DATA_SET";

/// Stores days until it is killed. Run as a test of its own it has nothing to do.
#[test]
fn child() {
    let Ok(url) = std::env::var(CHILD) else { return };
    install(Registry::new(vec![homebody_arrow::PLUGIN]));
    let mut logger = of_run(5, &url.parse().unwrap(), WriteMode::Resume).unwrap();
    for step in days(4.0).chunks(50) {
        logger.store(step, step[step.len() - 1].at + Span::MICROSECOND).unwrap();
        std::thread::sleep(Duration::from_micros(300));
    }
    logger.finish().unwrap();
}

#[test]
fn whatever_kills_a_run_it_is_gone_on_with_to_the_same_bytes() {
    let folder = ready("kills");
    let kills = std::env::var("HOMEBODY_KILLS").ok().and_then(|kills| kills.parse().ok()).unwrap_or(6_u64);
    for (kind, name) in [("parquet", "set"), ("parquet", "log.parquet"), ("arrow", "log.arrow")] {
        let whole = folder.url(&format!("{kind}:whole-{name}"));
        stage::store(of_run(5, &whole, WriteMode::Create).unwrap(), &days(4.0), 5_000).unwrap();
        let bytes = |url: &Url| match url.path().is_dir() {
            true => files(url.path()),
            false => BTreeMap::from([(String::new(), fs::read(url.path()).unwrap())]),
        };
        let mut days_left = 0;
        for kill in 0..kills {
            let url = folder.url(&format!("{kind}:{kill}-{name}"));
            let mut child = Command::new(std::env::current_exe().unwrap())
                .args(["data_sets::child", "--exact", "--test-threads", "1"])
                .env(CHILD, url.to_string())
                .stdout(Stdio::null())
                .spawn()
                .unwrap();
            let begun = Instant::now();
            let has_begun = || {
                fs::read_dir(folder.path())
                    .unwrap()
                    .any(|entry| entry.unwrap().file_name().to_string_lossy().starts_with(&format!("{kill}-")))
            };
            while !has_begun() {
                assert!(begun.elapsed() < Duration::from_secs(60), "the child begins");
                std::thread::sleep(Duration::from_millis(1));
            }
            std::thread::sleep(Duration::from_millis(kill * 7919 % 1_000));
            child.kill().unwrap();
            child.wait().unwrap();
            // Files that a killed run leaves under their names are whole and final.
            if url.path().is_dir() {
                let there = files(url.path());
                for (name, bytes) in there.iter().filter(|(name, _)| name.ends_with(".parquet")) {
                    assert!(files(whole.path()).get(name) == Some(bytes), "{name} after kill {kill}");
                    days_left += 1;
                }
            }
            stage::store(of_run(5, &url, WriteMode::Resume).unwrap(), &days(4.0), 1_000).unwrap();
            assert!(bytes(&url) == bytes(&whole), "{url} after kill {kill}");
            match url.path().is_dir() {
                true => fs::remove_dir_all(url.path()).unwrap(),
                false => fs::remove_file(url.path()).unwrap(),
            }
        }
        assert!(name != "set" || days_left > 0, "some were killed with whole days");
        assert!(folder.files().iter().all(|name| !name.ends_with(".part")), "{:?}", folder.files());
    }
}

/// The negative control: what was changed is not passed off as the run, nor is what this run does not come to.
#[test]
fn what_was_changed_is_not_gone_on_with() {
    let folder = ready("changed");
    let open = |url: &Url| of_run(5, url, WriteMode::Resume);
    for (kind, name) in [("parquet", "set"), ("parquet", "log.parquet"), ("arrow", "log.arrow")] {
        let url = folder.url(&format!("{kind}:{name}"));
        let mut other = days(1.5);
        other[100].sensor = other[101].sensor;
        other[100].at += Span::MICROSECOND;
        let changed = |result: Result<_, LogError>| match result {
            Err(LogError::Changed(reason)) => reason.why.code,
            Err(error) => panic!("{error}"),
            Ok(_) => panic!("{url} was gone on with"),
        };
        stage::store(of_run(5, &url, WriteMode::Create).unwrap(), &other, 100).unwrap();
        let said = changed(stage::store(open(&url).unwrap(), &days(1.5), 100));
        assert_eq!(said, "parquet::other-rows");
        // Shorter than before: what is there stays.
        let before = if url.path().is_dir() { files(url.path()) } else { BTreeMap::new() };
        let said = changed(stage::store(open(&url).unwrap(), &other[..15_000], 100));
        assert!(["resume::more-rows", "parquet::extra-file"].contains(&said), "{said}");
        assert!(!url.path().is_dir() || files(url.path()) == before);
        // The same and more of it: what was there is its beginning.
        other.extend(days(2.0).split_off(other.len()));
        stage::store(open(&url).unwrap(), &other, 100).unwrap();
        assert_eq!(read(&url, &LoggerFile::default()).unwrap().rows, other.len() as u64);
    }
}

#[test]
fn two_programs_never_write_one_run() {
    let folder = ready("two");
    let url = folder.url("parquet:lives");
    let first = of_run(5, &url, WriteMode::Resume).unwrap();
    assert!(matches!(of_run(5, &url, WriteMode::Resume), Err(LogError::Busy { .. })));
    // The control: another run is free, and once the first is done its place is too.
    assert!(of_run(6, &url, WriteMode::Resume).is_ok());
    drop(first);
    assert!(of_run(5, &url, WriteMode::Resume).is_ok());
}

#[test]
#[cfg(unix)]
fn a_folder_that_leads_elsewhere_is_not_written_into() {
    let folder = ready("links");
    let elsewhere = folder.path().join("elsewhere");
    fs::create_dir(&elsewhere).unwrap();
    fs::create_dir(folder.path().join("lives")).unwrap();
    std::os::unix::fs::symlink(&elsewhere, folder.path().join("lives/run=5")).unwrap();
    let url = folder.url("parquet:lives");
    assert!(matches!(of_run(5, &url, WriteMode::Resume), Err(LogError::LeadsOut { .. })));
    fs::remove_file(folder.path().join("lives/run=5")).unwrap();
    fs::create_dir(folder.path().join("lives/run=5")).unwrap();
    std::os::unix::fs::symlink(&elsewhere, folder.path().join("lives/run=5/day=2009-03-08")).unwrap();
    let stored = of_run(5, &url, WriteMode::Resume).and_then(|logger| stage::store(logger, &days(0.5), 100));
    assert!(matches!(stored, Err(LogError::LeadsOut { .. })));
    assert_eq!(fs::read_dir(&elsewhere).unwrap().count(), 0);
}

#[test]
fn each_table_of_the_truth_has_a_folder_even_one_without_rows() {
    let folder = ready("truth");
    let url = folder.url("parquet:truth");
    let run = Arc::new(stage::run());
    TruthLog::open(&url, &[], &LoggerFile::default(), &run, WriteMode::Create)
        .unwrap()
        .finish(RunTime::from_micros(1))
        .unwrap();
    let names = names(url.path());
    assert_eq!(names.len(), homebody_log::table::truth::tables().len());
    for name in ["movement/run=1/day=2009-03-07/part-0.parquet", "off/run=1/part-0.parquet"] {
        assert!(names.contains(&name.to_owned()), "{names:?}");
    }
}

/// Rows out of order are in further files of their days, and read in the order in which they came.
#[test]
fn rows_in_no_order_of_time_keep_their_own_order() {
    let folder = ready("order");
    let url = folder.url("parquet:lives");
    written(&url, WriteMode::Create, false, |row| (row * 7 % 10) * DAY + row * SECOND)
        .unwrap()
        .finish(RunTime::START)
        .unwrap();
    assert!(names(url.path()).len() > 10);
    let log = read(LogSource::recognise(url.path()).unwrap(), &LoggerFile::default()).unwrap();
    let values: Vec<String> = log.events.iter().map(|event| log.value(event).to_owned()).collect();
    let wanted: Vec<String> = (0..500).map(|row| format!("{}", f64::from(row) / 100.0)).collect();
    assert_eq!(values, wanted);
}

/// A sink at a place with 500 rows, which is not finished.
fn written(url: &Url, how: WriteMode, is_whole: bool, at: impl Fn(i64) -> Span) -> Result<Box<dyn Sink>, LogError> {
    let run = stage::run();
    let table = FleetLayout::new(run.clone(), &LoggerFile::default())?.table;
    let begin = Begin { is_whole, ..Begin::new(run.into(), vec![table], Default::default(), how) };
    let mut sink = homebody_log::registry::sink(url);
    sink.begin(&begin)?;
    let mut texts = TextPool::default();
    let text = Cell::Text(texts.id("hall"));
    let mut batch = Batch::default();
    for row in 0..500 {
        batch.push(
            0,
            [Cell::Integer(row), Cell::Instant(RunTime::START + at(row)), text, Cell::Thousandths(row as i32 * 10)],
        );
    }
    sink.write(&batch.with(&texts))?;
    Ok(sink)
}

#[test]
fn a_whole_log_has_its_name_only_once_all_rows_are_in_it() {
    let folder = ready("whole");
    let at = |row: i64| row * DAY / 100;
    // A killed program has left the beginning of its files.
    let left = folder.path().join("lives/.run=1.part/day=2009-03-03");
    fs::create_dir_all(&left).unwrap();
    fs::write(left.join("part-0.parquet"), "half").unwrap();
    for place in ["parquet:lives", "jsonl:lives.jsonl"] {
        let url = folder.url(place);
        let rows = || LogSource::recognise(url.path()).and_then(|source| read(source, &LoggerFile::default()));
        drop(written(&url, WriteMode::Create, true, at).unwrap());
        assert!(rows().is_err(), "{place}");
        written(&url, WriteMode::Create, true, at).unwrap().finish(RunTime::START).unwrap();
        assert_eq!(rows().unwrap().events.len(), 500, "{place}");
        assert!(matches!(written(&url, WriteMode::Create, true, at), Err(LogError::Exists { .. })), "{place}");
        // The old rows stay until the new ones are whole.
        let first = rows().unwrap().events[0].at;
        drop(written(&url, WriteMode::Overwrite, true, |row| at(row) + HOUR).unwrap());
        assert_eq!(rows().unwrap().events[0].at, first, "{place}");
        written(&url, WriteMode::Overwrite, true, |row| at(row) + HOUR).unwrap().finish(RunTime::START).unwrap();
        let replaced = rows().unwrap();
        assert_eq!((replaced.events.len(), replaced.events[0].at), (500, first + HOUR), "{place}");
        let hidden = fs::read_dir(folder.path()).unwrap().chain(fs::read_dir(url.path()).into_iter().flatten());
        let hidden = hidden.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        assert_eq!(hidden.filter(|name| name.ends_with(".part")).count(), 0, "{place}");
    }
    // The control: a run's log can be followed.
    let url = folder.url("parquet:run");
    std::mem::forget(written(&url, WriteMode::Create, false, at).unwrap());
    assert!(!names(url.path()).is_empty());
}
