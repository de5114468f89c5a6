use homebody_core::calendar::Calendar;
use homebody_core::event::{Events, Fact, Value};
use homebody_core::ids::{ResidentId, SensorId};
use homebody_core::motion::MotionState;
use homebody_core::posture::Posture;
use homebody_core::time::{Interval, MINUTE, RunTime, Span};
use homebody_timeline::{Episode, PersonTimeline};
use std::ops::Range;

#[derive(Clone, Debug)]
pub struct PersonRecord<'a> {
    pub events: &'a Events,
    pub resident: ResidentId,
    pub timeline: &'a PersonTimeline,
    pub calendar: &'a Calendar,
    /// The days that count; the run starts before the first and ends with the last.
    pub days: Range<i32>,
    /// The room that people pass through: the place of a line of sensors.
    pub hall: Option<&'a str>,
    /// By sensor: true if it detects motion.
    pub is_motion: &'a [bool],
    pub hold: Span,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyMovement {
    pub time: Interval<RunTime>,
    pub doing: MotionState,
    pub posture: Posture,
}

impl<'a> PersonRecord<'a> {
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

    pub fn moves(&self) -> Vec<BodyMovement> {
        let moved = |fact: &Fact| match *fact {
            Fact::Movement { resident, begin, end, doing, posture } if resident == self.resident => {
                Some(BodyMovement { time: Interval::new(begin, end), doing, posture })
            }
            _ => None,
        };
        self.events.facts.iter().filter_map(moved).collect()
    }

    /// The rooms that the person entered from another one, with the instants; doorways and time away do not count.
    pub fn rooms(&self) -> Vec<(RunTime, &'a str)> {
        let entered = self.timeline.rooms.iter().map(|stay| (stay.begin(), stay.label.as_str()));
        let mut rooms: Vec<(RunTime, &str)> = entered.collect();
        rooms.dedup_by_key(|(_, room)| *room);
        rooms
    }

    /// The ON times of the motion sensors, as in a log with a hold, in order of their start.
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

pub fn speed_mps(moved: &BodyMovement) -> Option<f64> {
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

pub fn overlap_h(done: &Episode, within: Interval<RunTime>) -> f64 {
    hours(done.time.overlap(within))
}

pub const HALF_HOUR: Span = MINUTE.times(30);
