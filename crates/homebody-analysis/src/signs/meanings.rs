//! The meanings of the values of a log, and of the words that only one sensor of it has.
//!
//! A sensor that is named as one of motion, a contact or a bed may say two texts in turn that no table has. Then it is a guess which of
//! them begins something: the opposite of a word that is known, the one that the other negates, or the one that holds for less of the time.

use super::names::{NamedKind, is_seat, known_and_named};
use homebody_core::names::words;
use homebody_core::sensed::{Kind, Meaning, meaning};
use homebody_core::states::{Says, says};
use homebody_core::time::Span;
use homebody_log::{Event, Log, ValuePair};

/// Ratio of the times of two texts at which the shorter one is rare (our choice).
const LESS: i64 = 2;

/// The meanings of the values of a log, each looked up once.
pub struct Meanings {
    /// By value: its meaning, and whether it is a number.
    values: Vec<(Says, bool)>,
    own: OwnWords,
}

impl Meanings {
    pub fn from_log<T>(log: &Log<T>) -> Meanings {
        let values = log.values.iter().map(|value| (says(value), is_number(value))).collect();
        Meanings { values, own: OwnWords::from_log(log) }
    }

    /// The meaning of a row, and whether its value is a number; `None` for a row that was added after the log was read.
    pub fn said<T>(&self, event: &Event<T>) -> Option<(Says, bool)> {
        let known = self.values.get(event.value as usize).copied()?;
        Some(self.own.says(event).map_or(known, |says| (says, false)))
    }

    pub fn says<T>(&self, event: &Event<T>) -> Says {
        self.said(event).map_or(Says::Else, |(says, _)| says)
    }
}

/// The words that single sensors of a log have for two states.
#[derive(Clone, Debug, Default)]
pub struct OwnWords {
    of_sensors: Vec<Option<TwoWords>>,
    not_understood: Vec<String>,
}

#[derive(Clone, Debug)]
struct TwoWords {
    on: u32,
    off: u32,
    is_contact: bool,
    because: String,
}

impl OwnWords {
    pub fn from_log<T>(log: &Log<T>) -> OwnWords {
        let mut own = OwnWords::default();
        for pair in &log.pairs {
            let (sensor, id) = (pair.sensor as usize, &log.sensors[pair.sensor as usize]);
            let texts = pair.values.map(|value| log.values[value as usize].as_str());
            // A sensor that says `pir` and `none` in turn is one of motion, whatever it is called.
            let says_pir = || texts.iter().any(|text| text.eq_ignore_ascii_case("pir")).then_some(Kind::Motion);
            let Some(kind) = kind_of_states(log, id).or_else(says_pir) else { continue };
            let Some((on, because)) = which_begins(pair, texts) else {
                own.not_understood.push(format!(
                    "{id} sends {:?} and {:?}; neither is a known state, so they count as readings",
                    texts[0], texts[1]
                ));
                continue;
            };
            own.of_sensors.resize(own.of_sensors.len().max(sensor + 1), None);
            own.of_sensors[sensor] = Some(TwoWords {
                on: pair.values[on],
                off: pair.values[1 - on],
                is_contact: kind == Kind::Contact,
                because: format!("{:?} is taken for ON, as {because}", texts[on]),
            });
        }
        own
    }

    pub fn says<T>(&self, event: &Event<T>) -> Option<Says> {
        let words = self.of_sensors.get(event.sensor as usize)?.as_ref()?;
        let (begins, ends) = if words.is_contact { (Says::Opens, Says::Closes) } else { (Says::Begins, Says::Ends) };
        match event.value {
            value if value == words.on => Some(begins),
            value if value == words.off => Some(ends),
            _ => None,
        }
    }

    /// The word of a sensor that means ON, and why; `None` without words of its own.
    pub fn because(&self, sensor: usize) -> Option<&str> {
        Some(&self.of_sensors.get(sensor)?.as_ref()?.because)
    }

    pub fn is_empty(&self) -> bool {
        self.of_sensors.is_empty()
    }

    /// A sentence on each sensor with two unknown words.
    pub fn not_understood(&self) -> &[String] {
        &self.not_understood
    }
}

/// The kind of a motion sensor, a contact or a place to sit or lie, by its source or its name.
fn kind_of_states<T>(log: &Log<T>, id: &str) -> Option<Kind> {
    let (known, named) = known_and_named(log, id);
    // An id such as that of `input_select.motion_mode` says what its entity is, whatever follows.
    if meaning("", id) == Some(Meaning::Is(Kind::Other)) {
        return None;
    }
    let is_seat = is_seat(id) || known.is_some_and(|known| is_seat(&known.name) || is_seat(&known.kind));
    match known.and_then(|known| meaning(&known.kind, "")) {
        Some(Meaning::Is(kind @ (Kind::Motion | Kind::Contact))) => return Some(kind),
        Some(Meaning::PresenceByName) => return Some(Kind::Motion),
        _ => {}
    }
    match named {
        Some((NamedKind::Motion, _)) => Some(Kind::Motion),
        Some((NamedKind::Contact | NamedKind::Door, _)) => Some(Kind::Contact),
        Some((NamedKind::Device, _)) => None,
        _ => is_seat.then_some(Kind::Used),
    }
}

/// The number of the text that begins something, and why; `None` where nothing tells.
fn which_begins(pair: &ValuePair, texts: [&str; 2]) -> Option<(usize, String)> {
    let said = texts.map(says);
    for (one, other) in [(0, 1), (1, 0)] {
        if said[one].is_sign() {
            let on = if said[one].is_on() { one } else { other };
            return Some((on, format!("{:?} is the other of its two words", texts[1 - on])));
        }
        if said[one] == Says::Unknown && pair.takes_turns {
            return Some((other, format!("{:?} is the other of its two words", texts[one])));
        }
        if negates(texts[one], texts[other]) {
            return Some((other, format!("{:?} negates it", texts[one])));
        }
    }
    let [first, second] = pair.held;
    match pair.takes_turns {
        true if first > Span::ZERO && first.saturating_mul(LESS) <= second => Some((0, LESS_TIME.to_owned())),
        true if second > Span::ZERO && second.saturating_mul(LESS) <= first => Some((1, LESS_TIME.to_owned())),
        _ => None,
    }
}

const LESS_TIME: &str = "it holds for less of the time";

/// A text is another one after letters or words that negate it, such as `unbelegt` of `belegt`.
fn negates(text: &str, other: &str) -> bool {
    let [text, other] = [text, other].map(|text| words(text).concat());
    other.chars().count() > 1 && text.len() > other.len() && text.ends_with(&other)
}

pub fn is_number(value: &str) -> bool {
    value.parse::<f64>().is_ok_and(f64::is_finite)
}
