//! Shared by the tests: folders, and a run to log.
#![allow(dead_code, reason = "each test file uses a part of it")]

pub mod sinks;
pub mod texts;

use homebody_core::calendar::Calendar;
use homebody_core::event::{Firing, Value};
use homebody_core::ids::SensorId;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::scenario::scheme::Scheme;
use homebody_core::time::{RunTime, SECOND, Span};
use homebody_log::run_log::destinations;
use homebody_log::{Destination, Log, LogError, Logger, RunInfo, Stored, TruthLog, Url, WriteMode};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// A folder that vanishes with the test.
pub struct Folder(PathBuf);

impl Folder {
    pub fn new(name: &str) -> Folder {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let own = format!("{name}-{}-{}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(own);
        let _ = std::fs::remove_dir_all(&path);
        std::fs::create_dir_all(&path).unwrap();
        Folder(path)
    }

    pub fn path(&self) -> &Path {
        &self.0
    }

    pub fn url(&self, url: &str) -> Url {
        url.parse::<Url>().unwrap().within(&self.0)
    }

    /// The names of the files in it.
    pub fn files(&self) -> Vec<String> {
        let mut names: Vec<String> =
            self.0.read_dir().unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    pub fn text(&self, name: &str) -> String {
        std::fs::read_to_string(self.0.join(name)).unwrap()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

pub fn sensors() -> Vec<String> {
    ["bedroom motion", "kitchen motion", "fridge"].map(String::from).to_vec()
}

pub fn calendar() -> Calendar {
    Calendar::new("2009-03-07T22:00:00", "America/Chicago").unwrap()
}

pub fn run() -> RunInfo {
    run_of(&sensors())
}

/// The run of a home with these sensors.
pub fn run_of(sensors: &[String]) -> RunInfo {
    RunInfo {
        seed: u64::MAX,
        residents: vec!["margaret".into(), "walter".into()],
        rooms: vec!["bedroom".into(), "kitchen".into()],
        things: vec!["stove".into()],
        ..RunInfo::of_log("a quiet night", calendar(), &Log { sensors: sensors.to_vec(), ..Log::default() })
    }
}

/// Firings some seconds apart, over the change to daylight saving time and, if there are many, far beyond.
pub fn firings(count: u64) -> Vec<Firing> {
    let mut at = RunTime::START;
    (0..count)
        .map(|seq| {
            at += (seq * 7_919_993 % 31) as i64 * SECOND / 4 + Span::from_micros(1 + (seq % 1000) as i64);
            Firing { seq, at, sensor: SensorId((seq * 31 % 3) as u32), value: Value::Fire }
        })
        .collect()
}

/// Opens a logger of this stage's run.
pub fn open(urls: &[Url], file: &LoggerFile, force: bool) -> Result<Logger, LogError> {
    open_of(urls, file, &sensors(), if force { WriteMode::Overwrite } else { WriteMode::Create })
}

/// Opens a logger of a run with these sensors.
pub fn open_of(urls: &[Url], file: &LoggerFile, sensors: &[String], how: WriteMode) -> Result<Logger, LogError> {
    Logger::open(destinations(urls, how)?, file, &Arc::new(run_of(sensors)), how)
}

/// Opens a logger of this stage's run with destinations of a test.
pub fn logger(all: Vec<Destination>, how: WriteMode) -> Result<Logger, LogError> {
    Logger::open(all, &LoggerFile::default(), &Arc::new(run()), how)
}

/// Starts this program again for one test alone, which finds `value` in its environment.
pub fn child(test: &str, key: &str, value: impl AsRef<OsStr>) -> Child {
    let mut command = Command::new(std::env::current_exe().unwrap());
    command.args([test, "--exact", "--test-threads", "1"]).env(key, value).stdout(Stdio::null());
    command.spawn().unwrap()
}

pub fn wait_for(is_there: impl Fn() -> bool) {
    let begun = Instant::now();
    while !is_there() {
        assert!(begun.elapsed() < Duration::from_secs(60), "the child begins");
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Opens the truth of this stage's run.
pub fn open_truth(path: &Path, places: &[Url], file: &LoggerFile) -> Result<TruthLog, LogError> {
    TruthLog::open(&Url::new(Scheme::Sqlite, path), places, file, &Arc::new(run()), WriteMode::Create)
}

/// A log of ten rows at a place.
pub fn ten_rows(url: &Url, file: &LoggerFile) {
    store(open(std::slice::from_ref(url), file, false).unwrap(), &firings(10), 3).unwrap();
}

/// Stores the firings in advances of `step` firings, as a run of a certain speed does.
pub fn store(mut logger: Logger, firings: &[Firing], step: usize) -> Result<Stored, LogError> {
    let end = firings.last().map_or(RunTime::START, |last| last.at + Span::MICROSECOND);
    for (index, advance) in firings.chunks(step).enumerate() {
        let until = firings.get((index + 1) * step).map_or(end, |next| next.at);
        logger.store(advance, until)?;
    }
    logger.store(&[], end)?;
    logger.finish()
}
