//! Text files: JSON Lines, which can be followed while they grow, and compressed texts.

use crate::alone::is_alone;
use crate::stage::texts::{carry, from_text, skipped, written};
use crate::stage::{self, Folder};
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::Span;
use homebody_log::{LogError, LogSource, Logger, Url, WriteMode, read, survey};
use std::fs;
use std::io::Write;
use std::time::Duration;

/// Kinds of texts that every build can pack, and those that only some can.
fn kinds() -> Vec<(&'static str, &'static str)> {
    let zstd = [("casas", "log.txt.zst"), ("csv", "log.csv.zst"), ("jsonl", "log.jsonl.zst")];
    let all = [("jsonl", "log.jsonl"), ("csv", "log.csv.gz"), ("jsonl", "log.jsonl.gz"), ("casas", "log.txt.gz")];
    all.into_iter().chain(zstd.into_iter().filter(|_| cfg!(feature = "zstd"))).collect()
}

fn open(url: &Url, how: WriteMode) -> Result<Logger, LogError> {
    stage::open_of(std::slice::from_ref(url), &LoggerFile::default(), &stage::sensors(), how)
}

#[test]
fn a_log_goes_through_all_texts_and_comes_back_the_same() {
    let folder = Folder::new("texts-round");
    let first = folder.url("csv:first.csv");
    let local = LoggerFile { time: homebody_core::scenario::logger::TimeFormat::Local, ..LoggerFile::default() };
    let logger = stage::open(std::slice::from_ref(&first), &local, false).unwrap();
    stage::store(logger, &stage::firings(3_000), 100).unwrap();
    let mut from = LogSource::from(&first);
    for (number, (kind, name)) in kinds().into_iter().enumerate() {
        let to = folder.url(&format!("{kind}:{number}-{name}"));
        assert_eq!(carry(&from, &to, "UTC", WriteMode::Create).unwrap(), 3_000, "{to}");
        // By what is in it, whatever it is called.
        from = LogSource::recognise(to.path()).unwrap();
        assert_eq!(from.form().name, kind, "{to}");
        let is_packed = !name.ends_with("jsonl");
        let bytes = fs::read(to.path()).unwrap();
        assert_eq!(bytes.starts_with(b"\x1f\x8b") || bytes.starts_with(b"\x28\xb5\x2f\xfd"), is_packed);
    }
    carry(&from, &folder.url("csv:last.csv"), "UTC", WriteMode::Create).unwrap();
    let rows = |name: &str| -> Vec<String> {
        folder.text(name).lines().map(|line| line.replace(' ', "").to_lowercase()).collect()
    };
    // In the form of CASAS names are single words.
    assert_eq!(rows("last.csv"), rows("first.csv"));
}

#[test]
fn activities_go_along_with_json_lines() {
    let folder = Folder::new("texts-activities");
    let rows = "time,sensor,value,activity\n2009-03-02 07:00:00,M1,ON,cooking\n2009-03-02 07:10:00,M2,ON,\n";
    let from = LogSource::recognise(&written(&folder, "labelled.csv", rows)).unwrap();
    for name in ["week.jsonl", "week.jsonl.gz"] {
        let to = folder.url(&format!("jsonl:{name}"));
        carry(&from, &to, "UTC", WriteMode::Create).unwrap();
        let back = read(&to, &LoggerFile::default()).unwrap();
        assert_eq!((back.rows, back.activities.len()), (2, 1), "{name}");
        assert_eq!(back.activities, read(&from, &LoggerFile::default()).unwrap().activities);
        assert!(back.problems.is_empty(), "{:?}", back.problems);
    }
    assert_eq!(
        folder.text("week.jsonl").lines().next().unwrap(),
        r#"{"seq":0,"fired_at":"2009-03-02 07:00:00.000000","sensor":"M1","value":"ON","activity":"cooking"}"#
    );
    let span =
        r#"{"start_time":"2009-03-02 07:00:00.000000","end_time":"2009-03-02 07:10:00.000000","activity":"cooking"}"#;
    assert_eq!(folder.text("week.activity.jsonl"), format!("{span}\n"));
}

