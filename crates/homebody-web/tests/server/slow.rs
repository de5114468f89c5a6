//! Clients hold connections of the server and do nothing with them, while a user controls a resident in the page.
//!
//! `HOMEBODY_SLOW_S=60 cargo test --release -p homebody-web --test all server::slow -- --nocapture` has a minute of each kind.

use super::served::{Page, Served};
use serde_json::Value;
use std::io::{ErrorKind, Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

/// More connections of a kind than places for strangers.
const CLIENTS: usize = 300;

/// The time from a key to its picture.
const MOST: Duration = Duration::from_millis(100);

/// A kind of slow client.
struct Kind {
    name: &'static str,
    /// The first bytes, sent again each second.
    opening: Vec<u8>,
    drip: Vec<u8>,
    /// Whether the client reads answers.
    reads: bool,
}

fn kinds(served: &Served) -> Vec<Kind> {
    let address = served.address;
    let get = |path: &str, more: &str| format!("GET {path} HTTP/1.1\r\nHost: {address}\r\n{more}").into_bytes();
    let beginning = String::from_utf8(served.get("/", "").body).unwrap();
    let asset = beginning.split('"').find(|part| part.contains("assets/") && part.ends_with(".js"));
    let asset = get(&format!("/{}", asset.unwrap_or("").trim_start_matches(['.', '/'])), "\r\n");
    let socket = format!(
        "Origin: http://{address}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n\
         Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
    );
    let body = format!("POST /api/check HTTP/1.1\r\nHost: {address}\r\nContent-Length: 1000\r\n\r\n{{");
    let kind = |name, opening, drip: &[u8], reads| Kind { name, opening, drip: drip.to_vec(), reads };
    vec![
        kind("ask and never read", asset.repeat(200), &asset, false),
        kind("never end a head", get("/", ""), b"X-More: more\r\n", true),
        kind("never end a body", body.into_bytes(), b" ", true),
        kind("say no hello", get("/api/live", &socket), b"", true),
        kind("guess the token", get("/api/runs", &format!("x-homebody-token: {}\r\n\r\n", "0".repeat(64))), b"", true),
    ]
}

impl Kind {
    /// Connects, and begins.
    fn connect(&self, address: SocketAddr) -> Option<TcpStream> {
        let mut stream = TcpStream::connect(address).ok()?;
        stream.set_nonblocking(true).ok()?;
        // Bytes that are not sent at once are not needed.
        let _ = stream.write(&self.opening);
        Some(stream)
    }

    /// Whether the connection is open.
    fn holds(&self, mut stream: &TcpStream, drips: bool) -> bool {
        let is_open = |done: std::io::Result<usize>| match done {
            Ok(length) => length > 0,
            Err(error) => error.kind() == ErrorKind::WouldBlock,
        };
        (!drips || self.drip.is_empty() || is_open(stream.write(&self.drip)))
            && (!self.reads || is_open(stream.read(&mut [0; 4096])))
    }

    /// Keeps all connections, and replaces those that the server closes.
    fn keep(&self, address: SocketAddr, is_over: &AtomicBool, connected: &AtomicUsize) {
        let mut clients: Vec<Option<TcpStream>> = (0..CLIENTS).map(|_| None).collect();
        for turn in 0.. {
            for client in &mut clients {
                if client.as_ref().is_none_or(|stream| !self.holds(stream, turn % 10 == 9)) {
                    *client = self.connect(address);
                    connected.fetch_add(1, Ordering::Relaxed);
                }
                if is_over.load(Ordering::Relaxed) {
                    return;
                }
            }
            thread::sleep(Duration::from_millis(100));
        }
    }
}

/// The place of the resident in the next picture.
fn next_x(page: &mut Page) -> f64 {
    let x = |frame: &Value| frame["bodies"][0]["at"][0].as_f64();
    x(&page.until(|frame| x(frame).is_some()).frame).unwrap()
}

/// A page with a running run and its first resident under manual control.
fn driven(served: &Served) -> Page {
    let mut page = served.page();
    page.say(r#"{"say":"start","driven":0}"#);
    page.say(r#"{"say":"play"}"#);
    page.until(|frame| frame["state"] == "playing");
    page
}

/// The time from each key to the first picture with its effect.
fn keys_to_pictures(page: &mut Page, length: Duration) -> Vec<Duration> {
    let begun = Instant::now();
    let mut took = Vec::new();
    while begun.elapsed() < length {
        let mut rest = next_x(page);
        // A step is completed.
        let mut still = 0;
        while still < 3 {
            let x = next_x(page);
            still = if x == rest { still + 1 } else { 0 };
            rest = x;
        }
        let key = if took.len() % 2 == 0 { "right" } else { "left" };
        let pressed = Instant::now();
        page.say(&format!(r#"{{"say":"hold","keys":["{key}"]}}"#));
        while next_x(page) == rest {
            assert!(pressed.elapsed() < Duration::from_secs(5), "a key has no effect");
        }
        took.push(pressed.elapsed());
        page.say(r#"{"say":"hold","keys":[]}"#);
    }
    took.sort();
    took
}

/// Connections without the token do not affect clients with it: pages open, requests are answered, keys move.
#[test]
fn slow_clients_delay_no_other() {
    let wished = std::env::var("HOMEBODY_SLOW_S").ok().and_then(|text| text.parse().ok());
    let length = Duration::from_secs_f64(wished.unwrap_or(0.6));
    let served = Served::scenario("by-hand");
    let share = |took: &[Duration], share: usize| took[(took.len() - 1) * share / 100];
    // The times without slow clients, on this machine under its present load.
    let alone = share(&keys_to_pictures(&mut driven(&served), length), 95);
    for kind in kinds(&served) {
        let (is_over, connected) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicUsize::new(0)));
        thread::scope(|scope| {
            let keeps = scope.spawn(|| kind.keep(served.address, &is_over, &connected));
            while connected.load(Ordering::Relaxed) < CLIENTS {
                thread::sleep(Duration::from_millis(5));
            }
            let asked = Instant::now();
            assert_eq!(served.api("/api/runs").code, 200, "{}", kind.name);
            assert_eq!(served.get("/", "").code, 200, "{}", kind.name);
            let mut page = driven(&served);
            let opened = asked.elapsed();
            let took = keys_to_pictures(&mut page, length);
            let of = |percent| share(&took, percent);
            println!(
                "{CLIENTS} who {}: open after {opened:?}; {} keys, p50 {:?}, p95 {:?}, longest {:?}; {} connections",
                kind.name,
                took.len(),
                of(50),
                of(95),
                of(100),
                connected.load(Ordering::Relaxed)
            );
            page.say(r#"{"say":"stop"}"#);
            is_over.store(true, Ordering::Relaxed);
            keeps.join().unwrap();
            // A client that waits for a stranger's place waits for ten seconds.
            assert!(opened < Duration::from_secs(5), "{}: a page opens after {opened:?}", kind.name);
            // On a busy machine, the slowest one in twenty measures the other load.
            assert!(of(95) < MOST.max(3 * alone), "{}: alone {alone:?}, now {took:?}", kind.name);
        });
    }
}
