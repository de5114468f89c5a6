//! A log that is looked at, row by row.

use super::counts::DayCounts;
use super::home::of_home;
use super::order::{MOST_WAITING, OrderCounts, RowBuffer, RowOrder};
use super::overview::{ActivityLook, HomeSensor, LogOverview, LogSilence, SensorLook};
use super::sensor::{Recorder, SensorHistory};
use crate::compare::natural;
use crate::dates::{on_wall, zone_of};
use crate::signs::{Beforehand, OwnWords, Says, SensorTally, is_number, says};
use homebody_core::sensed::domain_of;
use homebody_core::time::{DAY, HOUR, Interval, Span, WallTime};
use homebody_log::log::Clock;
use homebody_log::{Event, Log};
use homebody_timeline::Episode;
use jiff::tz::TimeZone;
use std::collections::BTreeMap;

/// Shortest silence of a log (our choice).
const SILENCE: Span = HOUR.times(12);

/// Number of silences, and of gaps, in a list.
const LISTED: usize = 100;

/// A source of rows: hands each part of a log to a function, and returns the log without its rows.
pub type RowStream<'s, E> = dyn FnMut(&mut dyn FnMut(&Log)) -> Result<Log, E> + 's;

/// Looks at the rows of a log, which come part by part; a second time where that shows more. Returns the log without its rows, too.
pub fn looked<E>(mut looker: Looker, stream: &mut RowStream<'_, E>) -> Result<(Looker, Log), E> {
    let mut about = stream(&mut |part| looker.take(part))?;
    if let Some(again) = looker.again(&about) {
        looker = again;
        about = stream(&mut |part| looker.take(part))?;
    }
    Ok((looker, about))
}

#[derive(Default)]
pub struct Looker {
    zone: Option<TimeZone>,
    is_by_own_zone: bool,
    values: Vec<(Says, Option<f64>)>,
    sensors: Vec<SensorHistory>,
    by_day: DayCounts,
    first: WallTime,
    latest: WallTime,
    before: Option<WallTime>,
    orders: OrderCounts,
    /// The waiting rows, if they are examined in the order of time.
    waiting: Option<RowBuffer>,
    clock: Clock,
    own: OwnWords,
    silences: (Vec<Interval<WallTime>>, u64),
    gaps: Vec<Interval<WallTime>>,
    /// The recorder stores states as it starts.
    restores: bool,
}

impl Looker {
    /// An overview has a log in UTC on the wall of the zone, if there is one.
    pub fn new(zone: Option<TimeZone>) -> Looker {
        Looker { zone, first: WallTime::MAX, latest: WallTime::MIN, ..Looker::default() }
    }

    /// Puts instants on the wall of the log's own zone, by its name or by offsets, where no zone is given.
    pub fn by_own_zone(self) -> Looker {
        Looker { is_by_own_zone: self.zone.is_none(), ..self }
    }

    /// Looks at the rows a second time: its first rows need not have all offsets, the order shows at the end, and so do words that one
    /// sensor alone has. `None` where the first time was enough.
    fn again(&self, about: &Log) -> Option<Looker> {
        let own_zone = zone_of(about).filter(|_| self.is_by_own_zone);
        let zone = own_zone.or_else(|| self.zone.clone());
        let own = OwnWords::from_log(about);
        let is_sorted = self.waiting.is_some() || !self.is_to_sort(about);
        if is_sorted && zone == self.zone && own.is_empty() {
            return None;
        }
        let waiting = self.is_to_sort(about).then(RowBuffer::default);
        Some(Looker { waiting, own, ..Looker::new(zone) })
    }

    /// Its rows are out of order, and few enough to be sorted.
    fn is_to_sort(&self, about: &Log) -> bool {
        self.orders.order(about.sensors.len()) != RowOrder::OfTime && about.rows <= MOST_WAITING
    }

