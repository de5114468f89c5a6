//! Somebody who may be visiting the one who lives in a home.
//!
//! Most of a log is made by one person alone, which is found out at a part of what it costs to think of two. Two are thought
//! of in stretches around what one alone would hardly have made the sensors say.

use crate::belief::{Belief, OUT};
use crate::learn::Senses;
use crate::pair::Pair;
use crate::steps::Steps;

/// Smallest logarithm of the likelihood ratio for a visitor in the result, and steps after a visit until the decision
/// (our choice).
const ENOUGH: f64 = 15.0;
const SETTLES: usize = 20;
/// Logarithm of the likelihood for one person alone below which a visitor is considered, and number of earlier steps
/// that are considered, too (our choice).
const SURPRISE: f64 = -8.0;
const BEFORE: usize = 96;
/// Probability above which a person is out (our choice).
const SURELY: f32 = 0.9;

/// What is thought of the one who lives there and a guest, in the stretches in which one may be there.
pub(crate) struct Visits<'a> {
    senses: [&'a Senses; 2],
    stretches: Vec<Stretch<'a>>,
    /// A stretch that goes on after the steps that are told: what is thought there, and how much more likely all is so far.
    open: Option<(Belief, f64)>,
}

/// A stretch of steps in which a guest may be there.
struct Stretch<'a> {
    /// The number of the first.
    first: usize,
    pair: Pair<'a>,
    /// By step, and before the first: how much more likely all is with a guest, as a logarithm.
    gains: Vec<f64>,
    /// By step: whether a guest is told of.
    has_guest: Vec<bool>,
}

impl<'a> Visits<'a> {
    pub fn new(senses: [&'a Senses; 2]) -> Visits<'a> {
        Visits { senses, stretches: Vec::new(), open: None }
    }

    /// Goes on through the steps through which the one has gone alone; the first of them are told.
    pub fn go_on(&mut self, alone: &Pair, steps: &Steps, told: usize) {
        self.stretches.clear();
        let asks = asks(alone);
        let mut now =
            self.open.take().map(|(belief, gain)| Stretch::new(0, Pair::after_belief(self.senses, belief), gain));
        for number in 0..steps.len() {
            if now.is_none() && asks[number] {
                let before = number.checked_sub(1).map_or(&alone.before, |before| &alone.beliefs[before]);
                let states = [before.states[0].clone(), vec![OUT]];
                let belief = Belief { states, chances: before.chances.clone() };
                now = Some(Stretch::new(number, Pair::after_belief(self.senses, belief), 0.0));
            }
            let Some(stretch) = &mut now else { continue };
            let of_one = alone.evidences[number]
                - number.checked_sub(1).map_or(alone.evidence_before, |before| alone.evidences[before]);
            stretch.go_on(steps, number, of_one);
            if number + 1 == told {
                self.open = Some((stretch.pair.last().clone(), stretch.gains[number + 1 - stretch.first]));
            }
            if !asks.get(number + 1).unwrap_or(&false) && stretch.pair.last().out(1) > SURELY {
                if number + 1 == told {
                    self.open = None;
                }
                self.stretches.extend(now.take());
            }
        }
        self.stretches.extend(now);
    }

    /// Goes back through the stretch that ends with this step; `after` is how likely all is that comes after it, of one alone.
    pub fn go_back(&mut self, steps: &Steps, number: usize, after: &Belief) {
        for stretch in self.stretches.iter_mut().filter(|stretch| stretch.end() == number + 1) {
            let all = match number + 1 < steps.len() {
                true => stretch.pair.with_second_out(after),
                false => stretch.pair.nothing_known(),
            };
            stretch.pair.go_back(steps, (stretch.first, usize::MAX), all, |_, _| {});
            stretch.find_guests();
        }
    }

    /// What is thought of both at a step at which a guest is told of.
    pub fn told(&self, number: usize) -> Option<(&Belief, [&'a Senses; 2])> {
        let of = |stretch: &&Stretch| (stretch.first..stretch.end()).contains(&number);
        let stretch = self.stretches.iter().find(of)?;
        let place = number - stretch.first;
        stretch.has_guest[place].then(|| (&stretch.pair.beliefs[place], self.senses))
    }
}

/// By step: whether a guest may come soon.
fn asks(alone: &Pair) -> Vec<bool> {
    let mut asks = vec![false; alone.evidences.len()];
    let mut last = alone.evidence_before;
    for (number, &evidence) in alone.evidences.iter().enumerate() {
        if evidence - last < SURPRISE {
            asks[number.saturating_sub(BEFORE)..=number].fill(true);
        }
        last = evidence;
    }
    asks
}

impl<'a> Stretch<'a> {
    fn new(first: usize, pair: Pair<'a>, gain: f64) -> Stretch<'a> {
        Stretch { first, pair, gains: vec![gain], has_guest: Vec::new() }
    }

    /// The number of the step after its last.
    fn end(&self) -> usize {
        self.first + self.pair.beliefs.len()
    }

    /// Goes on by a step, which the log is so likely with of one person alone.
    fn go_on(&mut self, steps: &Steps, number: usize, of_one: f64) {
        let before = self.pair.evidence;
        self.pair.go_on(steps, number);
        steps.get(number).said.into_iter().for_each(|heard| self.pair.hear(heard, 0.0));
        let last = self.gains.last().copied().unwrap_or(0.0);
        self.gains.push(last + self.pair.evidence - before - of_one);
    }

    /// A guest is where the log is much less likely without.
    fn find_guests(&mut self) {
        let steps = self.pair.beliefs.len();
        let mut has_guest: Vec<bool> = self.pair.beliefs.iter().map(|belief| belief.out(1) < 0.5).collect();
        let mut begin = 0;
        while begin < steps {
            let end = (begin..steps).find(|&step| has_guest[step] != has_guest[begin]).unwrap_or(steps);
            // One who is there from the first step on came before it.
            let before = if begin == 0 { 0.0 } else { self.gains[begin] };
            if has_guest[begin] && self.gains[(end + SETTLES).min(steps)] - before < ENOUGH {
                has_guest[begin..end].fill(false);
            }
            begin = end;
        }
        self.has_guest = has_guest;
    }
}
