//! The times with company, by a contact of the door: a guess.
//!
//! The person who leaves an empty home behind is the resident. If the door was used with a person at home before and after, a guest came or
//! went, or the post did. A visit is the time between two such uses that follow each other, in which the home is livelier than usual at
//! these hours; of two that share a use of the door, the livelier one.
//!
//! We tried to find a guest by sensors that fire sooner after each other than one person walks: that found a tenth of the hours, as most
//! guests sit with their host. So nothing is known without a door.
//!
//! The limits come from six simulations of the studio and of the house with two floors, in which a visit gives 1.3 to 3 times the usual
//! signs; no log of a real home that we have notes its visitors.
//!
//! Left out: guests whom the resident fetches or sees home, guests who come or go as the resident does, and the number of guests.

use super::signs::RoomSign;
use homebody_core::time::{HOUR, Interval, MINUTE, Span, WallTime};
use std::collections::{BTreeSet, VecDeque};

/// Number of days below which the usual amount of movement is unknown (our choice).
const LEAST_DAYS: usize = 7;
/// Largest number of days, up to the day itself, in the usual amount.
const MOST_DAYS: usize = 28;
/// Longest time between messages of a door that belong to one use of it (our choice).
const ONE_USE: Span = MINUTE.times(2);
/// Time before and after a use of the door whose firings are those of the person who uses it, even if the home is empty
/// (our choice).
const AT_THE_DOOR: Span = MINUTE;
/// Number of firings below which a home counts as empty (our choice).
const LEAST_SIGNS: usize = 3;
/// Shortest and longest visit (our choice).
const SHORTEST: Span = MINUTE.times(10);
const LONGEST: Span = HOUR.times(5);
/// Smallest ratio of firings during a visit to the usual ones (our choice).
const LIVELY: f64 = 1.3;

/// When there was company up to `now`; `None` where no door tells it, or there were too few days to tell what is usual. `door` are
/// the instants at which a door out was opened or closed, in order.
pub fn company(
    signs: &[RoomSign],
    door: &[WallTime],
    usual: &UsualSigns,
    now: WallTime,
) -> Option<Vec<Interval<WallTime>>> {
    let usual = usual.hours().filter(|_| usual.has_door)?;
    let uses = door.chunk_by(|&a, &b| b - a <= ONE_USE);
    let uses: Vec<Interval<WallTime>> = uses.map(|of_use| Interval::new(of_use[0], of_use[of_use.len() - 1])).collect();
    let between: Vec<Interval<WallTime>> =
        uses.windows(2).map(|pair| Interval::new(pair[0].end, pair[1].begin)).collect();
    let after = uses.last().map(|last| Interval::new(last.end, now)).filter(|after| after.length() >= SHORTEST);
    let is_lived_in: Vec<bool> = between.iter().chain(&after).map(|span| is_lived_in(signs, *span)).collect();
    // Before the first use, and soon after the last, it is taken to be so.
    let is_lived_in = |number: Option<usize>| number.and_then(|number| is_lived_in.get(number)).is_none_or(|is| *is);
    let mut lively: Vec<(f64, usize)> = Vec::new();
    for (number, &span) in between.iter().enumerate() {
        let neighbours = [number.checked_sub(1), Some(number), Some(number + 1)];
        if (SHORTEST..=LONGEST).contains(&span.length()) && neighbours.into_iter().all(is_lived_in) {
            let times = count(signs, span) as f64 / usual_signs(&usual, span);
            lively.extend((times >= LIVELY).then_some((times, number)));
        }
    }
    lively.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut taken: BTreeSet<usize> = BTreeSet::new();
    for (_, number) in lively {
        if !(taken.contains(&(number + 1)) || number.checked_sub(1).is_some_and(|before| taken.contains(&before))) {
            taken.insert(number);
        }
    }
    Some(taken.into_iter().map(|number| between[number]).collect())
}

/// A person was at home between two uses of the door.
fn is_lived_in(signs: &[RoomSign], span: Interval<WallTime>) -> bool {
    count(signs, Interval::new(span.begin + AT_THE_DOOR, span.end - AT_THE_DOOR)) >= LEAST_SIGNS
}

fn count(signs: &[RoomSign], span: Interval<WallTime>) -> usize {
    let before = span.map(|at| signs.partition_point(|sign| sign.at < at));
    before.end.saturating_sub(before.begin)
}

#[derive(Default)]
pub struct UsualSigns {
    days: VecDeque<[u32; 24]>,
    has_door: bool,
}

