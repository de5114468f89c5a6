//! Failures of destinations, and the files that they leave.

use crate::stage::{self, Folder};
use homebody_core::messages::Diagnose;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::{RunTime, SECOND, Span};
use homebody_log::{LogError, Logger, WriteMode};
use rusqlite::Connection;
use std::fs;

fn refused(folder: &Folder, url: &str, force: bool) -> LogError {
    match stage::open(&[folder.url(url)], &LoggerFile::default(), force) {
        Ok(_) => panic!("{url} was opened"),
        Err(error) => error,
    }
}

#[test]
fn an_existing_file_is_replaced_with_force_only() {
    let folder = Folder::new("exists");
    for (url, name) in [("sqlite:log.db", "log.db"), ("csv:log.csv", "log.csv"), ("casas:log.txt", "log.txt")] {
        fs::write(folder.path().join(name), "mine").unwrap();
        let error = refused(&folder, url, false);
        assert!(matches!(error, LogError::Exists { .. }));
        assert_eq!(folder.text(name), "mine");
        let logger = stage::open(&[folder.url(url)], &LoggerFile::default(), true).unwrap();
        stage::store(logger, &stage::firings(10), 3).unwrap();
        assert_ne!(fs::read(folder.path().join(name)).unwrap(), b"mine");
    }
    assert_eq!(folder.files(), ["log.csv", "log.db", "log.txt"]);
}

#[test]
fn one_refused_place_leaves_all_untouched() {
    let folder = Folder::new("untouched");
    fs::write(folder.path().join("log.csv"), "mine").unwrap();
    let urls = ["sqlite:log.db", "casas:log.txt", "csv:log.csv"].map(|url| folder.url(url));
    assert!(stage::open(&urls, &LoggerFile::default(), false).is_err());
    assert_eq!(folder.files(), ["log.csv"]);
}

#[test]
fn distinguishes_impossible_places() {
    let folder = Folder::new("cannot");
    fs::create_dir(folder.path().join("folder")).unwrap();
    fs::write(folder.path().join("file"), "").unwrap();
    for scheme in ["sqlite", "csv", "casas"] {
        assert!(matches!(refused(&folder, &format!("{scheme}:folder"), true), LogError::IsFolder { .. }));
        assert!(matches!(refused(&folder, &format!("{scheme}:none/log"), true), LogError::NoFolder { .. }));
        assert!(matches!(refused(&folder, &format!("{scheme}:file/log"), true), LogError::NoFolder { .. }));
    }
    assert!(matches!(refused(&folder, "sqlite:/dev/null", true), LogError::NoFile { .. }));
    let urls = ["csv:log.csv", "casas:./folder/../log.csv"].map(|url| folder.url(url));
    assert!(matches!(stage::open(&urls, &LoggerFile::default(), true), Err(LogError::SameFile { .. })));
    assert_eq!(folder.files(), ["file", "folder"]);
}

#[cfg(unix)]
#[test]
fn a_folder_that_may_not_be_written_says_so() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new("denied");
    let closed = folder.path().join("closed");
    fs::create_dir(&closed).unwrap();
    fs::set_permissions(&closed, fs::Permissions::from_mode(0o555)).unwrap();
    if fs::write(closed.join("probe"), "").is_ok() {
        return eprintln!("skipped: whoever runs this test may write everywhere");
    }
    for scheme in ["sqlite", "csv", "casas"] {
        assert!(matches!(refused(&folder, &format!("{scheme}:closed/log"), false), LogError::Denied { .. }));
    }
}

#[test]
fn sensors_that_become_one_word_stay_apart() {
    let folder = Folder::new("one-word");
    let sensors = ["hall motion".to_string(), "HallMotion".to_string()];
    let open = |url: &str, sensors: &[String]| {
        stage::open_of(&[folder.url(url)], &LoggerFile::default(), sensors, WriteMode::Create)
    };
    assert!(open("csv:log.csv", &sensors).is_ok());
    assert!(matches!(open("casas:log.txt", &sensors), Err(LogError::SameSensor { .. })));
}

#[test]
fn a_run_given_up_leaves_no_half_files() {
    let folder = Folder::new("given-up");
    let urls = ["csv:log.csv", "casas:log.txt", "sqlite:log.db"].map(|url| folder.url(url));
    drop(stage::open(&urls, &LoggerFile::default(), false).unwrap());
    assert!(folder.files().is_empty(), "{:?}", folder.files());

    let mut logger = stage::open(&urls, &LoggerFile::default(), false).unwrap();
    logger.store(&stage::firings(10_000), RunTime::START + 1_000_000 * SECOND).unwrap();
    drop(logger);
    assert_eq!(folder.files(), ["log.db"], "a database keeps what it holds");
}

