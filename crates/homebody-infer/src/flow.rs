//! How somebody gets from state to state when no sensor says anything.
//!
//! States follow each other as a Markov process in continuous time: the way over a patch of floor takes as long as it took when
//! the home was gone through; how long people stay is ours, with times for short and for long stays. `exp((Q - L) t)` says where
//! somebody is after `t` seconds in which nothing is said, where `Q` has the rates of the turns and `L`, on its diagonal, the
//! rates at which something would have been said.

use crate::exponential::exp;
use crate::states::{Kind, States};

/// Matrices for spans that grow by the square root of two.
#[derive(Clone, Debug)]
pub(crate) struct Flow {
    states: usize,
    /// By span: where from, where to, row by row.
    steps: Vec<Vec<f32>>,
    /// The chance of staying in a state for a whole span in silence, by span and state: first its logarithm, then itself.
    stays: Vec<Vec<(f32, f32)>>,
}

/// The shortest span, in seconds.
const SHORTEST_S: f64 = 0.125;
/// How many spans there are: the longest is of 9 hours.
const SPANS: usize = 37;

/// Durations of a state in seconds, and intervals after which a person leaves it for another (our choice). A walking
/// person may stop anywhere.
const STOPS_EVERY_S: f64 = 12.0;
const STANDS_S: f64 = 15.0;
const COMES_TO_EVERY_S: f64 = 8.0;
const BUSY_S: f64 = 100.0;
const RESTS_AFTER_S: f64 = 150.0;
const RESTS_S: f64 = 1_800.0;
const STIRS_AFTER_S: f64 = 1_200.0;
/// Rate, per second, at which a person leaves unseen (our choice): the cost of an error is bounded.
const LEAVES_UNSEEN: f64 = 1e-6;

impl Flow {
    /// Of states in which a body was for so long, and went from one to the other so often; `silence` is how much would have been
    /// said, in messages a second.
    pub fn new(states: &States, time_s: &[f64], turns: &[Vec<f64>], silence: &[f64], out_s: f64) -> Flow {
        let size = states.len();
        let mut rates = rates(states, time_s, turns, out_s);
        for state in 0..size {
            let leaves: f64 = rates[state].iter().sum();
            rates[state][state] = -leaves - silence[state];
        }
        // All grows unlikely at least so fast; what is common to all states says nothing.
        let least = silence.iter().copied().fold(f64::INFINITY, f64::min);
        (0..size).for_each(|state| rates[state][state] += least);
        let falls: Vec<f64> = (0..size).map(|state| rates[state][state]).collect();
        let first = exponential(&rates, SHORTEST_S);
        let second = exponential(&rates, SHORTEST_S * std::f64::consts::SQRT_2);
        let mut steps = vec![first, second];
        while steps.len() < SPANS {
            let half = &steps[steps.len() - 2];
            steps.push(product(half, half, size));
        }
        let steps = steps.into_iter().map(|step| step.into_iter().map(|one| one as f32).collect()).collect();
        Flow { states: size, steps, stays: stays(&falls) }
    }

    /// The number of the span that comes nearest.
    pub fn nearest(span_s: f64) -> usize {
        let number = 2.0 * libm::log2((span_s / SHORTEST_S).max(1.0));
        (libm::round(number) as usize).min(SPANS - 1)
    }

    /// How long the span of a number is, in seconds.
    pub fn span_s(span: usize) -> f64 {
        let whole = SHORTEST_S * (1u64 << (span / 2)) as f64;
        if span.is_multiple_of(2) { whole } else { whole * std::f64::consts::SQRT_2 }
    }

    /// The chances of where somebody is after a span who was in a state before.
    pub fn row(&self, span: usize, state: u32) -> &[f32] {
        &self.steps[span][state as usize * self.states..][..self.states]
    }

    /// For each state, the logarithm of the chance of staying there for the whole span. Then that chance.
    pub fn stays(&self, span: usize) -> &[(f32, f32)] {
        &self.stays[span]
    }

    /// Of nobody, who is always in the one state.
    pub fn nobody() -> Flow {
        Flow { states: 1, steps: vec![vec![1.0]; SPANS], stays: stays(&[0.0]) }
    }
}

/// The chances of staying, from how fast the logarithm of each falls a second; negative.
fn stays(falls: &[f64]) -> Vec<Vec<(f32, f32)>> {
    let of = |span: usize, fall: f64| {
        let usual = (fall * Flow::span_s(span)) as f32;
        (usual, exp(usual))
    };
    (0..SPANS).map(|span| falls.iter().map(|&fall| of(span, fall)).collect()).collect()
}

