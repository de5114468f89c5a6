//! Simple methods, for a comparison with episodes.

use super::protocol::{Judged, JudgedMethod, NewsDays, rate};
use homebody_analysis::episodes::{Patterns, WatchOptions, distances, found_days};
use homebody_analysis::measures::{DayMeasures, MEASURES};
use homebody_core::random::Stream;
use homebody_core::statistics::{mean, sd};
use serde::{Deserialize, Serialize};

/// Number of days after news until the next alarm is news (our choice).
const QUIET_DAYS: usize = 7;
/// Days of the mean of the first method, and least number of them that count.
const TWO_WEEKS: usize = 14;
const LEAST_DAYS: usize = 7;
/// The weight of a new day in the moving average (published for density maps and transfers, 0.2).
const SMOOTHING: f64 = 0.2;
/// Days that the isolation forest learns from, its trees, and the depth of each (Liu et al. 2008: 100 trees; the depth is the logarithm
/// of the number of days).
const LEARNED_DAYS: usize = 28;
const TREES: usize = 100;
const DEPTH: usize = 5;

/// The thresholds of the methods, as `homebody-lab alerts --fit` writes them.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct BaselineThresholds {
    pub two_week_mean: f64,
    pub density_ewma: f64,
    pub isolation_forest: f64,
}

const FITTED: &str = include_str!("baselines.json");

/// All methods, with the thresholds that were fitted on other people.
pub fn methods() -> Vec<JudgedMethod> {
    let fitted: BaselineThresholds = serde_json::from_str(FITTED).unwrap_or_default();
    let patterns = Patterns::fitted();
    let episodes = |one: &Judged, threshold: f64| {
        found_days(&one.measures, WatchOptions { threshold: Some(threshold), ..WatchOptions::default() })
    };
    let steps = |from: f64, to: f64| (0..24).map(|step| from + (to - from) * f64::from(step) / 23.0).collect();
    vec![
        JudgedMethod {
            name: "episodes",
            thresholds: steps(1.0, 16.0),
            fitted: patterns.threshold,
            news: Box::new(episodes),
        },
        JudgedMethod {
            name: "two-week mean",
            thresholds: steps(2.0, 25.0),
            fitted: fitted.two_week_mean,
            news: Box::new(|one, threshold| crossings(&two_week_mean(&one.measures.days), threshold)),
        },
        JudgedMethod {
            name: "EWMA on density map",
            thresholds: steps(1.0, 12.0),
            fitted: fitted.density_ewma,
            news: Box::new(|one, threshold| crossings(&density_ewma(&one.measures.days), threshold)),
        },
        JudgedMethod {
            name: "isolation forest",
            thresholds: steps(0.5, 0.9),
            fitted: fitted.isolation_forest,
            news: Box::new(|one, threshold| crossings(&isolation_forest(one), threshold)),
        },
    ]
}

/// The lowest thresholds with bearable false news.
pub fn fit(people: &[Judged], bearable_per_week: f64) -> BaselineThresholds {
    let mut fitted = methods().into_iter().skip(1).map(|method| {
        let per_week = |threshold: f64| rate(people.iter().map(|one| (one, (method.news)(one, threshold)))).per_week();
        let bearable = method.thresholds.iter().copied().find(|threshold| per_week(*threshold) <= bearable_per_week);
        bearable.or(method.thresholds.last().copied()).unwrap_or(0.0)
    });
    let mut next = || fitted.next().unwrap_or(0.0);
    BaselineThresholds { two_week_mean: next(), density_ewma: next(), isolation_forest: next() }
}

/// The days on which a score reaches a threshold, but those soon after another.
fn crossings(scores: &[Option<f64>], threshold: f64) -> NewsDays {
    let mut last: Option<usize> = None;
    let mut news = Vec::new();
    for (day, score) in scores.iter().enumerate() {
        let is_new = last.is_none_or(|last| day - last >= QUIET_DAYS);
        if is_new && score.is_some_and(|score| score >= threshold) {
            news.push(day);
            last = Some(day);
        }
    }
    news
}

