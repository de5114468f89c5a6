//! Sentences on the limits of a log: unknown measures, and guesses.

use super::day_by_day::Measured;
use super::known::Known;
use super::rooms::Purpose;
use crate::density::Chosen;
use crate::signs::OwnWords;
use homebody_core::problem::counted;
use homebody_log::Log;

/// The sentences, and the names of measures that are guessed.
pub struct Remarks {
    /// A sentence each.
    pub remarks: Vec<String>,
    /// The measures.
    pub guesses: Vec<&'static str>,
}

impl Remarks {
    /// Of a log that has been measured.
    pub fn of(log: &Log, known: &Known, measured: &Measured) -> Remarks {
        let mut told = Remarks { remarks: Vec::new(), guesses: Vec::new() };
        told.remarks.extend_from_slice(OwnWords::of(log).not_understood());
        if !measured.has_motion {
            told.remark("No sensor in it tells of motion: all that follows is by doors and by what is used");
        }
        told.rooms(log, known, measured);
        told.outings(measured);
        let timeline = &measured.timeline;
        if timeline.hides_showers {
            told.remark("The motion sensor in the bathroom stays on for more than a minute after a movement, so nothing is known of showers");
        } else if timeline.showers.is_none() && timeline.rooms.has(Purpose::Bathroom) {
            told.remark(
                "No motion sensor is in the bathroom and no sensor at the shower, so nothing is known of showers",
            );
        }
        if timeline.is_unwatched {
            told.remark("Most sensors tell what is used, not who moves, so nothing is known of ways from room to room and of sitting");
        }
        if timeline.guesses_nights {
            told.guess(&["time_in_bed", "bedtime", "rising", "bathroom_night"]);
            told.remark("Nights are a guess by what is used in the bedroom: no motion sensor is there, and none tells of the bed");
        } else if timeline.in_bed.is_some() && timeline.asleep.is_none() {
            told.remark("No motion sensor is in the bedroom, so time in bed is known, and sleep is not");
        }
        if timeline.hides_visits {
            told.guess(&["bathroom_day", "bathroom_night"]);
            told.remark(
                "Visits to the bathroom are a guess: its motion sensor stays on for more than 20 s after a movement, so passing its door may \
                 count as a visit",
            );
        }
        if timeline.hides_stirs {
            told.remark("A motion sensor in the bedroom stays on for more than 30 s after a movement, so nothing is known of restlessness");
        }
        if timeline.guesses_showers {
            told.guess(&["showers"]);
            told.remark("Showers are a guess by long stays in the bathroom: no sensor is at the shower");
        }
        if timeline.company.is_some() {
            told.guess(&["company", "visits"]);
            told.remark("Visitors are a guess by uses of the door with somebody at home before and after, and by how lively it is between them");
        }
        if measured.crowded > 0 {
            let days = counted(measured.crowded, "day", "days");
            told.remark(&format!("Nothing is measured of {days} with more rows than any home has"));
        }
        told
    }

    fn remark(&mut self, sentence: &str) {
        self.remarks.push(sentence.to_owned());
    }

    fn guess(&mut self, measures: &[&'static str]) {
        let new = measures.iter().filter(|measure| !self.guesses.contains(measure));
        self.guesses.extend(new.copied().collect::<Vec<_>>());
    }

    /// Remarks on rooms, and on measures that need a room without a sensor.
    fn rooms(&mut self, log: &Log, known: &Known, measured: &Measured) {
        let (rooms, telling) = (&measured.all_rooms, &measured.timeline.rooms);
        // A door out is in no room.
        let of_sensors = log.sensors.iter().zip(&rooms.of_sensors);
        let at_entrance = &measured.entrance.sensors;
        let unplaced = of_sensors.filter(|(sensor, room)| room.is_none() && !at_entrance.contains(sensor)).count();
        if rooms.rooms.is_empty() {
            self.remark("No sensor's name tells its room, so nothing of rooms, bed, meals and showers is known; --home tells which room each is in");
            return;
        }
        if known.rooms.is_empty() {
            self.remark("Rooms are a guess by the names of sensors, see guessed_rooms of the JSON; --home tells which room each is in");
        }
        if unplaced > 0 {
            let are = if unplaced == 1 { "is" } else { "are" };
            self.remark(&format!("{unplaced} of {} sensors {are} in no room that is known", log.sensors.len()));
        }
        for (purpose, room, lacking) in [
            (Purpose::Bedroom, "bedroom", "nights"),
            (Purpose::Bathroom, "bathroom", "visits to it and showers"),
            (Purpose::Kitchen, "kitchen", "meals"),
        ] {
            if !rooms.has(purpose) {
                self.remark(&format!("No sensor is in a {room}, so nothing is known of {lacking}"));
            } else if !telling.has(purpose) {
                self.remark(&format!("No sensor in the {room} detects the resident, so nothing is known of {lacking}"));
            }
        }
    }

    fn outings(&mut self, measured: &Measured) {
        match measured.entrance.chosen {
            Chosen::None => self.remark("No sensor is at an entrance, so nothing is known of outings"),
            Chosen::Guessed => {
                self.guess(&["time_out", "outings"]);
                let sensors = measured.entrance.sensors.join(", ");
                self.remark(&format!("Outings are a guess: the entrance is taken to be at {sensors}"));
            }
            Chosen::Asked | Chosen::Known if !measured.guesses_absences => {}
            Chosen::Asked | Chosen::Known => {
                self.remark("Some outings are told by no door that was opened: somebody was at the entrance, and then there was silence");
            }
        }
    }
}
