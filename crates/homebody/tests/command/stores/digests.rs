//! All rows have one digest, for any destination, speed and number of threads, watched or not.
//!
//! The digest is that of the rows from our readers: for each row its number, instant, sensor and value. `HOMEBODY_SCENARIOS=20` takes that
//! many scenarios: all templates, and some of them with random seeds and other messages.

use crate::folder::{Folder, ROOT};
use crate::mosquitto::Broker;
use crate::postgres::Server;
use crate::served::{address_of, page_of};
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::scenario::scheme::{SCHEMES, Scheme, SchemeRow, Stands};
use homebody_log::log::Clock;
use homebody_log::{LogSource, Url, read};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;
use tungstenite::Message;

/// A row of a reader: instant in microseconds since 1970, sensor, value.
type Row = (i64, String, String);

/// Simulated time at speeds: some seconds each, or one second with few scenarios.
const SPEEDS: [(&str, [&str; 2]); 3] = [("10", ["10s", "30s"]), ("100", ["2m", "5m"]), ("1000", ["20m", "40m"])];

fn scenarios() -> usize {
    std::env::var("HOMEBODY_SCENARIOS").ok().and_then(|count| count.parse().ok()).unwrap_or(3)
}

fn rows(place: &Url) -> Vec<Row> {
    homebody_simulation::install_sinks();
    let log = read(LogSource::from(place), &LoggerFile::default()).unwrap_or_else(|error| panic!("{place}: {error}"));
    // Without a movement in so short a time, nothing shows the clock.
    assert!(log.skipped == 0 && (log.clock == Clock::Utc || log.rows == 0), "{place}");
    log.events
        .iter()
        .map(|event| (event.at.micros(), log.sensor(event).to_owned(), log.value(event).to_owned()))
        .collect()
}

