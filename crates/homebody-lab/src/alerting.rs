//! The quality of alerts: whether they come after a condition has begun, how soon, and how often they are false.
//!
//! People differ as those of a cohort do. Each shows one condition from a day on that is known, growing for so many days as such
//! conditions do, or none. Each log is measured, and its alerts are compared with that day. An alert before it, and any of
//! a person without a condition, is a false alarm. Lead is counted back from the day on which the condition is at its height.

use homebody_analysis::alerts::{AlertMethod, AlertRule, Rules};
use homebody_placement::adequacy::{
    Adequacy, Alerts, FalseAlarmCount, WITHIN, Watched, Z, adequacy, alerts_of, conditions, delays, false_alarms, mean,
    swept,
};
use serde::Serialize;

/// Days after the onset for which the sensitivity is printed.
const AFTER: [usize; 4] = [7, 14, 28, 56];

/// The quality of alerts.
#[derive(Clone, Debug, Serialize)]
pub struct Quality {
    /// Number of people.
    pub people: usize,
    /// The days of each.
    pub days: u32,
    /// For each condition and rule that spoke of anybody with it; the rule `any` is all together.
    pub rows: Vec<Row>,
    /// False alarms by rule.
    pub false_alarms: Vec<FalseAlarms>,
    /// For each condition, all rules together, with other numbers of standard deviations.
    pub curves: Vec<Curve>,
    /// A comparison of the methods of rules.
    pub methods: Vec<OfMethod>,
}

/// The result with one method for all rules that are control charts.
#[derive(Clone, Debug, Serialize)]
pub struct OfMethod {
    /// The name of the method in rules.
    pub method: &'static str,
    /// The delay until people are found, with bearable false alarms.
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
    /// Number of people with the condition.
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
    /// False alarms of one person in a week.
    pub false_alarms_per_week: f64,
    /// The interval.
    pub false_alarms_95: [f64; 2],
}

/// The false alarms of a rule.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FalseAlarms {
    /// The rule's name, or `any`.
    pub rule: String,
    /// False alarms of one person in a week.
    pub per_week: f64,
    /// The interval of 95 %.
    pub per_week_95: [f64; 2],
}

/// Sensitivity against false alarms.
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
    /// False alarms of one person in a week.
    pub false_alarms_per_week: f64,
}

/// The quality of the alerts that rules give for people.
pub fn quality(people: &[Watched], rules: &Rules, days: u32) -> Quality {
    let told: Vec<Alerts> = people.iter().map(|watched| alerts_of(watched.measures, rules)).collect();
    let mut names: Vec<&str> = rules.rules.iter().map(|rule| rule.name.as_str()).collect();
    names.extend(["several", "any"]);
    let conditions = conditions(people);
    let false_alarms: Vec<FalseAlarms> = names.iter().map(|rule| false_alarms_of(people, &told, rule)).collect();
    let mut rows = Vec::new();
    for condition in &conditions {
        for (rule, idle) in names.iter().zip(&false_alarms) {
            let row = row(people, &told, condition, (rule, idle));
            rows.extend(row.filter(|row| row.sensitivity > 0.0));
        }
    }
    let swept: Vec<(f64, Vec<Alerts>)> = swept(people, rules).collect();
    let curve = |condition: &&'static str| Curve {
        condition: (*condition).to_owned(),
        points: swept.iter().map(|(k_sd, told)| point(people, told, *k_sd, Some(condition))).collect(),
    };
    let curves = conditions.iter().map(curve).collect();
    let methods = METHODS.map(|(name, method)| {
        let charts = rules.rules.iter().filter(|rule| rule.method != AlertMethod::Deviation);
        let rules = charts.map(|rule| AlertRule { method, ..rule.clone() }).collect();
        OfMethod { method: name, adequacy: adequacy(people, &Rules { rules, several: None }) }
    });
    Quality { people: people.len(), days, rows, false_alarms, curves, methods: methods.into() }
}

/// The methods that are held beside each other.
const METHODS: [(&str, AlertMethod); 3] =
    [("deviation", AlertMethod::Deviation), ("ewma", AlertMethod::Ewma), ("cusum", AlertMethod::Cusum)];

