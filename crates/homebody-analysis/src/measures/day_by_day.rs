//! Measures of a log, day by day: the values of a day follow from the rows up to its end, and later rows never change them.
//!
//! Only rows of the last days are kept. Of earlier rows these things carry over: the kinds of sensors, how long ways usually take,
//! how lively hours usually are, the height of a level of density, absences, and spans that are open.

use super::company::{Usual, company};
use super::heard::{Heard, Named};
use super::held::{Day, Silent};
use super::kinds::{MEASURES, Measure};
use super::known::Known;
use super::known_time::{KnownDay, KnownTime};
use super::of_day::{Common, OfDay, UNKNOWN_H};
use super::rooms::Rooms;
use super::signs::{Sign, gives_signs, signs, with_movements};
use super::silent::Listening;
use super::timeline::{Timeline, within_h};
use super::walking::Paces;
use crate::dates::{MOST_DAYS, date_of};
use crate::density::{Absence, Asked, Cell, Chosen, Entrance, Leaving, NoMap, SEATED, Signs, apart};
use crate::holds::{Holds, Movement};
use crate::rows::{Ongoing, Row, Span, Tallies};
use crate::signs::{Kind, LogSensors, is_seat};
use homebody_core::time::{DAY, Micros, SECOND};
use homebody_log::{Event, Log};
use std::collections::VecDeque;
use std::ops::Range;

/// Rows of so many days before are read again with a day, as much begins before midnight.
const DAYS_BEFORE: Micros = 2;
/// Two weeks: so many days are compared, and the first so many whole days give the height of a level of density.
const WEEKS: usize = 14;
/// Largest number of rows of a home on a day. Further rows are ignored, and the day has no measures.
const MOST_ROWS: usize = 250_000;
/// Absences are kept for so long: in an empty home no sensor is silent.
const ABSENCES_KEPT: Micros = 70 * DAY;
const HOUR: Micros = 3600 * SECOND;

/// Measures a log row by row, in the order of time.
pub struct Measuring<'a> {
    pub(super) log: &'a Log,
    pub(super) known: Known<'a>,
    asked: Asked,
    called: Vec<String>,
    named: Named,
    all_rooms: Rooms,
    rows: Tallies,
    /// The midnight at which the current day began; `None` before the first row.
    day: Option<Micros>,
    /// The rows of the last days, without numbers; and how many of them are of days before the current one.
    window: Vec<Row>,
    of_days_before: usize,
    /// Whether more rows came on the day than are kept.
    is_full: bool,
    /// By sensor, the first and the last of the day's numbers and other words.
    other: Vec<Option<Span>>,
    so_far: SoFar,
    days: Vec<Day>,
}

/// The measures of a whole log.
pub struct Measured {
    /// The days.
    pub days: Vec<Day>,
    /// The sensors that fell silent.
    pub silent: Vec<Silent>,
    /// The sensors at the way out.
    pub entrance: Entrance,
    /// Whether silence alone shows some absences.
    pub guesses_absences: bool,
    /// The rooms of all sensors, of thermometers too.
    pub all_rooms: Rooms,
    /// On how many days there were more rows than are looked at.
    pub crowded: usize,
    /// Whether any sensor looks for movement.
    pub has_motion: bool,
    /// The timeline of the last day.
    pub timeline: Timeline,
}

/// Knowledge that carries over from day to day.
struct SoFar {
    time: KnownTime,
    kinds: Vec<Kind>,
    /// As the kinds of the sensors tell it.
    entrance: Entrance,
    knows_entrance: bool,
    /// Whether a contact is at the entrance.
    has_door: bool,
    rooms: Rooms,
    has_spoken: Vec<bool>,
    has_bed: bool,
    /// How many signs there were in rooms that are known, and how many of them are movements that were seen.
    signs: [u64; 2],
    ongoing: Ongoing,
    is_seat: Vec<bool>,
    /// The spans over which a bed or a chair is taken for long.
    taken: Ongoing,
    leaving: Leaving,
    holds: Holds,
    /// The movements of the last days that lie between reports.
    movements: Vec<Movement>,
    /// The absences of the last weeks that are over, and whether any ever was a guess.
    absences: Vec<Absence>,
    guesses_absences: bool,
    listening: Listening,
    paces: Paces,
    usual: Usual,
    /// The last days: for how long each hour is known, and what it holds.
    history: VecDeque<([f64; 24], [Cell; 24])>,
    /// The cells of the first days that are whole, until they are enough.
    first_cells: Vec<[Cell; 24]>,
    step_per_h: Option<f64>,
    /// The timeline of the last day.
    last: Timeline,
    /// Whether any sensor looks for movement, and whether there was any sign of the resident.
    has_motion: bool,
    has_signs: bool,
    /// On how many days there were more rows than are looked at.
    crowded: usize,
}

