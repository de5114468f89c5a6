use crate::locating::SimulatedHome;
use homebody_analysis::measures::{MEASURES, Measures, Ways};
use homebody_core::sensors::kinds::SensorFile;
use homebody_placement::simulated::{SimulatedLog, SimulatedLogError};
use homebody_walk::Mesh;
use serde::Serialize;

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MeasureError {
    pub measure: &'static str,
    pub unit: &'static str,
    /// For each day with both values: the value from the log, and the true value.
    #[serde(skip)]
    pub pairs: Vec<(f64, f64)>,
    pub days: usize,
    pub mean_true: f64,
    /// The mean of the values from the log, less that of the true values.
    pub bias: f64,
    /// The mean absolute error.
    pub mean_error: f64,
    /// The largest error on nine of ten days.
    pub p90_error: f64,
    /// Pearson's correlation of the daily values; `None` if either is constant.
    pub correlation: Option<f64>,
}

impl MeasureError {
    /// The error of pairs of a value from the log and a true value; `None` without pairs.
    pub fn from_pairs(measure: &'static str, unit: &'static str, pairs: Vec<(f64, f64)>) -> Option<MeasureError> {
        let count = pairs.len() as f64;
        let mean = |of: &dyn Fn(&(f64, f64)) -> f64| pairs.iter().map(of).sum::<f64>() / count;
        let mut apart: Vec<f64> = pairs.iter().map(|(heard, lived)| (heard - lived).abs()).collect();
        apart.sort_by(f64::total_cmp);
        let p90_error = *apart.get(((count - 1.0) * 0.9).max(0.0).round() as usize)?;
        let (mean_heard, mean_true) = (mean(&|pair| pair.0), mean(&|pair| pair.1));
        let together = mean(&|pair| (pair.0 - mean_heard) * (pair.1 - mean_true));
        let spread = [mean(&|pair| (pair.0 - mean_heard).powi(2)), mean(&|pair| (pair.1 - mean_true).powi(2))];
        let spread = spread[0].sqrt() * spread[1].sqrt();
        Some(MeasureError {
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

    pub fn over_homes<'a>(of_homes: impl Iterator<Item = &'a MeasureError> + Clone) -> Vec<MeasureError> {
        let of_measure = |measure: &homebody_analysis::measures::DailyMeasure| {
            let same = of_homes.clone().filter(|error| error.measure == measure.name);
            MeasureError::from_pairs(
                measure.name,
                measure.unit.name,
                same.flat_map(|error| error.pairs.iter().copied()).collect(),
            )
        };
        MEASURES.iter().filter_map(of_measure).collect()
    }
}

/// The errors of a log, by all sensors of the home and without those in beds.
pub struct MeasuresCase {
    pub all: Vec<MeasureError>,
    pub without_bed: Vec<MeasureError>,
}

/// Simulates a home of one resident for so many days, and compares the measures of its log with the true ones.
pub fn case(home: &SimulatedHome, seed: u64, days: u32) -> Result<MeasuresCase, SimulatedLogError> {
    let log = SimulatedLog::simulate(home.scenario, home.drivers, seed, days)?.with_ways(ways(home));
    let lived = log.true_measures();
    let all = errors_between(&log.measures()?, &lived);
    let beds: Vec<&str> = beds(home).collect();
    let without_bed = match beds.is_empty() {
        true => all.clone(),
        false => errors_between(&log.measures_by(&|sensor| !beds.contains(&sensor))?, &lived),
    };
    Ok(MeasuresCase { all, without_bed })
}

/// The names of the sensors in beds.
fn beds<'a>(home: &'a SimulatedHome) -> impl Iterator<Item = &'a str> {
    let sensors = home.scenario.home.sensors.iter();
    sensors.filter(|sensor| matches!(sensor, SensorFile::Bed(_))).map(SensorFile::name)
}

pub fn errors_between(heard: &Measures, lived: &Measures) -> Vec<MeasureError> {
    let errors = MEASURES.iter().enumerate().filter_map(|(number, measure)| {
        let pairs = heard.days.iter().filter_map(|day| {
            let lived = lived.days.iter().find(|lived| lived.date == day.date)?;
            day.values[number].zip(lived.values[number])
        });
        MeasureError::from_pairs(measure.name, measure.unit.name, pairs.collect())
    });
    errors.collect()
}

fn ways(home: &SimulatedHome) -> Option<Ways> {
    let scenario = home.scenario;
    let resident = scenario.residents.first()?;
    let mesh = Mesh::with_numbers(scenario.home.plan(), resident.file.radius_m, scenario.home.numbers());
    Some(Ways::from_home(&scenario.home, &|from, to| mesh.path(from, to), &|_| Vec::new()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_compare_the_log_with_the_truth() {
        let error =
            MeasureError::from_pairs("meals", "times", vec![(3.0, 3.0), (4.0, 3.0), (1.0, 2.0), (5.0, 4.0)]).unwrap();
        assert_eq!((error.days, error.mean_true, error.bias, error.mean_error), (4, 3.0, 0.25, 0.75));
        assert!((error.p90_error - 1.0).abs() < 1e-9 && error.correlation.unwrap() > 0.9);
        assert_eq!(MeasureError::from_pairs("meals", "times", Vec::new()), None);
        assert_eq!(MeasureError::from_pairs("meals", "times", vec![(1.0, 2.0); 3]).unwrap().correlation, None);
    }
}
