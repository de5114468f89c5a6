//! Probabilities of the states of two bodies at one instant, and the choice of the states that are tracked.

pub(crate) const OUT: u32 = 0;

#[derive(Debug, Default, PartialEq)]
pub(crate) struct Belief {
    /// By body, the tracked states, ascending.
    pub states: [Vec<u32>; 2],
    /// Probabilities of pairs of states, row by row: a row for each state of the first body.
    pub chances: Vec<f32>,
}

impl Clone for Belief {
    fn clone(&self) -> Belief {
        Belief { states: self.states.clone(), chances: self.chances.clone() }
    }

    fn clone_from(&mut self, other: &Belief) {
        self.take_states(other);
        self.chances.clone_from(&other.chances);
    }
}

impl Belief {
    pub fn take_states(&mut self, other: &Belief) {
        self.states.iter_mut().zip(&other.states).for_each(|(own, other)| own.clone_from(other));
    }

    pub fn marginal(&self, body: usize) -> Vec<f32> {
        let mut sums = Vec::new();
        self.marginal_into(body, &mut sums);
        sums
    }

    pub fn marginal_into(&self, body: usize, sums: &mut Vec<f32>) {
        let columns = self.states[1].len().max(1);
        sums.clear();
        if body == 0 {
            sums.extend(self.chances.chunks_exact(columns).map(|row| row.iter().sum::<f32>()));
            return;
        }
        sums.resize(self.states[1].len(), 0.0);
        for row in self.chances.chunks_exact(columns) {
            sums.iter_mut().zip(row).for_each(|(sum, chance)| *sum += chance);
        }
    }

    pub fn out(&self, body: usize) -> f32 {
        let of = |(chance, state): (f32, &u32)| if *state == OUT { chance } else { 0.0 };
        self.marginal(body).into_iter().zip(&self.states[body]).map(of).sum()
    }

    /// Scales the probabilities to a sum of 1, and returns the logarithm of the sum before.
    pub fn normalise(&mut self) -> f64 {
        let sum = sum(&self.chances);
        if sum > 0.0 && sum.is_finite() {
            let part = 1.0 / sum;
            if part.is_finite() {
                self.chances.iter_mut().for_each(|chance| *chance *= part);
            } else {
                self.chances.iter_mut().for_each(|chance| *chance /= sum);
            }
            return libm::log(f64::from(sum));
        }
        // No state fits, so all become equally likely.
        let even = 1.0 / self.chances.len().max(1) as f32;
        self.chances.fill(even);
        libm::log(f64::from(f32::MIN_POSITIVE))
    }
}

/// Numbers that are added and compared side by side, so that the processor uses vector instructions.
const PARTS: usize = 8;

fn sum(all: &[f32]) -> f32 {
    let mut sums = [0.0; PARTS];
    let parts = all.chunks_exact(PARTS);
    let rest: f32 = parts.remainder().iter().sum();
    parts.for_each(|part| sums.iter_mut().zip(part).for_each(|(sum, one)| *sum += one));
    rest + sums.iter().sum::<f32>()
}

fn largest(all: &[f32], others: &[f32], of: impl Fn(f32, f32) -> f32) -> f32 {
    let larger = |most: f32, one: f32| if one > most { one } else { most };
    let mut most = [0.0; PARTS];
    let (all, others) = (all.chunks_exact(PARTS), others.chunks_exact(PARTS));
    let rest = all.remainder().iter().zip(others.remainder()).fold(0.0, |most, (&a, &b)| larger(most, of(a, b)));
    for (all, others) in all.zip(others) {
        for ((most, &a), &b) in most.iter_mut().zip(all).zip(others) {
            *most = larger(*most, of(a, b));
        }
    }
    most.into_iter().fold(rest, larger)
}

/// The tracked states: those above a share of the best probability, and at most a number of them. It includes the states
/// that count after a message with these rates.
pub(crate) fn likely(chances: &[f32], (most, part): (usize, f32), said: Option<(&[f32], f32)>, likely: &mut Vec<u32>) {
    likely.clear();
    let all = || (0..).zip(chances);
    let least = largest(chances, chances, |chance, _| chance) * part;
    let counts = all().filter(|(_, chance)| **chance > least).map(|(state, _)| state);
    match said {
        None => {
            likely.extend(counts);
            best(likely, most, |state| chances[state as usize]);
        }
        Some((rates, of_nothing)) => {
            let then = |state: u32| chances[state as usize] * (rates[state as usize] + of_nothing);
            let all_then = || chances.iter().zip(rates).map(|(chance, rate)| chance * (rate + of_nothing));
            let least_then = largest(chances, rates, |chance, rate| chance * (rate + of_nothing)) * part;
            let counts_then = |(_, then): &(u32, f32)| *then > least_then;
            let too_many = |count: usize| count > most;
            let may_be = too_many(chances.len());
            if may_be
                && (too_many(counts.clone().count()) || too_many((0..).zip(all_then()).filter(counts_then).count()))
            {
                let mut before: Vec<u32> = counts.collect();
                best(&mut before, most, |state| chances[state as usize]);
                likely.extend((0..).zip(all_then()).filter(counts_then).map(|(state, _)| state));
                best(likely, most, then);
                likely.extend(before);
                likely.sort_unstable();
                likely.dedup();
            } else {
                let either = all().zip(all_then()).filter(|((_, now), then)| **now > least || *then > least_then);
                likely.extend(either.map(|((state, _), _)| state));
            }
        }
    }
    if likely.is_empty() {
        // No state fits, so all are tracked.
        likely.extend(0..chances.len() as u32);
    }
}

fn best(states: &mut Vec<u32>, most: usize, chance: impl Fn(u32) -> f32) {
    if states.len() > most {
        states.select_nth_unstable_by(most, |&a, &b| chance(b).total_cmp(&chance(a)));
        states.truncate(most);
        states.sort_unstable();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kept(chances: &[f32], limits: (usize, f32), said: Option<(&[f32], f32)>) -> Vec<u32> {
        let mut states = Vec::new();
        likely(chances, limits, said, &mut states);
        states
    }

    #[test]
    fn tracks_likely_states_and_those_of_the_next_message() {
        let chances = [0.5, 1e-7, 0.4, 1e-9, 0.1];
        assert_eq!(kept(&chances, (9, 1e-4), None), [0, 2, 4]);
        assert_eq!(kept(&chances, (2, 1e-4), None), [0, 2]);
        let rates = [1e-6, 1.0, 1e-6, 1e-6, 1e-6];
        assert_eq!(kept(&chances, (9, 1e-4), Some((&rates, 1e-6))), [0, 1, 2, 4]);
        assert_eq!(kept(&chances, (2, 1e-4), Some((&rates, 1e-6))), [0, 2]);
        assert_eq!(kept(&[0.0; 3], (2, 1e-4), None), [0, 1, 2]);
    }

    #[test]
    fn marginal_sums_over_the_other_body() {
        let mut belief = Belief { states: [vec![0, 3], vec![1, 2, 5]], chances: vec![1.0, 2.0, 3.0, 4.0, 5.0, 5.0] };
        assert!((belief.normalise() - libm::log(20.0)).abs() < 1e-6);
        let near = |a: &[f32], b: &[f32]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6);
        assert!(near(&belief.marginal(0), &[0.3, 0.7]) && near(&belief.marginal(1), &[0.25, 0.35, 0.4]));
        assert!((belief.out(0) - 0.3).abs() < 1e-6);
        belief.chances.fill(0.0);
        belief.normalise();
        assert!(near(&belief.chances, &[1.0 / 6.0; 6]));
    }
}
