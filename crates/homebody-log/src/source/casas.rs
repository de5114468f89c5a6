//! The text of the CASAS smart homes: date, time, sensor and value, parted by blanks or tabs, as homes differ.
//!
//! Some homes repeat the sensor or tell its room and place before the value, and what kind of sensor it is after
//! it. Behind it some note that an activity begins or ends, as `Sleep begin` or `1-end`; others have a label on each row. The
//! beginning of a text shows which words are what.

mod layout;
pub(crate) mod words;

use super::instant::InstantReader;
use super::lines::LineReader;
use super::messages::FormMessage;
use super::reading::LogReading;
use super::start::FileStart;
use super::{LogForm, Shows};
use crate::error::LogError;
use crate::files::plain::text;
use crate::limits::beginning;
use crate::log::SensorInfo;
use crate::source::instant::date_parts::no_instant;
use foldhash::{HashSet, HashSetExt};
use homebody_core::names::words;
use homebody_core::problem::{counted, readable};
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::sensed::meaning;
use layout::{BetweenWords, CasasLayout, KIND, kind, people};
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;
use words::{CasasTime, behind_words_of_time, nearly, part, parted_note, when};

pub(crate) const FORM: LogForm = LogForm {
    name: "casas",
    what: "the text of the CASAS homes: time, sensor and message, separated by tabs or blanks, optionally with room, place and kind, and \
           with notes of activities or a label on each row",
    shows,
    read,
};

fn shows(start: &FileStart) -> Shows {
    Shows::rows_if(CasasLayout::find(start.lines()).is_ok())
}

/// Whether the first line is the heading that CASAS gives its tables, with the translations of a sensor's place.
pub(crate) fn has_own_heading(start: &FileStart) -> bool {
    start.lines().next().is_some_and(|line| line.contains("Translate01"))
}

/// Says why a text that begins with dates and times is not in this form. It finds times in other notations, too.
pub(crate) fn objection(start: &FileStart) -> Option<FormMessage> {
    let lines = || start.lines().take(LOOKED_AT_LINES);
    let mut instants = InstantReader::default();
    if lines().any(|line| when(line.as_bytes(), &mut instants).is_some()) {
        return CasasLayout::find(start.lines()).err();
    }
    let timed = lines().filter(|line| has_time(line)).count();
    let first = || beginning(&start.lines().next().unwrap_or_default());
    (timed > 0 && timed * 2 >= lines().count())
        .then(|| FormMessage::ProgramLog { evidence: format!("line 1 is {}", first()) })
}

/// The number of lines it looks at in a text without a form.
const LOOKED_AT_LINES: usize = 20;

fn has_time(line: &str) -> bool {
    /// A date and perhaps the name of a machine stand before the time.
    const FIRST_BYTES: usize = 60;
    let bytes = &line.as_bytes()[..line.len().min(FIRST_BYTES)];
    let is_time = |bytes: &[u8]| match bytes {
        [a, b, b':', c, d, b':', e, f] => [a, b, c, d, e, f].iter().all(|byte| byte.is_ascii_digit()),
        _ => false,
    };
    bytes.windows(8).any(is_time)
}

fn read(path: &Path, _: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    let layout = CasasLayout::said(FileStart::read(path)?.lines());
    layout.record(reading);
    let mut rows = CasasRows { layout, known: HashSet::new(), doing: BTreeMap::new(), odd: None, parts: Vec::new() };
    let mut lines = LineReader::open(path)?;
    while let Some((number, line)) = lines.next()? {
        rows.take(number, line, reading)?;
    }
    if let Some((line, value, count)) = &rows.odd {
        let rows = counted(*count as usize, "row says", "rows say");
        let remark =
            format!("{rows} neither a state nor a number, as nearly all do: the first is {value} in line {line}");
        reading.log.remarks.push(readable(remark));
    }
    rows.doing.values().for_each(|name| reading.note(name, false));
    Ok(())
}

struct CasasRows {
    layout: CasasLayout,
    /// The sensors whose places are recorded.
    known: HashSet<Vec<u8>>,
    /// The activity of each person, in a text that numbers both.
    doing: BTreeMap<u8, String>,
    /// The first value that is odd, its line, and how many are.
    odd: Option<(u64, String, u64)>,
    /// The words of the current line.
    parts: Vec<Range<usize>>,
}

