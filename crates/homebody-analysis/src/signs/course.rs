//! The rows of a sensor one after the other: each says what it does after those before it, and after stretches that are not known.

use super::meanings::Meanings;
use homebody_core::states::Says;
use homebody_core::time::{Interval, TimePoint, WallTime};
use homebody_log::Log;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RowMeaning<T = WallTime> {
    pub says: Says,
    /// The begin of an unknown state before this row, or at it; `None` where the state was known all along.
    pub unknown_from: Option<T>,
    /// It repeats the state from before an unknown time: the system restored it, and nothing happened.
    pub is_restored: bool,
}

impl<T> RowMeaning<T> {
    pub fn begins(&self) -> bool {
        self.says.is_on() && !self.is_restored
    }

    /// Something begins, ends, opens or closes at this row.
    pub fn is_sign(&self) -> bool {
        self.says.is_sign() && !self.is_restored
    }
}

#[derive(Clone, Copy, Debug, Default)]
pub struct SensorCourse<T = WallTime> {
    state: Option<Says>,
    at: Option<T>,
    /// The begin of the unknown state.
    unknown_from: Option<T>,
}

impl<T: TimePoint> SensorCourse<T> {
    /// Takes a row. `gaps` are those of the recorder, in the order of time.
    pub fn take(&mut self, at: T, says: Says, gaps: &[Interval<T>]) -> RowMeaning<T> {
        let gap = self.at.and_then(|before| gap_between(gaps, before, at));
        let before = self.unknown_from.or(gap);
        self.at = Some(at);
        match says {
            Says::Else => {
                self.unknown_from = before;
                RowMeaning { says, unknown_from: before, is_restored: false }
            }
            Says::Unknown => {
                self.unknown_from = before.or(Some(at));
                RowMeaning { says, unknown_from: self.unknown_from, is_restored: false }
            }
            known => {
                let is_restored = before.is_some() && self.state == Some(known);
                (self.state, self.unknown_from) = (Some(known), None);
                RowMeaning { says, unknown_from: before, is_restored }
            }
        }
    }
}

/// When the first gap begins that lies between two rows.
fn gap_between<T: TimePoint>(gaps: &[Interval<T>], before: T, at: T) -> Option<T> {
    let next = gaps.get(gaps.partition_point(|gap| gap.begin < before))?;
    (next.begin < at).then_some(next.begin)
}

pub fn said<T: TimePoint + Default>(log: &Log<T>) -> Vec<RowMeaning<T>> {
    let meanings = Meanings::from_log(log);
    let mut courses = vec![SensorCourse::default(); log.sensors.len()];
    let mut take = |number: usize| {
        let event = &log.events[number];
        courses[event.sensor as usize].take(event.at, meanings.says(event), &log.gaps)
    };
    if log.events.is_sorted_by_key(|event| event.at) {
        return (0..log.events.len()).map(take).collect();
    }
    let mut order: Vec<usize> = (0..log.events.len()).collect();
    order.sort_by_key(|&number| log.events[number].at);
    let mut all = vec![RowMeaning { says: Says::Else, unknown_from: None, is_restored: false }; log.events.len()];
    for number in order {
        all[number] = take(number);
    }
    all
}
