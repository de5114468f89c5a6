//! Silhouettes and passive sensors together.
//!
//! What silhouettes are sure of is told at once. What they doubt is told once passive sensors have been quiet for a while: who
//! kneels, bends or exercises moves on, who has fallen often does not.
//!
//! Cameras look on for a while after the last movement, and sleep then. Whoever they saw on the floor last lies there as long as
//! nothing moves: that is told sooner than a long lie of which passive sensors tell alone. Such a one is told unless cameras saw
//! somebody off the floor after the last movement: who has fallen lies on the floor by then, or out of their sight.
//!
//! A fall is told once: not again until somebody has been seen off the floor.
//!
//! Left out: weighing one word against another by how often each was wrong.

use super::long_lie::{LongLie, LongLieRule, long_lies};
use super::passive::{PassiveMeaning, PassiveMessage};
use super::rules::FallState;
use super::scenes::CameraSighting;
use super::watch::Fall;
use homebody_core::time::{RunTime, Span};
use serde::{Deserialize, Serialize};

/// How words of both are put together.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fusion {
    /// What silhouettes are so sure of is told at once, from 0 to 1.
    pub sure: f64,
    /// What they are less sure of than this is not heard at all.
    pub doubtful: f64,
    /// What they doubt is told if nothing moves for so long, in seconds.
    pub still_s: f64,
    /// Who was seen on the floor last is told of if nothing moves for so long after that, in seconds.
    pub floor_s: f64,
    /// Who is seen off the floor so long after the last movement has not fallen with it, in seconds.
    pub fallen_s: f64,
    /// When passive sensors tell of somebody alone.
    pub long_lie: LongLieRule,
}

impl Default for Fusion {
    /// All are ours, and fitted to nothing.
    fn default() -> Fusion {
        Fusion {
            sure: 0.75,
            doubtful: 0.25,
            still_s: 60.0,
            floor_s: 120.0,
            fallen_s: 5.0,
            long_lie: LongLieRule::default(),
        }
    }
}

/// What silhouettes and passive sensors have told.
#[derive(Clone, Copy, Debug)]
pub struct FallEvidence<'a> {
    /// Falls by silhouettes.
    pub falls: &'a [Fall],
    /// When somebody was seen, and how they were held to be, in order of time.
    pub sightings: &'a [CameraSighting],
    /// What passive sensors said, in order of time.
    pub heard: &'a [PassiveMessage],
    /// Until when.
    pub until: RunTime,
}

/// When both together tell of a fall, in order of time.
pub fn fused(fusion: &Fusion, told: &FallEvidence) -> Vec<RunTime> {
    let [still, floor, fallen] = [fusion.still_s, fusion.floor_s, fusion.fallen_s].map(Span::from_seconds);
    let by_silhouettes = told.falls.iter().filter_map(|fall| match fall.confidence {
        sure if sure >= fusion.sure => Some(fall.alarm_at),
        doubtful if doubtful >= fusion.doubtful && told.is_still(fall.alarm_at, still) => Some(fall.alarm_at + still),
        _ => None,
    });
    let on_the_floor = told.sightings.iter().enumerate().filter(|(index, seen)| {
        let next = told.sightings.get(index + 1);
        let is_last = next.is_none_or(|next| next.at > seen.at + floor);
        seen.state == FallState::OnTheGround && is_last && told.is_still(seen.at, floor)
    });
    let is_seen_up = |lie: &LongLie| {
        let last = told.seen_by(lie.alarm_at).last();
        last.is_some_and(|seen| seen.at >= lie.since + fallen && seen.state != FallState::OnTheGround)
    };
    let lies = long_lies(&fusion.long_lie, told.heard, told.until);
    let mut quiet: Vec<RunTime> = on_the_floor.map(|(_, seen)| seen.at + floor).collect();
    quiet.extend(lies.iter().filter(|lie| !is_seen_up(lie)).map(|lie| lie.alarm_at));
    quiet.sort_unstable();
    let mut alarms: Vec<RunTime> = by_silhouettes.collect();
    for at in quiet {
        let up = told.seen_by(at).iter().rev().find(|seen| seen.state != FallState::OnTheGround);
        let is_told = up.is_some_and(|up| alarms.iter().any(|alarm| (up.at..=at).contains(alarm)));
        if !is_told {
            alarms.push(at);
        }
    }
    alarms.sort_unstable();
    alarms
}

