//! The timeline that measures are taken from: rooms, times in bed, sleep and absences. `log_timeline` builds it from a log,
//! `truth_timeline` from a truth.

use super::rooms::{Purpose, SensorRooms};
use crate::density::DensityCell;
use homebody_core::time::{DAY, HOUR, Interval, MINUTE, Span, WallTime, joined};
use homebody_timeline::Episode;
use jiff::civil::Date;

pub type RoomStay = Episode<WallTime, usize>;

/// The way from one sensor to another that fires next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorPassage {
    pub at: WallTime,
    /// The pace, as multiples of the usual time between the two.
    pub of_usual: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimedWalk {
    /// The end of the walk.
    pub at: WallTime,
    pub speed_m_s: f64,
}

/// The timeline of some days, from sensors or from a truth, that measures are taken from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeasureTimeline {
    pub first: Date,
    /// Midnight at the begin of the first day.
    pub begin: WallTime,
    /// The known part of each hour of each day, in hours.
    pub recorded_h: Vec<[f64; 24]>,
    pub rooms: SensorRooms,
    /// Most signs come from things that are used, so that rooms and movements in between are unknown.
    pub is_unwatched: bool,
    pub unknown: Vec<Interval<WallTime>>,
    pub stays: Vec<RoomStay>,
    pub away: Option<Vec<Interval<WallTime>>>,
    /// The times in bed, by night and by day.
    pub in_bed: Option<Vec<Interval<WallTime>>>,
    pub asleep: Option<Vec<Interval<WallTime>>>,
    /// The movements in bed: the beginnings of bouts.
    pub stirs: Option<Vec<WallTime>>,
    pub guesses_showers: bool,
    /// The bathroom's motion sensors stay on for so long that visits to it are a guess.
    pub hides_visits: bool,
    /// The bathroom's motion sensors stay on for so long that they hide showers.
    pub hides_showers: bool,
    /// The bedroom's motion sensors stay on for so long that they hide movements in bed.
    pub hides_stirs: bool,
    /// The times in bed are a guess by the things that are used in the bedroom.
    pub guesses_nights: bool,
    /// The beginnings of showers and baths.
    pub showers: Option<Vec<WallTime>>,
    /// The beginnings of meals, or of their cooking where only that is known.
    pub meals: Option<Vec<WallTime>>,
    pub passages: Option<Vec<SensorPassage>>,
    /// The walks of known length, where the home is known.
    pub walks: Option<Vec<TimedWalk>>,
    pub company: Option<Vec<Interval<WallTime>>>,
    pub cells: Option<Vec<[DensityCell; 24]>>,
}

/// Longest gap within one night in bed (our choice).
pub(super) const OUT_OF_BED: Span = MINUTE.times(90);

/// Duration below which a night is a nap (our choice).
pub(super) const LEAST_NIGHT: Span = HOUR.times(2);

impl MeasureTimeline {
    pub fn days(&self) -> usize {
        self.recorded_h.len()
    }

    pub fn day(&self, day: usize) -> Interval<WallTime> {
        Interval::starting(self.begin + day as i64 * DAY, DAY)
    }

    pub fn known_h(&self, span: Interval<WallTime>) -> f64 {
        let hours = span.map(|at| (at - self.begin).div_euclid(HOUR));
        let known = (hours.begin..hours.end).filter_map(|hour| {
            let day = self.recorded_h.get(usize::try_from(hour.div_euclid(24)).ok()?)?;
            Some(day[hour.rem_euclid(24) as usize])
        });
        known.sum()
    }

    /// The stays in rooms for this; those that are no farther apart than `apart` are one.
    pub fn visits(&self, purpose: Purpose, apart: Span) -> Vec<Interval<WallTime>> {
        let stays = self.stays.iter().filter(|stay| self.rooms.purpose(stay.label) == purpose);
        joined(stays.map(|stay| stay.time), apart)
    }

