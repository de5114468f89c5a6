//! Keeps a run's ground truth, in a database of its own: no file of firings ever holds it.
//!
//! | table | a row is |
//! |---|---|
//! | `cause` | why a firing came: whose movement was seen, and when; `fired_at` and `sensor` are those of the log. Where each firing is one row of the log, `firing` is the row's number; with ON and OFF it is not. |
//! | `movement` | what a body did over a span; the spans of a resident follow each other without gaps |
//! | `room` | in which room a resident is from an instant on; none between rooms or away |
//! | `activity` | what a resident did over a span |
//! | `act` | how a resident left a thing that they used: 1 is on or open |
//! | `need` | how strong a need was, from 0 (met) to 1 (pressing) |
//! | `condition` | how severe a condition is from an instant on; 1 is a moderate case |
//! | `lost` | what a sensor said, or should have said, that never reached the logger, and why |
//! | `run` | which run it was |
//!
//! Instants are written as in the log, sensors under the ids they have there. No table looks like a log to whoever
//! reads logs: where there are sensors, two instants stand side by side.

use crate::clock::Clock;
use crate::error::LogError;
use crate::fresh::same_file;
use crate::logger::RunInfo;
use crate::mapping::Shown;
use crate::messages::RowValue;
use crate::sink::database::{Database, Insert};
use crate::sink::run;
use crate::url::Url;
use crate::writer::{BATCH, BATCH_WAITS, Sink, Writer};
use homebody_core::drivers::MotionSegment;
use homebody_core::event::{Events, Fact, Firing, Loss, MotionState, Need, Provenance, ThingUse, Trigger, Value};
use homebody_core::geometry::Point;
use homebody_core::ids::{ResidentId, RoomId, SensorId};
use homebody_core::scenario::calendar::Calendar;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::scenario::path::Posture;
use homebody_core::time::Micros;
use rusqlite::types::Null;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

/// What the indices in facts mean.
#[derive(Clone, Copy, Debug)]
pub struct Names<'a> {
    pub residents: &'a [String],
    pub rooms: &'a [String],
    pub things: &'a [String],
    pub sensors: &'a [String],
}

/// Stores facts; it is used as a [`Logger`](crate::Logger) is.
pub struct TruthLog {
    writer: Writer<Known>,
    /// What does not fill a batch yet.
    known: Vec<Known>,
    sent_at: Instant,
}

/// What is stored of a fact.
enum Known {
    Provenance { seq: u64, provenance: Provenance, firing: Option<Firing> },
    Lost { at: Micros, sensor: SensorId, value: Value, provenance: Provenance, loss: Loss },
    Act { resident: ResidentId, at: Micros, act: ThingUse },
    Need { resident: ResidentId, at: Micros, need: Need, level: f64 },
    Condition { resident: ResidentId, at: Micros, name: String, severity: f64 },
    Movement(Movement),
    Room { resident: ResidentId, at: Micros, room: Option<RoomId> },
    Activity { resident: ResidentId, at: Micros, name: Option<String> },
}

/// What somebody's body did.
#[derive(Clone)]
struct Movement {
    resident: ResidentId,
    span: MotionSegment,
}

impl TruthLog {
    /// Creates the database; one that exists is replaced with `force` only, one of the log's own `places` never.
    pub fn open(
        path: &Path,
        places: &[Url],
        file: &LoggerFile,
        names: Names,
        calendar: &Calendar,
        run: &RunInfo,
        force: bool,
    ) -> Result<TruthLog, LogError> {
        if places.iter().any(|place| same_file(place.path(), path)) {
            return Err(LogError::SameFile { path: path.into() });
        }
        let sink = TruthSink::open(path, file, names, calendar, run, force)?;
        Ok(TruthLog { writer: Writer::spawn(Box::new(sink)), known: Vec::new(), sent_at: Instant::now() })
    }

