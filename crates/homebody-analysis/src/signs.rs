//! Which rows of a log are signs of somebody, and of which sensors.
//!
//! Logs do not tell what their sensors are, so we go by what they say: a sensor is taken for what most of its rows
//! look like. Motion begins and ends (`ON`, `OFF`, `true`, `FIRE`), contacts open and close, and all else that is no
//! number is something that somebody used. Where values alone mislead, names decide: those of CASAS's lights are `L`
//! and a number, and a mattress that says `ON` has not moved. A bed, a chair or a stove may be where a motion sensor looks, as in
//! names of CASAS such as `BedroomABed`: it is one if it is `ON` for seconds. So are a fridge, a cabinet and a door, whose contacts
//! say `ON` in homes such as van Kasteren's, for seconds or for hours: where nothing but doors and fridges is `ON` for seconds, no sensor
//! looks. The words are ours.

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

impl Kind {
    /// In a word.
    pub fn word(self) -> &'static str {
        match self {
            Kind::Motion => "motion",
            Kind::Contact => "contact",
            Kind::Used => "used",
            Kind::Reading => "reading",
        }
    }
}

/// What a value says, whatever the case of its letters.
pub fn says(value: &str) -> Says {
    const WORDS: [(Says, &[&str]); 4] = [
        (
            Says::Begins,
            &["on", "fire", "fired", "true", "1", "present", "detected", "occupied", "motion", "in", "woke", "seen"],
        ),
        (
            Says::Ends,
            &["off", "false", "0", "absent", "clear", "cleared", "unoccupied", "vacant", "idle", "out", "slept"],
        ),
        (Says::Opens, &["open", "opened"]),
        (Says::Closes, &["close", "closed"]),
    ];
    let known = WORDS.iter().find(|(_, words)| words.iter().any(|word| word.eq_ignore_ascii_case(value)));
    known.map_or(Says::Else, |&(says, _)| says)
}

/// What a log tells of its sensors before anything else is asked of it; all in its order.
pub struct LogSensors {
    /// What they are called.
    pub called: Vec<String>,
    /// What they are taken for.
    pub kinds: Vec<Kind>,
}

impl LogSensors {
    /// Those of a log.
    pub fn of(log: &Log) -> LogSensors {
        LogSensors { called: log.called(), kinds: kinds(log) }
    }
}

/// What the sensors of a log are taken for, in its order.
pub fn kinds(log: &Log) -> Vec<Kind> {
    let looks: Vec<(Says, bool)> = log.values.iter().map(|value| (says(value), is_number(value))).collect();
    let mut tallies = vec![Tally::default(); log.sensors.len()];
    for event in log.in_order() {
        let (says, is_number) = looks[event.value as usize];
        tallies[event.sensor as usize].take(event.at, says, is_number);
    }
    kinds_of(&log.called().iter().map(String::as_str).zip(&tallies).collect::<Vec<_>>())
}

/// Where sensors look for movement, they tell more than one row of so many (ours).
const FEWER: u64 = 10;

/// What the sensors of one log are taken for, by their names and what their rows look like.
pub fn kinds_of(sensors: &[(&str, &Tally)]) -> Vec<Kind> {
    let mut kinds: Vec<Kind> = sensors.iter().map(|(name, tally)| tally.kind(name)).collect();
    let may_look = |((name, tally), kind): &(&(&str, &Tally), &Kind)| {
        let is_open = (is_named(name, &DOORS) || is_named(name, &PLACES)) && tally.spans > 0;
        **kind == Kind::Motion && !is_open
    };
    let rows = |(_, tally): &(&str, &Tally)| tally.motion + tally.contact;
    let looking: u64 = sensors.iter().zip(&kinds).filter(may_look).map(|(sensor, _)| rows(sensor)).sum();
    if looking * FEWER < sensors.iter().map(rows).sum() {
        for ((name, _), kind) in sensors.iter().zip(&mut kinds).filter(|(_, kind)| **kind == Kind::Motion) {
            *kind = if is_named(name, &DOORS) { Kind::Contact } else { Kind::Used };
        }
    }
    kinds
}

/// Whether a value is a number.
pub fn is_number(value: &str) -> bool {
    value.parse::<f64>().is_ok()
}

/// What the rows of one sensor look like, taken one by one in the order of time.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    motion: u64,
    contact: u64,
    reading: u64,
    /// Those of them that say 1 or 0: where a sensor tells other numbers, too, these are numbers as well.
    ones: u64,
    /// Since when something goes on.
    since: Option<Micros>,
    /// How often something went on for any time, and for how often that was for seconds.
    spans: u64,
    brief: u64,
}

impl Tally {
    /// Takes a row.
    pub fn take(&mut self, at: Micros, says: Says, is_number: bool) {
        match says {
            Says::Begins | Says::Ends => self.motion += 1,
            Says::Opens | Says::Closes => self.contact += 1,
            // Other words are about something that goes on, such as how restless somebody is.
            Says::Else => self.reading += u64::from(is_number),
        }
        self.ones += u64::from(is_number && says != Says::Else);
        match says {
            Says::Begins | Says::Opens => self.since = self.since.or(Some(at)),
            Says::Ends | Says::Closes => {
                if let Some(length) = self.since.take().map(|since| at - since).filter(|&length| length > 0) {
                    self.spans += 1;
                    self.brief += u64::from(length < BRIEF);
                }
            }
            Says::Else => {}
        }
    }

