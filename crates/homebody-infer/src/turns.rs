//! How one body gets from state to state in a span, in which some sensors are deaf.

use crate::exponential::exp;
use crate::learn::{SILENCE, Senses};
use crate::said::Said;
use crate::steps::Unusual;

/// An exponent that makes no difference (ours).
const NOTHING: f32 = 1e-3;
/// A turn that is rarer than this part of the most frequent one from its state is none (ours). So little of what is thought is
/// lost in a step: this part of it for each state that counts.
const RARE: f32 = 1e-6;

/// How one body gets from state to state in a span. It is set for each step anew, and keeps its memory.
#[derive(Clone, Debug)]
pub(crate) struct Turns {
    span: usize,
    /// By state: by how much less is said there in the span than if all could be.
    unsaid: Vec<f32>,
    /// By state: what that makes of the chance of those who come or go within the span.
    passing: Vec<f32>,
    /// The states of which either is not as usual.
    touched: Vec<u32>,
    /// Chances by state, all nothing between two uses; and those of the states that count, as passing makes them.
    dense: Vec<f32>,
    weighed: Vec<f32>,
}

/// The chances of getting from some states to others: those that are worth it, state by state of the first.
#[derive(Clone, Debug, Default)]
pub(crate) struct Between {
    /// By state of the first: where its turns begin; and the end of all.
    first: Vec<u32>,
    /// Which of the others, and the chance.
    turns: Vec<(u32, f32)>,
}

impl Turns {
    /// Of a body that has so many states.
    pub fn of(states: usize) -> Turns {
        Turns {
            span: 0,
            unsaid: vec![0.0; states],
            passing: vec![1.0; states],
            touched: Vec::new(),
            dense: vec![0.0; states],
            weighed: Vec::new(),
        }
    }

    /// From now on those of this span, in which this is unusual.
    pub fn set(&mut self, senses: &Senses, span: usize, unusual: &[Unusual]) {
        let Turns { unsaid, passing, touched, .. } = self;
        self.span = span;
        for state in touched.drain(..) {
            (unsaid[state as usize], passing[state as usize]) = (0.0, 1.0);
        }
        let mut add = |rates: &[(u32, f32)], seconds: f32| {
            for &(state, rate) in rates {
                let unsaid = &mut unsaid[state as usize];
                if *unsaid == 0.0 {
                    touched.push(state);
                }
                *unsaid += rate * seconds;
            }
        };
        for one in unusual {
            add(senses.heard_of(one.sensor, Said::On), one.deaf_s * SILENCE as f32);
            if one.may_end_s > 0.0 && !senses.timing[one.sensor].feels {
                add(senses.heard_of(one.sensor, Said::Off), -one.may_end_s);
            }
        }
        // Who comes or goes at any time of the span is there for a part of it: the mean of the exponential over all parts.
        for &state in touched.iter() {
            let unsaid = unsaid[state as usize];
            if unsaid.abs() >= NOTHING {
                passing[state as usize] = unsaid / (1.0 - exp(-unsaid));
            }
        }
    }

    /// The chance of staying in a state for the whole span, but for that which its matrix has.
    fn stays(&self, senses: &Senses, state: u32) -> f32 {
        let unsaid = self.unsaid[state as usize];
        if unsaid.abs() < NOTHING {
            return 0.0;
        }
        let (usual, passing) = (senses.flow.stays(self.span, state), self.passing[state as usize]);
        (exp(usual + unsaid) - exp(usual) * passing * passing).max(0.0)
    }