#[test]
fn json_lines_can_be_followed_and_other_texts_have_their_names_once_they_are_whole() {
    let folder = Folder::new("texts-followed");
    let urls = ["jsonl:log.jsonl", "jsonl:log.jsonl.gz", "csv:log.csv"].map(|url| folder.url(url));
    let mut logger = stage::open(&urls, &LoggerFile::default(), false).unwrap();
    let named = || -> Vec<String> {
        folder.files().into_iter().filter(|name| !name.ends_with(".part") && !name.ends_with(".lock")).collect()
    };
    assert_eq!(named(), Vec::<String>::new(), "nothing has come");
    let firings = stage::firings(20);
    logger.store(&firings[..10], firings[10].at).unwrap();
    logger.make_durable().unwrap();
    logger.wait_durable().unwrap();
    assert_eq!(named(), ["log.jsonl"]);
    assert_eq!(folder.text("log.jsonl").lines().count(), 10);
    // Given up, what could be read stays, as in a database.
    drop(logger);
    assert_eq!(folder.files(), ["log.jsonl"]);
    assert!(matches!(open(&urls[0], WriteMode::Create), Err(LogError::Exists { .. })));
    stage::store(open(&urls[0], WriteMode::Resume).unwrap(), &firings, 3).unwrap();
    assert_eq!(folder.text("log.jsonl").lines().count(), 20);
    // A replaced file stays until the new one is whole.
    let anew = open(&urls[0], WriteMode::Overwrite).unwrap();
    assert_eq!(folder.text("log.jsonl").lines().count(), 20);
    stage::store(anew, &firings[..5], 3).unwrap();
    assert_eq!(folder.text("log.jsonl").lines().count(), 5);
}

/// The place for the child of the test below; its parent sets it.
const CHILD: &str = "HOMEBODY_TEST_TEXTS";

/// Stores rows until it is killed. Run as a test of its own it has nothing to do.
#[test]
fn child() {
    let Ok(url) = std::env::var(CHILD) else { return };
    let mut logger = open(&url.parse().unwrap(), WriteMode::Resume).unwrap();
    for step in stage::firings(20_000).chunks(50) {
        logger.store(step, step[step.len() - 1].at + Span::MICROSECOND).unwrap();
        std::thread::sleep(Duration::from_millis(1));
    }
    logger.finish().unwrap();
}

#[test]
fn text_files_of_a_killed_run_resume_to_the_same_bytes() {
    let folder = Folder::new("texts-killed");
    let kills = std::env::var("HOMEBODY_KILLS").ok().and_then(|kills| kills.parse().ok()).unwrap_or(3_u64);
    let firings = stage::firings(20_000);
    for (kind, name) in kinds() {
        let whole = folder.url(&format!("{kind}:whole-{name}"));
        stage::store(open(&whole, WriteMode::Create).unwrap(), &firings, 1_000).unwrap();
        for kill in 0..kills {
            let url = folder.url(&format!("{kind}:{kill}-{name}"));
            let mut child = stage::child("texts::child", CHILD, url.to_string());
            stage::wait_for(|| folder.files().iter().any(|file| file.starts_with(&format!("{kill}-{name}"))));
            std::thread::sleep(Duration::from_millis(kill * 7919 % 400));
            child.kill().unwrap();
            child.wait().unwrap();
            let is_followed = name.ends_with(".jsonl");
            assert!(is_followed || !url.path().exists(), "{url} has its name only when it is whole");
            if is_followed && url.path().exists() {
                let (left, all) = (fs::read(url.path()).unwrap(), fs::read(whole.path()).unwrap());
                assert!(all.starts_with(&left), "what is left is a beginning");
            }
            stage::store(open(&url, WriteMode::Resume).unwrap(), &firings, 77).unwrap();
            assert!(fs::read(url.path()).unwrap() == fs::read(whole.path()).unwrap(), "{url} after kill {kill}");
            // Whole, it is compared; the control: what was changed is not passed off as the run.
            stage::store(open(&url, WriteMode::Resume).unwrap(), &firings, 5_000).unwrap();
            let mut other = firings.clone();
            other[7].at += Span::MICROSECOND;
            let changed = stage::store(open(&url, WriteMode::Resume).unwrap(), &other, 5_000);
            assert!(matches!(changed, Err(LogError::Changed { .. })), "{url}");
            let shorter = stage::store(open(&url, WriteMode::Resume).unwrap(), &firings[..100], 5_000);
            assert!(matches!(shorter, Err(LogError::Changed { .. })), "{url}");
            assert!(fs::read(url.path()).unwrap() == fs::read(whole.path()).unwrap(), "{url} stays as it was");
        }
    }
    assert!(folder.files().iter().all(|name| !name.contains(".part")), "{:?}", folder.files());
}

