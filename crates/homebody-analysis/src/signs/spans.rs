//! From when to when sensors say that something goes on, and when their state is not known.

use super::course::Course;
use super::says::{Says, says};
use homebody_core::time::Micros;
use homebody_log::Log;

/// From when to when something goes on, each time.
pub type Spans = Vec<(Micros, Micros)>;

/// The spans over which each sensor says that something goes on, in order. Where a sensor never says that it ends, a span
/// is an instant; what has not ended when the log does ends as it begins. What is on while a state stops being known ends there.
pub fn spans(log: &Log) -> Vec<Spans> {
    spans_until(log, None)
}

/// The same, but what has not ended when the log does ends at an instant, where one is given.
pub fn spans_until(log: &Log, end: Option<Micros>) -> Vec<Spans> {
    let values: Vec<Says> = log.values.iter().map(|value| says(value)).collect();
    let mut ends = vec![false; log.sensors.len()];
    for event in &log.events {
        ends[event.sensor as usize] |= matches!(values[event.value as usize], Says::Ends | Says::Closes);
    }
    let mut spans = vec![Vec::new(); log.sensors.len()];
    let mut since: Vec<Option<Micros>> = vec![None; log.sensors.len()];
    let mut courses = vec![Course::default(); log.sensors.len()];
    for event in log.in_order() {
        let sensor = event.sensor as usize;
        let said = courses[sensor].take(event.at, values[event.value as usize], &log.gaps);
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

/// When the state of each sensor is not known, in order: from a row that says so to the next that says something else, and over the gaps
/// of the recorder.
pub fn unknown(log: &Log) -> Vec<Spans> {
    let values: Vec<bool> = log.values.iter().map(|value| says(value) == Says::Unknown).collect();
    let mut spans = vec![Vec::new(); log.sensors.len()];
    let mut since: Vec<Option<Micros>> = vec![None; log.sensors.len()];
    let mut last = None;
    for event in log.in_order() {
        let sensor = event.sensor as usize;
        match values[event.value as usize] {
            true => since[sensor] = since[sensor].or(Some(event.at)),
            false => spans[sensor].extend(since[sensor].take().map(|begin| (begin, event.at))),
        }
        last = Some(event.at);
    }
    for (spans, since) in spans.iter_mut().zip(since) {
        spans.extend(since.zip(last));
        spans.extend(log.gaps.iter().copied());
        spans.sort_unstable();
        *spans = merged(spans);
    }
    spans
}

/// When nothing is known of any of some sensors, in order. One without a row says nothing of it.
pub fn unknown_of_all(log: &Log, asks: &dyn Fn(usize) -> bool) -> Spans {
    let mut has_rows = vec![false; log.sensors.len()];
    log.events.iter().for_each(|event| has_rows[event.sensor as usize] = true);
    let mut asked = unknown(log).into_iter().enumerate().filter(|(sensor, _)| has_rows[*sensor] && asks(*sensor));
    let Some((_, first)) = asked.next() else { return log.gaps.clone() };
    asked.fold(first, |all, (_, spans)| common(&all, &spans))
}

/// Spans in order, of which those that touch are one.
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

/// What lies in both of two lists of spans in order.
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