    /// Where a body is afterwards who was in one of several states, each with its chance: by state.
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
        self.touched.iter().for_each(|&state| to[state as usize] *= self.passing[state as usize]);
        for (&state, chance) in states.iter().zip(chances) {
            to[state as usize] += chance * self.stays(senses, state);
        }
    }

    /// How likely all is that comes after the span for who was in one of the states `from`, where `chances` is the same for each
    /// state `to` at its end.
    pub fn back(&mut self, senses: &Senses, chances: &[f32], (to, from): (&[u32], &[u32]), before: &mut Vec<f32>) {
        before.clear();
        self.weighed.clear();
        for (&state, &chance) in to.iter().zip(chances) {
            self.dense[state as usize] = chance;
            self.weighed.push(chance * self.passing[state as usize]);
        }
        for &state in from {
            let row = senses.flow.row(self.span, state);
            let passes = chosen(row, to, &self.weighed);
            let stays = match self.unsaid[state as usize] == 0.0 {
                true => 0.0,
                false => self.dense[state as usize] * self.stays(senses, state),
            };
            before.push(passes * self.passing[state as usize] + stays);
        }
        to.iter().for_each(|&state| self.dense[state as usize] = 0.0);
    }

    /// The chances of getting from some states to others.
    pub fn between(&self, senses: &Senses, from: &[u32], to: &[u32], between: &mut Between) {
        let Between { first, turns } = between;
        first.clear();
        turns.clear();
        for &state in from {
            first.push(turns.len() as u32);
            let (row, passing) = (senses.flow.row(self.span, state), self.passing[state as usize]);
            let chance = |to: u32| row[to as usize] * self.passing[to as usize] * passing;
            let stays = self.stays(senses, state);
            let most = to.iter().map(|&to| chance(to)).fold(0.0, |most, one| if one > most { one } else { most });
            let least = most.max(stays) * RARE;
            for (place, &to) in (0..).zip(to) {
                let chance = if to == state { chance(to) + stays } else { chance(to) };
                if chance > least {
                    turns.push((place, chance));
                }
            }
        }
        first.push(turns.len() as u32);
    }
}

impl Between {
    fn of(&self, from: usize) -> &[(u32, f32)] {
        &self.turns[self.first[from] as usize..self.first[from + 1] as usize]
    }

    /// Of a row of numbers for each state that was, one for each that is.
    pub fn forward(&self, rows: &[f32], [columns, states]: [usize; 2], to: &mut Vec<f32>) {
        to.clear();
        to.resize(columns * states, 0.0);
        for (from, row) in rows.chunks_exact(columns.max(1)).enumerate() {
            for &(state, chance) in self.of(from) {
                add(&mut to[state as usize * columns..][..columns], chance, row);
            }
        }
    }

    /// Of a row of numbers for each state that is, one for each that was.
    pub fn back(&self, rows: &[f32], columns: usize, from: &mut Vec<f32>) {
        from.clear();
        from.resize(columns * (self.first.len() - 1), 0.0);
        for (state, sums) in from.chunks_exact_mut(columns.max(1)).enumerate() {
            for &(to, chance) in self.of(state) {
                add(sums, chance, &rows[to as usize * columns..][..columns]);
            }
        }
    }
}

fn add(sums: &mut [f32], factor: f32, row: &[f32]) {
    sums.iter_mut().zip(row).for_each(|(sum, one)| *sum += factor * one);
}

/// The sum of some numbers of a row, each by its factor: in parts, so that none waits for the one before.
fn chosen(row: &[f32], places: &[u32], factors: &[f32]) -> f32 {
    const PARTS: usize = 4;
    let mut sums = [0.0; PARTS];
    let (places, factors) = (places.chunks_exact(PARTS), factors.chunks_exact(PARTS));
    let rest = places.remainder().iter().zip(factors.remainder()).map(|(&place, factor)| row[place as usize] * factor);
    let rest: f32 = rest.sum();
    for (places, factors) in places.zip(factors) {
        for ((sum, &place), factor) in sums.iter_mut().zip(places).zip(factors) {
            *sum += row[place as usize] * factor;
        }
    }
    rest + (sums[0] + sums[1]) + (sums[2] + sums[3])
}

/// Rows of so many columns, turned over.
pub(crate) fn turned_over(rows: &[f32], columns: usize, over: &mut Vec<f32>) {
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

    /// Turns from three states to four, and rows of two numbers.
    const CHANCES: [[f32; 4]; 3] = [[0.9, 0.1, 0.0, 1e-9], [0.0, 0.5, 0.5, 0.0], [0.2, 0.0, 0.3, 0.4]];

    fn between() -> Between {
        let mut between = Between::default();
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
    fn what_is_worth_it_comes_to_what_all_comes_to() {
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
    fn rows_turned_over_twice_are_as_they_were() {
        let rows: Vec<f32> = (0..12).map(|number| number as f32).collect();
        let (mut once, mut twice) = (Vec::new(), Vec::new());
        turned_over(&rows, 3, &mut once);
        turned_over(&once, 4, &mut twice);
        assert_eq!(once[..5], [0.0, 3.0, 6.0, 9.0, 1.0]);
        assert_eq!(twice, rows);
    }

    #[test]
    fn chosen_numbers_are_added_by_their_factors() {
        let row: Vec<f32> = (0..20).map(|number| number as f32).collect();
        let places = [1, 4, 7, 10, 19];
        assert_eq!(chosen(&row, &places, &[1.0, 0.5, 2.0, 0.0, 1.0]), 1.0 + 2.0 + 14.0 + 19.0);
    }
}
