//! Nights: time in bed, sleep, wakefulness and visits to the toilet.
//!
//! A night lasts from lying down to getting up for good, between two noons. Other activities in between, such as going to the toilet,
//! are part of it.

use super::record::{BodyMovement, PersonRecord, hours, minutes};
use homebody_core::activity::{GOING_TO_BED, LYING_AWAKE, SLEEPING, USING_BATHROOM};
use homebody_core::posture::Posture;
use homebody_core::statistics::{mean, sd, share};
use homebody_core::time::{DAY, Interval, RunTime};
use homebody_timeline::Episode;
use serde::Serialize;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Night {
    /// Hours since the midnight before it: 23.5, or 24.5 after midnight.
    pub to_bed_h: f64,
    /// Hours since the midnight in it.
    pub up_h: f64,
    pub in_bed_h: f64,
    pub asleep_h: f64,
    pub latency_min: f64,
    /// Minutes not asleep, after falling asleep and before getting up.
    pub awake_min: f64,
    pub trips: u32,
    pub time: Interval<RunTime>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NightlyFigures {
    pub nights: usize,
    pub to_bed_h: Option<f64>,
    pub to_bed_sd_h: Option<f64>,
    pub up_h: Option<f64>,
    pub up_sd_h: Option<f64>,
    pub in_bed_h: Option<f64>,
    pub asleep_h: Option<f64>,
    pub latency_min: Option<f64>,
    pub awake_min: Option<f64>,
    pub trips: Option<f64>,
    /// Shares of the nights with at least one trip, and with at least two.
    pub any_trip: Option<f64>,
    pub two_trips: Option<f64>,
    pub trip_min: Option<f64>,
}

pub const IN_BED: [&str; 3] = [GOING_TO_BED, SLEEPING, LYING_AWAKE];

/// The nights that end in the days that count; the first starts on the evening before them.
pub fn nights(lived: &PersonRecord, activities: &[Episode], moves: &[BodyMovement]) -> Vec<Night> {
    let days = lived.days.start - 1..lived.days.end - 1;
    days.filter_map(|day| night(lived, activities, moves, day)).collect()
}

fn night(lived: &PersonRecord, activities: &[Episode], moves: &[BodyMovement], day: i32) -> Option<Night> {
    let noon = |day: i32| activities.partition_point(|done| done.time.begin < lived.midnight(day) + DAY / 2);
    let of_night = &activities[noon(day)..noon(day + 1)];
    let mut in_bed = of_night.iter().enumerate().filter(|(_, done)| IN_BED.contains(&&*done.label));
    let (first, begin) = in_bed.clone().find_map(|(index, done)| Some((index, lies_from(moves, done.time)?)))?;
    let of_night = &of_night[first..=in_bed.next_back()?.0];
    let end = of_night.last()?.time.end;
    let asleep: Vec<&Episode> = of_night.iter().filter(|done| done.label == SLEEPING).collect();
    let asleep_h = asleep.iter().map(|done| hours(done.length())).sum();
    let fell_asleep = asleep.first()?.time.begin;
    Some(Night {
        to_bed_h: hours(begin - lived.midnight(day)),
        up_h: hours(end - lived.midnight(day + 1)),
        in_bed_h: hours(end - begin),
        asleep_h,
        latency_min: minutes(fell_asleep - begin),
        awake_min: minutes(end - fell_asleep) - asleep_h * 60.0,
        trips: of_night.iter().filter(|done| done.label == USING_BATHROOM).count() as u32,
        time: Interval::new(begin, end),
    })
}

fn lies_from(moves: &[BodyMovement], time: Interval<RunTime>) -> Option<RunTime> {
    let from = moves.partition_point(|moved| moved.time.end <= time.begin);
    let mut within = moves[from..].iter().take_while(|moved| moved.time.begin < time.end);
    within.find(|moved| moved.posture == Posture::Lying).map(|lies| lies.time.begin.max(time.begin))
}

impl NightlyFigures {
    pub fn measure(nights: &[Night], activities: &[Episode]) -> NightlyFigures {
        let all = |of: fn(&Night) -> f64| -> Vec<f64> { nights.iter().map(of).collect() };
        let in_night = |at: RunTime| {
            let night = nights.get(nights.partition_point(|night| night.time.end <= at));
            night.is_some_and(|night| night.time.begin <= at)
        };
        let trips = activities.iter().filter(|done| done.label == USING_BATHROOM && in_night(done.time.begin));
        let trip_min: Vec<f64> = trips.map(|trip| minutes(trip.length())).collect();
        NightlyFigures {
            nights: nights.len(),
            to_bed_h: mean(&all(|night| night.to_bed_h)),
            to_bed_sd_h: sd(&all(|night| night.to_bed_h)),
            up_h: mean(&all(|night| night.up_h)),
            up_sd_h: sd(&all(|night| night.up_h)),
            in_bed_h: mean(&all(|night| night.in_bed_h)),
            asleep_h: mean(&all(|night| night.asleep_h)),
            latency_min: mean(&all(|night| night.latency_min)),
            awake_min: mean(&all(|night| night.awake_min)),
            trips: mean(&all(|night| f64::from(night.trips))),
            any_trip: share(nights, |night| night.trips >= 1),
            two_trips: share(nights, |night| night.trips >= 2),
            trip_min: mean(&trip_min),
        }
    }
}
