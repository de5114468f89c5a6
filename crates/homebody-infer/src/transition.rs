//! Transitions of one body while some sensors cannot send.

use crate::exponential::exp;
use crate::log_step::LimitedSensor;
use crate::message::MessageKind;
use crate::senses::{SILENCE, Senses};

/// Exponent below which a factor makes no difference (our choice).
const NOTHING: f32 = 1e-3;
/// Ratio to the most frequent turn from the same state below which a turn is dropped (our choice). Each step loses no
/// more than this share for each state that counts.
const RARE: f32 = 1e-6;

/// Set for each step anew, with reused memory.
#[derive(Clone, Debug, Default)]
pub(crate) struct TransitionStep {
    span: usize,
    /// States with an unusual span.
    odd: Vec<UnusualState>,
    /// By state.
    passing: Vec<f32>,
    stays: Vec<f32>,
    /// Buffers: by state, zero between uses; by tracked state; and exponentials.
    dense: Vec<f32>,
    weighed: Vec<f32>,
    powers: Vec<f32>,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct UnusualState {
    state: u32,
    /// Expected messages that the usual matrix assumes, but that cannot occur.
    unsaid: f32,
    /// Factor for a body that enters or leaves within the span.
    passing: f32,
    /// Probability of staying for the whole span, beyond that in the matrix.
    stays: f32,
}

/// Sparse transition probabilities, by state at the start.
#[derive(Clone, Debug, Default)]
pub(crate) struct StateTransitions {
    /// By state at the start, the index of its first entry; then the number of all.
    first: Vec<u32>,
    /// State at the end, and probability.
    turns: Vec<(u32, f32)>,
    passing: Vec<f32>,
    chances: Vec<f32>,
}

impl TransitionStep {
    pub fn new(states: usize) -> TransitionStep {
        let zeros = || vec![0.0; states];
        TransitionStep { passing: vec![1.0; states], stays: zeros(), dense: zeros(), ..Default::default() }
    }

    pub fn set(&mut self, senses: &Senses, span: usize, unusual: &[LimitedSensor]) {
        self.forget();
        self.span = span;
        let TransitionStep { odd, dense, powers, .. } = self;
        let mut add = |rates: &[(u32, f32)], seconds: f32| {
            for &(state, rate) in rates {
                let unsaid = &mut dense[state as usize];
                if *unsaid == 0.0 {
                    odd.push(UnusualState { state, unsaid: 0.0, passing: 1.0, stays: 0.0 });
                }
                *unsaid += rate * seconds;
            }
        };
        for one in unusual {
            add(senses.excess_rates(one.sensor, MessageKind::On), one.deaf_s * SILENCE as f32);
            if one.may_end_s > 0.0 && !senses.timing[one.sensor].feels {
                add(senses.excess_rates(one.sensor, MessageKind::Off), -one.may_end_s);
            }
        }
        odd.iter_mut().for_each(|odd| odd.unsaid = std::mem::take(&mut dense[odd.state as usize]));
        odd.retain(|odd| odd.unsaid.abs() >= NOTHING);
        // A body that enters or leaves at any time of the span is there for part of it: the mean of the exponential over
        // all parts.
        exponentials(odd.iter().map(|odd| -odd.unsaid), powers);
        odd.iter_mut().zip(powers.iter()).for_each(|(odd, power)| odd.passing = odd.unsaid / (1.0 - power));
        let usual = senses.flow.stays(span);
        exponentials(odd.iter().map(|odd| usual[odd.state as usize].0 + odd.unsaid), powers);
        for (odd, power) in odd.iter_mut().zip(powers.iter()) {
            odd.stays = (power - usual[odd.state as usize].1 * odd.passing * odd.passing).max(0.0);
        }
        self.spread();
    }

    /// Restores a span from its unusual states.
    pub fn set_again(&mut self, span: usize, odd: &[UnusualState]) {
        self.forget();
        self.span = span;
        self.odd.extend_from_slice(odd);
        self.spread();
    }

    pub fn odd(&self) -> &[UnusualState] {
        &self.odd
    }

    fn forget(&mut self) {
        for odd in self.odd.drain(..) {
            (self.passing[odd.state as usize], self.stays[odd.state as usize]) = (1.0, 0.0);
        }
    }

    fn spread(&mut self) {
        for odd in &self.odd {
            (self.passing[odd.state as usize], self.stays[odd.state as usize]) = (odd.passing, odd.stays);
        }
    }

