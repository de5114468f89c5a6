//! What measures are taken from, as a truth tells it.

use super::rooms::{Rooms, purpose};
use super::timeline::{Stay, Timeline, Walk, joined};
use crate::dates::{date_of, midnight};
use crate::rows::Span;
use homebody_core::activity::{
    AWAY, EATING_BREAKFAST, EATING_DINNER, EATING_LUNCH, GOING_TO_BED, LYING_AWAKE, SHOWERING, SLEEPING,
};
use homebody_core::time::{DAY, Micros, SECOND};
use homebody_log::Life;
use std::ops::Range;

/// Longest gap within one activity (our choice): a walk to the toilet does not make a second meal.
const APART: Micros = 5 * 60 * SECOND;

/// What a truth tells of a resident besides their rooms and what they do.
#[derive(Clone, Debug, Default)]
pub struct Beside {
    /// How fast they walked, in order of time.
    pub walks: Option<Vec<Walk>>,
    /// When guests were in the home.
    pub company: Option<Vec<Span>>,
}

impl Timeline {
    /// As the truth tells it of one resident, for the days that touch `recorded`.
    pub fn lived(life: &Life, recorded: Range<Micros>) -> Timeline {
        Timeline::lived_beside(life, &Beside::default(), recorded)
    }

    /// The same, with what is known besides.
    pub fn lived_beside(life: &Life, beside: &Beside, recorded: Range<Micros>) -> Timeline {
        let first = date_of(recorded.start);
        let begin = midnight(first);
        let days =
            (recorded.end - begin).max(0).div_euclid(DAY) + i64::from((recorded.end - begin).rem_euclid(DAY) > 0);
        let hour = 3600 * SECOND;
        let known = |at: Micros| {
            let span = ((at + hour).min(recorded.end) - at.max(recorded.start)).clamp(0, hour);
            span as f64 / hour as f64
        };
        let hours = |day: i64| std::array::from_fn(|number| known(begin + day * DAY + number as Micros * hour));
        let mut rooms = Rooms::default();
        let mut stays: Vec<Stay> = Vec::new();
        for one in life.rooms.iter().filter(|one| one.name != AWAY) {
            let room = rooms.number((one.name.clone(), purpose(&one.name)));
            match stays.last_mut().filter(|stay| stay.room == room && stay.end >= one.begin) {
                Some(stay) => stay.end = one.end,
                None => stays.push(Stay { room, begin: one.begin, end: one.end }),
            }
        }
        let of = |labels: &[&str]| -> Vec<Span> {
            let done = life.activities.iter().filter(|one| labels.contains(&one.name.as_str()));
            done.map(|one| (one.begin, one.end)).collect()
        };
        let begins = |labels: &[&str]| -> Option<Vec<Micros>> {
            Some(joined(of(labels).into_iter(), APART).into_iter().map(|span| span.0).collect())
        };
        Timeline {
            first,
            begin,
            recorded_h: (0..days).map(hours).collect(),
            rooms,
            stays,
            away: Some(joined(of(&[AWAY]).into_iter(), 0)),
            in_bed: Some(joined(of(&[GOING_TO_BED, SLEEPING, LYING_AWAKE]).into_iter(), SECOND)),
            asleep: Some(of(&[SLEEPING])),
            showers: begins(&[SHOWERING]),
            meals: begins(&[EATING_BREAKFAST, EATING_LUNCH, EATING_DINNER]),
            walks: beside.walks.clone(),
            company: beside.company.as_ref().map(|company| {
                let mut company = company.clone();
                company.sort_unstable();
                joined(company.into_iter(), APART)
            }),
            ..Timeline::default()
        }
    }
}
