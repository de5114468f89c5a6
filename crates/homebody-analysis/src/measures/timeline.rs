//! What measures are taken from: who was in which room, in bed, asleep and out, and from when to when. A log tells it in
//! `heard`, a truth in `lived`.

use super::rooms::{Purpose, Rooms};
use crate::density::Cell;
use crate::rows::Span;
use homebody_core::time::{DAY, Micros, SECOND, seconds};
use jiff::civil::Date;

/// A time in one room.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stay {
    /// The room, by its number.
    pub room: usize,
    /// From when, in microseconds since 1970 on the clock on the wall.
    pub begin: Micros,
    /// Until when.
    pub end: Micros,
}

impl Stay {
    /// How long it lasts.
    pub fn lasts(&self) -> Micros {
        self.end - self.begin
    }
}

/// The way from one sensor to another, as they speak one after the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passage {
    /// When the second one speaks.
    pub at: Micros,
    /// How fast it was gone, as multiples of what is usual between the two.
    pub of_usual: f64,
}

/// A walk whose length is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Walk {
    /// When it ended.
    pub at: Micros,
    /// How fast it was, in metres a second.
    pub speed_m_s: f64,
}

/// What is known of some days.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Timeline {
    /// The first day, and midnight at its beginning.
    pub first: Date,
    /// The same in microseconds since 1970.
    pub begin: Micros,
    /// For how many hours of each hour of each day anything is known.
    pub recorded_h: Vec<[f64; 24]>,
    /// The rooms.
    pub rooms: Rooms,
    /// Whether most signs are of what is used, so that nobody knows where somebody is meanwhile, and how often they move.
    pub is_unwatched: bool,
    /// The unknown times, in order.
    pub unknown: Vec<Span>,
    /// Who was where, in order of time.
    pub stays: Vec<Stay>,
    /// When nobody was at home.
    pub away: Option<Vec<Span>>,
    /// When somebody was in bed: by night and by day.
    pub in_bed: Option<Vec<Span>>,
    /// When somebody was asleep in bed.
    pub asleep: Option<Vec<Span>>,
    /// When somebody stirred in bed: the beginnings of bouts.
    pub stirs: Option<Vec<Micros>>,
    /// Whether showers are guessed.
    pub guesses_showers: bool,
    /// Whether the bathroom's motion sensors stay on for so long that visits to it are a guess.
    pub hides_visits: bool,
    /// Whether the bathroom's motion sensors stay on for so long that they hide showers.
    pub hides_showers: bool,
    /// Whether the bedroom's motion sensors stay on for so long that they hide movements in bed.
    pub hides_stirs: bool,
    /// Whether the times in bed are a guess by what is used in the bedroom.
    pub guesses_nights: bool,
    /// When showers and baths began.
    pub showers: Option<Vec<Micros>>,
    /// When meals began, or their cooking where only that is known.
    pub meals: Option<Vec<Micros>>,
    /// How fast somebody walked.
    pub passages: Option<Vec<Passage>>,
    /// The same in metres a second, where the home is known.
    pub walks: Option<Vec<Walk>>,
    /// When somebody besides the resident was there.
    pub company: Option<Vec<Span>>,
    /// How much is said in each hour.
    pub cells: Option<Vec<[Cell; 24]>>,
}

/// Longest gap within one night in bed (our choice).
const OUT_OF_BED: Micros = 90 * 60 * SECOND;

/// Duration below which a night is a nap (our choice).
const LEAST_NIGHT: Micros = 2 * 3600 * SECOND;

impl Timeline {
    /// How many days there are.
    pub fn days(&self) -> usize {
        self.recorded_h.len()
    }

    /// From midnight to midnight.
    pub fn day(&self, day: usize) -> Span {
        let begin = self.begin + day as Micros * DAY;
        (begin, begin + DAY)
    }

    /// For how many hours between two instants anything is known, to the hour.
    pub fn known_h(&self, span: Span) -> f64 {
        let hour = 3600 * SECOND;
        let hours = (span.0 - self.begin).div_euclid(hour)..(span.1 - self.begin).div_euclid(hour);
        let known = hours.filter_map(|hour| {
            let day = self.recorded_h.get(usize::try_from(hour.div_euclid(24)).ok()?)?;
            Some(day[hour.rem_euclid(24) as usize])
        });
        known.sum()
    }

    /// The stays in rooms for this; those that are no farther apart than `apart` are one.
    pub fn visits(&self, purpose: Purpose, apart: Micros) -> Vec<Span> {
        let stays = self.stays.iter().filter(|stay| self.rooms.purpose(stay.room) == purpose);
        joined(stays.map(|stay| (stay.begin, stay.end)), apart)
    }