#[test]
fn a_file_that_comes_meanwhile_is_kept() {
    let folder = Folder::new("meanwhile");
    let logger = stage::open(&[folder.url("csv:log.csv")], &LoggerFile::default(), false).unwrap();
    fs::write(folder.path().join("log.csv"), "theirs").unwrap();
    let error = stage::store(logger, &stage::firings(10), 3).unwrap_err();
    assert!(matches!(error, LogError::Exists { .. }));
    assert_eq!(folder.text("log.csv"), "theirs");
    assert_eq!(folder.files(), ["log.csv"]);
}

/// Stores until an error comes, and looks whether it comes once.
fn fails_once(mut logger: Logger) -> LogError {
    let firings = stage::firings(200_000);
    let mut steps = firings.chunks(100);
    let error = loop {
        let step = steps.next().expect("an error before the end");
        if let Err(error) = logger.store(step, step[step.len() - 1].at + Span::MICROSECOND) {
            break error;
        }
    };
    let again = logger.store(&[], firings[firings.len() - 1].at).unwrap_err();
    assert!(matches!(again, LogError::Stopped { .. }));
    assert!(matches!(logger.finish(), Err(LogError::Stopped { .. })));
    error
}

#[cfg(target_os = "linux")]
#[test]
fn reports_a_full_disk_once() {
    let folder = Folder::new("full");
    for url in ["csv:/dev/full", "casas:/dev/full"] {
        let urls = [folder.url(url), folder.url("casas:log.txt")];
        let error = fails_once(stage::open(&urls, &LoggerFile::default(), false).unwrap());
        assert!(matches!(error, LogError::Full { .. }), "{error}");
        assert!(folder.files().is_empty(), "{:?}", folder.files());
    }
    assert!(fs::metadata("/dev/full").is_ok_and(|device| !device.is_file()), "a device stays what it is");
    let few = stage::open(&[folder.url("csv:/dev/full")], &LoggerFile::default(), false).unwrap();
    assert!(matches!(stage::store(few, &stage::firings(3), 1), Err(LogError::Full { .. })));
}

#[test]
fn reports_a_locked_database() {
    let folder = Folder::new("locked");
    let path = folder.path().join("log.db");
    let url = folder.url("sqlite:log.db");
    let logger = stage::open(std::slice::from_ref(&url), &LoggerFile::default(), false).unwrap();
    let other = Connection::open(&path).unwrap();
    other.execute_batch("BEGIN IMMEDIATE").unwrap();
    let replaced = stage::open(std::slice::from_ref(&url), &LoggerFile::default(), true);
    assert!(matches!(replaced, Err(LogError::Busy { .. })));
    let error = stage::store(logger, &stage::firings(3), 1).unwrap_err();
    assert!(matches!(error, LogError::Locked { .. }), "{error}");
    fs::write(&path, "").unwrap();
    let other = Connection::open(&path).unwrap();
    other.execute_batch("BEGIN IMMEDIATE").unwrap();
    let replaced = stage::open(std::slice::from_ref(&url), &LoggerFile::default(), true);
    assert!(matches!(replaced, Err(LogError::Locked { .. })));
}

#[test]
fn a_committed_row_stays_when_the_database_is_locked_later() {
    let folder = Folder::new("locked-later");
    let path = folder.path().join("log.db");
    let firings = stage::firings(10_000);
    let mut logger = stage::open(&[folder.url("sqlite:log.db")], &LoggerFile::default(), false).unwrap();
    logger.store(&firings, firings[9_999].at + Span::MICROSECOND).unwrap();
    let other = Connection::open(&path).unwrap();
    let count = || other.query_row("SELECT count(*) FROM firing", [], |row| row.get::<_, i64>(0)).unwrap();
    while count() == 0 {
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    let kept = count();
    other.execute_batch("BEGIN IMMEDIATE").unwrap();
    let length = firings[9_999].at.since_zero();
    let more: Vec<_> = firings.iter().map(|f| homebody_core::event::Firing { at: f.at + length, ..*f }).collect();
    let stored =
        logger.store(&more, RunTime::START + 3 * length).map(|_| ()).and_then(|()| logger.finish().map(|_| ()));
    assert!(matches!(stored, Err(LogError::Locked { .. })));
    other.execute_batch("COMMIT").unwrap();
    assert_eq!(count(), kept);
    assert!(path.exists());
}

#[test]
fn an_error_names_its_place() {
    let error = LogError::Exists { place: "runs/log.db".into() };
    let message = error.diagnostic();
    assert_eq!((message.code, &message.data["place"]), ("log::exists", &"runs/log.db".into()));
}
