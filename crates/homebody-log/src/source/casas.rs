//! The text of the CASAS smart homes: date, time, sensor and value, parted by blanks or tabs, as homes differ.
//!
//! Some homes repeat the sensor or tell its room and place before the value, and what kind of sensor it is after
//! it; all that is passed over. Behind it some note that an activity begins or ends, as `Sleep begin` or `Sleep="end"`; others have
//! a label on each row.

use super::form::{Form, Shows};
use super::instant::Instants;
use super::lines::Lines;
use super::reading::Reading;
use super::start::Start;
use crate::error::LogError;
use homebody_core::scenario::logger::LoggerFile;
use std::ops::Range;
use std::path::Path;

pub(super) const FORM: Form = Form {
    name: "casas",
    what: "the text of the CASAS homes: time, sensor and message, parted by tabs or blanks, with notes of activities or a label on \
           each row",
    shows,
    read,
};

/// Before the kind of a sensor there is always its value.
const KIND: &str = "Control4-";

/// How many of a file's first lines may be something else (ours).
const LOOKED_AT_LINES: usize = 5;

fn shows(start: &Start) -> Shows {
    let mut instants = Instants::default();
    let mut is_row = |line: &str| {
        let words = words(line);
        words.len() > 3 && instants.read(&line[words[0].start..words[1].end]).is_some()
            || words.len() > 2 && instants.read(&line[words[0].clone()]).is_some()
    };
    Shows::rows_if(start.lines().take(LOOKED_AT_LINES).any(|line| is_row(&line)))
}

fn read(path: &Path, _: &LoggerFile, reading: &mut Reading<'_>) -> Result<(), LogError> {
    let mut lines = Lines::open(path)?;
    let mut parts = Vec::new();
    while let Some((number, line)) = lines.next_text()? {
        understand(number, &line, &mut parts, reading)?;
    }
    Ok(())
}

/// Takes a line; `parts` is where its words are put.
fn understand(
    number: u64,
    line: &str,
    parts: &mut Vec<Range<usize>>,
    reading: &mut Reading<'_>,
) -> Result<(), LogError> {
    part(line, parts);
    let word = |index: usize| parts.get(index).map(|word| &line[word.clone()]);
    let Some(date) = word(0) else { return Ok(()) };
    // `2009-03-02T07:12:03` is one word, `2009-03-02 07:12:03` two.
    let first = if date.contains(':') { 1 } else { 2 };
    let Some(sensor) = word(first) else {
        reading.skip(number, "there are no date, time, sensor and value".into());
        return Ok(());
    };
    let time = &line[parts[0].start..parts[first - 1].end];
    let last = parts.len();
    let kind = (first + 2..last).find(|&index| line[parts[index].start..].starts_with(KIND));
    // Where the value is, and what is behind all that tells of the sensor.
    let (value, rest) = match kind {
        Some(kind) => (kind - 1, kind + 1),
        _ if last > first + 2 && word(first + 1) == Some(sensor) => (first + 2, first + 3),
        _ => (first + 1, first + 2),
    };
    if reading.row(number, time, sensor, word(value).unwrap_or_default())? {
        let noted = parts.get(rest).map(|word| &line[word.start..parts[last - 1].end]);
        match noted.map(parted_note) {
            Some((name, Some(begins))) => reading.note(name, begins),
            Some((label, None)) => reading.label(Some(label)),
            None => reading.label(None),
        }
    }
    Ok(())
}

/// What a note names, and whether it says that it begins or ends; a label says neither.
fn parted_note(note: &str) -> (&str, Option<bool>) {
    let note = note.trim_matches('"');
    for (word, begins) in [("begin", true), ("end", false)] {
        if let Some(name) = note.strip_suffix(word)
            && let trimmed = name.trim_end_matches([' ', '\t', '=', '"'])
            && trimmed.len() < name.len()
            && !trimmed.is_empty()
        {
            return (trimmed, Some(begins));
        }
    }
    (note, None)
}

fn words(line: &str) -> Vec<Range<usize>> {
    let mut words = Vec::new();
    part(line, &mut words);
    words
}