#[test]
fn a_packed_text_that_is_cut_short_or_damaged_is_refused_by_its_name() {
    let folder = Folder::new("texts-cut");
    for (kind, name) in kinds().into_iter().filter(|(_, name)| !name.ends_with("jsonl")) {
        let url = folder.url(&format!("{kind}:{name}"));
        stage::store(open(&url, WriteMode::Create).unwrap(), &stage::firings(2_000), 500).unwrap();
        let whole = fs::read(url.path()).unwrap();
        for length in [whole.len() / 2, whole.len() - 5, 20] {
            fs::write(url.path(), &whole[..length]).unwrap();
            let read = LogSource::recognise(url.path()).and_then(|source| read(&source, &LoggerFile::default()));
            let said = read.expect_err("it is cut short").to_string();
            assert!(said.contains(name) && said.contains("damaged or cut short"), "{said}");
        }
        let mut damaged = whole.clone();
        let middle = damaged.len() / 2;
        damaged[middle..middle + 20].fill(0xa5);
        fs::write(url.path(), damaged).unwrap();
        let read = LogSource::recognise(url.path()).and_then(|source| read(&source, &LoggerFile::default()));
        assert!(read.is_err(), "{name}");
    }
}

/// A few kilobytes that unpack to very much: a line of it is refused, and lines are streamed.
#[test]
fn a_text_that_unpacks_to_very_much_takes_little_memory() {
    if !is_alone("texts::a_text_that_unpacks_to_very_much_takes_little_memory", &[]) {
        return;
    }
    let folder = Folder::new("texts-bomb");
    let packed = |name: &str, chunk: &[u8], times: usize| {
        let file = fs::File::create(folder.path().join(name)).unwrap();
        let mut packer = flate2::write::GzEncoder::new(file, flate2::Compression::new(6));
        packer.write_all(b"time,sensor,value\n2009-03-02 07:12:03,M1,ON\n").unwrap();
        (0..times).for_each(|_| packer.write_all(chunk).unwrap());
        packer.finish().unwrap();
        folder.path().join(name)
    };
    let line = packed("line.csv.gz", &[b'x'; 1 << 20], 300);
    assert!(fs::metadata(&line).unwrap().len() < 400_000);
    let said = read(LogSource::recognise(&line).unwrap(), &LoggerFile::default()).unwrap_err();
    assert!(matches!(said, LogError::TooLong { .. }), "{said}");
    let rows = packed("rows.csv.gz", &b"2009-03-02 07:12:03,M1,ON\n".repeat(10_000), 200);
    let log = survey(LogSource::recognise(&rows).unwrap(), &LoggerFile::default()).unwrap();
    assert_eq!((log.rows, log.events.len()), (2_000_001, 0));
    #[cfg(target_os = "linux")]
    {
        let status = fs::read_to_string("/proc/self/status").unwrap();
        let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap();
        let peak_kib: u64 = peak.trim().trim_end_matches(" kB").parse().unwrap();
        assert!(peak_kib < 150_000, "{peak_kib} KiB");
    }
}

#[test]
fn odd_lines_of_json_are_named_and_cost_no_other() {
    let folder = Folder::new("texts-odd");
    let lines = [
        r#"{"time": "2009-03-02T07:12:03Z", "sensor": "hall", "value": "ON"}"#,
        r#"{"time": 1235977924.5, "sensor": "hall", "value": 21.5}"#,
        "nonsense",
        r#"["a list"]"#,
        r#"{"value": true, "sensor": 7, "time": "2009-03-02T07:12:05Z"}"#,
        r#"{"time": null, "sensor": "hall", "value": "ON"}"#,
        r#"{"time": 12, "sensor": "hall", "value": "ON"}"#,
        r#"{"other": 1}"#,
        "",
        r#"{"time": "2009-03-02T07:12:06Z", "sensor": "hall", "value": null}"#,
        r#"{"time": "2009-03-02T07:12:07Z", "sensor": "h\u00e4ll", "value": {"a": [1]}}"#,
    ];
    let log = from_text(&folder, "jsonl", "log.jsonl", &lines.join("\n"));
    let told: Vec<(&str, &str)> = log.events.iter().map(|event| (log.sensor(event), log.value(event))).collect();
    assert_eq!(told, [("hall", "ON"), ("hall", "21.5"), ("7", "true"), ("häll", r#"{"a":[1]}"#)]);
    assert_eq!(skipped(&log), [3, 4, 6, 7, 8, 10]);
}
