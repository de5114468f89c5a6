//! Bounds that follow from a statement and the number of days.
//!
//! The count of days of a habit is a sum of independent draws, so its bounds are exact quantiles. A mean has bounds from the deviation of
//! the single values. Both have the same rate of false alarms.

use homebody_core::fuzzy::Fuzzy;

/// Probability that a true statement is outside the bounds of one measure by chance (our choice).
pub const FALSE_ALARMS: f64 = 1e-4;

/// Deviation of a mean from its expected value, in standard errors, that is as rare as [`FALSE_ALARMS`].
const ERRORS: f64 = 3.89;

/// Share of the occasions that may be left out (our choice): as one in twenty, which the report of differences allows.
pub const LEFT_OUT: f64 = 0.05;

/// Share of the occasions that may miss their time, length or place (our choice): as one in ten, which that report allows.
pub const OFF: f64 = 0.1;

/// Number of cases below which none may be missed (our choice).
const SOME: f64 = 5.0;

/// The least and the greatest number of days of independent draws with these probabilities. Some may be left out.
pub fn count_bounds(chances: &[f64]) -> (usize, usize) {
    let mut shares = vec![1.0];
    for chance in chances {
        shares.push(0.0);
        for count in (0..shares.len()).rev() {
            let more = if count > 0 { shares[count - 1] * chance } else { 0.0 };
            shares[count] = shares[count] * (1.0 - chance) + more;
        }
    }
    let beyond = |shares: &[f64]| {
        let mut sum = 0.0;
        let is_likely = |share: &f64| {
            sum += share;
            sum > FALSE_ALARMS / 2.0
        };
        shares.iter().position(is_likely).unwrap_or(0)
    };
    let low = beyond(&shares);
    shares.reverse();
    let high = shares.len() - 1 - beyond(&shares);
    (low - allowed(chances.iter().sum(), LEFT_OUT).min(low), high)
}

/// The number of cases that may be missed of so many.
pub fn allowed(many: f64, share: f64) -> usize {
    let missed = (many * share + 1e-9).floor();
    (if many >= SOME { missed.max(1.0) } else { missed }) as usize
}

/// Whether enough of the cases are as stated.
pub fn most(right: usize, many: usize) -> bool {
    many - right <= allowed(many as f64, OFF)
}

/// The deviation of a mean of so many values by chance.
pub fn mean_error(sd: f64, many: usize) -> f64 {
    ERRORS * sd / (many.max(1) as f64).sqrt()
}

/// The standard deviation of draws.
pub fn deviation(fuzzy: &Fuzzy) -> f64 {
    const PARTS: u32 = 200;
    let values: Vec<f64> = (0..PARTS).map(|part| fuzzy.at((f64::from(part) + 0.5) / f64::from(PARTS))).collect();
    spread(&values)
}

pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

pub fn spread(values: &[f64]) -> f64 {
    let mean = mean(values);
    (values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / values.len().max(1) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_outside_the_bounds_are_as_rare_as_stated() {
        // One of twenty certain days may be left out, and none comes more often.
        assert_eq!(count_bounds(&[1.0; 20]), (19, 20));
        assert_eq!(count_bounds(&[1.0; 4]), (4, 4));
        assert_eq!(count_bounds(&[0.0; 20]), (0, 0));
        let (low, high) = count_bounds(&[0.5; 60]);
        let binomial = |count: usize| {
            let ways: f64 = (1..=count).map(|k| ((60 - k + 1) as f64 / k as f64).ln()).sum();
            (ways - 60.0 * 2f64.ln()).exp()
        };
        let above: f64 = (high + 1..=60).map(binomial).sum();
        let with_one_less: f64 = (high..=60).map(binomial).sum();
        assert!(above <= FALSE_ALARMS / 2.0 && with_one_less > FALSE_ALARMS / 2.0, "{low} to {high}: {above}");
        let below: f64 = (0..low + allowed(30.0, LEFT_OUT)).map(binomial).sum();
        assert!(below <= FALSE_ALARMS / 2.0, "{below}");
    }

    #[test]
    fn most_allows_one_in_ten() {
        assert!(most(9, 10) && !most(8, 10) && !most(3, 4) && most(4, 4));
        assert!((deviation(&Fuzzy::between(0.0, 12.0)) - 12f64.sqrt()).abs() < 0.01);
    }
}