impl<'a> Measuring<'a> {
    /// For a log, whose rows come by `take`. `known` describes its home.
    pub fn new(log: &'a Log, known: Known<'a>, asked: &Asked) -> Measuring<'a> {
        let called = log.called();
        let count = log.sensors.len();
        let so_far = SoFar {
            time: KnownTime::new(asked.recorded.clone(), &log.gaps),
            kinds: vec![Kind::Reading; count],
            entrance: Entrance { sensors: Vec::new(), chosen: Chosen::None },
            knows_entrance: false,
            has_door: false,
            rooms: Rooms::default(),
            has_spoken: vec![false; count],
            has_bed: false,
            signs: [0; 2],
            ongoing: Ongoing::new(count, 0),
            is_seat: called.iter().map(|name| is_seat(name)).collect(),
            taken: Ongoing::new(count, SEATED),
            leaving: Leaving::new(asked.away_after),
            holds: Holds::new(count),
            movements: Vec::new(),
            absences: Vec::new(),
            guesses_absences: false,
            listening: Listening::new(count),
            paces: Paces::default(),
            usual: Usual::default(),
            history: VecDeque::new(),
            first_cells: Vec::new(),
            step_per_h: None,
            last: Timeline::default(),
            has_motion: false,
            has_signs: false,
            crowded: 0,
        };
        Measuring {
            log,
            known,
            asked: asked.clone(),
            named: Named::of(&called),
            all_rooms: Rooms::of(&log.sensors, known.rooms),
            rows: Tallies::new(log),
            day: None,
            window: Vec::new(),
            of_days_before: 0,
            is_full: false,
            other: vec![None; count],
            called,
            so_far,
            days: Vec::new(),
        }
    }

    /// Takes the next row. A row of an earlier day than the last row is left out.
    ///
    /// # Errors
    ///
    /// [`NoMap::TooLong`] where the days are too many.
    pub fn take(&mut self, event: &Event) -> Result<(), NoMap> {
        let date = event.at - event.at.rem_euclid(DAY);
        let began = self.asked.recorded.as_ref().map_or(event.at, |recorded| recorded.start.min(event.at));
        let day = *self.day.get_or_insert(began - began.rem_euclid(DAY));
        let days = self.days.len() as Micros + (date - day) / DAY;
        if days >= MOST_DAYS as Micros {
            return Err(NoMap::TooLong(days as usize + 1));
        }
        while self.day.is_some_and(|day| day < date) {
            self.end_day(Some(event.at));
        }
        if date < day {
            return Ok(());
        }
        self.so_far.time.take(event.at);
        match self.rows.take(event) {
            Some(row) if self.window.len() - self.of_days_before < MOST_ROWS => self.window.push(row),
            Some(_) => self.is_full = true,
            None => {
                if let Some(other) = self.other.get_mut(event.sensor as usize) {
                    *other = Some((other.map_or(event.at, |other| other.0), event.at));
                }
            }
        }
        Ok(())
    }

    /// The span of the recording so far, if there is any.
    pub(super) fn recorded(&self) -> Option<Range<Micros>> {
        let time = &self.so_far.time;
        self.asked.recorded.clone().or_else(|| Some(time.first()?..time.last()? + 1))
    }

    /// Ends the log, and returns its days.
    ///
    /// # Errors
    ///
    /// Those that [`NoMap`] lists.
    pub fn end(mut self) -> Result<Measured, NoMap> {
        let mut last = self.so_far.time.last().ok_or(NoMap::Empty)?;
        last = self.asked.recorded.as_ref().map_or(last, |recorded| last.max(recorded.end - 1));
        let first = self.day.map_or(last, |day| day - self.days.len() as Micros * DAY);
        let days = ((last - first) / DAY) as usize + 1;
        if days > MOST_DAYS {
            return Err(NoMap::TooLong(days));
        }
        while self.day.is_some_and(|day| day <= last) {
            self.end_day(None);
        }
        let so_far = self.so_far;
        if !so_far.has_signs {
            return Err(NoMap::no_motion(self.log));
        }
        let away = so_far.away(last + 1);
        let silent = so_far.listening.told(&self.log.sensors, &so_far.kinds, &away, last);
        Ok(Measured {
            days: self.days,
            silent,
            entrance: so_far.entrance,
            guesses_absences: so_far.guesses_absences,
            all_rooms: self.all_rooms,
            crowded: so_far.crowded,
            has_motion: so_far.has_motion,
            timeline: so_far.last,
        })
    }

    /// Ends a day and measures it; `next` is the instant of the next row.
    fn end_day(&mut self, next: Option<Micros>) {
        let Some(begin) = self.day else { return };
        let (end, from) = (begin + DAY, self.of_days_before);
        self.window[from..].sort_by_key(|row| row.at);
        if self.window.len() > from {
            self.know_sensors(from);
        }
        self.go_through(from, (begin, end));
        let recorded = self.asked.recorded.as_ref().map(|recorded| recorded.end);
        let is_over = next.is_some() || recorded.is_some_and(|until| until >= end);
        let now =
            if is_over { end } else { recorded.max(self.so_far.time.last()).map_or(end, |last| end.min(last + 1)) };
        let away = self.so_far.away(now);
        self.listen(from, &away);
        if std::mem::take(&mut self.is_full) {
            self.so_far.crowded += 1;
            self.so_far.time.forget((begin, end));
        }
        let known = self.so_far.time.end_day(begin, next, &away);
        let timeline = self.timeline(begin, &away, &known);
        let number = timeline.days() - 1;
        let common = Common::of(&timeline, self.so_far.step_per_h);
        let day = OfDay::new(&common, number, is_over);
        let lacking = self.so_far.listening.on_day((begin, now), &self.so_far.kinds, &away);
        let sensors = &self.so_far.entrance.sensors;
        let at_entrance = |sensor: usize| sensors.contains(&self.log.sensors[sensor]);
        let value = |measure: &Measure| {
            let is_hindered = lacking.hinders(measure, &timeline.rooms, &at_entrance);
            (measure.of)(&day).filter(|_| !is_hindered)
        };
        let values = MEASURES.iter().map(value).collect();
        self.days.push(Day { date: date_of(begin), is_whole: day.is_known(), values });
        self.so_far.remember(timeline, begin);
        let keeps = end - DAYS_BEFORE * DAY;
        self.window.retain(|row| row.at >= keeps);
        self.of_days_before = self.window.len();
        self.other.fill(None);
        self.day = Some(end);
    }

    /// Learns the kinds of sensors from the rows of a day, and which of them give signs.
    fn know_sensors(&mut self, from: usize) {
        let so_far = &mut self.so_far;
        let sensors = LogSensors { kinds: self.rows.kinds(), called: std::mem::take(&mut self.called) };
        for row in &self.window[from..] {
            let sensor = row.sensor as usize;
            so_far.has_spoken[sensor] |= gives_signs(sensors.kinds[sensor], &row.said);
        }
        let has_spoken = &so_far.has_spoken;
        let is_one =
            |sensor: usize| has_spoken[sensor] && !matches!(sensors.kinds[sensor], Kind::Reading | Kind::Other);
        so_far.rooms = self.all_rooms.among(&is_one);
        if !std::mem::replace(&mut so_far.knows_entrance, true) || so_far.kinds != sensors.kinds {
            so_far.entrance = Entrance::find(&self.log.sensors, &sensors, &self.asked.doors);
        }
        so_far.has_motion |= sensors.kinds.contains(&Kind::Motion);
        so_far.has_door = Signs::new(&self.log.sensors, &sensors.kinds, &so_far.entrance).has_door();
        self.called = sensors.called;
        so_far.kinds = sensors.kinds;
    }

    /// Takes the rows of a day for open spans and for absences.
    fn go_through(&mut self, from: usize, (begin, end): Span) {
        let so_far = &mut self.so_far;
        let signs = Signs::new(&self.log.sensors, &so_far.kinds, &so_far.entrance);
        let all_breaks = so_far.time.breaks((begin, end));
        let mut breaks = all_breaks.iter().copied().peekable();
        let mut movements = Vec::new();
        for row in &self.window[from..] {
            while let Some(at) = breaks.next_if(|at| *at <= row.at) {
                so_far.break_off(at);
            }
            so_far.ongoing.take(row);
            if so_far.is_seat[row.sensor as usize] {
                so_far.taken.take(row);
            }
            so_far.holds.take(row, so_far.kinds[row.sensor as usize], &mut movements);
        }
        breaks.for_each(|at| so_far.break_off(at));
        so_far.holds.pass(end, &mut movements);
        let of_rows = self.window[from..].iter().filter_map(|row| signs.of(row));
        let mut all: Vec<_> = of_rows.collect();
        so_far.has_signs |= !all.is_empty();
        all.extend(movements.iter().filter(|movement| movement.at >= begin).map(|of| signs.of_movement(of)));
        all.sort_by_key(|sign| sign.at);
        so_far.leave(&all, &all_breaks, end);
        so_far.movements.extend(movements);
        let is_bed = |sensor: usize| self.named.is_bed(sensor, so_far.kinds[sensor]);
        let lies = |sensor: usize| so_far.ongoing.spans(sensor, Some(end)).iter().any(|span| span.1 > span.0);
        so_far.has_bed |= (0..so_far.kinds.len()).any(|sensor| is_bed(sensor) && lies(sensor));
    }

    /// Takes the times at which sensors reported on a day.
    fn listen(&mut self, from: usize, away: &[Span]) {
        let mut spoken: Vec<(Micros, usize)> =
            self.window[from..].iter().map(|row| (row.at, row.sensor as usize)).collect();
        for (sensor, other) in self.other.iter().enumerate() {
            spoken.extend(other.iter().flat_map(|&(first, last)| [(first, sensor), (last, sensor)]));
        }
        // The rows are in order of time already, which this kind of sorting makes use of.
        spoken.sort();
        for (at, sensor) in spoken {
            self.so_far.listening.take(at, sensor, self.so_far.kinds[sensor], away);
        }
    }

    /// The timeline of the last days, when one of them ends.
    fn timeline(&mut self, begin: Micros, away: &[Span], known: &KnownDay) -> Timeline {
        let so_far = &mut self.so_far;
        let signs = signs(&self.window, &so_far.kinds, &so_far.rooms, &so_far.holds);
        let today = &signs[signs.partition_point(|sign| sign.at < begin)..];
        let seen: Vec<Sign> = today.iter().filter(|sign| sign.is_seen).copied().collect();
        so_far.signs[0] += today.len() as u64;
        so_far.signs[1] += seen.len() as u64;
        let at_entrance = Signs::new(&self.log.sensors, &so_far.kinds, &so_far.entrance);
        let door: Vec<Micros> = self.window.iter().filter(|row| at_entrance.is_door(row)).map(|row| row.at).collect();
        so_far.usual.add(today, door.last().is_some_and(|last| *last >= begin));
        let passages = so_far.paces.of_day(&seen);
        let mut cells = known.cells();
        for row in self.window.iter().filter(|row| row.at >= begin && at_entrance.is_motion(row)) {
            cells[((row.at - begin) / HOUR) as usize].events += 1;
        }
        for &span in away {
            for (hour, cell) in (0..).zip(&mut cells) {
                cell.away_h += within_h(&[span], (begin + hour * HOUR, begin + (hour + 1) * HOUR));
            }
        }
        so_far.keep_cells(known.hours, cells);
        let history = so_far.history.iter();
        let mut timeline = Timeline {
            first: date_of(begin - (so_far.history.len() as Micros - 1) * DAY),
            begin: begin - (so_far.history.len() as Micros - 1) * DAY,
            recorded_h: history.clone().map(|day| day.0).collect(),
            cells: so_far.has_motion.then(|| history.map(|day| day.1).collect()),
            rooms: so_far.rooms.clone(),
            is_unwatched: 2 * so_far.signs[1] < so_far.signs[0],
            unknown: known.unknown.clone(),
            away: (!so_far.entrance.sensors.is_empty()).then(|| away.to_vec()),
            passages: so_far.paces.is_known().then_some(passages),
            company: company(&signs, &door, &so_far.usual, known.until),
            ..Timeline::default()
        };
        let heard = Heard {
            ids: &self.log.sensors,
            kinds: &so_far.kinds,
            spans: &|sensor| so_far.ongoing.spans(sensor, Some(known.until)),
            ways: self.known.ways,
            named: &self.named,
            has_bed: so_far.has_bed,
            has_spoken: &so_far.has_spoken,
            holds: &so_far.holds,
            until: known.until,
        };
        timeline.hear(&heard, &with_movements(&signs, &so_far.movements, &so_far.rooms));
        timeline
    }
}

