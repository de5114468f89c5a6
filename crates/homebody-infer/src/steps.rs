//! A log as steps: spans in which nothing is said, and what is said at their ends.

use crate::flow::Flow;
use crate::said::{Last, Message, Said, Timing};
use crate::spells::Spell;
use homebody_core::time::{Micros, micros, seconds};

/// Duration in seconds below which a person does not move (our choice).
const SHORTEST_S: f64 = 0.02;
/// Length in seconds of the first and the last part of a span (our choice): in between, the person may have gone
/// elsewhere.
const FIRST_PART_S: f64 = 2.0;

/// A span in which nothing is said, and what is said at its end.
#[derive(Clone, Debug)]
pub(crate) struct Step {
    pub end: Micros,
    /// The number of its matrix; none of a span in which nobody gets anywhere.
    pub span: Option<usize>,
    /// What is said at its end; nothing inside of a long silence.
    pub said: Option<Heard>,
    /// Where what is unusual in it begins.
    first: usize,
}

/// A message without its time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Heard {
    /// Index into the home's sensors.
    pub sensor: usize,
    /// What it says.
    pub said: Said,
}

/// A sensor that cannot say ON for a part of a span, or may say OFF.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Unusual {
    pub sensor: usize,
    /// For so many seconds of the span it cannot say ON.
    pub deaf_s: f32,
    /// For so many it may say OFF.
    pub may_end_s: f32,
}

/// The steps of a log, of which those that are done with can be forgotten.
pub(crate) struct Steps<'a> {
    timing: &'a [Timing],
    /// When which sensors cannot be believed.
    spells: &'a [Spell],
    last: Vec<Last>,
    /// Which sensors may be unable to say ON now.
    unusual: Vec<usize>,
    now: Micros,
    steps: Vec<Step>,
    all_unusual: Vec<Unusual>,
}

impl<'a> Steps<'a> {
    pub fn new(timing: &'a [Timing], spells: &'a [Spell]) -> Steps<'a> {
        let last = vec![Last::default(); timing.len()];
        Steps { timing, spells, last, unusual: Vec::new(), now: 0, steps: Vec::new(), all_unusual: Vec::new() }
    }

    pub fn len(&self) -> usize {
        self.steps.len()
    }

    /// When the last of them ends.
    pub fn now(&self) -> Micros {
        self.now
    }

    pub fn get(&self, number: usize) -> &Step {
        &self.steps[number]
    }

    /// What is unusual in a step.
    pub fn unusual(&self, number: usize) -> &[Unusual] {
        let end = self.steps.get(number + 1).map_or(self.all_unusual.len(), |next| next.first);
        &self.all_unusual[self.steps[number].first..end]
    }

    /// Time goes on until a message; one that comes late counts as if it came now.
    pub fn hear(&mut self, message: &Message) {
        let is_ill = |spell: &Spell| spell.sensor == message.sensor && (spell.from..=spell.to).contains(&message.at);
        if self.spells.iter().any(is_ill) {
            return;
        }
        self.go_on(message.at, Some(Heard { sensor: message.sensor, said: message.said }));
        self.last[message.sensor].hear(message, &self.timing[message.sensor]);
        if !self.unusual.contains(&message.sensor) {
            self.unusual.push(message.sensor);
        }
    }

    /// Time goes on until an instant, and then something is said, or not.
    pub fn go_on(&mut self, to: Micros, said: Option<Heard>) {
        let at = to.max(self.now);
        let spans = split(seconds(at - self.now));
        let count = spans.len();
        for (number, span_s) in spans.into_iter().enumerate() {
            let is_last = number + 1 == count;
            let end = if is_last { at } else { self.now + micros(span_s) };
            self.step((self.now, end), said.filter(|_| is_last));
            self.now = end;
        }
    }

    fn step(&mut self, (begin, end): (Micros, Micros), said: Option<Heard>) {
        let first = self.all_unusual.len();
        let span_s = seconds(end - begin);
        let span = (span_s > SHORTEST_S).then(|| Flow::nearest(span_s));
        // Matrices are of spans that are nearly right: what is unusual is so for the same part of them.
        let part = span.map_or(1.0, |span| Flow::span_s(span) / span_s);
        let Steps { unusual, last, all_unusual, .. } = self;
        unusual.retain(|&sensor| {
            let last = &last[sensor];
            let deaf_s = (seconds(last.deaf(begin, end)) * part) as f32;
            let may_end_s = (seconds(last.may_end(begin, end)) * part) as f32;
            if deaf_s > 0.0 || may_end_s > 0.0 {
                all_unusual.push(Unusual { sensor, deaf_s, may_end_s });
            }
            last.is_on || last.blind_until > end
        });
        for spell in self.spells.iter().filter(|spell| spell.from < end && spell.to > begin) {
            let deaf_s = (seconds(spell.to.min(end) - spell.from.max(begin)) * part) as f32;
            let known = all_unusual[first..].iter_mut().find(|one| one.sensor == spell.sensor);
            match known {
                Some(one) => (one.deaf_s, one.may_end_s) = (one.deaf_s.max(deaf_s), 0.0),
                None => all_unusual.push(Unusual { sensor: spell.sensor, deaf_s, may_end_s: 0.0 }),
            }
        }
        self.steps.push(Step { end, span, said, first });
    }

    /// Forgets the first steps.
    pub fn forget(&mut self, steps: usize) {
        let first = self.steps.get(steps).map_or(self.all_unusual.len(), |step| step.first);
        self.all_unusual.drain(..first);
        self.steps.drain(..steps);
        self.steps.iter_mut().for_each(|step| step.first -= first);
    }
}

/// A span in parts that are short at both ends.
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
    fn parts_of_a_span_are_short_at_both_ends_and_are_the_span() {
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
