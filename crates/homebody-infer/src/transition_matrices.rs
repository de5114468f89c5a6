//! Transition probabilities between states while no sensor sends a message.
//!
//! A Markov process in continuous time. The time to cross a patch of floor comes from the simulated walk; the lengths of
//! stays are our choice, short and long. `exp((Q - L) t)` gives the state after `t` seconds without a message, where `Q`
//! holds the transition rates and the diagonal of `L` the rates of messages.

use crate::exponential::exp;
use crate::states::{StateKind, States};

/// One matrix for each span; each span is longer than the one before by the square root of two.
#[derive(Clone, Debug)]
pub(crate) struct TransitionMatrices {
    states: usize,
    /// By span, row by row: a row for each state at the start.
    steps: Vec<Vec<f32>>,
    /// By span and state: the probability of staying for the whole span in silence, as a logarithm and as a number.
    stays: Vec<Vec<(f32, f32)>>,
}

/// In seconds.
const SHORTEST_S: f64 = 0.125;
/// The longest span is 9 hours.
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

impl TransitionMatrices {
    /// `time_s` is the time in each state, `turns` counts the transitions, `silence` is the rate of messages in each state,
    /// per second.
    pub fn new(states: &States, time_s: &[f64], turns: &[Vec<f64>], silence: &[f64], out_s: f64) -> TransitionMatrices {
        let size = states.len();
        let mut rates = rates(states, time_s, turns, out_s);
        for state in 0..size {
            let leaves: f64 = rates[state].iter().sum();
            rates[state][state] = -leaves - silence[state];
        }
        // The rate that all states share carries no information.
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
        TransitionMatrices { states: size, steps, stays: stays(&falls) }
    }

    pub fn nearest(span_s: f64) -> usize {
        let number = 2.0 * libm::log2((span_s / SHORTEST_S).max(1.0));
        (libm::round(number) as usize).min(SPANS - 1)
    }

    pub fn span_s(span: usize) -> f64 {
        let whole = SHORTEST_S * (1u64 << (span / 2)) as f64;
        if span.is_multiple_of(2) { whole } else { whole * std::f64::consts::SQRT_2 }
    }

    pub fn row(&self, span: usize, state: u32) -> &[f32] {
        &self.steps[span][state as usize * self.states..][..self.states]
    }

    pub fn stays(&self, span: usize) -> &[(f32, f32)] {
        &self.stays[span]
    }

    /// Of the empty body, which has one state.
    pub fn empty() -> TransitionMatrices {
        TransitionMatrices { states: 1, steps: vec![vec![1.0]; SPANS], stays: stays(&[0.0]) }
    }
}

/// `falls` are the changes of the logarithms per second, negative.
fn stays(falls: &[f64]) -> Vec<Vec<(f32, f32)>> {
    let of = |span: usize, fall: f64| {
        let usual = (fall * TransitionMatrices::span_s(span)) as f32;
        (usual, exp(usual))
    };
    (0..SPANS).map(|span| falls.iter().map(|&fall| of(span, fall)).collect()).collect()
}

fn rates(states: &States, time_s: &[f64], turns: &[Vec<f64>], out_s: f64) -> Vec<Vec<f64>> {
    let size = states.len();
    let mut rates = vec![vec![0.0; size]; size];
    let is_walk = |state: usize| states.all[state].kind == StateKind::Walks;
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
    // A person taken to be at home without a sign may have left unseen.
    (1..size).for_each(|state| rates[state][0] = LEAVES_UNSEEN);
    // A person stands at the door before going out.
    let doors: Vec<usize> = (0..size).filter(|&state| turns[state][0] > 0.0).collect();
    for &door in &doors {
        rates[door][0] = 1.0 / COMES_TO_EVERY_S;
        rates[0][door] = 1.0 / out_s / doors.len() as f64;
    }
    rates
}

/// `exp(rates * span)`: the series of a small part of the span, squared repeatedly.
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

/// For each state of staying, the walking state that most often comes before it.
fn before(turns: &[Vec<f64>], states: &States, stays: usize) -> Option<usize> {
    let is_walk = |&state: &usize| states.all[state].kind == StateKind::Walks;
    let often = |state: &usize| turns[*state][stays];
    let best = (0..turns.len()).filter(is_walk).max_by(|a, b| often(a).total_cmp(&often(b)))?;
    (often(&best) > 0.0).then_some(best)
}
