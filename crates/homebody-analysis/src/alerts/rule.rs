//! Rules for alerts, as a file has them.

use crate::measures::{MEASURES, Measure};
use serde::Deserialize;

/// The rules that hold where nobody says others.
pub const USUAL: &str = include_str!("rules.json");

/// A file of rules.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with \"rules\", a list of rules")]
pub struct Rules {
    /// One measure each.
    pub rules: Vec<Rule>,
    /// Several measures at once; without it nothing is said of these.
    pub several: Option<Several>,
}

/// When a measure is worth an alert.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a rule: an object with name, measure and when")]
pub struct Rule {
    /// What the alert is called.
    pub name: String,
    /// The measure's name.
    pub measure: String,
    /// Whether it is one if there is more than usual, less, or either.
    pub when: When,
    /// How a day is held against those before.
    #[serde(default)]
    pub method: Method,
    /// How many standard deviations from the mean.
    #[serde(default = "three")]
    pub k_sd: f64,
    /// The standard deviation is taken to be at least so large, in the measure's unit.
    #[serde(default)]
    pub least_sd: f64,
    /// The usual is that of so many days before; those that do not count are passed over, not replaced.
    #[serde(default = "fourteen")]
    pub baseline_days: usize,
    /// With fewer of them that count there is no usual.
    #[serde(default = "seven")]
    pub min_days: usize,
    /// On so many days in a row, for the method `deviation`.
    #[serde(default = "one")]
    pub days: usize,
    /// The weight of the newest day, for the method `ewma`.
    #[serde(default = "fifth")]
    pub smoothing: f64,
    /// So many standard deviations from the mean a day may be and adds nothing, for the method `cusum`.
    #[serde(default = "half")]
    pub slack_sd: f64,
}

/// Several measures at once.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with at_least and k_sd")]
pub struct Several {
    /// So many measures of the rules on one day.
    pub at_least: usize,
    /// Each by so many standard deviations.
    pub k_sd: f64,
}

/// Which difference counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum When {
    /// More than usual.
    More,
    /// Less than usual.
    Less,
    /// Both.
    Either,
}

/// How a day is held against those before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// Against mean and standard deviation of the days before, as in US patents 10188295 and 11147451.
    #[default]
    Deviation,
    /// An exponentially weighted moving average against its control limits (Roberts 1959; Lucas and Saccucci 1990), which begins
    /// anew after three days of alarm.
    Ewma,
    /// Cumulative sums of how far days are from the mean (Page 1954), which find since when it is so: a change point. The limit,
    /// in standard deviations, is `k_sd`.
    Cusum,
}

// The window is that of two weeks in the Missouri systems, and the least number of days half of it, which is ours.
pub(super) fn fourteen() -> usize {
    14
}

pub(super) fn seven() -> usize {
    7
}

fn one() -> usize {
    1
}

fn three() -> f64 {
    3.0
}

// Half of a change by one standard deviation, for which the sums are the soonest (Page 1954; Montgomery 2009).
fn half() -> f64 {
    0.5
}

fn fifth() -> f64 {
    0.2
}

impl Rules {
    /// Of a file's text; all that is wrong with it, else.
    ///
    /// # Errors
    ///
    /// A sentence for each problem.
    pub fn read(text: &str) -> Result<Rules, Vec<String>> {
        let rules: Rules = serde_json::from_str(text).map_err(|error| vec![error.to_string()])?;
        let mut problems: Vec<String> = rules.rules.iter().flat_map(Rule::problems).collect();
        let twice = rules.rules.iter().enumerate().filter(|(number, rule)| {
            rules.rules[..*number].iter().filter(|other| other.name == rule.name).count() == 1
        });
        problems.extend(twice.map(|(_, rule)| format!("two rules are called {:?}: give each its own name", rule.name)));
        problems.extend(rules.several.iter().flat_map(Several::problems));
        if problems.is_empty() { Ok(rules) } else { Err(problems) }
    }
}

impl Several {
    fn problems(&self) -> Vec<String> {
        let mut problems = Vec::new();
        if self.at_least < 2 {
            problems.push("several: at_least has to be 2 or more, such as 3".to_owned());
        }
        if !(self.k_sd > 0.0 && self.k_sd <= 100.0) {
            problems.push("several: k_sd has to be above 0 and at most 100, such as 2".to_owned());
        }
        problems
    }
}

impl Rule {
    /// The measure that it is about.
    pub fn measure(&self) -> Option<(usize, &'static Measure)> {
        MEASURES.iter().enumerate().find(|(_, measure)| measure.name == self.measure)
    }

    fn problems(&self) -> Vec<String> {
        let mut problems = Vec::new();
        let mut wrong = |is_wrong: bool, what: String| {
            if is_wrong {
                problems.push(format!("the rule {:?}: {what}", self.name));
            }
        };
        let known: Vec<&str> = MEASURES.iter().map(|measure| measure.name).collect();
        wrong(
            self.measure().is_none(),
            format!("there is no measure {:?}\n  hint: the measures are {}", self.measure, known.join(", ")),
        );
        wrong(!(self.k_sd > 0.0 && self.k_sd <= 100.0), "k_sd has to be above 0 and at most 100, such as 3".into());
        wrong(!(self.least_sd >= 0.0 && self.least_sd.is_finite()), "least_sd must not be below 0".into());
        wrong(!(2..=366).contains(&self.baseline_days), "baseline_days has to be from 2 to 366, such as 14".into());
        wrong(
            !(2..=self.baseline_days.max(2)).contains(&self.min_days),
            "min_days has to be from 2 to baseline_days, such as 7".into(),
        );
        wrong(!(1..=60).contains(&self.days), "days has to be from 1 to 60, such as 2".into());
        wrong(
            !(self.smoothing > 0.0 && self.smoothing <= 1.0),
            "smoothing has to be above 0 and at most 1, such as 0.2".into(),
        );
        wrong(!(0.0..=10.0).contains(&self.slack_sd), "slack_sd has to be from 0 to 10, such as 0.5".into());
        problems
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_usual_rules_are_well_formed() {
        assert!(Rules::read(USUAL).is_ok_and(|rules| rules.rules.len() > 10 && rules.several.is_some()));
    }

    #[test]
    fn all_that_is_wrong_is_told_at_once() {
        let text = r#"{ "rules": [
            { "name": "a", "measure": "meels", "when": "less", "k_sd": -1 },
            { "name": "b", "measure": "meals", "when": "less", "smoothing": 2, "min_days": 30 }
        ] }"#;
        let problems = Rules::read(text).unwrap_err();
        assert_eq!(problems.len(), 4, "{problems:?}");
        assert!(problems[0].contains("meals"), "{problems:?}");
        assert!(Rules::read(r#"{ "rules": [], "many": 1 }"#).unwrap_err()[0].contains("many"));
        assert!(Rules::read("[]").unwrap_err()[0].contains("an object with \"rules\""));
    }

    #[test]
    fn a_name_is_of_one_rule_and_several_are_two_or_more() {
        let text = r#"{ "rules": [
            { "name": "a", "measure": "meals", "when": "less" },
            { "name": "a", "measure": "sleep", "when": "less" },
            { "name": "a", "measure": "sleep", "when": "more" }
        ], "several": { "at_least": 0, "k_sd": 0 } }"#;
        let problems = Rules::read(text).unwrap_err();
        assert_eq!(problems.len(), 3, "{problems:?}");
        assert!(problems[0].contains("\"a\"") && problems[1].contains("at_least") && problems[2].contains("k_sd"));
    }
}
