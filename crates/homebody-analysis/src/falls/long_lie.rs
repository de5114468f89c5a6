//! The long lie, by passive sensors alone: somebody moved where nobody rests, and nothing has moved since.
//!
//! Who lies on the floor and cannot rise moves little. A rule of two times is all there is to it: how long nothing has moved, and
//! how long somebody has to have moved elsewhere after they were in a bed or on a seat. Whoever was in one last is still there;
//! whoever used the door to the outside last is out.
//!
//! We assume that one person lives there.
//!
//! Left out: learning how long somebody keeps still at which hour and in which room.

use super::heard::{Heard, HeardAt};
use homebody_core::time::{Micros, micros};
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
    pub since: Micros,
    /// When it had been quiet for long enough.
    pub alarm_at: Micros,
}

/// The long lies in messages that are in order of time, until an instant.
pub fn long_lies(rule: &LongLieRule, heard: &[HeardAt], until: Micros) -> Vec<LongLie> {
    let (quiet, leaves) = (micros(rule.quiet_s), micros(rule.leaves_s));
    let mut lies = Vec::new();
    let (mut rests_since, mut is_felt) = (None::<Micros>, false);
    for (index, &HeardAt { at, heard: message }) in heard.iter().enumerate() {
        match message {
            Heard::Rests => is_felt = true,
            Heard::Rises => is_felt = false,
            Heard::Moved { at_rest: false } if rests_since.is_none_or(|since| at - since >= leaves) => {
                rests_since = None
            }
            Heard::Moved { at_rest: false } => {}
            Heard::Moved { at_rest: true } | Heard::Door => rests_since = Some(at),
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

    const MOVED: Heard = Heard::Moved { at_rest: false };
    const STIRRED: Heard = Heard::Moved { at_rest: true };

    fn alarms(heard: &[(i64, Heard)], until_s: i64) -> Vec<i64> {
        let heard: Vec<HeardAt> = heard.iter().map(|&(at, heard)| HeardAt { at: at * SECOND, heard }).collect();
        let lies = long_lies(&LongLieRule::default(), &heard, until_s * SECOND);
        lies.into_iter().map(|lie| lie.alarm_at / SECOND).collect()
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
        assert_eq!(alarms(&[(0, MOVED), (8, Heard::Door)], 3600), NEVER);
        assert_eq!(alarms(&[(0, MOVED), (8, Heard::Rests)], 3600), NEVER);
        assert_eq!(alarms(&[(0, Heard::Rests), (8, Heard::Rises)], 3600), [1208]);
    }
}
