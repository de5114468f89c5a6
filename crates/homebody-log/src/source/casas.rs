//! The text of the CASAS smart homes: date, time, sensor and value, parted by blanks or tabs, as homes differ.
//!
//! Some homes repeat the sensor or tell its room and place before the value, and what kind of sensor it is after
//! it; all that is passed over. Behind it some note that an activity begins or ends, as `Sleep begin` or `Sleep="end"`; others have
//! a label on each row.

use super::form::{Form, Shows};
use super::instant::{Instant, Instants};
use super::lines::Lines;
use super::reading::Reading;
use super::start::Start;
use crate::error::LogError;
use crate::plain::text;
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
const KIND: &[u8] = b"Control4-";

/// How many of a file's first lines may be something else (ours).
const LOOKED_AT_LINES: usize = 5;

fn shows(start: &Start) -> Shows {
    let (mut words, mut instants) = (Vec::new(), Instants::default());
    let mut is_row = |line: &str| {
        part(line.as_bytes(), &mut words);
        words.len() > 3 && instants.read(&line[words[0].start..words[1].end]).is_some()
            || words.len() > 2 && instants.read(&line[words[0].clone()]).is_some()
    };
    Shows::rows_if(start.lines().take(LOOKED_AT_LINES).any(|line| is_row(&line)))
}

fn read(path: &Path, _: &LoggerFile, reading: &mut Reading<'_>) -> Result<(), LogError> {
    let mut lines = Lines::open(path)?;
    let mut parts = Vec::new();
    while let Some((number, line)) = lines.next()? {
        understand(number, line, &mut parts, reading)?;
    }
    Ok(())
}

/// Takes a line; `parts` is where its words are put.
fn understand(
    number: u64,
    line: &[u8],
    parts: &mut Vec<Range<usize>>,
    reading: &mut Reading<'_>,
) -> Result<(), LogError> {
    let line = line.trim_ascii();
    // Where a line begins with an instant and a blank, its words begin behind it: nothing looks for those of the instant.
    let leading = reading.instants.leading(line).filter(|(_, rest)| rest.first().is_some_and(u8::is_ascii_whitespace));
    let behind = match leading {
        Some((_, rest)) => rest,
        None => match behind_words_of_time(line) {
            Some(rest) => rest,
            None => return Ok(()),
        },
    };
    part(behind, parts);
    let word = |index: usize| parts.get(index).map(|word| &behind[word.clone()]);
    let Some(sensor) = word(0) else {
        reading.skip(number, "there are no date, time, sensor and value".into());
        return Ok(());
    };
    let last = parts.len();
    let kind = (2..last).find(|&index| word(index).is_some_and(|word| word.starts_with(KIND)));
    // Where the value is, and what is behind all that tells of the sensor.
    let (value, rest) = match kind {
        Some(kind) => (kind - 1, kind + 1),
        _ if last > 2 && word(1) == Some(sensor) => (2, 3),
        _ => (1, 2),
    };
    let value = word(value).unwrap_or_default();
    let is_row = match leading {
        Some((at, _)) => reading.event_of_bytes(number, Instant::Local(at), sensor, value)?,
        None => reading.row_of_bytes(number, &line[..line.len() - behind.len()], sensor, value)?,
    };
    if is_row {
        match parts.get(rest) {
            Some(noted) => match parted_note(&text(&behind[noted.start..])) {
                (name, Some(begins)) => reading.note(name, begins),
                (label, None) => reading.label(Some(label)),
            },
            None => reading.label(None),
        }
    }
    Ok(())
}

/// What is behind the words that stand where the time should; None where there is no word.
fn behind_words_of_time(line: &[u8]) -> Option<&[u8]> {
    let (date, rest) = first_word(line);
    // `2009-03-02T07:12:03` is one word, `2009-03-02 07:12:03` two.
    match date {
        [] => None,
        date if date.contains(&b':') => Some(rest),
        _ => Some(first_word(rest).1),
    }
}

fn first_word(text: &[u8]) -> (&[u8], &[u8]) {
    let text = text.trim_ascii_start();
    text.split_at(text.iter().position(u8::is_ascii_whitespace).unwrap_or(text.len()))
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

/// Where the words of a line are.
fn part(bytes: &[u8], words: &mut Vec<Range<usize>>) {
    words.clear();
    let mut at = 0;
    while let Some(begin) = bytes[at..].iter().position(|byte| !byte.is_ascii_whitespace()).map(|more| at + more) {
        let end = bytes[begin..].iter().position(u8::is_ascii_whitespace).map_or(bytes.len(), |length| begin + length);
        words.push(begin..end);
        at = end;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::{Clock, Log};

    fn read(text: &str) -> Log {
        let mut events = Vec::new();
        let mut take = |part: &Log| {
            events.extend_from_slice(&part.events);
            Ok(())
        };
        let mut reading = Reading::new(&mut take);
        let mut parts = Vec::new();
        for (index, line) in text.lines().enumerate() {
            understand(index as u64 + 1, line.as_bytes(), &mut parts, &mut reading).unwrap();
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
    fn an_instant_that_other_words_follow_at_once_is_read_word_by_word() {
        for (line, told) in [
            ("2009-03-02 07:12:03 -06:00 ON", Some((Clock::Local, "-06:00"))),
            ("2009-03-02 07:12:03-06:00 M001 ON", Some((Clock::Utc, "M001"))),
            ("2009-03-02T07:12:03Z\tM001 ON", Some((Clock::Utc, "M001"))),
            (" 02-Mar-2009\t07:12  M001 ON", Some((Clock::Local, "M001"))),
            ("2009-03-0207:12:03 M001 ON", Some((Clock::Local, "M001"))),
            ("2009-03-02 07:12:03x M001 ON", None),
            ("2009-03-02 07:12: M001 ON", None),
            ("2009-03-02 07:12:0é M001 ON", None),
        ] {
            let log = read(line);
            let read = log.sensors.first().map(|sensor| (log.clock, sensor.as_str()));
            assert_eq!((read, log.skipped), (told, u64::from(told.is_none())), "{line}");
        }
    }

    #[test]
    fn what_is_no_text_is_replaced_and_is_one_sensor_however_often_it_comes() {
        let mut take = |_: &Log| Ok(());
        let mut reading = Reading::new(&mut take);
        let mut parts = Vec::new();
        for (number, sensor) in [&b"M\xff"[..], b"M\xff", "M\u{fffd}".as_bytes(), b"M\xfe", b"M1"].iter().enumerate() {
            let line = [b"2009-03-02 07:12:03 ", *sensor, b" ON"].concat();
            understand(number as u64 + 1, &line, &mut parts, &mut reading).unwrap();
        }
        assert_eq!(reading.end().unwrap().sensors, ["M\u{fffd}", "M1"]);
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