impl FallEvidence<'_> {
    /// The sightings up to an instant.
    fn seen_by(&self, at: RunTime) -> &[CameraSighting] {
        &self.sightings[..self.sightings.partition_point(|seen| seen.at <= at)]
    }

    /// Whether nothing moves for so long from an instant on, as far as is known.
    fn is_still(&self, from: RunTime, long: Span) -> bool {
        let first = self.heard.partition_point(|heard| heard.at <= from);
        let next = self.heard[first..]
            .iter()
            .find(|heard| matches!(heard.heard, PassiveMeaning::Moved { .. } | PassiveMeaning::Door));
        from + long <= self.until && next.is_none_or(|next| next.at > from + long)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::SECOND;

    const NEVER: [i64; 0] = [];

    fn at(seconds: i64) -> RunTime {
        RunTime::START + seconds * SECOND
    }

    fn fall(at_s: i64, confidence: f64) -> Fall {
        let at = at(at_s);
        Fall { at, alarm_at: at, at_m: [0.0, 0.0], rule: "rule".into(), confidence }
    }

    fn moved(at_s: i64) -> PassiveMessage {
        PassiveMessage { at: at(at_s), heard: PassiveMeaning::Moved { at_rest: false } }
    }

    fn alarms(falls: &[Fall], sightings: &[CameraSighting], heard: &[PassiveMessage]) -> Vec<i64> {
        let told = FallEvidence { falls, sightings, heard, until: at(3000) };
        fused(&Fusion::default(), &told).into_iter().map(|at| at.since_zero() / SECOND).collect()
    }

    #[test]
    fn what_is_sure_is_told_at_once_and_what_is_doubtful_once_nothing_moves() {
        let busy: Vec<PassiveMessage> = (0..300).map(|step| moved(step * 10)).collect();
        assert_eq!(alarms(&[fall(100, 0.9)], &[], &busy), [100]);
        assert_eq!(alarms(&[fall(100, 0.5)], &[], &busy), NEVER);
        assert_eq!(alarms(&[fall(100, 0.1)], &[], &[moved(2990)]), NEVER);
        assert_eq!(alarms(&[fall(100, 0.5)], &[], &[moved(90), moved(200), moved(1000), moved(2000)]), [160]);
    }

    #[test]
    fn a_long_lie_is_told_unless_cameras_saw_somebody_off_the_floor_after_the_last_movement() {
        let seen = |at_s: i64, state| CameraSighting { at: at(at_s), state };
        let then = |sightings: &[CameraSighting]| alarms(&[], sightings, &[moved(100)]);
        assert_eq!(then(&[]), [1300]);
        assert_eq!(then(&[seen(115, FallState::Upright)]), NEVER);
        assert_eq!(then(&[seen(115, FallState::InBetween)]), NEVER);
        // Out of sight with the last movement, or seen only after it was told.
        assert_eq!(then(&[seen(101, FallState::Upright)]), [1300]);
        assert_eq!(then(&[seen(1400, FallState::Upright)]), [1300]);
    }

    #[test]
    fn who_was_seen_on_the_floor_last_is_told_of_soon_and_once() {
        let seen = |at_s: i64, state| CameraSighting { at: at(at_s), state };
        let (up, down) = (FallState::Upright, FallState::OnTheGround);
        let lies = [seen(90, up), seen(101, down), seen(115, down)];
        assert_eq!(alarms(&[], &lies, &[moved(100)]), [235]);
        // Told by silhouettes already.
        assert_eq!(alarms(&[fall(105, 0.9)], &lies, &[moved(100)]), [105]);
        // Who stirs is told of once they keep still, who gets up is not.
        assert_eq!(alarms(&[], &[&lies[..], &[seen(215, down)]].concat(), &[moved(100), moved(200)]), [335]);
        assert_eq!(alarms(&[], &[&lies[..], &[seen(150, up)]].concat(), &[moved(100), moved(139)]), NEVER);
    }
}
