//! A log as a map: its hours, day by day.

use homebody_core::time::{ClockChange, DAY, HOUR, Interval, MINUTE, Span, TimeScale, UtcTime, WallTime, without};
use homebody_log::{Event, Log};
use jiff::civil::Date;
use jiff::tz::TimeZone;
use serde::Serialize;
use std::collections::BTreeMap;

use super::{CellSum, DensityCell, Entrance, HomeAbsence, HourState, LEAST, Leaving, PresenceSign, SEATED};
use crate::dates::{MOST_DAYS, written};
use crate::holds::{HiddenMovement, HoldTimes, LONGEST};
use crate::rows::{Ongoing, StateRow, Tallies};
use crate::signs::{Kind, LogSensors, OwnWords, Says, UnknownStates, is_seat};

/// Silence of all sensors after which nothing is recorded.
pub const SILENCE: Span = DAY;
/// Unknown time after which the resident may have come home and left again.
const UNSEEN: Span = MINUTE.times(10);

#[derive(Clone, Debug)]
pub struct DensityOptions {
    /// The sensors at the entrance; empty to find them by their names.
    pub doors: Vec<String>,
    pub away_after: Span,
    /// The time of the recording, if that is known.
    pub recorded: Option<Interval<WallTime>>,
    /// The zone on whose wall the log is, if that is known: on a day on which clocks are set, it gives the length of the hours.
    pub zone: Option<TimeZone>,
    /// The first day; `None`: the first of the log.
    pub from: Option<Date>,
    /// The number of days; `None`: to the last of the log.
    pub days: Option<usize>,
}

impl Default for DensityOptions {
    fn default() -> DensityOptions {
        DensityOptions { doors: Vec::new(), away_after: LEAST, recorded: None, zone: None, from: None, days: None }
    }
}

homebody_core::messages! {
    /// Reasons why a log has no density map and no measures.
    #[derive(Clone, PartialEq, Eq)]
    pub enum NoMap in "measure" {
        /// The density map and the measures of days count the rows of a log. This log has none of sensors.
        Empty error "no-rows" ("the log has no rows");
        /// The density map and the measures of days count movements, which motion sensors report. Homebody recognises a motion sensor by
        /// its kind, its name and its values.
        NoMotion error "no-motion-sensors" ("no sensor of the log reports motion")
            hint ("motion sensors send ON, FIRE, true or 1 when they see a person");
        /// Sensors with names of motion sensors send two words that Homebody does not know, so their rows count as readings.
        NotUnderstood(remarks: Vec<String>) error "unknown-states"
            ("no sensor of the log reports motion: {}", remarks.join("; "))
            hint ("replace the two words by ON and OFF in the log");
        /// Systems such as Home Assistant write `unavailable` or `unknown` for a sensor that does not answer. The motion sensors of this log
        /// have no other values.
        Unknown error "never-known" ("all values of the motion sensors are words such as unavailable or unknown");
        /// The density map and the measures of days have a limit of ten years, so that a wrong date does not exhaust the memory.
        TooLong(days: usize) error "too-many-days" ("the log covers {days} days, and the limit is ten years");
        /// The requested first day is before the first row of the log, or after the last.
        NoDay { date: Date, first: Date, last: Date } error "no-such-day" ("the log does not cover {date}")
            hint ("choose a day from {first} to {last}");
        /// The log is too long for the memory, so Homebody reads it a second time. The second reading failed.
        Unread(why: String) error "unreadable" ("Homebody reads a long log twice, and the second reading failed: {why}");
        /// Homebody sorts a log that fits into the memory. This log is longer, so its rows must be in the order of time.
        Disorder {
            at: WallTime,
            /// The time of an earlier row of the file, in microseconds.
            before: WallTime,
        } error "out-of-order" (
            "the log is too long to sort in memory, and its rows are out of order: {row} comes after {earlier}",
            row = written(*at),
            earlier = written(*before)
        )
            hint ("sort the rows of the log by time");
    }
}