impl UsualSigns {
    /// Takes a day: its signs, and whether a door out was used.
    pub fn add(&mut self, signs: &[RoomSign], has_door: bool) {
        self.has_door |= has_door;
        if signs.is_empty() {
            return;
        }
        let mut hours = [0; 24];
        signs.iter().for_each(|sign| hours[(sign.at.time_of_day() / HOUR) as usize] += 1);
        self.days.push_back(hours);
        if self.days.len() > MOST_DAYS {
            self.days.pop_front();
        }
    }

    /// By hour of the day, the median over the days with a sign in it; `None` with too few days.
    fn hours(&self) -> Option<[f64; 24]> {
        if self.days.len() < LEAST_DAYS {
            return None;
        }
        let mut usual = [0.0; 24];
        for (hour, usual) in usual.iter_mut().enumerate() {
            let mut counts: Vec<u32> = self.days.iter().map(|day| day[hour]).filter(|count| *count > 0).collect();
            counts.sort_unstable();
            *usual = counts.get(counts.len() / 2).map_or(0.0, |count| f64::from(*count));
        }
        Some(usual)
    }
}

/// The usual number of signs in an interval; one at least.
fn usual_signs(usual: &[f64; 24], span: Interval<WallTime>) -> f64 {
    let hours = span.map(|at| at.since_zero().div_euclid(HOUR));
    let in_hour = |hour: i64| {
        let lasts = Interval::starting(WallTime::EPOCH + hour * HOUR, HOUR).overlap(span);
        lasts.ratio(HOUR) * usual[hour.rem_euclid(24) as usize]
    };
    (hours.begin..=hours.end).map(in_hour).sum::<f64>().max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::DAY;

    /// Ten days with a sign every five minutes from 08:00 to 22:00, except in an empty home, and every minute in the lively hours of the
    /// eighth.
    fn signs(out: &[(i64, i64)], lively: &[(i64, i64)]) -> Vec<RoomSign> {
        let minutes = (0..10).flat_map(|day| (8 * 60..22 * 60).map(move |minute| (day, minute)));
        let is_in = |spans: &[(i64, i64)], day: i64, minute: i64| {
            day == 8 && spans.iter().any(|span| (span.0..span.1).contains(&minute))
        };
        minutes
            .filter(|&(day, minute)| !is_in(out, day, minute) && (minute % 5 == 0 || is_in(lively, day, minute)))
            .map(|(day, minute)| RoomSign { at: at(day, minute), room: 0, sensor: 0, is_seen: true, is_held: false })
            .collect()
    }

    fn at(day: i64, minute: i64) -> WallTime {
        WallTime::EPOCH + day * DAY + minute * MINUTE
    }

    fn told(signs: &[RoomSign], door: &[WallTime]) -> Option<Vec<Interval<WallTime>>> {
        let mut usual = UsualSigns::default();
        signs.chunk_by(|a, b| a.at.date() == b.at.date()).for_each(|day| usual.add(day, !door.is_empty()));
        company(signs, door, &usual, at(10, 0))
    }

    fn found(out: &[(i64, i64)], lively: &[(i64, i64)], door: &[i64]) -> Vec<Interval<WallTime>> {
        let door: Vec<WallTime> = door.iter().map(|minute| at(8, *minute)).collect();
        told(&signs(out, lively), &door).unwrap()
    }

    #[test]
    fn lively_time_between_two_uses_of_the_door_is_a_visit() {
        assert_eq!(found(&[], &[(900, 1000)], &[900, 1000]), [Interval::new(at(8, 900), at(8, 1000))]);
        // The post comes at 11:00, and nothing is lively between it and the guest.
        assert_eq!(found(&[], &[(900, 1000)], &[660, 900, 1000]), [Interval::new(at(8, 900), at(8, 1000))]);
        assert_eq!(found(&[], &[], &[900, 1000]), [], "nothing was livelier");
        assert_eq!(found(&[], &[(700, 1100)], &[700, 1100]), [], "no visit is so long");
    }

    #[test]
    fn leaving_an_empty_home_is_not_a_visit() {
        // Lively between two ways out: it is the resident alone.
        assert_eq!(found(&[(700, 800), (900, 1000)], &[(800, 900)], &[700, 800, 900, 1000]), []);
    }

    #[test]
    fn company_needs_days_and_a_door_contact() {
        assert_eq!(told(&signs(&[], &[(900, 1000)]), &[]), None);
        let few: Vec<RoomSign> = signs(&[], &[]).into_iter().filter(|sign| sign.at < at(5, 0)).collect();
        assert_eq!(told(&few, &[at(3, 900), at(3, 1000)]), None);
    }
}
