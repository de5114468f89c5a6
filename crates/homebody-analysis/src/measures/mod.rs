//! What a person has been doing, day by day: bed and sleep, bathroom, meals, outings, ways and their pace, sitting, density.
//!
//! A measure is written once, in `of_day`, and is taken from a `Timeline`: who was in which room, in bed, asleep and out. A
//! log tells it in `heard`, a truth by `Timeline::lived`, so that the two can be held against each other. What
//! each measure is, with its unit, its definition and the source of that, stands in `MEASURES`.
//!
//! A day of which more than an hour is unknown has no values, and a night none of its own: nothing is filled in. Left out: who
//! of several residents it was; visitors are guessed, and what they do is measured as if the resident did it.

mod company;
mod day_by_day;
mod fhir;
mod heard;
mod held;
mod kinds;
mod known;
mod known_time;
mod lived;
mod noted;
mod of_day;
mod remarks;
mod rooms;
mod signs;
mod silent;
mod table;
mod timeline;
mod told;
mod walking;
mod wandering;
mod ways;

use crate::density::{Asked, NoMap};
use homebody_log::{Life, Log};
use of_day::Common;
use remarks::Remarks;

pub use crate::rows::Span;
pub use day_by_day::Measuring;
pub use held::{Day, Measures, Noted, Silent};
pub use kinds::{MEASURES, Measure, Unit};
pub use known::Known;
pub use lived::Beside;
pub use of_day::OfDay;
pub use rooms::{Purpose, Rooms};
pub use timeline::{Passage, Stay, Timeline, Walk, joined};
pub use ways::Ways;

impl Measures {
    /// Of a log, with what its home tells.
    ///
    /// # Errors
    ///
    /// [`NoMap`] where no sensor tells of motion, or the days are too many.
    pub fn heard(name: &str, log: &Log, known: &Known, asked: &Asked) -> Result<Measures, NoMap> {
        let mut measuring = Measuring::new(log, *known, asked);
        log.in_order().into_iter().try_for_each(|event| measuring.take(event))?;
        Measures::of_rows(name, measuring)
    }

    /// Of the rows of a log that have been taken one by one.
    ///
    /// # Errors
    ///
    /// As of [`Measures::heard`].
    pub fn of_rows(name: &str, measuring: Measuring) -> Result<Measures, NoMap> {
        let (log, known, recorded) = (measuring.log, measuring.known, measuring.recorded());
        let measured = measuring.end()?;
        let Remarks { remarks, guesses } = Remarks::of(log, &known, &measured);
        let (days, silent, rooms) = (measured.days, measured.silent, measured.all_rooms);
        let guessed = log.sensors.iter().zip(0..).filter(|_| known.rooms.is_empty());
        let guessed_rooms =
            guessed.filter_map(|(id, sensor)| Some((id.clone(), rooms.name_of(sensor)?.into()))).collect();
        let mut measures = Measures {
            name: name.to_owned(),
            measures: MEASURES,
            remarks,
            guesses,
            silent,
            guessed_rooms,
            days,
            ..Measures::default()
        };
        if let Some(recorded) = recorded {
            measures.hold_beside(&log.activities, recorded);
        }
        Ok(measures)
    }

    /// Of a truth, for the days of a log.
    pub fn lived(name: &str, life: &Life, recorded: std::ops::Range<homebody_core::time::Micros>) -> Measures {
        Measures::of(name, &Timeline::lived(life, recorded), Vec::new())
    }

    /// The same, with what is known besides.
    pub fn lived_beside(
        name: &str,
        life: &Life,
        beside: &Beside,
        recorded: std::ops::Range<homebody_core::time::Micros>,
    ) -> Measures {
        Measures::of(name, &Timeline::lived_beside(life, beside, recorded), Vec::new())
    }

    /// Of a timeline.
    pub fn of(name: &str, timeline: &Timeline, remarks: Vec<String>) -> Measures {
        let common = Common::of(timeline, None);
        let first = timeline.first;
        let days = (0..timeline.days()).map(|number| {
            let day = OfDay::new(&common, number, true);
            let values = MEASURES.iter().map(|measure| (measure.of)(&day)).collect();
            let date = first.saturating_add(jiff::Span::new().days(number as i64));
            Day { date, is_whole: day.is_known(), values }
        });
        Measures { name: name.to_owned(), measures: MEASURES, remarks, days: days.collect(), ..Measures::default() }
    }
}

#[cfg(test)]
mod future;
#[cfg(test)]
mod tests;
