//! Which rows of a log are signs of somebody, and of which sensors.
//!
//! Logs do not tell what their sensors are, so we go by what they say: a sensor is taken for what most of its rows
//! look like. Motion begins and ends (`ON`, `OFF`, `true`, `FIRE`), contacts open and close, and all else that is no
//! number is something that somebody used. Where values alone mislead, names decide: those of CASAS's lights are `L`
//! and a number, and a mattress that says `ON` has not moved. A bed, a chair or a stove may be where a motion sensor looks, as in
//! names of CASAS such as `BedroomABed`: it is one if it is `ON` for seconds. The words are ours.

use homebody_core::names::words;
use homebody_core::time::{Micros, SECOND};
use homebody_log::Log;
use serde::Serialize;

/// What one row says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Says {
    /// Something began: a movement, a press, a use.
    Begins,
    /// What began is over.
    Ends,
    /// A door, a drawer or a window is opened.
    Opens,
    /// It is closed.
    Closes,
    /// A number, or a word that is not known.
    Else,
}

/// What a sensor is taken for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// It sees movement.
    Motion,
    /// A door, a drawer, a window.
    Contact,
    /// A light's switch, a mattress, an item: it is used, but no movement is seen.
    Used,
    /// A temperature, a battery, a brightness.
    Reading,
}

/// What a value says, whatever the case of its letters.
pub fn says(value: &str) -> Says {
    const WORDS: [(Says, &[&str]); 4] = [
        (Says::Begins, &["on", "fire", "fired", "true", "1", "present", "detected", "occupied", "motion", "in"]),
        (Says::Ends, &["off", "false", "0", "absent", "clear", "cleared", "unoccupied", "vacant", "idle", "out"]),
        (Says::Opens, &["open", "opened"]),
        (Says::Closes, &["close", "closed"]),
    ];
    let known = WORDS.iter().find(|(_, words)| words.iter().any(|word| word.eq_ignore_ascii_case(value)));
    known.map_or(Says::Else, |&(says, _)| says)
}

/// What the sensors of a log are taken for, in its order.
pub fn kinds(log: &Log) -> Vec<Kind> {
    let says: Vec<Says> = log.values.iter().map(|value| says(value)).collect();
    let is_number: Vec<bool> = log.values.iter().map(|value| value.parse::<f64>().is_ok()).collect();
    // Those that tell a number beside 0 and 1: where they tell these, they are numbers, too.
    let mut numbers = vec![false; log.sensors.len()];
    for event in &log.events {
        numbers[event.sensor as usize] |= is_number[event.value as usize] && says[event.value as usize] == Says::Else;
    }
    // Rows that look like motion, a contact, a reading.
    let mut rows = vec![[0_u64; 3]; log.sensors.len()];
    for event in &log.events {
        let looks = match says[event.value as usize] {
            Says::Begins | Says::Ends if numbers[event.sensor as usize] && is_number[event.value as usize] => 2,
            Says::Begins | Says::Ends => 0,
            Says::Opens | Says::Closes => 1,
            Says::Else if is_number[event.value as usize] => 2,
            // A word about something that goes on, such as how restless somebody is.
            Says::Else => continue,
        };
        rows[event.sensor as usize][looks] += 1;
    }
    let spans = spans(log);
    let kind = |(sensor, &[motion, contact, reading]): (usize, &[u64; 3])| match () {
        () if reading > motion.max(contact) || motion + contact == 0 => Kind::Reading,
        () if contact > motion => Kind::Contact,
        () if is_named(&log.sensors[sensor], &THINGS) => Kind::Used,
        () if is_named(&log.sensors[sensor], &PLACES) && !is_brief(&spans[sensor]) => Kind::Used,
        () => Kind::Motion,
    };
    rows.iter().enumerate().map(kind).collect()
}

