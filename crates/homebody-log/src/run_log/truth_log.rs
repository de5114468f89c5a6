//! Keeps a run's ground truth in a separate place: no file of firings ever holds it.
//!
//! [`tables`] are its tables, the same for all kinds of places. Instants are written as in the log, sensors have the ids of the log. No
//! reader of logs takes a table for a log: tables with sensors have two columns of instants.
//!
//! The order of rows depends on the run alone, and not on the strides of its caller: so the same run gives the same bytes.

use super::logger::RowsOfFirings;
use crate::destination::writer::{BATCH, BATCH_WAITS, Writer};
use crate::destination::{Destination, Treatment};
use crate::error::{LogError, place_of};
use crate::files::{WriteMode, all_can_be_written, same_file};
use crate::policy::SinkMetrics;
use crate::run::RunInfo;
use crate::sink::{Begin, Watermark};
use crate::table::truth::{Truth, TruthKept, tables};
use crate::table::{Batch, Cell, ShownTexts, TextId, TextPool};
use crate::url::Url;
use homebody_core::calendar::Calendar;
use homebody_core::event::{BodilyNeed, Events, Fact, Loss, Provenance, Trigger};
use homebody_core::geometry::Point;
use homebody_core::ids::{ResidentId, RoomId, SensorId, ThingId};
use homebody_core::intervention::Intervention;
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::scenario::logger::{LoggerFile, TimeFormat};
use homebody_core::time::{DAY, Interval, RunTime, Span};
use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

/// Stores facts; it is used as a [`Logger`](crate::Logger) is.
pub struct TruthLog {
    writer: Writer,
    texts: TextPool,
    shown: ShownTexts,
    sensors: Vec<TextId>,
    residents: Vec<TextId>,
    rooms: Vec<TextId>,
    things: Vec<TextId>,
    /// The present activity of each resident, and its begin.
    doing: Vec<Option<(RunTime, TextId)>>,
    /// The rooms that a stride under way is going to come through: who, when, and which.
    coming: Vec<(ResidentId, RunTime, Option<RoomId>)>,
    /// The rows that end a hold and are not told yet: each comes before the cause of the next row.
    offs: VecDeque<(u64, u64)>,
    /// By table, its place among those that are kept.
    kept: Vec<Option<usize>>,
    batch: Batch,
    sent_at: Instant,
    sent: u64,
    /// `None` for instants with their offset or in UTC.
    set_backs: Option<SetBacks>,
}

/// The instants at which the clock on the wall of a home is set back.
struct SetBacks {
    calendar: Calendar,
    known: Vec<RunTime>,
    /// Up to when they are known.
    until: RunTime,
}

impl SetBacks {
    fn new(calendar: &Calendar) -> SetBacks {
        SetBacks { calendar: calendar.clone(), known: Vec::new(), until: RunTime::START }
    }

    /// The first piece of an interval, up to the next of these instants, and the rest. Told on the wall, an interval over one of them would
    /// end before it begins, or an hour early. A piece ends a microsecond before the clock is set back: the instant itself is on the wall
    /// an hour earlier.
    fn split(&mut self, time: Interval<RunTime>) -> (Interval<RunTime>, Option<Interval<RunTime>>) {
        if time.end > self.until {
            let length = time.end.since_zero().saturating_add(400 * DAY);
            let changes = self.calendar.scale(length);
            self.known = changes.run_changes().filter(|change| change.is_back()).map(|change| change.at).collect();
            self.until = RunTime::START + length;
        }
        let next = self.known.partition_point(|&at| at <= time.begin);
        match self.known.get(next).filter(|&&at| at < time.end) {
            Some(&at) => (Interval::new(time.begin, at - Span::MICROSECOND), Some(Interval::new(at, time.end))),
            None => (time, None),
        }
    }
}

impl TruthLog {
    /// Opens the place of the truth, which must differ from the log's own `places`.
    pub fn open(
        url: &Url,
        places: &[Url],
        file: &LoggerFile,
        run: &Arc<RunInfo>,
        how: WriteMode,
    ) -> Result<TruthLog, LogError> {
        let logs: Vec<&Path> = places.iter().filter_map(Url::file).collect();
        TruthLog::open_keeping(TruthKept::All, url, (&logs, &Treatment::default()), file, run, how)
    }