impl NoMap {
    /// The reason for a log without a sensor that tells of motion.
    pub(crate) fn no_motion(log: &Log) -> NoMap {
        match OwnWords::from_log(log).not_understood() {
            [] => NoMap::NoMotion,
            remarks => NoMap::NotUnderstood(remarks.to_vec()),
        }
    }
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Map {
    pub name: String,
    pub from: Date,
    pub events: u64,
    pub motion_sensors: usize,
    pub left_out: Vec<String>,
    pub entrance: Entrance,
    pub recorded_h: f64,
    pub away_h: f64,
    /// Firings an hour at home, if a person was ever at home.
    pub density_per_h: Option<f64>,
    pub away_h_per_day: f64,
    pub days: Vec<MapDay>,
    pub hours: Vec<Hour>,
    pub absences: Vec<HomeAbsence>,
    /// By day and hour.
    #[serde(skip)]
    pub cells: Vec<[DensityCell; 24]>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MapDay {
    pub date: Date,
    #[serde(flatten)]
    pub sum: CellSum,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Hour {
    pub hour: usize,
    #[serde(flatten)]
    pub sum: CellSum,
}

impl Map {
    pub fn from_log(name: &str, log: &Log, asked: &DensityOptions) -> Result<Map, NoMap> {
        let mut mapping = Mapping::new(log, LogSensors::from_log(log), asked);
        log.in_order().into_iter().for_each(|event| mapping.take(event));
        mapping.end(name)
    }

    fn sum(name: &str, from: Date, cells: Vec<[DensityCell; 24]>, found: MapContext) -> Map {
        let first = WallTime::midnight(from);
        let days = cells.iter().zip(0..);
        let days =
            days.map(|(day, number)| MapDay { date: (first + number * DAY).date(), sum: CellSum::from_cells(day) });
        let hours = (0..24).map(|hour| Hour { hour, sum: CellSum::from_cells(cells.iter().map(|day| &day[hour])) });
        let all = CellSum::from_cells(cells.iter().flatten());
        let recorded_days = all.recorded_h / 24.0;
        Map {
            name: name.into(),
            from,
            events: all.events,
            motion_sensors: found.motion_sensors,
            left_out: found.left_out,
            entrance: found.entrance,
            recorded_h: all.recorded_h,
            away_h: all.away_h,
            density_per_h: all.density_per_h,
            away_h_per_day: if recorded_days > 0.0 { all.away_h / recorded_days } else { 0.0 },
            days: days.collect(),
            hours: hours.collect(),
            absences: found.absences,
            cells,
        }
    }

    /// The cells as rows of a table: `date,hour,events,athome_h,density`; without a density in an empty home, and without hours at home if
    /// nothing is known.
    pub fn csv(&self) -> String {
        let mut text = String::from("date,hour,events,athome_h,density\n");
        for (day, cells) in self.days.iter().zip(&self.cells) {
            for (hour, cell) in cells.iter().enumerate() {
                let [at_home, density] = match cell.state() {
                    HourState::NoData => [String::new(), String::new()],
                    HourState::Away => [format!("{:.4}", cell.at_home_h()), String::new()],
                    HourState::Density(density) => [format!("{:.4}", cell.at_home_h()), format!("{density:.4}")],
                };
                text += &format!("{},{hour},{},{at_home},{density}\n", day.date, cell.events);
            }
        }
        text
    }
}

/// Finds the signs of the resident among rows, by the kinds of their sensors.
pub struct Signs {
    kinds: Vec<Kind>,
    at_entrance: Vec<bool>,
}

impl Signs {
    pub fn new(ids: &[String], kinds: &[Kind], entrance: &Entrance) -> Signs {
        let at_entrance = ids.iter().map(|name| entrance.sensors.contains(name)).collect();
        Signs { kinds: kinds.to_vec(), at_entrance }
    }

    pub fn sign(&self, row: &StateRow) -> Option<PresenceSign> {
        let sensor = row.sensor as usize;
        let (kind, at_entrance) = (self.kinds[sensor], self.at_entrance[sensor]);
        let is_use = matches!(kind, Kind::Contact | Kind::Used) && row.said.begins();
        let opens_door = self.is_door(row);
        (is_use || self.is_motion(row)).then_some(PresenceSign { at: row.at, at_entrance, opens_door, is_use })
    }

    pub fn of_movement(&self, movement: &HiddenMovement) -> PresenceSign {
        let at_entrance = self.at_entrance[movement.sensor as usize];
        PresenceSign { at: movement.at, at_entrance, opens_door: false, is_use: false }
    }

    pub fn kind(&self, sensor: u32) -> Kind {
        self.kinds[sensor as usize]
    }

    pub fn is_motion(&self, row: &StateRow) -> bool {
        self.kinds[row.sensor as usize] == Kind::Motion && row.said.says == Says::Begins && row.said.begins()
    }

    pub fn is_door(&self, row: &StateRow) -> bool {
        let sensor = row.sensor as usize;
        self.kinds[sensor] == Kind::Contact && self.at_entrance[sensor]
    }

    /// A contact at the entrance shows who leaves and comes.
    pub fn has_door(&self) -> bool {
        self.kinds.iter().zip(&self.at_entrance).any(|(kind, at)| *at && *kind == Kind::Contact)
    }
}

/// A map under construction. It takes the rows of its log in the order of time, and keeps no row.
pub struct Mapping<'a> {
    log: &'a Log,
    asked: &'a DensityOptions,
    sensors: LogSensors,
    entrance: Entrance,
    signs: Signs,
    rows: Tallies,
    is_seat: Vec<bool>,
    taken: Ongoing,
    leaving: Leaving,
    holds: HoldTimes,
    /// Signs that wait until all before them are known, by their instants.
    waiting: BTreeMap<(WallTime, u64), PresenceSign>,
    count: u64,
    absences: Vec<HomeAbsence>,
    /// Events of motion by their hour since 1970, of the days that may be in the map.
    events: BTreeMap<i64, u64>,
    has_signs: bool,
    /// The first row and the last, and the long silences of all sensors.
    span: Option<(WallTime, WallTime)>,
    silences: Vec<Interval<WallTime>>,
    gaps: usize,
    unknown: UnknownStates,
}

impl<'a> Mapping<'a> {
    /// For a log, whose own rows it does not look at.
    pub fn new(log: &'a Log, sensors: LogSensors, asked: &'a DensityOptions) -> Mapping<'a> {
        let entrance = Entrance::find(&log.sensors, &sensors, &asked.doors);
        Mapping {
            log,
            asked,
            signs: Signs::new(&log.sensors, &sensors.kinds, &entrance),
            rows: Tallies::new(log),
            is_seat: sensors.called.iter().map(|name| is_seat(name)).collect(),
            taken: Ongoing::new(log.sensors.len(), SEATED),
            leaving: Leaving::new(asked.away_after),
            holds: HoldTimes::new(log.sensors.len()),
            waiting: BTreeMap::new(),
            count: 0,
            absences: Vec::new(),
            events: BTreeMap::new(),
            has_signs: false,
            span: None,
            silences: Vec::new(),
            gaps: 0,
            unknown: UnknownStates::new(log.sensors.len()),
            sensors,
            entrance,
        }
    }

    pub fn take(&mut self, event: &Event) {
        while let Some(gap) = self.log.gaps.get(self.gaps).filter(|gap| gap.begin <= event.at) {
            self.taken.end_all(gap.begin);
            self.leave_until(WallTime::MAX);
            self.holds.end_all();
            self.absences.extend(self.leaving.last());
            self.leaving.forget();
            self.gaps += 1;
        }
        let (first, last) = self.span.unwrap_or((event.at, event.at));
        if event.at - last > SILENCE {
            self.silences.push(Interval::new(last, event.at));
        }
        self.span = Some((first, event.at));
        let row = self.rows.take(event);
        let is_unknown = row.is_some_and(|row| row.said.says == Says::Unknown);
        self.unknown.take(event.at, event.sensor as usize, is_unknown);
        let Some(row) = row else { return };
        if self.is_seat[row.sensor as usize] {
            self.taken.take(&row);
        }
        let mut movements = Vec::new();
        self.holds.take(&row, self.signs.kind(row.sensor), &mut movements);
        movements.iter().for_each(|movement| self.wait(self.signs.of_movement(movement)));
        if let Some(sign) = self.signs.sign(&row) {
            self.has_signs = true;
            self.wait(sign);
        }
        // The signs of other logs need not wait.
        let waits = if self.holds.hide_any() { LONGEST } else { Span::ZERO };
        self.leave_until(row.at - waits);
        if self.signs.is_motion(&row) {
            // No map is longer.
            let hour_of = |at: WallTime| at.since_zero().div_euclid(HOUR);
            let (from, hour) = (hour_of(self.asked.from.map_or(first, WallTime::midnight)), hour_of(row.at));
            if (from - 24..from + MOST_DAYS as i64 * 24).contains(&hour) {
                *self.events.entry(hour).or_default() += 1;
            }
        }
    }

    fn wait(&mut self, sign: PresenceSign) {
        self.waiting.insert((sign.at, self.count), sign);
        self.count += 1;
    }

    fn leave_until(&mut self, until: WallTime) {
        while let Some(first) = self.waiting.first_entry().filter(|first| first.key().0 <= until) {
            self.absences.extend(self.leaving.take(&first.remove()));
        }
    }

    pub fn end(mut self, name: &str) -> Result<Map, NoMap> {
        self.leave_until(WallTime::MAX);
        let (first, last) = self.span.ok_or(NoMap::Empty)?;
        let kinds = &self.sensors.kinds;
        let motion_sensors = kinds.iter().filter(|kind| **kind == Kind::Motion).count();
        if !self.has_signs || motion_sensors == 0 {
            return Err(NoMap::no_motion(self.log));
        }
        self.absences.extend(self.leaving.last());
        let taken: Vec<Interval<WallTime>> =
            (0..kinds.len()).flat_map(|sensor| self.taken.spans(sensor, None)).collect();
        // An hour is not known while no motion sensor is in a state that is known.
        let unknown = self.unknown.of_all(&self.log.gaps, &|sensor| kinds[sensor] == Kind::Motion);
        let is_seen = |absence: &HomeAbsence| unknown.iter().all(|span| span.overlap(absence.interval()) <= UNSEEN);
        let is_one = |absence: &&HomeAbsence| !absence.is_taken(&taken) && is_seen(absence);
        let absences: Vec<HomeAbsence> = self.absences.iter().filter(is_one).copied().collect();
        let rows = Interval::new(first, last + Span::MICROSECOND);
        let recorded = match self.asked.recorded {
            Some(span) => vec![span.hull(rows)],
            None => without_silences(rows, &self.silences, &absences),
        };
        let recorded = without(&recorded, &unknown);
        let known = recorded.iter().copied().reduce(Interval::hull).ok_or(NoMap::Unknown)?;
        let days = days(self.asked, rows.hull(known))?;
        let mut cells = vec![[DensityCell::default(); 24]; days.count];
        for (&hour, &events) in &self.events {
            if let Some(cell) = days.cell(&mut cells, WallTime::EPOCH + hour * HOUR) {
                cell.events += events;
            }
        }
        let set = self.asked.zone.as_ref().map_or_else(Vec::new, |zone| clocks_set(days.interval(), zone));
        for span in recorded {
            days.add_lived(&mut cells, span, &set, |cell, hours| cell.recorded_h += hours);
        }
        for absence in &absences {
            days.add_lived(&mut cells, absence.interval(), &set, |cell, hours| cell.away_h += hours);
        }
        let shown = |absence: &&HomeAbsence| absence.interval().overlaps(days.interval());
        let left_out = self.log.sensors.iter().zip(kinds).filter(|(_, kind)| **kind != Kind::Motion);
        let left_out = left_out.map(|(name, _)| name.clone()).collect();
        let absences = absences.iter().filter(shown).copied().collect();
        let found = MapContext { motion_sensors, left_out, entrance: self.entrance, absences };
        Ok(Map::sum(name, days.first, cells, found))
    }
}

/// The rest of the log for a map: what is not in its cells.
struct MapContext {
    motion_sensors: usize,
    left_out: Vec<String>,
    entrance: Entrance,
    absences: Vec<HomeAbsence>,
}

struct DayColumns {
    first: Date,
    count: usize,
}

fn days(asked: &DensityOptions, span: Interval<WallTime>) -> Result<DayColumns, NoMap> {
    let (first, last) = (span.begin.date(), (span.end - Span::MICROSECOND).date());
    let from = asked.from.unwrap_or(first);
    if !(first..=last).contains(&from) {
        return Err(NoMap::NoDay { date: from, first, last });
    }
    let there = ((WallTime::midnight(last) - WallTime::midnight(from)) / DAY + 1) as usize;
    let count = asked.days.unwrap_or(there).min(there);
    if count > MOST_DAYS { Err(NoMap::TooLong(count)) } else { Ok(DayColumns { first: from, count }) }
}

impl DayColumns {
    fn interval(&self) -> Interval<WallTime> {
        Interval::starting(WallTime::midnight(self.first), self.count as i64 * DAY)
    }

