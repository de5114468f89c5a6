//! What the words of a log mean, and which sensors could say something now.

use homebody_core::states::says;
use homebody_core::time::Micros;

/// A message of a sensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Message {
    /// When, in microseconds since the start.
    pub at: Micros,
    /// Index into the home's sensors.
    pub sensor: usize,
    /// What it says.
    pub said: Said,
}

/// What a message says, whatever its words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Said {
    /// It saw movement, or it is on, open, or has somebody in it.
    On,
    /// That is over.
    Off,
    /// Something else that is no number: how restless a sleeper is, say.
    Word,
}

/// How many kinds of messages a sensor has.
pub(crate) const KINDS: usize = 3;

impl Said {
    /// What a value of a log means; `None` of a number, which says nothing of where somebody is.
    pub fn of(value: &str) -> Option<Said> {
        match says(value) {
            says if says.is_on() => return Some(Said::On),
            says if says.is_off() => return Some(Said::Off),
            _ => {}
        }
        value.parse::<f64>().is_err().then_some(Said::Word)
    }
}

/// The number of the channel of a kind of message.
pub(crate) fn channel(sensor: usize, said: Said) -> usize {
    sensor * KINDS + said as usize
}

/// When a sensor cannot say something, however much there is to say.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Timing {
    /// Whether it says that something is over.
    pub has_off: bool,
    /// Whether it is on because somebody is there, and not because of what they did last.
    pub feels: bool,
    /// For so long after a message it does not say ON.
    pub blind: Micros,
}

/// What a sensor has said last.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Last {
    pub is_on: bool,
    /// Before this it does not say ON.
    pub blind_until: Micros,
}

impl Last {
    /// After a message.
    pub fn hear(&mut self, message: &Message, timing: &Timing) {
        match message.said {
            Said::On => self.is_on = timing.has_off,
            Said::Off => self.is_on = false,
            Said::Word => return,
        }
        self.blind_until = message.at + timing.blind;
    }

    /// For how much of a span it cannot say ON.
    pub fn deaf(&self, from: Micros, to: Micros) -> Micros {
        if self.is_on { to - from } else { (self.blind_until.min(to) - from).max(0) }
    }

    /// For how much of a span it may say OFF.
    pub fn may_end(&self, from: Micros, to: Micros) -> Micros {
        if self.is_on { to - from } else { 0 }
    }
}