impl CasasRows {
    fn take(&mut self, number: u64, line: &[u8], reading: &mut LogReading<'_>) -> Result<(), LogError> {
        let line = line.trim_ascii();
        let Some(CasasTime { at, behind, .. }) = when(line, &mut reading.instants) else {
            let is_heading = number == 1 && self.layout.is_heading(line);
            if !line.is_empty() && !is_heading {
                reading.skip(number, no_time(line));
            }
            return Ok(());
        };
        part(behind, self.layout.is_tabbed, &mut self.parts);
        if self.layout.is_tabbed && self.parts.len() <= self.layout.value {
            part(behind, false, &mut self.parts);
        }
        let word = |index: usize| self.parts.get(index).map(|word| &behind[word.clone()]);
        let Some(sensor) = word(0) else {
            reading.skip(number, "there are no date, time, sensor and value".into());
            return Ok(());
        };
        let (place, rest) = self.places(&word, sensor);
        let value = word(place).unwrap_or_default();
        let note = self.parts.get(rest).map(|noted| text(&behind[noted.start..]));
        if let Some(why) = damage(&self.layout, value, note.as_deref()) {
            reading.skip(number, why);
            return Ok(());
        }
        if !is_usual(value) && self.layout.is_odd(&text(value)) {
            self.odd.get_or_insert_with(|| (number, beginning(&text(value)), 0)).2 += 1;
        }
        if self.layout.tells_of_sensors() && !self.known.contains(sensor) {
            self.known.insert(sensor.to_vec());
            self.know(&word, place, reading);
        }
        if reading.event_of_bytes(number, at, sensor, value)? {
            match note {
                Some(note) if self.layout.has_people => {
                    let words: Vec<&str> = note.split_whitespace().collect();
                    self.do_all(people(&words).unwrap_or_default(), reading);
                }
                Some(note) => match parted_note(&note, !self.layout.is_labelled) {
                    (name, Some(begins)) => reading.note(name, begins),
                    (label, None) => reading.label(Some(label)),
                },
                None => reading.label(None),
            }
        }
        Ok(())
    }

    /// Notes the activities of people from this row onwards.
    fn do_all(&mut self, told: Vec<(u8, u8)>, reading: &mut LogReading<'_>) {
        for (person, activity) in told {
            let name = format!("R{person} activity {activity}");
            let before = self.doing.insert(person, name.clone());
            if before.as_ref() != Some(&name) {
                before.iter().for_each(|before| reading.note(before, false));
                reading.note(&name, true);
            }
        }
    }

    /// The places of the value and of the note behind it. A row may differ from most: a kind that only such homes write and a
    /// repeated sensor show its value.
    #[inline]
    fn places<'w>(&self, word: &impl Fn(usize) -> Option<&'w [u8]>, sensor: &[u8]) -> (usize, usize) {
        let CasasLayout { value, has_kind, between, .. } = self.layout;
        if !has_kind && self.parts.len() > 2 {
            let kind = (2..self.parts.len()).find(|&index| word(index).is_some_and(|word| word.starts_with(KIND)));
            if let Some(kind) = kind {
                return (kind - 1, kind + 1);
            }
            if value == 1 && between == BetweenWords::Nothing && word(1) == Some(sensor) {
                return (2, 3);
            }
        }
        (value, value + 1 + usize::from(has_kind))
    }

    /// Records the room, the name and the kind that a row gives for its sensor.
    fn know<'w>(&self, word: &impl Fn(usize) -> Option<&'w [u8]>, value: usize, reading: &mut LogReading<'_>) {
        let said = |index: usize| word(index).map(|word| text(word).into_owned()).unwrap_or_default();
        let id = said(0);
        let (room, place) = match self.layout.between {
            BetweenWords::RoomAndPlace => (Some(said(1)), Some(said(2))),
            BetweenWords::Room => (Some(said(1)), None),
            BetweenWords::Nothing | BetweenWords::Again | BetweenWords::Reading => (None, None),
        };
        // Homes write `OutsideDoor` where a room should be.
        let room = room.filter(|room| !room.is_empty() && !words(room).iter().any(|word| word == "door"));
        let name = place.filter(|place| !place.is_empty()).unwrap_or_else(|| id.clone());
        let of_reading = said(1).trim_end_matches(':').to_owned();
        let kind = match self.layout.between {
            BetweenWords::Reading if meaning(&of_reading, "").is_some() => of_reading,
            _ => self.layout.has_kind.then(|| kind(&said(value + 1))).flatten().unwrap_or_default().to_owned(),
        };
        reading.know(SensorInfo { id, room, ..SensorInfo::of_kind(&name, &kind, &[]) });
    }
}