/// The spans over which each sensor says that something goes on, in order. Where a sensor never says that it ends, a span
/// is an instant; what has not ended when the log does ends as it begins.
pub fn spans(log: &Log) -> Vec<Vec<(Micros, Micros)>> {
    let mut order: Vec<usize> = (0..log.events.len()).collect();
    // Real logs are not always in order.
    order.sort_by_key(|&index| log.events[index].at);
    let mut ends = vec![false; log.sensors.len()];
    for event in &log.events {
        ends[event.sensor as usize] |= matches!(says(log.value(event)), Says::Ends | Says::Closes);
    }
    let mut spans = vec![Vec::new(); log.sensors.len()];
    let mut since: Vec<Option<Micros>> = vec![None; log.sensors.len()];
    for event in order.into_iter().map(|index| &log.events[index]) {
        let sensor = event.sensor as usize;
        match says(log.value(event)) {
            Says::Begins | Says::Opens if ends[sensor] => since[sensor] = since[sensor].or(Some(event.at)),
            Says::Begins | Says::Opens => spans[sensor].push((event.at, event.at)),
            Says::Ends | Says::Closes => spans[sensor].extend(since[sensor].take().map(|begin| (begin, event.at))),
            Says::Else => {}
        }
    }
    for (spans, since) in spans.iter_mut().zip(since) {
        spans.extend(since.map(|begin| (begin, begin)));
    }
    spans
}

/// Things that are used, though they say `ON`.
const THINGS: [&str; 11] =
    ["light", "lamp", "switch", "pressure", "mattress", "mat", "item", "power", "water", "flow", "tv"];

/// Things that are used, or else places that a motion sensor looks at.
const PLACES: [&str; 3] = ["bed", "chair", "stove"];

/// Whether a name is that of one of these things, or of one of CASAS's lights and items: L012, I05.
fn is_named(name: &str, things: &[&str]) -> bool {
    let is_numbered = name.strip_prefix(['L', 'I']).is_some_and(|rest| rest.parse::<u32>().is_ok());
    let words = words(name);
    is_numbered
        || words.iter().any(|word| things.contains(&word.as_str())) && !words.iter().any(|word| word == "motion")
}

/// Whether something goes on for seconds at a time, as movements do: nobody lies, sits or cooks for so short.
fn is_brief(spans: &[(Micros, Micros)]) -> bool {
    /// At least half of the spans are shorter (ours).
    const BRIEF: Micros = 20 * SECOND;
    let of_length: Vec<Micros> = spans.iter().map(|(from, to)| to - from).filter(|&length| length > 0).collect();
    let brief = of_length.iter().filter(|&&length| length < BRIEF).count();
    brief > 0 && 2 * brief >= of_length.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::log;

    #[test]
    fn sensors_are_taken_for_what_most_of_their_rows_look_like() {
        let log = log(&[
            (0, "M1", "ON"),
            (1, "M1", "OFF"),
            (2, "M1", "ON0"),
            (3, "D1", "OPEN"),
            (4, "T1", "21.5"),
            (5, "T1", "1"),
            (6, "T1", "0"),
            (7, "L002", "ON"),
            (8, "mattress", "true"),
            (9, "hall", "FIRE"),
        ]);
        let wanted = [Kind::Motion, Kind::Contact, Kind::Reading, Kind::Used, Kind::Used, Kind::Motion];
        assert_eq!(kinds(&log), wanted);
    }

    #[test]
    fn a_bed_that_is_on_for_seconds_is_where_a_motion_sensor_looks() {
        let rows: Vec<(i64, &str, &str)> = (0..10)
            .flat_map(|time| {
                let (from, to) = (1000 * time, 1000 * time + 4);
                [(from, "BedroomBed", "ON"), (to, "BedroomBed", "OFF"), (from, "bed", "ON"), (to + 900, "bed", "OFF")]
            })
            .collect();
        assert_eq!(kinds(&log(&rows)), [Kind::Motion, Kind::Used]);
        // An instant tells nothing of how long it lasts.
        assert_eq!(kinds(&log(&[(0, "chair", "ON"), (1, "kitchen", "ON")])), [Kind::Used, Kind::Motion]);
    }

    #[test]
    fn what_our_own_sensors_say_first_begins_something() {
        for kind in homebody_core::sensors::kinds::KINDS {
            let Some(first) = kind.values.first() else { continue };
            let says = says(&first.to_string());
            assert!(matches!(says, Says::Begins | Says::Opens), "a {} sensor says {first}: {says:?}", kind.key);
        }
    }

    #[test]
    fn what_is_on_goes_on_until_it_is_off() {
        let log = log(&[
            (5, "M1", "ON"),
            (0, "M1", "ON"),
            (9, "M1", "OFF"),
            (9, "M1", "OFF"),
            (20, "M1", "ON"),
            (3, "hall", "FIRE"),
            (6, "hall", "FIRE"),
        ]);
        const S: Micros = homebody_core::time::SECOND;
        assert_eq!(spans(&log), [vec![(0, 9 * S), (20 * S, 20 * S)], vec![(3 * S, 3 * S), (6 * S, 6 * S)]]);
    }
}
