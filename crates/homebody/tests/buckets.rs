//! The command and a bucket of S3: a run writes to it day by day, resumes after a kill, and is checked, read, labelled and refused; a
//! cohort writes member by member.
//!
//! The tests need a build with the feature `cloud` and the server of moto: `moto_server` on the `PATH`, or the path in `HOMEBODY_MOTO`.
#![cfg(all(unix, feature = "cloud"))]
#![allow(dead_code, reason = "what tests of several programs share is used in part by each")]

#[path = "command/flat.rs"]
mod flat;
#[path = "command/folder.rs"]
mod folder;

use flat::flat;
use folder::{Done, Folder};
use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

const SECRET: &str = "s3cr3t-canary";

/// A server that speaks S3, which ends with the test.
struct Store {
    server: Child,
    port: u16,
}

impl Drop for Store {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

impl Store {
    fn start() -> Option<Store> {
        let program = std::env::var("HOMEBODY_MOTO").unwrap_or_else(|_| "moto_server".into());
        let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
        let mut command = Command::new(&program);
        command.args(["-H", "127.0.0.1", "-p", &port.to_string()]).stdout(Stdio::null()).stderr(Stdio::null());
        let Ok(server) = command.spawn() else {
            println!("skipped: there is no {program}, as pip install 'moto[server]' brings it");
            return None;
        };
        let store = Store { server, port };
        let begun = Instant::now();
        while TcpStream::connect(("127.0.0.1", port)).is_err() {
            assert!(begun.elapsed() < Duration::from_secs(60), "the store begins");
            std::thread::sleep(Duration::from_millis(50));
        }
        let answer = store.ask("PUT", "/bucket");
        assert!(answer.starts_with("HTTP/1.1 200"), "{answer}");
        Some(store)
    }

    fn ask(&self, method: &str, path: &str) -> String {
        String::from_utf8_lossy(&self.bytes(method, path)).into_owned()
    }

    fn bytes(&self, method: &str, path: &str) -> Vec<u8> {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        // The store accepts any credentials.
        let head = format!(
            "{method} {path} HTTP/1.1\r\nHost: 127.0.0.1\r\nAuthorization: AWS ann:signed\r\nContent-Length: 0\r\n\
            Connection: close\r\n\r\n"
        );
        stream.write_all(head.as_bytes()).unwrap();
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).unwrap();
        answer
    }

    /// Number of files below a name.
    fn files(&self, below: &str) -> usize {
        self.ask("GET", &format!("/bucket?list-type=2&prefix={below}")).matches("<Key>").count()
    }

    fn command(&self, folder: &Folder, words: &str) -> Command {
        let mut command = folder.command(words);
        command.env("AWS_ENDPOINT", format!("http://127.0.0.1:{}", self.port)).env("AWS_REGION", "us-east-1");
        command.env("AWS_ACCESS_KEY_ID", "ann").env("AWS_SECRET_ACCESS_KEY", SECRET);
        command
    }

    fn run(&self, folder: &Folder, words: &str) -> Done {
        let done = Done::new(words, self.command(folder, words).output().unwrap());
        assert!(!done.out.contains(SECRET) && !done.err.contains(SECRET), "{}{}", done.out, done.err);
        done
    }
}

#[test]
fn a_run_goes_into_a_bucket_and_comes_back() {
    let Some(store) = Store::start() else { return };
    let folder = flat();
    let run = "run flat --for 3d --quiet --out parquet:s3://bucket/lives --truth truth.db";
    store.run(&folder, run).ok();
    assert_eq!(store.files("lives/"), 4, "a file for each date: three days from 08:00 on");
    folder.run("run flat --for 3d --quiet --out parquet:lives").ok();
    let said = |of: &str| {
        store.run(&folder, &format!("convert {of} --out csv:read.csv --force")).ok();
        folder.sha256("read.csv")
    };
    assert_eq!(said("parquet:s3://bucket/lives"), said("parquet:lives"));
    store.run(&folder, "doctor parquet:s3://bucket/lives").ok();
    store.run(&folder, "inspect parquet:s3://bucket/lives").ok();
    store.run(&folder, "label parquet:s3://bucket/lives truth.db --out csv:labelled.csv").ok();
    // Existing files are refused, and replaced on request.
    store.run(&folder, &run.replace("truth.db", "other.db")).fails(1, "--force");
    store.run(&folder, &format!("{run} --force")).ok();
    assert_eq!(said("parquet:s3://bucket/lives"), said("parquet:lives"));
    // A missing run, bucket or store is reported.
    store.run(&folder, "inspect parquet:s3://bucket/nowhere").fails(1, "parquet:s3://bucket/nowhere");
    store
        .run(&folder, &run.replace("bucket", "no-such-bucket").replace("truth.db", "none.db"))
        .fails(1, "error[object-store::not-found]");
    let port = store.port;
    drop(store);
    let words = run.replace("truth.db", "third.db");
    let mut command = folder.command(&words);
    command.env("AWS_ENDPOINT", format!("http://127.0.0.1:{port}")).env("AWS_REGION", "us-east-1");
    command.env("AWS_ACCESS_KEY_ID", "ann").env("AWS_SECRET_ACCESS_KEY", SECRET);
    Done::new(&words, command.output().unwrap()).fails(1, "error[object-store::no-answer]");
}

