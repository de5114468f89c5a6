//! The quality of alerts: their sensitivity, their delay, and their rate of false alarms.
//!
//! People differ as in a cohort. Each person has no condition, or one from a known day on, which grows as such conditions do. The
//! alerts from each log are compared with that day. An alert before it is a false alarm, and so is any alert of a person without a
//! condition. Lead is counted back from the day of the full effect.

pub mod people;

use homebody_analysis::alerts::{AlertMethod, AlertRule, Rules};
use homebody_placement::adequacy::{
    Adequacy, Alerts, FalseAlarmCount, WITHIN, Watched, Z, adequacy, alerts_of, conditions, delays, false_alarms, mean,
    swept,
};
use serde::Serialize;

/// Days after the onset for which the sensitivity is printed.
const AFTER: [usize; 4] = [7, 14, 28, 56];

#[derive(Clone, Debug, Serialize)]
pub struct AlertQuality {
    pub people: usize,
    pub days: u32,
    /// A row for each condition and each rule with an alert after the onset; the rule `any` is all rules together.
    pub rows: Vec<AlertsRow>,
    /// False alarms by rule.
    pub false_alarms: Vec<RuleFalseAlarms>,
    /// For each condition, all rules together with other thresholds.
    pub curves: Vec<AlertCurve>,
    pub methods: Vec<MethodQuality>,
}