    /// Stores the facts of an advance of the run.
    pub fn store(&mut self, events: &Events) -> Result<(), LogError> {
        for fact in &events.facts {
            self.known.push(known(fact, &events.firings));
            if self.known.len() >= BATCH {
                self.send()?;
            }
        }
        if self.sent_at.elapsed() >= BATCH_WAITS { self.send() } else { Ok(()) }
    }

    /// Makes sure of all facts; what residents are doing ends with the run.
    pub fn finish(mut self, end: Micros) -> Result<(), LogError> {
        self.send()?;
        self.writer.finish(end)
    }

    fn send(&mut self) -> Result<(), LogError> {
        self.sent_at = Instant::now();
        match std::mem::take(&mut self.known) {
            known if known.is_empty() => self.writer.check(),
            known => self.writer.send(Arc::new(known)),
        }
    }
}

/// A fact, with the firing it is about.
fn known(fact: &Fact, firings: &[Firing]) -> Known {
    match *fact {
        Fact::Provenance { seq, provenance } => {
            // Firings are numbered without gaps.
            let place = firings.first().and_then(|first| seq.checked_sub(first.seq));
            let firing = place.and_then(|place| firings.get(place as usize)).filter(|firing| firing.seq == seq);
            Known::Provenance { seq, provenance, firing: firing.copied() }
        }
        Fact::Movement { resident, begin, end, doing, posture } => {
            Known::Movement(Movement { resident, span: MotionSegment { begin, end, doing, posture } })
        }
        Fact::Room { resident, at, room } => Known::Room { resident, at, room },
        Fact::Activity { resident, at, ref name } => Known::Activity { resident, at, name: name.clone() },
        Fact::Lost { at, sensor, value, provenance, loss } => Known::Lost { at, sensor, value, provenance, loss },
        Fact::Use { resident, at, act } => Known::Act { resident, at, act },
        Fact::Need { resident, at, need, level } => Known::Need { resident, at, need, level },
        Fact::Condition { resident, at, ref name, severity } => {
            Known::Condition { resident, at, name: name.clone(), severity }
        }
    }
}

/// The database of the truth.
struct TruthSink {
    database: Database,
    clock: Clock,
    residents: Vec<String>,
    rooms: Vec<String>,
    things: Vec<String>,
    shown: Shown,
    /// What each resident is doing, and since when.
    doing: Vec<Option<(Micros, String)>>,
    /// Each resident's last movement: where the run is stopped, it ends sooner than it was going to.
    moving: Vec<Option<Movement>>,
    /// The rooms that these are going to come through: who, when, and which.
    coming: Vec<(ResidentId, Micros, Option<RoomId>)>,
    run: i64,
    inserts: Inserts,
}

struct Inserts {
    cause: Insert,
    movement: Insert,
    room: Insert,
    activity: Insert,
    act: Insert,
    need: Insert,
    condition: Insert,
    lost: Insert,
}

/// An activity that is over.
struct Done {
    resident: ResidentId,
    begin: Micros,
    end: Micros,
    name: String,
}

impl TruthSink {
    fn open(
        path: &Path,
        file: &LoggerFile,
        names: Names,
        calendar: &Calendar,
        run: &RunInfo,
        force: bool,
    ) -> Result<TruthSink, LogError> {
        let mut clock = Clock::new(calendar, file.time);
        let tables = tables(run::time_type(file.time));
        let begin = run::begin(run, file.time, &mut clock);
        let database = Database::create(path, force, &tables.each_ref().map(String::as_str), begin)?;
        let insert = |table, columns: &[&str]| Insert::new(table, ("run_id", run.id), columns);
        Ok(TruthSink {
            database,
            clock,
            residents: names.residents.to_vec(),
            rooms: names.rooms.to_vec(),
            things: names.things.to_vec(),
            shown: Shown::new(file, names.sensors)?,
            doing: vec![None; names.residents.len()],
            moving: vec![None; names.residents.len()],
            coming: Vec::new(),
            run: run.id,
            inserts: Inserts {
                cause: insert("cause", &["firing", "resident", "seen_at", "fired_at", "sensor", "why", "thing"]),
                movement: insert("movement", &MOVEMENT),
                room: insert("room", &["resident", "at", "room"]),
                activity: insert("activity", &["resident", "begin_at", "end_at", "name"]),
                act: insert("act", &["resident", "at", "thing", "is_on"]),
                need: insert("need", &["resident", "at", "need", "level"]),
                condition: insert("condition", &["resident", "at", "name", "severity"]),
                lost: insert("lost", &["sensor", "value", "sent_at", "seen_at", "loss", "resident", "why", "thing"]),
            },
        })
    }

