//! Measures of a log, day by day: the values of a day follow from the rows up to its end, and later rows never change them.
//!
//! Only rows of the last days are kept. Of earlier rows these things carry over: the kinds of sensors, how long ways usually take,
//! how lively hours usually are, the height of a level of density, absences, and spans that are open.

use super::company::{UsualSigns, company};
use super::known_time::{KnownDay, KnownTime};
use super::log_timeline::{LogExcerpt, NamedSensors};
use super::measure::DailyMeasure;
use super::measured_day::{DayContext, MeasuredDay, UNKNOWN_H};
use super::registry::MEASURES;
use super::rooms::SensorRooms;
use super::signs::{RoomSign, gives_signs, signs, with_movements};
use super::silences::Listening;
use super::timeline::{MeasureTimeline, within_h};
use super::values::{DayMeasures, SilentSensor};
use super::walking::Paces;
use super::ways::HomeKnowledge;
use crate::dates::MOST_DAYS;
use crate::density::{DensityCell, DensityOptions, Entrance, HomeAbsence, Leaving, NoMap, SEATED, Signs, distance};
use crate::holds::{HiddenMovement, HoldTimes};
use crate::rows::{Ongoing, StateRow, Tallies};
use crate::signs::{Kind, LogSensors, is_seat};
use homebody_core::time::{DAY, HOUR, Interval, Span, WallTime};
use homebody_log::{Event, Log};
use std::collections::VecDeque;

/// Number of days before a day whose rows are read again with it, as much begins before midnight.
const DAYS_BEFORE: i64 = 2;
/// Two weeks: number of days in comparisons, and of the first whole days that give the height of a level of density.
const WEEKS: usize = 14;
/// Largest number of rows of a home on a day. Further rows are ignored, and the day has no measures.
const MOST_ROWS: usize = 250_000;
/// Time for which absences are kept: in an empty home no sensor is silent.
const ABSENCES_KEPT: Span = DAY.times(70);

pub struct Measuring<'a> {
    pub(super) log: &'a Log,
    pub(super) known: HomeKnowledge<'a>,
    asked: DensityOptions,
    called: Vec<String>,
    named: NamedSensors,
    all_rooms: SensorRooms,
    rows: Tallies,
    /// The midnight at which the current day began; `None` before the first row.
    day: Option<WallTime>,
    /// The rows of the last days, without numbers, and the number of those before the current day.
    window: Vec<StateRow>,
    of_days_before: usize,
    is_full: bool,
    /// By sensor, the first and the last of the day's numbers and other words.
    other: Vec<Option<Interval<WallTime>>>,
    so_far: SoFar,
    days: Vec<DayMeasures>,
}

pub struct MeasuredLog {
    pub days: Vec<DayMeasures>,
    pub silent: Vec<SilentSensor>,
    pub entrance: Entrance,
    /// Silence alone shows some absences.
    pub guesses_absences: bool,
    /// The rooms of all sensors, thermometers included.
    pub all_rooms: SensorRooms,
    /// The number of days with more rows than are kept.
    pub crowded: usize,
    pub has_motion: bool,
    pub timeline: MeasureTimeline,
}

#[derive(Default)]
struct SoFar {
    time: KnownTime,
    kinds: Vec<Kind>,
    entrance: Entrance,
    knows_entrance: bool,
    has_door: bool,
    rooms: SensorRooms,
    has_spoken: Vec<bool>,
    has_bed: bool,
    /// The number of signs in known rooms, and of seen movements among them.
    signs: [u64; 2],
    ongoing: Ongoing,
    is_seat: Vec<bool>,
    /// The times in which a bed or a chair is occupied for long.
    taken: Ongoing,
    leaving: Leaving,
    holds: HoldTimes,
    /// The movements of the last days that lie between reports.
    movements: Vec<HiddenMovement>,
    /// The absences of the last weeks that are over, and whether any absence was a guess.
    absences: Vec<HomeAbsence>,
    guesses_absences: bool,
    listening: Listening,
    paces: Paces,
    usual: UsualSigns,
    /// The last days: the known part of each hour, and its cell.
    history: VecDeque<([f64; 24], [DensityCell; 24])>,
    /// The cells of the first whole days, until they are enough.
    first_cells: Vec<[DensityCell; 24]>,
    step_per_h: Option<f64>,
    last: MeasureTimeline,
    has_motion: bool,
    has_signs: bool,
    crowded: usize,
}

