//! The firings of the motion sensors of a log on its whole days.

use crate::signs::{Kind, Says, kinds, said, spans};
use homebody_core::time::{DAY, HOUR, Interval, Span, WallTime};
use homebody_log::Log;
use std::collections::BTreeMap;
use std::ops::Range;

/// Recorded time from which a day counts.
const WHOLE_DAY: Span = HOUR.times(23);

/// The firings of motion sensors on days that follow each other.
#[derive(Clone, Debug)]
pub struct MotionFirings {
    pub sensors: Vec<String>,
    /// The firings, in order: the time and the sensor.
    pub firings: Vec<(WallTime, usize)>,
    /// The ONs, in order of beginning, with their sensors; empty where the log does not tell when an ON ends.
    pub on: Vec<(Interval<WallTime>, usize)>,
    /// The days since 1970.
    pub days: Range<i64>,
}

impl MotionFirings {
    /// The firings of a log on its whole days; `recorded` is the time of its recording, if that is known.
    pub fn from_log(log: &Log, recorded: Option<Interval<WallTime>>) -> MotionFirings {
        let kinds = kinds(log);
        let motion: Vec<usize> = (0..log.sensors.len()).filter(|&sensor| kinds[sensor] == Kind::Motion).collect();
        let mut number = vec![None; log.sensors.len()];
        for (index, &sensor) in motion.iter().enumerate() {
            number[sensor] = Some(index);
        }
        let events = log.events.iter().zip(said(log));
        let mut firings: Vec<(WallTime, usize)> = events
            .filter(|(_, said)| said.says == Says::Begins && said.begins())
            .filter_map(|(event, _)| Some((event.at, number[event.sensor as usize]?)))
            .collect();
        firings.sort_unstable();
        let mut on: Vec<(Interval<WallTime>, usize)> = Vec::new();
        for (sensor, spans) in spans(log).into_iter().enumerate() {
            let Some(index) = number[sensor] else { continue };
            on.extend(spans.into_iter().filter(|span| !span.is_empty()).map(|span| (span, index)));
        }
        on.sort_unstable_by_key(|(span, sensor)| (span.begin, *sensor));
        let told = || log.events.iter().map(|event| event.at);
        let ends = || told().min().zip(told().max());
        let of_rows = || ends().map(|(first, last)| Interval::new(first, last + Span::MICROSECOND));
        let days = recorded.or_else(of_rows).map_or(0..0, whole_days);
        MotionFirings {
            sensors: motion.iter().map(|&sensor| log.sensors[sensor].clone()).collect(),
            firings,
            on,
            days: 0..0,
        }
        .within(days)
    }

    pub fn within(&self, days: Range<i64>) -> MotionFirings {
        let span = of_days(&days);
        MotionFirings {
            sensors: self.sensors.clone(),
            firings: self.firings_in(span).to_vec(),
            on: self.on_in(span).to_vec(),
            days,
        }
    }

    pub fn halves(&self) -> [MotionFirings; 2] {
        let middle = self.days.start + (self.days.end - self.days.start) / 2;
        [self.within(self.days.start..middle), self.within(middle..self.days.end)]
    }

    pub fn firings_in(&self, span: Interval<WallTime>) -> &[(WallTime, usize)] {
        let before = span.map(|instant| self.firings.partition_point(|&(at, _)| at < instant));
        &self.firings[before.begin..before.end]
    }

    pub fn on_in(&self, span: Interval<WallTime>) -> &[(Interval<WallTime>, usize)] {
        let before = span.map(|instant| self.on.partition_point(|(on, _)| on.begin < instant));
        &self.on[before.begin..before.end]
    }

    pub fn each_day(&self) -> impl Iterator<Item = Interval<WallTime>> {
        self.days.clone().map(|day| of_days(&(day..day + 1)))
    }

    pub fn each_hour(&self) -> impl Iterator<Item = Interval<WallTime>> {
        self.each_day().flat_map(|day| (0..24).map(move |hour| Interval::starting(day.begin + hour * HOUR, HOUR)))
    }

    pub fn days_count(&self) -> usize {
        (self.days.end - self.days.start).max(0) as usize
    }

    pub fn counts(&self) -> BTreeMap<&str, f64> {
        let mut counts: BTreeMap<&str, f64> = BTreeMap::new();
        for &(_, sensor) in &self.firings {
            *counts.entry(&self.sensors[sensor]).or_default() += 1.0;
        }
        counts
    }
}

/// From midnight before the first of some days since 1970 to midnight after the last.
pub fn of_days(days: &Range<i64>) -> Interval<WallTime> {
    let midnight = |day: i64| WallTime::EPOCH + day * DAY;
    Interval::new(midnight(days.start), midnight(days.end))
}

/// The days that lie within an interval but for an hour.
fn whole_days(span: Interval<WallTime>) -> Range<i64> {
    let covered = |day: i64| span.overlap(of_days(&(day..day + 1)));
    let (mut first, mut last) = (span.begin.day_number(), (span.end - Span::MICROSECOND).day_number());
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
    use crate::sample::{log, parsed, span};

    #[test]
    fn days_are_whole_if_all_but_an_hour_was_recorded() {
        let days = |from_h: i64, to_h: i64| whole_days(span(from_h * 3600, to_h * 3600));
        assert_eq!(days(0, 48), 0..2);
        assert_eq!(days(1, 47), 0..2);
        assert_eq!(days(2, 46), 1..1);
        assert_eq!(days(2, 75), 1..3);
        assert_eq!(days(5, 20), 1..1);
    }

    #[test]
    fn contacts_and_readings_are_no_motion_and_what_never_ends_has_no_length() {
        let log = log(&parsed("60 hall ON, 64 hall OFF, 70 door OPEN, 80 T1 21.5, 90 bed FIRE, 86399 hall ON"));
        let heard = MotionFirings::from_log(&log, None);
        assert_eq!(heard.sensors, ["hall"], "a bed is used");
        assert_eq!(heard.firings.len(), 2);
        assert_eq!(heard.on, [(span(60, 64), 0)]);
        assert_eq!((heard.days_count(), heard.counts()["hall"]), (1, 2.0));
    }
}