    /// Ends what a resident was doing and begins what is next; the activity that is over.
    fn turn(&mut self, resident: ResidentId, at: Micros, next: Option<String>) -> Option<Done> {
        let next = next.map(|name| (at, name));
        let (begin, name) = std::mem::replace(&mut self.doing[resident.index()], next)?;
        Some(Done { resident, begin, end: at, name })
    }

    fn write_movements(&mut self, movements: &[Movement]) -> Result<(), LogError> {
        let TruthSink { database, clock, residents, inserts, .. } = self;
        database.change(movements.len(), |connection| {
            inserts.movement.rows(connection, movements, |movement, row| {
                row.put(&residents[movement.resident.index()])?;
                row.put(clock.stamp(movement.span.begin))?;
                row.put(clock.stamp(movement.span.end))?;
                let (kind, from, to, amplitude) = told(&movement.span.doing);
                row.put(kind)?;
                for point in [from, to] {
                    row.put(point.map(|point| point.x))?;
                    row.put(point.map(|point| point.y))?;
                }
                row.put(amplitude)?;
                row.put(posture_name(movement.span.posture))
            })
        })
    }

    fn write_rooms(&mut self, entered: &[(ResidentId, Micros, Option<RoomId>)]) -> Result<(), LogError> {
        let TruthSink { database, clock, residents, rooms, inserts, .. } = self;
        database.change(entered.len(), |connection| {
            inserts.room.rows(connection, entered, |(resident, at, room), row| {
                row.put(&residents[resident.index()])?;
                row.put(clock.stamp(*at))?;
                row.put(room.map(|room| &rooms[room.index()]))
            })
        })
    }

    fn write_activities(&mut self, done: &[Done]) -> Result<(), LogError> {
        let TruthSink { database, clock, residents, inserts, .. } = self;
        database.change(done.len(), |connection| {
            inserts.activity.rows(connection, done, |done, row| {
                row.put(&residents[done.resident.index()])?;
                row.put(clock.stamp(done.begin))?;
                row.put(clock.stamp(done.end))?;
                row.put(&done.name)
            })
        })
    }

    /// Why messages came, and which ones never did.
    fn write_messages(&mut self, known: &[Known]) -> Result<(), LogError> {
        let TruthSink { database, clock, residents, things, shown, inserts, .. } = self;
        let causes: Vec<_> = known
            .iter()
            .filter_map(|fact| match fact {
                Known::Provenance { seq, provenance, firing } => Some((*seq, provenance, firing)),
                _ => None,
            })
            .collect();
        let lost: Vec<_> = known
            .iter()
            .filter_map(|fact| match fact {
                Known::Lost { at, sensor, value, provenance, loss } => Some((*at, *sensor, *value, provenance, *loss)),
                _ => None,
            })
            .collect();
        let mut text = String::new();
        database.change(causes.len() + lost.len(), |connection| {
            inserts.cause.rows(connection, &causes, |(seq, provenance, firing), row| {
                row.put(*seq as i64)?;
                row.put(provenance.resident.map(|resident| &residents[resident.index()]))?;
                row.put(clock.stamp(provenance.seen_at))?;
                match firing {
                    Some(firing) => {
                        row.put(clock.stamp(firing.at))?;
                        row.put(&shown.sensors[firing.sensor.index()])?;
                    }
                    None => {
                        row.put(Null)?;
                        row.put(Null)?;
                    }
                }
                let (why, thing) = reason(provenance.trigger);
                row.put(why)?;
                row.put(thing.map(|thing| &things[thing]))
            })?;
            inserts.lost.rows(connection, &lost, |(at, sensor, value, provenance, loss), row| {
                row.put(&shown.sensors[sensor.index()])?;
                row.put(shown.value(RowValue::Value(*value), &mut text))?;
                row.put(clock.stamp(*at))?;
                row.put(clock.stamp(provenance.seen_at))?;
                row.put(loss_name(*loss))?;
                row.put(provenance.resident.map(|resident| &residents[resident.index()]))?;
                let (why, thing) = reason(provenance.trigger);
                row.put(why)?;
                row.put(thing.map(|thing| &things[thing]))
            })
        })
    }

