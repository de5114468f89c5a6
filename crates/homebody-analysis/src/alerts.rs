//! Alerts by rules of the user's own: the measures of a day differ from the days before.
//!
//! A day is compared with the days before, never with other people. It does not count, neither as usual nor as unusual, if it is not whole,
//! if the resident was out for most of it, or if a sensor was silent that the measure needs. The silent sensor has an alert of its own.
//! With too few days that count, there are no usual values and no alerts.
//!
//! Left out: visitors, who are measured as if they were the resident.

mod rule;
mod wording;

use crate::measures::{DailyMeasure, DayMeasures, Measures, SilentSensor};
use crate::phrases::{joined, listed, write_remarks};
use homebody_core::problem::counted;
use homebody_core::statistics::{mean, sd};
use jiff::civil::Date;
use serde::Serialize;
use std::fmt;

pub use rule::{AlertDirection, AlertMethod, AlertRule, AlertRuleMessage, Rules, Several};

#[cfg(test)]
pub(crate) use rule::EXAMPLE;

pub const SENSOR: &str = "sensor";

#[derive(Clone, Debug, Serialize)]
pub struct LogAlerts {
    pub name: String,
    /// The number of days, and of those that count.
    pub days: usize,
    pub days_that_count: usize,
    pub remarks: Vec<String>,
    pub alerts: Vec<Alert>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Alert {
    pub date: Date,
    /// The rule's name; `several` for several measures at once, `sensor` for a sensor that is silent.
    pub rule: String,
    pub measures: Vec<&'static str>,
    /// More than usual, or less; `None` where the alert has no direction.
    pub is_more: Option<bool>,
    /// The measure's value of that day, or its weighted average; `None` where it is not about one measure.
    pub value: Option<f64>,
    /// The mean of the days before.
    pub usual: Option<f64>,
    /// Their standard deviation, as far as the rule lets it be small.
    pub sd: Option<f64>,
    pub shown_by: Vec<Date>,
    /// The same in words, without a full stop.
    pub words: String,
    /// The words without values.
    #[serde(skip)]
    pub headline: String,
    /// The values of the words; empty if these have none.
    #[serde(skip)]
    pub numbers: String,
}

impl Alert {
    /// An alert of a day that is not about one measure.
    fn of_day(date: Date, rule: &str, measures: Vec<&'static str>, shown_by: Vec<Date>, words: String) -> Alert {
        let (is_more, value, usual, sd) = (None, None, None, None);
        let (headline, numbers) = (words.clone(), String::new());
        Alert { date, rule: rule.to_owned(), measures, is_more, value, usual, sd, shown_by, words, headline, numbers }
    }
}

#[derive(Clone, Copy)]
struct Baseline {
    mean: f64,
    sd: f64,
}

pub fn alerts(measures: &Measures, rules: &Rules) -> LogAlerts {
    let counts: Vec<bool> = measures.days.iter().map(DayMeasures::counts).collect();
    let mut alerts: Vec<Alert> = Vec::new();
    for rule in &rules.rules {
        let Some((number, measure)) = rule.measure() else { continue };
        let values: Vec<Option<f64>> =
            measures.days.iter().zip(&counts).map(|(day, counts)| day.values[number].filter(|_| *counts)).collect();
        alerts.extend(match rule.method {
            AlertMethod::Deviation => by_deviation(rule, measure, &values, &measures.days),
            AlertMethod::Ewma => by_chart(rule, measure, &values, &measures.days, Average::new),
            AlertMethod::Cusum => by_chart(rule, measure, &values, &measures.days, CumulativeSums::new),
        });
    }
    if let Some(several) = rules.several {
        alerts.extend(at_once(several, rules, measures, &counts));
    }
    let silent = SilentSensor::sentences(&measures.silent).into_iter();
    alerts.extend(silent.map(|(silent, words)| {
        let words = format!("{words}; check its battery");
        Alert::of_day(silent.told, SENSOR, Vec::new(), vec![silent.since], words)
    }));
    alerts.sort_by(|a, b| (a.date, &a.rule).cmp(&(b.date, &b.rule)));
    let mut remarks = measures.remarks.clone();
    let days_that_count = counts.iter().filter(|counts| **counts).count();
    let least = rules.rules.iter().map(|rule| rule.min_days).min().unwrap_or(0);
    if days_that_count <= least {
        remarks.push(format!(
            "Only {} so far; at least {} are needed to know what is usual",
            counted(days_that_count, "complete day", "complete days"),
            least + 1
        ));
    }
    LogAlerts { name: measures.name.clone(), days: measures.days.len(), days_that_count, remarks, alerts }
}

fn usual(rule: &AlertRule, values: &[Option<f64>], day: usize) -> Option<Baseline> {
    let before = &values[day.saturating_sub(rule.baseline_days)..day];
    Baseline::from_values(before, rule.min_days, rule.least_sd)
}

impl Baseline {
    fn from_values(values: &[Option<f64>], least: usize, least_sd: f64) -> Option<Baseline> {
        let known: Vec<f64> = values.iter().copied().flatten().collect();
        let sd = sd(&known).filter(|_| known.len() >= least)?.max(least_sd);
        Some(Baseline { mean: mean(&known)?, sd }).filter(|_| sd > 0.0)
    }
}

/// By how many standard deviations a value differs in a direction that counts; 0 where it does not.
fn differs(rule: &AlertRule, value: f64, mean: f64, sd: f64) -> f64 {
    let by = (value - mean) / sd;
    match rule.when {
        AlertDirection::More => by.max(0.0),
        AlertDirection::Less => (-by).max(0.0),
        AlertDirection::Either => by.abs(),
    }
}

/// Days in a row that differ from those before the first of them.
fn by_deviation(
    rule: &AlertRule,
    measure: &'static DailyMeasure,
    values: &[Option<f64>],
    days: &[DayMeasures],
) -> Vec<Alert> {
    let mut alerts = Vec::new();
    // The first day of a difference, and the usual values then: they stay, so that a difference does not become usual as it lasts.
    let mut since: Option<(Vec<usize>, Baseline)> = None;
    // A single odd day is not usual either.
    let mut counted = values.to_vec();
    for (day, value) in values.iter().enumerate() {
        let Some(value) = *value else { continue };
        let usual = match &since {
            Some((shown, usual)) if shown.len() < rule.baseline_days => Some(*usual),
            _ => usual(rule, &counted, day),
        };
        let Some(usual) = usual.filter(|usual| differs(rule, value, usual.mean, usual.sd) > rule.k_sd) else {
            let odd = since.take().map(|(shown, _)| shown).filter(|shown| shown.len() < rule.days);
            odd.into_iter().flatten().for_each(|day| counted[day] = None);
            continue;
        };
        let (shown, _) = since.get_or_insert_with(|| (Vec::new(), usual));
        shown.push(day);
        if shown.len() == rule.days {
            alerts.push(alert(rule, measure, (value, usual), shown, days));
        }
    }
    alerts
}

/// After so many days of alarm in a row a control chart begins anew (published for times of transfer out of bed).
const ANEW_AFTER: usize = 3;
/// Days until the same alert is reported again (our choice).
const TOLD_AGAIN: usize = 7;

trait ControlChart {
    /// Takes a day: what it comes to by now, and the days that show it, where that is beyond the limits.
    fn take(&mut self, rule: &AlertRule, day: usize, value: f64) -> Option<(f64, Vec<usize>)>;
}

struct Average {
    usual: Baseline,
    average: f64,
    count: i32,
    alarms: Vec<usize>,
}

impl Average {
    fn new(usual: Baseline) -> Average {
        Average { usual, average: usual.mean, count: 0, alarms: Vec::new() }
    }
}

impl ControlChart for Average {
    fn take(&mut self, rule: &AlertRule, day: usize, value: f64) -> Option<(f64, Vec<usize>)> {
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
struct CumulativeSums {
    usual: Baseline,
    more: CumulativeSum,
    less: CumulativeSum,
}

#[derive(Default)]
struct CumulativeSum {
    sum: f64,
    days: Vec<usize>,
    values: f64,
}

impl CumulativeSum {
    fn add(&mut self, by: f64, day: usize, value: f64) {
        self.sum += by;
        if self.sum <= 0.0 {
            *self = CumulativeSum::default();
            return;
        }
        self.days.push(day);
        self.values += value;
    }
}

impl CumulativeSums {
    fn new(usual: Baseline) -> CumulativeSums {
        CumulativeSums { usual, more: CumulativeSum::default(), less: CumulativeSum::default() }
    }
}

impl ControlChart for CumulativeSums {
    fn take(&mut self, rule: &AlertRule, day: usize, value: f64) -> Option<(f64, Vec<usize>)> {
        let by = (value - self.usual.mean) / self.usual.sd;
        self.more.add(by - rule.slack_sd, day, value);
        self.less.add(-by - rule.slack_sd, day, value);
        let counting: &[&CumulativeSum] = match rule.when {
            AlertDirection::More => &[&self.more],
            AlertDirection::Less => &[&self.less],
            AlertDirection::Either => &[&self.more, &self.less],
        };
        let sum = counting.iter().find(|sum| sum.sum > rule.k_sd)?;
        Some((sum.values / sum.days.len() as f64, sum.days.clone()))
    }
}

fn by_chart<C: ControlChart>(
    rule: &AlertRule,
    measure: &'static DailyMeasure,
    values: &[Option<f64>],
    days: &[DayMeasures],
    begin: impl Fn(Baseline) -> C,
) -> Vec<Alert> {
    let mut alerts = Vec::new();
    // The chart, what was usual as it began, and for how many days in a row it has been beyond its limits.
    let mut chart: Option<(C, Baseline, usize)> = None;
    let mut begins = 0;
    let mut told: Option<usize> = None;
    for (day, value) in values.iter().enumerate() {
        let Some(value) = *value else { continue };
        let Some((taken, usual, alarms)) = &mut chart else {
            let known = values[begins..day].iter().flatten().count();
            if known >= rule.baseline_days.min(rule.min_days * 2) {
                let usual = Baseline::from_values(&values[begins..day], rule.min_days, rule.least_sd);
                chart = usual.map(|usual| (begin(usual), usual, 0));
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

fn alert(
    rule: &AlertRule,
    measure: &'static DailyMeasure,
    (value, usual): (f64, Baseline),
    shown: &[usize],
    days: &[DayMeasures],
) -> Alert {
    let shown_by: Vec<Date> = shown.iter().map(|&day| days[day].date).collect();
    let (headline, numbers) = measure.alert_words(rule.method, (value, usual.mean), &shown_by);
    Alert {
        date: shown_by.last().copied().unwrap_or_default(),
        rule: rule.name.clone(),
        measures: vec![measure.name],
        is_more: Some(value > usual.mean),
        value: Some(value),
        usual: Some(usual.mean),
        sd: Some(usual.sd),
        shown_by,
        words: joined(headline.clone(), &numbers),
        headline,
        numbers,
    }
}

/// Days on which several measures differ, each less than would be worth an alert of its own; the first of those in a row.
fn at_once(several: Several, rules: &Rules, measures: &Measures, counts: &[bool]) -> Vec<Alert> {
    let mut alerts = Vec::new();
    let mut was_so = false;
    for (day, of_day) in measures.days.iter().enumerate() {
        let mut differ: Vec<&'static DailyMeasure> = Vec::new();
        for rule in &rules.rules {
            let Some((number, measure)) = rule.measure() else { continue };
            let from = day.saturating_sub(rule.baseline_days);
            let value = |day: usize| measures.days[day].values[number].filter(|_| counts[day]);
            let before: Vec<Option<f64>> = (from..day).map(value).collect();
            let Some(value) = value(day) else { continue };
            let differs = usual(rule, &before, before.len())
                .is_some_and(|usual| differs(rule, value, usual.mean, usual.sd) > several.k_sd);
            if differs && !differ.iter().any(|known| known.name == measure.name) {
                differ.push(measure);
            }
        }
        let is_so = differ.len() >= several.at_least;
        if is_so && !was_so {
            let nouns: Vec<String> = differ.iter().map(|measure| measure.noun()).collect();
            let words = format!("Several things were unusual at once: {}", listed(&nouns));
            let measures = differ.iter().map(|measure| measure.name).collect();
            alerts.push(Alert::of_day(of_day.date, "several", measures, vec![of_day.date], words));
        }
        was_so = is_so;
    }
    alerts
}

impl fmt::Display for LogAlerts {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(
            f,
            "{}: {}, {} of them complete and at home; {}",
            self.name,
            counted(self.days, "day", "days"),
            self.days_that_count,
            counted(self.alerts.len(), "alert", "alerts")
        )?;
        for alert in &self.alerts {
            writeln!(f, "\n{}  {}\n  {}.", alert.date, alert.rule, alert.words)?;
        }
        write_remarks(f, &self.remarks)
    }
}

#[cfg(test)]
mod tests;
