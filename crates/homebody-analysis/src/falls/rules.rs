//! The fuzzy rules: what high, low and upright mean, and what follows from them. They are read from JSON and written as JSON.
//!
//! The numbers are ours. Those of Anderson et al. 2009 were made with nurses and are not published whole.

use super::Shape;
use homebody_core::fuzzy::Fuzzy;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// How somebody is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum State {
    /// On the feet.
    Upright,
    /// Sitting, kneeling, bending, or lying on a bed.
    InBetween,
    /// On the floor.
    OnTheGround,
}

/// How far somebody is in each state, from 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Memberships {
    /// On the feet.
    pub upright: f64,
    /// In between.
    pub in_between: f64,
    /// On the floor.
    pub on_the_ground: f64,
}

impl Memberships {
    /// How far somebody is in a state.
    pub fn of(&self, state: State) -> f64 {
        match state {
            State::Upright => self.upright,
            State::InBetween => self.in_between,
            State::OnTheGround => self.on_the_ground,
        }
    }

    fn of_mut(&mut self, state: State) -> &mut f64 {
        match state {
            State::Upright => &mut self.upright,
            State::InBetween => &mut self.in_between,
            State::OnTheGround => &mut self.on_the_ground,
        }
    }
}

/// A number of a shape that rules speak of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Feature {
    /// How high the middle is, in metres.
    CentroidUpM,
    /// How high the top is, in metres.
    HeightM,
    /// The angle to the vertical, in degrees.
    TiltDeg,
    /// How large it is, in litres.
    VolumeL,
}

impl Feature {
    fn of(self, shape: &Shape) -> f64 {
        match self {
            Feature::CentroidUpM => shape.centroid_up_m,
            Feature::HeightM => shape.height_m,
            Feature::TiltDeg => shape.tilt_deg,
            Feature::VolumeL => shape.volume_l,
        }
    }
}

/// A rule of the first level: who is like this is in this state.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StateRule {
    /// The state that follows.
    pub state: State,
    /// What has to be so: of each feature, one of its terms. The least of them is how far the rule holds.
    #[serde(rename = "if")]
    pub conditions: BTreeMap<Feature, String>,
}

/// A rule of the second level: who is on the ground like this has fallen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FallRule {
    /// What it is called.
    pub name: String,
    /// How long somebody has to be on the ground.
    pub lies_s: f64,
    /// How they were just before, and how many seconds earlier at most; without it, whatever was before.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub before: Option<Before>,
    /// How sure it is at most, from 0 to 1.
    pub confidence: f64,
}

/// How somebody was before they were on the ground.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Before {
    /// The state.
    pub state: State,
    /// How many seconds earlier at most.
    pub within_s: f64,
}

/// All rules.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FallRules {
    /// What words mean: by feature and term, where it begins to hold, where it holds wholly, until where, and where it ends.
    pub terms: BTreeMap<Feature, BTreeMap<String, [f64; 4]>>,
    /// The first level.
    pub states: Vec<StateRule>,
    /// The second level.
    pub falls: Vec<FallRule>,
}

/// The usual rules, as JSON.
pub const USUAL: &str = include_str!("usual.json");

impl Default for FallRules {
    fn default() -> FallRules {
        FallRules::parse(USUAL).expect("the usual rules are checked by a test")
    }
}

impl FallRules {
    /// Rules as a file has them.
    ///
    /// # Errors
    ///
    /// All that is wrong with them, a line each.
    pub fn parse(text: &str) -> Result<FallRules, Vec<String>> {
        let rules: FallRules = serde_json::from_str(text).map_err(|error| vec![error.to_string()])?;
        let wrong = rules.wrong();
        if wrong.is_empty() { Ok(rules) } else { Err(wrong) }
    }

    fn wrong(&self) -> Vec<String> {
        let mut wrong = Vec::new();
        let name = |feature: &Feature| serde_json::to_string(feature).unwrap_or_default();
        for (feature, terms) in &self.terms {
            for (term, numbers) in terms {
                if !numbers.is_sorted() || numbers.iter().any(|number| !number.is_finite()) {
                    wrong.push(format!("{term:?} of {}: its four numbers must not fall", name(feature)));
                }
            }
        }
        for (number, rule) in self.states.iter().enumerate() {
            if rule.conditions.is_empty() {
                wrong.push(format!("rule {} of \"states\" has no \"if\"", number + 1));
            }
            for (feature, term) in &rule.conditions {
                let terms = self.terms.get(feature);
                if terms.is_none_or(|terms| !terms.contains_key(term)) {
                    let known: Vec<&str> = terms.into_iter().flat_map(BTreeMap::keys).map(String::as_str).collect();
                    let known = if known.is_empty() { "none".into() } else { known.join(", ") };
                    let number = number + 1;
                    wrong.push(format!(
                        "rule {number} of \"states\": {} has no term {term:?}; its terms: {known}",
                        name(feature)
                    ));
                }
            }
        }
        for rule in &self.falls {
            let within = rule.before.map_or(0.0, |before| before.within_s);
            if !(0.0..=86_400.0).contains(&rule.lies_s) || !(0.0..=86_400.0).contains(&within) {
                wrong.push(format!("{:?} of \"falls\": times are from 0 to 86400 s", rule.name));
            }
            if !(0.0..=1.0).contains(&rule.confidence) {
                wrong.push(format!("{:?} of \"falls\": \"confidence\" is from 0 to 1", rule.name));
            }
        }
        wrong
    }

    /// How far somebody of this shape is in each state.
    pub fn memberships(&self, shape: &Shape) -> Memberships {
        let mut memberships = Memberships::default();
        for rule in &self.states {
            let holds = |(feature, term): (&Feature, &String)| {
                let [low, from, to, high] = self.terms[feature][term];
                Fuzzy { low, from, to, high }.agreement(feature.of(shape))
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

    fn shape(centroid_up_m: f64, height_m: f64, tilt_deg: f64, volume_l: f64) -> Shape {
        Shape { centroid_up_m, height_m, tilt_deg, volume_l, at_m: [0.0, 0.0] }
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
    fn all_that_is_wrong_with_rules_is_told() {
        let text = r#"{ "terms": { "height_m": { "low": [0, 0.5, 0.4, 1] } },
            "states": [{ "state": "upright", "if": { "height_m": "tall", "tilt_deg": "up" } }, { "state": "upright", "if": {} }],
            "falls": [{ "name": "f", "lies_s": -1, "confidence": 2 }] }"#;
        let wrong = FallRules::parse(text).unwrap_err();
        assert_eq!(wrong.len(), 6, "{wrong:?}");
        assert!(wrong.iter().any(|line| line.contains("no term \"tall\"; its terms: low")), "{wrong:?}");
        assert!(FallRules::parse("{").is_err());
    }

    #[test]
    fn rules_are_written_as_they_are_read() {
        let rules = FallRules::default();
        assert_eq!(FallRules::parse(&serde_json::to_string(&rules).unwrap()).unwrap(), rules);
    }
}