    /// What was used, needs and conditions.
    fn write_the_rest(&mut self, known: &[Known]) -> Result<(), LogError> {
        let TruthSink { database, clock, residents, things, inserts, .. } = self;
        let (mut acts, mut needs, mut conditions) = (Vec::new(), Vec::new(), Vec::new());
        for fact in known {
            match fact {
                Known::Act { resident, at, act } => acts.push((*resident, *at, *act)),
                Known::Need { resident, at, need, level } => needs.push((*resident, *at, *need, *level)),
                Known::Condition { resident, at, name, severity } => {
                    conditions.push((*resident, *at, name, *severity));
                }
                _ => {}
            }
        }
        database.change(acts.len() + needs.len() + conditions.len(), |connection| {
            inserts.act.rows(connection, &acts, |(resident, at, act), row| {
                row.put(&residents[resident.index()])?;
                row.put(clock.stamp(*at))?;
                row.put(&things[act.thing.index()])?;
                row.put(act.on)
            })?;
            inserts.need.rows(connection, &needs, |(resident, at, need, level), row| {
                row.put(&residents[resident.index()])?;
                row.put(clock.stamp(*at))?;
                row.put(need_name(*need))?;
                row.put(*level)
            })?;
            inserts.condition.rows(connection, &conditions, |(resident, at, name, severity), row| {
                row.put(&residents[resident.index()])?;
                row.put(clock.stamp(*at))?;
                row.put(*name)?;
                row.put(*severity)
            })
        })
    }
}

const MOVEMENT: [&str; 10] =
    ["resident", "begin_at", "end_at", "kind", "from_x", "from_y", "to_x", "to_y", "amplitude_m", "posture"];

/// The statements that create the tables.
fn tables(time: &str) -> [String; 8] {
    [
        format!(
            "cause (run_id INTEGER, firing INTEGER, resident TEXT, seen_at {time}, fired_at {time}, sensor TEXT, \
             why TEXT, thing TEXT)"
        ),
        format!(
            "movement (run_id INTEGER, resident TEXT, begin_at {time}, end_at {time}, kind TEXT, \
             from_x REAL, from_y REAL, to_x REAL, to_y REAL, amplitude_m REAL, posture TEXT)"
        ),
        format!("room (run_id INTEGER, resident TEXT, at {time}, room TEXT)"),
        format!("activity (run_id INTEGER, resident TEXT, begin_at {time}, end_at {time}, name TEXT)"),
        format!("act (run_id INTEGER, resident TEXT, at {time}, thing TEXT, is_on INTEGER)"),
        format!("need (run_id INTEGER, resident TEXT, at {time}, need TEXT, level REAL)"),
        format!("condition (run_id INTEGER, resident TEXT, at {time}, name TEXT, severity REAL)"),
        format!(
            "lost (run_id INTEGER, sensor TEXT, value TEXT, sent_at {time}, seen_at {time}, loss TEXT, resident TEXT, \
             why TEXT, thing TEXT)"
        ),
    ]
    .map(|table| format!("CREATE TABLE {table}"))
}

