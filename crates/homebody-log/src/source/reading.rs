//! A log that is being read: what its rows say, taken one by one, whatever they are read from.

use super::instant::{InstantReader, LogInstant};
use super::messages::FormMessage;
use super::options::TableOptions;
use crate::error::{LogError, Skipped, place_of};
use crate::files::plain::text;
use crate::files::unpacked;
use crate::limits::{LONGEST_ID, LONGEST_VALUE, MOST_ACTIVITIES, beginning};
use crate::log::{ActivityNotes, Clock, ColumnRole, ColumnUse, Event, Log, Pairs, SensorInfo};
use crate::source::instant::date_parts::no_instant;
use foldhash::HashMap;
use homebody_core::calendar::Calendar;
use homebody_core::problem::readable;
use homebody_core::time::{DAY, Interval, Span, UtcTime, WallTime};
use homebody_timeline::Episode;
use jiff::Timestamp;
use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;

/// Largest number of skipped lines that are reported one by one.
const MOST_TOLD: usize = 100;

/// Silence between two files above which there is a gap: a night is shorter.
const LONGEST_SILENCE: Span = Span::from_micros(DAY.micros() / 2);

/// Largest number of activities before a seam that may continue: people do few things at once.
const MOST_JOINED: usize = 100;

/// Rows that are handed over together.
const PART: usize = 8192;

/// A log that is being read, row by row.
pub struct LogReading<'t> {
    /// With the rows that have not been handed over yet.
    pub(crate) log: Log,
    take: &'t mut dyn FnMut(&Log) -> Result<(), LogError>,
    sensors: TextNumbers,
    values: TextNumbers,
    pub(crate) instants: InstantReader,
    notes: ActivityNotes,
    /// The clock of what has come, once something has.
    clock: Option<Clock>,
    /// Lines and clocks of the rows that have come, until the first are handed over.
    first: Option<Vec<(u64, Clock)>>,
    /// Whether whole activities are elsewhere, so that labels on rows only repeat them.
    pub has_spans: bool,
    last: WallTime,
    pub(crate) options: TableOptions,
    /// The log that is being read, for errors.
    pub(crate) place: String,
    /// The file next to the log that is being read, if it is not the log itself.
    beside: Option<String>,
    /// Activities beyond the most that are kept.
    beyond: u64,
    /// The state at the end of the last of several files.
    pub(crate) carried: CarriedState,
    /// The first instants of further files.
    seams: Vec<WallTime>,
    pairs: Pairs,
}

/// The state at the end of a file whose rows contain all sensors.
#[derive(Default)]
pub(crate) struct CarriedState {
    /// The last value of each sensor.
    pub said: BTreeMap<String, String>,
    /// The instant of its last row.
    pub until: Option<LogInstant>,
}

