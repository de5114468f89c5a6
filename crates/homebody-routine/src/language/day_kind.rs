//! The words for busy and quiet days.

use super::reader::SentenceReader;
use crate::routine::DayKind;

const KINDS: [(&str, DayKind); 2] = [("quiet|lazy|slow", DayKind::Quiet), ("busy|active|lively", DayKind::Busy)];

/// "busy days", of "on busy days she goes out".
pub fn days_of_kind(reader: &mut SentenceReader) -> Option<DayKind> {
    reader.attempt(|reader| {
        reader.skip_determiners();
        let kind = reader.eat_any(&KINDS)?;
        reader.eat("day|days").then_some(kind)
    })
}

/// "has a very quiet day": of which kind, and whether very.
pub fn has_days(reader: &mut SentenceReader) -> Option<(DayKind, bool)> {
    reader.eat("has|have").then_some(())?;
    reader.skip_determiners();
    let very = reader.eat("very");
    days_of_kind(reader).map(|kind| (kind, very))
}

/// "are busy", "is a very quiet day", behind days or how many of them.
pub fn are_of_kind(reader: &mut SentenceReader) -> Option<(DayKind, bool)> {
    reader.attempt(|reader| {
        reader.eat("is|are").then_some(())?;
        reader.skip_determiners();
        let very = reader.eat("very");
        let kind = reader.eat_any(&KINDS)?;
        reader.eat("day|days|one|ones");
        Some((kind, very))
    })
}