    /// The night in bed that ends on a day: from lying down to getting up, with the times out of bed in between. If the resident is in bed for
    /// longer than a day, the night lasts from noon to noon.
    pub fn night(&self, day: usize) -> Option<Span> {
        let (midnight, end) = self.day(day);
        let (from, to) = (midnight - DAY / 2, midnight + DAY / 2);
        // A night that ends before midnight belongs to the day before.
        let of_day = self.lain((from, to), end).into_iter().filter(|(_, night)| night.1 > midnight);
        let (lain, night) = of_day.max_by_key(|(lain, _)| *lain)?;
        let night = if night.1 - night.0 > DAY { (night.0.max(from), night.1.min(to)) } else { night };
        (lain >= LEAST_NIGHT).then_some(night)
    }

    /// The last time in bed of a day, if it lasts until midnight; by that day alone.
    pub fn evening(&self, day: usize) -> Option<Span> {
        let (midnight, end) = self.day(day);
        let (_, (begin, until)) = self.lain((midnight + DAY / 2, end), end).pop()?;
        (until >= end - OUT_OF_BED).then_some((begin, end))
    }

    /// The times in bed that touch a span, as known at `end`: the time lain in each, and its span.
    fn lain(&self, (from, to): Span, end: Micros) -> Vec<(Micros, Span)> {
        let in_bed = self.in_bed.iter().flatten().filter(|span| span.1 > from && span.0 < to);
        let mut nights: Vec<(Micros, Span)> = Vec::new();
        for (begin, end) in in_bed.map(|span| (span.0, span.1.min(end))) {
            match nights.last_mut().filter(|(_, night)| begin - night.1 <= OUT_OF_BED) {
                Some((lain, night)) => {
                    *lain += end - begin;
                    night.1 = end;
                }
                None => nights.push((end - begin, (begin, end))),
            }
        }
        nights
    }
}

/// Spans in order of time, of which those no farther apart than this are one.
pub fn joined(spans: impl Iterator<Item = Span>, apart: Micros) -> Vec<Span> {
    let mut joined: Vec<Span> = Vec::new();
    for (begin, end) in spans {
        match joined.last_mut().filter(|last| begin - last.1 <= apart) {
            Some(last) => last.1 = last.1.max(end),
            None => joined.push((begin, end)),
        }
    }
    joined
}

/// For how many hours some spans, of which none are at once, lie within another.
pub fn within_h(spans: &[Span], within: Span) -> f64 {
    let part = |span: &Span| (span.1.min(within.1) - span.0.max(within.0)).max(0);
    seconds(spans.iter().map(part).sum()) / 3600.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signs::without;

    const H: Micros = 3600 * SECOND;

    #[test]
    fn spans_are_joined_and_cut() {
        assert_eq!(joined([(0, 2), (3, 5), (9, 10)].into_iter(), 1), [(0, 5), (9, 10)]);
        assert_eq!(without(&[(0, 10), (12, 20)], &[(2, 3), (5, 13), (19, 30)]), [(0, 2), (3, 5), (13, 19)]);
        assert!((within_h(&[(0, 2 * H), (3 * H, 4 * H)], (H, 4 * H)) - 2.0).abs() < 1e-9);
    }

    #[test]
    fn a_night_is_the_longest_time_in_bed_with_what_interrupts_it() {
        // A nap after lunch, the night with a way to the bathroom, and an hour in the morning that is far from it.
        let in_bed = vec![(14 * H, 15 * H), (22 * H, 26 * H), (26 * H + H / 4, 31 * H), (34 * H, 35 * H)];
        let timeline = Timeline { recorded_h: vec![[1.0; 24]; 2], in_bed: Some(in_bed), ..Timeline::default() };
        assert_eq!(timeline.night(1), Some((22 * H, 31 * H)));
        assert_eq!(timeline.night(0), None);
        // What ends at eleven in the evening is no night that ends on the next day.
        let by_day = Timeline { in_bed: Some(vec![(14 * H, 23 * H)]), ..timeline.clone() };
        assert_eq!((by_day.night(0), by_day.night(1)), (None, None));
        // By the end of the first day the resident is in bed since ten.
        assert_eq!((timeline.evening(0), timeline.evening(1)), (Some((22 * H, 24 * H)), None));
        // Nobody is in bed for more than 24 hours a day.
        let ill = Timeline { in_bed: Some(vec![(-80 * H, 90 * H)]), ..timeline.clone() };
        assert_eq!(ill.night(1), Some((12 * H, 36 * H)));
        assert!((timeline.known_h((12 * H, 36 * H)) - 24.0).abs() < 1e-9);
        assert!((timeline.known_h((-12 * H, 12 * H)) - 12.0).abs() < 1e-9);
    }
}
