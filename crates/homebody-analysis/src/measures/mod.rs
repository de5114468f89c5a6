//! What a person has been doing, day by day: bed and sleep, bathroom, meals, outings, ways and their pace, sitting, density.
//!
//! A measure is written once, in `of_day`, and is taken from a `Timeline`: who was in which room, in bed, asleep and out. A
//! log tells it in `heard`, a truth by `Timeline::lived`, so that the two can be held against each other. What
//! each measure is, with its unit, its definition and the source of that, stands in `MEASURES`.
//!
//! A day of which more than an hour is unknown has no values, and a night none of its own: nothing is filled in. Left out: who
//! of several residents it was; visitors are guessed, and what they do is measured as if the resident did it.

mod company;
mod fhir;
mod heard;
mod held;
mod kinds;
mod known;
mod lived;
mod of_day;
mod rooms;
mod signs;
mod silent;
mod table;
mod timeline;
mod told;
mod walking;
mod wandering;
mod ways;

use crate::density::{Asked, Chosen, NoMap};
use crate::signs::LogSensors;
use homebody_log::{Life, Log};
use of_day::Common;

pub use held::{Day, Measures, Silent};
pub use kinds::{MEASURES, Measure};
pub use known::Known;
pub use lived::Beside;
pub use of_day::OfDay;
pub use rooms::{Purpose, Rooms};
pub use timeline::{Passage, Span, Stay, Timeline, Walk, joined};
pub use ways::Ways;

impl Measures {
    /// Of a log, with what its home tells.
    ///
    /// # Errors
    ///
    /// [`NoMap`] where no sensor tells of motion, or the days are too many.
    pub fn heard(name: &str, log: &Log, known: &Known, asked: &Asked) -> Result<Measures, NoMap> {
        let sensors = LogSensors::of(log);
        let (timeline, map) = Timeline::heard(log, &sensors, known, asked)?;
        let mut remarks = Vec::new();
        // A door out is in no room.
        let of_sensors = log.sensors.iter().zip(&timeline.rooms.of_sensors);
        let unplaced =
            of_sensors.filter(|(sensor, room)| room.is_none() && !map.entrance.sensors.contains(sensor)).count();
        if timeline.rooms.rooms.is_empty() {
            remarks.push("No sensor's name tells its room, so nothing of rooms, bed, meals and showers is known; --home tells which room each is in".to_owned());
        } else if unplaced > 0 {
            let are = if unplaced == 1 { "is" } else { "are" };
            remarks.push(format!("{unplaced} of {} sensors {are} in no room that is known", log.sensors.len()));
        }
        for (purpose, room, lacking) in [
            (Purpose::Bedroom, "bedroom", "nights"),
            (Purpose::Bathroom, "bathroom", "visits to it and showers"),
            (Purpose::Kitchen, "kitchen", "meals"),
        ] {
            if !timeline.rooms.rooms.is_empty() && !timeline.rooms.has(purpose) {
                remarks.push(format!("No sensor is in a {room}, so nothing is known of {lacking}"));
            }
        }
        let mut guesses = Vec::new();
        match map.entrance.chosen {
            Chosen::None => remarks.push("No sensor is at an entrance, so nothing is known of outings".to_owned()),
            Chosen::Guessed => {
                guesses.extend(["time_out", "outings"]);
                remarks.push(format!(
                    "Outings are a guess: the entrance is taken to be at {}",
                    map.entrance.sensors.join(", ")
                ));
            }
            Chosen::Asked | Chosen::Known if map.absences.iter().all(|absence| !absence.is_guess) => {}
            Chosen::Asked | Chosen::Known => {
                remarks.push("Some outings are told by no door that was opened: somebody was at the entrance, and then there was silence".to_owned());
            }
        }
        if timeline.showers.is_none() && timeline.rooms.has(Purpose::Bathroom) {
            remarks.push(
                "No motion sensor is in the bathroom and no sensor at the shower, so nothing is known of showers"
                    .to_owned(),
            );
        }
        if timeline.is_unwatched {
            remarks.push("Most sensors tell what is used, not who moves, so nothing is known of ways from room to room and of sitting".to_owned());
        }
        if timeline.guesses_nights {
            guesses.extend(["time_in_bed", "bedtime", "rising", "bathroom_night"]);
            remarks.push("Nights are a guess by what is used in the bedroom: no motion sensor is there, and none tells of the bed".to_owned());
        } else if timeline.in_bed.is_some() && timeline.asleep.is_none() {
            remarks.push("No motion sensor is in the bedroom, so time in bed is known, and sleep is not".to_owned());
        }
        if timeline.guesses_showers {
            guesses.push("showers");
            remarks.push("Showers are a guess by long stays in the bathroom: no sensor is at the shower".to_owned());
        }
        if timeline.company.is_some() {
            guesses.extend(["company", "visits"]);
            remarks.push("Visitors are a guess by uses of the door with somebody at home before and after, and by how lively it is between them".to_owned());
        }
        let mut measures = Measures { guesses, ..Measures::of(name, &timeline, remarks) };
        let away = timeline.away.clone().unwrap_or_default();
        let last = log.events.iter().map(|event| event.at).max().unwrap_or(timeline.begin);
        let silences = silent::silences(log, &sensors.kinds, &away, last);
        measures.leave_out(&silences, log, &timeline.rooms, &map.entrance);
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
        let common = Common::of(timeline);
        let first = timeline.first;
        let days = (0..timeline.days()).map(|number| {
            let day = OfDay::new(&common, number);
            let values = MEASURES.iter().map(|measure| (measure.of)(&day)).collect();
            let date = first.saturating_add(jiff::Span::new().days(number as i64));
            Day { date, is_whole: day.is_known(), values }
        });
        Measures {
            name: name.to_owned(),
            measures: MEASURES,
            remarks,
            guesses: Vec::new(),
            silent: Vec::new(),
            days: days.collect(),
        }
    }
}

#[cfg(test)]
mod tests;