/// The largest difference of any measure from its mean of two weeks, in standard deviations.
fn two_week_mean(days: &[DayMeasures]) -> Vec<Option<f64>> {
    let value = |day: usize, measure: usize| days[day].values[measure].filter(|_| days[day].counts());
    let score = |day: usize| {
        let of = |measure: usize| {
            let before: Vec<f64> = (day.saturating_sub(TWO_WEEKS)..day).filter_map(|day| value(day, measure)).collect();
            let (mean, sd) = mean(&before).zip(sd(&before)).filter(|_| before.len() >= LEAST_DAYS)?;
            Some((value(day, measure)? - mean).abs() / sd.max(MEASURES[measure].least_sd))
        };
        (0..MEASURES.len()).filter_map(of).reduce(f64::max)
    };
    (0..days.len()).map(score).collect()
}

/// The moving average of the density map's change, in standard deviations of the first four weeks.
fn density_ewma(days: &[DayMeasures]) -> Vec<Option<f64>> {
    let value = |day: &DayMeasures| day.value("density_distance").filter(|_| day.counts());
    let first: Vec<f64> = days.iter().filter_map(value).take(LEARNED_DAYS).collect();
    let Some((mean, sd)) = mean(&first).zip(sd(&first)).filter(|(_, sd)| *sd > 0.0) else {
        return vec![None; days.len()];
    };
    let mut average = mean;
    let score = |day: &DayMeasures| {
        average += SMOOTHING * (value(day)? - average);
        Some((average - mean) / (sd * (SMOOTHING / (2.0 - SMOOTHING)).sqrt()))
    };
    days.iter().map(score).collect()
}

enum IsolationTree {
    Leaf(usize),
    Split { measure: usize, at: f64, below: Box<IsolationTree>, above: Box<IsolationTree> },
}

impl IsolationTree {
    fn grow(rows: &[&Vec<f64>], depth: usize, stream: &mut Stream) -> IsolationTree {
        let (Some(first), true) = (rows.first(), depth > 0 && rows.len() > 1) else {
            return IsolationTree::Leaf(rows.len());
        };
        let measure = stream.below(first.len() as u32) as usize;
        let (low, high) =
            rows.iter().fold((f64::MAX, f64::MIN), |(low, high), row| (low.min(row[measure]), high.max(row[measure])));
        if low >= high {
            return IsolationTree::Leaf(rows.len());
        }
        let at = stream.between(low, high);
        let (below, above): (Vec<&Vec<f64>>, Vec<&Vec<f64>>) = rows.iter().partition(|row| row[measure] < at);
        let mut grow = |rows: &[&Vec<f64>]| Box::new(IsolationTree::grow(rows, depth - 1, stream));
        IsolationTree::Split { measure, at, below: grow(&below), above: grow(&above) }
    }

    /// The number of splits until a day is alone, with the mean number for those that a leaf keeps together.
    fn path(&self, row: &[f64]) -> f64 {
        match self {
            IsolationTree::Leaf(count) => mean_path(*count),
            IsolationTree::Split { measure, at, below, above } => {
                1.0 + if row[*measure] < *at { below.path(row) } else { above.path(row) }
            }
        }
    }
}

/// The mean number of splits that isolates one of some days (Liu et al. 2008).
fn mean_path(count: usize) -> f64 {
    let count = count as f64;
    if count < 2.0 { 0.0 } else { 2.0 * ((count - 1.0).ln() + EULER) - 2.0 * (count - 1.0) / count }
}

const EULER: f64 = 0.577_215_664_901_532_9;

/// The anomaly of each day against the first four weeks. A measure that is not known counts as usual.
fn isolation_forest(one: &Judged) -> Vec<Option<f64>> {
    let days = &one.measures.days;
    let rows: Vec<Option<Vec<f64>>> = distances(&one.measures)
        .iter()
        .zip(days)
        .map(|(distances, day)| day.counts().then(|| distances.iter().map(|one| one.unwrap_or(0.0)).collect()))
        .collect();
    let is_learned = |row: &&Vec<f64>| row.iter().any(|value| *value != 0.0);
    let learned: Vec<&Vec<f64>> = rows.iter().flatten().filter(is_learned).take(LEARNED_DAYS).collect();
    let mut stream = Stream::named(u64::from(one.person.number), "alerts/isolation-forest");
    let trees: Vec<IsolationTree> = (0..TREES).map(|_| IsolationTree::grow(&learned, DEPTH, &mut stream)).collect();
    let usual = mean_path(learned.len());
    let score = |row: &Option<Vec<f64>>| {
        let paths: Vec<f64> = trees.iter().map(|tree| tree.path(row.as_deref().unwrap_or_default())).collect();
        Some(2.0_f64.powf(-mean(&paths)? / usual))
    };
    rows.iter().map(|row| row.as_ref().and_then(|_| score(row))).collect()
}
