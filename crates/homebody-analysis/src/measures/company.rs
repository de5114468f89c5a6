//! When somebody besides the resident was there, as a guess: two sensors that speak within less time than a walk from one to the
//! other takes have seen two people.
//!
//! How long a walk takes at least is told by the home, where it is known. Otherwise the log tells it: on three days of ten
//! nobody was faster, as guests are not there every day. One such pair may be a false firing, and one sensor that is stuck
//! makes many: it takes several within the hour, not all of one sensor. A visit begins and ends as the front door is opened, where
//! that has a contact, and otherwise with the first and last of them, so that it is told shorter than it was.
//!
//! Left out: guests who sit with the resident in one room all the time, whom motion sensors cannot tell from one person, and how many
//! guests there are.

use super::signs::Sign;
use super::timeline::Span;
use super::ways::Ways;
use homebody_core::time::{DAY, Micros, SECOND, seconds};
use std::collections::{BTreeMap, BTreeSet};

/// Nobody walks faster at home, and sensors look over so much farther than the home says (ours).
const FASTEST_M_S: f64 = 1.5;
const SLACK_M: f64 = 1.5;
/// Walks that take less tell nothing (ours), since sensors take some time to notice.
const LEAST_WALK: Micros = 2 * SECOND;
/// Two sensors that never speak one after the other are at least so far apart (ours), of which half is too soon.
const FAR_APART: Micros = 6 * SECOND;
/// On so large a part of the days nobody was faster (ours).
const DAYS_ALONE: f64 = 0.3;
/// With fewer days nothing is known of how long walks take (ours).
const LEAST_DAYS: usize = 7;
/// Pairs no farther apart belong to one visit, which takes so many of them, or one between two openings of the door (ours).
const VISIT_APART: Micros = 45 * 60 * SECOND;
const VISIT_PAIRS: usize = 3;
/// Who comes or goes opens the door no longer before or after (ours).
const DOOR_WITHIN: Micros = 2 * 3600 * SECOND;

/// Two sensors that have seen two people: when the second spoke, and which they are, the lower number first.
type Pair = (Micros, (usize, usize));

/// When there was company; `None` where it cannot be known. `doors` are the instants at which a door out was opened.
pub fn company(signs: &[Sign], sensors: &[String], ways: Option<&Ways>, doors: &[Micros]) -> Option<Vec<Span>> {
    let pairs = match ways {
        Some(ways) => too_soon_for_a_walk(signs, sensors, ways),
        None => too_soon_for_most_days(signs)?,
    };
    let mut visits: Vec<Span> = Vec::new();
    for visit in pairs.chunk_by(|a, b| b.0 - a.0 <= VISIT_APART) {
        let (first, last) = (visit[0].0, visit[visit.len() - 1].0);
        let before = doors[..doors.partition_point(|&at| at <= first)].last().copied();
        let after = doors.get(doors.partition_point(|&at| at < last)).copied();
        let came = before.filter(|at| first - at <= DOOR_WITHIN);
        let went = after.filter(|at| at - last <= DOOR_WITHIN);
        let has_door = came.is_some() && went.is_some();
        if has_door || visit.len() >= VISIT_PAIRS && !is_of_one_sensor(visit) {
            visits.push((came.unwrap_or(first), went.unwrap_or(last)));
        }
    }
    Some(super::timeline::joined(visits.into_iter(), 0))
}

/// Whether one sensor is in all pairs.
fn is_of_one_sensor(pairs: &[Pair]) -> bool {
    let (_, first) = pairs[0];
    [first.0, first.1].iter().any(|sensor| pairs.iter().all(|(_, pair)| pair.0 == *sensor || pair.1 == *sensor))
}

/// Signs in two rooms, one after the other.
fn in_two_rooms(signs: &[Sign]) -> impl Iterator<Item = (Micros, Pair)> {
    signs.windows(2).filter(|pair| pair[0].room != pair[1].room).map(|pair| {
        let [a, b] = [pair[0].sensor, pair[1].sensor];
        (pair[1].at - pair[0].at, (pair[1].at, (a.min(b), a.max(b))))
    })
}

fn too_soon_for_a_walk(signs: &[Sign], sensors: &[String], ways: &Ways) -> Vec<Pair> {
    let numbers: Vec<Option<usize>> = sensors.iter().map(|sensor| ways.number(sensor)).collect();
    let too_soon = |&(took, (_, (a, b))): &(Micros, Pair)| {
        let metres = numbers[a].zip(numbers[b]).and_then(|(a, b)| ways.between_m(a, b));
        let least_s = metres.map_or(0.0, |metres| (metres - SLACK_M) / FASTEST_M_S);
        least_s >= seconds(LEAST_WALK) && seconds(took) < least_s
    };
    in_two_rooms(signs).filter(too_soon).map(|(_, pair)| pair).collect()
}