    fn cell<'c>(&self, cells: &'c mut [[DensityCell; 24]], at: WallTime) -> Option<&'c mut DensityCell> {
        let hours = (at - self.interval().begin).div_euclid(HOUR);
        let hour = usize::try_from(hours).ok()?;
        cells.get_mut(hour / 24).map(|day| &mut day[hour % 24])
    }

    fn add(&self, cells: &mut [[DensityCell; 24]], span: Interval<WallTime>, add: impl Fn(&mut DensityCell, f64)) {
        let Interval { begin: mut at, end } = span.intersection(self.interval());
        while at < end {
            let next = (at - at.since_zero().rem_euclid(HOUR) + HOUR).min(end);
            if let Some(cell) = self.cell(cells, at) {
                add(cell, (next - at).seconds() / 3600.0);
            }
            at = next;
        }
    }

    /// The same in real time: the span lacks a time that the clock on the wall leaves out, and has twice what it shows again.
    fn add_lived(
        &self,
        cells: &mut [[DensityCell; 24]],
        span: Interval<WallTime>,
        set: &[ClockChange<WallTime>],
        add: impl Fn(&mut DensityCell, f64),
    ) {
        self.add(cells, span, &add);
        for change in set {
            let lasts = Interval::new(change.at, change.at + change.by.abs());
            self.add(cells, span.intersection(lasts), |cell, hours| {
                add(cell, if change.is_back() { hours } else { -hours });
            });
        }
    }
}

