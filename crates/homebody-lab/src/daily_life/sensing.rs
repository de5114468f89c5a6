//! The motion sensors of a simulated person, as logs with ON and OFF have them.

use super::record::PersonRecord;
use homebody_core::ids::SensorId;
use homebody_core::statistics::{lag_1_autocorrelation, mean, quantile, sd};
use homebody_core::time::{Interval, RunTime};
use serde::Serialize;

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SensingFigures {
    /// ONs per day: their mean, their spread between days, and the correlation with the day before.
    pub ons: f64,
    pub ons_sd: Option<f64>,
    pub ons_next_day: Option<f64>,
    /// Seconds between two ONs of any sensors: the quantiles of 50, 90, 95 and 99 %.
    pub gaps_s: [Option<f64>; 4],
    /// The share of gaps over an hour.
    pub gaps_over_an_hour: Option<f64>,
    /// Seconds of an ON: the quantiles of 5, 50 and 95 %.
    pub on_s: [Option<f64>; 3],
    /// Seconds from ON to ON of one sensor during a movement: the quantiles of 5, 25 and 50 %.
    pub again_s: [Option<f64>; 3],
    /// The shares of one, two, and more sensors in the time with any sensor ON.
    pub at_once: Option<[f64; 3]>,
}

/// Time within which a sensor that is ON again continues a movement (our choice).
const GOES_ON_S: f64 = 30.0;

impl SensingFigures {
    pub fn measure(lived: &PersonRecord) -> SensingFigures {
        let ons = lived.ons();
        let mut days = vec![0.0; lived.days.len()];
        let mut last = vec![None; lived.is_motion.len()];
        let mut again = Vec::new();
        for &(sensor, on) in &ons {
            if let Some(day) = days.get_mut(lived.clock(on.begin).0) {
                *day += 1.0;
            }
            if let Some(before) = last[sensor.index()].replace(on.begin) {
                again.push((on.begin - before).seconds());
            }
        }
        again.retain(|&wait| wait <= GOES_ON_S);
        let gaps: Vec<f64> = ons.windows(2).map(|pair| (pair[1].1.begin - pair[0].1.begin).seconds()).collect();
        let lasting: Vec<f64> = ons.iter().map(|(_, on)| on.length().seconds()).collect();
        let over_an_hour = gaps.iter().filter(|&&gap| gap > 3600.0).count();
        SensingFigures {
            ons: mean(&days).unwrap_or(0.0),
            ons_sd: sd(&days),
            ons_next_day: lag_1_autocorrelation(&days),
            gaps_s: [0.5, 0.9, 0.95, 0.99].map(|share| quantile(&gaps, share)),
            gaps_over_an_hour: (!gaps.is_empty()).then(|| over_an_hour as f64 / gaps.len() as f64),
            on_s: [0.05, 0.5, 0.95].map(|share| quantile(&lasting, share)),
            again_s: [0.05, 0.25, 0.5].map(|share| quantile(&again, share)),
            at_once: at_once(&ons),
        }
    }
}

fn at_once(ons: &[(SensorId, Interval<RunTime>)]) -> Option<[f64; 3]> {
    let mut changes: Vec<(RunTime, i32)> = ons.iter().flat_map(|(_, on)| [(on.begin, 1), (on.end, -1)]).collect();
    changes.sort_unstable();
    let (mut spans, mut now) = ([0.0; 3], 0);
    for pair in changes.windows(2) {
        now += pair[0].1;
        if now > 0 {
            spans[(now as usize).min(3) - 1] += (pair[1].0 - pair[0].0).seconds();
        }
    }
    let whole: f64 = spans.iter().sum();
    (whole > 0.0).then(|| spans.map(|span| span / whole))
}