impl<'t> LogReading<'t> {
    pub(crate) fn new(take: &'t mut dyn FnMut(&Log) -> Result<(), LogError>) -> LogReading<'t> {
        LogReading {
            log: Log::default(),
            take,
            sensors: TextNumbers::default(),
            values: TextNumbers::default(),
            instants: InstantReader::default(),
            notes: ActivityNotes::default(),
            clock: None,
            first: Some(Vec::new()),
            has_spans: false,
            last: WallTime::EPOCH,
            options: TableOptions::default(),
            place: String::new(),
            beside: None,
            beyond: 0,
            carried: CarriedState::default(),
            seams: Vec::new(),
            pairs: Pairs::default(),
        }
    }

    /// Takes a row as a file writes it; whether it was understood. Lines are counted from 1.
    ///
    /// # Errors
    ///
    /// Those of who takes the rows.
    pub fn row(&mut self, line: u64, time: &str, sensor: &str, value: &str) -> Result<bool, LogError> {
        self.row_of_bytes(line, time.as_bytes(), sensor.as_bytes(), value.as_bytes())
    }

    /// The same from bytes; invalid UTF-8 is replaced.
    #[inline]
    pub(crate) fn row_of_bytes(
        &mut self,
        line: u64,
        time: &[u8],
        sensor: &[u8],
        value: &[u8],
    ) -> Result<bool, LogError> {
        match self.instants.read_bytes(time) {
            Some(instant) => self.event_of_bytes(line, instant, sensor, value),
            None => {
                self.skip(line, no_instant(&text(time)));
                Ok(false)
            }
        }
    }

    /// Takes a row whose instant is known; whether it was understood.
    ///
    /// # Errors
    ///
    /// Those of who takes the rows.
    pub fn event(&mut self, line: u64, instant: LogInstant, sensor: &str, value: &str) -> Result<bool, LogError> {
        self.event_of_bytes(line, instant, sensor.as_bytes(), value.as_bytes())
    }

    /// The same from bytes. The ids and values of sensors are checked as text once: the same bytes are known from then on.
    pub(crate) fn event_of_bytes(
        &mut self,
        line: u64,
        instant: LogInstant,
        sensor: &[u8],
        value: &[u8],
    ) -> Result<bool, LogError> {
        // While no row has been handed over, most of them are going to say which clock it is.
        let told = if self.first.is_some() { on_any_clock(instant) } else { self.on_clock(instant) };
        let known = self.sensors.known(&self.log.sensors, sensor).zip(self.values.known(&self.log.values, value));
        let told = match (told, known) {
            (Ok(at), Some(known)) => Ok((at, known)),
            (Ok(at), None) => self.learn(sensor, value).map(|known| (at, known)),
            (Err(fault), _) => Err(fault.to_owned()),
        };
        let (at, (sensor, value)) = match told {
            Ok(told) => told,
            Err(fault) => {
                self.skip(line, fault);
                return Ok(false);
            }
        };
        if let Some(first) = &mut self.first {
            first.push((line, instant.clock()));
        }
        if self.clock.is_none() {
            self.keep_clock(instant);
        }
        if self.log.events.len() == PART {
            self.hand_over()?;
        }
        self.log.events.push(Event { at, sensor, value });
        self.log.rows += 1;
        self.last = at;
        Ok(true)
    }

    /// The numbers of a sensor and of a value, at least one of them new; or the reason why there is none.
    #[cold]
    fn learn(&mut self, sensor: &[u8], value: &[u8]) -> Result<(u32, u32), String> {
        let (sensor, value) = (text(sensor), text(value));
        named(&sensor, "sensor", LONGEST_ID)?;
        named(&value, "value", LONGEST_VALUE)?;
        Ok((self.sensors.of(&mut self.log.sensors, &sensor), self.values.of(&mut self.log.values, &value)))
    }

    /// An instant on the wall of the log, or why it is on none.
    fn on_clock(&self, instant: LogInstant) -> Result<WallTime, &'static str> {
        let at = on_any_clock(instant)?;
        match self.clock {
            Some(known) if known != instant.clock() => Err(OTHER_CLOCK),
            _ => Ok(at),
        }
    }

    fn keep_clock(&mut self, instant: LogInstant) {
        self.clock = Some(instant.clock());
        self.log.clock = instant.clock();
    }

    pub(crate) fn hand_over(&mut self) -> Result<(), LogError> {
        if let Some(first) = self.first.take() {
            self.decide_clock(&first);
        }
        self.few_sensors()?;
        self.log.offsets.clone_from(&self.instants.offsets);
        if !self.log.events.is_empty() {
            (self.take)(&self.log)?;
            self.pairs.take(&self.log.events);
            self.log.events.clear();
        }
        Ok(())
    }

    /// Refuses names that hardly come again: sensors do.
    fn few_sensors(&self) -> Result<(), LogError> {
        let (sensors, rows) = (self.log.sensors.len(), self.log.rows);
        if sensors <= FEW_SENSORS || 2 * sensors as u64 <= rows {
            return Ok(());
        }
        Err(LogError::no_log(self.place.as_str(), FormMessage::ManyNames { rows, names: sensors }))
    }

    /// Decides the clock of the log: that of most of its first rows. Rows with the other are left out.
    fn decide_clock(&mut self, first: &[(u64, Clock)]) {
        let utc = first.iter().filter(|(_, clock)| *clock == Clock::Utc).count();
        if utc == 0 || utc == first.len() {
            return;
        }
        let most = if 2 * utc > first.len() { Clock::Utc } else { Clock::Local };
        (self.clock, self.log.clock) = (Some(most), most);
        let mut of_rows = first.iter();
        self.log.events.retain(|_| of_rows.next().is_none_or(|(_, clock)| *clock == most));
        self.log.rows = self.log.events.len() as u64;
        for (line, _) in first.iter().filter(|(_, clock)| *clock != most) {
            self.skip(*line, OTHER_CLOCK.into());
        }
        self.log.problems.sort_by_key(|problem| problem.line);
    }

    /// Takes the name of the zone of the log's home, before the first row. UTC is also the name for a zone that is not known.
    pub fn in_zone(&mut self, name: &str) {
        self.log.zone = Calendar::zone(name).ok().filter(|_| name != "UTC");
    }

    /// Takes a note, at the last row, that an activity begins or ends.
    pub(crate) fn note(&mut self, name: &str, begins: bool) {
        if self.log.rows > 0 {
            self.note_at(name, begins, self.last);
        }
    }

    pub(crate) fn note_of(&mut self, instant: LogInstant, name: &str, begins: bool) {
        if let Ok(at) = self.on_clock(instant)
            && !self.has_spans
        {
            self.note_at(name, begins, at);
        }
    }