fn too_soon_for_most_days(signs: &[Sign]) -> Option<Vec<Pair>> {
    let mut soonest: BTreeMap<(usize, usize), BTreeMap<Micros, Micros>> = BTreeMap::new();
    let days: BTreeSet<Micros> = signs.iter().map(|sign| sign.at.div_euclid(DAY)).collect();
    if days.len() < LEAST_DAYS {
        return None;
    }
    for (took, (at, pair)) in in_two_rooms(signs) {
        let soonest = soonest.entry(pair).or_default().entry(at.div_euclid(DAY)).or_insert(took);
        *soonest = took.min(*soonest);
    }
    let usual: BTreeMap<(usize, usize), Micros> = soonest
        .into_iter()
        .map(|(pair, by_day)| {
            let mut soonest: Vec<Micros> = by_day.into_values().collect();
            soonest.sort_unstable();
            // On the other days they did not speak one after the other at all.
            let usual = soonest.get((days.len() as f64 * DAYS_ALONE) as usize).copied();
            (pair, usual.unwrap_or(FAR_APART).min(FAR_APART))
        })
        .collect();
    let too_soon = |&(took, (_, pair)): &(Micros, Pair)| {
        usual.get(&pair).is_some_and(|&usual| usual >= LEAST_WALK && took < usual / 2)
    };
    Some(in_two_rooms(signs).filter(too_soon).map(|(_, pair)| pair).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    const KITCHEN: (usize, usize) = (0, 0);
    const HALL: (usize, usize) = (1, 1);
    const BEDROOM: (usize, usize) = (2, 2);
    const SOFA: (usize, usize) = (3, 3);

    /// Ten days of walks from room to room, 5 s each, and then what else is said on the eighth at noon.
    fn signs(more: &[(Micros, (usize, usize))]) -> Vec<Sign> {
        let of = |at: Micros, (room, sensor): (usize, usize)| Sign { at, room, sensor };
        let mut signs = Vec::new();
        for day in 0..10 {
            for walk in 0..20 {
                let rooms = [KITCHEN, HALL, BEDROOM, HALL, SOFA, HALL];
                signs.extend(rooms.iter().zip(0..).map(|(room, number)| {
                    of(day * DAY + (8 * 60 + walk * 30) * 60 * SECOND + number * 5 * SECOND, *room)
                }));
            }
        }
        let noon = 8 * DAY + 12 * 3600 * SECOND + 300 * SECOND;
        signs.extend(more.iter().map(|&(at, room)| of(noon + at * SECOND / 2, room)));
        signs.sort_by_key(|sign| sign.at);
        signs
    }

    fn found(more: &[(Micros, (usize, usize))], doors: &[Micros]) -> Vec<Span> {
        company(&signs(more), &[], None, doors).unwrap()
    }

    #[test]
    fn who_is_in_two_rooms_at_once_is_two() {
        assert_eq!(found(&[], &[]), []);
        let two = [(0, KITCHEN), (1, BEDROOM), (100, SOFA), (101, KITCHEN), (900, BEDROOM), (901, SOFA)];
        let visits = found(&two, &[]);
        assert_eq!(visits.len(), 1);
        assert_eq!((visits[0].1 - visits[0].0) / SECOND, 450);
        // Once may be by chance, and a sensor that is stuck speaks whoever is where.
        assert_eq!(found(&two[..2], &[]), []);
        let stuck = [(0, KITCHEN), (1, BEDROOM), (100, SOFA), (101, BEDROOM), (900, BEDROOM), (901, SOFA)];
        assert_eq!(found(&stuck, &[]), []);
    }

    #[test]
    fn a_visit_begins_and_ends_at_the_door() {
        let noon = 8 * DAY + 12 * 3600 * SECOND;
        let doors = [noon - 600 * SECOND, noon + 3600 * SECOND];
        assert_eq!(found(&[(0, KITCHEN), (1, BEDROOM)], &doors), [(doors[0], doors[1])]);
        assert_eq!(found(&[], &doors), []);
    }

    #[test]
    fn a_few_days_do_not_tell_how_long_walks_take() {
        let few: Vec<Sign> = signs(&[]).into_iter().filter(|sign| sign.at < 5 * DAY).collect();
        assert_eq!(company(&few, &[], None, &[]), None);
    }
}
