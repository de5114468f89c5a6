//! How fast somebody walks from sensor to sensor: beside what is usual between the two, and in metres a second where a home tells
//! how far apart they are.
//!
//! Metres a second need three sensors and more that speak one after the other on one way: the first tells from where somebody comes
//! into the view of the second, and the last is where the walk ends. A stop on the way looks like a slow walk, so the slowest tenth tells of stops, too.

use super::signs::Sign;
use super::timeline::{Passage, Walk};
use super::ways::Ways;
use homebody_core::time::{Micros, SECOND, seconds};
use std::collections::BTreeMap;

/// A way from one sensor to another takes no longer, and is known by so many (ours).
const PASSES_WITHIN: Micros = 15 * SECOND;
const PASSES_KNOWN: usize = 20;
/// A sensor that has said nothing for so long speaks as somebody comes into its view (ours).
const COMES_AFTER: Micros = 15 * SECOND;
/// Who goes on is seen again within so long (ours), on one way by so many signs at most.
const GOES_ON: Micros = 8 * SECOND;
const MOST_SIGNS: usize = 16;
/// Over less, what a sensor sees at its border tells too little of how far one has gone (ours).
const LEAST_WALK_M: f64 = 3.0;
/// Nobody walks at home faster or slower (ours).
const SPEEDS_M_S: std::ops::RangeInclusive<f64> = 0.1..=2.0;

/// How fast somebody went from sensor to sensor, of those pairs in different rooms that are passed often enough.
pub fn passages(signs: &[Sign]) -> Option<Vec<Passage>> {
    let mut by_pair: BTreeMap<(usize, usize), Vec<(Micros, f64)>> = BTreeMap::new();
    for pair in signs.windows(2) {
        let took = pair[1].at - pair[0].at;
        if pair[0].room != pair[1].room && took > 0 && took <= PASSES_WITHIN {
            let of = (pair[0].sensor, pair[1].sensor);
            by_pair.entry(of).or_default().push((pair[1].at, seconds(took)));
        }
    }
    let mut passages = Vec::new();
    for passed in by_pair.into_values().filter(|passed| passed.len() >= PASSES_KNOWN) {
        let mut took: Vec<f64> = passed.iter().map(|(_, took)| *took).collect();
        took.sort_by(f64::total_cmp);
        let usual = took[took.len() / 2];
        passages.extend(passed.into_iter().map(|(at, took)| Passage { at, of_usual: usual / took }));
    }
    passages.sort_by_key(|passage| passage.at);
    (!passages.is_empty()).then_some(passages)
}

/// How fast somebody walked, by the ways of their home.
pub fn walks(signs: &[Sign], sensors: &[String], ways: &Ways) -> Option<Vec<Walk>> {
    let numbers: Vec<Option<usize>> = sensors.iter().map(|sensor| ways.number(sensor)).collect();
    let mut before: Vec<Option<Micros>> = vec![None; sensors.len()];
    // Each sign with its sensor's number in the home, and whether somebody has just come into its view.
    let coming: Vec<(Micros, Option<usize>, bool)> = (signs.iter())
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
    (!walks.is_empty()).then_some(walks)
}

/// The longest walk along one way that begins with the first of some signs: the number of the sign with which it ends.
fn longest(signs: &[(Micros, Option<usize>, bool)], ways: &Ways) -> Option<(usize, Option<Walk>)> {
    let (_, Some(first), _) = signs[0] else { return None };
    let (began, Some(from), true) = signs[1] else { return None };
    let on_the_way = |last: usize| {
        let (ended, Some(to), true) = signs[last] else { return None };
        let metres = |sensor: usize| ways.walked_m(first, sensor, to);
        let passed = signs[1..last].iter().all(|(_, sensor, _)| {
            sensor.is_some_and(|sensor| sensor == first || metres(sensor).is_some_and(|metres| metres >= 0.0))
        });
        let metres = metres(from).filter(|metres| passed && *metres >= LEAST_WALK_M)?;
        let speed_m_s = metres / seconds(ended - began);
        Some((last, SPEEDS_M_S.contains(&speed_m_s).then_some(Walk { at: ended, speed_m_s })))
    };
    (2..signs.len().min(MOST_SIGNS)).rev().find_map(on_the_way)
}
