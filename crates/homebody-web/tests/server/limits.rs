//! Those who would keep the server busy for nothing.

use super::served::Served;
use std::io::{Read, Write};
use std::net::TcpStream;
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

#[test]
fn who_never_ends_a_request_is_sent_away() {
    let served = Served::scenario("by-hand");
    let slow: Vec<TcpStream> = (0..40)
        .map(|number| {
            let mut stream = TcpStream::connect(served.address).unwrap();
            stream.set_read_timeout(Some(Duration::from_secs(30))).unwrap();
            // Some say nothing at all.
            if number % 2 == 0 {
                stream.write_all(format!("GET / HTTP/1.1\r\nHost: {}\r\n", served.address).as_bytes()).unwrap();
            }
            stream
        })
        .collect();
    assert_eq!(served.api("/api/runs").code, 200, "others are heard meanwhile");
    for mut stream in slow {
        let mut answer = Vec::new();
        // Its end comes by the server's own clock; the time-out of reading would be an error.
        stream.read_to_end(&mut answer).unwrap();
        assert!(!String::from_utf8_lossy(&answer).contains("200 OK"));
    }
}

#[test]
fn guesses_of_the_token_wait_for_each_other_and_who_knows_it_does_not() {
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