    /// The night in bed that ends on a day: from lying down to getting up, with the times out of bed in between. If the resident is in bed for
    /// longer than a day, the night lasts from noon to noon.
    pub fn night(&self, day: usize) -> Option<Interval<WallTime>> {
        let Interval { begin: midnight, end } = self.day(day);
        let noons = Interval::new(midnight - DAY / 2, midnight + DAY / 2);
        // A night that ends before midnight belongs to the day before.
        let of_day = self.lain(noons, end).into_iter().filter(|(_, night)| night.end > midnight);
        let (lain, night) = of_day.max_by_key(|(lain, _)| *lain)?;
        let night = if night.length() > DAY { night.intersection(noons) } else { night };
        (lain >= LEAST_NIGHT).then_some(night)
    }

    /// The last time in bed of a day, if it lasts until midnight; by that day alone.
    pub fn evening(&self, day: usize) -> Option<Interval<WallTime>> {
        let Interval { begin: midnight, end } = self.day(day);
        let (_, last) = self.lain(Interval::new(midnight + DAY / 2, end), end).pop()?;
        (last.end >= end - OUT_OF_BED).then_some(Interval::new(last.begin, end))
    }

    /// The times in bed that touch a span, as known at `end`: the time lain in each, and from when to when it is.
    fn lain(&self, span: Interval<WallTime>, end: WallTime) -> Vec<(Span, Interval<WallTime>)> {
        let in_bed = self.in_bed.iter().flatten().filter(|one| one.overlaps(span));
        let mut nights: Vec<(Span, Interval<WallTime>)> = Vec::new();
        for one in in_bed.map(|one| Interval::new(one.begin, one.end.min(end))) {
            match nights.last_mut().filter(|(_, night)| one.begin - night.end <= OUT_OF_BED) {
                Some((lain, night)) => {
                    *lain += one.length();
                    night.end = one.end;
                }
                None => nights.push((one.length(), one)),
            }
        }
        nights
    }
}

/// The hours of some intervals without overlaps that lie within another.
pub fn within_h(spans: &[Interval<WallTime>], within: Interval<WallTime>) -> f64 {
    spans.iter().map(|span| span.overlap(within)).sum::<Span>().seconds() / 3600.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::span;

    fn hours(from: i64, to: i64) -> Interval<WallTime> {
        span(from * 3600, to * 3600)
    }

    #[test]
    fn hours_within_a_span_are_counted() {
        assert!((within_h(&[hours(0, 2), hours(3, 4)], hours(1, 4)) - 2.0).abs() < 1e-9);
    }

    #[test]
    fn a_night_is_the_longest_time_in_bed_with_what_interrupts_it() {
        // A nap after lunch, the night with a way to the bathroom, and an hour in the morning that is far from it.
        let after = Interval { begin: hours(26, 31).begin + HOUR / 4, ..hours(26, 31) };
        let in_bed = vec![hours(14, 15), hours(22, 26), after, hours(34, 35)];
        let timeline =
            MeasureTimeline { recorded_h: vec![[1.0; 24]; 2], in_bed: Some(in_bed), ..MeasureTimeline::default() };
        assert_eq!(timeline.night(1), Some(hours(22, 31)));
        assert_eq!(timeline.night(0), None);
        // A time in bed that ends at eleven in the evening is not a night that ends on the next day.
        let by_day = MeasureTimeline { in_bed: Some(vec![hours(14, 23)]), ..timeline.clone() };
        assert_eq!((by_day.night(0), by_day.night(1)), (None, None));
        // By the end of the first day the resident is in bed since ten.
        assert_eq!((timeline.evening(0), timeline.evening(1)), (Some(hours(22, 24)), None));
        // Nobody is in bed for more than 24 hours a day.
        let ill = MeasureTimeline { in_bed: Some(vec![hours(-80, 90)]), ..timeline.clone() };
        assert_eq!(ill.night(1), Some(hours(12, 36)));
        assert!((timeline.known_h(hours(12, 36)) - 24.0).abs() < 1e-9);
        assert!((timeline.known_h(hours(-12, 12)) - 12.0).abs() < 1e-9);
    }
}