    fn note_at(&mut self, name: &str, begins: bool, at: WallTime) {
        if name.len() > LONGEST_VALUE {
            self.beyond += 1;
            return;
        }
        let ended = self.notes.take(name, begins, at);
        self.keep(ended);
    }

    /// Whether any activity, note or label has come.
    pub(crate) fn has_activities(&self) -> bool {
        !self.log.activities.is_empty() || self.notes.has_any()
    }

    /// Takes the label of the last row, if it has one. It holds until a row has another.
    pub fn label(&mut self, name: Option<&str>) {
        if self.has_spans {
            return;
        }
        self.label_at(name, self.last);
    }

    pub(crate) fn label_of(&mut self, instant: LogInstant, name: Option<&str>) {
        if let Ok(at) = self.on_clock(instant) {
            self.label_at(name, at);
        }
    }

    fn label_at(&mut self, name: Option<&str>, at: WallTime) {
        let is_long = name.is_some_and(|name| name.len() > LONGEST_VALUE);
        self.beyond += u64::from(is_long);
        let ended = self.notes.label(name.filter(|_| !is_long), at);
        self.keep(ended);
    }

    /// The instant of a text.
    pub fn instant(&mut self, text: &str) -> Option<LogInstant> {
        self.instants.read(text)
    }

    /// Takes an activity with both ends.
    pub fn span(&mut self, line: u64, begin: LogInstant, end: LogInstant, name: &str) {
        let told = match (self.on_clock(begin), self.on_clock(end)) {
            _ if name.is_empty() => Err("there is no activity"),
            _ if name.len() > LONGEST_VALUE => Err("the activity's name is too long"),
            (Ok(begin), Ok(end)) if end < begin => Err(ENDS_BEFORE),
            (Ok(begin), Ok(end)) => Ok(Interval::new(begin, end)),
            (Err(fault), _) | (_, Err(fault)) => Err(fault),
        };
        match told {
            Ok(time) => {
                self.keep_clock(begin);
                self.keep(Some(Episode::new(name.into(), time)));
            }
            Err(fault) => self.skip(line, fault.into()),
        }
    }

    /// Ends open activities at the last row.
    fn end_notes(&mut self) {
        for activity in self.notes.end(self.last) {
            self.keep(Some(activity));
        }
    }

    fn keep(&mut self, activity: Option<Episode<WallTime>>) {
        match activity {
            Some(_) if self.log.activities.len() >= MOST_ACTIVITIES => self.beyond += 1,
            activity => self.log.activities.extend(activity),
        }
    }

    /// Tells that a line, or a row by its number, is not understood, and why.
    pub fn skip(&mut self, line: u64, why: String) {
        self.log.skipped += 1;
        if self.log.problems.len() < MOST_TOLD {
            self.log.problems.push(Skipped { line, beside: self.beside.clone(), why });
        }
    }

    /// Keeps what the source reports of a sensor: its name, kind, unit and room. Values from a table of
    /// sensors next to the log and earlier values stay; new ones fill the gaps.
    pub fn know(&mut self, sensor: SensorInfo) {
        match self.log.known.iter_mut().find(|known| known.id == sensor.id) {
            Some(known) => known.fill(sensor),
            None => self.log.known.push(sensor),
        }
    }

    /// Records that nothing was recorded meanwhile, on the wall of the log.
    pub fn gap(&mut self, gap: Interval<WallTime>) {
        self.log.gaps.push(gap);
    }

    /// Records what a column was taken for, and why.
    pub fn column(&mut self, column: &str, used_as: ColumnRole, because: &str) {
        self.column_use(ColumnUse { column: column.into(), used_as, because: because.into(), is_guess: false });
    }

    /// Records the parts of a row where no heading names them, and the form has each in its place.
    pub(crate) fn columns_of_form(&mut self, parts: &[(&str, ColumnRole)]) {
        parts.iter().for_each(|(part, role)| self.column(part, *role, "the form has it there"));
    }

    pub(crate) fn column_use(&mut self, of: ColumnUse) {
        // The log itself has its columns already.
        if self.beside.is_some() && self.seams.is_empty() {
            return;
        }
        // Each of several files has the same ones.
        if self.log.columns.iter().all(|known| (&known.column, known.used_as) != (&of.column, of.used_as)) {
            self.log.columns.push(of);
        }
    }

    /// Begins a further file of the log, with its first instant. A long silence before it is a gap.
    pub(crate) fn continue_with(&mut self, file: &Path, begin: Option<WallTime>) {
        self.go_beside(file);
        let Some(begin) = begin.filter(|_| self.log.rows > 0) else { return };
        self.seams.push(begin);
        // Readers whose rows contain all sensors record gaps themselves.
        if self.carried.until.is_none() && begin - self.last >= LONGEST_SILENCE {
            self.end_notes();
            self.gap(Interval::new(self.last, begin));
        }
    }

