//! A mosquitto for one test, a listener to it, and a home that logs to it.

use homebody_core::calendar::Calendar;
use homebody_core::event::{Band, Firing, Value};
use homebody_core::ids::SensorId;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::{RunTime, SECOND, Span};
use homebody_log::{Destination, Log, LogError, Logger, Policy, RunInfo, SensorInfo, Url, WriteMode};
use homebody_mqtt::{MqttSink, policy};
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

/// The lines of one that remembers who listens, also when it is begun again, and leaves out nothing for them.
pub const REMEMBERS: &str = "allow_anonymous true\npersistence true\npersistence_location FOLDER/\nautosave_interval 0\n\
                             max_inflight_messages 0\nmax_queued_messages 0\nqueue_qos0_messages true\n";

#[path = "mosquitto.rs"]
mod mosquitto;
#[allow(unused_imports, reason = "a benchmark uses a part of it")]
pub use mosquitto::{Broker, SOON, free_port, is_installed};

impl Broker {
    /// All that it keeps.
    pub fn kept(&self) -> Vec<Heard> {
        let listener = Listener::of(self.port, "#", &["--retained-only"]);
        // There is nothing to wait for where nothing is kept.
        thread::sleep(Duration::from_millis(700));
        let mut heard = listener.heard();
        loop {
            thread::sleep(Duration::from_millis(300));
            let more = listener.heard();
            if more.len() == heard.len() {
                return heard;
            }
            heard = more;
        }
    }

    /// Has it store who listens, so that it knows when it is begun again.
    pub fn save(&self) {
        self.signal("-USR1");
        let database = self.folder.path().join("mosquitto.db");
        wait_for("the broker's database", || database.exists().then_some(()));
    }

    pub fn say_lines(&self, topic: &str, lines: &str) {
        let port = self.port.to_string();
        let args = ["-h", "127.0.0.1", "-p", &port, "-q", "1", "-l", "-t", topic];
        let mut child = Command::new("mosquitto_pub").args(args).stdin(Stdio::piped()).spawn().unwrap();
        child.stdin.take().unwrap().write_all(lines.as_bytes()).unwrap();
        assert!(child.wait().unwrap().success());
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Heard {
    pub topic: String,
    pub is_kept: bool,
    pub payload: String,
}

impl Heard {
    pub fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.payload).unwrap()
    }

    /// The run and the number that a row has.
    pub fn row(&self) -> Option<(String, u64)> {
        let json: serde_json::Value = serde_json::from_str(&self.payload).ok()?;
        Some((json.get("run")?.as_str()?.to_owned(), json.get("seq")?.as_u64()?))
    }
}

pub struct Listener {
    child: Child,
    heard: Arc<Mutex<Vec<Heard>>>,
    /// Rows up to here, at most, were heard of.
    rows: Arc<AtomicU64>,
}

impl Listener {
    pub fn to(broker: &Broker, topic: &str) -> Listener {
        let listener = Listener::of(broker.port, topic, &[]);
        // It listens once it hears something.
        let probe = topic.trim_end_matches('#').to_owned() + "probe";
        wait_for("the listener", || {
            broker.say(&probe, "there", &[]);
            listener.heard().iter().any(|heard| heard.topic == probe).then_some(())
        });
        listener
    }

    /// Listens by mosquitto's own program, which connects again when it is sent away.
    pub fn of(port: u16, topic: &str, more: &[&str]) -> Listener {
        let port = port.to_string();
        let args = ["-h", "127.0.0.1", "-p", &port, "-q", "1", "-t", topic, "-F", "%t\t%r\t%p"];
        let mut child = Command::new("mosquitto_sub")
            .args(args)
            .args(more)
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let (output, heard) = (child.stdout.take().unwrap(), Arc::new(Mutex::new(Vec::new())));
        let (into, rows) = (heard.clone(), Arc::new(AtomicU64::new(0)));
        let highest = rows.clone();
        thread::spawn(move || {
            for line in BufReader::new(output).lines().map_while(Result::ok) {
                let mut parts = line.splitn(3, '\t').map(str::to_owned);
                if let (Some(topic), Some(kept), Some(payload)) = (parts.next(), parts.next(), parts.next()) {
                    let heard = Heard { topic, is_kept: kept == "1", payload };
                    // Retained messages come before those that have waited for the listener.
                    if let Some((_, seq)) = heard.row().filter(|_| !heard.is_kept) {
                        highest.fetch_max(seq + 1, Ordering::Relaxed);
                    }
                    into.lock().unwrap().push(heard);
                }
            }
        });
        Listener { child, heard, rows }
    }

