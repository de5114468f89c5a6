//! What servers are named by and what they say: URLs of databases and brokers, orders to a run, and notes of what was confirmed.

use super::told;
use crate::corpus;
use crate::dice::Dice;
use crate::mutate::{json, texts};
use crate::target::{self, Files, Target, Verdict};
use homebody_core::event::{Firing, Value};
use homebody_core::ids::SensorId;
use homebody_core::scenario::calendar::Calendar;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::scenario::scheme::{Scheme, without_password};
use homebody_core::time::Micros;
use homebody_log::table::Batch;
use homebody_log::{Begin, Destination, How, Log, LogError, Logger, Policy, RunInfo, Sink, Url, Watermark};
use homebody_mqtt::{Address, order_of};
use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

pub const TARGET: Target = Target {
    name: "server",
    about: "URLs of servers, orders from brokers, notes of what was confirmed",
    cases: 10_000,
    corpus,
    mutate,
    run,
};

const URLS: &str = "urls.txt";
const ORDERS: &str = "orders.jsonl";
const NOTE: &str = "note.json";

/// What stands as a password in the corpus, and in no message.
const SECRET: &str = "s3cr3t-canary";

fn corpus() -> Vec<Files> {
    vec![corpus::of(TARGET.name).into_iter().flatten().collect()]
}

fn mutate(files: &mut Files, corpus: &[Files], dice: &mut Dice) {
    target::change(files, corpus, dice, |name, text, others, dice| {
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        for _ in 0..dice.size(6) {
            let at = dice.below(lines.len());
            let Some(line) = lines.get_mut(at) else { break };
            let is_json = name != URLS && json::json(line, others, dice);
            if !is_json {
                *line = part(line, dice);
            }
        }
        *text = lines.join("\n");
    });
}

/// A URL of which one part is another.
fn part(line: &str, dice: &mut Dice) -> String {
    let marks = ['/', '?', '&', '=', ':', '@', '%', '[', ']', ',', '+'];
    let mut letters: Vec<char> = line.chars().collect();
    let at = dice.below(letters.len().max(1)).min(letters.len());
    match dice.below(4) {
        0 => letters.insert(at, *dice.one(&marks)),
        1 if at < letters.len() => letters[at] = *dice.one(&marks),
        2 if !line.is_empty() => {
            let parts: Vec<&str> = line.split_inclusive(marks).collect();
            let other = texts::other(parts[dice.below(parts.len())], dice);
            let replaced = dice.below(parts.len());
            return parts.iter().enumerate().map(|(at, part)| if at == replaced { &*other } else { part }).collect();
        }
        _ => return texts::other(line, dice),
    }
    letters.into_iter().collect()
}

fn run(files: &Files, folder: &Path) -> Result<Verdict, String> {
    let mut verdict = Verdict::Refused;
    for (number, line) in target::texts(files).get(URLS).iter().flat_map(|text| text.lines().enumerate()) {
        // Of many lines some always name a server: the first decides.
        if named(line)? && number == 0 {
            verdict = Verdict::Accepted;
        }
    }
    let orders = files.get(ORDERS).map(Vec::as_slice).unwrap_or_default();
    for order in orders.split(|&byte| byte == b'\n') {
        if let Err(why) = order_of(order) {
            told::message(&why)?;
        }
    }
    noted(files.get(NOTE).map(Vec::as_slice).unwrap_or_default(), folder)?;
    Ok(verdict)
}

/// Whether a text names a server.
fn named(text: &str) -> Result<bool, String> {
    // What stands where no password can be, nobody can know to be one.
    let has_secret = text.contains(SECRET) && !without_password(text).contains(SECRET);
    let said = |error: LogError| {
        let error = error.to_string();
        match has_secret && error.contains(SECRET) {
            true => Err(format!("a password is told: {error}")),
            false => told::message(&error),
        }
    };
    let mut is_one = false;
    match text.parse::<Url>() {
        Err(error) => said(error.into())?,
        Ok(url) if url.scheme() == Scheme::Postgresql => match homebody_postgres::understood(&url.to_string()) {
            Ok(()) => is_one = true,
            Err(error) => said(error)?,
        },
        Ok(url) if Address::is_of(&url) => match Address::of(&url) {
            Ok(address) => {
                is_one = true;
                if address.prefix.contains(['#', '+', '\0', '$']) || address.prefix.is_empty() {
                    return Err(format!("{text:?} speaks below {:?}", address.prefix));
                }
                if has_secret && address.place().contains(SECRET) {
                    return Err(format!("a password is told: {}", address.place()));
                }
            }
            Err(error) => said(error)?,
        },
        Ok(_) => {}
    }
    Ok(is_one)
}

/// How many rows a destination gets that has a note of what it has confirmed, whatever stands in it.
fn noted(note: &[u8], folder: &Path) -> Result<(), String> {
    const ROWS: u64 = 5;
    let taken = Arc::new(AtomicU64::new(0));
    let live = |how: How| -> Result<(), LogError> {
        let sink = Counting { taken: taken.clone(), now: 0 };
        let place = Destination::own("a broker", sink, Policy::default()).remembered_in(folder);
        let calendar =
            Calendar::new("2009-03-02T00:00:00", "America/Chicago").expect("a date and a zone that there are");
        let sensors = Log { sensors: vec!["hall".into()], ..Log::default() };
        let run = Arc::new(RunInfo::of_log("a day", calendar, &sensors));
        let mut logger = Logger::open(vec![place], &LoggerFile::default(), &run, how)?;
        let firing = |seq: u64| Firing { seq, at: seq as Micros, sensor: SensorId(0), value: Value::Fire };
        logger.store(&(0..ROWS).map(firing).collect::<Vec<_>>(), ROWS as Micros)?;
        logger.finish().map(drop)
    };
    live(How::New).map_err(|error| error.to_string())?;
    let path = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let path = path.into_iter().find(|path| path.to_string_lossy().ends_with(".confirmed.json"));
    let path = path.ok_or("nothing is noted")?;
    fs::write(&path, note).map_err(|error| error.to_string())?;
    taken.store(0, Ordering::SeqCst);
    match live(How::GoOn) {
        Ok(()) if taken.load(Ordering::SeqCst) > ROWS => Err("more rows are given than there are".into()),
        Ok(()) => Ok(()),
        Err(error) => told::message(&error.to_string()),
    }
}

/// Counts what it is given.
struct Counting {
    taken: Arc<AtomicU64>,
    now: u64,
}

impl Sink for Counting {
    fn begin(&mut self, _: &Begin) -> Result<Watermark, LogError> {
        Ok(Watermark::none())
    }

    fn write(&mut self, batch: &Batch) -> Result<(), LogError> {
        self.now += batch.len() as u64;
        self.taken.fetch_add(batch.len() as u64, Ordering::SeqCst);
        Ok(())
    }

    fn settle(&mut self) -> Result<Watermark, LogError> {
        Ok(Watermark(vec![self.now]))
    }

    fn finish(&mut self, _: Micros) -> Result<(), LogError> {
        Ok(())
    }
}
