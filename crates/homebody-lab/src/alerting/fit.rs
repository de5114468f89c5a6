//! Fits the patterns of conditions on simulated people.
//!
//! A pattern has the mean shift of each measure at the height of its condition, by least squares over the severities. The weights follow
//! from the shifts and the covariance of the measures on usual days (Fisher 1936, linear discriminant). The threshold is the lowest with
//! few false news on other people than those who gave the patterns.

use super::people::{WatchedPerson, YearEventKind};
use super::protocol::{Judged, rate};
use homebody_analysis::episodes::{
    ConditionPattern, Distances, PatternMeasure, Patterns, WatchOptions, distances, named_conditions,
};
use homebody_analysis::measures::{MEASURES, MeasureGroup};
use homebody_core::statistics::mean;
use homebody_placement::people::CONDITIONS;
use std::ops::Range;

/// Days at the height of a condition that give its shifts (our choice).
const AT_HEIGHT: usize = 28;
/// Variance that is added to each measure (our choice): shifts are not known exactly.
const RIDGE: f64 = 0.3;
/// Smallest shift of a pattern, in standard deviations (our choice): smaller ones are chance.
const LEAST_SHIFT_SD: f64 = 0.1;
/// Largest rate of false news: one in ten weeks.
pub const BEARABLE_PER_WEEK: f64 = 0.1;
const THRESHOLDS: Range<u32> = 6..81;
const STEP: f64 = 0.25;

/// The patterns by these people. Two thirds of them give the shifts, and the others the threshold and the likelihood ratios.
pub fn fit(people: &[Judged], fitted_by: String) -> Patterns {
    let (others, first): (Vec<&Judged>, Vec<&Judged>) = people.iter().partition(|one| one.person.number % 3 == 2);
    let days: Vec<(&WatchedPerson, Vec<Distances>)> =
        first.iter().map(|one| (&one.person, distances(&one.measures))).collect();
    let covariance = covariance(&days);
    let pattern = |name: &str, shifts: Vec<f64>| with_weights(name, &shifts, &covariance);
    let conditions = CONDITIONS.map(|(name, _)| pattern(name, condition_shifts(&days, name))).into();
    let harmless = vec![
        pattern("guest", event_shifts(&days, &|_, kind| kind == YearEventKind::Guest)),
        pattern(
            "one-of-two-away",
            event_shifts(&days, &|person, kind| kind == YearEventKind::Away && person.has_company()),
        ),
    ];
    let mut patterns = Patterns { fitted_by, threshold: 0.0, conditions, harmless };
    let is_bearable = |threshold: f64| {
        let options = WatchOptions { threshold: Some(threshold), patterns: Some(&patterns), ..WatchOptions::default() };
        rate(others.iter().map(|one| (*one, homebody_analysis::episodes::found_days(&one.measures, options))))
            .per_week()
            <= BEARABLE_PER_WEEK
    };
    let threshold = THRESHOLDS.map(|step| f64::from(step) * STEP).find(|threshold| is_bearable(*threshold));
    patterns.threshold = threshold.unwrap_or(f64::from(THRESHOLDS.end) * STEP);
    let ratios = likelihood_ratios(&others, &patterns);
    patterns.conditions.iter_mut().zip(ratios).for_each(|(pattern, ratio)| pattern.likelihood_ratio = ratio);
    patterns
}

fn mean_of_days(days: &[Distances], during: Range<usize>, measure: usize) -> Option<f64> {
    let during = during.start.min(days.len())..during.end.min(days.len());
    mean(&days[during].iter().filter_map(|day| day[measure]).collect::<Vec<f64>>())
}

fn condition_shifts(people: &[(&WatchedPerson, Vec<Distances>)], name: &str) -> Vec<f64> {
    let of = |measure: usize| {
        let (mut both, mut squares) = (0.0, 0.0);
        for (person, days) in people {
            let Some(condition) = person.condition.as_ref().filter(|condition| condition.name == name) else {
                continue;
            };
            let height = condition.onset + condition.grows_days;
            let at_height = mean_of_days(days, height..height + AT_HEIGHT, measure);
            let Some((high, before)) = at_height.zip(mean_of_days(days, 0..condition.onset, measure)) else { continue };
            let strength = strength(condition.severity);
            both += strength * (high - before);
            squares += strength * strength;
        }
        if squares > 0.0 { both / squares } else { 0.0 }
    };
    (0..MEASURES.len()).map(of).collect()
}

/// Severity as a share of the moderate one, as the conditions' files have it.
fn strength(severity: &str) -> f64 {
    match severity {
        "mild" => 0.5,
        "severe" => 1.5,
        _ => 1.0,
    }
}

