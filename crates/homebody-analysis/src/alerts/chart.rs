//! Control charts: what is taken from day to day, and leaves its limits once something has changed.

use super::rule::{Rule, When};
use super::{Alert, Usual, alert, differs, usual_of};
use crate::measures::{Day, Measure};

/// After so many days of alarm in a row a control chart begins anew (published for times of transfer out of bed).
const ANEW_AFTER: usize = 3;
/// What was told is not told again for so many days (ours).
const TOLD_AGAIN: usize = 7;

/// A chart that has begun.
pub trait Chart {
    /// Takes a day: what it comes to by now, and the days that show it, where that is beyond the limits.
    fn take(&mut self, rule: &Rule, day: usize, value: f64) -> Option<(f64, Vec<usize>)>;
}

/// An exponentially weighted moving average.
pub struct Average {
    usual: Usual,
    average: f64,
    count: i32,
    alarms: Vec<usize>,
}

impl Average {
    /// As it begins.
    pub fn new(usual: Usual) -> Average {
        Average { usual, average: usual.mean, count: 0, alarms: Vec::new() }
    }
}

impl Chart for Average {
    fn take(&mut self, rule: &Rule, day: usize, value: f64) -> Option<(f64, Vec<usize>)> {
        self.count += 1;
        self.average += rule.smoothing * (value - self.average);
        let weights = rule.smoothing / (2.0 - rule.smoothing) * (1.0 - (1.0 - rule.smoothing).powi(2 * self.count));
        if differs(rule, self.average, self.usual.mean, self.usual.sd * weights.sqrt()) <= rule.k_sd {
            self.alarms.clear();
            return None;
        }
        self.alarms.push(day);
        Some((self.average, self.alarms.clone()))
    }
}

/// Cumulative sums of what is more than usual and of what is less, in standard deviations. A sum that is 0 begins anew, so that
/// its days are those since the change.
pub struct Sums {
    usual: Usual,
    more: Sum,
    less: Sum,
}

/// One of the sums, with the days since it was 0 and what they came to.
#[derive(Default)]
struct Sum {
    sum: f64,
    days: Vec<usize>,
    values: f64,
}

impl Sum {
    fn add(&mut self, by: f64, day: usize, value: f64) {
        self.sum += by;
        if self.sum <= 0.0 {
            *self = Sum::default();
            return;
        }
        self.days.push(day);
        self.values += value;
    }
}

impl Sums {
    /// As they begin.
    pub fn new(usual: Usual) -> Sums {
        Sums { usual, more: Sum::default(), less: Sum::default() }
    }
}

impl Chart for Sums {
    fn take(&mut self, rule: &Rule, day: usize, value: f64) -> Option<(f64, Vec<usize>)> {
        let by = (value - self.usual.mean) / self.usual.sd;
        self.more.add(by - rule.slack_sd, day, value);
        self.less.add(-by - rule.slack_sd, day, value);
        let counting: &[&Sum] = match rule.when {
            When::More => &[&self.more],
            When::Less => &[&self.less],
            When::Either => &[&self.more, &self.less],
        };
        let sum = counting.iter().find(|sum| sum.sum > rule.k_sd)?;
        Some((sum.values / sum.days.len() as f64, sum.days.clone()))
    }
}

/// Days on which a chart leaves its limits.
pub fn by_chart<C: Chart>(
    rule: &Rule,
    measure: &'static Measure,
    values: &[Option<f64>],
    days: &[Day],
    begin: impl Fn(Usual) -> C,
) -> Vec<Alert> {
    let mut alerts = Vec::new();
    // The chart, what was usual as it began, and for how many days in a row it has been beyond its limits.
    let mut chart: Option<(C, Usual, usize)> = None;
    let mut begins = 0;
    let mut told: Option<usize> = None;
    for (day, value) in values.iter().enumerate() {
        let Some(value) = *value else { continue };
        let Some((taken, usual, alarms)) = &mut chart else {
            let known = values[begins..day].iter().flatten().count();
            if known >= rule.baseline_days.min(rule.min_days * 2) {
                chart = usual_of(rule, &values[begins..day]).map(|usual| (begin(usual), usual, 0));
            }
            continue;
        };
        let Some((level, shown)) = taken.take(rule, day, value) else {
            *alarms = 0;
            continue;
        };
        *alarms += 1;
        if *alarms == 1 && told.replace(day).is_none_or(|told| day - told > TOLD_AGAIN) {
            alerts.push(alert(rule, measure, (level, *usual), &shown, days));
        }
        if *alarms == ANEW_AFTER {
            (chart, begins) = (None, day + 1);
        }
    }
    alerts
}