impl Sink for TruthSink {
    type Row = Known;

    fn path(&self) -> &Path {
        self.database.path()
    }

    fn write(&mut self, known: &[Known]) -> Result<(), LogError> {
        let (mut movements, mut rooms, mut done) = (Vec::new(), Vec::new(), Vec::new());
        for fact in known {
            match fact {
                Known::Movement(movement) => {
                    let begun = |room: &mut (ResidentId, Micros, _)| {
                        room.0 == movement.resident && room.1 <= movement.span.begin
                    };
                    rooms.extend(self.coming.extract_if(.., begun));
                    movements.extend(self.moving[movement.resident.index()].replace(movement.clone()));
                }
                Known::Room { resident, at, room } => self.coming.push((*resident, *at, *room)),
                Known::Activity { resident, at, name } => done.extend(self.turn(*resident, *at, name.clone())),
                _ => {}
            }
        }
        self.write_movements(&movements)?;
        self.write_rooms(&rooms)?;
        self.write_activities(&done)?;
        self.write_messages(known)?;
        self.write_the_rest(known)
    }

    fn settle(&mut self) -> Result<(), LogError> {
        self.database.settle()
    }

    fn finish(mut self: Box<Self>, end: Micros) -> Result<(), LogError> {
        let nothing = |resident| Known::Activity { resident, at: end, name: None };
        let last: Vec<Known> = (0..self.residents.len()).map(ResidentId::of).map(nothing).collect();
        self.write(&last)?;
        let cut = |moving: Movement| Movement { span: moving.span.until(end), ..moving };
        let last: Vec<Movement> = self.moving.iter_mut().filter_map(|moving| moving.take().map(cut)).collect();
        self.write_movements(&last)?;
        let last: Vec<_> = self.coming.drain(..).filter(|&(_, at, _)| at < end).collect();
        self.write_rooms(&last)?;
        run::end(&mut self.database, self.run, self.clock.stamp(end))?;
        self.database.close()
    }
}

fn posture_name(posture: Posture) -> &'static str {
    match posture {
        Posture::Standing => "standing",
        Posture::Sitting => "sitting",
        Posture::Lying => "lying",
    }
}

/// What a body does, where from, where to, and how far what moves moves.
fn told(doing: &MotionState) -> (&'static str, Option<Point>, Option<Point>, Option<f64>) {
    match *doing {
        MotionState::Stride { from, to } => ("stride", Some(from), Some(to), None),
        MotionState::InPlace { at, amplitude_m } => ("in_place", Some(at), Some(at), Some(amplitude_m)),
        MotionState::Rest { at } => ("rest", Some(at), Some(at), None),
        MotionState::Away => ("away", None, None, None),
    }
}

/// The kind of a cause, and the thing that was used where one was.
fn reason(trigger: Trigger) -> (&'static str, Option<usize>) {
    match trigger {
        Trigger::Movement => ("movement", None),
        Trigger::Use(thing) => ("act", Some(thing.index())),
        Trigger::Reading => ("reading", None),
        Trigger::Duplicate => ("duplicate", None),
        Trigger::False => ("false", None),
    }
}

fn loss_name(loss: Loss) -> &'static str {
    match loss {
        Loss::Radio => "radio",
        Loss::Collision => "collision",
        Loss::Miss => "miss",
        Loss::Battery => "battery",
        Loss::Place => "place",
        Loss::Stuck => "stuck",
        Loss::Garbled => "garbled",
        Loss::Outage => "outage",
    }
}

fn need_name(need: Need) -> &'static str {
    match need {
        Need::Toilet => "toilet",
        Need::Thirst => "thirst",
        Need::Hunger => "hunger",
        Need::Tiredness => "tiredness",
    }
}