/// How often a second somebody turns from a state to another.
fn rates(states: &States, time_s: &[f64], turns: &[Vec<f64>], out_s: f64) -> Vec<Vec<f64>> {
    let size = states.len();
    let mut rates = vec![vec![0.0; size]; size];
    let is_walk = |state: usize| states.all[state].kind == Kind::Walks;
    for from in (0..size).filter(|&state| is_walk(state) && time_s[state] > 0.0) {
        for to in (0..size).filter(|&state| is_walk(state) && state != from) {
            rates[from][to] = turns[from][to] / time_s[from];
        }
    }
    for (walks, stands) in states.patches() {
        rates[walks][stands] = 1.0 / STOPS_EVERY_S;
        rates[stands][walks] = 1.0 / STANDS_S;
    }
    for station in &states.stations {
        let Some(walks) = before(turns, states, station.busy) else { continue };
        rates[walks][station.busy] = 1.0 / COMES_TO_EVERY_S;
        rates[station.busy][walks] = 1.0 / BUSY_S;
        let mut stays = vec![station.busy];
        if let Some(still) = station.still {
            rates[station.busy][still] = 1.0 / RESTS_AFTER_S;
            rates[still][station.busy] = 1.0 / STIRS_AFTER_S;
            rates[still][walks] = 1.0 / RESTS_S;
            stays.push(still);
        }
        for other in stays {
            for (from, to) in [(other, station.motionless), (station.motionless, other)] {
                rates[from][to] = turns[from][to] / time_s[from].max(1.0);
            }
        }
        rates[station.motionless][walks] = 1.0 / RESTS_S;
    }
    // Who is taken to be at home, and gives no sign of it, may have left without being seen.
    (1..size).for_each(|state| rates[state][0] = LEAVES_UNSEEN);
    // Who goes out stands at the door before.
    let doors: Vec<usize> = (0..size).filter(|&state| turns[state][0] > 0.0).collect();
    for &door in &doors {
        rates[door][0] = 1.0 / COMES_TO_EVERY_S;
        rates[0][door] = 1.0 / out_s / doors.len() as f64;
    }
    rates
}

/// `exp(rates * span)`, by the series of a small part of the span, squared.
fn exponential(rates: &[Vec<f64>], span_s: f64) -> Vec<f64> {
    const TERMS: usize = 8;
    let size = rates.len();
    let largest = (0..size).map(|state| rates[state][state].abs()).fold(0.0, f64::max);
    let halvings = (libm::ceil(libm::log2((largest * span_s).max(1e-9))) as i32 + 2).max(0);
    let part_s = span_s / libm::pow(2.0, f64::from(halvings));
    let small: Vec<f64> = rates.iter().flatten().map(|rate| rate * part_s).collect();
    let mut term = identity(size);
    let mut sum = identity(size);
    for number in 1..=TERMS {
        term = product(&term, &small, size);
        term.iter_mut().for_each(|one| *one /= number as f64);
        sum.iter_mut().zip(&term).for_each(|(sum, term)| *sum += term);
    }
    for _ in 0..halvings {
        sum = product(&sum, &sum, size);
    }
    sum
}

fn identity(size: usize) -> Vec<f64> {
    (0..size * size).map(|place| if place % (size + 1) == 0 { 1.0 } else { 0.0 }).collect()
}

fn product(a: &[f64], b: &[f64], size: usize) -> Vec<f64> {
    let mut product = vec![0.0; size * size];
    for (row, to) in product.chunks_exact_mut(size).enumerate() {
        for (middle, &factor) in a[row * size..][..size].iter().enumerate().filter(|(_, factor)| **factor != 0.0) {
            let from = &b[middle * size..][..size];
            to.iter_mut().zip(from).for_each(|(to, from)| *to += factor * from);
        }
    }
    product
}

/// Which walks lead to a stay: of each state of staying, the state of walking that comes before it most often.
fn before(turns: &[Vec<f64>], states: &States, stays: usize) -> Option<usize> {
    let is_walk = |&state: &usize| states.all[state].kind == Kind::Walks;
    let often = |state: &usize| turns[*state][stays];
    let best = (0..turns.len()).filter(is_walk).max_by(|a, b| often(a).total_cmp(&often(b)))?;
    (often(&best) > 0.0).then_some(best)
}
