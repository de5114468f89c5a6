//! Large requests, logs and slow browsers do not use up the server's memory. It is a program of its own, because memory belongs to a whole
//! program.
//!
//! `HOMEBODY_STUCK_S=600 cargo test -p homebody-web --test memory -- --nocapture` has a browser stuck for ten minutes.
#![cfg(target_os = "linux")]

#[expect(dead_code, reason = "other tests use more of it")]
#[path = "server/served.rs"]
mod served;

use homebody_core::event::Events;
use homebody_core::recording::{Recording, RunDigest};
use homebody_core::time::RunTime;
use homebody_routine::household::Household;
use served::Served;
use std::io::{Read, Write};
use std::net::TcpStream;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use std::{fs, thread};

/// Growth that counts as none.
const MOST_KB: u64 = 16 << 10;

fn memory_kb() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find(|line| line.starts_with("VmRSS:")).unwrap();
    line.split_whitespace().nth(1).unwrap().parse().unwrap()
}

#[test]
fn bounds_memory_under_excessive_requests() {
    huge_bodies();
    long_logs();
    late_months();
    hasty_months();
    stuck_browsers();
}

/// 100 MB are refused, with or without an announced length.
fn huge_bodies() {
    let served = Served::scenario("by-hand");
    // The allocator keeps the memory of one body for this program; further bodies must not take more.
    send_huge_bodies(&served);
    let before = memory_kb();
    send_huge_bodies(&served);
    let growth = memory_kb().saturating_sub(before);
    println!("memory grows by {growth} kB over seven more bodies of 100 MB");
    assert!(growth < MOST_KB, "{growth} kB");
}

fn send_huge_bodies(served: &Served) {
    let part = vec![b' '; 1 << 20];
    let chunk = [format!("{:x}\r\n", part.len()).as_bytes(), &part, b"\r\n"].concat();
    for route in ["/api/files", "/api/check", "/api/plan", "/api/import"] {
        // A plan with models and textures may be large: without its length, the server reads 64 MB before it refuses the rest.
        let ways: &[bool] = if route == "/api/import" { &[true] } else { &[true, false] };
        for &is_told in ways {
            let mut stream = TcpStream::connect(served.address).unwrap();
            stream.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
            let length = if is_told { "Content-Length: 104857600" } else { "Transfer-Encoding: chunked" };
            let head = format!(
                "POST {route} HTTP/1.1\r\nHost: {}\r\nx-homebody-token: {}\r\nContent-Type: application/json\r\n{length}\r\n\r\n",
                served.address, served.token
            );
            stream.write_all(head.as_bytes()).unwrap();
            let piece = if is_told { &part } else { &chunk };
            // The rest of the bytes is in the buffers of the sockets.
            let sent = (0..100).take_while(|_| stream.write_all(piece).is_ok()).count();
            assert!(sent < 40, "{route} takes {sent} MB");
            let mut answer = [0; 64];
            let length = stream.read(&mut answer).unwrap_or(0);
            let answer = String::from_utf8_lossy(&answer[..length]);
            // A server that closes during a write may lose the answer.
            assert!(answer.starts_with("HTTP/1.1 413") || answer.is_empty() && !is_told, "{route}: {answer:?}");
        }
    }
}