impl SoFar {
    /// The absences, as known at an instant.
    fn away(&self, now: Micros) -> Vec<Span> {
        let last = self.leaving.last().into_iter().chain(self.leaving.open(now, self.has_door));
        let taken = self.taken_until(now);
        let last = last.filter(|absence| !absence.is_taken(&taken));
        self.absences.iter().copied().chain(last).map(|absence| (absence.begin, absence.end)).collect()
    }

    fn taken_until(&self, now: Micros) -> Vec<Span> {
        (0..self.is_seat.len()).flat_map(|sensor| self.taken.spans(sensor, Some(now))).collect()
    }

    fn add_absence(&mut self, absence: Absence, now: Micros) {
        if !absence.is_taken(&self.taken_until(now)) {
            self.guesses_absences |= absence.is_guess;
            self.absences.push(absence);
        }
    }

    /// Ends open spans where an unknown time begins.
    fn break_off(&mut self, at: Micros) {
        self.ongoing.end_all(at);
        self.taken.end_all(at);
        self.holds.end_all();
        self.paces.forget();
    }

    /// Looks for absences in the signs of a day. A resident who left before a gap may have come back in it.
    fn leave(&mut self, signs: &[crate::density::Sign], breaks: &[Micros], end: Micros) {
        let mut gaps = breaks.iter().copied().filter(|at| self.time.is_gap(*at)).collect::<VecDeque<_>>();
        for sign in signs {
            while gaps.front().is_some_and(|at| *at <= sign.at) {
                self.leave_before(gaps.pop_front().unwrap_or(end));
            }
            if let Some(absence) = self.leaving.take(sign) {
                self.add_absence(absence, end);
            }
        }
        gaps.into_iter().for_each(|at| self.leave_before(at));
    }