#[test]
fn a_killed_run_is_gone_on_with_in_a_bucket() {
    let Some(store) = Store::start() else { return };
    let folder = flat();
    std::fs::create_dir(folder.path("died")).unwrap();
    let words = "run flat --for 20d --quiet --out parquet:s3://bucket/died --recording died/recording.json --truth died/truth.db";
    let mut child = store.command(&folder, words).spawn().unwrap();
    let begun = Instant::now();
    while store.files("died/") < 2 {
        assert!(begun.elapsed() < Duration::from_secs(60), "whole days are there");
        std::thread::sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let there = store.files("died/");
    assert!(there < 20, "it was killed on the way: {there}");
    store.run(&folder, "run --resume died --quiet --out parquet:s3://bucket/died").ok();
    assert_eq!(store.files("died/"), 21, "a file for each date");
    store.run(&folder, "replay died/recording.json --out csv:again.csv").ok();
    store.run(&folder, "convert parquet:s3://bucket/died --out csv:read.csv").ok();
    let rows = |name: &str| folder.read(name).lines().count();
    assert_eq!(rows("read.csv"), rows("again.csv"));
}

/// All files below a folder, with what they hold.
fn held(folder: &Folder, below: &str) -> Vec<(String, Vec<u8>)> {
    let bytes = |name: String| Some((name.strip_prefix(below)?.to_owned(), std::fs::read(folder.path(&name)).unwrap()));
    folder.files().into_iter().filter_map(bytes).collect()
}

#[test]
fn a_cohort_goes_into_a_bucket_as_into_a_folder_and_goes_on_there() {
    let Some(store) = Store::start() else { return };
    let folder = Folder::new();
    folder.copy_scenario("studio");
    let run = "run studio --members 6 --for 2d --quiet --out parquet:";
    folder.run(&format!("{run}cohort")).ok();
    let here = held(&folder, "cohort/");
    store.run(&folder, &format!("{run}s3://bucket/whole")).ok();
    let same = |below: &str| {
        let body = |answer: Vec<u8>| {
            let head = answer.windows(4).position(|end| end == b"\r\n\r\n").map_or(0, |head| head + 4);
            answer[head..].to_vec()
        };
        for (name, bytes) in &here {
            let there = body(store.bytes("GET", &format!("/bucket/{below}/{}", name.replace('=', "%3D"))));
            assert!(there == *bytes, "{below}: {name} has {} bytes, and {} here", there.len(), bytes.len());
        }
        assert_eq!(store.files(&format!("{below}/")), here.len(), "{below} has no file besides");
    };
    same("whole");
    // Nothing is replaced, and a complete run is not resumed.
    store.run(&folder, &format!("{run}s3://bucket/whole")).fails(1, "a cohort was begun there");
    store.run(&folder, "run --resume s3://bucket/whole").fails(2, "is complete");
    store.run(&folder, "run --resume s3://bucket/nowhere").fails(1, "kit::no-recording");
    // A killed cohort has complete members, and resumes to the same bytes.
    let mut child = store.command(&folder, &format!("{run}s3://bucket/died")).spawn().unwrap();
    let begun = Instant::now();
    while store.files("died/members/") < 2 {
        assert!(begun.elapsed() < Duration::from_secs(60), "a member is there");
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(store.files("died/") < here.len(), "it was killed on its way");
    store.run(&folder, "run --resume parquet:s3://bucket/died").ok();
    same("died");
}