    /// Opens the place of a truth that keeps so much. These files of logs may not be its place, and a server gets its treatment.
    pub(crate) fn open_keeping(
        kept: TruthKept,
        url: &Url,
        (logs, as_said): (&[&Path], &Treatment),
        file: &LoggerFile,
        run: &Arc<RunInfo>,
        how: WriteMode,
    ) -> Result<TruthLog, LogError> {
        let files = url.files(&kept.tables());
        if let Some(file) = files.iter().find(|file| logs.iter().any(|log| same_file(log, file))) {
            return Err(LogError::SameFile { place: place_of(file) });
        }
        if how != WriteMode::Resume {
            all_can_be_written(&files.iter().map(PathBuf::as_path).collect::<Vec<_>>(), how == WriteMode::Overwrite)?;
        }
        let destination = Destination::new(url);
        let destination = if url.server().is_some() { destination.treated(as_said) } else { destination };
        TruthLog::keeping(kept, destination, file, run, how)
    }

    /// Stores the truth in a destination.
    pub fn into(
        destination: Destination,
        file: &LoggerFile,
        run: &Arc<RunInfo>,
        how: WriteMode,
    ) -> Result<TruthLog, LogError> {
        TruthLog::keeping(TruthKept::All, destination, file, run, how)
    }

    fn keeping(
        kept: TruthKept,
        destination: Destination,
        file: &LoggerFile,
        run: &Arc<RunInfo>,
        how: WriteMode,
    ) -> Result<TruthLog, LogError> {
        let shown = ShownTexts::new(file, &run.sensor_names())?;
        let beginning = Begin::new(run.clone(), kept.tables(), file.time, how);
        let beginning = Begin { spreadsheet_safe: file.spreadsheet_safe, ..beginning };
        let writer = Writer::spawn(destination, &beginning)?;
        let mut texts = TextPool::default();
        let mut log = TruthLog {
            writer,
            sensors: texts.ids(&shown.sensors),
            residents: texts.ids(&run.residents),
            rooms: texts.ids(&run.rooms),
            things: texts.ids(&run.things),
            doing: vec![None; run.residents.len()],
            coming: Vec::new(),
            offs: VecDeque::new(),
            kept: places_of(kept),
            batch: Batch::default(),
            sent_at: Instant::now(),
            sent: 0,
            shown,
            texts,
            set_backs: (file.time == TimeFormat::Local).then(|| SetBacks::new(&run.calendar)),
        };
        let home = run.home.as_deref().unwrap_or(&run.scenario);
        for (index, name) in run.residents.iter().enumerate() {
            let person = Cell::Text(log.texts.id(&format!("{home}/{name}")));
            let cells = [Cell::Text(log.residents[index]), person];
            log.push(Truth::Resident, cells);
        }
        if let Some(plan) = &run.plan {
            let cells = [&plan.file, &plan.name].map(|text| Cell::Text(log.texts.id(text)));
            log.push(Truth::Home, cells);
        }
        Ok(log)
    }

    /// Stores the facts of an advance of the run; `joined` says which rows of the log tell of its firings.
    pub fn store(&mut self, events: &Events, joined: &RowsOfFirings) -> Result<(), LogError> {
        self.offs.extend(&joined.offs);
        for fact in &events.facts {
            self.take(fact, events, joined);
            if self.batch.len() >= BATCH {
                self.send()?;
            }
        }
        if self.sent_at.elapsed() >= BATCH_WAITS { self.send() } else { Ok(()) }
    }

    pub(crate) fn meter(&self) -> (String, Arc<SinkMetrics>) {
        self.writer.meter()
    }

    /// The watermark of the truth.
    pub fn durable(&self) -> Watermark {
        self.writer.durable()
    }

    /// Has its place make sure of what was stored so far. Nobody waits for that here.
    pub fn make_durable(&mut self) -> Result<(), LogError> {
        self.send()?;
        self.writer.make_durable()
    }

    /// Waits until its place has made sure of what it was asked to.
    pub fn wait_durable(&mut self) -> Result<(), LogError> {
        self.writer.wait_durable()
    }

    /// Whether the run is past all rows that its place had.
    pub(crate) fn is_past_replayed_part(&self) -> bool {
        self.writer.is_past_replayed_part()
    }

    pub(crate) fn rows(&self) -> u64 {
        self.sent + self.batch.len() as u64
    }

    /// Makes sure of all facts; what residents are doing ends with the run.
    pub fn finish(mut self, end: RunTime) -> Result<(), LogError> {
        for resident in (0..self.residents.len()).map(ResidentId::new) {
            self.turn(resident, end, None);
        }
        for (resident, at, room) in std::mem::take(&mut self.coming) {
            if at < end {
                self.push_room(resident, at, room);
            }
        }
        self.tell_offs_before(u64::MAX);
        self.send()?;
        self.writer.finish(end)
    }

    fn send(&mut self) -> Result<(), LogError> {
        self.sent_at = Instant::now();
        if self.batch.is_empty() {
            return self.writer.check();
        }
        let batch = std::mem::replace(&mut self.batch, Batch::with_capacity(BATCH, COLUMNS)).with(&self.texts);
        self.sent += batch.len() as u64;
        self.writer.send(Arc::new(batch))
    }

