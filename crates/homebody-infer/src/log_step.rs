//! A log as steps: silent spans, each with the message at its end.

use crate::fault_interval::FaultInterval;
use crate::message::{LastMessage, LogMessage, MessageKind, ReportTiming};
use crate::transition_matrices::TransitionMatrices;
use homebody_core::time::{Interval, RunTime, Span};

/// Duration in seconds below which a person does not move (our choice).
const SHORTEST_S: f64 = 0.02;
/// Length in seconds of the first and the last part of a span (our choice): in between, the person may have gone
/// elsewhere.
const FIRST_PART_S: f64 = 2.0;

#[derive(Clone, Debug)]
pub(crate) struct LogStep {
    pub end: RunTime,
    /// Index of its matrix; `None` if it is too short to move.
    pub span: Option<usize>,
    /// `None` inside of a long silence.
    pub said: Option<MessageContent>,
    /// Start of its entries in `all_unusual`.
    first: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MessageContent {
    pub sensor: usize,
    pub said: MessageKind,
}

/// A sensor that cannot send ON, or can send OFF, for part of a span.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LimitedSensor {
    pub sensor: usize,
    pub deaf_s: f32,
    pub may_end_s: f32,
}

pub(crate) struct LogSteps<'a> {
    timing: &'a [ReportTiming],
    faults: &'a [FaultInterval],
    last: Vec<LastMessage>,
    unusual: Vec<usize>,
    now: RunTime,
    steps: Vec<LogStep>,
    all_unusual: Vec<LimitedSensor>,
}

impl<'a> LogSteps<'a> {
    pub fn new(timing: &'a [ReportTiming], faults: &'a [FaultInterval]) -> LogSteps<'a> {
        let last = vec![LastMessage::default(); timing.len()];
        let now = RunTime::START;
        LogSteps { timing, faults, last, unusual: Vec::new(), now, steps: Vec::new(), all_unusual: Vec::new() }
    }

    pub fn len(&self) -> usize {
        self.steps.len()
    }

    pub fn now(&self) -> RunTime {
        self.now
    }

    pub fn get(&self, number: usize) -> &LogStep {
        &self.steps[number]
    }

    pub fn unusual(&self, number: usize) -> &[LimitedSensor] {
        let end = self.steps.get(number + 1).map_or(self.all_unusual.len(), |next| next.first);
        &self.all_unusual[self.steps[number].first..end]
    }

    /// A late message counts as if it came now.
    pub fn hear(&mut self, message: &LogMessage) {
        let is_ill = |interval: &FaultInterval| {
            interval.sensor == message.sensor && (interval.from..=interval.to).contains(&message.at)
        };
        if self.faults.iter().any(is_ill) {
            return;
        }
        self.advance(message.at, Some(MessageContent { sensor: message.sensor, said: message.said }));
        self.last[message.sensor].hear(message, &self.timing[message.sensor]);
        if !self.unusual.contains(&message.sensor) {
            self.unusual.push(message.sensor);
        }
    }

    pub fn advance(&mut self, to: RunTime, said: Option<MessageContent>) {
        let at = to.max(self.now);
        let spans = split((at - self.now).seconds());
        let count = spans.len();
        for (number, span_s) in spans.into_iter().enumerate() {
            let is_last = number + 1 == count;
            let end = if is_last { at } else { self.now + Span::from_seconds(span_s) };
            self.step(Interval::new(self.now, end), said.filter(|_| is_last));
            self.now = end;
        }
    }

    fn step(&mut self, silent: Interval<RunTime>, said: Option<MessageContent>) {
        let Interval { begin, end } = silent;
        let first = self.all_unusual.len();
        let span_s = silent.length().seconds();
        let span = (span_s > SHORTEST_S).then(|| TransitionMatrices::nearest(span_s));
        // Matrices have fixed spans, so unusual times are scaled to the span of the matrix.
        let part = span.map_or(1.0, |span| TransitionMatrices::span_s(span) / span_s);
        let LogSteps { unusual, last, all_unusual, .. } = self;
        unusual.retain(|&sensor| {
            let last = &last[sensor];
            let deaf_s = (last.deaf(silent).seconds() * part) as f32;
            let may_end_s = (last.may_end(silent).seconds() * part) as f32;
            if deaf_s > 0.0 || may_end_s > 0.0 {
                all_unusual.push(LimitedSensor { sensor, deaf_s, may_end_s });
            }
            last.is_on || last.blind_until > end
        });
        for interval in self.faults.iter().filter(|interval| interval.from < end && interval.to > begin) {
            let deaf_s = ((interval.to.min(end) - interval.from.max(begin)).seconds() * part) as f32;
            let known = all_unusual[first..].iter_mut().find(|one| one.sensor == interval.sensor);
            match known {
                Some(one) => (one.deaf_s, one.may_end_s) = (one.deaf_s.max(deaf_s), 0.0),
                None => all_unusual.push(LimitedSensor { sensor: interval.sensor, deaf_s, may_end_s: 0.0 }),
            }
        }
        self.steps.push(LogStep { end, span, said, first });
    }

    pub fn forget(&mut self, steps: usize) {
        let first = self.steps.get(steps).map_or(self.all_unusual.len(), |step| step.first);
        self.all_unusual.drain(..first);
        self.steps.drain(..steps);
        self.steps.iter_mut().for_each(|step| step.first -= first);
    }
}

fn split(span_s: f64) -> Vec<f64> {
    let mut side = Vec::new();
    let (mut left, mut part) = (span_s, FIRST_PART_S);
    while left > 2.0 * part + FIRST_PART_S {
        side.push(part);
        left -= 2.0 * part;
        part *= 2.0;
    }
    let back: Vec<f64> = side.iter().rev().copied().collect();
    side.into_iter().chain([left]).chain(back).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_a_span_sum_to_it_and_are_short_at_both_ends() {
        for span_s in [0.0, 0.3, 5.9, 6.1, 77.7, 3_600.0, 100_000.0] {
            let parts = split(span_s);
            assert!((parts.iter().sum::<f64>() - span_s).abs() < 1e-9, "{span_s}");
            assert!(parts.len() < 40);
            let mut back = parts.clone();
            back.reverse();
            assert_eq!(parts, back);
        }
        assert_eq!(split(10.0), [2.0, 6.0, 2.0]);
    }
}
