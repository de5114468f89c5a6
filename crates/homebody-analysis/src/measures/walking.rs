//! How fast somebody walks from sensor to sensor: beside what is usual between the two, and in metres a second where a home tells
//! how far apart they are.
//!
//! Metres a second need three sensors that speak one after the other: the first tells from where somebody comes into the view of the
//! second. A stop on the way looks like a slow walk, so the slowest tenth tells of stops, too.

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
/// Over less, what a sensor sees at its border tells too little of how far one has gone (ours).
const LEAST_WALK_M: f64 = 1.5;
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
    let mut walks = Vec::new();
    // The last three that came into view, and whether they had been silent.
    let mut last: [Option<(Sign, bool)>; 3] = [None; 3];
    for sign in signs {
        let was = before[sign.sensor].replace(sign.at);
        let comes = was.is_none_or(|was| sign.at - was >= COMES_AFTER);
        last = [last[1], last[2], Some((*sign, comes))];
        let [Some((first, _)), Some((from, true)), Some((to, true))] = last else { continue };
        if to.at - first.at > 2 * PASSES_WITHIN || to.at <= from.at {
            continue;
        }
        let known = [first, from, to].map(|sign| numbers[sign.sensor]);
        let [Some(first), Some(middle), Some(end)] = known else { continue };
        let Some(metres) = ways.walked_m(first, middle, end).filter(|metres| *metres >= LEAST_WALK_M) else { continue };
        let speed_m_s = metres / seconds(to.at - from.at);
        if SPEEDS_M_S.contains(&speed_m_s) {
            walks.push(Walk { at: to.at, speed_m_s });
        }
    }
    (!walks.is_empty()).then_some(walks)
}
