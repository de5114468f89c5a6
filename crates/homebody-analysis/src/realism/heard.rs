//! What the motion sensors of a log said on its whole days.

use crate::signs::{Kind, Says, kinds, said, spans};
use homebody_core::time::{DAY, Micros, SECOND};
use homebody_log::Log;
use std::collections::BTreeMap;
use std::ops::Range;

pub const HOUR: Micros = 3600 * SECOND;

/// A day counts if this much of it was recorded.
const WHOLE_DAY: Micros = 23 * HOUR;

/// The firings of motion sensors on days that follow each other.
#[derive(Clone, Debug)]
pub struct Heard {
    /// The motion sensors.
    pub sensors: Vec<String>,
    /// When which of them fired, in order.
    pub firings: Vec<(Micros, usize)>,
    /// When which of them was ON, in order of beginning; nothing where the log does not tell when an ON ends.
    pub on: Vec<(Range<Micros>, usize)>,
    /// The days since 1970.
    pub days: Range<Micros>,
}

impl Heard {
    /// What a log says on its whole days; `recorded` is from when to when it was recorded, if that is known.
    pub fn of(log: &Log, recorded: Option<&Range<Micros>>) -> Heard {
        let kinds = kinds(log);
        let motion: Vec<usize> = (0..log.sensors.len()).filter(|&sensor| kinds[sensor] == Kind::Motion).collect();
        let mut number = vec![None; log.sensors.len()];
        for (index, &sensor) in motion.iter().enumerate() {
            number[sensor] = Some(index);
        }
        let events = log.events.iter().zip(said(log));
        let mut firings: Vec<(Micros, usize)> = events
            .filter(|(_, said)| said.says == Says::Begins && said.begins())
            .filter_map(|(event, _)| Some((event.at, number[event.sensor as usize]?)))
            .collect();
        firings.sort_unstable();
        let mut on: Vec<(Range<Micros>, usize)> = Vec::new();
        for (sensor, spans) in spans(log).into_iter().enumerate() {
            let Some(index) = number[sensor] else { continue };
            on.extend(spans.into_iter().filter(|(from, to)| from < to).map(|(from, to)| (from..to, index)));
        }
        on.sort_unstable_by_key(|(span, sensor)| (span.start, *sensor));
        let told = || log.events.iter().map(|event| event.at);
        let of_rows = || told().min().zip(told().max()).map(|(first, last)| first..last + 1);
        let days = recorded.cloned().or_else(of_rows).map_or(0..0, |span| whole_days(&span));
        Heard { sensors: motion.iter().map(|&sensor| log.sensors[sensor].clone()).collect(), firings, on, days: 0..0 }
            .within(days)
    }

    /// The part of some of its days.
    pub fn within(&self, days: Range<Micros>) -> Heard {
        let span = days.start * DAY..days.end * DAY;
        Heard {
            sensors: self.sensors.clone(),
            firings: self.firings_in(&span).to_vec(),
            on: self.on_in(&span).to_vec(),
            days,
        }
    }

    /// Its first and its second half.
    pub fn halves(&self) -> [Heard; 2] {
        let middle = self.days.start + (self.days.end - self.days.start) / 2;
        [self.within(self.days.start..middle), self.within(middle..self.days.end)]
    }

    pub fn firings_in(&self, span: &Range<Micros>) -> &[(Micros, usize)] {
        let before = |instant| self.firings.partition_point(|&(at, _)| at < instant);
        &self.firings[before(span.start)..before(span.end)]
    }

    pub fn on_in(&self, span: &Range<Micros>) -> &[(Range<Micros>, usize)] {
        let before = |instant| self.on.partition_point(|(on, _)| on.start < instant);
        &self.on[before(span.start)..before(span.end)]
    }

    /// From midnight to midnight.
    pub fn each_day(&self) -> impl Iterator<Item = Range<Micros>> {
        self.days.clone().map(|day| day * DAY..(day + 1) * DAY)
    }

    pub fn each_hour(&self) -> impl Iterator<Item = Range<Micros>> {
        self.each_day().flat_map(|day| (0..24).map(move |hour| day.start + hour * HOUR..day.start + (hour + 1) * HOUR))
    }

    pub fn days_count(&self) -> usize {
        (self.days.end - self.days.start).max(0) as usize
    }

    /// How often each sensor fired, by name.
    pub fn counts(&self) -> BTreeMap<&str, f64> {
        let mut counts: BTreeMap<&str, f64> = BTreeMap::new();
        for &(_, sensor) in &self.firings {
            *counts.entry(&self.sensors[sensor]).or_default() += 1.0;
        }
        counts
    }
}

/// The days that a span covers all but an hour of.
fn whole_days(span: &Range<Micros>) -> Range<Micros> {
    let covered = |day: Micros| span.end.min((day + 1) * DAY) - span.start.max(day * DAY);
    let (mut first, mut last) = (span.start.div_euclid(DAY), (span.end - 1).div_euclid(DAY));
    if covered(first) < WHOLE_DAY {
        first += 1;
    }
    if last >= first && covered(last) < WHOLE_DAY {
        last -= 1;
    }
    first..last.max(first - 1) + 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::log;

    #[test]
    fn days_are_whole_if_all_but_an_hour_was_recorded() {
        let days = |from_h: Micros, to_h: Micros| whole_days(&(from_h * HOUR..to_h * HOUR));
        assert_eq!(days(0, 48), 0..2);
        assert_eq!(days(1, 47), 0..2);
        assert_eq!(days(2, 46), 1..1);
        assert_eq!(days(2, 75), 1..3);
        assert_eq!(days(5, 20), 1..1);
    }

    #[test]
    fn contacts_and_readings_are_no_motion_and_what_never_ends_has_no_length() {
        let log = log(&[
            (60, "hall", "ON"),
            (64, "hall", "OFF"),
            (70, "door", "OPEN"),
            (80, "T1", "21.5"),
            (90, "bed", "FIRE"),
            (86_399, "hall", "ON"),
        ]);
        let heard = Heard::of(&log, None);
        assert_eq!(heard.sensors, ["hall"], "a bed is used");
        assert_eq!(heard.firings.len(), 2);
        assert_eq!(heard.on, [(60 * SECOND..64 * SECOND, 0)]);
        assert_eq!((heard.days_count(), heard.counts()["hall"]), (1, 2.0));
    }
}
