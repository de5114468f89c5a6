//! The delay between conditions of people and the alerts about them, and the number of false alerts.
//!
//! Each person has one condition from a known day on, or none. An alert before that day is a false alarm, and so is any
//! alert of a person without a condition.

use homebody_analysis::alerts::{Rules, SENSOR, Several, alerts};
use homebody_analysis::measures::Measures;
use homebody_core::statistics;
use serde::Serialize;

/// First day with alerts that count: before it, no person has a usual level.
pub const FIRST: usize = 15;
/// Days within which a person counts as found.
pub const WITHIN: usize = 28;
/// Numbers of standard deviations that are tried.
const SWEEP: [f64; 9] = [1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 8.0];
/// False alarms a week at which layouts are compared: one in five weeks, as in a published study of control charts.
const BEARABLE_PER_WEEK: f64 = 0.2;
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

pub type Alerts = Vec<(usize, String)>;

/// Without alerts about sensors.
pub fn alerts_of(measures: &Measures, rules: &Rules) -> Alerts {
    let first = measures.days.first().map(|day| day.date);
    let number = |date: jiff::civil::Date| {
        let days = first.and_then(|first| first.until(date).ok()).map_or(0, |span| span.get_days());
        usize::try_from(days).unwrap_or(0)
    };
    let of_person = alerts(measures, rules).alerts.into_iter().filter(|alert| alert.rule != SENSOR);
    of_person.map(|alert| (number(alert.date), alert.rule)).collect()
}

pub fn swept(people: &[Watched], rules: &Rules) -> impl Iterator<Item = (f64, Vec<Alerts>)> {
    let with = move |k_sd: f64| {
        let mut rules = rules.clone();
        rules.rules.iter_mut().for_each(|rule| rule.k_sd = k_sd);
        rules.several = rules.several.map(|several| Several { k_sd: k_sd - 1.0, ..several });
        (k_sd, people.iter().map(|watched| alerts_of(watched.measures, &rules)).collect())
    };
    SWEEP.into_iter().map(with)
}

/// The performance of a layout of sensors, with no more false alarms than are bearable.
#[derive(Clone, Debug, Serialize)]
pub struct Adequacy {
    /// The least number of standard deviations with bearable false alarms; the greatest one that was tried, if they
    /// never are.
    pub k_sd: f64,
    pub false_alarms_per_week: f64,
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

pub fn adequacy(people: &[Watched], rules: &Rules) -> Adequacy {
    let per_week = |alerts: &[Alerts]| false_alarms(people, alerts, "any").per_week();
    let (mut k_sd, mut alerts) = Default::default();
    for with_more in swept(people, rules) {
        (k_sd, alerts) = with_more;
        if per_week(&alerts) <= BEARABLE_PER_WEEK {
            break;
        }
    }
    let days = |condition: &'static str| -> Vec<f64> {
        let delays = delays(people, &alerts, Some(condition), "any");
        delays.into_iter().map(|delay| delay.unwrap_or(WITHIN).min(WITHIN) as f64).collect()
    };
    let by_condition: Vec<(&str, Vec<f64>)> =
        conditions(people).into_iter().map(|condition| (condition, days(condition))).collect();
    let by_person: Vec<f64> = by_condition.iter().flat_map(|(_, days)| days.iter().copied()).collect();
    let found = by_person.iter().filter(|days| **days < WITHIN as f64).count();
    Adequacy {
        k_sd,
        false_alarms_per_week: per_week(&alerts),
        found: found as f64 / by_person.len().max(1) as f64,
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

/// Days from the onset to the first alert of a rule (`any` for all rules), by person with a condition, or by person
/// without one.
pub fn delays(people: &[Watched], alerts: &[Alerts], condition: Option<&str>, rule: &str) -> Vec<Option<usize>> {
    let of = people.iter().map(|watched| watched.person).zip(alerts);
    let delay = |(person, alerts): (&Person, &Alerts)| {
        let days = alerts.iter().filter(|(day, by)| *day >= person.onset && (rule == "any" || by == rule));
        days.map(|(day, _)| day - person.onset).min()
    };
    of.filter(|(person, _)| person.condition == condition).map(delay).collect()
}

#[derive(Clone, Copy, Debug, Default)]
pub struct FalseAlarmCount {
    pub count: f64,
    pub weeks: f64,
}

impl FalseAlarmCount {
    pub fn per_week(self) -> f64 {
        if self.weeks > 0.0 { self.count / self.weeks } else { 0.0 }
    }
}

pub fn false_alarms(people: &[Watched], alerts: &[Alerts], rule: &str) -> FalseAlarmCount {
    let mut all = FalseAlarmCount::default();
    for (Watched { person, measures }, alerts) in people.iter().zip(alerts) {
        let end = if person.condition.is_some() { person.onset } else { measures.days.len() };
        all.weeks += end.saturating_sub(FIRST) as f64 / 7.0;
        let is_false = |(day, by): &&(usize, String)| (FIRST..end).contains(day) && (rule == "any" || by == rule);
        all.count += alerts.iter().filter(is_false).count() as f64;
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
        let rules: Rules = serde_json::from_str(r#"{ "rules": [] }"#).unwrap();
        let never = adequacy(&people, &rules);
        assert_eq!((never.days, never.found, never.by_person), (28.0, 0.0, vec![28.0]));
    }
}