impl<'a> Measuring<'a> {
    pub fn new(log: &'a Log, known: HomeKnowledge<'a>, asked: &DensityOptions) -> Measuring<'a> {
        let called = log.called();
        let count = log.sensors.len();
        let so_far = SoFar {
            time: KnownTime::new(asked.recorded, &log.gaps),
            kinds: vec![Kind::Reading; count],
            has_spoken: vec![false; count],
            ongoing: Ongoing::new(count, Span::ZERO),
            is_seat: called.iter().map(|name| is_seat(name)).collect(),
            taken: Ongoing::new(count, SEATED),
            leaving: Leaving::new(asked.away_after),
            holds: HoldTimes::new(count),
            listening: Listening::new(count),
            ..SoFar::default()
        };
        Measuring {
            log,
            known,
            asked: asked.clone(),
            named: NamedSensors::from_names(&called),
            all_rooms: SensorRooms::from_sensors(&log.sensors, known.rooms),
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
    pub fn take(&mut self, event: &Event) -> Result<(), NoMap> {
        let date = event.at - event.at.time_of_day();
        let began = self.asked.recorded.map_or(event.at, |recorded| recorded.begin.min(event.at));
        let day = *self.day.get_or_insert(began - began.time_of_day());
        let days = self.days.len() as i64 + (date - day) / DAY;
        if days >= MOST_DAYS as i64 {
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
                    *other = Some(Interval::new(other.map_or(event.at, |other| other.begin), event.at));
                }
            }
        }
        Ok(())
    }

    pub(super) fn recorded(&self) -> Option<Interval<WallTime>> {
        let time = &self.so_far.time;
        self.asked.recorded.or_else(|| Some(Interval::new(time.first()?, time.last()? + Span::MICROSECOND)))
    }

    pub fn end(mut self) -> Result<MeasuredLog, NoMap> {
        let mut last = self.so_far.time.last().ok_or(NoMap::Empty)?;
        last = self.asked.recorded.map_or(last, |recorded| last.max(recorded.end - Span::MICROSECOND));
        let first = self.day.map_or(last, |day| day - self.days.len() as i64 * DAY);
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
        let away = so_far.away(last + Span::MICROSECOND);
        let silent = so_far.listening.silent_sensors(&self.log.sensors, &so_far.kinds, &away, last);
        Ok(MeasuredLog {
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
    fn end_day(&mut self, next: Option<WallTime>) {
        let Some(begin) = self.day else { return };
        let (today, from) = (Interval::starting(begin, DAY), self.of_days_before);
        let end = today.end;
        self.window[from..].sort_by_key(|row| row.at);
        if self.window.len() > from {
            self.know_sensors(from);
        }
        self.go_through(from, today);
        let recorded = self.asked.recorded.map(|recorded| recorded.end);
        let is_over = next.is_some() || recorded.is_some_and(|until| until >= end);
        let last = recorded.max(self.so_far.time.last()).filter(|_| !is_over);
        let now = last.map_or(end, |last| end.min(last + Span::MICROSECOND));
        let away = self.so_far.away(now);
        self.listen(from, &away);
        if std::mem::take(&mut self.is_full) {
            self.so_far.crowded += 1;
            self.so_far.time.forget(today);
        }
        let known = self.so_far.time.end_day(today, next, &away);
        let timeline = self.timeline(begin, &away, &known);
        let number = timeline.days() - 1;
        let common = DayContext::new(&timeline, self.so_far.step_per_h);
        let day = MeasuredDay::new(&common, number, is_over);
        let lacking = self.so_far.listening.on_day(Interval::new(begin, now), &self.so_far.kinds, &away);
        let sensors = &self.so_far.entrance.sensors;
        let at_entrance = |sensor: usize| sensors.contains(&self.log.sensors[sensor]);
        let value = |measure: &DailyMeasure| {
            let is_hindered = lacking.hinders(measure, &timeline.rooms, &at_entrance);
            (measure.of)(&day).filter(|_| !is_hindered)
        };
        let values = MEASURES.iter().map(value).collect();
        self.days.push(DayMeasures { date: begin.date(), is_whole: day.is_known(), values });
        self.so_far.remember(timeline, begin);
        let keeps = end - DAYS_BEFORE * DAY;
        self.window.retain(|row| row.at >= keeps);
        self.of_days_before = self.window.len();
        self.other.fill(None);
        self.day = Some(end);
    }

    /// Learns from the rows of a day the kinds of sensors, and which of them give signs.
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

    fn go_through(&mut self, from: usize, day: Interval<WallTime>) {
        let so_far = &mut self.so_far;
        let signs = Signs::new(&self.log.sensors, &so_far.kinds, &so_far.entrance);
        let all_breaks = so_far.time.breaks(day);
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
        so_far.holds.pass(day.end, &mut movements);
        let of_rows = self.window[from..].iter().filter_map(|row| signs.sign(row));
        let mut all: Vec<_> = of_rows.collect();
        so_far.has_signs |= !all.is_empty();
        all.extend(movements.iter().filter(|movement| movement.at >= day.begin).map(|of| signs.of_movement(of)));
        all.sort_by_key(|sign| sign.at);
        so_far.leave(&all, &all_breaks, day.end);
        so_far.movements.extend(movements);
        let is_bed = |sensor: usize| self.named.is_bed(sensor, so_far.kinds[sensor]);
        let lies = |sensor: usize| so_far.ongoing.spans(sensor, Some(day.end)).iter().any(|span| !span.is_empty());
        so_far.has_bed |= (0..so_far.kinds.len()).any(|sensor| is_bed(sensor) && lies(sensor));
    }

    fn listen(&mut self, from: usize, away: &[Interval<WallTime>]) {
        let mut spoken: Vec<(WallTime, usize)> =
            self.window[from..].iter().map(|row| (row.at, row.sensor as usize)).collect();
        for (sensor, other) in self.other.iter().enumerate() {
            spoken.extend(other.iter().flat_map(|other| [(other.begin, sensor), (other.end, sensor)]));
        }
        // The rows are in order of time already, which this kind of sorting makes use of.
        spoken.sort();
        for (at, sensor) in spoken {
            self.so_far.listening.take(at, sensor, self.so_far.kinds[sensor], away);
        }
    }

    fn timeline(&mut self, begin: WallTime, away: &[Interval<WallTime>], known: &KnownDay) -> MeasureTimeline {
        let so_far = &mut self.so_far;
        let signs = signs(&self.window, &so_far.kinds, &so_far.rooms, &so_far.holds);
        let today = &signs[signs.partition_point(|sign| sign.at < begin)..];
        let seen: Vec<RoomSign> = today.iter().filter(|sign| sign.is_seen).copied().collect();
        so_far.signs[0] += today.len() as u64;
        so_far.signs[1] += seen.len() as u64;
        let at_entrance = Signs::new(&self.log.sensors, &so_far.kinds, &so_far.entrance);
        let door: Vec<WallTime> = self.window.iter().filter(|row| at_entrance.is_door(row)).map(|row| row.at).collect();
        so_far.usual.add(today, door.last().is_some_and(|last| *last >= begin));
        let passages = so_far.paces.of_day(&seen);
        let mut cells = known.cells();
        for row in self.window.iter().filter(|row| row.at >= begin && at_entrance.is_motion(row)) {
            cells[((row.at - begin) / HOUR) as usize].events += 1;
        }
        for &span in away {
            for (hour, cell) in (0..).zip(&mut cells) {
                cell.away_h += within_h(&[span], Interval::starting(begin + hour * HOUR, HOUR));
            }
        }
        so_far.keep_cells(known.hours, cells);
        let history = so_far.history.iter();
        let first = begin - (so_far.history.len() as i64 - 1) * DAY;
        let mut timeline = MeasureTimeline {
            first: first.date(),
            begin: first,
            recorded_h: history.clone().map(|day| day.0).collect(),
            cells: so_far.has_motion.then(|| history.map(|day| day.1).collect()),
            rooms: so_far.rooms.clone(),
            is_unwatched: 2 * so_far.signs[1] < so_far.signs[0],
            unknown: known.unknown.clone(),
            away: (!so_far.entrance.sensors.is_empty()).then(|| away.to_vec()),
            passages: so_far.paces.is_known().then_some(passages),
            company: company(&signs, &door, &so_far.usual, known.until),
            ..MeasureTimeline::default()
        };
        let heard = LogExcerpt {
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
    fn away(&self, now: WallTime) -> Vec<Interval<WallTime>> {
        let last = self.leaving.last().into_iter().chain(self.leaving.open(now, self.has_door));
        let taken = self.taken_until(now);
        let last = last.filter(|absence| !absence.is_taken(&taken));
        self.absences.iter().copied().chain(last).map(|absence| absence.interval()).collect()
    }

    fn taken_until(&self, now: WallTime) -> Vec<Interval<WallTime>> {
        (0..self.is_seat.len()).flat_map(|sensor| self.taken.spans(sensor, Some(now))).collect()
    }

    fn add_absence(&mut self, absence: HomeAbsence, now: WallTime) {
        if !absence.is_taken(&self.taken_until(now)) {
            self.guesses_absences |= absence.is_guess;
            self.absences.push(absence);
        }
    }

    fn break_off(&mut self, at: WallTime) {
        self.ongoing.end_all(at);
        self.taken.end_all(at);
        self.holds.end_all();
        self.paces.forget();
    }

    /// Looks for absences in the signs of a day. A resident who left before a gap may have come back in it.
    fn leave(&mut self, signs: &[crate::density::PresenceSign], breaks: &[WallTime], end: WallTime) {
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

    fn leave_before(&mut self, gap: WallTime) {
        if let Some(absence) = self.leaving.last() {
            self.add_absence(absence, gap);
        }
        self.leaving.forget();
    }

    /// Keeps the hours of a day with those of the last two weeks. The first whole days give the height of a level of density.
    fn keep_cells(&mut self, hours: [f64; 24], cells: [DensityCell; 24]) {
        self.history.push_back((hours, cells));
        if self.history.len() > WEEKS {
            self.history.pop_front();
        }
        if self.step_per_h.is_none() && hours.iter().sum::<f64>() > 24.0 - UNKNOWN_H {
            self.first_cells.push(cells);
            if self.first_cells.len() == WEEKS {
                self.step_per_h = Some(distance::step_per_h(&std::mem::take(&mut self.first_cells)));
            }
        }
    }

    /// Keeps the parts of a day that later days need, and drops the rest.
    fn remember(&mut self, timeline: MeasureTimeline, begin: WallTime) {
        self.last = timeline;
        self.ongoing.retain(|span| span.end >= begin - (DAYS_BEFORE - 1) * DAY);
        self.movements.retain(|movement| movement.at >= begin - (DAYS_BEFORE - 1) * DAY);
        self.taken.retain(|span| span.end >= begin - ABSENCES_KEPT);
        self.absences.retain(|absence| absence.end >= begin - ABSENCES_KEPT);
    }
}