    /// Takes the rows of a part; its sensors and values are all that have come so far.
    pub fn take(&mut self, part: &Log) {
        if self.is_by_own_zone && self.zone.is_none() && self.orders.is_empty() {
            self.zone = zone_of(part);
        }
        let number = |value: &String| value.parse().ok().filter(|_| is_number(value));
        self.values.extend(part.values[self.values.len()..].iter().map(|value| (says(value), number(value))));
        // Home Assistant is such a recorder: its ids begin with their domain.
        self.restores |= part.sensors[self.sensors.len()..].iter().any(|id| domain_of(id).is_some());
        self.sensors.resize(part.sensors.len(), SensorHistory::default());
        self.take_gaps(part);
        self.clock = part.clock;
        for event in &part.events {
            // The hour that a clock on the wall tells twice is in order by the world's.
            self.orders.take(event.at, event.sensor);
            let next = match &mut self.waiting {
                Some(waiting) => waiting.take(event),
                None => Some(*event),
            };
            if let Some(event) = next {
                self.row(&event);
            }
        }
    }

    fn take_gaps(&mut self, part: &Log) {
        let new = part.gaps[self.gaps.len()..].iter();
        let new: Vec<Interval<WallTime>> = new.map(|gap| gap.map(|at| self.on_wall(at, part.clock))).collect();
        self.gaps.extend(new);
    }

    fn on_wall(&self, at: WallTime, clock: Clock) -> WallTime {
        match &self.zone {
            Some(zone) if clock == Clock::Utc => on_wall(at, zone),
            _ => at,
        }
    }

    fn row(&mut self, event: &Event) {
        let at = self.on_wall(event.at, self.clock);
        if let Some(before) =
            self.before.filter(|&before| at - before >= SILENCE && !self.has_gap(Interval::new(before, at)))
        {
            self.silences.1 += 1;
            if self.silences.0.len() < LISTED {
                self.silences.0.push(Interval::new(before, at));
            }
        }
        self.before = Some(at);
        (self.first, self.latest) = (self.first.min(at), self.latest.max(at));
        let (says, number) = self.values[event.value as usize];
        let says = self.own.says(event).unwrap_or(says);
        self.restores |= says == Says::Unknown || !self.gaps.is_empty();
        let recorder = Recorder { gaps: &self.gaps, restores: self.restores };
        self.sensors[event.sensor as usize].take((at, event.value), (says, number), &recorder);
        self.by_day.take(event.sensor, at);
    }

    /// The recorder did not run for most of the time between two instants.
    fn has_gap(&self, span: Interval<WallTime>) -> bool {
        let gaps = &self.gaps[self.gaps.partition_point(|gap| gap.end <= span.begin)..];
        let gaps = gaps.iter().take_while(|gap| gap.begin < span.end);
        2 * gaps.map(|gap| gap.overlap(span)).sum::<Span>() > span.length()
    }

