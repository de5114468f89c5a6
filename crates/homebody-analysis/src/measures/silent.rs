//! Sensors that have fallen silent, and the measures that cannot be taken without them.

use super::held::{Day, Measures, Silent};
use super::kinds::Measure;
use super::rooms::{Purpose, Rooms};
use super::timeline::{Span, within_h};
use crate::dates::date_of;
use crate::density::Entrance;
use crate::signs::Kind;
use homebody_core::time::{DAY, Micros};
use homebody_log::Log;

/// A sensor is silent that says nothing for so long while somebody is at home, and for so many times as long as ever before
/// (ours), as of `look`.
const SILENT: Micros = 2 * DAY;
const SILENT_TIMES: Micros = 3;
/// Only of a sensor of what is used or opened that has spoken on so many days before, and on three of four, silence says anything (ours): a drawer may stay
/// closed for a week.
const LEAST_DAYS: i64 = 4;
const OF_DAYS: (i64, i64) = (3, 4);

/// A silence: whose, from when, and until when.
pub(super) struct Silence {
    sensor: usize,
    span: Span,
    told: Micros,
    speaks_again: bool,
}

/// The silences of sensors of movements and of what is used, up to `last`.
pub(super) fn silences(log: &Log, kinds: &[Kind], away: &[Span], last: Micros) -> Vec<Silence> {
    let mut before: Vec<Option<Micros>> = vec![None; log.sensors.len()];
    let mut longest: Vec<Micros> = vec![0; log.sensors.len()];
    // By sensor: the first day on which it spoke, and on how many it has.
    let mut spoken: Vec<(i64, i64)> = vec![(0, 0); log.sensors.len()];
    let mut found = Vec::new();
    let mut ends = |sensor: usize, at: Micros, before: Option<Micros>, speaks_again: bool| {
        let day = |at: Micros| at.div_euclid(DAY);
        let (first, days) = spoken[sensor];
        let is_regular = before.is_some_and(|since| {
            let so_far = day(since) - first + 1;
            kinds[sensor] == Kind::Motion && longest[sensor] > 0
                || days >= LEAST_DAYS && days * OF_DAYS.1 >= so_far * OF_DAYS.0
        });
        match before {
            None => spoken[sensor] = (day(at), 1),
            Some(since) => spoken[sensor].1 += i64::from(day(since) < day(at)),
        }
        // What is no longer than another silence before it changes nothing.
        let Some(since) = before.filter(|since| at - since > longest[sensor]) else { return };
        let away = (within_h(away, (since, at)) * DAY as f64 / 24.0) as Micros;
        let quiet = at - since - away;
        let least = SILENT.max(longest[sensor] * SILENT_TIMES);
        if quiet >= least && is_regular {
            found.push(Silence { sensor, span: (since, at), told: since + least + away, speaks_again });
        } else {
            longest[sensor] = longest[sensor].max(quiet);
        }
    };
    for event in log.in_order() {
        let sensor = event.sensor as usize;
        ends(sensor, event.at, before[sensor].replace(event.at), true);
    }
    for (sensor, at) in before.into_iter().enumerate() {
        ends(sensor, last, at, false);
    }
    found.retain(|silence| !matches!(kinds[silence.sensor], Kind::Reading | Kind::Other));
    found
}

/// Whether a measure needs a sensor.
fn needs(measure: &Measure, sensor: &str, room: Option<Purpose>, entrance: &Entrance) -> bool {
    match measure.name {
        "time_in_bed" | "bedtime" | "rising" | "sleep" | "restlessness" => room == Some(Purpose::Bedroom),
        "bathroom_night" | "bathroom_day" | "showers" => room == Some(Purpose::Bathroom),
        "meals" => room == Some(Purpose::Kitchen),
        "time_out" | "outings" => entrance.sensors.iter().any(|known| known == sensor),
        _ => true,
    }
}

impl Measures {
    /// Takes out what cannot be measured while sensors are silent.
    pub(super) fn leave_out(&mut self, silences: &[Silence], log: &Log, rooms: &Rooms, entrance: &Entrance) {
        for silence in silences {
            let name = &log.sensors[silence.sensor];
            let room = rooms.of_sensors[silence.sensor].map(|room| rooms.purpose(room));
            let [since, until, told] = [silence.span.0, silence.span.1, silence.told].map(date_of);
            let silent = |day: &&mut Day| (since..=until).contains(&day.date);
            for day in self.days.iter_mut().filter(silent) {
                for (measure, value) in self.measures.iter().zip(&mut day.values) {
                    if needs(measure, name, room, entrance) {
                        *value = None;
                    }
                }
            }
            let until = silence.speaks_again.then_some(until);
            self.silent.push(Silent { sensor: name.clone(), since, told, until });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::SECOND;
    use homebody_log::Event;

    const H: Micros = 3600 * SECOND;

    /// A log in which one sensor speaks each hour, and the other each second hour but for a time.
    fn log(quiet: std::ops::Range<Micros>) -> Log {
        let mut log = Log {
            sensors: vec!["hall motion".into(), "kitchen motion".into()],
            values: vec!["ON".into()],
            ..Log::default()
        };
        for hour in 0..240 {
            log.events.push(Event { at: hour * H, sensor: 0, value: 0 });
            if hour % 2 == 0 && !quiet.contains(&hour) {
                log.events.push(Event { at: hour * H, sensor: 1, value: 0 });
            }
        }
        log
    }

    fn found(log: &Log, away: &[Span]) -> Vec<(usize, Micros, Micros)> {
        found_of(log, Kind::Motion, away)
    }

    fn found_of(log: &Log, kind: Kind, away: &[Span]) -> Vec<(usize, Micros, Micros)> {
        let found = silences(log, &[kind; 2], away, 240 * H);
        found.iter().map(|silence| (silence.sensor, silence.span.0 / H, silence.span.1 / H)).collect()
    }

    #[test]
    fn a_sensor_that_says_nothing_for_days_is_silent() {
        assert_eq!(found(&log(100..240), &[]), [(1, 98, 240)]);
        assert_eq!(found(&log(100..160), &[]), [(1, 98, 160)]);
        assert_eq!(found(&log(100..130), &[]), []);
        // A contact, if it has spoken on days enough.
        assert_eq!(found_of(&log(100..240), Kind::Contact, &[]), [(1, 98, 240)]);
        assert_eq!(found_of(&log(70..240), Kind::Contact, &[]), []);
        assert_eq!(found(&log(70..240), &[]), [(1, 68, 240)]);
        // With nobody at home it has nothing to say.
        assert_eq!(found(&log(100..160), &[(101 * H, 150 * H)]), []);
    }
}