    fn leave_before(&mut self, gap: Micros) {
        if let Some(absence) = self.leaving.last() {
            self.add_absence(absence, gap);
        }
        self.leaving.forget();
    }

    /// Keeps the hours of a day with those of the last two weeks. The first whole days give the height of a level of density.
    fn keep_cells(&mut self, hours: [f64; 24], cells: [Cell; 24]) {
        self.history.push_back((hours, cells));
        if self.history.len() > WEEKS {
            self.history.pop_front();
        }
        if self.step_per_h.is_none() && hours.iter().sum::<f64>() > 24.0 - UNKNOWN_H {
            self.first_cells.push(cells);
            if self.first_cells.len() == WEEKS {
                self.step_per_h = Some(apart::step_per_h(&std::mem::take(&mut self.first_cells)));
            }
        }
    }

    /// Keeps what later days need of a day, and drops the rest.
    fn remember(&mut self, timeline: Timeline, begin: Micros) {
        self.last = timeline;
        self.ongoing.retain(|span| span.1 >= begin - (DAYS_BEFORE - 1) * DAY);
        self.movements.retain(|movement| movement.at >= begin - (DAYS_BEFORE - 1) * DAY);
        self.taken.retain(|span| span.1 >= begin - ABSENCES_KEPT);
        self.absences.retain(|absence| absence.end >= begin - ABSENCES_KEPT);
    }
}
