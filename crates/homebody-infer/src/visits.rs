//! Detection of a visitor to a single resident.
//!
//! Most of a log has one person only, which costs far less to compute than two. Two are computed only around messages that
//! one person hardly explains.

use crate::belief::{Belief, OUT};
use crate::body_pair::BodyPair;
use crate::log_step::LogSteps;
use crate::senses::Senses;

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

pub(crate) struct Visits<'a> {
    senses: [&'a Senses; 2],
    stretches: Vec<VisitInterval<'a>>,
    /// An interval that continues into the next block: its belief, and the gain so far.
    open: Option<(Belief, f64)>,
}

struct VisitInterval<'a> {
    /// Index of its first step.
    first: usize,
    pair: BodyPair<'a>,
    /// Before the first step and by step: the logarithm of the likelihood ratio of a visitor.
    gains: Vec<f64>,
    has_guest: Vec<bool>,
}

impl<'a> Visits<'a> {
    pub fn new(senses: [&'a Senses; 2]) -> Visits<'a> {
        Visits { senses, stretches: Vec::new(), open: None }
    }

    /// Continues with the steps that the resident's forward pass has processed; the first `reported` of them are reported.
    pub fn advance(&mut self, alone: &BodyPair, steps: &LogSteps, reported: usize) {
        self.stretches.clear();
        let arrivals = possible_arrivals(alone);
        let mut now = self
            .open
            .take()
            .map(|(belief, gain)| VisitInterval::new(0, BodyPair::after_belief(self.senses, belief), gain));
        for number in 0..steps.len() {
            if now.is_none() && arrivals[number] {
                let before = number.checked_sub(1).map_or(&alone.before, |before| &alone.beliefs[before]);
                let states = [before.states[0].clone(), vec![OUT]];
                let belief = Belief { states, chances: before.chances.clone() };
                now = Some(VisitInterval::new(number, BodyPair::after_belief(self.senses, belief), 0.0));
            }
            let Some(stretch) = &mut now else { continue };
            let of_one = alone.evidences[number]
                - number.checked_sub(1).map_or(alone.evidence_before, |before| alone.evidences[before]);
            stretch.advance(steps, number, of_one);
            if number + 1 == reported {
                self.open = Some((stretch.pair.last().clone(), stretch.gains[number + 1 - stretch.first]));
            }
            if !arrivals.get(number + 1).unwrap_or(&false) && stretch.pair.last().out(1) > SURELY {
                if number + 1 == reported {
                    self.open = None;
                }
                self.stretches.extend(now.take());
            }
        }
        self.stretches.extend(now);
    }

    /// Smooths an interval that ends with this step; `after` is the likelihood of the future of the resident.
    pub fn go_back(&mut self, steps: &LogSteps, number: usize, after: &Belief) {
        for stretch in self.stretches.iter_mut().filter(|stretch| stretch.end() == number + 1) {
            let all = match number + 1 < steps.len() {
                true => stretch.pair.with_second_out(after),
                false => stretch.pair.nothing_known(),
            };
            stretch.pair.go_back(steps, (stretch.first, usize::MAX), all, |_, _| {});
            stretch.find_guests();
        }
    }

    pub fn reported(&self, number: usize) -> Option<(&Belief, [&'a Senses; 2])> {
        let of = |stretch: &&VisitInterval| (stretch.first..stretch.end()).contains(&number);
        let stretch = self.stretches.iter().find(of)?;
        let place = number - stretch.first;
        stretch.has_guest[place].then(|| (&stretch.pair.beliefs[place], self.senses))
    }
}

/// By step: whether a visitor may come soon.
fn possible_arrivals(alone: &BodyPair) -> Vec<bool> {
    let mut arrivals = vec![false; alone.evidences.len()];
    let mut last = alone.evidence_before;
    for (number, &evidence) in alone.evidences.iter().enumerate() {
        if evidence - last < SURPRISE {
            arrivals[number.saturating_sub(BEFORE)..=number].fill(true);
        }
        last = evidence;
    }
    arrivals
}

impl<'a> VisitInterval<'a> {
    fn new(first: usize, pair: BodyPair<'a>, gain: f64) -> VisitInterval<'a> {
        VisitInterval { first, pair, gains: vec![gain], has_guest: Vec::new() }
    }

    fn end(&self) -> usize {
        self.first + self.pair.beliefs.len()
    }

    fn advance(&mut self, steps: &LogSteps, number: usize, of_one: f64) {
        let before = self.pair.evidence;
        self.pair.advance(steps, number);
        steps.get(number).said.into_iter().for_each(|heard| self.pair.hear(heard, 0.0));
        let last = self.gains.last().copied().unwrap_or(0.0);
        self.gains.push(last + self.pair.evidence - before - of_one);
    }

    /// Marks a visitor where the log is much less likely without.
    fn find_guests(&mut self) {
        let steps = self.pair.beliefs.len();
        let mut has_guest: Vec<bool> = self.pair.beliefs.iter().map(|belief| belief.out(1) < 0.5).collect();
        let mut begin = 0;
        while begin < steps {
            let end = (begin..steps).find(|&step| has_guest[step] != has_guest[begin]).unwrap_or(steps);
            // A visitor present at the first step came before it.
            let before = if begin == 0 { 0.0 } else { self.gains[begin] };
            if has_guest[begin] && self.gains[(end + SETTLES).min(steps)] - before < ENOUGH {
                has_guest[begin..end].fill(false);
            }
            begin = end;
        }
        self.has_guest = has_guest;
    }
}