/// Where the words of a line are.
fn part(line: &str, words: &mut Vec<Range<usize>>) {
    words.clear();
    let bytes = line.as_bytes();
    let mut at = 0;
    // Most lines begin with a date and a time of usual lengths, which need no search.
    if let [_, _, _, _, b'-', _, _, b'-', _, _, b' ' | b'\t', time @ ..] = bytes
        && let Some(length) = time.iter().position(u8::is_ascii_whitespace)
        && length > 0
        && !bytes[..10].iter().any(u8::is_ascii_whitespace)
    {
        words.extend([0..10, 11..11 + length]);
        at = 11 + length;
    }
    while let Some(begin) = bytes[at..].iter().position(|byte| !byte.is_ascii_whitespace()).map(|more| at + more) {
        let end = bytes[begin..].iter().position(u8::is_ascii_whitespace).map_or(bytes.len(), |length| begin + length);
        words.push(begin..end);
        at = end;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Log;

    fn read(text: &str) -> Log {
        let mut events = Vec::new();
        let mut take = |part: &Log| {
            events.extend_from_slice(&part.events);
            Ok(())
        };
        let mut reading = Reading::new(&mut take);
        let mut parts = Vec::new();
        for (index, line) in text.lines().enumerate() {
            understand(index as u64 + 1, line, &mut parts, &mut reading).unwrap();
        }
        let log = reading.end().unwrap();
        Log { events, ..log }
    }

    #[test]
    fn homes_differ() {
        for line in [
            "2009-03-02 07:12:03.25\tM001\tON\t",
            "2009-03-02 07:12:03.25 M001 ON",
            "2009-03-02\t07:12:03.250000\tM001\tON\tSleep begin\r",
            "2009-03-02T07:12:03.25 M001 ON R1_Work end",
            "2009-03-02 07:12:03.25 M001 M001 ON Cook",
            "2009-03-02 07:12:03.250  M001  Kitchen Stove ON Control4-Motion",
            "2009-03-02 07:12:03.250\tM001\tKitchen\tStove\tON\tControl4-MotionArea\tCook",
        ] {
            let log = read(line);
            assert_eq!((&log.sensors[..], &log.values[..]), (&["M001".into()][..], &["ON".into()][..]), "{line}");
            assert_eq!(log.events[0].at, 1_235_977_923_250_000, "{line}");
        }
    }

    #[test]
    fn notes_become_activities() {
        let log = read(
            "2009-03-02 07:00:00 M001 ON Sleep end\n2009-03-02 08:00:00 M001 ON Cook begin\n\
             2009-03-02 08:10:00 M001 ON Cook begin\n2009-03-02 08:20:00 M001 OFF R1_Work begin\n\
             2009-03-02 08:30:00 M001 OFF Cook end",
        );
        let [cook] = &log.activities[..] else { panic!("{:?}", log.activities) };
        assert_eq!((cook.name.as_str(), cook.end - cook.begin), ("Cook", 30 * 60 * 1_000_000));
        assert_eq!(log.remarks, ["3 notes that an activity begins or ends have no other end"]);
    }

    #[test]
    fn notes_are_written_in_many_ways() {
        for (begin, end) in [
            ("Meal Preparation begin", "Meal Preparation end"),
            ("\"Meal Preparation begin\"", "\"Meal Preparation end\""),
            ("Control4-Motion Meal Preparation=\"begin\"", "Control4-Motion Meal Preparation=\"end\""),
        ] {
            let log = read(&format!("2009-03-02 08:00:00 M001 ON\t{begin}\n2009-03-02 08:30:00 M001 OFF\t{end}\t"));
            assert_eq!(log.activities.len(), 1, "{begin}");
            assert_eq!(log.activities[0].name, "Meal Preparation", "{begin}");
        }
    }

    #[test]
    fn labels_of_rows_become_activities() {
        let log = read(
            "2009-03-02 08:00:00 M001 M001 ON Cook\n2009-03-02 08:10:00 M001 M001 OFF Cook\n\
             2009-03-02 08:20:00 M001 M001 ON Eat\n2009-03-02 08:30:00 M001 M001 OFF\n2009-03-02 08:40:00 M001 M001 ON Eat",
        );
        let minute = 60 * 1_000_000;
        let told: Vec<_> = log.activities.iter().map(|of| (of.name.as_str(), of.end - of.begin)).collect();
        assert_eq!(told, [("Cook", 20 * minute), ("Eat", 10 * minute), ("Eat", 1)]);
    }

    #[test]
    fn dirt_is_skipped_and_told() {
        let log =
            read("2009-03-02 07:12:03 M001 ON\n\nnonsense\n2009-03-02 07:12:04 M001\n2009-03-02 99:12:04 M1 ON\n");
        assert_eq!((log.events.len(), log.skipped), (1, 3));
        let lines: Vec<u64> = log.problems.iter().map(|skipped| skipped.line).collect();
        assert_eq!(lines, [3, 4, 5]);
    }
}
