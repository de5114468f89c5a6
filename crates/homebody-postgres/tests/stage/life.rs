//! A run whose rows follow a rule: a log with messages and readings, and a truth of several tables.

use homebody_core::calendar::Calendar;
use homebody_core::event::{Events, Fact, Firing, Provenance, Trigger, Value};
use homebody_core::geometry::Point;
use homebody_core::ids::{ResidentId, RoomId, SensorId};
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::posture::Posture;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::{RunTime, SECOND, Span};
use homebody_log::{Destination, Log, LogError, Logger, Policy, RunInfo, TruthLog, Url, WriteMode};
use homebody_postgres::Postgres;
use std::sync::Arc;
use std::time::Duration;

#[derive(Clone, Copy, Debug)]
pub struct Life {
    pub run: i64,
    pub firings: u64,
    pub step: usize,
    /// Advances after which log and truth make sure of their rows.
    pub settles: usize,
    /// The pause of the run after each advance.
    pub rests: Duration,
    pub how: WriteMode,
}

impl Life {
    pub fn new(run: i64, firings: u64) -> Life {
        Life { run, firings, step: 50, settles: 10, rests: Duration::ZERO, how: WriteMode::Create }
    }

    pub fn live(&self, log: &str, truth: Option<&str>, policy: Policy) -> Result<(), LogError> {
        self.live_as(log, truth, policy, &LoggerFile::default())
    }

    pub fn live_as(&self, log: &str, truth: Option<&str>, policy: Policy, file: &LoggerFile) -> Result<(), LogError> {
        let run = Arc::new(run(self.run));
        let mut logger = Logger::open(vec![destination(log, &policy)], file, &run, self.how)?;
        let truth = truth.map(|truth| TruthLog::into(destination(truth, &policy), file, &run, self.how));
        let mut truth = truth.transpose()?;
        let firings = firings(self.firings);
        for (number, step) in firings.chunks(self.step).enumerate() {
            let events = Events { firings: step.to_vec(), facts: facts(step), ..Events::default() };
            let joined = logger.store(&events.firings, step[step.len() - 1].at)?.clone();
            if let Some(truth) = &mut truth {
                truth.store(&events, &joined)?;
            }
            if number % self.settles == self.settles - 1 {
                logger.make_durable()?;
                truth.as_mut().map_or(Ok(()), TruthLog::make_durable)?;
            }
            std::thread::sleep(self.rests);
        }
        let end = end(self.firings);
        logger.store(&[], end)?;
        logger.finish()?;
        truth.map_or(Ok(()), |truth| truth.finish(end))
    }
}

pub fn destination(url: &str, policy: &Policy) -> Destination {
    let url: Url = url.parse().unwrap();
    Destination::own(url.to_string(), Postgres::new(&url), policy.clone())
}

pub fn patient(seconds: u64) -> Policy {
    let retry_after = Duration::from_millis(20);
    Policy { retry_for: Duration::from_secs(seconds), retry_after, ..Policy::default() }
}

pub fn run(id: i64) -> RunInfo {
    let calendar = Calendar::new("2009-03-07T22:00:00", "America/Chicago").unwrap();
    let sensors = ["bedroom motion", "kitchen motion", "thermo \"hall\", ö"].map(String::from).to_vec();
    RunInfo {
        id,
        seed: u64::MAX,
        residents: vec!["margaret".into(), "walter".into()],
        rooms: vec!["bedroom".into(), "kitchen".into()],
        things: vec!["stove".into()],
        ..RunInfo::of_log("a quiet night", calendar, &Log { sensors, ..Log::default() })
    }
}

/// Firings some seconds apart, over the change to daylight saving time and, if there are many, far beyond.
pub fn firings(count: u64) -> Vec<Firing> {
    let mut at = RunTime::START;
    let one = |seq: u64| {
        at += (seq * 7_919_993 % 31) as i64 * SECOND / 4 + Span::from_micros(1 + (seq % 1000) as i64);
        let sensor = (seq * 31 % 3) as u32;
        let value = if sensor == 2 { Value::Reading((seq % 700) as i32 * 50 - 5000) } else { Value::Fire };
        Firing { seq, at, sensor: SensorId(sensor), value }
    };
    (0..count).map(one).collect()
}

fn end(count: u64) -> RunTime {
    firings(count).last().map_or(RunTime::START, |last| last.at) + SECOND
}

fn facts(firings: &[Firing]) -> Vec<Fact> {
    let each = |firing: &Firing| {
        let (seq, at) = (firing.seq, firing.at);
        let who = ResidentId::new((seq % 2) as usize);
        let provenance =
            Provenance { resident: Some(who), seen_at: at - Span::MICROSECOND, trigger: Trigger::Movement };
        let mut facts = vec![Fact::Provenance { seq, provenance }];
        if seq % 3 == 0 {
            let from = Point { x: seq as f64 / 7.0, y: -0.5 };
            let doing = MotionState::Stride { from, to: Point { x: 1.0, y: 2.0 } };
            let MotionSegment { begin, end, doing, posture } =
                MotionSegment { begin: at, end: at + SECOND, doing, posture: Posture::Standing };
            facts.push(Fact::Movement { resident: who, begin, end, doing, posture });
        }
        if seq % 11 == 0 {
            facts.push(Fact::Activity { resident: who, at, name: Some(format!("activity {}", seq % 5)) });
            facts.push(Fact::Room { resident: who, at, room: Some(RoomId::new((seq % 2) as usize)) });
        }
        facts
    };
    firings.iter().flat_map(each).collect()
}
