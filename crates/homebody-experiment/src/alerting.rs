//! How good alerts are: whether they come after a condition has begun, how soon, and how often they come for nothing.
//!
//! People differ as those of a cohort do. Each shows one condition from a day on that is known, growing for so many days as such
//! conditions do, or none. Each log is measured, and its alerts are held against that day. An alert before it, and any of
//! somebody without a condition, is a false alarm. Lead is counted back from the day on which the condition is at its height.

use homebody_analysis::alerts::{Method, Rule, Rules, SENSOR, Several, alerts};
use homebody_analysis::measures::Measures;
use homebody_core::statistics;
use serde::Serialize;

/// Before this day nobody has a usual.
const FIRST: usize = 15;
/// Curves tell of those who are found within so many days.
pub const WITHIN: usize = 28;
/// The standard deviations for which curves have a point.
const SWEEP: [f64; 9] = [1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 8.0];
/// Layouts are held against each other with so many false alarms a week: one in five weeks, as a published study of control charts
/// had.
const BEARABLE_PER_WEEK: f64 = 0.2;
/// Sensitivity is told for so many days after the beginning.
const AFTER: [usize; 4] = [7, 14, 28, 56];
/// Of intervals of 95 %, in standard deviations.
const Z: f64 = 1.96;

/// Somebody with a condition, or without one.
#[derive(Clone, Copy)]
pub struct Person {
    /// The condition's name; none of somebody without one.
    pub condition: Option<&'static str>,
    /// The day on which it begins, counted from 0: of somebody without one, that of the others.
    pub onset: usize,
    /// How many days later it is at its height.
    pub height: usize,
}

/// Somebody whose days were measured.
#[derive(Clone, Copy)]
pub struct Watched<'a> {
    /// Who.
    pub person: &'a Person,
    /// The days.
    pub measures: &'a Measures,
}

/// How good the alerts are.
#[derive(Clone, Debug, Serialize)]
pub struct Quality {
    /// How many people, and for how many days each.
    pub people: usize,
    /// The days of each.
    pub days: u32,
    /// For each condition and rule that spoke of anybody with it; the rule `any` is all together.
    pub rows: Vec<Row>,
    /// How often each rule speaks for nothing.
    pub false_alarms: Vec<FalseAlarms>,
    /// For each condition, all rules together, with other numbers of standard deviations.
    pub curves: Vec<Curve>,
    /// How the methods of rules do beside each other.
    pub methods: Vec<OfMethod>,
}

/// How a method does for all rules that are control charts, each with it instead of its own.
#[derive(Clone, Debug, Serialize)]
pub struct OfMethod {
    /// What it is called in rules.
    pub method: &'static str,
    /// How soon it finds people, with bearable false alarms.
    #[serde(flatten)]
    pub adequacy: Adequacy,
}

/// A condition and a rule.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// The condition.
    pub condition: String,
    /// The rule's name, or `any`.
    pub rule: String,
    /// How many people show the condition.
    pub people: usize,
    /// The share of them with an alert until the end, with its interval of 95 % (Wilson 1927).
    pub sensitivity: f64,
    /// The interval.
    pub sensitivity_95: [f64; 2],
    /// The share of those without a condition who have one in the same days: what chance does.
    pub by_chance: f64,
    /// The share of them with an alert within so many days after the beginning.
    pub within: Vec<(usize, f64)>,
    /// The median of the days from the beginning to the first alert, of those who have one, with quartiles.
    pub delay_days: Option<[f64; 3]>,
    /// The median of the days from the first alert to the height of the condition.
    pub lead_days: Option<f64>,
    /// How many false alarms a week of one person.
    pub false_alarms_per_week: f64,
    /// The interval.
    pub false_alarms_95: [f64; 2],
}

/// How often a rule speaks for nothing.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FalseAlarms {
    /// The rule's name, or `any`.
    pub rule: String,
    /// How many false alarms a week of one person.
    pub per_week: f64,
    /// The interval of 95 %.
    pub per_week_95: [f64; 2],
}