    /// What the sensor of this name is taken for where others look for movement.
    fn kind(&self, name: &str) -> Kind {
        let ones = if self.reading > 0 { self.ones } else { 0 };
        let (motion, contact, reading) = (self.motion - ones, self.contact, self.reading + ones);
        match () {
            () if reading > motion.max(contact) || motion + contact == 0 => Kind::Reading,
            () if contact > motion => Kind::Contact,
            () if is_named(name, &THINGS) => Kind::Used,
            () if is_named(name, &PLACES) && !self.is_brief() => Kind::Used,
            () if is_named(name, &["magnetic"]) => Kind::Contact,
            () if is_named(name, &DOORS) && self.spans > 0 && !self.is_brief() => Kind::Contact,
            () => Kind::Motion,
        }
    }

    /// Whether something goes on for seconds at a time, as movements do: nobody lies, sits or cooks for so short.
    fn is_brief(&self) -> bool {
        self.brief > 0 && 2 * self.brief >= self.spans
    }
}

/// At least half of the spans of what is brief are shorter (ours).
const BRIEF: Micros = 20 * SECOND;

/// From when to when something goes on, each time.
pub type Spans = Vec<(Micros, Micros)>;

/// The spans over which each sensor says that something goes on, in order. Where a sensor never says that it ends, a span
/// is an instant; what has not ended when the log does ends as it begins.
pub fn spans(log: &Log) -> Vec<Spans> {
    spans_until(log, None)
}

/// The same, but what has not ended when the log does ends at an instant, where one is given.
pub fn spans_until(log: &Log, end: Option<Micros>) -> Vec<Spans> {
    let mut ends = vec![false; log.sensors.len()];
    for event in &log.events {
        ends[event.sensor as usize] |= matches!(says(log.value(event)), Says::Ends | Says::Closes);
    }
    let mut spans = vec![Vec::new(); log.sensors.len()];
    let mut since: Vec<Option<Micros>> = vec![None; log.sensors.len()];
    for event in log.in_order() {
        let sensor = event.sensor as usize;
        match says(log.value(event)) {
            Says::Begins | Says::Opens if ends[sensor] => since[sensor] = since[sensor].or(Some(event.at)),
            Says::Begins | Says::Opens => spans[sensor].push((event.at, event.at)),
            Says::Ends | Says::Closes => spans[sensor].extend(since[sensor].take().map(|begin| (begin, event.at))),
            Says::Else => {}
        }
    }
    for (spans, since) in spans.iter_mut().zip(since) {
        spans.extend(since.map(|begin| (begin, end.map_or(begin, |end| end.max(begin)))));
    }
    spans
}

/// Things that are used, though they say `ON`.
const THINGS: [&str; 30] = [
    "light",
    "lamp",
    "switch",
    "pressure",
    "mattress",
    "mat",
    "item",
    "power",
    "water",
    "flow",
    "tv",
    "flush",
    "faucet",
    "burner",
    "electric",
    "dishwasher",
    "washingmachine",
    "microwave",
    "toaster",
    "freezer",
    "cupboard",
    "drawer",
    "machine",
    "maker",
    "fan",
    "kettle",
    "dryer",
    "disposal",
    "box",
    "dvd",
];

/// Doors and windows, which have a contact, or else where a motion sensor looks.
const DOORS: [&str; 5] = ["door", "window", "frontdoor", "maindoor", "backdoor"];

/// Things that are used, or else places that a motion sensor looks at.
const PLACES: [&str; 10] =
    ["bed", "chair", "stove", "oven", "fridge", "refrigerator", "cabinet", "closet", "wardrobe", "computer"];

/// Whether a name is that of one of these things, or of one of CASAS's lights and items: L012, I05.
fn is_named(name: &str, things: &[&str]) -> bool {
    let is_numbered = name.strip_prefix(['L', 'I']).is_some_and(|rest| rest.parse::<u32>().is_ok());
    let words = words(name);
    is_numbered
        || words.iter().any(|word| things.contains(&word.as_str())) && !words.iter().any(|word| word == "motion")
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
            .chain((0..5).map(|time| (1000 * time, "kitchen", "ON")))
            .collect();
        assert_eq!(kinds(&log(&rows)), [Kind::Motion, Kind::Used, Kind::Motion]);
        // An instant tells nothing of how long it lasts.
        assert_eq!(kinds(&log(&[(0, "chair", "ON"), (1, "kitchen", "ON")])), [Kind::Used, Kind::Motion]);
    }

    #[test]
    fn of_a_home_of_contacts_that_say_on_nothing_sees_movement() {
        let names = [
            ("Hall-Bedroom door", 600, Kind::Contact),
            ("Maindoor Magnetic Entrance", 9, Kind::Contact),
            ("Cups cupboard", 9, Kind::Used),
            ("ToiletFlush", 3, Kind::Used),
            ("Fridge", 40, Kind::Used),
            // Where a motion sensor looks at a door or a fridge, it is ON for seconds.
            ("BedroomADoor", 4, Kind::Motion),
            ("KitchenARefrigerator", 4, Kind::Motion),
            ("Basin PIR Bathroom", 600, Kind::Motion),
        ];
        let rows: Vec<(i64, &str, &str)> = (0..10)
            .flat_map(|time| {
                names.map(|(name, length, _)| [(1000 * time, name, "ON"), (1000 * time + length, name, "OFF")])
            })
            .flatten()
            .collect();
        assert_eq!(kinds(&log(&rows)), names.map(|(_, _, kind)| kind));
        // Without an end nobody knows for how long: it is what its values say.
        assert_eq!(kinds(&log(&[(0, "front door", "FIRE")])), [Kind::Motion]);
        // Where nothing else is ON for seconds, no sensor looks.
        let rows: Vec<(i64, &str, &str)> = (0..10)
            .flat_map(|time| {
                ["Frontdoor", "Fridge"].map(|name| [(1000 * time, name, "ON"), (1000 * time + 4, name, "OFF")])
            })
            .flatten()
            .collect();
        assert_eq!(kinds(&log(&rows)), [Kind::Contact, Kind::Used]);
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
