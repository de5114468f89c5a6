//! Data sets in an object store: the store returns what was written, also after the program died, and replaces nothing without `--force`.
//!
//! Each is tried with a store in a folder. With a server that speaks S3 it is tried again: moto's, where `moto_server` is on the `PATH` or
//! `HOMEBODY_MOTO` names it.

#[path = "../../homebody-log/tests/stage/mod.rs"]
mod stage;

use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::{Span, WallTime};
use homebody_log::examine::{CheckOptions, CheckVerdict, examine};
use homebody_log::registry::{Registry, install};
use homebody_log::{Log, LogError, Logger, Url, WriteMode, read};
use stage::Folder;
use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// So many rows are some weeks.
const ROWS: u64 = 200_000;

fn told(log: &Log) -> Vec<(WallTime, String, String)> {
    log.events.iter().map(|event| (event.at, log.sensor(event).to_owned(), log.value(event).to_owned())).collect()
}

fn open(url: &Url, how: WriteMode) -> Result<Logger, LogError> {
    stage::open_of(std::slice::from_ref(url), &LoggerFile::default(), &stage::sensors(), how)
}

/// All that is promised of a store, tried in one below this URL.
fn tried(base: &str, folder: &Folder) {
    install(Registry::new(vec![homebody_arrow::PLUGIN]));
    let at = |name: &str| format!("parquet:{base}/{name}").parse::<Url>().unwrap();
    let beside = folder.url("parquet:beside");
    let firings = stage::firings(ROWS);
    stage::store(open(&beside, WriteMode::Create).unwrap(), &firings, 900).unwrap();
    let wanted = told(&read(&beside, &LoggerFile::default()).unwrap());
    assert_eq!(wanted.len() as u64, ROWS);
    let lives = at("lives");
    stage::store(open(&lives, WriteMode::Create).unwrap(), &firings, 900).unwrap();
    let same =
        |url: &Url| assert!(told(&read(url, &LoggerFile::default()).unwrap()) == wanted, "{url} tells another log");
    same(&lives);
    // An existing run is refused, and replaced on request; fewer days then.
    assert!(matches!(open(&lives, WriteMode::Create), Err(LogError::Exists { .. })));
    stage::store(open(&lives, WriteMode::Overwrite).unwrap(), &firings[..3000], 900).unwrap();
    assert_eq!(told(&read(&lives, &LoggerFile::default()).unwrap()), wanted[..3000]);
    // A run that died has its whole days there, and resumes to the same rows.
    let died = at("died");
    let mut logger = open(&died, WriteMode::Create).unwrap();
    for step in firings[..150_000].chunks(900) {
        logger.store(step, step[step.len() - 1].at + Span::MICROSECOND).unwrap();
    }
    logger.make_durable().unwrap();
    logger.wait_durable().unwrap();
    drop(logger);
    let there = told(&read(&died, &LoggerFile::default()).unwrap());
    assert!(there.len() > 1000 && there[..] == wanted[..there.len()], "{} rows are there", there.len());
    stage::store(open(&died, WriteMode::Resume).unwrap(), &firings, 900).unwrap();
    same(&died);
    // The checks find it whole, and report a missing one.
    let asked = CheckOptions { mapping: &LoggerFile::default(), may_write: false };
    let checks = examine(&died, &asked).unwrap();
    assert!(!checks.is_empty() && checks.iter().all(|check| check.verdict == CheckVerdict::Ok), "{checks:?}");
    let checks = examine(&at("nowhere"), &asked).unwrap();
    assert!(checks.iter().any(|check| check.verdict == CheckVerdict::Wrong), "{checks:?}");
    assert!(read(&at("nowhere"), &LoggerFile::default()).is_err());
}

#[test]
fn a_store_in_a_folder_keeps_what_it_gets() {
    let folder = Folder::new("store");
    std::fs::create_dir(folder.path().join("bucket")).unwrap();
    tried(&format!("file://{}", folder.path().join("bucket").display()), &folder);
    let refused = |url: &str| match open(&url.parse().unwrap(), WriteMode::Create) {
        Err(LogError::NoPlace(why)) => why.to_string(),
        Err(error) => panic!("{url}: {error}"),
        Ok(_) => panic!("{url} is opened"),
    };
    assert!(refused("parquet:gs://bucket/lives").contains("not a kind of store"));
}

/// The child's store; the parent sets it, with the child's credentials.
const CHILD: &str = "HOMEBODY_TEST_STORE";

/// The child. Run as a test of its own it has nothing to do.
#[test]
fn child() {
    let Ok(what) = std::env::var(CHILD) else { return };
    install(Registry::new(vec![homebody_arrow::PLUGIN]));
    match what.as_str() {
        "away" => {
            let begun = Instant::now();
            let error = open(&"parquet:s3://bucket/lives".parse().unwrap(), WriteMode::Create).err().unwrap();
            assert_eq!(error.code(), "object-store::no-answer", "{error}");
            assert!(!error.to_string().contains("s3cr3t-canary"), "{error}");
            assert!(begun.elapsed() < Duration::from_secs(10), "{:?}", begun.elapsed());
        }
        "nobody" => {
            let error = open(&"parquet:s3://no-such-bucket/lives".parse().unwrap(), WriteMode::Create).err().unwrap();
            assert_eq!(error.code(), "object-store::not-found", "{error}");
        }
        what => tried(what, &Folder::new("store-s3")),
    }
}

fn as_child(what: &str, port: u16) {
    let mut command = Command::new(std::env::current_exe().unwrap());
    command.args(["child", "--exact", "--nocapture"]).env(CHILD, what);
    command.env("AWS_ENDPOINT", format!("http://127.0.0.1:{port}")).env("AWS_REGION", "us-east-1");
    command.env("AWS_ACCESS_KEY_ID", "ann").env("AWS_SECRET_ACCESS_KEY", "s3cr3t-canary");
    let done = command.output().unwrap();
    let said = String::from_utf8_lossy(&done.stdout).into_owned() + &String::from_utf8_lossy(&done.stderr);
    assert!(done.status.success(), "{what}: {said}");
    assert!(!said.contains("s3cr3t-canary"), "{said}");
}

#[test]
fn reports_an_absent_store_soon() {
    let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
    as_child("away", port);
}

struct Server(Child);

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[test]
fn a_server_of_s3_keeps_what_it_gets() {
    let program = std::env::var("HOMEBODY_MOTO").unwrap_or_else(|_| "moto_server".into());
    let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
    let started = Command::new(&program)
        .args(["-H", "127.0.0.1", "-p", &port.to_string()])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn();
    let Ok(server) = started else {
        println!("skipped: there is no {program}, as pip install 'moto[server]' brings it");
        return;
    };
    let _server = Server(server);
    let begun = Instant::now();
    let mut stream = loop {
        match TcpStream::connect(("127.0.0.1", port)) {
            Ok(stream) => break stream,
            Err(why) => assert!(begun.elapsed() < Duration::from_secs(60), "{why}"),
        }
        std::thread::sleep(Duration::from_millis(50));
    };
    let head =
        format!("PUT /bucket HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nContent-Length: 0\r\nConnection: close\r\n\r\n");
    stream.write_all(head.as_bytes()).unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    assert!(answer.starts_with("HTTP/1.1 200"), "{answer}");
    as_child("s3://bucket/some/where", port);
    as_child("nobody", port);
}
