//! Input from servers: URLs of databases and brokers, orders to a run, and records of confirmed rows.

use super::messages;
use crate::choices::Choices;
use crate::mutate::{json, texts};
use crate::seeds;
use crate::target::{self, CaseFiles, ReadVerdict, Target};
use homebody_core::calendar::Calendar;
use homebody_core::event::{Firing, Value};
use homebody_core::ids::SensorId;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::scenario::scheme::{Scheme, without_password};
use homebody_core::time::RunTime;
use homebody_log::table::Batch;
use homebody_log::{Begin, Destination, Log, LogError, Logger, Policy, RunInfo, Sink, Url, Watermark, WriteMode};
use homebody_mqtt::{BrokerAddress, order_of};
use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

pub const TARGET: Target = Target { name: "server", cases: 10_000, seeds, mutate, run };

const URLS: &str = "urls.txt";
const ORDERS: &str = "orders.jsonl";
const NOTE: &str = "note.json";

/// The password in the seeds, which must not appear in messages.
const SECRET: &str = "s3cr3t-canary";

fn seeds() -> Vec<CaseFiles> {
    vec![seeds::named(TARGET.name).into_iter().flatten().collect()]
}

fn mutate(files: &mut CaseFiles, seeds: &[CaseFiles], choices: &mut Choices) {
    target::change(files, seeds, choices, |name, text, others, choices| {
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        for _ in 0..choices.size(6) {
            let at = choices.below(lines.len());
            let Some(line) = lines.get_mut(at) else { break };
            let is_json = name != URLS && json::json(line, others, choices);
            if !is_json {
                *line = part(line, choices);
            }
        }
        *text = lines.join("\n");
    });
}

fn part(line: &str, choices: &mut Choices) -> String {
    let marks = ['/', '?', '&', '=', ':', '@', '%', '[', ']', ',', '+'];
    let mut letters: Vec<char> = line.chars().collect();
    let at = choices.below(letters.len().max(1)).min(letters.len());
    match choices.below(4) {
        0 => letters.insert(at, *choices.one(&marks)),
        1 if at < letters.len() => letters[at] = *choices.one(&marks),
        2 if !line.is_empty() => {
            let parts: Vec<&str> = line.split_inclusive(marks).collect();
            let other = texts::other(parts[choices.below(parts.len())], choices);
            let replaced = choices.below(parts.len());
            return parts.iter().enumerate().map(|(at, part)| if at == replaced { &*other } else { part }).collect();
        }
        _ => return texts::other(line, choices),
    }
    letters.into_iter().collect()
}

fn run(files: &CaseFiles, folder: &Path) -> Result<ReadVerdict, String> {
    let mut verdict = ReadVerdict::Refused;
    for (number, line) in target::texts(files).get(URLS).iter().flat_map(|text| text.lines().enumerate()) {
        // Of many lines some always name a server: the first decides.
        if names_server(line)? && number == 0 {
            verdict = ReadVerdict::Accepted;
        }
    }
    let orders = files.get(ORDERS).map(Vec::as_slice).unwrap_or_default();
    for order in orders.split(|&byte| byte == b'\n') {
        if let Err(why) = order_of(order) {
            messages::message(&why)?;
        }
    }
    check_watermark(files.get(NOTE).map(Vec::as_slice).unwrap_or_default(), folder)?;
    Ok(verdict)
}

fn names_server(text: &str) -> Result<bool, String> {
    // A text outside of the place of a password may be anything.
    let has_secret = text.contains(SECRET) && !without_password(text).contains(SECRET);
    let said = |error: LogError| {
        let error = error.to_string();
        match has_secret && error.contains(SECRET) {
            true => Err(format!("a password is told: {error}")),
            false => messages::message(&error),
        }
    };
    let mut is_one = false;
    match text.parse::<Url>() {
        Err(error) => said(error.into())?,
        Ok(url) if url.scheme() == Scheme::Postgresql => match homebody_postgres::understood(&url.to_string()) {
            Ok(()) => is_one = true,
            Err(error) => said(error)?,
        },
        Ok(url) if BrokerAddress::is_broker(&url) => match BrokerAddress::from_url(&url) {
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

/// Checks that a destination never gets more rows than exist, whatever its record of confirmed rows contains.
fn check_watermark(note: &[u8], folder: &Path) -> Result<(), String> {
    const ROWS: u64 = 5;
    let taken = Arc::new(AtomicU64::new(0));
    let simulate = |how: WriteMode| -> Result<(), LogError> {
        let sink = Counting { taken: taken.clone(), now: 0 };
        let place = Destination::own("a broker", sink, Policy::default()).remembered_in(folder);
        let calendar =
            Calendar::new("2009-03-02T00:00:00", "America/Chicago").expect("a date and a zone that there are");
        let sensors = Log { sensors: vec!["hall".into()], ..Log::default() };
        let run = Arc::new(RunInfo::of_log("a day", calendar, &sensors));
        let mut logger = Logger::open(vec![place], &LoggerFile::default(), &run, how)?;
        let at = |seq: u64| RunTime::from_micros(seq as i64);
        let firing = |seq: u64| Firing { seq, at: at(seq), sensor: SensorId(0), value: Value::Fire };
        logger.store(&(0..ROWS).map(firing).collect::<Vec<_>>(), at(ROWS))?;
        logger.finish().map(drop)
    };
    simulate(WriteMode::Create).map_err(|error| error.to_string())?;
    let path = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let path = path.into_iter().find(|path| path.to_string_lossy().ends_with(".confirmed.json"));
    let path = path.ok_or("nothing is noted")?;
    fs::write(&path, note).map_err(|error| error.to_string())?;
    taken.store(0, Ordering::SeqCst);
    match simulate(WriteMode::Resume) {
        Ok(()) if taken.load(Ordering::SeqCst) > ROWS => Err("more rows are given than there are".into()),
        Ok(()) => Ok(()),
        Err(error) => messages::refusal(&error),
    }
}

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

    fn make_durable(&mut self) -> Result<Watermark, LogError> {
        Ok(Watermark(vec![self.now]))
    }

    fn finish(&mut self, _: RunTime) -> Result<(), LogError> {
        Ok(())
    }
}
