//! Intervals of 95 % for counts, and for medians.

use crate::alerting::wilson;

/// Probability beyond each end of an interval.
const TAIL: f64 = 0.025;

/// A count of rare events in some days; the days differ between kinds of event.
#[derive(Clone, Copy, Debug)]
pub(super) struct EventCount {
    pub events: u32,
    pub days: f64,
}

/// The exact interval of the mean of a Poisson distribution, from a count (Garwood 1936).
pub(super) fn poisson_exact(count: u32) -> [f64; 2] {
    let lower = if count == 0 { 0.0 } else { mean_where(|mean| 1.0 - at_most(count - 1, mean), TAIL) };
    [lower, mean_where(|mean| 1.0 - at_most(count, mean), 1.0 - TAIL)]
}

/// Events a day of all kinds, and the interval: that of the sum of all counts, scaled to the standard deviation of the weighted sum
/// (Dobson et al. 1991). Without events, the upper limit is that of the kind with the fewest days.
pub(super) fn per_day(counted: &[EventCount]) -> (f64, [f64; 2]) {
    let count: u32 = counted.iter().map(|one| one.events).sum();
    let [lower, upper] = poisson_exact(count);
    let rate: f64 = counted.iter().map(|one| f64::from(one.events) / one.days).sum();
    if count == 0 {
        let fewest = counted.iter().map(|one| one.days).fold(f64::INFINITY, f64::min);
        return (0.0, [0.0, upper / fewest]);
    }
    let variance: f64 = counted.iter().map(|one| f64::from(one.events) / (one.days * one.days)).sum();
    let scale = (variance / f64::from(count)).sqrt();
    let apart = |limit: f64| (rate + scale * (limit - f64::from(count))).max(0.0);
    (rate, [apart(lower), apart(upper)])
}

pub(super) fn share(found: u32, of: u32) -> (f64, [f64; 2]) {
    (f64::from(found) / f64::from(of), wilson(found as usize, of as usize))
}

/// The median and its interval by ranks, which assumes no distribution; `None` without numbers.
pub(super) fn median(mut numbers: Vec<f64>) -> Option<(f64, [f64; 2])> {
    numbers.sort_by(f64::total_cmp);
    let count = numbers.len();
    let middle = homebody_core::statistics::quantile(&numbers, 0.5)?;
    // The number of values below the median has a binomial distribution.
    let mut chance = 0.5f64.powi(count as i32);
    let (mut below, mut sum) = (0, chance);
    while sum <= TAIL {
        below += 1;
        chance *= (count + 1 - below) as f64 / below as f64;
        sum += chance;
    }
    Some((middle, [numbers[below.saturating_sub(1)], numbers[(count - below).min(count - 1)]]))
}

fn at_most(count: u32, mean: f64) -> f64 {
    let mut chance = (-mean).exp();
    let mut sum = chance;
    for number in 1..=count {
        chance *= mean / f64::from(number);
        sum += chance;
    }
    sum
}

/// The mean at which an increasing probability has this value.
fn mean_where(chance: impl Fn(f64) -> f64, is: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    while chance(high) < is {
        high *= 2.0;
    }
    for _ in 0..80 {
        let middle = (low + high) / 2.0;
        if chance(middle) < is { low = middle } else { high = middle }
    }
    (low + high) / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_near(found: [f64; 2], published: [f64; 2]) {
        assert!(found.iter().zip(published).all(|(found, published)| (found - published).abs() < 0.006), "{found:?}");
    }

    #[test]
    fn counts_have_the_limits_of_printed_tables() {
        is_near(poisson_exact(0), [0.0, 3.69]);
        is_near(poisson_exact(1), [0.025, 5.57]);
        is_near(poisson_exact(10), [4.80, 18.39]);
        is_near(poisson_exact(100), [81.36, 121.63]);
    }

    #[test]
    fn a_single_kind_has_the_limits_of_its_count() {
        let (rate, interval) = per_day(&[EventCount { events: 10, days: 20.0 }]);
        assert_eq!(rate, 0.5);
        is_near(interval, [0.24, 0.92]);
        assert_eq!(per_day(&[EventCount { events: 0, days: 2.0 }, EventCount { events: 0, days: 9.0 }]).0, 0.0);
        is_near(per_day(&[EventCount { events: 0, days: 2.0 }]).1, [0.0, 1.844]);
    }

    #[test]
    fn a_median_lies_between_its_ranks() {
        // Of ten numbers, the second and the ninth.
        let numbers = (1..=10).map(f64::from).collect();
        assert_eq!(median(numbers), Some((5.5, [2.0, 9.0])));
        assert_eq!(median(vec![3.0]), Some((3.0, [3.0, 3.0])));
        assert_eq!(median(vec![]), None);
    }
}