/// The result if all control charts use one method.
#[derive(Clone, Debug, Serialize)]
pub struct MethodQuality {
    pub method: &'static str,
    /// The delay until people are found, with at most a given number of false alarms.
    #[serde(flatten)]
    pub adequacy: Adequacy,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AlertsRow {
    pub condition: String,
    /// The rule's name, or `any`.
    pub rule: String,
    pub people: usize,
    /// The share of people with an alert between the onset and the end; the interval of 95 % is that of Wilson (1927).
    pub sensitivity: f64,
    pub sensitivity_95: [f64; 2],
    /// The share of people without a condition who have an alert in the same days: the effect of chance.
    pub by_chance: f64,
    /// The share of people with an alert within a number of days after the onset.
    pub within: Vec<(usize, f64)>,
    /// Days from the onset to the first alert of people who have one: quartile, median, quartile.
    pub delay_days: Option<[f64; 3]>,
    /// Median of the days from the first alert to the full effect of the condition.
    pub lead_days: Option<f64>,
    pub false_alarms_per_week: f64,
    pub false_alarms_95: [f64; 2],
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RuleFalseAlarms {
    /// The rule's name, or `any`.
    pub rule: String,
    pub per_week: f64,
    /// The interval of 95 %.
    pub per_week_95: [f64; 2],
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AlertCurve {
    pub condition: String,
    /// By number of standard deviations.
    pub points: Vec<CurvePoint>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CurvePoint {
    /// The number of standard deviations, for all rules.
    pub k_sd: f64,
    /// The share of those with the condition who are found within 28 days.
    pub sensitivity: f64,
    pub false_alarms_per_week: f64,
}

pub fn quality(people: &[Watched], rules: &Rules, days: u32) -> AlertQuality {
    let alerts: Vec<Alerts> = people.iter().map(|watched| alerts_of(watched.measures, rules)).collect();
    let mut names: Vec<&str> = rules.rules.iter().map(|rule| rule.name.as_str()).collect();
    names.extend(["several", "any"]);
    let conditions = conditions(people);
    let false_alarms: Vec<RuleFalseAlarms> = names.iter().map(|rule| false_alarms_of(people, &alerts, rule)).collect();
    let mut rows = Vec::new();
    for condition in &conditions {
        for (rule, idle) in names.iter().zip(&false_alarms) {
            let row = row(people, &alerts, condition, (rule, idle));
            rows.extend(row.filter(|row| row.sensitivity > 0.0));
        }
    }
    let swept: Vec<(f64, Vec<Alerts>)> = swept(people, rules).collect();
    let curve = |condition: &&'static str| AlertCurve {
        condition: (*condition).to_owned(),
        points: swept.iter().map(|(k_sd, alerts)| point(people, alerts, *k_sd, Some(condition))).collect(),
    };
    let curves = conditions.iter().map(curve).collect();
    let methods = METHODS.map(|(name, method)| {
        let charts = rules.rules.iter().filter(|rule| rule.method != AlertMethod::Deviation);
        let rules = charts.map(|rule| AlertRule { method, ..rule.clone() }).collect();
        MethodQuality { method: name, adequacy: adequacy(people, &Rules { rules, several: None }) }
    });
    AlertQuality { people: people.len(), days, rows, false_alarms, curves, methods: methods.into() }
}

/// The methods that are compared.
const METHODS: [(&str, AlertMethod); 3] =
    [("deviation", AlertMethod::Deviation), ("ewma", AlertMethod::Ewma), ("cusum", AlertMethod::Cusum)];

fn point(people: &[Watched], alerts: &[Alerts], k_sd: f64, condition: Option<&str>) -> CurvePoint {
    let firsts = delays(people, alerts, condition, "any");
    let found = firsts.iter().flatten().filter(|&&delay| delay < WITHIN).count();
    let false_alarms_per_week = false_alarms(people, alerts, "any").per_week();
    CurvePoint { k_sd, sensitivity: found as f64 / firsts.len().max(1) as f64, false_alarms_per_week }
}

/// Mean number of days by which another layout finds the same people later, with the interval of 95 %.
pub fn later(than: &Adequacy, by: &Adequacy) -> (f64, [f64; 2]) {
    let apart: Vec<f64> = by.by_person.iter().zip(&than.by_person).map(|(by, than)| by - than).collect();
    let middle = mean(&apart);
    let squares: Vec<f64> = apart.iter().map(|apart| (apart - middle) * (apart - middle)).collect();
    let error = Z * (mean(&squares) / apart.len().max(1) as f64).sqrt();
    (middle, [middle - error, middle + error])
}

fn false_alarms_of(people: &[Watched], alerts: &[Alerts], rule: &str) -> RuleFalseAlarms {
    let counted = false_alarms(people, alerts, rule);
    let (per_week, FalseAlarmCount { count, weeks }) = (counted.per_week(), counted);
    // Counts as those of Poisson, by the normal law.
    let apart = Z * count.max(1.0).sqrt() / weeks.max(1e-9);
    RuleFalseAlarms { rule: rule.to_owned(), per_week, per_week_95: [(per_week - apart).max(0.0), per_week + apart] }
}

fn row(
    people: &[Watched],
    alerts: &[Alerts],
    condition: &str,
    (rule, idle): (&str, &RuleFalseAlarms),
) -> Option<AlertsRow> {
    let (found, healthy) = (delays(people, alerts, Some(condition), rule), delays(people, alerts, None, rule));
    let count = found.len();
    let height = people.iter().find(|watched| watched.person.condition == Some(condition))?.person.height;
    let mut delays: Vec<usize> = found.into_iter().flatten().collect();
    delays.sort_unstable();
    let share = |found: usize| found as f64 / count as f64;
    let at =
        |share: f64| delays.get(((delays.len().max(1) - 1) as f64 * share).round() as usize).map(|&day| day as f64);
    let delay_days = at(0.25).zip(at(0.5)).zip(at(0.75)).map(|((low, middle), high)| [low, middle, high]);
    (count > 0).then(|| AlertsRow {
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

/// The interval of 95 % of a share (Wilson 1927).
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
    fn alerts_before_the_onset_are_false() {
        let measures = Measures::default();
        let people = [&OF_GRIEF, &OF_GRIEF, &OF_NONE].map(|person| Watched { person, measures: &measures });
        let alerts = [[30, 70, 80].map(|day| (day, "sleep".to_owned())).to_vec(), vec![], vec![]];
        let idle = false_alarms_of(&people, &alerts, "sleep");
        assert!((idle.per_week - 1.0 / (2.0 * 45.0 / 7.0)).abs() < 1e-9, "{idle:?}");
        let row = row(&people, &alerts, "grief", ("sleep", &idle)).unwrap();
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