/// How sensitivity and false alarms go together.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Curve {
    /// The condition.
    pub condition: String,
    /// By number of standard deviations.
    pub points: Vec<Point>,
}

/// A point of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Point {
    /// The number of standard deviations, for all rules.
    pub k_sd: f64,
    /// The share of those with the condition who are found within 28 days.
    pub sensitivity: f64,
    /// How many false alarms a week of one person.
    pub false_alarms_per_week: f64,
}

/// The alerts of a person: on which day, by which rule.
type Told = Vec<(usize, String)>;

/// How good the alerts are that rules give of people.
pub fn quality(people: &[Watched], rules: &Rules, days: u32) -> Quality {
    let told: Vec<Told> = people.iter().map(|watched| told(watched.measures, rules)).collect();
    let mut names: Vec<&str> = rules.rules.iter().map(|rule| rule.name.as_str()).collect();
    names.extend(["several", "any"]);
    let conditions = conditions(people);
    let false_alarms: Vec<FalseAlarms> = names.iter().map(|rule| false_alarms(people, &told, rule)).collect();
    let mut rows = Vec::new();
    for condition in &conditions {
        for (rule, idle) in names.iter().zip(&false_alarms) {
            let row = row(people, &told, condition, (rule, idle));
            rows.extend(row.filter(|row| row.sensitivity > 0.0));
        }
    }
    let swept: Vec<(f64, Vec<Told>)> = swept(people, rules).collect();
    let curve = |condition: &&'static str| Curve {
        condition: (*condition).to_owned(),
        points: swept.iter().map(|(k_sd, told)| point(people, told, *k_sd, Some(condition))).collect(),
    };
    let curves = conditions.iter().map(curve).collect();
    let methods = METHODS.map(|(name, method)| {
        let charts = rules.rules.iter().filter(|rule| rule.method != Method::Deviation);
        let rules = charts.map(|rule| Rule { method, ..rule.clone() }).collect();
        OfMethod { method: name, adequacy: adequacy(people, &Rules { rules, several: None }) }
    });
    Quality { people: people.len(), days, rows, false_alarms, curves, methods: methods.into() }
}

/// The methods that are held beside each other.
const METHODS: [(&str, Method); 3] =
    [("deviation", Method::Deviation), ("ewma", Method::Ewma), ("cusum", Method::Cusum)];

fn told(measures: &Measures, rules: &Rules) -> Told {
    let first = measures.days.first().map(|day| day.date);
    let number = |date: jiff::civil::Date| {
        let days = first.and_then(|first| first.until(date).ok()).map_or(0, |span| span.get_days());
        usize::try_from(days).unwrap_or(0)
    };
    let of_somebody = alerts(measures, rules).alerts.into_iter().filter(|alert| alert.rule != SENSOR);
    of_somebody.map(|alert| (number(alert.date), alert.rule)).collect()
}

/// The alerts with each of the numbers of standard deviations, the least first.
fn swept(people: &[Watched], rules: &Rules) -> impl Iterator<Item = (f64, Vec<Told>)> {
    let with = move |k_sd: f64| {
        let mut rules = rules.clone();
        rules.rules.iter_mut().for_each(|rule| rule.k_sd = k_sd);
        rules.several = rules.several.map(|several| Several { k_sd: k_sd - 1.0, ..several });
        (k_sd, people.iter().map(|watched| told(watched.measures, &rules)).collect())
    };
    SWEEP.into_iter().map(with)
}

fn point(people: &[Watched], told: &[Told], k_sd: f64, condition: Option<&str>) -> Point {
    let firsts = firsts(people, told, condition, "any");
    let found = firsts.iter().flatten().filter(|&&delay| delay < WITHIN).count();
    let false_alarms_per_week = false_alarms_of(people, told, "any").0;
    Point { k_sd, sensitivity: found as f64 / firsts.len().max(1) as f64, false_alarms_per_week }
}

