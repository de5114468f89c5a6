//! The quality of news about changes: how many people with a condition are found and when, and the rate of false news.

mod baselines;
mod fit;
pub mod people;
pub mod protocol;

use homebody_placement::adequacy::{Adequacy, Z, mean};

pub use baselines::{fit as fit_baselines, methods};
pub use fit::{BEARABLE_PER_WEEK, fit as fit_patterns};

/// Mean number of days by which another layout finds the same people later, with the interval of 95 %.
pub fn later(than: &Adequacy, by: &Adequacy) -> (f64, [f64; 2]) {
    let apart: Vec<f64> = by.by_person.iter().zip(&than.by_person).map(|(by, than)| by - than).collect();
    let middle = mean(&apart);
    let squares: Vec<f64> = apart.iter().map(|apart| (apart - middle) * (apart - middle)).collect();
    let error = Z * (mean(&squares) / apart.len().max(1) as f64).sqrt();
    (middle, [middle - error, middle + error])
}

/// The interval of 95 % of a share (Wilson 1927).
pub(crate) fn wilson(found: usize, of: usize) -> [f64; 2] {
    let (count, share) = (of as f64, found as f64 / of as f64);
    let whole = 1.0 + Z * Z / count;
    let middle = (share + Z * Z / (2.0 * count)) / whole;
    let apart = Z * (share * (1.0 - share) / count + Z * Z / (4.0 * count * count)).sqrt() / whole;
    [(middle - apart).max(0.0), (middle + apart).min(1.0)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_placement::adequacy::adequacy;

    #[test]
    fn a_layout_is_later_by_the_mean_difference_of_its_people() {
        let never = adequacy(&[]);
        let [soon, late] = [4.0, 28.0].map(|days| Adequacy { by_person: vec![days], ..never.clone() });
        assert_eq!(later(&soon, &late), (24.0, [24.0, 24.0]));
    }

    #[test]
    fn an_interval_of_a_share_is_wilsons() {
        let [low, high] = wilson(8, 10);
        assert!((low - 0.490).abs() < 1e-3 && (high - 0.943).abs() < 1e-3, "{low} {high}");
    }
}
