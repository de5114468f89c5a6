//! The words of a line in the text of the CASAS homes: when it was, what a sensor says, and what a note names.

use crate::source::instant::{InstantReader, LogInstant, offset};
use homebody_core::time::Span;
use std::ops::Range;

/// The time that a line begins with.
pub(crate) struct CasasTime<'l> {
    pub at: LogInstant,
    /// What follows.
    pub behind: &'l [u8],
    /// The number of words of the time.
    pub words: usize,
}

/// The time that a line begins with, in one word or two, with a zone as a word of its own or none.
#[inline]
pub(crate) fn when<'l>(line: &'l [u8], instants: &mut InstantReader) -> Option<CasasTime<'l>> {
    let line = line.trim_ascii_start();
    // The words begin behind an instant and a blank; the words of the instant itself need no search.
    let leading = instants.leading(line).filter(|(_, rest)| rest.first().is_some_and(u8::is_ascii_whitespace));
    let (at, behind, words) = match leading {
        Some((at, rest)) => {
            let time = &line[..line.len() - rest.len()];
            (LogInstant::Local(at), rest, if time.iter().any(u8::is_ascii_whitespace) { 2 } else { 1 })
        }
        None => {
            let (behind, words) = behind_words_of_time(line)?;
            let time = &line[..line.len() - behind.len()];
            let at = match parted_at_line(time) {
                Some(parted) => instants.read_bytes(&parted)?,
                None => instants.read_bytes(time)?,
            };
            (at, behind, words)
        }
    };
    if let (LogInstant::Local(local), Some((zone, rest))) = (at, zone(behind)) {
        return Some(CasasTime { at: LogInstant::Utc(local.to_utc(zone)), behind: rest, words: words + 1 });
    }
    Some(CasasTime { at, behind, words })
}

/// A time whose date and time of day are parted by a line, `2009-03-02_07:12:03`, as FHEM writes it.
fn parted_at_line(time: &[u8]) -> Option<Vec<u8>> {
    (time.get(10) == Some(&b'_')).then(|| [&time[..10], b" ", &time[11..]].concat())
}

/// The zone that stands as a word before the others, and what follows.
fn zone(behind: &[u8]) -> Option<(Span, &[u8])> {
    let trimmed = behind.trim_ascii_start();
    if !matches!(trimmed.first(), Some(b'+' | b'-')) {
        return None;
    }
    let (word, rest) = first_word(trimmed);
    (word.len() == 6 && word[3] == b':').then_some(())?;
    Some((offset(word)?, rest))
}

/// The rest behind the words in the place of the time, and the number of those words; None in a blank line.
pub(crate) fn behind_words_of_time(line: &[u8]) -> Option<(&[u8], usize)> {
    let (date, rest) = first_word(line);
    // `2009-03-02T07:12:03` is one word, `2009-03-02 07:12:03` two.
    match date {
        [] => None,
        date if date.contains(&b':') => Some((rest, 1)),
        _ => Some((first_word(rest).1, 2)),
    }
}

fn first_word(text: &[u8]) -> (&[u8], &[u8]) {
    let text = text.trim_ascii_start();
    text.split_at(text.iter().position(u8::is_ascii_whitespace).unwrap_or(text.len()))
}

/// The words of a line, which blanks part, or tabs alone.
#[inline]
pub(crate) fn part(bytes: &[u8], is_tabbed: bool, words: &mut Vec<Range<usize>>) {
    words.clear();
    let parts = |byte: &u8| if is_tabbed { *byte == b'\t' } else { byte.is_ascii_whitespace() };
    let mut at = 0;
    while let Some(begin) = bytes[at..].iter().position(|byte| !byte.is_ascii_whitespace()).map(|more| at + more) {
        let end = bytes[begin..].iter().position(parts).map_or(bytes.len(), |length| begin + length);
        words.push(begin..begin + bytes[begin..end].trim_ascii_end().len());
        at = end;
    }
}

/// States of sensors in capitals.
const STATES: [&str; 38] = [
    "ON", "OFF", "OPEN", "CLOSE", "OPENED", "CLOSED", "ABSENT", "PRESENT", "START", "STOP", "TRUE", "FALSE", "FIRE",
    "FIRED", "MOTION", "ACTIVE", "INACTIVE", "DETECTED", "CLEAR", "CLEARED", "OCCUPIED", "VACANT", "PRESSED",
    "RELEASED", "LOCKED", "UNLOCKED", "HIGH", "LOW", "HOME", "AWAY", "NOT_HOME", "UNAVAILABLE", "UNKNOWN", "STARTED",
    "STOPPED", "START_INSTRUCT", "STOP_INSTRUCT", "IDLE",
];

/// Whether a word is a state that sensors have, damaged perhaps, or a number.
pub(crate) fn is_value(word: &str) -> bool {
    let upper = word.to_ascii_uppercase();
    STATES.contains(&upper.as_str()) || is_number(word) || is_damaged(word)
}

/// Whether a word is a number, perhaps with a decimal comma.
pub(crate) fn is_number(word: &str) -> bool {
    let begins = word.bytes().next().is_some_and(|byte| byte.is_ascii_digit() || b"+-.".contains(&byte));
    begins && word.replacen(',', ".", 1).parse::<f64>().is_ok()
}