/// How soon a layout of sensors finds people, with no more false alarms than are bearable.
#[derive(Clone, Debug, Serialize)]
pub struct Adequacy {
    /// The least number of standard deviations with which false alarms are bearable; of those that were tried, the greatest
    /// where they never are.
    pub k_sd: f64,
    /// How many false alarms a week of one person there are then.
    pub false_alarms_per_week: f64,
    /// The share of those with a condition who are found within 28 days.
    pub found: f64,
    /// In how many days somebody with a condition is found, on average; who is not within 28 counts as 28.
    pub days: f64,
    /// The same by condition.
    pub by_condition: Vec<(String, f64)>,
    /// The same by person, of those with a condition.
    #[serde(skip)]
    pub by_person: Vec<f64>,
}

/// How soon people are found by what was measured of them.
pub fn adequacy(people: &[Watched], rules: &Rules) -> Adequacy {
    let of = |told: &[Told]| false_alarms_of(people, told, "any").0;
    let (mut k_sd, mut told) = Default::default();
    for with_more in swept(people, rules) {
        (k_sd, told) = with_more;
        if of(&told) <= BEARABLE_PER_WEEK {
            break;
        }
    }
    let days = |condition: &'static str| -> Vec<f64> {
        let firsts = firsts(people, &told, Some(condition), "any");
        firsts.into_iter().map(|first| first.unwrap_or(WITHIN).min(WITHIN) as f64).collect()
    };
    let by_condition: Vec<(&str, Vec<f64>)> =
        conditions(people).into_iter().map(|condition| (condition, days(condition))).collect();
    let by_person: Vec<f64> = by_condition.iter().flat_map(|(_, days)| days.iter().copied()).collect();
    let found = by_person.iter().filter(|days| **days < WITHIN as f64).count();
    Adequacy {
        k_sd,
        false_alarms_per_week: of(&told),
        found: found as f64 / by_person.len().max(1) as f64,
        days: mean(&by_person),
        by_condition: by_condition.iter().map(|(name, days)| ((*name).to_owned(), mean(days))).collect(),
        by_person,
    }
}

/// How many days later people are found than by another layout, on average, with its interval of 95 %: of the same people.
pub fn later(than: &Adequacy, by: &Adequacy) -> (f64, [f64; 2]) {
    let apart: Vec<f64> = by.by_person.iter().zip(&than.by_person).map(|(by, than)| by - than).collect();
    let middle = mean(&apart);
    let squares: Vec<f64> = apart.iter().map(|apart| (apart - middle) * (apart - middle)).collect();
    let error = Z * (mean(&squares) / apart.len().max(1) as f64).sqrt();
    (middle, [middle - error, middle + error])
}

fn mean(of: &[f64]) -> f64 {
    statistics::mean(of).unwrap_or(0.0)
}

fn conditions(people: &[Watched]) -> Vec<&'static str> {
    let mut conditions: Vec<&'static str> = people.iter().filter_map(|watched| watched.person.condition).collect();
    conditions.sort_unstable();
    conditions.dedup();
    conditions
}

/// Of each with a condition, or of each without one: how many days after the beginning the first alert of a rule comes.
fn firsts(people: &[Watched], told: &[Told], condition: Option<&str>, rule: &str) -> Vec<Option<usize>> {
    let of = people.iter().map(|watched| watched.person).zip(told).filter(|(person, _)| person.condition == condition);
    let first = |(person, told): (&Person, &Told)| {
        let days = told.iter().filter(|(day, by)| *day >= person.onset && (rule == "any" || by == rule));
        days.map(|(day, _)| day - person.onset).min()
    };
    of.map(first).collect()
}

/// False alarms a week, with how many there are.
fn false_alarms_of(people: &[Watched], told: &[Told], rule: &str) -> (f64, f64, f64) {
    let (mut count, mut weeks) = (0.0, 0.0);
    for (Watched { person, measures }, told) in people.iter().zip(told) {
        let end = if person.condition.is_some() { person.onset } else { measures.days.len() };
        weeks += end.saturating_sub(FIRST) as f64 / 7.0;
        let is_idle = |(day, by): &&(usize, String)| (FIRST..end).contains(day) && (rule == "any" || by == rule);
        count += told.iter().filter(is_idle).count() as f64;
    }
    (if weeks > 0.0 { count / weeks } else { 0.0 }, count, weeks)
}