fn event_shifts(
    people: &[(&WatchedPerson, Vec<Distances>)],
    counts: &dyn Fn(&WatchedPerson, YearEventKind) -> bool,
) -> Vec<f64> {
    let of = |measure: usize| {
        let shifts = people.iter().flat_map(|(person, days)| {
            let events = person.events.iter().filter(|event| counts(person, event.kind));
            // The first day and the last are mixed.
            events.filter_map(move |event| mean_of_days(days, event.from + 1..event.from + event.days, measure))
        });
        mean(&shifts.collect::<Vec<f64>>()).unwrap_or(0.0)
    };
    (0..MEASURES.len()).map(of).collect()
}

/// The covariance of the measures on usual days; of two that are never known together 0.
fn covariance(people: &[(&WatchedPerson, Vec<Distances>)]) -> Vec<Vec<f64>> {
    let count = MEASURES.len();
    let (mut sums, mut squares, mut days_of) =
        (vec![0.0; count], vec![vec![0.0; count]; count], vec![vec![0.0; count]; count]);
    for (person, days) in people {
        for day in &days[..person.healthy_until(days.len())] {
            for (a, one) in day.iter().enumerate() {
                let Some(one) = one else { continue };
                sums[a] += one;
                for (b, other) in day.iter().enumerate() {
                    let Some(other) = other else { continue };
                    squares[a][b] += one * other;
                    days_of[a][b] += 1.0;
                }
            }
        }
    }
    let mean = |measure: usize| sums[measure] / f64::max(days_of[measure][measure], 1.0);
    let of = |a: usize, b: usize| match days_of[a][b] {
        0.0 => 0.0,
        days => squares[a][b] / days - mean(a) * mean(b),
    };
    (0..count).map(|a| (0..count).map(|b| of(a, b)).collect()).collect()
}

/// A pattern with the weights of its measures. A weight against the measure's own shift is left out, and so are measures of many days in a
/// row, which would count each day many times.
fn with_weights(name: &str, shifts: &[f64], covariance: &[Vec<f64>]) -> ConditionPattern {
    let used: Vec<usize> = (0..MEASURES.len())
        .filter(|&measure| covariance[measure][measure] > 0.0 && MEASURES[measure].group != MeasureGroup::Rhythm)
        .collect();
    let size = used.len();
    let matrix =
        nalgebra::DMatrix::from_fn(size, size, |a, b| covariance[used[a]][used[b]] + if a == b { RIDGE } else { 0.0 });
    let shifted = nalgebra::DVector::from_fn(size, |a, _| shifts[used[a]]);
    let weights = matrix.lu().solve(&shifted).unwrap_or_else(|| nalgebra::DVector::zeros(size));
    let rounded = |value: f64| (value * 1000.0).round() / 1000.0;
    let measure = |(place, &measure): (usize, &usize)| {
        let (shift, weight) = (rounded(shifts[measure]), rounded(weights[place]));
        let is_kept = shift * weight > 0.0 && shift.abs() >= LEAST_SHIFT_SD;
        is_kept.then(|| PatternMeasure::new(measure, shift, weight))
    };
    let measures = used.iter().enumerate().filter_map(measure).collect();
    ConditionPattern { name: name.to_owned(), likelihood_ratio: 1.0, measures }
}

/// By condition, how many times as often news name it in people who have it as in others.
fn likelihood_ratios(people: &[&Judged], patterns: &Patterns) -> Vec<f64> {
    let options = WatchOptions { patterns: Some(patterns), ..WatchOptions::default() };
    let news: Vec<(Option<&'static str>, Vec<String>)> = people
        .iter()
        .flat_map(|one| {
            let has = |day: usize| one.person.condition.as_ref().filter(|of| day >= of.onset).map(|of| of.name);
            named_conditions(&one.measures, options).into_iter().map(move |(day, named)| (has(day), named))
        })
        .collect();
    let ratio = |pattern: &ConditionPattern| {
        let share = |has: bool| {
            let of: Vec<bool> = (news.iter())
                .filter(|(condition, _)| (*condition == Some(pattern.name.as_str())) == has)
                .map(|(_, named)| named.contains(&pattern.name))
                .collect();
            // Half a person more on either side: no share is 0 or 1 (Haldane 1956).
            (of.iter().filter(|named| **named).count() as f64 + 0.5) / (of.len() as f64 + 1.0)
        };
        (share(true) / share(false) * 10.0).round() / 10.0
    };
    patterns.conditions.iter().map(ratio).collect()
}