    /// A row of a table, if that is kept.
    fn push(&mut self, table: Truth, cells: impl IntoIterator<Item = Cell>) {
        if let Some(place) = self.kept[table as usize] {
            self.batch.push(place, cells);
        }
    }

    fn take(&mut self, fact: &Fact, events: &Events, joined: &RowsOfFirings) {
        match *fact {
            Fact::Provenance { seq, provenance } => self.take_cause(seq, provenance, events, joined),
            Fact::Movement { resident, begin, end, doing, posture } => {
                // The next interval has its end.
                self.enter_rooms(resident, end - Span::MICROSECOND);
                let whole = MotionSegment { begin, end, doing, posture };
                let mut left = Some(Interval::new(begin, end));
                while let Some(time) = left {
                    let (piece, rest) = self.split(time);
                    self.push_movement(resident, &whole.within(piece));
                    left = rest;
                }
            }
            Fact::Room { resident, at, room } => self.coming.push((resident, at, room)),
            Fact::Activity { resident, at, ref name } => {
                let name = name.as_ref().map(|name| self.texts.id(name));
                self.turn(resident, at, name);
            }
            Fact::Lost { at, sensor, value, provenance, loss } => {
                let value = self.shown.cell(value, &mut self.texts);
                let loss = Cell::Text(self.texts.id(loss_name(loss)));
                let [who, why, thing] = self.reason(provenance);
                let seen_at = Cell::Instant(provenance.seen_at);
                let cells = [self.sensor(sensor), value, Cell::Instant(at), seen_at, loss, who, why, thing];
                self.push(Truth::Lost, cells);
            }
            Fact::Use { resident, at, act } => {
                let who = resident.map_or(Cell::Null, |resident| self.who(resident));
                let cells = [who, Cell::Instant(at), self.thing(act.thing), Cell::Integer(act.on.into())];
                self.push(Truth::Act, cells);
            }
            Fact::Need { resident, at, need, level } => {
                let need = Cell::Text(self.texts.id(need_name(need)));
                let cells = [self.who(resident), Cell::Instant(at), need, Cell::Real(level)];
                self.push(Truth::Need, cells);
            }
            Fact::Condition { resident, at, ref name, severity } => {
                let name = Cell::Text(self.texts.id(name));
                let cells = [self.who(resident), Cell::Instant(at), name, Cell::Real(severity)];
                self.push(Truth::Condition, cells);
            }
            Fact::Outside { at, ref intervention } => self.take_intervention(at, intervention),
        }
    }

    /// Takes an intervention. A person who falls passes through none of the rooms that were still ahead.
    fn take_intervention(&mut self, at: RunTime, intervention: &Intervention) {
        let (of, until) = match intervention {
            Intervention::Use { thing, .. } => (thing, None),
            Intervention::Fail { sensor, until_us, .. } => (sensor, *until_us),
            Intervention::Fall { resident, lies_us } => {
                let fallen = self.texts.id(resident);
                self.coming.retain(|&(who, when, _)| when < at || self.residents[who.index()] != fallen);
                (resident, Some(at + *lies_us))
            }
        };
        let of = Cell::Text(self.texts.id(of));
        let word = Cell::Text(self.texts.id(intervention.word()));
        let until = until.map_or(Cell::Null, Cell::Instant);
        self.push(Truth::Outside, [Cell::Instant(at), until, word, of]);
    }

    fn take_cause(&mut self, seq: u64, provenance: Provenance, events: &Events, joined: &RowsOfFirings) {
        // Firings are numbered without gaps.
        let place = events.firings.first().and_then(|first| seq.checked_sub(first.seq)).map(|place| place as usize);
        let firing = place.and_then(|place| events.firings.get(place)).filter(|firing| firing.seq == seq);
        let row = place.filter(|_| firing.is_some()).and_then(|place| joined.rows.get(place)).copied();
        self.tell_offs_before(row.unwrap_or(0));
        let [who, why, thing] = self.reason(provenance);
        let cells = [
            Cell::Integer(seq as i64),
            row.map_or(Cell::Null, |row| Cell::Integer(row as i64)),
            who,
            Cell::Instant(provenance.seen_at),
            firing.map_or(Cell::Null, |firing| Cell::Instant(firing.at)),
            firing.map_or(Cell::Null, |firing| self.sensor(firing.sensor)),
            why,
            thing,
        ];
        self.push(Truth::Cause, cells);
    }

    fn tell_offs_before(&mut self, next: u64) {
        while let Some(&(row, firing)) = self.offs.front().filter(|(row, _)| *row < next) {
            self.offs.pop_front();
            self.push(Truth::Off, [Cell::Integer(row as i64), Cell::Integer(firing as i64)]);
        }
    }

