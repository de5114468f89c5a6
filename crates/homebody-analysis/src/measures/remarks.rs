//! Sentences on the limits of a log: unknown measures, and guesses.

use super::day_by_day::MeasuredLog;
use super::rooms::Purpose;
use super::ways::HomeKnowledge;
use crate::density::EntranceSource;
use crate::phrases::listed;
use crate::signs::OwnWords;
use homebody_core::problem::counted;
use homebody_log::Log;

pub struct Remarks {
    pub remarks: Vec<String>,
    pub guesses: Vec<&'static str>,
}

impl Remarks {
    pub fn from_log(log: &Log, known: &HomeKnowledge, measured: &MeasuredLog) -> Remarks {
        let mut told = Remarks { remarks: Vec::new(), guesses: Vec::new() };
        told.remarks.extend_from_slice(OwnWords::from_log(log).not_understood());
        if !measured.has_motion {
            told.remark("The log has no motion sensor; the measures rely on doors and on sensors of use");
        }
        told.rooms(log, known, measured);
        told.outings(measured);
        let timeline = &measured.timeline;
        if timeline.hides_showers {
            told.remark("Showers are unknown: the motion sensor in the bathroom stays on for more than a minute after a movement");
        } else if timeline.showers.is_none() && timeline.rooms.has(Purpose::Bathroom) {
            told.remark("Showers are unknown: no motion sensor is in the bathroom, and no sensor at the shower");
        }
        if timeline.is_unwatched {
            told.remark("Room changes and sitting are unknown: most sensors report the use of things, not movement");
        }
        if timeline.guesses_nights {
            told.guess(&["time_in_bed", "bedtime", "rising", "bathroom_night"]);
            told.remark("Nights are estimated from the use of things in the bedroom (no motion sensor there, and none in the bed)");
        } else if timeline.in_bed.is_some() && timeline.asleep.is_none() {
            told.remark("Time in bed is known, but not sleep: no motion sensor is in the bedroom");
        }
        if timeline.hides_visits {
            told.guess(&["bathroom_day", "bathroom_night"]);
            told.remark(
                "Bathroom visits are estimated: the motion sensor stays on for more than 20 s after a movement, so a walk past the door may count",
            );
        }
        if timeline.hides_stirs {
            told.remark("Restlessness in bed is unknown: a motion sensor in the bedroom stays on for more than 30 s after a movement");
        }
        if timeline.guesses_showers {
            told.guess(&["showers"]);
            told.remark("Showers are estimated from long stays in the bathroom (no sensor in the shower)");
        }
        if timeline.company.is_some() {
            told.guess(&["company", "visits"]);
            told.remark("Visitors are estimated from uses of the front door with the home occupied before and after, and from more movement between them than usual");
        }
        if measured.crowded > 0 {
            let days = counted(measured.crowded, "day", "days");
            told.remark(&format!("No values for {days} with more rows than any home sends"));
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

    fn rooms(&mut self, log: &Log, known: &HomeKnowledge, measured: &MeasuredLog) {
        let (rooms, telling) = (&measured.all_rooms, &measured.timeline.rooms);
        // A door out is in no room.
        let of_sensors = log.sensors.iter().zip(&rooms.of_sensors);
        let at_entrance = &measured.entrance.sensors;
        let unplaced = of_sensors.filter(|(sensor, room)| room.is_none() && !at_entrance.contains(sensor)).count();
        if rooms.rooms.is_empty() {
            self.remark("Rooms, bed, meals and showers are unknown: no sensor name contains a room; pass --home to name the rooms");
            return;
        }
        if known.rooms.is_empty() {
            self.remark(
                "Rooms are guessed from sensor names; pass --home to name them, or see guessed_rooms in the JSON",
            );
        }
        if unplaced > 0 {
            self.remark(&format!("The room of {unplaced} of {} sensors is unknown", log.sensors.len()));
        }
        for (purpose, room, lacking) in [
            (Purpose::Bedroom, "bedroom", "Nights"),
            (Purpose::Bathroom, "bathroom", "Bathroom visits and showers"),
            (Purpose::Kitchen, "kitchen", "Kitchen meals"),
        ] {
            if !rooms.has(purpose) {
                self.remark(&format!("{lacking} are unknown: no sensor is in a {room}"));
            } else if !telling.has(purpose) {
                self.remark(&format!("{lacking} are unknown: no sensor in the {room} detects the resident"));
            }
        }
    }

    fn outings(&mut self, measured: &MeasuredLog) {
        match measured.entrance.chosen {
            EntranceSource::None => self.remark("Outings are unknown: no sensor is at an entrance"),
            EntranceSource::Guessed => {
                self.guess(&["time_out", "outings"]);
                let sensors = listed(&measured.entrance.sensors);
                self.remark(&format!("Outings are estimated, with the entrance taken to be at {sensors}"));
            }
            EntranceSource::Asked | EntranceSource::Known if !measured.guesses_absences => {}
            EntranceSource::Asked | EntranceSource::Known => {
                self.remark("Some outings are estimated: movement at the entrance, then no movement at home");
            }
        }
    }
}