    /// The overview of the log. `about` is the log without its rows, once all have been taken; `named` finds another name of a sensor.
    pub fn look(
        mut self,
        name: &str,
        form: &str,
        about: &Log,
        named: &dyn Fn(&str) -> Option<String>,
        home: Option<(&str, &[HomeSensor])>,
    ) -> LogOverview {
        // A gap after the last row comes with no part.
        self.take_gaps(about);
        while let Some(event) = self.waiting.as_mut().and_then(RowBuffer::first) {
            self.row(&event);
        }
        let clock = if self.zone.is_some() { Clock::Local } else { about.clock };
        let text = |at: WallTime| instant_text(at, clock);
        let (first, last) = match about.rows {
            // The end of a label is behind the row that it is of.
            0 => self.of_activities(about),
            _ => (Some(self.first), Some(self.latest)),
        };
        let (days, by_day) = std::mem::take(&mut self.by_day).finish(about.sensors.len());
        let mut sensors: Vec<SensorLook> = Vec::new();
        let tallies: Vec<&SensorTally> = self.sensors.iter().map(|course| &course.tally).collect();
        let taken = Beforehand::from_log(about).taken(&tallies);
        for (index, ((id, course), taken)) in about.sensors.iter().zip(&self.sensors).zip(taken).enumerate() {
            let by_day = by_day.get(index).cloned().unwrap_or_default();
            sensors.push(course.look((id, taken), named(id), &about.values, by_day, self.latest, &text));
        }
        let home = home.map(|(name, sensors_of_home)| of_home(name, sensors_of_home, &sensors, about.rows));
        sensors.sort_by_cached_key(|sensor| {
            natural(&sensor.id).into_iter().map(|(size, part)| (size, part.to_owned())).collect::<Vec<_>>()
        });
        let order = self.orders.order(about.sensors.len());
        let of_order = order.remark(self.waiting.is_some());
        let (set_back, set_back_most) = match order {
            RowOrder::NewestFirst | RowOrder::BySensor => (0, Span::ZERO),
            RowOrder::OfTime | RowOrder::Another => self.orders.set_back(),
        };
        let own = OwnWords::from_log(about);
        let not_understood = own.not_understood().iter().cloned();
        let sum = |of: fn(&SensorLook) -> u64| sensors.iter().map(of).sum();
        let first_midnight = days.first().map_or(WallTime::EPOCH, |day| WallTime::midnight(*day));
        let in_days = |at: WallTime| (at - first_midnight).ratio(DAY);
        let silence = |silence: &Interval<WallTime>| LogSilence {
            from: text(silence.begin),
            to: text(silence.end),
            hours: silence.length().seconds() / 3600.0,
            at_days: [in_days(silence.begin), in_days(silence.end)],
        };
        LogOverview {
            name: name.to_owned(),
            form: form.to_owned(),
            rows: about.rows,
            first: first.filter(|&at| at != WallTime::MAX).map(text),
            last: last.filter(|&at| at != WallTime::MIN).map(text),
            clock,
            days,
            columns: about.columns.clone(),
            repeated: sum(|sensor| sensor.repeated),
            missing: sum(|sensor| sensor.missing),
            doubled: sum(|sensor| sensor.doubled),
            sensors,
            activities: activities(&about.activities),
            set_back,
            set_back_most_s: set_back_most.seconds(),
            silences: self.silences.0.iter().map(silence).collect(),
            silences_in_all: self.silences.1,
            gaps: self.gaps.iter().take(LISTED).map(silence).collect(),
            gaps_in_all: self.gaps.len() as u64,
            refused: about.problems.iter().map(|problem| problem.line).collect(),
            refused_in_all: about.skipped,
            why_refused: about.problems.clone(),
            remarks: about.remarks.iter().cloned().chain(of_order).chain(not_understood).collect(),
            home,
        }
    }
}

impl Looker {
    fn of_activities(&self, about: &Log) -> (Option<WallTime>, Option<WallTime>) {
        let told = |at: WallTime| self.on_wall(at, about.clock);
        let begins = about.activities.iter().map(|of| told(of.begin()));
        (begins.min(), about.activities.iter().map(|of| told(of.end())).max())
    }
}

/// An instant for readers: `2009-03-02 07:12:03`, with a fraction where it has one, and a Z in UTC.
fn instant_text(at: WallTime, clock: Clock) -> String {
    let zone = if clock == Clock::Utc { "Z" } else { "" };
    at.as_of_utc().timestamp().strftime("%Y-%m-%d %H:%M:%S%.f").to_string() + zone
}

fn activities(all: &[Episode<WallTime>]) -> Vec<ActivityLook> {
    let mut by_label: BTreeMap<&str, (u64, Span)> = BTreeMap::new();
    for activity in all {
        let (times, length) = by_label.entry(&activity.label).or_default();
        (*times, *length) = (*times + 1, length.saturating_add(activity.length()));
    }
    let look = |(label, (times, length)): (&str, (u64, Span))| ActivityLook {
        label: label.to_owned(),
        times,
        hours: length.seconds() / 3600.0,
    };
    by_label.into_iter().map(look).collect()
}
