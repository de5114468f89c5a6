//! Walking from sensor to sensor: the pace as multiples of the usual time between the two, and the speed in metres a second where the home
//! gives their distance.
//!
//! Metres a second need three sensors and more that fire one after the other on one way: the first shows from where a person comes into the
//! view of the second, and the last is the end of the walk. A stop on the way looks like a slow walk, so the slowest tenth contains stops,
//! too.

use super::signs::RoomSign;
use super::timeline::{SensorPassage, TimedWalk};
use super::ways::Ways;
use homebody_core::time::{SECOND, Span, WallTime};
use std::collections::BTreeMap;

/// Longest time of a way from one sensor to another.
const PASSES_WITHIN: Span = SECOND.times(15);
/// Number of times after which the usual time of a way is known, and largest number of first times that it is taken from.
const PASSES_KNOWN: usize = 20;
const PASSES_KEPT: usize = 100;
/// Largest number of pairs of sensors with a way between them.
const MOST_PAIRS: usize = 20_000;
/// Silence after which a firing of a sensor means that a person has entered its view (our choice).
const COMES_AFTER: Span = SECOND.times(15);
/// Time within which a walking person is seen again, and largest number of firings on one way (our choice).
const GOES_ON: Span = SECOND.times(8);
const MOST_SIGNS: usize = 16;
/// Length of a way below which the position within the sensors' fields makes the distance too uncertain (our choice).
const LEAST_WALK_M: f64 = 3.0;
/// Lowest and highest walking speed at home (our choice).
const SPEEDS_M_S: std::ops::RangeInclusive<f64> = 0.1..=2.0;

/// The pace of ways between sensors in different rooms, relative to their first times.
#[derive(Default)]
pub struct Paces {
    before: Option<RoomSign>,
    pairs: BTreeMap<(usize, usize), WayTimes>,
}

/// The way between two sensors: the seconds of its first times, the shortest first.
#[derive(Default)]
struct WayTimes(Vec<f64>);

impl WayTimes {
    fn usual(&self) -> Option<f64> {
        (self.0.len() >= PASSES_KNOWN).then(|| self.0[self.0.len() / 2])
    }

    fn add(&mut self, took: f64) {
        if self.0.len() < PASSES_KEPT {
            let place = self.0.partition_point(|other| *other < took);
            self.0.insert(place, took);
        }
    }
}

impl Paces {
    /// Takes the signs of a day, in order, and returns the passages of ways whose usual time was known before.
    pub fn of_day(&mut self, signs: &[RoomSign]) -> Vec<SensorPassage> {
        let mut passages = Vec::new();
        for sign in signs {
            let Some(before) = self.before.replace(*sign) else { continue };
            let took = sign.at - before.at;
            if before.room == sign.room || took <= Span::ZERO || took > PASSES_WITHIN {
                continue;
            }
            let (of, took) = ((before.sensor, sign.sensor), took.seconds());
            if self.pairs.len() >= MOST_PAIRS && !self.pairs.contains_key(&of) {
                continue;
            }
            let pair = self.pairs.entry(of).or_default();
            passages.extend(pair.usual().map(|usual| SensorPassage { at: sign.at, of_usual: usual / took }));
            pair.add(took);
        }
        passages
    }

    pub fn forget(&mut self) {
        self.before = None;
    }

    pub fn is_known(&self) -> bool {
        self.pairs.values().any(|pair| pair.usual().is_some())
    }
}

/// The walks of a person, by the ways of their home.
pub fn walks(signs: &[RoomSign], sensors: &[String], ways: &Ways) -> Vec<TimedWalk> {
    let numbers: Vec<Option<usize>> = sensors.iter().map(|sensor| ways.number(sensor)).collect();
    let mut before: Vec<Option<WallTime>> = vec![None; sensors.len()];
    // Each sign with its sensor's number in the home; true if a person has just come into its view.
    let coming: Vec<(WallTime, Option<usize>, bool)> = (signs.iter())
        .map(|sign| {
            let was = before[sign.sensor].replace(sign.at);
            (sign.at, numbers[sign.sensor], was.is_none_or(|was| sign.at - was >= COMES_AFTER))
        })
        .collect();
    let mut walks = Vec::new();
    for moving in coming.chunk_by(|a, b| b.0 - a.0 <= GOES_ON) {
        let mut first = 0;
        while first + 2 < moving.len() {
            match longest(&moving[first..], ways) {
                Some((last, walk)) => {
                    walks.extend(walk);
                    first += last;
                }
                None => first += 1,
            }
        }
    }
    walks
}

/// The longest walk along one way that begins with the first of some signs: the number of the sign with which it ends.
fn longest(signs: &[(WallTime, Option<usize>, bool)], ways: &Ways) -> Option<(usize, Option<TimedWalk>)> {
    let (_, Some(first), _) = signs[0] else { return None };
    let (began, Some(from), true) = signs[1] else { return None };
    let on_the_way = |last: usize| {
        let (ended, Some(to), true) = signs[last] else { return None };
        let metres = |sensor: usize| ways.walked_m(first, sensor, to);
        let passed = signs[1..last].iter().all(|(_, sensor, _)| {
            sensor.is_some_and(|sensor| sensor == first || metres(sensor).is_some_and(|metres| metres >= 0.0))
        });
        let metres = metres(from).filter(|metres| passed && *metres >= LEAST_WALK_M)?;
        let speed_m_s = metres / (ended - began).seconds();
        Some((last, SPEEDS_M_S.contains(&speed_m_s).then_some(TimedWalk { at: ended, speed_m_s })))
    };
    (2..signs.len().min(MOST_SIGNS)).rev().find_map(on_the_way)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pace_is_held_against_the_first_times_that_a_way_was_gone() {
        let mut paces = Paces::default();
        // A day of ways from one room to another, each of so many seconds, ten minutes apart.
        let day = |count: i64, took: i64| -> Vec<RoomSign> {
            let way = |number: i64| {
                [(0, 0), (took, 1)].map(|(off, sensor)| RoomSign {
                    at: crate::sample::at(number * 600 + off),
                    room: sensor,
                    sensor,
                    is_seen: true,
                    is_held: false,
                })
            };
            (0..count).flat_map(way).collect()
        };
        assert!(paces.of_day(&day(19, 4)).is_empty() && !paces.is_known());
        assert!(paces.of_day(&day(1, 4)).is_empty() && paces.is_known());
        paces.of_day(&day(80, 4));
        let slower: Vec<f64> = paces.of_day(&day(3, 8)).iter().map(|passage| passage.of_usual).collect();
        assert_eq!(slower, [0.5; 3]);
        // Later times do not change the usual time.
        paces.of_day(&day(1000, 8));
        assert!(paces.of_day(&day(2, 4)).iter().all(|passage| passage.of_usual == 1.0));
    }
}
