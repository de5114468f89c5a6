//! Measures of days taken from logs, held against the same taken from what residents did.

use crate::locating::Home;
use homebody_analysis::measures::{MEASURES, Measures, Ways};
use homebody_placement::simulated::{SimulatedLog, SimulatedLogError};
use homebody_walk::Mesh;
use serde::Serialize;

/// How a measure of a home's log differs from the truth.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Error {
    /// The measure's name.
    pub measure: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// By day on which both are known: what the log says, and what was so.
    #[serde(skip)]
    pub pairs: Vec<(f64, f64)>,
    /// On how many days both are known.
    pub days: usize,
    /// The mean of the truth.
    pub mean_true: f64,
    /// The mean of what the log says, less that of the truth.
    pub bias: f64,
    /// The mean of how far the two are apart.
    pub mean_error: f64,
    /// On nine days of ten they are no farther apart.
    pub p90_error: f64,
    /// How well the log follows the truth from day to day: Pearson's correlation; `None` where either never changes.
    pub correlation: Option<f64>,
}

impl Error {
    /// Of pairs of what a log says and what was so; `None` without any.
    pub fn of(measure: &'static str, unit: &'static str, pairs: Vec<(f64, f64)>) -> Option<Error> {
        let count = pairs.len() as f64;
        let mean = |of: &dyn Fn(&(f64, f64)) -> f64| pairs.iter().map(of).sum::<f64>() / count;
        let mut apart: Vec<f64> = pairs.iter().map(|(heard, lived)| (heard - lived).abs()).collect();
        apart.sort_by(f64::total_cmp);
        let p90_error = *apart.get(((count - 1.0) * 0.9).max(0.0).round() as usize)?;
        let (mean_heard, mean_true) = (mean(&|pair| pair.0), mean(&|pair| pair.1));
        let together = mean(&|pair| (pair.0 - mean_heard) * (pair.1 - mean_true));
        let spread = [mean(&|pair| (pair.0 - mean_heard).powi(2)), mean(&|pair| (pair.1 - mean_true).powi(2))];
        let spread = spread[0].sqrt() * spread[1].sqrt();
        Some(Error {
            measure,
            unit,
            days: pairs.len(),
            mean_true,
            bias: mean_heard - mean_true,
            mean_error: apart.iter().sum::<f64>() / count,
            p90_error,
            correlation: (spread > 1e-12).then(|| together / spread),
            pairs,
        })
    }

    /// All days of several homes together.
    pub fn all<'a>(of_homes: impl Iterator<Item = &'a Error> + Clone) -> Vec<Error> {
        let of_measure = |measure: &homebody_analysis::measures::DailyMeasure| {
            let same = of_homes.clone().filter(|error| error.measure == measure.name);
            Error::of(measure.name, measure.unit.name, same.flat_map(|error| error.pairs.iter().copied()).collect())
        };
        MEASURES.iter().filter_map(of_measure).collect()
    }
}

/// Simulates a home of one resident for so many days, and compares the measures of its log with the true ones.
///
/// # Errors
///
/// If the simulation fails, or no sensor detects motion.
pub fn case(home: &Home, seed: u64, days: u32) -> Result<Vec<Error>, SimulatedLogError> {
    let log = SimulatedLog::simulate(home.scenario, home.drivers, seed, days)?.with_ways(ways(home));
    Ok(beside(&log.measures()?, &log.true_measures()))
}

/// Measures of a log beside those that are taken for true, on the days that both know.
pub fn beside(heard: &Measures, lived: &Measures) -> Vec<Error> {
    let errors = MEASURES.iter().enumerate().filter_map(|(number, measure)| {
        let pairs = heard.days.iter().filter_map(|day| {
            let lived = lived.days.iter().find(|lived| lived.date == day.date)?;
            day.values[number].zip(lived.values[number])
        });
        Error::of(measure.name, measure.unit.name, pairs.collect())
    });
    errors.collect()
}

/// The distances between the sensors of a home, as its first resident walks.
fn ways(home: &Home) -> Option<Ways> {
    let scenario = home.scenario;
    let resident = scenario.residents.first()?;
    let mesh = Mesh::with_numbers(scenario.home.plan(), resident.file.radius_m, scenario.home.numbers());
    Some(Ways::from_home(&scenario.home, &|from, to| mesh.path(from, to), &|_| Vec::new()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_told_beside_the_truth() {
        let error = Error::of("meals", "times", vec![(3.0, 3.0), (4.0, 3.0), (1.0, 2.0), (5.0, 4.0)]).unwrap();
        assert_eq!((error.days, error.mean_true, error.bias, error.mean_error), (4, 3.0, 0.25, 0.75));
        assert!((error.p90_error - 1.0).abs() < 1e-9 && error.correlation.unwrap() > 0.9);
        assert_eq!(Error::of("meals", "times", Vec::new()), None);
        assert_eq!(Error::of("meals", "times", vec![(1.0, 2.0); 3]).unwrap().correlation, None);
    }
}
