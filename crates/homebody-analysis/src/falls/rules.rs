//! The fuzzy rules: what high, low and upright mean, and what follows from them. They are read from JSON and written as JSON.
//!
//! The numbers are ours. Those of Anderson et al. 2009 were made with nurses and are not published whole.

use super::BodyShape;
use homebody_core::fuzzy::Fuzzy;
use homebody_core::problem::{Problem, Problems};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FallState {
    Upright,
    /// Sitting, kneeling, bending, or lying on a bed.
    InBetween,
    OnTheGround,
}

/// The degree of each state, from 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Memberships {
    pub upright: f64,
    pub in_between: f64,
    pub on_the_ground: f64,
}

impl Memberships {
    pub fn membership(&self, state: FallState) -> f64 {
        match state {
            FallState::Upright => self.upright,
            FallState::InBetween => self.in_between,
            FallState::OnTheGround => self.on_the_ground,
        }
    }

    fn of_mut(&mut self, state: FallState) -> &mut f64 {
        match state {
            FallState::Upright => &mut self.upright,
            FallState::InBetween => &mut self.in_between,
            FallState::OnTheGround => &mut self.on_the_ground,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Feature {
    CentroidUpM,
    HeightM,
    /// The angle to the vertical, in degrees.
    TiltDeg,
    VolumeL,
}

impl Feature {
    fn name(self) -> String {
        serde_json::to_value(self).ok().and_then(|name| name.as_str().map(str::to_owned)).unwrap_or_default()
    }

    fn value(self, shape: &BodyShape) -> f64 {
        match self {
            Feature::CentroidUpM => shape.centroid_up_m,
            Feature::HeightM => shape.height_m,
            Feature::TiltDeg => shape.tilt_deg,
            Feature::VolumeL => shape.volume_l,
        }
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StateRule {
    pub state: FallState,
    /// The conditions: for each feature, one of its terms. The least degree is that of the rule.
    #[serde(rename = "if")]
    pub conditions: BTreeMap<Feature, String>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FallRule {
    pub name: String,
    pub lies_s: f64,
    /// The state just before, if it matters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub before: Option<Before>,
    /// The highest confidence, from 0 to 1.
    pub confidence: f64,
}

/// The state before the ground.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Before {
    pub state: FallState,
    /// The time since that state, in seconds, at most.
    pub within_s: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FallRules {
    /// The terms by feature: the values at which a term begins to hold, holds fully, stops to hold fully, and ends.
    pub terms: BTreeMap<Feature, BTreeMap<String, [f64; 4]>>,
    pub states: Vec<StateRule>,
    pub falls: Vec<FallRule>,
}

/// The usual rules, as JSON.
pub const USUAL: &str = include_str!("usual.json");

impl Default for FallRules {
    fn default() -> FallRules {
        FallRules::parse(USUAL).expect("the usual rules are checked by a test")
    }
}

homebody_core::messages! {
    /// Problems with rules of falls.
    #[derive(Clone, PartialEq, Eq)]
    pub enum FallRuleMessage in "fall-rule" {
        /// A file of rules is JSON with "terms", "states" and "falls". `homebody falls --show-rules` prints the default rules, which are an
        /// example.
        Form { why: String } error "invalid" ("cannot parse the rules of falls: {why}");
        /// The four numbers of a term are the value at which it begins to hold, the values between which it holds wholly, and the value at
        /// which it ends:
        ///
        /// ```json
        /// { "terms": { "height_m": { "low": [0, 0, 0.4, 0.7] } } }
        /// ```
        Unsorted { feature: String, term: String } error "unsorted-term"
            ("the numbers of the term {term:?} of {feature:?} are not in order")
            hint ("write four finite numbers in ascending order; equal numbers are allowed");
        /// A rule of "states" says which terms make a state. Without a term it would hold always.
        NoCondition { rule: usize } error "no-condition" ("rule {rule} of \"states\" has an empty \"if\"")
            hint ("write a feature and one of its terms into \"if\"");
        /// A rule of "states" names the terms that the file declares under "terms".
        UnknownTerm { rule: usize, feature: String, term: String, known: Vec<String> } error "unknown-term"
            ("rule {rule} of \"states\" names the term {term:?}, which {feature:?} does not have")
            advice (Some(match known.is_empty() {
                true => format!("declare the term under \"terms\", where {feature:?} has no terms"),
                false => format!("the terms of {feature:?} are {}", known.join(", ")),
            }));
        /// The times of a rule of "falls" are the least duration on the ground and the longest time since the state before.
        Times { rule: String } error "times" ("the rule {rule:?} of \"falls\" has a time out of range")
            hint ("write times from 0 to 86400 s");
        /// The confidence of a rule of "falls" is a share.
        Confidence { rule: String } error "confidence"
            ("the \"confidence\" of the rule {rule:?} of \"falls\" is out of range")
            hint ("write a number from 0 to 1");
    }
}

impl FallRules {
    pub fn parse(text: &str) -> Result<FallRules, Problems> {
        let unread = |error: serde_json::Error| Problems(vec![FallRuleMessage::Form { why: error.to_string() }.into()]);
        let rules: FallRules = serde_json::from_str(text).map_err(unread)?;
        let wrong = rules.wrong();
        match wrong.is_empty() {
            true => Ok(rules),
            false => Err(Problems(wrong.into_iter().map(Problem::from).collect())),
        }
    }

    fn wrong(&self) -> Vec<FallRuleMessage> {
        let mut wrong = Vec::new();
        for (feature, terms) in &self.terms {
            for (term, numbers) in terms {
                if !numbers.is_sorted() || numbers.iter().any(|number| !number.is_finite()) {
                    wrong.push(FallRuleMessage::Unsorted { feature: feature.name(), term: term.clone() });
                }
            }
        }
        for (rule, number) in self.states.iter().zip(1..) {
            if rule.conditions.is_empty() {
                wrong.push(FallRuleMessage::NoCondition { rule: number });
            }
            for (feature, term) in &rule.conditions {
                let terms = self.terms.get(feature);
                if terms.is_none_or(|terms| !terms.contains_key(term)) {
                    wrong.push(FallRuleMessage::UnknownTerm {
                        rule: number,
                        feature: feature.name(),
                        term: term.clone(),
                        known: terms.into_iter().flat_map(BTreeMap::keys).cloned().collect(),
                    });
                }
            }
        }
        for rule in &self.falls {
            let within = rule.before.map_or(0.0, |before| before.within_s);
            if !(0.0..=86_400.0).contains(&rule.lies_s) || !(0.0..=86_400.0).contains(&within) {
                wrong.push(FallRuleMessage::Times { rule: rule.name.clone() });
            }
            if !(0.0..=1.0).contains(&rule.confidence) {
                wrong.push(FallRuleMessage::Confidence { rule: rule.name.clone() });
            }
        }
        wrong
    }

    pub fn memberships(&self, shape: &BodyShape) -> Memberships {
        let mut memberships = Memberships::default();
        for rule in &self.states {
            let holds = |(feature, term): (&Feature, &String)| {
                let [low, from, to, high] = self.terms[feature][term];
                Fuzzy { low, from, to, high }.agreement(feature.value(shape))
            };
            let least = rule.conditions.iter().map(holds).fold(1.0, f64::min);
            let state = memberships.of_mut(rule.state);
            *state = state.max(least);
        }
        memberships
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn shape(centroid_up_m: f64, height_m: f64, tilt_deg: f64, volume_l: f64) -> BodyShape {
        BodyShape { centroid_up_m, height_m, tilt_deg, volume_l, at_m: [0.0, 0.0] }
    }

    #[test]
    fn the_usual_rules_are_whole_and_know_the_three_states() {
        let rules = FallRules::parse(USUAL).unwrap();
        let of = |shape| rules.memberships(&shape);
        let standing = of(shape(0.9, 1.65, 5.0, 120.0));
        assert!(standing.upright > 0.9 && standing.on_the_ground == 0.0, "{standing:?}");
        let lying = of(shape(0.15, 0.35, 85.0, 120.0));
        assert!(lying.on_the_ground > 0.9 && lying.upright == 0.0, "{lying:?}");
        let kneeling = of(shape(0.6, 1.2, 10.0, 120.0));
        assert!(kneeling.in_between > 0.5 && kneeling.on_the_ground < 0.2, "{kneeling:?}");
        // A cat is as low as who lies, and far smaller.
        assert_eq!(of(shape(0.15, 0.3, 80.0, 6.0)).on_the_ground, 0.0);
    }

    #[test]
    fn reports_all_problems_of_rules() {
        let text = r#"{ "terms": { "height_m": { "low": [0, 0.5, 0.4, 1] } },
            "states": [{ "state": "upright", "if": { "height_m": "tall", "tilt_deg": "up" } }, { "state": "upright", "if": {} }],
            "falls": [{ "name": "f", "lies_s": -1, "confidence": 2 }] }"#;
        let Problems(wrong) = FallRules::parse(text).unwrap_err();
        let codes: Vec<&str> = wrong.iter().filter_map(|problem| problem.code.strip_prefix("fall-rule::")).collect();
        let terms = ["unsorted-term", "unknown-term", "unknown-term", "no-condition"];
        assert_eq!(codes, [&terms[..], &["times", "confidence"]].concat());
        let tall = &wrong[1].data;
        assert_eq!(
            (&tall["feature"], &tall["term"], &tall["known"][0]),
            (&json!("height_m"), &json!("tall"), &json!("low"))
        );
        let Problems(unread) = FallRules::parse("{").unwrap_err();
        assert_eq!(unread[0].code, "fall-rule::invalid");
    }

    #[test]
    fn rules_are_written_as_they_are_read() {
        let rules = FallRules::default();
        assert_eq!(FallRules::parse(&serde_json::to_string(&rules).unwrap()).unwrap(), rules);
    }
}