/// Whether a value needs no check: the most usual states, and numbers.
#[inline]
fn is_usual(value: &[u8]) -> bool {
    matches!(value, b"ON" | b"OFF" | b"OPEN" | b"CLOSE") || value.first().is_none_or(u8::is_ascii_digit)
}

/// The damage of a value or of the note behind it, as part of a sentence.
#[inline]
fn damage(layout: &CasasLayout, value: &[u8], note: Option<&str>) -> Option<String> {
    if note.is_some_and(|note| matches!(note, "ON" | "OFF" | "OPEN" | "CLOSE")) {
        return Some("a value stands where a note should: the line is damaged".into());
    }
    if is_usual(value) {
        return None;
    }
    let value = text(value);
    let state = layout.is_damaged(&value).then(|| nearly(&value)).flatten()?;
    Some(format!("{} looks like a damaged {state}", beginning(&value)))
}

fn no_time(line: &[u8]) -> String {
    let behind = behind_words_of_time(line).map_or(&b""[..], |(behind, _)| behind);
    match behind.trim_ascii() {
        b"" => "there are no date, time, sensor and value".into(),
        _ => no_instant(&text(&line[..line.len() - behind.len()])),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::log::{Clock, Log};
    use homebody_core::time::{MINUTE, Span};
    use std::borrow::Cow;

    fn rows(text: &str) -> CasasRows {
        let layout = CasasLayout::said(text.lines().map(Cow::Borrowed));
        CasasRows { layout, known: HashSet::new(), doing: BTreeMap::new(), odd: None, parts: Vec::new() }
    }

    fn read(text: &str) -> Log {
        let mut events = Vec::new();
        let mut take = |part: &Log| {
            events.extend_from_slice(&part.events);
            Ok(())
        };
        let mut reading = LogReading::new(&mut take);
        let mut rows = rows(text);
        for (index, line) in text.lines().enumerate() {
            rows.take(index as u64 + 1, line.as_bytes(), &mut reading).unwrap();
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
            assert_eq!(log.events[0].at.micros(), 1_235_977_923_250_000, "{line}");
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
        assert_eq!((cook.label.as_str(), cook.length()), ("Cook", 30 * MINUTE));
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
            assert_eq!(log.activities[0].label, "Meal Preparation", "{begin}");
        }
    }

    #[test]
    fn labels_of_rows_become_activities() {
        let log = read(
            "2009-03-02 08:00:00 M001 M001 ON Cook\n2009-03-02 08:10:00 M001 M001 OFF Cook\n\
             2009-03-02 08:20:00 M001 M001 ON Eat\n2009-03-02 08:30:00 M001 M001 OFF\n2009-03-02 08:40:00 M001 M001 ON Eat",
        );
        let told: Vec<_> = log.activities.iter().map(|of| (of.label.as_str(), of.length())).collect();
        assert_eq!(told, [("Cook", 20 * MINUTE), ("Eat", 10 * MINUTE), ("Eat", Span::MICROSECOND)]);
    }

    #[test]
    fn an_instant_that_other_words_follow_at_once_is_read_word_by_word() {
        for (line, told) in [
            ("2009-03-02 07:12:03 -06:00 M001 ON", Some((Clock::Utc, "M001"))),
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
    fn replaces_invalid_utf8_and_keeps_one_sensor() {
        let mut take = |_: &Log| Ok(());
        let mut reading = LogReading::new(&mut take);
        let mut rows = rows("2009-03-02 07:12:03 M1 ON");
        for (number, sensor) in [&b"M\xff"[..], b"M\xff", "M\u{fffd}".as_bytes(), b"M\xfe", b"M1"].iter().enumerate() {
            let line = [b"2009-03-02 07:12:03 ", *sensor, b" ON"].concat();
            rows.take(number as u64 + 1, &line, &mut reading).unwrap();
        }
        assert_eq!(reading.end().unwrap().sensors, ["M\u{fffd}", "M1"]);
    }

    #[test]
    fn skips_and_reports_broken_lines() {
        let log =
            read("2009-03-02 07:12:03 M001 ON\n\nnonsense\n2009-03-02 07:12:04 M001\n2009-03-02 99:12:04 M1 ON\n");
        assert_eq!((log.events.len(), log.skipped), (1, 3));
        let lines: Vec<u64> = log.problems.iter().map(|skipped| skipped.line).collect();
        assert_eq!(lines, [3, 4, 5]);
    }
}
