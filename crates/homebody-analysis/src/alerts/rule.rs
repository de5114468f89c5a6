//! Rules for alerts, as a file has them.

use crate::measures::{DailyMeasure, MEASURES};
use homebody_core::problem::{Problem, Problems};
use serde::Deserialize;

/// The rules of the documentation, as an example.
#[cfg(test)]
pub const EXAMPLE: &str = include_str!("rules.json");

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with \"rules\", a list of rules")]
pub struct Rules {
    pub rules: Vec<AlertRule>,
    pub several: Option<Several>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a rule: an object with name, measure and when")]
pub struct AlertRule {
    pub name: String,
    pub measure: String,
    pub when: AlertDirection,
    #[serde(default)]
    pub method: AlertMethod,
    /// Number of standard deviations from the mean.
    #[serde(default = "three")]
    pub k_sd: f64,
    /// The standard deviation is taken to be at least so large, in the measure's unit.
    #[serde(default)]
    pub least_sd: f64,
    /// The usual is that of so many days before; those that do not count are passed over, not replaced.
    #[serde(default = "fourteen")]
    pub baseline_days: usize,
    /// Number of days that count below which there are no usual values.
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

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with at_least and k_sd")]
pub struct Several {
    /// So many measures of the rules on one day.
    pub at_least: usize,
    /// Each by so many standard deviations.
    pub k_sd: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AlertDirection {
    More,
    Less,
    Either,
}

/// A method of comparing a day with those before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AlertMethod {
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

homebody_core::messages! {
    /// Problems with rules of alerts.
    #[derive(Clone, PartialEq, Eq)]
    pub enum AlertRuleMessage in "alert-rule" {
        /// A file of rules is JSON with a list of rules:
        ///
        /// ```json
        /// { "rules": [{ "name": "nights", "measure": "bathroom_night", "when": "more" }] }
        /// ```
        Form { why: String } error "invalid" ("cannot parse the alert rules: {why}")
            hint ("write only keys that docs/reference/measures.md lists");
        /// An alert names its rule, so each rule has a name of its own.
        SameName { rule: String } error "same-name" ("two rules have the name {rule:?}")
            hint ("give each rule its own name");
        /// A rule compares one measure of days with those before.
        UnknownMeasure { rule: String, measure: String, known: Vec<String> } error "unknown-measure"
            ("the rule {rule:?} names an unknown measure, {measure:?}")
            hint ("the measures are {}", known.join(", "));
        /// The keys of a rule have limits: a number outside of them would never raise an alert, or raise one each day.
        Range { rule: String, key: &'static str, allowed: &'static str, example: &'static str } error "out-of-range"
            ("the rule {rule:?}: {key} must be {allowed}")
            hint ("write a number such as {example}");
        /// The part `several` raises an alert when several measures differ on the same day. Its keys have limits.
        Several { key: &'static str, allowed: &'static str, example: &'static str } error "several"
            ("in \"several\", {key} must be {allowed}")
            hint ("write a number such as {example}");
    }
}

impl Rules {
    pub fn read(text: &str) -> Result<Rules, Problems> {
        let unread =
            |error: serde_json::Error| Problems(vec![AlertRuleMessage::Form { why: error.to_string() }.into()]);
        let rules: Rules = serde_json::from_str(text).map_err(unread)?;
        let mut problems: Vec<AlertRuleMessage> = rules.rules.iter().flat_map(AlertRule::problems).collect();
        let twice = rules.rules.iter().enumerate().filter(|(number, rule)| {
            rules.rules[..*number].iter().filter(|other| other.name == rule.name).count() == 1
        });
        problems.extend(twice.map(|(_, rule)| AlertRuleMessage::SameName { rule: rule.name.clone() }));
        problems.extend(rules.several.iter().flat_map(Several::problems));
        match problems.is_empty() {
            true => Ok(rules),
            false => Err(Problems(problems.into_iter().map(Problem::from).collect())),
        }
    }
}

impl Several {
    fn problems(&self) -> Vec<AlertRuleMessage> {
        let mut problems = Vec::new();
        if self.at_least < 2 {
            problems.push(AlertRuleMessage::Several { key: "at_least", allowed: "2 or more", example: "3" });
        }
        if !(self.k_sd > 0.0 && self.k_sd <= 100.0) {
            problems.push(AlertRuleMessage::Several { key: "k_sd", allowed: "above 0 and at most 100", example: "2" });
        }
        problems
    }
}

impl AlertRule {
    pub fn measure(&self) -> Option<(usize, &'static DailyMeasure)> {
        MEASURES.iter().enumerate().find(|(_, measure)| measure.name == self.measure)
    }

    fn problems(&self) -> Vec<AlertRuleMessage> {
        let mut problems = Vec::new();
        if self.measure().is_none() {
            problems.push(AlertRuleMessage::UnknownMeasure {
                rule: self.name.clone(),
                measure: self.measure.clone(),
                known: MEASURES.iter().map(|measure| measure.name.to_owned()).collect(),
            });
        }
        let mut range = |is_right: bool, key, allowed, example| {
            if !is_right {
                problems.push(AlertRuleMessage::Range { rule: self.name.clone(), key, allowed, example });
            }
        };
        range(self.k_sd > 0.0 && self.k_sd <= 100.0, "k_sd", "above 0 and at most 100", "3");
        range(self.least_sd >= 0.0 && self.least_sd.is_finite(), "least_sd", "0 or more", "0.5");
        range((2..=366).contains(&self.baseline_days), "baseline_days", "from 2 to 366", "14");
        range((2..=self.baseline_days.max(2)).contains(&self.min_days), "min_days", "from 2 to baseline_days", "7");
        range((1..=60).contains(&self.days), "days", "from 1 to 60", "2");
        range(self.smoothing > 0.0 && self.smoothing <= 1.0, "smoothing", "above 0 and at most 1", "0.2");
        range((0.0..=10.0).contains(&self.slack_sd), "slack_sd", "from 0 to 10", "0.5");
        problems
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_usual_rules_are_well_formed() {
        assert!(Rules::read(EXAMPLE).is_ok_and(|rules| rules.rules.len() > 10 && rules.several.is_some()));
    }

    #[test]
    fn reports_all_problems_of_rules_at_once() {
        let text = r#"{ "rules": [
            { "name": "a", "measure": "meels", "when": "less", "k_sd": -1 },
            { "name": "b", "measure": "meals", "when": "less", "smoothing": 2, "min_days": 30 }
        ] }"#;
        let Problems(problems) = Rules::read(text).unwrap_err();
        let range = "alert-rule::out-of-range";
        assert_eq!(codes(&problems), ["alert-rule::unknown-measure", range, range, range]);
        assert!(problems[0].hint.as_ref().unwrap().contains("meals"), "{problems:?}");
        for (text, why) in [(r#"{ "rules": [], "many": 1 }"#, "many"), ("[]", "an object with \"rules\"")] {
            let Problems(problems) = Rules::read(text).unwrap_err();
            assert_eq!(codes(&problems), ["alert-rule::invalid"]);
            assert!(problems[0].data["why"].as_str().unwrap().contains(why), "{problems:?}");
        }
    }

    fn codes(problems: &[Problem]) -> Vec<&'static str> {
        problems.iter().map(|problem| problem.code).collect()
    }

    #[test]
    fn rejects_rules_with_one_name_and_several_of_less_than_two() {
        let text = r#"{ "rules": [
            { "name": "a", "measure": "meals", "when": "less" },
            { "name": "a", "measure": "sleep", "when": "less" },
            { "name": "a", "measure": "sleep", "when": "more" }
        ], "several": { "at_least": 0, "k_sd": 0 } }"#;
        let Problems(problems) = Rules::read(text).unwrap_err();
        assert_eq!(codes(&problems), ["alert-rule::same-name", "alert-rule::several", "alert-rule::several"]);
        assert_eq!(problems[0].data["rule"], "a");
        assert_eq!([&problems[1], &problems[2]].map(|problem| problem.data["key"].clone()), ["at_least", "k_sd"]);
    }
}