    pub fn forward(&self, senses: &Senses, chances: &[f32], states: &[u32], to: &mut Vec<f32>) {
        to.clear();
        to.resize(self.passing.len(), 0.0);
        let row = |state: u32| senses.flow.row(self.span, state);
        let chance = |place: usize| chances[place] * self.passing[states[place] as usize];
        let mut fours = states.chunks_exact(4);
        for (place, four) in (0..).step_by(4).zip(&mut fours) {
            let [a, b, c, d] = [0, 1, 2, 3].map(|one| chance(place + one));
            let rows = row(four[0]).iter().zip(row(four[1])).zip(row(four[2])).zip(row(four[3]));
            for (to, (((first, second), third), fourth)) in to.iter_mut().zip(rows) {
                *to += (a * first + b * second) + (c * third + d * fourth);
            }
        }
        let rest = states.len() / 4 * 4;
        for (place, &state) in states.iter().enumerate().skip(rest) {
            add(to, chance(place), row(state));
        }
        self.odd.iter().for_each(|odd| to[odd.state as usize] *= odd.passing);
        for (&state, chance) in states.iter().zip(chances) {
            to[state as usize] += chance * self.stays[state as usize];
        }
    }

    /// The likelihood of the future for each state in `from`, where `chances` is that for each state in `to` at the end of
    /// the span.
    pub fn back(&mut self, senses: &Senses, chances: &[f32], (to, from): (&[u32], &[u32]), before: &mut Vec<f32>) {
        before.clear();
        self.weighed.clear();
        for (&state, &chance) in to.iter().zip(chances) {
            self.dense[state as usize] = chance;
            self.weighed.push(chance * self.passing[state as usize]);
        }
        let mut add = |state: u32, passes: f32| {
            let stays = self.dense[state as usize] * self.stays[state as usize];
            before.push(passes * self.passing[state as usize] + stays);
        };
        let row = |state: u32| senses.flow.row(self.span, state);
        let fours = from.chunks_exact(FOUR);
        let rest = fours.remainder();
        for four in fours {
            let states: [u32; FOUR] = std::array::from_fn(|one| four[one]);
            let passes = chosen(states.map(row), to, &self.weighed);
            states.into_iter().zip(passes).for_each(|(state, passes)| add(state, passes));
        }
        for &state in rest {
            let [passes] = chosen([row(state)], to, &self.weighed);
            add(state, passes);
        }
        to.iter().for_each(|&state| self.dense[state as usize] = 0.0);
    }

    pub fn between(&self, senses: &Senses, from: &[u32], to: &[u32], between: &mut StateTransitions) {
        let StateTransitions { first, turns, passing, chances } = between;
        first.clear();
        turns.clear();
        passing.clear();
        passing.extend(to.iter().map(|&to| self.passing[to as usize]));
        for &state in from {
            first.push(turns.len() as u32);
            let (row, own) = (senses.flow.row(self.span, state), self.passing[state as usize]);
            chances.clear();
            chances.extend(to.iter().zip(passing.iter()).map(|(&to, passing)| row[to as usize] * passing * own));
            let stays = self.stays[state as usize];
            let most = chances.iter().fold(0.0, |most, &one| if one > most { one } else { most });
            let least = most.max(stays) * RARE;
            if let Ok(place) = to.binary_search(&state) {
                chances[place] += stays;
            }
            turns.extend((0..).zip(chances.iter().copied()).filter(|(_, chance)| *chance > least));
        }
        first.push(turns.len() as u32);
    }
}

impl StateTransitions {
    fn turns_of(&self, from: usize) -> &[(u32, f32)] {
        &self.turns[self.first[from] as usize..self.first[from + 1] as usize]
    }

    pub fn forward(&self, rows: &[f32], [columns, states]: [usize; 2], to: &mut Vec<f32>) {
        to.clear();
        to.resize(columns * states, 0.0);
        for (from, row) in rows.chunks_exact(columns.max(1)).enumerate() {
            for &(state, chance) in self.turns_of(from) {
                add(&mut to[state as usize * columns..][..columns], chance, row);
            }
        }
    }