/// The rows of an open run's log are on disk, so that two million take no more memory than a few.
fn long_logs() {
    const ROWS: u64 = 2_000_000;
    let served = Served::scenario("tigerplace");
    let mut page = served.page();
    page.say(r#"{"say":"speed","times":1000}"#);
    page.say(r#"{"say":"play"}"#);
    page.until(|frame| frame["told"].as_u64().is_some_and(|told| told > 0));
    page.say(r#"{"say":"stop"}"#);
    page.until(|frame| frame["state"] == "over");
    let run = served.only_run();
    let log = rusqlite::Connection::open(run.join("log.db")).unwrap();
    let more = "WITH RECURSIVE more(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM more WHERE n < ?)
        INSERT INTO event SELECT run_id, seq + n, ts_local, sensor_id, event_code
        FROM (SELECT * FROM event ORDER BY seq DESC LIMIT 1), more";
    log.execute(more, [ROWS as i64]).unwrap();
    drop(log);

    let (before, begun) = (memory_kb(), Instant::now());
    let path = format!("/api/runs/{}", run.file_name().unwrap().to_str().unwrap());
    let asked = |path: &str| -> serde_json::Value {
        let answer = served.api(path);
        assert_eq!(answer.code, 200, "{path}: {}", String::from_utf8_lossy(&answer.body));
        serde_json::from_slice(&answer.body).unwrap()
    };
    asked(&path);
    while !asked(&format!("{path}/reading"))["read_us"].is_null() {
        thread::sleep(Duration::from_millis(100));
    }
    let growth = memory_kb().saturating_sub(before);
    println!("memory grows by {growth} kB over a log of {ROWS} rows, in {:?}", begun.elapsed());
    let hours = asked(&path)["hours"].clone();
    let rows: u64 = hours
        .as_array()
        .unwrap()
        .iter()
        .flat_map(|day| day.as_array().unwrap())
        .filter_map(|count| count.as_u64())
        .sum();
    assert!(rows > ROWS, "{rows}");
    assert!(growth < MOST_KB, "{growth} kB");
}

/// Only the last days of two hundred are in the answer.
fn late_months() {
    let served = Served::scenario("tigerplace");
    let text = fs::read_to_string(served.folder.path().join("tigerplace/scenario.json")).unwrap();
    let month = |from: u32| {
        let draft = serde_json::json!({ "texts": { "scenario.json": text.replace("\"days\": 90", "\"days\": 200") } });
        let asked = serde_json::json!({ "draft": draft, "from": from, "days": 5, "without": [] }).to_string();
        let head = format!(
            "POST /api/month HTTP/1.1\r\nHost: {}\r\nConnection: close\r\nx-homebody-token: {}\r\nContent-Type: application/json\r\nContent-Length: {}\r\n\r\n",
            served.address,
            served.token,
            asked.len()
        );
        let answer = served.ask((head + asked.as_str()).as_bytes());
        assert!(answer.code == 200 && answer.body.len() > 10_000, "{}", answer.code);
    };
    month(0);
    let before = memory_kb();
    month(195);
    let growth = memory_kb().saturating_sub(before);
    println!("memory grows by {growth} kB over a late month");
    assert!(growth < MOST_KB, "{growth} kB");
}

/// The answer has a part of the actions of a person with a million in a second, and says where it ends.
fn hasty_months() {
    let served = Served::scenario("by-hand");
    let text = |name: &str| fs::read_to_string(served.folder.path().join("by-hand").join(name)).unwrap();
    let keys = r#""driver": { "live": { "keys": "keys.json", "start": [0.6, 0.6] } }"#;
    let draft = serde_json::json!({ "texts": {
        "scenario.json": text("scenario.json").replace("\"days\": 0.001", "\"days\": 30"),
        "visitor.json": text("visitor.json").replace(keys, r#""driver": { "path": "visitor.path.json" }"#),
        "visitor.path.json": r#"{"start":[0.6,0.6],"steps":[{"repeat":{"steps":[{"wait":{"for_s":0.011}}]}}]}"#,
    } });
    let month = serde_json::json!({ "draft": draft, "from": 24, "days": 5, "without": [] });
    for (path, asked) in [("/api/month", month), ("/api/rows", draft)] {
        let asked = asked.to_string();
        let head = format!(
            "POST {path} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\nx-homebody-token: {}\r\nContent-Type: application/json\r\nContent-Length: {}\r\n\r\n",
            served.address,
            served.token,
            asked.len()
        );
        let (before, begun) = (memory_kb(), Instant::now());
        let answer = served.ask((head + asked.as_str()).as_bytes());
        let growth = memory_kb().saturating_sub(before);
        println!("memory grows by {growth} kB over {path} of a hasty life, in {:?}", begun.elapsed());
        assert_eq!(answer.code, 200, "after {:?}", begun.elapsed());
        let said = String::from_utf8_lossy(&answer.body);
        // The first rows need three simulated days at most.
        assert!(path == "/api/rows" || said.contains("The simulation stopped here after"), "{said}");
        assert!(growth < 4 * MOST_KB, "{growth} kB");
    }
}

/// A page that reads a message a second delays neither the run nor another page, and takes no memory.
fn stuck_browsers() {
    let wished = std::env::var("HOMEBODY_STUCK_S").ok().and_then(|text| text.parse().ok());
    let length = Duration::from_secs(wished.unwrap_or(6));
    let mut served = Served::scenario("tigerplace");
    let done = Arc::new(AtomicBool::new(false));
    let mut stuck = served.page();
    let is_done = done.clone();
    let reader = thread::spawn(move || {
        while !is_done.load(Ordering::Relaxed) {
            stuck.hear();
            thread::sleep(Duration::from_secs(1));
        }
    });
    let mut page = served.page();
    page.say(r#"{"say":"speed","times":1000}"#);
    page.say(r#"{"say":"play"}"#);
    let warm = Instant::now();
    while warm.elapsed() < Duration::from_secs(2) {
        page.until(|_| true);
    }
    let before = memory_kb();
    let (begun, mut last) = (Instant::now(), Instant::now());
    let mut gaps = Vec::new();
    while begun.elapsed() < length {
        page.until(|_| true);
        gaps.push(last.elapsed());
        last = Instant::now();
    }
    let growth = memory_kb().saturating_sub(before);
    page.say(r#"{"say":"stop"}"#);
    let frame = page.until(|frame| frame["state"] == "over").frame;
    done.store(true, Ordering::Relaxed);
    reader.join().unwrap();
    gaps.sort();
    let p99 = gaps[gaps.len() * 99 / 100];
    println!("{} frames in {length:?}, p99 of their gaps {p99:?}; memory grows by {growth} kB", gaps.len());
    assert!(growth < MOST_KB, "{growth} kB");
    assert!(gaps.len() as u64 > 5 * length.as_secs(), "the other page sees {} frames in {length:?}", gaps.len());
    served.close();

    // The log equals that of the same run without pages.
    let run = served.only_run();
    let recording: Recording = serde_json::from_str(&fs::read_to_string(run.join("recording.json")).unwrap()).unwrap();
    let (scenario, household) = Household::recorded(&recording).unwrap();
    let mut alone = recording.run(&scenario, &household);
    let (mut events, mut digest) = (Events::default(), RunDigest::default());
    alone.advance(RunTime::START + recording.length_us, &mut events).unwrap();
    digest.add(&events.firings);
    assert_eq!((digest.firings(), digest.hex()), (recording.firings, recording.sha256));
    let log = rusqlite::Connection::open(run.join("log.db")).unwrap();
    let rows: i64 = log.query_row("SELECT count(*) FROM event", [], |row| row.get(0)).unwrap();
    assert_eq!((rows, rows as u64), (frame["told"].as_i64().unwrap(), recording.firings));
}