fn point(people: &[Watched], told: &[Alerts], k_sd: f64, condition: Option<&str>) -> Point {
    let firsts = delays(people, told, condition, "any");
    let found = firsts.iter().flatten().filter(|&&delay| delay < WITHIN).count();
    let false_alarms_per_week = false_alarms(people, told, "any").per_week();
    Point { k_sd, sensitivity: found as f64 / firsts.len().max(1) as f64, false_alarms_per_week }
}

/// The mean number of days by which people are found later than by another layout, with the interval of 95 %: of the same people.
pub fn later(than: &Adequacy, by: &Adequacy) -> (f64, [f64; 2]) {
    let apart: Vec<f64> = by.by_person.iter().zip(&than.by_person).map(|(by, than)| by - than).collect();
    let middle = mean(&apart);
    let squares: Vec<f64> = apart.iter().map(|apart| (apart - middle) * (apart - middle)).collect();
    let error = Z * (mean(&squares) / apart.len().max(1) as f64).sqrt();
    (middle, [middle - error, middle + error])
}

fn false_alarms_of(people: &[Watched], told: &[Alerts], rule: &str) -> FalseAlarms {
    let counted = false_alarms(people, told, rule);
    let (per_week, FalseAlarmCount { count, weeks }) = (counted.per_week(), counted);
    // Counts as those of Poisson, by the normal law.
    let apart = Z * count.max(1.0).sqrt() / weeks.max(1e-9);
    FalseAlarms { rule: rule.to_owned(), per_week, per_week_95: [(per_week - apart).max(0.0), per_week + apart] }
}

fn row(people: &[Watched], told: &[Alerts], condition: &str, (rule, idle): (&str, &FalseAlarms)) -> Option<Row> {
    let (found, healthy) = (delays(people, told, Some(condition), rule), delays(people, told, None, rule));
    let count = found.len();
    let height = people.iter().find(|watched| watched.person.condition == Some(condition))?.person.height;
    let mut delays: Vec<usize> = found.into_iter().flatten().collect();
    delays.sort_unstable();
    let share = |found: usize| found as f64 / count as f64;
    let at =
        |share: f64| delays.get(((delays.len().max(1) - 1) as f64 * share).round() as usize).map(|&day| day as f64);
    let delay_days = at(0.25).zip(at(0.5)).zip(at(0.75)).map(|((low, middle), high)| [low, middle, high]);
    (count > 0).then(|| Row {
        condition: condition.to_owned(),
        rule: rule.to_owned(),
        people: count,
        sensitivity: share(delays.len()),
        sensitivity_95: wilson(delays.len(), count),
        by_chance: healthy.iter().flatten().count() as f64 / healthy.len().max(1) as f64,
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
    use homebody_analysis::measures::Measures;
    use homebody_placement::adequacy::Person;

    const OF_GRIEF: Person = Person { condition: Some("grief"), onset: 60, height: 28 };
    const OF_NONE: Person = Person { condition: None, ..OF_GRIEF };

    #[test]
    fn alerts_after_the_beginning_count_and_those_before_are_false() {
        let measures = Measures::default();
        let people = [&OF_GRIEF, &OF_GRIEF, &OF_NONE].map(|person| Watched { person, measures: &measures });
        let told = [[30, 70, 80].map(|day| (day, "sleep".to_owned())).to_vec(), vec![], vec![]];
        let idle = false_alarms_of(&people, &told, "sleep");
        assert!((idle.per_week - 1.0 / (2.0 * 45.0 / 7.0)).abs() < 1e-9, "{idle:?}");
        let row = row(&people, &told, "grief", ("sleep", &idle)).unwrap();
        assert_eq!((row.people, row.sensitivity, row.by_chance), (2, 0.5, 0.0));
        assert_eq!((row.delay_days, row.lead_days), (Some([10.0; 3]), Some(18.0)));
        assert_eq!(row.within[..2], [(7, 0.0), (14, 0.5)]);
    }

    #[test]
    fn a_layout_is_later_by_the_mean_difference_of_its_people() {
        let never = adequacy(&[], &serde_json::from_str(r#"{ "rules": [] }"#).unwrap());
        let [soon, late] = [4.0, 28.0].map(|days| Adequacy { by_person: vec![days], ..never.clone() });
        assert_eq!(later(&soon, &late), (24.0, [24.0, 24.0]));
    }

    #[test]
    fn an_interval_of_a_share_is_wilsons() {
        let [low, high] = wilson(8, 10);
        assert!((low - 0.490).abs() < 1e-3 && (high - 0.943).abs() < 1e-3, "{low} {high}");
    }
}
