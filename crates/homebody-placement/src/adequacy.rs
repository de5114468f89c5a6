//! The delay between conditions of people and the episodes that are found, and the number of false episodes.
//!
//! Each person has one condition from a known day on, or none. An episode that is found before that day is false, and so is any
//! episode of a person without a condition.

use homebody_analysis::episodes::{WatchOptions, found_days};
use homebody_analysis::measures::Measures;
use homebody_core::statistics;
use serde::Serialize;

/// First day with episodes that count: before it, no person has a reference.
pub const FIRST: usize = 28;
/// Days within which a person counts as found.
pub const WITHIN: usize = 28;
/// Thresholds of evidence that are tried.
const SWEEP: [f64; 12] = [2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 10.0, 12.0, 15.0, 20.0, 30.0];
/// False episodes a week at which layouts are compared (our choice): one in ten weeks.
const BEARABLE_PER_WEEK: f64 = 0.1;
/// Half the width of an interval of 95 %, in standard deviations.
pub const Z: f64 = 1.96;

#[derive(Clone, Copy)]
pub struct Person {
    pub condition: Option<&'static str>,
    /// The day on which the condition begins, counted from 0. A person without a condition has the day of the others.
    pub onset: usize,
    /// Days from then until the condition is at its height.
    pub height: usize,
}

#[derive(Clone, Copy)]
pub struct Watched<'a> {
    pub person: &'a Person,
    pub measures: &'a Measures,
}

/// The number of each day on which an episode was found.
pub type FoundDays = Vec<usize>;

pub fn swept(people: &[Watched]) -> impl Iterator<Item = (f64, Vec<FoundDays>)> {
    let with = move |threshold: f64| {
        let options = WatchOptions { threshold: Some(threshold), ..WatchOptions::default() };
        (threshold, people.iter().map(|watched| found_days(watched.measures, options)).collect())
    };
    SWEEP.into_iter().map(with)
}

/// The performance of a layout of sensors, with no more false alarms than are bearable.
#[derive(Clone, Debug, Serialize)]
pub struct Adequacy {
    /// The least threshold with bearable false episodes; the greatest one that was tried, if they never are.
    pub threshold: f64,
    pub false_episodes_per_week: f64,
    /// Share of the people with a condition who are found within 28 days.
    pub found: f64,
    /// Mean number of days until a person with a condition is found; 28 for a person who is not found by then.
    pub days: f64,
    /// The same by condition.
    pub by_condition: Vec<(String, f64)>,
    /// The same by person with a condition.
    #[serde(skip)]
    pub by_person: Vec<f64>,
}

pub fn adequacy(people: &[Watched]) -> Adequacy {
    let per_week = |found: &[FoundDays]| false_episodes(people, found).per_week();
    let (mut threshold, mut found) = Default::default();
    for with_more in swept(people) {
        (threshold, found) = with_more;
        if per_week(&found) <= BEARABLE_PER_WEEK {
            break;
        }
    }
    let days = |condition: &'static str| -> Vec<f64> {
        let delays = delays(people, &found, Some(condition));
        delays.into_iter().map(|delay| delay.unwrap_or(WITHIN).min(WITHIN) as f64).collect()
    };
    let by_condition: Vec<(&str, Vec<f64>)> =
        conditions(people).into_iter().map(|condition| (condition, days(condition))).collect();
    let by_person: Vec<f64> = by_condition.iter().flat_map(|(_, days)| days.iter().copied()).collect();
    let found_in_time = by_person.iter().filter(|days| **days < WITHIN as f64).count();
    Adequacy {
        threshold,
        false_episodes_per_week: per_week(&found),
        found: found_in_time as f64 / by_person.len().max(1) as f64,
        days: mean(&by_person),
        by_condition: by_condition.iter().map(|(name, days)| ((*name).to_owned(), mean(days))).collect(),
        by_person,
    }
}

pub fn mean(of: &[f64]) -> f64 {
    statistics::mean(of).unwrap_or(0.0)
}

pub fn conditions(people: &[Watched]) -> Vec<&'static str> {
    let mut conditions: Vec<&'static str> = people.iter().filter_map(|watched| watched.person.condition).collect();
    conditions.sort_unstable();
    conditions.dedup();
    conditions
}

/// Days from the onset to the first episode that is found, by person with a condition, or by person without one.
pub fn delays(people: &[Watched], found: &[FoundDays], condition: Option<&str>) -> Vec<Option<usize>> {
    let of = people.iter().map(|watched| watched.person).zip(found);
    let delay = |(person, found): (&Person, &FoundDays)| {
        found.iter().filter(|day| **day >= person.onset).map(|day| day - person.onset).min()
    };
    of.filter(|(person, _)| person.condition == condition).map(delay).collect()
}

#[derive(Clone, Copy, Debug, Default)]
pub struct FalseEpisodes {
    pub count: f64,
    pub weeks: f64,
}

impl FalseEpisodes {
    pub fn per_week(self) -> f64 {
        if self.weeks > 0.0 { self.count / self.weeks } else { 0.0 }
    }
}

pub fn false_episodes(people: &[Watched], found: &[FoundDays]) -> FalseEpisodes {
    let mut all = FalseEpisodes::default();
    for (Watched { person, measures }, found) in people.iter().zip(found) {
        let end = if person.condition.is_some() { person.onset } else { measures.days.len() };
        all.weeks += end.saturating_sub(FIRST) as f64 / 7.0;
        all.count += found.iter().filter(|day| (FIRST..end).contains(day)).count() as f64;
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_person_who_is_never_found_counts_as_found_on_the_last_day() {
        let measures = Measures::default();
        let with_grief = Person { condition: Some("grief"), onset: 60, height: 28 };
        let healthy = Person { condition: None, ..with_grief };
        let people = [&with_grief, &healthy].map(|person| Watched { person, measures: &measures });
        let never = adequacy(&people);
        assert_eq!((never.days, never.found, never.by_person), (28.0, 0.0, vec![28.0]));
    }
}
