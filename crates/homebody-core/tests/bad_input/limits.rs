//! The size of input is bounded, and the cost of reading it grows with its size.

#![allow(
    clippy::disallowed_types,
    clippy::disallowed_methods,
    reason = "what reading costs is measured by the clock; the core reads none"
)]

use super::*;
use std::fmt::Write;
use std::hint::black_box;
use std::time::{Duration, Instant};

/// A part of the good scenario, enlarged to a size.
type Grown = (&'static str, fn(usize) -> BTreeMap<String, String>);

fn with(file: &str, text: String) -> BTreeMap<String, String> {
    let mut files = good();
    files.insert(file.into(), text);
    files
}

fn list(count: usize, item: impl Fn(usize) -> String) -> String {
    (0..count).map(item).collect::<Vec<_>>().join(",")
}

/// Each kind of input that can be long, right or wrong.
const GROWN: [Grown; 12] = [
    ("unknown keys", |n| with("home.json", format!("{{{}}}", list(n, |i| format!("\"k{i}\":0"))))),
    ("repeated keys", |n| with("home.json", format!("{{{}}}", list(n, |_| "\"name\":0".into())))),
    ("misspelt keys", |n| with("home.json", format!("{{{}}}", list(n, |i| format!("\"nam{i}\":0"))))),
    ("a list of a wrong type", |n| with("home.json", format!("{{\"rooms\":[{}]}}", list(n, |_| "0".into())))),
    ("numbers where an object belongs", |n| with("home.json", format!("[{}]", list(n, |_| "0".into())))),
    ("ids of nobody", |n| {
        with("logger.json", format!("{{\"ids\":{{{}}}}}", list(n / 8, |i| format!("\"s{i}\":\"{i}\""))))
    }),
    ("a path of many steps", |n| path(n / 8, |_| "{\"wait\":{\"for_s\":1}}".into())),
    ("a path to places that are none", |n| path(n / 8, |i| format!("{{\"go\":{{\"to\":[\"x{i}\"]}}}}"))),
    ("activities", |n| path(n / 8, |i| format!("{{\"activity\":\"a{i}\"}}"))),
    ("blanks", |n| with("home.json", format!("{{{}}}", " ".repeat(8 * n)))),
    ("lines", |n| with("home.json", format!("{{{}}}", "\n".repeat(8 * n)))),
    ("brackets", |n| with("home.json", "[".repeat(8 * n))),
];

fn path(count: usize, step: impl Fn(usize) -> String) -> BTreeMap<String, String> {
    with("ann.path.json", format!("{{\"start\":\"bed\",\"steps\":[{}]}}", list(count, step)))
}

/// The least of several times, which is the one that nothing else has disturbed.
fn least_time(work: impl Fn()) -> Duration {
    let time = |_| {
        let begin = Instant::now();
        work();
        begin.elapsed()
    };
    (0..5).map(time).min().unwrap()
}

/// Eight times the size may take so many times as long: what grows as its square takes 64 times.
const MOST_TIMES: f64 = 24.0;

fn ratio(small: Duration, large: Duration) -> f64 {
    large.as_secs_f64() / small.as_secs_f64().max(1e-3)
}

#[test]
fn reading_and_checking_cost_no_more_than_a_small_multiple_of_the_size() {
    const SIZE: usize = 6_000;
    let mut told = String::new();
    for (what, grown) in GROWN {
        let [small, large] = [SIZE, 8 * SIZE].map(|size| {
            let files = grown(size);
            least_time(|| drop(problems(&files)))
        });
        let ratio = ratio(small, large);
        writeln!(told, "{what}: {small:?}, {large:?}, {ratio:.1} times").unwrap();
        assert!(ratio < MOST_TIMES, "{told}");
    }
}

/// The control: who compares each key with all others is seen to take too long.
#[test]
fn finds_a_quadratic_cost() {
    let [small, large] = [4_000, 32_000].map(|size| {
        let keys: Vec<u64> = (0..size).collect();
        let repeated = || keys.iter().map(|one| keys.iter().filter(|other| *other == black_box(one)).count()).sum();
        least_time(|| {
            black_box::<usize>(repeated());
        })
    });
    assert!(ratio(small, large) > MOST_TIMES, "{small:?}, {large:?}");
}

#[test]
fn rejects_long_texts_lists_and_paths() {
    let (text, values) = (format!("\"{}\"", "x".repeat(10_001)), list(1_000_001, |_| "0".into()));
    check(&[("scenario.json", r#""home": "home.json""#, &format!(r#""home": {text}"#), "6:11: json::long-text")]);
    assert_eq!(reported(&with("home.json", format!("[{values}]"))), "home.json:1:2000001: json::too-many-values");
    let steps = reported(&path(10_001, |_| "{\"wait\":{\"for_s\":1}}".into()));
    assert_eq!(steps, "ann.path.json:1:24: schema::wrong-count");
    let waypoints =
        reported(&path(130, |_| format!("{{\"go\":{{\"to\":[{}]}}}}", list(950, |i| format!("[1.{i},1]")))));
    assert_eq!(waypoints, "ann.path.json:1:24: path::too-many-steps");
}

#[test]
fn messages_quote_no_more_than_a_line() {
    let long = "y".repeat(9_000);
    let told = problems(&with("home.json", format!("{{ \"{long}\": 0, \"name\": [] }}"))).to_string();
    assert!(told.len() < 4_000 && told.contains("yyy ... yyy"), "{told}");
}
