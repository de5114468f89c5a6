//! Measures of each day of a person: bed and sleep, bathroom, meals, outings, ways and their pace, sitting, density.
//!
//! Each measure has a row in `registry`, with unit, definition, source and words, and a function in `measured_day`. The function reads a
//! `MeasureTimeline`: the resident's rooms, times in bed, sleep and absences. `log_timeline` makes one from a log and `truth_timeline` one
//! from the truth, so that the measures of both can be compared.
//!
//! A day with more than an hour unknown has no values, and such a night has none: nothing is filled in. Left out: several residents are not
//! told apart; visitors are guessed, and their movement is measured as the resident's.

mod company;
mod day_by_day;
mod fhir;
mod values;
mod known_time;
mod log_timeline;
mod measure;
mod truth_timeline;
mod measured_day;
mod registry;
mod remarks;
mod rooms;
mod signs;
mod silences;
mod table;
mod timeline;
mod notes;
mod walking;
mod wandering;
mod ways;
mod wording;

use crate::density::{DensityOptions, NoMap};
use homebody_core::time::{Interval, WallTime};
use homebody_log::Log;
use homebody_timeline::PersonTimeline;
use measured_day::DayContext;
use remarks::Remarks;

pub use day_by_day::Measuring;
pub use measure::{DailyMeasure, MeasureGroup, MeasureUnit, NoteMeaning, SummaryUse, ValueForm};
pub use measured_day::MeasuredDay;
pub use registry::MEASURES;
pub use rooms::{Purpose, SensorRooms};
pub use timeline::{MeasureTimeline, RoomStay, SensorPassage, TimedWalk};
pub use truth_timeline::TruthDetails;
pub use values::{DayMeasures, Measures, NoteComparison, NotedDay, NotedMeasure, SilentSensor};
pub use ways::{HomeKnowledge, Ways};
pub(crate) use wording::Earlier;

impl Measures {
    pub fn from_log(name: &str, log: &Log, known: &HomeKnowledge, asked: &DensityOptions) -> Result<Measures, NoMap> {
        let mut measuring = Measuring::new(log, *known, asked);
        log.in_order().into_iter().try_for_each(|event| measuring.take(event))?;
        Measures::from_rows(name, measuring)
    }

    pub fn from_rows(name: &str, measuring: Measuring) -> Result<Measures, NoMap> {
        let (log, known, recorded) = (measuring.log, measuring.known, measuring.recorded());
        let measured = measuring.end()?;
        let Remarks { remarks, guesses } = Remarks::from_log(log, &known, &measured);
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
            measures.use_notes(&log.activities, recorded);
        }
        Ok(measures)
    }

    pub fn from_truth(name: &str, person: &PersonTimeline<WallTime>, recorded: Interval<WallTime>) -> Measures {
        Measures::from_timeline(name, &MeasureTimeline::from_truth(person, recorded), Vec::new())
    }

    pub fn from_detailed_truth(
        name: &str,
        person: &PersonTimeline<WallTime>,
        details: &TruthDetails,
        recorded: Interval<WallTime>,
    ) -> Measures {
        Measures::from_timeline(name, &MeasureTimeline::from_detailed_truth(person, details, recorded), Vec::new())
    }

    pub fn from_timeline(name: &str, timeline: &MeasureTimeline, remarks: Vec<String>) -> Measures {
        let common = DayContext::new(timeline, None);
        let first = timeline.first;
        let days = (0..timeline.days()).map(|number| {
            let day = MeasuredDay::new(&common, number, true);
            let values = MEASURES.iter().map(|measure| (measure.of)(&day)).collect();
            let date = first.saturating_add(jiff::Span::new().days(number as i64));
            DayMeasures { date, is_whole: day.is_known(), values }
        });
        Measures { name: name.to_owned(), measures: MEASURES, remarks, days: days.collect(), ..Measures::default() }
    }
}

#[cfg(test)]
mod future;
#[cfg(test)]
mod tests;
