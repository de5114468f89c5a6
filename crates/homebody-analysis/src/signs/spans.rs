//! The spans over which sensors are on, and over which their state is not known.

use super::course::Course;
use super::meanings::Meanings;
use homebody_core::states::Says;
use homebody_core::time::Micros;
use homebody_log::Log;

/// Beginnings and ends.
pub type Spans = Vec<(Micros, Micros)>;

/// The spans over which each sensor is on, in order. A span is an instant if the
/// sensor never says that it ends, or if the log ends first. A span ends if the state of its sensor stops being known.
pub fn spans(log: &Log) -> Vec<Spans> {
    spans_until(log, None)
}

/// The same, but what has not ended when the log does ends at an instant, where one is given.
pub fn spans_until(log: &Log, end: Option<Micros>) -> Vec<Spans> {
    let meanings = Meanings::of(log);
    let mut ends = vec![false; log.sensors.len()];
    for event in &log.events {
        ends[event.sensor as usize] |= meanings.says(event).is_off();
    }
    let mut spans = vec![Vec::new(); log.sensors.len()];
    let mut since: Vec<Option<Micros>> = vec![None; log.sensors.len()];
    let mut courses = vec![Course::default(); log.sensors.len()];
    for event in log.in_order() {
        let sensor = event.sensor as usize;
        let said = courses[sensor].take(event.at, meanings.says(event), &log.gaps);
        if let Some(unknown) = said.unknown_from {
            spans[sensor].extend(since[sensor].take().map(|begin| (begin, unknown.max(begin))));
        }
        match said.says {
            says if says.is_on() && ends[sensor] => since[sensor] = since[sensor].or(Some(event.at)),
            says if says.is_on() && !said.is_restored => spans[sensor].push((event.at, event.at)),
            Says::Ends | Says::Closes => spans[sensor].extend(since[sensor].take().map(|begin| (begin, event.at))),
            _ => {}
        }
    }
    for (spans, since) in spans.iter_mut().zip(since) {
        let Some(begin) = since else { continue };
        // A gap at the end of the log has no row after it.
        let gap = log.gaps.iter().map(|gap| gap.0).find(|&gap| gap >= begin);
        let known = end.map(|end| end.min(gap.unwrap_or(end)));
        spans.push((begin, known.map_or(begin, |end| end.max(begin))));
    }
    spans
}

/// When the states of sensors are not known, by rows in the order of time. It keeps no rows.
#[derive(Clone, Debug, Default)]
pub struct UnknownStates {
    sensors: Vec<UnknownState>,
    last: Option<Micros>,
}

/// The same of one sensor.
#[derive(Clone, Debug, Default)]
struct UnknownState {
    /// Its first row.
    first: Option<Micros>,
    /// Since when its state is not known.
    since: Option<Micros>,
    spans: Spans,
}

impl UnknownStates {
    /// For so many sensors, before their first rows.
    pub fn new(sensors: usize) -> UnknownStates {
        UnknownStates { sensors: vec![UnknownState::default(); sensors], last: None }
    }

    /// Of all rows of a log.
    pub fn of(log: &Log) -> UnknownStates {
        let meanings = Meanings::of(log);
        let mut states = UnknownStates::new(log.sensors.len());
        for event in log.in_order() {
            states.take(event.at, event.sensor as usize, meanings.says(event) == Says::Unknown);
        }
        states
    }

    /// Takes a row.
    pub fn take(&mut self, at: Micros, sensor: usize, is_unknown: bool) {
        let of = &mut self.sensors[sensor];
        of.first = of.first.or(Some(at));
        match is_unknown {
            true => of.since = of.since.or(Some(at)),
            false => of.spans.extend(of.since.take().map(|begin| (begin, at))),
        }
        self.last = Some(at);
    }

    /// The spans of each sensor, in order: from a row that says so to the next that says something else, and over the gaps of the
    /// recorder.
    pub fn spans(self, gaps: &[(Micros, Micros)]) -> Vec<Spans> {
        let last = self.last;
        let all = self.sensors.into_iter().map(|UnknownState { since, mut spans, .. }| {
            spans.extend(since.zip(last));
            spans.extend(gaps);
            spans.sort_unstable();
            merged(&spans)
        });
        all.collect()
    }

    /// When nothing is known of any of some sensors, in order. Before its first row a sensor cannot say that anything is known.
    pub fn of_all(self, gaps: &[(Micros, Micros)], asks: &dyn Fn(usize) -> bool) -> Spans {
        let first: Vec<Option<Micros>> = self.sensors.iter().map(|sensor| sensor.first).collect();
        let asked = self.spans(gaps).into_iter().zip(first).enumerate().filter(|(sensor, _)| asks(*sensor));
        let asked: Vec<(Spans, Micros)> = asked.filter_map(|(_, (spans, first))| Some((spans, first?))).collect();
        let mut said: Spans = asked.iter().flat_map(|(spans, _)| spans).chain(gaps).copied().collect();
        said.sort_unstable();
        asked.into_iter().fold(merged(&said), |all, (mut spans, first)| {
            spans.insert(0, (Micros::MIN, first));
            common(&all, &merged(&spans))
        })
    }
}

/// Spans in order; those that touch become one.
fn merged(spans: &[(Micros, Micros)]) -> Spans {
    let mut merged: Spans = Vec::with_capacity(spans.len());
    for &(begin, end) in spans {
        match merged.last_mut().filter(|last| begin <= last.1) {
            Some(last) => last.1 = last.1.max(end),
            None => merged.push((begin, end)),
        }
    }
    merged
}

/// The parts that two lists of spans in order have in common.
fn common(some: &[(Micros, Micros)], others: &[(Micros, Micros)]) -> Spans {
    let outside = without(some, others);
    without(some, &outside)
}

/// The parts of spans that lie outside others; both in order of time.
pub fn without(spans: &[(Micros, Micros)], others: &[(Micros, Micros)]) -> Spans {
    let mut left = Vec::new();
    let mut first = 0;
    for &(begin, end) in spans {
        while others.get(first).is_some_and(|other| other.1 <= begin) {
            first += 1;
        }
        let mut from = begin;
        for other in others[first..].iter().take_while(|other| other.0 < end) {
            if other.0 > from {
                left.push((from, other.0));
            }
            from = from.max(other.1);
        }
        if from < end {
            left.push((from, end));
        }
    }
    left
}
