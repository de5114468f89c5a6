//! Silhouettes and passive sensors together.
//!
//! A sure fall by silhouettes is reported at once. A doubtful one is reported once passive sensors have been quiet for a while: a person
//! who kneels, bends or exercises moves again, a person who has fallen often does not.
//!
//! Cameras look for a while after the last movement, and sleep then. A person whom they saw on the floor last lies there as long as nothing
//! moves: this fall is reported earlier than a long lie by passive sensors alone. A long lie is reported unless cameras saw the person off
//! the floor after the last movement: by then a fallen person lies on the floor, or out of their sight.
//!
//! A fall is reported once: not again until cameras have seen the person off the floor.
//!
//! Left out: weights for the two sources by their errors.

use super::long_lie::{LongLie, LongLieRule, long_lies};
use super::passive::{PassiveMeaning, PassiveMessage};
use super::rules::FallState;
use super::scenes::CameraSighting;
use super::watch::Fall;
use homebody_core::time::{RunTime, Span};
use serde::{Deserialize, Serialize};

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fusion {
    /// Confidence of silhouettes from which a fall is reported at once, from 0 to 1.
    pub sure: f64,
    /// Confidence of silhouettes below which a fall is ignored, from 0 to 1.
    pub doubtful: f64,
    /// Time without movement after which a doubtful fall is reported, in seconds.
    pub still_s: f64,
    /// Time without movement after which a person last seen on the floor is reported, in seconds.
    pub floor_s: f64,
    /// Time after the last movement at which a person seen off the floor has not fallen with it, in seconds.
    pub fallen_s: f64,
    pub long_lie: LongLieRule,
}

impl Default for Fusion {
    /// All are our choice, and fitted to no data.
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

#[derive(Clone, Copy, Debug)]
pub struct FallEvidence<'a> {
    pub falls: &'a [Fall],
    /// The states in which cameras saw the person, in order of time.
    pub sightings: &'a [CameraSighting],
    /// The messages of passive sensors, in order of time.
    pub heard: &'a [PassiveMessage],
    pub until: RunTime,
}

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
    fn seen_by(&self, at: RunTime) -> &[CameraSighting] {
        &self.sightings[..self.sightings.partition_point(|seen| seen.at <= at)]
    }

    /// Nothing is known to move for so long from an instant on.
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
    fn reports_sure_falls_at_once_and_doubtful_ones_without_movement() {
        let busy: Vec<PassiveMessage> = (0..300).map(|step| moved(step * 10)).collect();
        assert_eq!(alarms(&[fall(100, 0.9)], &[], &busy), [100]);
        assert_eq!(alarms(&[fall(100, 0.5)], &[], &busy), NEVER);
        assert_eq!(alarms(&[fall(100, 0.1)], &[], &[moved(2990)]), NEVER);
        assert_eq!(alarms(&[fall(100, 0.5)], &[], &[moved(90), moved(200), moved(1000), moved(2000)]), [160]);
    }

    #[test]
    fn reports_long_lie_unless_cameras_saw_the_person_off_the_floor() {
        let seen = |at_s: i64, state| CameraSighting { at: at(at_s), state };
        let then = |sightings: &[CameraSighting]| alarms(&[], sightings, &[moved(100)]);
        assert_eq!(then(&[]), [1300]);
        assert_eq!(then(&[seen(115, FallState::Upright)]), NEVER);
        assert_eq!(then(&[seen(115, FallState::InBetween)]), NEVER);
        // Out of sight with the last movement, or seen only after the report.
        assert_eq!(then(&[seen(101, FallState::Upright)]), [1300]);
        assert_eq!(then(&[seen(1400, FallState::Upright)]), [1300]);
    }

    #[test]
    fn person_last_seen_on_the_floor_is_reported_soon_and_once() {
        let seen = |at_s: i64, state| CameraSighting { at: at(at_s), state };
        let (up, down) = (FallState::Upright, FallState::OnTheGround);
        let lies = [seen(90, up), seen(101, down), seen(115, down)];
        assert_eq!(alarms(&[], &lies, &[moved(100)]), [235]);
        // Told by silhouettes already.
        assert_eq!(alarms(&[fall(105, 0.9)], &lies, &[moved(100)]), [105]);
        // A person who stirs is reported once they keep still, one who gets up is not.
        assert_eq!(alarms(&[], &[&lies[..], &[seen(215, down)]].concat(), &[moved(100), moved(200)]), [335]);
        assert_eq!(alarms(&[], &[&lies[..], &[seen(150, up)]].concat(), &[moved(100), moved(139)]), NEVER);
    }
}