    /// Listens to all below a topic of one that [`REMEMBERS`], across its deaths. It acknowledges nothing: mosquitto's program throws
    /// away what it has not read when it cannot say that it has.
    pub fn lasting(broker: &Broker, topic: &str) -> Listener {
        let listener = Listener::of(broker.port, topic, &["-c", "-i", "listener", "-q", "0"]);
        let probe = topic.trim_end_matches('#').to_owned() + "probe";
        wait_for("the listener", || {
            broker.say(&probe, "there", &[]);
            (listener.count() > 0).then_some(())
        });
        broker.save();
        listener
    }

    pub fn heard(&self) -> Vec<Heard> {
        self.heard.lock().unwrap().clone()
    }

    /// The number behind that of the highest row that was heard, but for those that a broker keeps.
    pub fn rows(&self) -> u64 {
        self.rows.load(Ordering::Relaxed)
    }

    pub fn count(&self) -> usize {
        self.heard.lock().unwrap().len()
    }

    pub fn wait(&self, topic: &str, says: &str) -> Heard {
        wait_for(&format!("{says} on {topic}"), || {
            self.heard().into_iter().rev().find(|heard| heard.topic == topic && heard.payload.contains(says))
        })
    }
}

impl Drop for Listener {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

pub fn wait_for<T>(what: &str, look: impl Fn() -> Option<T>) -> T {
    let begun = Instant::now();
    loop {
        if let Some(found) = look() {
            return found;
        }
        assert!(begun.elapsed() < SOON, "in vain: {what}");
        thread::sleep(Duration::from_millis(20));
    }
}

/// A home with a sensor of each kind, and a motion sensor that says OFF.
pub fn run() -> RunInfo {
    let sensor = |name: &str, kind: &str, unit: Option<&str>, values: &[&str]| {
        let (unit, room) = (unit.map(Into::into), Some("living room".into()));
        SensorInfo { unit, room, ..SensorInfo::of_kind(name, kind, values) }
    };
    let sensors = vec![
        sensor("hall motion", "motion", None, &["ON"]),
        sensor("front door", "contact", None, &["OPEN", "CLOSE"]),
        sensor("bed", "bed", None, &["IN", "OUT"]),
        sensor("stove", "stove_temperature", Some("\u{b0}C"), &["ON", "OFF"]),
        sensor("chair", "pressure", None, &["ON", "OFF"]),
        sensor("lamp plug", "power", Some("W"), &["ON", "OFF"]),
        sensor("tap", "flow", None, &["ON", "OFF"]),
        sensor("window light", "light", Some("lx"), &[]),
        sensor("living room temperature", "temperature", Some("\u{b0}C"), &[]),
        sensor("landing motion", "ceiling_motion", None, &["ON", "OFF"]),
    ];
    let calendar = Calendar::new("2009-03-02T07:12:03.25", "America/Chicago").unwrap();
    RunInfo {
        id: 4_611_686_018_427_387_905,
        things: vec!["front door".into(), "stove".into()],
        residents: vec!["margaret".into()],
        sensors,
        ..RunInfo::of_log("the studio", calendar, &Log::default())
    }
}

/// The values of each sensor of [`run`], in turn.
const SAID: [(u32, Value); 16] = [
    (0, Value::Fire),
    (1, Value::Open),
    (2, Value::In),
    (3, Value::On),
    (4, Value::On),
    (5, Value::On),
    (6, Value::On),
    (7, Value::Reading(150_000)),
    (8, Value::Reading(21_500)),
    (9, Value::Fire),
    (2, Value::Restless(3)),
    (2, Value::Pulse(Band::High)),
    (3, Value::Reading(180_250)),
    (5, Value::Reading(60_000)),
    (1, Value::Close),
    (2, Value::Out),
];

pub fn firings(count: u64) -> Vec<Firing> {
    let firing = |seq: u64| {
        let (sensor, value) = SAID[(seq % SAID.len() as u64) as usize];
        Firing { seq, at: RunTime::START + seq as i64 * 4 * SECOND, sensor: SensorId(sensor), value }
    };
    (0..count).map(firing).collect()
}

pub fn logger(sink: MqttSink, how: WriteMode) -> Result<Logger, LogError> {
    logger_with(sink, how, policy())
}

pub fn logger_with(sink: MqttSink, how: WriteMode, policy: Policy) -> Result<Logger, LogError> {
    let to = Destination::own("mqtt", sink, policy);
    Logger::open(vec![to], &LoggerFile::default(), &Arc::new(run()), how)
}

pub fn store(logger: &mut Logger, firings: &[Firing]) {
    logger.store(firings, firings.last().map_or(RunTime::START, |last| last.at + Span::MICROSECOND)).unwrap();
}

pub fn live(url: &Url, rows: u64) {
    let mut logger = logger(MqttSink::in_real_time(url), WriteMode::Create).unwrap();
    store(&mut logger, &firings(rows));
    logger.finish().unwrap();
}

pub fn repository() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}
