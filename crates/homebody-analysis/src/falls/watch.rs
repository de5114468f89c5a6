//! The second level: states over time become falls, with a confidence.
//!
//! A person is on the ground from the instant at which that holds more than half, until it has not for a second. The state before is that
//! of the last instant at which another state held more than half.
//!
//! We assume that nothing changes for two seconds without a picture, and that nothing is known after longer.

use super::ShapeAt;
use super::rules::{FallRule, FallRules, FallState, Memberships};
use homebody_core::time::{RunTime, SECOND, Span};
use serde::Serialize;

/// Degree from which a state holds.
const HOLDS: f64 = 0.5;

/// Longest disagreement of pictures about a person on the ground that is ignored (our choice).
const LAPSE: Span = SECOND;

/// Time without a picture after which the previous state is unknown (our choice).
const GAP: Span = SECOND.times(2);

const STATES: [FallState; 3] = [FallState::Upright, FallState::InBetween, FallState::OnTheGround];

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fall {
    /// The begin of the time on the ground.
    pub at: RunTime,
    pub alarm_at: RunTime,
    pub at_m: [f64; 2],
    pub rule: String,
    /// The confidence, from 0 to 1.
    pub confidence: f64,
}

impl Fall {
    pub fn words(&self) -> &'static str {
        match self.confidence {
            sure if sure >= 0.8 => "very likely a fall",
            sure if sure >= 0.6 => "probably a fall",
            sure if sure >= 0.4 => "perhaps a fall",
            _ => "hardly a fall",
        }
    }
}

#[derive(Clone, Debug)]
pub struct FallWatch<'r> {
    rules: &'r FallRules,
    last: Option<RunTime>,
    /// By state, the last time at which it held.
    held_at: [Option<RunTime>; 3],
    ground: Option<Lying>,
    state: Option<FallState>,
}

#[derive(Clone, Debug)]
struct Lying {
    since: RunTime,
    last: RunTime,
    sum: f64,
    pictures: u32,
    /// By state, the time since it held; `None` if it did not, or that is unknown.
    before: [Option<Span>; 3],
    told: f64,
}

impl<'r> FallWatch<'r> {
    pub fn new(rules: &'r FallRules) -> FallWatch<'r> {
        FallWatch { rules, last: None, held_at: [None; 3], ground: None, state: None }
    }

    /// The last state of the person; `None` before anything was sure.
    pub fn state(&self) -> Option<FallState> {
        self.state
    }

    /// Takes the next shape, in order of time. It returns a fall once, and again only if a rule is surer of it.
    pub fn next(&mut self, ShapeAt { at, shape }: &ShapeAt) -> Option<Fall> {
        let at = *at;
        let memberships: Memberships = self.rules.memberships(shape);
        if self.last.is_some_and(|last| at - last > GAP) {
            (self.held_at, self.ground) = ([None; 3], None);
        }
        self.last = Some(at);
        let holds = |state: FallState| memberships.membership(state) >= HOLDS;
        let surest =
            STATES.into_iter().max_by(|&a, &b| memberships.membership(a).total_cmp(&memberships.membership(b)));
        self.state = surest.filter(|&state| holds(state)).or(self.state);
        STATES.into_iter().filter(|&state| holds(state)).for_each(|state| self.held_at[state as usize] = Some(at));
        if !holds(FallState::OnTheGround) {
            if self.ground.as_ref().is_some_and(|lying| at - lying.last > LAPSE) {
                self.ground = None;
            }
            return None;
        }
        let before = self.held_at.map(|then| then.map(|then| at - then));
        let lying = self.ground.get_or_insert(Lying { since: at, last: at, sum: 0.0, pictures: 0, before, told: 0.0 });
        lying.last = at;
        lying.sum += memberships.on_the_ground;
        lying.pictures += 1;
        let lies = at - lying.since;
        let mean = lying.sum / f64::from(lying.pictures);
        let applies = |rule: &&FallRule| {
            let was = rule.before.is_none_or(|before| {
                lying.before[before.state as usize].is_some_and(|then| then <= Span::from_seconds(before.within_s))
            });
            was && lies.seconds() >= rule.lies_s
        };
        let surest = self.rules.falls.iter().filter(applies).max_by(|a, b| a.confidence.total_cmp(&b.confidence))?;
        let confidence = surest.confidence * mean;
        if lying.told > 0.0 && surest.confidence <= lying.told {
            return None;
        }
        lying.told = surest.confidence;
        let rule = surest.name.clone();
        Some(Fall { at: lying.since, alarm_at: at, at_m: shape.at_m, rule, confidence })
    }
}

#[cfg(test)]
mod tests {
    use super::super::BodyShape;
    use super::*;

    fn shape(height_m: f64) -> BodyShape {
        let (centroid_up_m, tilt_deg) = (height_m * 0.55, if height_m < 0.6 { 80.0 } else { 5.0 });
        BodyShape { centroid_up_m, height_m, tilt_deg, volume_l: 100.0, at_m: [1.0, 2.0] }
    }

    /// Falls that are found as a body's height goes through these numbers, five pictures a second.
    fn found(heights: &[(f64, u32)]) -> Vec<Fall> {
        let rules = FallRules::default();
        let (mut watch, mut at, mut found) = (FallWatch::new(&rules), RunTime::START, Vec::new());
        for &(height_m, pictures) in heights {
            for _ in 0..pictures {
                found.extend(watch.next(&ShapeAt { at, shape: shape(height_m) }));
                at += SECOND / 5;
            }
        }
        found
    }

    #[test]
    fn upright_then_on_the_ground_is_a_fall() {
        let falls = found(&[(1.65, 20), (1.0, 3), (0.3, 60)]);
        assert_eq!(falls.len(), 1, "{falls:?}");
        assert_eq!((falls[0].rule.as_str(), falls[0].words()), ("sudden", "very likely a fall"));
        let [at, alarm_at] = [23, 43].map(|pictures| RunTime::START + pictures * SECOND / 5);
        assert_eq!((falls[0].at, falls[0].alarm_at), (at, alarm_at));
    }

    #[test]
    fn lying_down_slowly_is_reported_after_two_minutes() {
        let slowly = [(1.65, 20), (1.0, 15), (0.3, 60)];
        let falls = found(&slowly);
        assert!(falls.iter().all(|fall| fall.rule != "sudden"), "{falls:?}");
        let falls = found(&[(0.3, 700)]);
        assert_eq!(falls.iter().map(|fall| fall.rule.as_str()).collect::<Vec<_>>(), ["lies on the floor"]);
        assert_eq!(falls[0].words(), "perhaps a fall");
    }

    #[test]
    fn ignores_a_moment_on_the_ground() {
        assert_eq!(found(&[(1.65, 20), (0.3, 10), (1.65, 20)]), []);
        assert_eq!(found(&[(1.65, 20), (1.0, 100), (1.65, 20)]), []);
    }
}
