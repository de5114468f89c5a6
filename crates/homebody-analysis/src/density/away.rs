//! Absences by the sensors alone: Wang and Skubic's *time away from home*.
//!
//! An absence begins and ends at the entrance, and in between there is next to nothing. Firings no more than two minutes apart make a bout.
//! A bout of three firings or more is a person's, and so is one with a thing used or opened. A shorter one of motion sensors is stray: in
//! an empty home they fire now and then, by the sun or a heater. The home is empty between two bouts of a person if
//!
//! - they are longer apart than the least absence, 30 minutes by default,
//! - an entrance sensor fired in the last minute of the first bout, and in the first minute of the second, and
//! - no sensor of a bed or a chair was occupied meanwhile for more than five minutes, and
//! - there are at most two stray firings, and one for each hour; or the home is five times as quiet as usual, for a faulty sensor in it may
//!   fire more often.
//!
//! So a night with the last firing in the bedroom is sleep, and so is a nap in an armchair. The rule is that of the literature (Wang &
//! Skubic 2008: a gap after the front door, an empty bed); the least absence is the upper end of its 10 to 30 minutes; bouts, strays, their
//! number and the minute are our choice. In a week of the CASAS home HH111, whose rows note who left and came, it finds all 15 absences of
//! more than half an hour and no other, with at most 4 stray firings in 5 hours; in one of TM000, the journey of three days, with 15. These
//! do not test it: with five minutes instead of two, a stray firing hid one of the 15.
//!
//! An absence is a guess unless a contact shows that a door was opened as it began and as it ended.
//!
//! Left out: more than one resident, if one of them leaves; visitors; people who leave through a door without a sensor; absences that have
//! begun before the log. No map has an absence that lasts when the log ends; a day's measures count it until the day ends.

use homebody_core::time::{HOUR, Interval, MINUTE, Span, WallTime};
use serde::{Serialize, Serializer};

/// Time between firings that separates two bouts.
const BOUT: Span = MINUTE.times(2);
/// Time after which a bed or a chair is occupied; a motion sensor of that name only blinks.
pub const SEATED: Span = MINUTE.times(5);
/// Number of firings below which a bout is stray, if they are of motion sensors alone.
const LEAST_FIRINGS: usize = 3;
/// Number of stray firings, beyond one for each such time, above which a person is at home. A small share of the usual
/// firings is stray in any case.
const MOST_STRAY: usize = 2;
const STRAY_EVERY: Span = HOUR;
const QUIET: f64 = 0.2;
/// Time from a bout's end within which the entrance has to fire.
const EDGE: Span = MINUTE;