fn digest(rows: &[Row]) -> String {
    let mut hash = Sha256::new();
    for (number, (at, sensor, value)) in rows.iter().enumerate() {
        hash.update(format!("{number}\t{at}\t{sensor}\t{value}\n"));
    }
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Copies a scenario: one that comes with the program or, beyond these, one of them with a drawn seed and other messages. All log in UTC
/// under the names of their sensors, for a day that begins in the morning.
fn scenario(folder: &Folder, number: usize) -> String {
    let mut names: Vec<String> = fs::read_dir(Path::new(ROOT).join("scenarios"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    // Scenarios with routines first: their days have the most rows.
    names.sort_by_key(|name| (!["tigerplace", "studio", "couple-with-cat"].contains(&name.as_str()), name.clone()));
    let (name, round) = (&names[number % names.len()], number / names.len());
    folder.copy_scenario(name);
    let change = |file: &str, change: &dyn Fn(&mut Value)| {
        let file = format!("{name}/{file}");
        let text = if folder.path(&file).exists() { folder.read(&file) } else { "{}".into() };
        let mut json: Value = serde_json::from_str(&text).unwrap();
        change(&mut json);
        folder.write(&file, json.to_string());
    };
    change("logger.json", &|logger| {
        let messages = [
            logger["messages"].clone(),
            json!({ "on_off": { "hold_s": 5 } }),
            json!({ "occupancy": { "timeout_s": 90 } }),
        ];
        let messages = messages[(round + number) % 3 * usize::from(round > 0)].clone();
        *logger = json!({ "time": "utc", "messages": if messages.is_null() { json!("fire_only") } else { messages } });
    });
    change("scenario.json", &|scenario| {
        let start = scenario["start"].as_str().unwrap_or("2025-06-02T00:00:00");
        scenario["start"] = format!("{}T07:00:00", &start[..10]).into();
        scenario["days"] = 1.into();
        scenario["logger"] = "logger.json".into();
        if round > 0 {
            scenario["seed"] = (number as u64 * 7919 + 11).into();
        }
    });
    name.clone()
}

#[test]
fn one_digest_whatever_it_goes_to_how_fast_and_whoever_looks() {
    let servers = Server::shared().zip(Broker::start());
    let mut all = Sha256::new();
    let (mut compared, mut total, begun) = (0, 0, Instant::now());
    for number in 0..scenarios() {
        let folder = Folder::new();
        let name = scenario(&folder, number);
        let place = |text: &str| text.parse::<Url>().unwrap().within(&folder.path(""));
        // The form of CASAS changes the names of sensors.
        let is_same = |row: &&SchemeRow| row.stands != Stands::Server && row.scheme != Scheme::Casas;
        let files = SCHEMES.iter().filter(is_same).map(|row| format!("{}:{}", row.name, row.usual));
        let mut places: Vec<Url> = files.chain(["parquet:lives".to_owned()]).map(|text| place(&text)).collect();
        if let Some((server, _)) = &servers {
            let database = server.database(&format!("digest{number}"));
            places.push(server.url("postgres", &database, "").parse().unwrap());
        }
        let out: String = places.iter().map(|place| format!(" --out {place}")).collect();
        folder.run(&format!("run {name} --quiet{out}")).ok();
        let base = rows(&places[0]);
        let wanted = digest(&base);
        for place in &places[1..] {
            assert_eq!(digest(&rows(place)), wanted, "{name}: {place}");
            compared += 1;
        }
        let begins = |found: &[Row], what: &str| {
            assert!(found.len() <= base.len(), "{name} {what}: {} rows of {}", found.len(), base.len());
            assert_eq!(digest(found), digest(&base[..found.len()]), "{name} {what}");
        };
        let paced = SPEEDS.map(|(speed, spans)| {
            let span = spans[usize::from(scenarios() > 3)];
            folder.start(&format!("run {name} --quiet --for {span} --speed {speed} --out csv:paced-{speed}.csv"))
        });
        for ((speed, _), run) in SPEEDS.into_iter().zip(paced) {
            run.finish().ok();
            begins(&rows(&place(&format!("csv:paced-{speed}.csv"))), &format!("at {speed} times the speed of life"));
            compared += 1;
        }
        if let Some((_, broker)) = &servers {
            begins(&told(&folder, &name, broker, &format!("told{number}")), "as a broker is told it");
            compared += 1;
        }
        let looked_at = looked_at(&folder, &name);
        assert_eq!(digest(&looked_at), wanted, "{name}: a page looks on");
        compared += 1 + cohort(&folder, &name);
        println!("{name:22} {:>6} rows  {wanted}", base.len());
        all.update(&wanted);
        total += base.len();
        if number == 0 {
            control(&base);
        }
    }
    let all: String = all.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
    println!("{} scenarios, {total} rows, {compared} comparisons, {:?}: {all}", scenarios(), begun.elapsed());
    assert!(total > 1000);
}

/// One row that is another, or in another place, gives another digest.
fn control(base: &[Row]) {
    let mut other = base.to_vec();
    other[3].0 += 1;
    assert_ne!(digest(&other), digest(base));
    let mut other = base.to_vec();
    other.swap(4, 5);
    assert_ne!(digest(&other), digest(base));
}

/// Some minutes on a broker, in the style of plain JSON; below a prefix of their own, without retained messages.
fn told(folder: &Folder, name: &str, broker: &Broker, prefix: &str) -> Vec<Row> {
    let port = broker.port.to_string();
    let listen = |more: &[&str]| {
        let args =
            ["-h", "127.0.0.1", "-p", &port, "-i", prefix, "-c", "-q", "1", "-t", &format!("{prefix}/#"), "-F", "%p"];
        let heard = Command::new("mosquitto_sub").args(args).args(more).stderr(Stdio::null()).output().unwrap();
        String::from_utf8(heard.stdout).unwrap()
    };
    // A client with a session gets all messages of its absence.
    listen(&["-E"]);
    let url = broker.url(&format!("{prefix}?allow-fast=true&style=plain"));
    folder.run(&format!("run {name} --quiet --force --for 20m --out {url} --out csv:beside.csv")).ok();
    let heard = listen(&["-W", "2"]);
    let mut rows = std::collections::BTreeMap::new();
    for line in heard.lines() {
        let Ok(message) = serde_json::from_str::<Value>(line) else { continue };
        let Some(number) = message["seq"].as_u64() else { continue };
        let at: jiff::Timestamp = message["sim_time"].as_str().unwrap().parse().unwrap();
        let value = match &message["value"] {
            Value::String(text) => text.clone(),
            other => other.to_string(),
        };
        rows.insert(number, (at.as_microsecond(), message["sensor"].as_str().unwrap().to_owned(), value));
    }
    assert!(rows.keys().copied().eq(0..rows.len() as u64), "{name}: no row is missing");
    rows.into_values().collect()
}

/// A simulated day in the page, at full speed, with the log of its folder.
fn looked_at(folder: &Folder, name: &str) -> Vec<Row> {
    let served =
        folder.command(&format!("serve {name} --no-open")).stdout(Stdio::piped()).stderr(Stdio::null()).spawn();
    let mut served = served.unwrap();
    let (address, token) = address_of(&mut served);
    let mut page = page_of(&address, &token);
    for say in [r#"{"say":"speed","times":null}"#, r#"{"say":"play"}"#] {
        page.send(Message::Text(say.into())).unwrap();
    }
    // A run that is over has its rows in its folder, which a note says.
    loop {
        let Message::Text(text) = page.read().unwrap() else { continue };
        if text.contains("Stored ") && text.contains(" rows in ") {
            break;
        }
    }
    served.kill().unwrap();
    served.wait().unwrap();
    let runs: Vec<_> = fs::read_dir(folder.path("runs")).unwrap().map(|entry| entry.unwrap().path()).collect();
    let [run] = &runs[..] else { panic!("{runs:?}") };
    let rows = rows(&Url::new("sqlite:x".parse::<Url>().unwrap().scheme(), run.join("log.db")));
    fs::remove_dir_all(folder.path("runs")).unwrap();
    rows
}

/// Three runs in parallel on one processor, on all, and each alone. Returns the number of comparisons.
fn cohort(folder: &Folder, name: &str) -> usize {
    let live = |first: &str| {
        let mut command = Command::new("taskset");
        command.args([
            "-c",
            first,
            env!("CARGO_BIN_EXE_homebody"),
            "run",
            name,
            "--quiet",
            "--members",
            "3",
            "--for",
            "3h",
        ]);
        let done = command.current_dir(folder.path("")).output().unwrap();
        assert!(done.status.success(), "{name}: {}", String::from_utf8_lossy(&done.stderr));
        let cohort = fs::read_dir(folder.path("runs")).unwrap().next().unwrap().unwrap().path();
        let mut members: Vec<_> =
            fs::read_dir(&cohort).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_dir()).collect();
        members.sort();
        let url = |path: &Path| Url::new("sqlite:x".parse::<Url>().unwrap().scheme(), path.join("log.db"));
        let digests: Vec<String> = members.iter().map(|member| digest(&rows(&url(member)))).collect();
        (members, digests)
    };
    let (_, on_one) = live("0");
    fs::remove_dir_all(folder.path("runs")).unwrap();
    let (members, on_all) = live("0-63");
    assert_eq!(on_one, on_all, "{name}: on one processor and on all");
    for (member, wanted) in members.iter().zip(&on_all) {
        folder.run(&format!("replay {}/recording.json --quiet --force --out csv:alone.csv", member.display())).ok();
        let alone = "csv:alone.csv".parse::<Url>().unwrap().within(&folder.path(""));
        assert_eq!(digest(&rows(&alone)), *wanted, "{name}: {} alone", member.display());
    }
    fs::remove_dir_all(folder.path("runs")).unwrap();
    2 * members.len()
}
