//! The meaning of a text so far.

use super::words::TextSpan;
use crate::routine::{Activity, Quote, Routine};

pub(crate) struct RoutineDraft {
    pub routine: Routine,
    pub is_condition: bool,
    pub name: Option<String>,
    pub habit_spans: Vec<TextSpan>,
    pub finders: Vec<(String, TextSpan)>,
    pub rule_spans: Vec<(TextSpan, TextSpan)>,
    pub first_date: Option<(i16, u8, u8)>,
    pub usual: Vec<Activity>,
}

/// The words of a place of the text, with their line and column.
pub fn quote(text: &str, span: TextSpan) -> Quote {
    let (mut line, mut start, mut carriage) = (1, 0, false);
    for (at, byte) in text.bytes().enumerate().take(span.start) {
        // A line ends in any way, and once with both signs.
        if byte == b'\r' || byte == b'\n' && !carriage {
            line += 1;
        }
        if byte == b'\r' || byte == b'\n' {
            start = at + 1;
        }
        carriage = byte == b'\r';
    }
    let column = text.get(start..span.start).map_or(0, |before| before.chars().count()) as u32 + 1;
    let said = text.get(span.start..span.end).unwrap_or_default().to_owned();
    Quote { line, column, text: said }
}