/// The changes of the clocks of a zone during a span on its wall: the first time that they leave out, or show again.
fn clocks_set(span: Interval<WallTime>, zone: &TimeZone) -> Vec<ClockChange<WallTime>> {
    // The wall is never further than a day from UTC.
    let range = Interval::new(span.begin - DAY, span.end + DAY).map(WallTime::as_of_utc);
    let scale = TimeScale::new(UtcTime::EPOCH, zone, range);
    let on_wall = |set: ClockChange<UtcTime>| {
        let after = scale.to_wall(set.at);
        ClockChange { at: after.min(after - set.by), by: set.by }
    };
    scale.changes().map(on_wall).collect()
}

/// From the first row to the last, without silences that no absence explains.
fn without_silences(
    rows: Interval<WallTime>,
    silences: &[Interval<WallTime>],
    absences: &[HomeAbsence],
) -> Vec<Interval<WallTime>> {
    let mut recorded = Vec::new();
    let mut begin = rows.begin;
    for silence in silences {
        let is_away = absences.iter().any(|absence| absence.begin <= silence.begin && silence.end <= absence.end);
        if !is_away {
            recorded.push(Interval::new(begin, silence.begin + Span::MICROSECOND));
            begin = silence.end;
        }
    }
    recorded.push(Interval::new(begin, rows.end));
    recorded
}
