//! The long lie, by passive sensors alone: a person moved away from places of rest, and nothing has moved since.
//!
//! A person who lies on the floor and cannot rise moves little. The rule has two times: the time without movement, and the time that a
//! person has to have moved elsewhere after they were in a bed or on a seat. A person who was in one last is still there; one who used the
//! door to the outside last is out.
//!
//! We assume that the home has one resident.
//!
//! Left out: learning the usual times without movement by hour and room.

use super::passive::{PassiveMeaning, PassiveMessage};
use homebody_core::time::{RunTime, Span};
use serde::{Deserialize, Serialize};

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LongLieRule {
    /// Time without movement, in seconds.
    pub quiet_s: f64,
    /// Time of movement elsewhere after which a person has left a bed, a seat or the door, in seconds: sensors of the room see a person who
    /// stirs on a seat, too.
    pub leaves_s: f64,
}

impl Default for LongLieRule {
    /// Both are our choice, and fitted to no data.
    fn default() -> LongLieRule {
        LongLieRule { quiet_s: 1200.0, leaves_s: 10.0 }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LongLie {
    pub since: RunTime,
    pub alarm_at: RunTime,
}

/// The long lies in messages in order of time, until an instant.
pub fn long_lies(rule: &LongLieRule, heard: &[PassiveMessage], until: RunTime) -> Vec<LongLie> {
    let [quiet, leaves] = [rule.quiet_s, rule.leaves_s].map(Span::from_seconds);
    let mut lies = Vec::new();
    let (mut rests_since, mut is_felt) = (None::<RunTime>, false);
    for (index, &PassiveMessage { at, heard: message }) in heard.iter().enumerate() {
        match message {
            PassiveMeaning::Rests => is_felt = true,
            PassiveMeaning::Rises => is_felt = false,
            PassiveMeaning::Moved { at_rest: false } if rests_since.is_none_or(|since| at - since >= leaves) => {
                rests_since = None
            }
            PassiveMeaning::Moved { at_rest: false } => {}
            PassiveMeaning::Moved { at_rest: true } | PassiveMeaning::Door => rests_since = Some(at),
        }
        let next = heard.get(index + 1).map_or(until, |next| next.at.min(until));
        if rests_since.is_none() && !is_felt && next - at >= quiet {
            lies.push(LongLie { since: at, alarm_at: at + quiet });
        }
    }
    lies
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::SECOND;

    const NEVER: [i64; 0] = [];

    const MOVED: PassiveMeaning = PassiveMeaning::Moved { at_rest: false };
    const STIRRED: PassiveMeaning = PassiveMeaning::Moved { at_rest: true };

    fn alarms(heard: &[(i64, PassiveMeaning)], until_s: i64) -> Vec<i64> {
        let at = |seconds: i64| RunTime::START + seconds * SECOND;
        let heard: Vec<PassiveMessage> = heard.iter().map(|&(s, heard)| PassiveMessage { at: at(s), heard }).collect();
        let lies = long_lies(&LongLieRule::default(), &heard, at(until_s));
        lies.into_iter().map(|lie| lie.alarm_at.since_zero() / SECOND).collect()
    }

    #[test]
    fn movement_that_stops_is_a_long_lie() {
        assert_eq!(alarms(&[(0, MOVED), (8, MOVED)], 3600), [1208]);
        assert_eq!(alarms(&[(0, MOVED), (8, MOVED)], 1200), NEVER);
        assert_eq!(alarms(&[(0, MOVED), (1000, MOVED), (2000, MOVED)], 3000), NEVER);
    }

    #[test]
    fn rest_and_outings_are_not_long_lies() {
        assert_eq!(alarms(&[(0, MOVED), (8, STIRRED)], 3600), NEVER);
        // The room's sensor sees who stirs on the seat.
        assert_eq!(alarms(&[(0, MOVED), (8, STIRRED), (9, MOVED)], 3600), NEVER);
        assert_eq!(alarms(&[(0, STIRRED), (20, MOVED)], 3600), [1220]);
        assert_eq!(alarms(&[(0, MOVED), (8, PassiveMeaning::Door)], 3600), NEVER);
        assert_eq!(alarms(&[(0, MOVED), (8, PassiveMeaning::Rests)], 3600), NEVER);
        assert_eq!(alarms(&[(0, PassiveMeaning::Rests), (8, PassiveMeaning::Rises)], 3600), [1208]);
    }
}
