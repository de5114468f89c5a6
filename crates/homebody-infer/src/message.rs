//! Messages of a log, and which sensors can send one.

use homebody_core::states::says;
use homebody_core::time::{Interval, RunTime, Span};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LogMessage {
    pub at: RunTime,
    pub sensor: usize,
    pub said: MessageKind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MessageKind {
    /// Movement, or on, open, occupied.
    On,
    /// The end of On.
    Off,
    /// Another word, such as the restlessness of a sleeper.
    Word,
}

pub(crate) const KINDS: usize = 3;

impl MessageKind {
    /// `None` for a number, which carries no place.
    pub fn from_value(value: &str) -> Option<MessageKind> {
        match says(value) {
            says if says.is_on() => return Some(MessageKind::On),
            says if says.is_off() => return Some(MessageKind::Off),
            _ => {}
        }
        value.parse::<f64>().is_err().then_some(MessageKind::Word)
    }
}

pub(crate) fn channel(sensor: usize, said: MessageKind) -> usize {
    sensor * KINDS + said as usize
}

#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ReportTiming {
    pub has_off: bool,
    /// Whether it detects presence, and not movement.
    pub feels: bool,
    pub blind: Span,
}

#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LastMessage {
    pub is_on: bool,
    pub blind_until: RunTime,
}

impl LastMessage {
    pub fn hear(&mut self, message: &LogMessage, timing: &ReportTiming) {
        match message.said {
            MessageKind::On => self.is_on = timing.has_off,
            MessageKind::Off => self.is_on = false,
            MessageKind::Word => return,
        }
        self.blind_until = message.at + timing.blind;
    }

    /// The part of a span during which it cannot send ON.
    pub fn deaf(&self, span: Interval<RunTime>) -> Span {
        let until = if self.is_on { span.end } else { span.end.min(self.blind_until).max(span.begin) };
        until - span.begin
    }

    /// The part of a span during which it can send OFF.
    pub fn may_end(&self, span: Interval<RunTime>) -> Span {
        if self.is_on { span.length() } else { Span::ZERO }
    }
}
