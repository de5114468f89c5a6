//! When nobody was at home, by the sensors alone: Wang and Skubic's *time away from home*.
//!
//! An absence begins and ends at the entrance, and in between there is next to nothing. Firings no more than two minutes apart
//! make a bout. A bout of three firings or more is somebody's, and one in which something was opened or used. A shorter one of
//! motion sensors is stray: in an empty home they fire now and then, by the sun or a heater. Nobody is at home between two bouts of
//! somebody, however many stray ones lie between, if
//!
//! - they are longer apart than the least absence, 30 minutes unless asked otherwise,
//! - an entrance sensor fired in the last minute of the first bout, and in the first minute of the second, and
//! - no sensor of a bed or a chair said meanwhile, for more than five minutes, that somebody is there.
//!
//! So a night with the last firing in the bedroom is sleep, and so is a nap in an armchair. The rule is that of the
//! literature (Wang & Skubic 2008: a gap after the front door, an empty bed); the least absence is the upper end of its 10
//! to 30 minutes; bouts, strays and the minute are ours. In a week of the CASAS home HH111, whose rows note who left and
//! came, it finds all 15 absences of more than half an hour and no other; in one of TM000, the journey of three days.
//! These are no test of it: with five minutes instead of two, a stray firing hid one of the 15.
//!
//! An absence is a guess unless a contact tells that a door was opened as it began and as it ended.
//!
//! Left out: more residents than one, of whom one leaves; visitors; whoever leaves through a door without a sensor; absences
//! that go on when the log begins or ends.

use homebody_core::time::{Micros, SECOND, seconds};
use serde::{Serialize, Serializer};

/// Firings farther apart than this belong to different bouts.
const BOUT: Micros = 120 * SECOND;
/// A bed or a chair that is taken for longer has somebody in it; a motion sensor of that name only blinks.
const SEATED: Micros = 300 * SECOND;
/// A bout of fewer firings is stray, if they are of motion sensors alone.
const LEAST_FIRINGS: usize = 3;
/// How near to a bout's end the entrance has to fire.
const EDGE: Micros = 60 * SECOND;

/// The least absence that is looked for unless asked otherwise: the upper end of Wang & Skubic's 10 to 30 minutes.
pub const LEAST: Micros = 30 * 60 * SECOND;

/// A time when nobody was at home.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Absence {
    /// The last sign of somebody who leaves, on the clock on the wall.
    #[serde(serialize_with = "told")]
    pub begin: Micros,
    /// The first sign of somebody who comes home.
    #[serde(serialize_with = "told")]
    pub end: Micros,
    /// Firings meanwhile, in the empty home.
    pub stray: usize,
    /// Whether no door was seen to open as it began and as it ended: that somebody was at the entrance and then nowhere
    /// is all that tells it.
    pub is_guess: bool,
}

/// A sign of somebody: when, and whether it is at the entrance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sign {
    /// When, in microseconds since 1970 on the clock on the wall.
    pub at: Micros,
    /// Whether a sensor at the entrance tells it.
    pub at_entrance: bool,
    /// Whether it is a door there that is opened.
    pub opens_door: bool,
    /// Whether something is used or opened, which no empty home does.
    pub is_use: bool,
}

/// The absences longer than `least`; signs in order, and the spans over which a bed or a chair is taken, in any order.
pub fn absences(signs: &[Sign], taken: &[(Micros, Micros)], least: Micros) -> Vec<Absence> {
    let bouts: Vec<&[Sign]> = signs.chunk_by(|a, b| b.at - a.at <= BOUT).collect();
    let mut absences = Vec::new();
    let mut before: Option<&[Sign]> = None;
    let mut stray = 0;
    for bout in bouts {
        if bout.len() < LEAST_FIRINGS && !bout.iter().any(|sign| sign.is_use) {
            stray += bout.len();
            continue;
        }
        if let Some((begin, end)) = before.and_then(|before| leaves(before).zip(comes(bout))) {
            let in_between = |&(from, to): &(Micros, Micros)| to.min(end) - from.max(begin) > SEATED;
            if end - begin > least && !taken.iter().any(in_between) {
                let is_guess = !before.is_some_and(|before| has_door(before.iter().rev(), end_of(before)))
                    || !has_door(bout.iter(), end);
                absences.push(Absence { begin, end, stray, is_guess });
            }
        }
        (before, stray) = (Some(bout), 0);
    }
    absences
}

