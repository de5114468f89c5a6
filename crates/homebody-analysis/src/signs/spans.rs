//! The spans over which sensors are on, and over which their state is not known.

use super::course::SensorCourse;
use super::meanings::Meanings;
use homebody_core::states::Says;
use homebody_core::time::{Interval, WallTime, intersection, union};
use homebody_log::Log;

/// The spans over which each sensor is on, in order. A span is an instant if the
/// sensor never says that it ends, or if the log ends first. A span ends if the state of its sensor stops being known.
pub fn spans(log: &Log) -> Vec<Vec<Interval<WallTime>>> {
    spans_until(log, None)
}

/// The same, but open spans end at an instant, if one is given.
pub fn spans_until(log: &Log, end: Option<WallTime>) -> Vec<Vec<Interval<WallTime>>> {
    let meanings = Meanings::from_log(log);
    let mut ends = vec![false; log.sensors.len()];
    for event in &log.events {
        ends[event.sensor as usize] |= meanings.says(event).is_off();
    }
    let mut spans = vec![Vec::new(); log.sensors.len()];
    let mut since: Vec<Option<WallTime>> = vec![None; log.sensors.len()];
    let mut courses = vec![SensorCourse::default(); log.sensors.len()];
    for event in log.in_order() {
        let sensor = event.sensor as usize;
        let said = courses[sensor].take(event.at, meanings.says(event), &log.gaps);
        if let Some(unknown) = said.unknown_from {
            spans[sensor].extend(since[sensor].take().map(|begin| Interval::new(begin, unknown.max(begin))));
        }
        match said.says {
            says if says.is_on() && ends[sensor] => since[sensor] = since[sensor].or(Some(event.at)),
            says if says.is_on() && !said.is_restored => spans[sensor].push(Interval::instant(event.at)),
            Says::Ends | Says::Closes => {
                spans[sensor].extend(since[sensor].take().map(|begin| Interval::new(begin, event.at)));
            }
            _ => {}
        }
    }
    for (spans, since) in spans.iter_mut().zip(since) {
        let Some(begin) = since else { continue };
        // A gap at the end of the log has no row after it.
        let gap = log.gaps.iter().map(|gap| gap.begin).find(|&gap| gap >= begin);
        let known = end.map(|end| end.min(gap.unwrap_or(end)));
        spans.push(Interval::new(begin, known.map_or(begin, |end| end.max(begin))));
    }
    spans
}

/// The times in which the states of sensors are unknown, by rows in the order of time. It keeps no rows.
#[derive(Clone, Debug, Default)]
pub struct UnknownStates {
    sensors: Vec<UnknownState>,
    last: Option<WallTime>,
}

#[derive(Clone, Debug, Default)]
struct UnknownState {
    first: Option<WallTime>,
    since: Option<WallTime>,
    spans: Vec<Interval<WallTime>>,
}

impl UnknownStates {
    pub fn new(sensors: usize) -> UnknownStates {
        UnknownStates { sensors: vec![UnknownState::default(); sensors], last: None }
    }

    pub fn from_log(log: &Log) -> UnknownStates {
        let meanings = Meanings::from_log(log);
        let mut states = UnknownStates::new(log.sensors.len());
        for event in log.in_order() {
            states.take(event.at, event.sensor as usize, meanings.says(event) == Says::Unknown);
        }
        states
    }

    pub fn take(&mut self, at: WallTime, sensor: usize, is_unknown: bool) {
        let of = &mut self.sensors[sensor];
        of.first = of.first.or(Some(at));
        match is_unknown {
            true => of.since = of.since.or(Some(at)),
            false => of.spans.extend(of.since.take().map(|begin| Interval::new(begin, at))),
        }
        self.last = Some(at);
    }

    /// The spans of each sensor, in order: from a row that says so to the next that says something else, and over the gaps of the
    /// recorder.
    pub fn spans(self, gaps: &[Interval<WallTime>]) -> Vec<Vec<Interval<WallTime>>> {
        let last = self.last;
        let all = self.sensors.into_iter().map(|UnknownState { since, spans, .. }| {
            let open = since.zip(last).map(|(since, last)| Interval::new(since, last));
            union(spans.into_iter().chain(open).chain(gaps.iter().copied()))
        });
        all.collect()
    }

    /// The times in which nothing is known of some sensors, in order. Before its first row a sensor does not make anything known.
    pub fn of_all(self, gaps: &[Interval<WallTime>], asks: &dyn Fn(usize) -> bool) -> Vec<Interval<WallTime>> {
        let first: Vec<Option<WallTime>> = self.sensors.iter().map(|sensor| sensor.first).collect();
        let asked = self.spans(gaps).into_iter().zip(first).enumerate().filter(|(sensor, _)| asks(*sensor));
        let asked: Vec<(Vec<Interval<WallTime>>, WallTime)> =
            asked.filter_map(|(_, (spans, first))| Some((spans, first?))).collect();
        let said = union(asked.iter().flat_map(|(spans, _)| spans).chain(gaps).copied());
        asked.into_iter().fold(said, |all, (spans, first)| {
            let before = Interval::new(WallTime::MIN, first);
            intersection(&all, &union(spans.into_iter().chain([before])))
        })
    }
}
