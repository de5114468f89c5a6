//! One person's simulated days, as the measures need them.

use homebody_core::calendar::Calendar;
use homebody_core::event::{Events, Fact, Value};
use homebody_core::ids::{ResidentId, SensorId};
use homebody_core::motion::MotionState;
use homebody_core::posture::Posture;
use homebody_core::time::{Interval, MINUTE, RunTime, Span};
use homebody_timeline::{Episode, PersonTimeline};
use std::ops::Range;

/// A simulated person and their home.
#[derive(Clone, Debug)]
pub struct Lived<'a> {
    pub events: &'a Events,
    /// The resident.
    pub resident: ResidentId,
    /// The resident's activities and rooms, over the whole run.
    pub timeline: &'a PersonTimeline,
    pub calendar: &'a Calendar,
    /// The days that count; the run begins before the first and ends with the last.
    pub days: Range<i32>,
    /// The room that people pass through: where a line of sensors would be.
    pub hall: Option<&'a str>,
    /// By sensor: whether it detects motion.
    pub is_motion: &'a [bool],
    /// Time that a firing keeps its sensor ON.
    pub hold: Span,
}

/// A movement or rest of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moved {
    pub time: Interval<RunTime>,
    pub doing: MotionState,
    pub posture: Posture,
}

impl<'a> Lived<'a> {
    /// Midnight at the beginning of a day.
    pub fn midnight(&self, day: i32) -> RunTime {
        self.calendar.instant(day, Span::ZERO)
    }

    /// The days that count, from their first midnight to their last.
    pub fn span(&self) -> Interval<RunTime> {
        Interval::new(self.midnight(self.days.start), self.midnight(self.days.end))
    }

    /// The day, counted from the first that counts, and the hour of it.
    pub fn clock(&self, at: RunTime) -> (usize, f64) {
        let day = self.calendar.day(at);
        let since = hours(at - self.midnight(day));
        ((day - self.days.start).max(0) as usize, since)
    }

    /// The movements and rests of the body, over the whole run.
    pub fn moves(&self) -> Vec<Moved> {
        let moved = |fact: &Fact| match *fact {
            Fact::Movement { resident, begin, end, doing, posture } if resident == self.resident => {
                Some(Moved { time: Interval::new(begin, end), doing, posture })
            }
            _ => None,
        };
        self.events.facts.iter().filter_map(moved).collect()
    }

    /// The rooms that the person entered after another one, with the instants; doorways and time away are no rooms.
    pub fn rooms(&self) -> Vec<(RunTime, &'a str)> {
        let entered = self.timeline.rooms.iter().map(|stay| (stay.begin(), stay.label.as_str()));
        let mut rooms: Vec<(RunTime, &str)> = entered.collect();
        rooms.dedup_by_key(|(_, room)| *room);
        rooms
    }

    /// The intervals in which each motion sensor was ON, as a log with a hold has them, in order of beginning.
    pub fn ons(&self) -> Vec<(SensorId, Interval<RunTime>)> {
        let mut ons: Vec<(SensorId, Interval<RunTime>)> = Vec::new();
        let mut last: Vec<Option<usize>> = vec![None; self.is_motion.len()];
        for firing in &self.events.firings {
            let sensor = firing.sensor.index();
            if firing.value != Value::Fire || !self.is_motion.get(sensor).is_some_and(|&motion| motion) {
                continue;
            }
            let on = Interval::starting(firing.at, self.hold);
            match last[sensor].filter(|&index| ons[index].1.end > firing.at) {
                Some(index) => ons[index].1.end = on.end,
                None => {
                    last[sensor] = Some(ons.len());
                    ons.push((firing.sensor, on));
                }
            }
        }
        let span = self.span();
        ons.retain(|(_, on)| span.contains(on.begin));
        ons
    }
}

/// The speed of a stride that is long enough to tell.
pub fn speed_mps(moved: &Moved) -> Option<f64> {
    /// Shortest walk with a measured speed, as on a line of sensors (our choice).
    const LEAST_M: f64 = 1.0;
    let MotionState::Stride { from, to } = moved.doing else { return None };
    let length = from.distance(to);
    (length >= LEAST_M && !moved.time.is_empty()).then(|| length / moved.time.length().seconds())
}

pub fn hours(span: Span) -> f64 {
    span.seconds() / 3600.0
}

pub fn minutes(span: Span) -> f64 {
    span.seconds() / 60.0
}

/// Hours of an activity inside an interval.
pub fn overlap_h(done: &Episode, within: Interval<RunTime>) -> f64 {
    hours(done.time.overlap(within))
}

/// Half an hour.
pub const HALF_HOUR: Span = MINUTE.times(30);