    /// Ends what a resident was doing and begins what is next.
    fn turn(&mut self, resident: ResidentId, at: RunTime, next: Option<TextId>) {
        let next = next.map(|name| (at, name));
        if let Some((begin, name)) = std::mem::replace(&mut self.doing[resident.index()], next) {
            let mut left = Some(Interval::new(begin, at));
            while let Some(time) = left {
                let (piece, rest) = self.split(time);
                let cells =
                    [self.who(resident), Cell::Instant(piece.begin), Cell::Instant(piece.end), Cell::Text(name)];
                self.push(Truth::Activity, cells);
                left = rest;
            }
        }
    }

    /// The first row of an interval, and the rest, which has rows of its own.
    fn split(&mut self, time: Interval<RunTime>) -> (Interval<RunTime>, Option<Interval<RunTime>>) {
        self.set_backs.as_mut().map_or((time, None), |set_backs| set_backs.split(time))
    }

    /// The rooms that a resident has come to by an instant.
    fn enter_rooms(&mut self, resident: ResidentId, by: RunTime) {
        let mut index = 0;
        while index < self.coming.len() {
            let (who, at, room) = self.coming[index];
            if who == resident && at <= by {
                self.coming.remove(index);
                self.push_room(who, at, room);
            } else {
                index += 1;
            }
        }
    }

    fn push_room(&mut self, resident: ResidentId, at: RunTime, room: Option<RoomId>) {
        let room = room.map_or(Cell::Null, |room| Cell::Text(self.rooms[room.index()]));
        let cells = [self.who(resident), Cell::Instant(at), room];
        self.push(Truth::Room, cells);
    }

    fn push_movement(&mut self, resident: ResidentId, segment: &MotionSegment) {
        let (kind, from, to, amplitude) = motion_cells(&segment.doing);
        let x = |point: Option<Point>| point.map_or(Cell::Null, |point| Cell::Real(point.x));
        let y = |point: Option<Point>| point.map_or(Cell::Null, |point| Cell::Real(point.y));
        let cells = [
            self.who(resident),
            Cell::Instant(segment.begin),
            Cell::Instant(segment.end),
            Cell::Text(self.texts.id(kind)),
            x(from),
            y(from),
            x(to),
            y(to),
            amplitude.map_or(Cell::Null, Cell::Real),
            Cell::Text(self.texts.id(segment.posture.name())),
        ];
        self.push(Truth::Movement, cells);
    }

    /// The person, the kind of cause, and the thing that was used.
    fn reason(&mut self, provenance: Provenance) -> [Cell; 3] {
        let (why, thing) = match provenance.trigger {
            Trigger::Movement => ("movement", None),
            Trigger::Use(thing) => ("act", Some(thing)),
            Trigger::Reading => ("reading", None),
            Trigger::Duplicate => ("duplicate", None),
            Trigger::False => ("false", None),
        };
        let who = provenance.resident.map_or(Cell::Null, |resident| self.who(resident));
        [who, Cell::Text(self.texts.id(why)), thing.map_or(Cell::Null, |thing| self.thing(thing))]
    }

    fn who(&self, resident: ResidentId) -> Cell {
        Cell::Text(self.residents[resident.index()])
    }

    fn sensor(&self, sensor: SensorId) -> Cell {
        Cell::Text(self.sensors[sensor.index()])
    }

    fn thing(&self, thing: ThingId) -> Cell {
        Cell::Text(self.things[thing.index()])
    }
}

/// By table, its place among those that are kept.
fn places_of(kept: TruthKept) -> Vec<Option<usize>> {
    let mut next = 0..;
    tables().iter().map(|table| kept.has(table).then(|| next.next()).flatten()).collect()
}

/// Initial number of columns of a batch (our choice): most tables have fewer.
const COLUMNS: usize = 10;

/// The kind of a body's motion, its start, its end, and its amplitude.
fn motion_cells(doing: &MotionState) -> (&'static str, Option<Point>, Option<Point>, Option<f64>) {
    match *doing {
        MotionState::Stride { from, to } => ("stride", Some(from), Some(to), None),
        MotionState::InPlace { at, amplitude_m } => ("in_place", Some(at), Some(at), Some(amplitude_m)),
        MotionState::Rest { at } => ("rest", Some(at), Some(at), None),
        MotionState::Away => ("away", None, None, None),
    }
}

pub(crate) fn loss_name(loss: Loss) -> &'static str {
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

pub(crate) fn need_name(need: BodilyNeed) -> &'static str {
    match need {
        BodilyNeed::Toilet => "toilet",
        BodilyNeed::Thirst => "thirst",
        BodilyNeed::Hunger => "hunger",
        BodilyNeed::Tiredness => "tiredness",
    }
}
