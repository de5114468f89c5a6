//! The long lie, by passive sensors alone: somebody moved where nobody rests, and nothing has moved since.
//!
//! Who lies on the floor and cannot rise moves little. A rule of two times is all there is to it: how long nothing has moved, and
//! how long somebody has to have moved elsewhere after they were in a bed or on a seat. Whoever was in one last is still there;
//! whoever used the door to the outside last is out.
//!
//! We assume that one person lives there.
//!
//! Left out: learning how long somebody keeps still at which hour and in which room.

use super::passive::{PassiveMeaning, PassiveMessage};
use homebody_core::time::{RunTime, Span};
use serde::{Deserialize, Serialize};

/// When a lie is long.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LongLieRule {
    /// Nothing has moved for so long, in seconds.
    pub quiet_s: f64,
    /// Who moves elsewhere so long after they moved in a bed or on a seat, or used the door, has left it, in seconds: sensors of the
    /// room see who stirs on a seat, too.
    pub leaves_s: f64,
}

impl Default for LongLieRule {
    /// Both are ours, and fitted to nothing.
    fn default() -> LongLieRule {
        LongLieRule { quiet_s: 1200.0, leaves_s: 10.0 }
    }
}

/// Somebody who has kept still too long.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LongLie {
    /// The last movement.
    pub since: RunTime,
    /// When it had been quiet for long enough.
    pub alarm_at: RunTime,
}

/// The long lies in messages that are in order of time, until an instant.
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
    fn who_moves_and_then_no_more_lies_somewhere() {
        assert_eq!(alarms(&[(0, MOVED), (8, MOVED)], 3600), [1208]);
        assert_eq!(alarms(&[(0, MOVED), (8, MOVED)], 1200), NEVER);
        assert_eq!(alarms(&[(0, MOVED), (1000, MOVED), (2000, MOVED)], 3000), NEVER);
    }

    #[test]
    fn who_was_in_a_bed_or_on_a_seat_last_or_at_the_door_is_there_or_out() {
        assert_eq!(alarms(&[(0, MOVED), (8, STIRRED)], 3600), NEVER);
        // The room's sensor sees who stirs on the seat.
        assert_eq!(alarms(&[(0, MOVED), (8, STIRRED), (9, MOVED)], 3600), NEVER);
        assert_eq!(alarms(&[(0, STIRRED), (20, MOVED)], 3600), [1220]);
        assert_eq!(alarms(&[(0, MOVED), (8, PassiveMeaning::Door)], 3600), NEVER);
        assert_eq!(alarms(&[(0, MOVED), (8, PassiveMeaning::Rests)], 3600), NEVER);
        assert_eq!(alarms(&[(0, PassiveMeaning::Rests), (8, PassiveMeaning::Rises)], 3600), [1208]);
    }
}