fn end_of(bout: &[Sign]) -> Micros {
    bout.last().map_or(0, |sign| sign.at)
}

/// Whether a door is opened near an instant, by the signs from there on.
fn has_door<'a>(mut signs: impl Iterator<Item = &'a Sign>, at: Micros) -> bool {
    signs.by_ref().take_while(|sign| (sign.at - at).abs() <= EDGE).any(|sign| sign.opens_door)
}

/// The end of a bout, if that is somebody who leaves.
fn leaves(bout: &[Sign]) -> Option<Micros> {
    let end = bout.last()?.at;
    let last = bout.iter().rev().take_while(|sign| end - sign.at <= EDGE);
    last.into_iter().any(|sign| sign.at_entrance).then_some(end)
}

/// The beginning of a bout, if that is somebody who comes home.
fn comes(bout: &[Sign]) -> Option<Micros> {
    let begin = bout.first()?.at;
    bout.iter().take_while(|sign| sign.at - begin <= EDGE).any(|sign| sign.at_entrance).then_some(begin)
}

impl Absence {
    /// How long it is, in hours.
    pub fn hours(&self) -> f64 {
        seconds(self.end - self.begin) / 3600.0
    }
}

fn told<S: Serializer>(at: &Micros, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&format_args!("{} {}", crate::dates::date_of(*at), crate::dates::clock_s(*at)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const MINUTE: Micros = 60 * SECOND;

    /// Signs by their seconds; those at the entrance are negative.
    fn signs(at_s: &[Micros]) -> Vec<Sign> {
        at_s.iter()
            .map(|&at| Sign { at: at.abs() * SECOND, at_entrance: at < 0, opens_door: false, is_use: false })
            .collect()
    }

    fn found(at_s: &[Micros], taken: &[(Micros, Micros)]) -> Vec<(Micros, Micros, usize)> {
        let found = absences(&signs(at_s), taken, LEAST);
        found.iter().map(|absence| (absence.begin / SECOND, absence.end / SECOND, absence.stray)).collect()
    }

    #[test]
    fn who_leaves_and_comes_by_the_door_is_away() {
        assert_eq!(found(&[10, 20, -30, -4000, 4010, 4020], &[]), [(30, 4000, 0)]);
        // The hall sensor sees the back that goes out, and is first to see who comes.
        assert_eq!(found(&[10, -20, 40, 4000, -4010, 4020], &[]), [(40, 4000, 0)]);
        // Half an hour is no absence yet, a second more is.
        assert_eq!(found(&[10, 20, -30, -1830, 1840, 1850], &[]), []);
        assert_eq!(found(&[10, 20, -30, -1831, 1840, 1850], &[]), [(30, 1831, 0)]);
    }

    #[test]
    fn a_long_sleep_is_no_absence() {
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
        // Three in a row are somebody's, here of somebody who did not come by the door.
        assert_eq!(found(&[10, 20, -30, 5000, 5100, 5200, -20_000, 20_010, 20_020], &[]), []);
    }

    #[test]
    fn where_the_bed_is_taken_somebody_is_there() {
        let day = [10, 20, -30, -30_000, 30_010, 30_020];
        assert_eq!(found(&day, &[(100 * SECOND, 20_000 * SECOND)]), []);
        // Not for as long as a motion sensor of that name blinks, and not before or after.
        assert_eq!(found(&day, &[(100 * SECOND, 102 * SECOND)]).len(), 1);
        assert_eq!(found(&day, &[(0, 30 * SECOND), (30_000 * SECOND, 90_000 * SECOND)]).len(), 1);
    }

    #[test]
    fn where_no_door_is_seen_to_open_it_is_a_guess() {
        let mut day = signs(&[10, 20, -30, -4000, 4010, 4020]);
        assert!(absences(&day, &[], LEAST)[0].is_guess);
        day[2].opens_door = true;
        assert!(absences(&day, &[], LEAST)[0].is_guess, "nobody was seen to come");
        day[3].opens_door = true;
        assert!(!absences(&day, &[], LEAST)[0].is_guess);
    }

    #[test]
    fn a_log_without_signs_has_no_absences() {
        assert_eq!(found(&[], &[]), []);
        assert_eq!(found(&[-10], &[]), []);
        assert!(absences(&signs(&[10, 20, -30, -4000, 4010, 4020]), &[], 120 * MINUTE).is_empty());
    }
}