    pub fn back(&self, rows: &[f32], columns: usize, from: &mut Vec<f32>) {
        from.clear();
        from.resize(columns * (self.first.len() - 1), 0.0);
        for (state, sums) in from.chunks_exact_mut(columns.max(1)).enumerate() {
            for &(to, chance) in self.turns_of(state) {
                add(sums, chance, &rows[to as usize * columns..][..columns]);
            }
        }
    }
}

fn exponentials(numbers: impl Iterator<Item = f32>, powers: &mut Vec<f32>) {
    powers.clear();
    powers.extend(numbers);
    powers.iter_mut().for_each(|one| *one = exp(*one));
}

fn add(sums: &mut [f32], factor: f32, row: &[f32]) {
    sums.iter_mut().zip(row).for_each(|(sum, one)| *sum += factor * one);
}

/// Rows that are processed at once.
const FOUR: usize = 4;

/// The weighted sum of chosen entries of each row, in independent parts that the processor can overlap.
fn chosen<const ROWS: usize>(rows: [&[f32]; ROWS], places: &[u32], factors: &[f32]) -> [f32; ROWS] {
    const PARTS: usize = 4;
    let mut sums = [[0.0; ROWS]; PARTS];
    let mut rest = [0.0; ROWS];
    // Equal lengths need only one bounds check.
    let rows = rows.map(|row| &row[..rows[0].len()]);
    let (places, factors) = (places.chunks_exact(PARTS), factors.chunks_exact(PARTS));
    let add = |sums: &mut [f32; ROWS], place: u32, factor: f32| {
        sums.iter_mut().zip(rows).for_each(|(sum, row)| *sum += row[place as usize] * factor);
    };
    let left = places.remainder().iter().zip(factors.remainder());
    left.for_each(|(&place, &factor)| add(&mut rest, place, factor));
    for (places, factors) in places.zip(factors) {
        for ((sums, &place), &factor) in sums.iter_mut().zip(places).zip(factors) {
            add(sums, place, factor);
        }
    }
    std::array::from_fn(|row| rest[row] + (sums[0][row] + sums[1][row]) + (sums[2][row] + sums[3][row]))
}

pub(crate) fn transposed(rows: &[f32], columns: usize, over: &mut Vec<f32>) {
    let height = rows.len() / columns.max(1);
    over.clear();
    over.resize(rows.len(), 0.0);
    for (row, numbers) in rows.chunks_exact(columns.max(1)).enumerate() {
        for (column, &number) in numbers.iter().enumerate() {
            over[column * height + row] = number;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::senses::tests::senses;

    const CHANCES: [[f32; 4]; 3] = [[0.9, 0.1, 0.0, 1e-9], [0.0, 0.5, 0.5, 0.0], [0.2, 0.0, 0.3, 0.4]];

    fn between() -> StateTransitions {
        let mut between = StateTransitions::default();
        for row in CHANCES {
            between.first.push(between.turns.len() as u32);
            between.turns.extend((0..).zip(row).filter(|(_, chance)| *chance > RARE));
        }
        between.first.push(between.turns.len() as u32);
        between
    }

    fn near(a: &[f32], b: &[f32]) -> bool {
        a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6)
    }

    #[test]
    fn sparse_product_equals_the_full_product() {
        let (mut to, mut from) = (Vec::new(), Vec::new());
        let was = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        between().forward(&was, [2, 4], &mut to);
        let of = |state: usize, column: usize| (0..3).map(|from| CHANCES[from][state] * was[from * 2 + column]).sum();
        let all: Vec<f32> = (0..8).map(|place| of(place / 2, place % 2)).collect();
        assert!(near(&to, &all), "{to:?} {all:?}");
        between().back(&all, 2, &mut from);
        let of = |state: usize, column: usize| (0..4).map(|to| CHANCES[state][to] * all[to * 2 + column]).sum();
        let before: Vec<f32> = (0..6).map(|place| of(place / 2, place % 2)).collect();
        assert!(near(&from, &before), "{from:?} {before:?}");
        assert!(!near(&from, &was));
    }

    #[test]
    fn restored_span_equals_the_original() {
        let senses = senses();
        let states: Vec<u32> = (0..senses.states().len() as u32).collect();
        let chances = vec![1.0; states.len()];
        let forward = |turns: &TransitionStep| {
            let mut to = Vec::new();
            turns.forward(&senses, &chances, &states, &mut to);
            to
        };
        let mut turns = TransitionStep::new(states.len());
        turns.set(&senses, 8, &[LimitedSensor { sensor: 0, deaf_s: 1.5, may_end_s: 0.0 }]);
        let (once, odd) = (forward(&turns), turns.odd().to_vec());
        turns.set(&senses, 8, &[]);
        assert_ne!(forward(&turns), once, "nothing is unusual any more");
        turns.set_again(8, &odd);
        assert_eq!(forward(&turns), once);
    }

    #[test]
    fn transposing_twice_restores_rows() {
        let rows: Vec<f32> = (0..12).map(|number| number as f32).collect();
        let (mut once, mut twice) = (Vec::new(), Vec::new());
        transposed(&rows, 3, &mut once);
        transposed(&once, 4, &mut twice);
        assert_eq!(once[..5], [0.0, 3.0, 6.0, 9.0, 1.0]);
        assert_eq!(twice, rows);
    }

    #[test]
    fn sums_chosen_entries_with_their_factors() {
        let row: Vec<f32> = (0..20).map(|number| number as f32).collect();
        let places = [1, 4, 7, 10, 19];
        let twice: Vec<f32> = row.iter().map(|number| 2.0 * number).collect();
        assert_eq!(chosen([&row, &twice], &places, &[1.0, 0.5, 2.0, 0.0, 1.0]), [36.0, 72.0]);
    }
}
