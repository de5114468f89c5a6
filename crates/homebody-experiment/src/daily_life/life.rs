//! One person's life as the truth and the sensors tell it, cut into what the measures ask for.

use homebody_core::event::{Events, Fact, MotionState, Value};
use homebody_core::ids::{ResidentId, RoomId, SensorId};
use homebody_core::scenario::calendar::Calendar;
use homebody_core::scenario::path::Posture;
use homebody_core::time::{Micros, SECOND, seconds};
use std::ops::Range;

/// What was lived, and what there is to know of the home.
#[derive(Clone, Debug)]
pub struct Lived<'a> {
    pub events: &'a Events,
    /// Whose life it is.
    pub resident: ResidentId,
    pub calendar: &'a Calendar,
    /// The days that count; the run begins before the first and ends with the last.
    pub days: Range<i32>,
    /// The room that people pass through: where a line of sensors would be.
    pub hall: Option<RoomId>,
    /// Which sensors see motion, by index.
    pub is_motion: &'a [bool],
    /// For how long a firing keeps its sensor ON.
    pub hold: Micros,
}

/// A span with what was done in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span<'a> {
    pub begin: Micros,
    pub end: Micros,
    pub name: &'a str,
}

impl Span<'_> {
    pub fn hours(&self) -> f64 {
        seconds(self.end - self.begin) / 3600.0
    }

    pub fn minutes(&self) -> f64 {
        seconds(self.end - self.begin) / 60.0
    }
}

/// What a body did over a span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moved {
    pub begin: Micros,
    pub end: Micros,
    pub doing: MotionState,
    pub posture: Posture,
}

impl<'a> Lived<'a> {
    /// Midnight at the beginning of a day.
    pub fn midnight(&self, day: i32) -> Micros {
        self.calendar.instant(day, 0)
    }

    /// The days that count, from their first midnight to their last.
    pub fn span(&self) -> Range<Micros> {
        self.midnight(self.days.start)..self.midnight(self.days.end)
    }

    /// The day, counted from the first that counts, and the hour of it.
    pub fn clock(&self, at: Micros) -> (usize, f64) {
        let day = self.calendar.day(at);
        let since = seconds(at - self.midnight(day)) / 3600.0;
        ((day - self.days.start).max(0) as usize, since)
    }

    /// What was done, one after the other, over the whole run.
    pub fn activities(&self) -> Vec<Span<'a>> {
        let mut spans: Vec<Span> = Vec::new();
        for fact in &self.events.facts {
            let Fact::Activity { resident, at, name } = fact else { continue };
            if *resident != self.resident {
                continue;
            }
            if let Some(last) = spans.last_mut() {
                last.end = *at;
            }
            spans.push(Span { begin: *at, end: *at, name: name.as_deref().unwrap_or("") });
        }
        if let Some(last) = spans.last_mut() {
            last.end = self.span().end.max(last.begin);
        }
        spans.retain(|span| span.end > span.begin);
        spans
    }

    /// What the body did, over the whole run.
    pub fn moves(&self) -> Vec<Moved> {
        let moved = |fact: &Fact| match *fact {
            Fact::Movement { resident, begin, end, doing, posture } if resident == self.resident => {
                Some(Moved { begin, end, doing, posture })
            }
            _ => None,
        };
        self.events.facts.iter().filter_map(moved).collect()
    }

    /// When a room was entered that is not the one before, and which; doorways and time away are no rooms.
    pub fn rooms(&self) -> Vec<(Micros, RoomId)> {
        let mut rooms: Vec<(Micros, RoomId)> = Vec::new();
        for fact in &self.events.facts {
            if let Fact::Room { resident, at, room: Some(room) } = *fact
                && resident == self.resident
                && rooms.last().is_none_or(|&(_, last)| last != room)
            {
                rooms.push((at, room));
            }
        }
        rooms
    }

    /// When each motion sensor was ON, as a log with a hold has it, in order of beginning: sensor, from, to.
    pub fn ons(&self) -> Vec<(SensorId, Micros, Micros)> {
        let mut ons: Vec<(SensorId, Micros, Micros)> = Vec::new();
        let mut last: Vec<Option<usize>> = vec![None; self.is_motion.len()];
        for firing in &self.events.firings {
            let sensor = firing.sensor.index();
            if firing.value != Value::Fire || !self.is_motion.get(sensor).is_some_and(|&motion| motion) {
                continue;
            }
            let end = firing.at + self.hold;
            match last[sensor].filter(|&index| ons[index].2 > firing.at) {
                Some(index) => ons[index].2 = end,
                None => {
                    last[sensor] = Some(ons.len());
                    ons.push((firing.sensor, firing.at, end));
                }
            }
        }
        let span = self.span();
        ons.retain(|(_, from, _)| span.contains(from));
        ons
    }
}

/// The speed of a stride that is long enough to tell.
pub fn speed_mps(moved: &Moved) -> Option<f64> {
    /// Shortest walk with a measured speed, as on a line of sensors (our choice).
    const LEAST_M: f64 = 1.0;
    let MotionState::Stride { from, to } = moved.doing else { return None };
    let length = from.distance(to);
    (length >= LEAST_M && moved.end > moved.begin).then(|| length / seconds(moved.end - moved.begin))
}

/// How long a span is inside another, in hours.
pub fn overlap_h(span: &Span, within: &Range<Micros>) -> f64 {
    let (begin, end) = (span.begin.max(within.start), span.end.min(within.end));
    seconds((end - begin).max(0)) / 3600.0
}

/// Half an hour.
pub const HALF_HOUR: Micros = 1800 * SECOND;