    fn join_at_seams(&mut self) {
        if self.seams.is_empty() {
            return;
        }
        let mut joined: Vec<Episode<WallTime>> = Vec::with_capacity(self.log.activities.len());
        for activity in self.log.activities.drain(..) {
            let is_further = self.seams.contains(&activity.begin());
            let before = joined.iter_mut().rev().take(MOST_JOINED).filter(|_| is_further);
            let before = before.into_iter().find(|of| of.end() == activity.begin() && of.label == activity.label);
            match before {
                Some(before) => before.time.end = activity.end(),
                None => joined.push(activity),
            }
        }
        self.log.activities = joined;
    }

    pub(crate) fn go_beside(&mut self, file: &Path) {
        self.options = TableOptions { dates: self.options.dates, ..TableOptions::default() };
        self.beside = Some(readable(place_of(file)));
    }

    /// Ends the reading: the log without the rows that have been handed over.
    pub(crate) fn end(mut self) -> Result<Log, LogError> {
        self.hand_over()?;
        self.end_notes();
        self.log.pairs = std::mem::take(&mut self.pairs).end(&self.log.values);
        // Notes are known once they end.
        self.log.activities.sort_by_key(Episode::begin);
        self.join_at_seams();
        for (count, what) in [
            (self.notes.alone, "notes that an activity begins or ends have no other end"),
            (self.beyond, "activities are left out: they are too many, or their names too long"),
        ] {
            if count > 0 {
                self.log.remarks.push(format!("{count} {what}"));
            }
        }
        Ok(self.log)
    }
}

/// A log may have so many sensors with a row or two each.
const FEW_SENSORS: usize = 1000;

/// The reason to skip a row.
const OTHER_CLOCK: &str = "some instants have a zone and some have none";

/// Makes sure that a row has a part, and not too much of it.
fn named(text: &str, what: &str, most: usize) -> Result<(), String> {
    match text {
        "" => Err(format!("there is no {what}")),
        // Characters are counted only where they may be too many.
        _ if text.len() > most && text.chars().count() > most => {
            Err(format!("the {what} {} has more than {most} characters", beginning(text)))
        }
        _ => Ok(()),
    }
}

fn on_any_clock(instant: LogInstant) -> Result<WallTime, &'static str> {
    let at = instant.on_wall();
    if is_on_any_clock(at) { Ok(at) } else { Err("the time is out of range") }
}

/// The reason to skip an activity.
pub(crate) const ENDS_BEFORE: &str = "it ends before it begins";

/// The text of a file that may hold a log, unpacked if necessary.
pub(crate) fn open(path: &Path) -> Result<Box<dyn Read + Send>, LogError> {
    unpacked(path).map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound => LogError::Missing { place: place_of(path) },
        _ => LogError::file(path, error),
    })
}

/// Whether the instant exists in every zone: some programs write 9999-12-31 for never.
fn is_on_any_clock(at: WallTime) -> bool {
    let [first, last] = [Timestamp::MIN, Timestamp::MAX].map(|end| UtcTime::from(end).on_wall_of_utc());
    Interval::new(first + DAY, last - DAY).contains(at)
}

struct TextNumbers {
    known: HashMap<Box<[u8]>, u32>,
    /// Those that were asked for last, at places that a look at a text's ends tells: sensors say the same again and again.
    last: [u32; PLACES],
}

/// Numbers of names in the cache (our choice): a home has fewer sensors, most with distinct endings.
const PLACES: usize = 64;

impl Default for TextNumbers {
    fn default() -> TextNumbers {
        TextNumbers { known: HashMap::default(), last: [0; PLACES] }
    }
}

impl TextNumbers {
    /// The number of a text that has come before.
    #[inline]
    fn known(&mut self, all: &[String], bytes: &[u8]) -> Option<u32> {
        let (first, last, before) = (bytes.first()?, bytes.last()?, bytes[bytes.len().saturating_sub(2)]);
        let place = bytes.len() + usize::from(*first) + 3 * usize::from(before) + 7 * usize::from(*last);
        let at_hand = &mut self.last[place % PLACES];
        if all.get(*at_hand as usize).is_none_or(|known| known.as_bytes() != bytes) {
            *at_hand = *self.known.get(bytes)?;
        }
        Some(*at_hand)
    }

    /// The number of a text, a new one if it is new.
    fn of(&mut self, all: &mut Vec<String>, text: &str) -> u32 {
        *self.known.entry(text.as_bytes().into()).or_insert_with(|| {
            all.push(text.into());
            all.len() as u32 - 1
        })
    }
}