/// States that come damaged from real homes: letters are lost, doubled or added.
const OFTEN: [&str; 6] = ["ON", "OFF", "OPEN", "CLOSE", "ABSENT", "PRESENT"];

/// Whether a word is a misspelt state: `ONc`, `OFFF`, `OF`, `ON0`.
pub(crate) fn is_damaged(word: &str) -> bool {
    nearly(word).is_some()
}

/// The state that a damaged word is nearly.
pub(crate) fn nearly(word: &str) -> Option<&'static str> {
    /// So many letters are too many or too few at most.
    const MOST_LETTERS: usize = 2;
    let upper = word.to_ascii_uppercase();
    if upper.is_empty() || STATES.contains(&upper.as_str()) {
        return None;
    }
    OFTEN.into_iter().find(|state| {
        let longer = upper.starts_with(state) && upper.len() - state.len() <= MOST_LETTERS;
        let shorter = state.starts_with(&upper) && state.len() - upper.len() <= MOST_LETTERS;
        longer || shorter
    })
}

/// Words that say that an activity begins or ends.
const BEGINS: [&str; 7] = ["begin", "start", "begins", "began", "begun", "starts", "started"];
const ENDS: [&str; 9] = ["end", "stop", "finish", "ends", "ended", "stops", "stopped", "finishes", "finished"];

/// The name in a note, and whether the activity begins or ends; a label has neither. `Sleep begin`, `Sleep="end"`, `1-begin`,
/// `Work_End` and `begin Cook` are notes. If most rows have labels, `begin` and `end` count only as words of their own.
pub(crate) fn parted_note(note: &str, is_loose: bool) -> (&str, Option<bool>) {
    let note = note.trim_matches('"').trim();
    let is_joint = |c: char| c.is_whitespace() || "=\"".contains(c) || (is_loose && "-_:/.()".contains(c));
    let said = |word: &str| {
        let is = |words: &[&str]| words.iter().any(|known| known.eq_ignore_ascii_case(word));
        if is(&BEGINS) { Some(true) } else { is(&ENDS).then_some(false) }
    };
    let trimmed = note.trim_end_matches(is_joint);
    if let Some(at) = trimmed.rfind(is_joint) {
        let word = at + trimmed[at..].chars().next().map_or(0, char::len_utf8);
        let name = trimmed[..at].trim_end_matches(is_joint);
        if let (Some(begins), false) = (said(&trimmed[word..]), name.is_empty()) {
            return (name, Some(begins));
        }
    }
    if let Some(at) = note.find(is_joint) {
        let name = note[at..].trim_matches(is_joint);
        if let (Some(begins), false) = (said(&note[..at]), name.is_empty()) {
            return (name, Some(begins));
        }
    }
    (note, None)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::log::Clock;
    use homebody_core::time::{HOUR, WallTime};

    #[test]
    fn a_note_says_which_end_it_is() {
        for (note, name, begins) in [
            ("Sleep begin", "Sleep", Some(true)),
            ("Sleep=\"end\"", "Sleep", Some(false)),
            ("1-begin", "1", Some(true)),
            ("Work_End", "Work", Some(false)),
            ("R1_Work_Begin", "R1_Work", Some(true)),
            ("begin Cook", "Cook", Some(true)),
            ("Eat started", "Eat", Some(true)),
            ("Eat finished", "Eat", Some(false)),
            ("Eat_ended", "Eat", Some(false)),
            ("started", "started", None),
            ("end:Meal Preparation", "Meal Preparation", Some(false)),
            ("begin(Cook)", "Cook", Some(true)),
            ("Cook", "Cook", None),
            ("Weekend", "Weekend", None),
            ("begin", "begin", None),
            ("Legend", "Legend", None),
        ] {
            assert_eq!(parted_note(note, true), (name, begins), "{note}");
        }
        assert_eq!(parted_note("week-end", false), ("week-end", None));
    }

    #[test]
    fn a_time_may_have_a_line_in_it_or_a_zone_behind_it() {
        const AT: WallTime = WallTime::from_micros(1_235_977_923_000_000);
        for (line, at, words) in [
            ("2009-03-02_07:12:03 hall on", Some(LogInstant::Local(AT)), 1),
            ("2009-03-02 07:12:03 -06:00 hall on", Some(LogInstant::told_by(Clock::Utc, AT + 6 * HOUR)), 3),
            ("2009-03-02 07:12:03 -06 on", Some(LogInstant::Local(AT)), 2),
            ("2009-03-02x07:12:03 hall on", None, 0),
        ] {
            let found = when(line.as_bytes(), &mut InstantReader::default());
            assert_eq!(found.as_ref().map(|when| when.at), at, "{line}");
            assert!(found.is_none_or(|when| when.words == words), "{line}");
        }
    }

    #[test]
    fn recognises_a_damaged_state() {
        for (word, state) in [
            ("ONc", Some("ON")),
            ("OFFF", Some("OFF")),
            ("OF", Some("OFF")),
            ("ON0", Some("ON")),
            ("OPE", Some("OPEN")),
            ("CLOSED", None),
            ("ON", None),
            ("off", None),
            ("21.5", None),
            ("ONLINE", None),
            ("O", Some("ON")),
            ("C", None),
        ] {
            assert_eq!(nearly(word), state, "{word}");
        }
    }
}
