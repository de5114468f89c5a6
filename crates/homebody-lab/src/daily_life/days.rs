//! Days: what the time goes into, meals, naps, visits to the toilet, ways through the home.

use super::nights::IN_BED;
use super::record::{BodyMovement, HALF_HOUR, PersonRecord, minutes, overlap_h, speed_mps};
use homebody_core::activity::{
    AWAY, DRINKING, EATING_BREAKFAST, EATING_DINNER, EATING_LUNCH, HAVING_A_SNACK, NAPPING, TimeUse, USING_BATHROOM,
    WAITING, WALKING,
};
use homebody_core::posture::Posture;
use homebody_core::statistics::{mean, sd};
use homebody_core::time::{Interval, RunTime};
use homebody_timeline::Episode;
use serde::Serialize;

pub const USES: usize = TimeUse::ALL.len();

/// Days of one person; counts are means per day. A visit to the toilet is by day unless it interrupts a night in bed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DailyFigures {
    pub days: usize,
    /// Hours of a day, by [`TimeUse::ALL`].
    pub hours: [f64; USES],
    /// The share of each use in each hour of the day.
    pub by_hour: [[f64; USES]; 24],
    pub away_h: f64,
    pub toilet: f64,
    pub toilet_min: Option<f64>,
    pub meals: f64,
    pub three_meals: f64,
    pub occasions: f64,
    /// The share of days with a nap, the length of a nap, and the hours of naps in each half hour of the day.
    pub naps: f64,
    pub nap_min: Option<f64>,
    pub nap_half_hours: Vec<f64>,
    pub rooms: f64,
    pub hall: f64,
    pub rises: f64,
    pub pace_mps: Option<f64>,
    pub pace_sd_mps: Option<f64>,
}

const MEALS: [&str; 3] = [EATING_BREAKFAST, EATING_LUNCH, EATING_DINNER];

const OCCASIONS: [&str; 5] = [EATING_BREAKFAST, EATING_LUNCH, EATING_DINNER, HAVING_A_SNACK, DRINKING];

impl DailyFigures {
    pub fn measure(lived: &PersonRecord, activities: &[Episode], moves: &[BodyMovement]) -> DailyFigures {
        let span = lived.span();
        let days = lived.days.len().max(1);
        let a_day = |count: usize| count as f64 / days as f64;
        let begun = |names: &[&str]| -> Vec<&Episode> {
            activities.iter().filter(|one| names.contains(&&*one.label) && span.contains(one.time.begin)).collect()
        };
        // The way there and a wait are rows of their own.
        let at_their_place: Vec<&Episode> =
            activities.iter().filter(|one| ![WALKING, WAITING].contains(&&*one.label)).collect();
        let visits = at_their_place
            .windows(2)
            .filter(|pair| pair[1].label == USING_BATHROOM && !IN_BED.contains(&&*pair[0].label));
        let toilet: Vec<&Episode> =
            visits.map(|pair| pair[1]).filter(|visit| span.contains(visit.time.begin)).collect();
        let naps: Vec<&Episode> = begun(&[NAPPING]);
        let mut eaten = vec![[false; MEALS.len()]; days];
        for meal in begun(&MEALS) {
            if let (Some(day), Some(which)) =
                (eaten.get_mut(lived.clock(meal.time.begin).0), MEALS.iter().position(|name| *name == meal.label))
            {
                day[which] = true;
            }
        }
        let count = |day: &[bool; 3]| day.iter().filter(|&&eaten| eaten).count();
        let mut napped: Vec<usize> = naps.iter().map(|nap| lived.clock(nap.time.begin).0).collect();
        napped.dedup();
        let rooms: Vec<(RunTime, &str)> =
            lived.rooms().into_iter().skip(1).filter(|(at, _)| span.contains(*at)).collect();
        let first = moves.partition_point(|moved| moved.time.begin < span.begin);
        let moves = &moves[first..moves.partition_point(|moved| moved.time.begin < span.end)];
        let rises = moves.windows(2).filter(|pair| pair[0].posture != Posture::Standing && is_up(&pair[1])).count();
        let speeds: Vec<f64> = moves.iter().filter_map(speed_mps).collect();
        let hours = hours(activities, span).map(|hours| hours / days as f64);
        DailyFigures {
            days,
            hours,
            by_hour: by_hour(lived, activities),
            away_h: activities.iter().filter(|one| one.label == AWAY).map(|one| overlap_h(one, span)).sum::<f64>()
                / days as f64,
            toilet: a_day(toilet.len()),
            toilet_min: mean(&toilet.iter().map(|visit| minutes(visit.length())).collect::<Vec<_>>()),
            meals: a_day(eaten.iter().map(count).sum()),
            three_meals: a_day(eaten.iter().filter(|day| count(day) == 3).count()),
            occasions: a_day(begun(&OCCASIONS).len()),
            naps: a_day(napped.len()),
            nap_min: mean(&naps.iter().map(|nap| minutes(nap.length())).collect::<Vec<_>>()),
            nap_half_hours: half_hours(lived, &naps),
            rooms: a_day(rooms.len()),
            hall: a_day(rooms.iter().filter(|(_, room)| Some(*room) == lived.hall).count()),
            rises: a_day(rises),
            pace_mps: mean(&speeds),
            pace_sd_mps: sd(&speeds),
        }
    }
}

fn is_up(moved: &BodyMovement) -> bool {
    moved.posture == Posture::Standing
}

fn hours(activities: &[Episode], within: Interval<RunTime>) -> [f64; USES] {
    let mut hours = [0.0; USES];
    for done in activities {
        hours[TimeUse::from_label(&done.label) as usize] += overlap_h(done, within);
    }
    hours
}

fn by_hour(lived: &PersonRecord, activities: &[Episode]) -> [[f64; USES]; 24] {
    let mut shares = [[0.0; USES]; 24];
    let days = lived.days.len().max(1) as f64;
    for day in lived.days.clone() {
        let (midnight, next) = (lived.midnight(day), lived.midnight(day + 1));
        let hour = (next - midnight) / 24;
        let first = activities.partition_point(|done| done.time.end <= midnight);
        let today = activities[first..].iter().take_while(|done| done.time.begin < next);
        for done in today {
            for (index, shares) in (0..).zip(&mut shares) {
                let within = Interval::starting(midnight + hour * index, hour);
                shares[TimeUse::from_label(&done.label) as usize] += overlap_h(done, within) / days;
            }
        }
    }
    shares
}

/// Hours of naps in each half hour of the day.
fn half_hours(lived: &PersonRecord, naps: &[&Episode]) -> Vec<f64> {
    let mut hours = vec![0.0; 48];
    for nap in naps {
        let mut at = nap.time.begin;
        while at < nap.time.end {
            let (_, hour) = lived.clock(at);
            let slot = (hour * 2.0) as usize % 48;
            let next = (at + HALF_HOUR - (at - lived.span().begin).rem_euclid(HALF_HOUR)).min(nap.time.end);
            hours[slot] += overlap_h(nap, Interval::new(at, next));
            at = next;
        }
    }
    hours
}
