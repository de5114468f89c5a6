//! Limits on requests that would keep the server busy.

use super::served::Served;
use serde_json::{Value, json};
use std::io::{Read, Write};
use std::net::TcpStream;
use std::sync::Arc;
use std::time::{Duration, Instant};
use std::{fs, thread};

#[test]
fn disconnects_endless_requests() {
    let served = Served::scenario("by-hand");
    let slow: Vec<TcpStream> = (0..40)
        .map(|number| {
            let mut stream = TcpStream::connect(served.address).unwrap();
            stream.set_read_timeout(Some(Duration::from_secs(30))).unwrap();
            // Some send nothing.
            if number % 2 == 0 {
                stream.write_all(format!("GET / HTTP/1.1\r\nHost: {}\r\n", served.address).as_bytes()).unwrap();
            }
            stream
        })
        .collect();
    assert_eq!(served.api("/api/runs").code, 200, "others are heard meanwhile");
    for mut stream in slow {
        let mut answer = Vec::new();
        // The server ends the connection by its own clock; a timeout of reading would be an error.
        stream.read_to_end(&mut answer).unwrap();
        assert!(!String::from_utf8_lossy(&answer).contains("200 OK"));
    }
}

#[test]
fn delays_wrong_tokens_only() {
    let served = Arc::new(Served::scenario("by-hand"));
    let begun = Instant::now();
    let guessing: Vec<_> = (0..8)
        .map(|thread| {
            let served = served.clone();
            thread::spawn(move || {
                for guess in 0..3 {
                    let wrong = format!("x-homebody-token: {:064x}\r\n", thread * 10 + guess);
                    assert_eq!(served.get("/api/runs", &wrong).code, 401);
                }
            })
        })
        .collect();
    let asked = Instant::now();
    assert_eq!(served.api("/api/runs").code, 200);
    let known = asked.elapsed();
    for guessing in guessing {
        guessing.join().unwrap();
    }
    // 24 guesses at ten a second.
    let all = begun.elapsed();
    assert!(all >= Duration::from_millis(2400), "{all:?}");
    assert!(known < all / 2, "who knows the token waits {known:?} of {all:?}");
}

/// A draft with as many actions a second as possible.
fn hasty(served: &Served) -> Value {
    let text = |name: &str| fs::read_to_string(served.file("by-hand", name)).unwrap();
    let path = json!({ "start": [0.6, 0.6], "steps": [{ "repeat": { "steps": [{ "wait": { "for_s": 0.011 } }] } }] });
    let visitor = text("visitor.json").replace(
        r#""driver": { "live": { "keys": "keys.json", "start": [0.6, 0.6] } }"#,
        r#""driver": { "path": "visitor.path.json" }"#,
    );
    json!({ "texts": {
        "scenario.json": text("scenario.json").replace("\"days\": 0.001", "\"days\": 30"),
        "visitor.json": visitor,
        "visitor.path.json": path.to_string(),
    } })
}

/// A client that disconnects cancels its simulation, so that the next one does not wait.
#[test]
fn abandoned_requests_are_not_simulated() {
    let served = Served::scenario("by-hand");
    let asked = json!({ "draft": hasty(&served), "from": 29, "days": 1, "without": [] }).to_string();
    for path in ["/api/month", "/api/rows"] {
        let asked = if path == "/api/rows" { hasty(&served).to_string() } else { asked.clone() };
        let head = format!(
            "POST {path} HTTP/1.1\r\nHost: {}\r\nx-homebody-token: {}\r\nContent-Type: application/json\r\nContent-Length: {}\r\n\r\n",
            served.address,
            served.token,
            asked.len()
        );
        let mut streams: Vec<TcpStream> = (0..20).map(|_| TcpStream::connect(served.address).unwrap()).collect();
        for stream in &mut streams {
            stream.write_all((head.clone() + asked.as_str()).as_bytes()).unwrap();
        }
        streams[0].set_read_timeout(Some(Duration::from_millis(500))).unwrap();
        assert!(streams[0].read(&mut [0; 1]).is_err(), "{path} takes longer than this test");
        drop(streams);
        let begun = Instant::now();
        let month = json!({ "draft": { "texts": {} }, "from": 0, "days": 1, "without": [] });
        let known = served.told("/api/month", &month);
        assert!(known["days"].as_array().is_some_and(|days| days.len() == 1), "{known}");
        // Twenty requests of five seconds each would take a hundred.
        assert!(begun.elapsed() < Duration::from_secs(20), "{path}: the next month waits for {:?}", begun.elapsed());
    }
}