fn false_alarms(people: &[Watched], told: &[Told], rule: &str) -> FalseAlarms {
    let (per_week, count, weeks) = false_alarms_of(people, told, rule);
    // Counts as those of Poisson, by the normal law.
    let apart = Z * count.max(1.0).sqrt() / weeks.max(1e-9);
    FalseAlarms { rule: rule.to_owned(), per_week, per_week_95: [(per_week - apart).max(0.0), per_week + apart] }
}

fn row(people: &[Watched], told: &[Told], condition: &str, (rule, idle): (&str, &FalseAlarms)) -> Option<Row> {
    let firsts_of = firsts(people, told, Some(condition), rule);
    let count = firsts_of.len();
    let height = people.iter().find(|watched| watched.person.condition == Some(condition))?.person.height;
    let mut delays: Vec<usize> = firsts_of.into_iter().flatten().collect();
    delays.sort_unstable();
    let share = |found: usize| found as f64 / count as f64;
    let chance = firsts(people, told, None, rule);
    let at =
        |share: f64| delays.get(((delays.len().max(1) - 1) as f64 * share).round() as usize).map(|&day| day as f64);
    let delay_days = at(0.25).zip(at(0.5)).zip(at(0.75)).map(|((low, middle), high)| [low, middle, high]);
    (count > 0).then(|| Row {
        condition: condition.to_owned(),
        rule: rule.to_owned(),
        people: count,
        sensitivity: share(delays.len()),
        sensitivity_95: wilson(delays.len(), count),
        by_chance: chance.iter().flatten().count() as f64 / chance.len().max(1) as f64,
        within: AFTER.map(|days| (days, share(delays.iter().filter(|&&delay| delay < days).count()))).to_vec(),
        delay_days,
        lead_days: delay_days.map(|[_, middle, _]| height as f64 - middle),
        false_alarms_per_week: idle.per_week,
        false_alarms_95: idle.per_week_95,
    })
}

/// The interval of a share.
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

    const OF_GRIEF: Person = Person { condition: Some("grief"), onset: 60, height: 28 };
    const OF_NONE: Person = Person { condition: None, ..OF_GRIEF };

    fn no_days() -> Measures {
        Measures::default()
    }

    #[test]
    fn alerts_after_the_beginning_count_and_those_before_are_false() {
        let measures = no_days();
        let people = [&OF_GRIEF, &OF_GRIEF, &OF_NONE].map(|person| Watched { person, measures: &measures });
        let told = [[30, 70, 80].map(|day| (day, "sleep".to_owned())).to_vec(), vec![], vec![]];
        let idle = false_alarms(&people, &told, "sleep");
        assert!((idle.per_week - 1.0 / (2.0 * 45.0 / 7.0)).abs() < 1e-9, "{idle:?}");
        let row = row(&people, &told, "grief", ("sleep", &idle)).unwrap();
        assert_eq!((row.people, row.sensitivity, row.by_chance), (2, 0.5, 0.0));
        assert_eq!((row.delay_days, row.lead_days), (Some([10.0; 3]), Some(18.0)));
        assert_eq!(row.within[..2], [(7, 0.0), (14, 0.5)]);
    }

    #[test]
    fn who_is_never_found_is_found_as_late_as_can_be() {
        let measures = no_days();
        let people = [&OF_GRIEF, &OF_NONE].map(|person| Watched { person, measures: &measures });
        let rules: Rules = serde_json::from_str(r#"{ "rules": [] }"#).unwrap();
        let never = adequacy(&people, &rules);
        assert_eq!((never.days, never.found, never.by_person.clone()), (28.0, 0.0, vec![28.0]));
        let soon = Adequacy { by_person: vec![4.0], ..never.clone() };
        assert_eq!(later(&soon, &never), (24.0, [24.0, 24.0]));
    }

    #[test]
    fn an_interval_of_a_share_is_wilsons() {
        let [low, high] = wilson(8, 10);
        assert!((low - 0.490).abs() < 1e-3 && (high - 0.943).abs() < 1e-3, "{low} {high}");
    }
}