/// The least absence by default: the upper end of Wang & Skubic's 10 to 30 minutes.
pub const LEAST: Span = MINUTE.times(30);

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct HomeAbsence {
    /// The last sign of the person who leaves, on the clock on the wall.
    #[serde(serialize_with = "as_text")]
    pub begin: WallTime,
    /// The first sign of the person who comes home.
    #[serde(serialize_with = "as_text")]
    pub end: WallTime,
    /// Firings meanwhile, in the empty home.
    pub stray: usize,
    /// No door opened as it began and as it ended: a person was at the entrance and then nowhere.
    pub is_guess: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PresenceSign {
    pub at: WallTime,
    pub at_entrance: bool,
    pub opens_door: bool,
    /// It is an act: use or opening, which no empty home has.
    pub is_use: bool,
}

/// The absences longer than `least`; signs in order, and the times in which a bed or a chair is occupied, in any order.
pub fn absences(signs: &[PresenceSign], taken: &[Interval<WallTime>], least: Span) -> Vec<HomeAbsence> {
    let mut leaving = Leaving::new(least);
    let mut found: Vec<HomeAbsence> = signs.iter().filter_map(|sign| leaving.take(sign)).collect();
    found.extend(leaving.last());
    found.retain(|absence| !absence.is_taken(taken));
    found
}

/// Looks for absences in signs, in the order of time. It does not know of beds and chairs.
#[derive(Clone, Debug, Default)]
pub struct Leaving {
    least: Span,
    /// The last bout that ended and was not stray.
    before: Option<Bout>,
    /// The firings of stray bouts since then.
    stray: usize,
    bout: Option<Bout>,
    /// All signs so far, and the first and the last of them.
    firings: usize,
    span: Option<Interval<WallTime>>,
}

/// A bout of signs, and whether the resident leaves after it, or comes with it.
#[derive(Clone, Copy, Debug, Default)]
struct Bout {
    begin: WallTime,
    end: WallTime,
    firings: usize,
    is_use: bool,
    /// The entrance fires, and a door there opens, near its beginning.
    comes: bool,
    comes_by_door: bool,
    /// The last firing of the entrance, and the last opening of a door there.
    entrance: Option<WallTime>,
    door: Option<WallTime>,
}

impl Bout {
    fn add(&mut self, sign: &PresenceSign) {
        self.end = self.end.max(sign.at);
        self.firings += 1;
        self.is_use |= sign.is_use;
        let is_near = sign.at - self.begin <= EDGE;
        if sign.at_entrance {
            self.comes |= is_near;
            self.entrance = Some(sign.at);
        }
        if sign.opens_door {
            self.comes_by_door |= is_near;
            self.door = Some(sign.at);
        }
    }

    fn is_somebodys(&self) -> bool {
        self.firings >= LEAST_FIRINGS || self.is_use
    }

    fn leaves(&self) -> bool {
        self.entrance.is_some_and(|at| self.end - at <= EDGE)
    }

    fn leaves_by_door(&self) -> bool {
        self.door.is_some_and(|at| self.end - at <= EDGE)
    }
}

impl Leaving {
    pub fn new(least: Span) -> Leaving {
        Leaving { least, ..Leaving::default() }
    }

    /// Takes a sign; returns the absence that ended with the bout before it, if there is one.
    pub fn take(&mut self, sign: &PresenceSign) -> Option<HomeAbsence> {
        self.firings += 1;
        self.span = Some(Interval::new(self.span.map_or(sign.at, |span| span.begin), sign.at));
        if let Some(bout) = self.bout.as_mut().filter(|bout| sign.at - bout.end <= BOUT) {
            bout.add(sign);
            return None;
        }
        let absence = self.last();
        if let Some(bout) = self.bout.take() {
            match bout.is_somebodys() {
                true => (self.before, self.stray) = (Some(bout), 0),
                false => self.stray += bout.firings,
            }
        }
        let mut bout = Bout { begin: sign.at, end: sign.at, ..Bout::default() };
        bout.add(sign);
        self.bout = Some(bout);
        absence
    }

    /// The absence that ended with the last bout, if no further sign comes.
    pub fn last(&self) -> Option<HomeAbsence> {
        let (before, bout) = self.before.zip(self.bout.filter(Bout::is_somebodys))?;
        let (begin, end) = (before.end, bout.begin);
        let is_guess = !before.leaves_by_door() || !bout.comes_by_door;
        let is_one =
            before.leaves() && bout.comes && end - begin > self.least && self.is_empty(self.stray, end - begin);
        is_one.then_some(HomeAbsence { begin, end, stray: self.stray, is_guess })
    }

    /// The absence that has not ended by `now`: the resident left, and all later bouts are stray. If the entrance has a contact
    /// (`has_door`), it was opened.
    pub fn open(&self, now: WallTime, has_door: bool) -> Option<HomeAbsence> {
        let is_somebodys = self.bout.is_some_and(|bout| bout.is_somebodys());
        let stray = if is_somebodys { 0 } else { self.stray + self.bout.map_or(0, |bout| bout.firings) };
        let last = if is_somebodys { self.bout } else { self.before }?;
        let leaves = last.leaves() && (last.leaves_by_door() || !has_door) && now - last.end > self.least;
        let leaves = leaves && self.is_empty(stray, now - last.end);
        leaves.then_some(HomeAbsence { begin: last.end, end: now, stray, is_guess: true })
    }

    pub fn forget(&mut self) {
        (self.before, self.bout, self.stray) = (None, None, 0);
    }

    /// The home may have been empty for so long with so many stray firings.
    fn is_empty(&self, stray: usize, length: Span) -> bool {
        let all = self.span.map(|span| span.length().max(Span::MICROSECOND));
        let usual = all.map_or(0.0, |all| self.firings as f64 / all.micros() as f64);
        stray <= MOST_STRAY + (length / STRAY_EVERY) as usize || stray as f64 <= QUIET * usual * length.micros() as f64
    }
}

impl HomeAbsence {
    /// A bed or a chair is occupied meanwhile, by the times in which one is.
    pub fn is_taken(&self, taken: &[Interval<WallTime>]) -> bool {
        taken.iter().any(|span| span.overlap(self.interval()) > SEATED)
    }

    pub fn interval(&self) -> Interval<WallTime> {
        Interval::new(self.begin, self.end)
    }

    pub fn hours(&self) -> f64 {
        self.interval().length().seconds() / 3600.0
    }
}

fn as_text<S: Serializer>(at: &WallTime, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&format_args!("{} {}", at.date(), crate::dates::clock_s(*at)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::{at, span};
    use homebody_core::time::SECOND;

    /// Signs by their seconds; those at the entrance are negative.
    fn signs(at_s: &[i64]) -> Vec<PresenceSign> {
        let sign = |&s: &i64| PresenceSign { at: at(s.abs()), at_entrance: s < 0, opens_door: false, is_use: false };
        at_s.iter().map(sign).collect()
    }

    fn seconds(at: WallTime) -> i64 {
        at.since_zero() / SECOND
    }

    fn found(at_s: &[i64], taken: &[Interval<WallTime>]) -> Vec<(i64, i64, usize)> {
        let found = absences(&signs(at_s), taken, LEAST);
        found.iter().map(|absence| (seconds(absence.begin), seconds(absence.end), absence.stray)).collect()
    }

    #[test]
    fn leaving_and_coming_by_the_door_is_an_absence() {
        assert_eq!(found(&[10, 20, -30, -4000, 4010, 4020], &[]), [(30, 4000, 0)]);
        // The hall sensor sees the back that goes out, and is first to see who comes.
        assert_eq!(found(&[10, -20, 40, 4000, -4010, 4020], &[]), [(40, 4000, 0)]);
        // An absence lasts for more than half an hour.
        assert_eq!(found(&[10, 20, -30, -1830, 1840, 1850], &[]), []);
        assert_eq!(found(&[10, 20, -30, -1831, 1840, 1850], &[]), [(30, 1831, 0)]);
    }

    #[test]
    fn long_sleep_does_not_count_as_absence() {
        // To bed past the front door two minutes ago, and up again in the bedroom.
        assert_eq!(found(&[-10, 100, 130, 30_000, 30_010, -30_020], &[]), []);
        // Only one of the two is at the entrance.
        assert_eq!(found(&[10, 20, -30, 30_000, 30_010, 30_020, -30_100], &[]), []);
        assert_eq!(found(&[-10, 20, 130, -30_000, 30_010, 30_020], &[]), []);
    }

    #[test]
    fn stray_firings_in_an_empty_home_do_not_end_an_absence() {
        let strays = [10, 20, -30, 5000, 5100, -9000, -20_000, 20_010, 20_020];
        assert_eq!(found(&strays, &[]), [(30, 20_000, 3)]);
        // Three in a row are a person's, here of one who did not come by the door.
        assert_eq!(found(&[10, 20, -30, 5000, 5100, 5200, -20_000, 20_010, 20_020], &[]), []);
    }

    #[test]
    fn occupied_bed_means_presence() {
        let day = [10, 20, -30, -30_000, 30_010, 30_020];
        assert_eq!(found(&day, &[span(100, 20_000)]), []);
        // Not for as long as a motion sensor of that name blinks, and not before or after.
        assert_eq!(found(&day, &[span(100, 102)]).len(), 1);
        assert_eq!(found(&day, &[span(0, 30), span(30_000, 90_000)]).len(), 1);
    }

    #[test]
    fn absence_without_an_opening_door_is_a_guess() {
        let mut day = signs(&[10, 20, -30, -4000, 4010, 4020]);
        assert!(absences(&day, &[], LEAST)[0].is_guess);
        day[2].opens_door = true;
        assert!(absences(&day, &[], LEAST)[0].is_guess, "nobody was seen to come");
        day[3].opens_door = true;
        assert!(!absences(&day, &[], LEAST)[0].is_guess);
    }

    #[test]
    fn absence_lasts_until_the_return() {
        let open = |at_s: &[i64], now_s: i64, has_door: bool| {
            let mut leaving = Leaving::new(LEAST);
            for sign in signs(at_s) {
                leaving.take(&sign);
            }
            leaving.open(at(now_s), has_door).map(|absence| (seconds(absence.begin), absence.stray))
        };
        assert_eq!(open(&[10, 20, -30], 4000, false), Some((30, 0)));
        assert_eq!(open(&[10, 20, -30, 3000], 4000, false), Some((30, 1)), "a stray firing ends nothing");
        assert_eq!(open(&[10, 20, -30], 1000, false), None, "it is too soon to tell");
        assert_eq!(open(&[-10, 100, 130], 30_000, false), None, "who goes to bed has not left");
        assert_eq!(open(&[10, 20, -30], 4000, true), None, "nobody opened the door");
    }

    #[test]
    fn home_with_movement_is_not_empty() {
        // Out from minute 1 to minute 181, and so many movements in between.
        let with = |movements: i64| {
            let mut at_s = vec![10, 20, -30];
            at_s.extend((0..movements).map(|movement| 600 + movement * 1000));
            at_s.extend([-10_860, 10_870, 10_880]);
            absences(&signs(&at_s), &[], LEAST)
        };
        assert_eq!(with(5).len(), 1);
        assert_eq!(with(5)[0].stray, 5);
        assert_eq!(with(6), []);
        // A home that is usually a hundred times as lively is empty all the same.
        let mut lively: Vec<i64> = (1..20_000).chain([20_010, 20_020, -20_030]).collect();
        lively.extend((0..6).map(|movement| 20_600 + movement * 1000));
        lively.extend([-30_860, 30_870, 30_880]);
        assert_eq!(absences(&signs(&lively), &[], LEAST).len(), 1);
    }

    #[test]
    fn a_log_without_signs_has_no_absences() {
        assert_eq!(found(&[], &[]), []);
        assert_eq!(found(&[-10], &[]), []);
        assert!(absences(&signs(&[10, 20, -30, -4000, 4010, 4020]), &[], 120 * MINUTE).is_empty());
    }
}
