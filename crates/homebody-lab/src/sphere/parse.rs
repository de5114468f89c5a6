//! The recording's files: rows of `start,end,name,index`.

use super::{AnnotatedRun, Interval};
use csv::{ReaderBuilder, StringRecord, Trim};
use homebody_core::problem::readable;
use std::fmt;

#[derive(Clone, Copy, Debug)]
pub struct RecordingTexts<'a> {
    pub location: &'a str,
    pub annotations: &'a str,
    pub pir: &'a str,
    /// Rooms by a second annotator.
    pub second_location: Option<&'a str>,
}

homebody_core::messages! {
    /// Problems with a row of a recording.
    #[derive(Clone, PartialEq)]
    pub enum RowMessage in "sphere" {
        /// A person is in some room. Without a room there is nothing to compare.
        NoRoom error "no-annotated-room" ("no room is annotated")
            hint ("download the recording again");
        /// Each file of a recording begins with the names of its columns.
        Heading { line: String, expected: &'static str } error "heading"
            ("the first line does not name the columns: {line:?}")
            hint ("write {expected} in the first line");
        /// Each row has a start, an end, a name and an index.
        Fields { count: usize } error "fields" ("the row has {count} fields, and 4 are expected");
        /// Times are seconds since the start of the recording.
        Time { text: String } error "time" ("{text:?} is not a time in seconds");
        /// A row lasts from its start to its end.
        Backward { start_s: f64, end_s: f64 } error "backward" ("the row ends at {end_s} s, before it starts at {start_s} s");
        /// A row names a room or a movement.
        NoName error "no-name" ("the row has no name");
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct SphereRowError {
    pub file: &'static str,
    /// Counted from 1.
    pub line: usize,
    pub what: RowMessage,
}

impl fmt::Display for SphereRowError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}:{}: {}", self.file, self.line, self.what)
    }
}

pub fn parse(texts: &RecordingTexts) -> Result<AnnotatedRun, Vec<SphereRowError>> {
    let mut bad = Vec::new();
    let (rooms, room_lines) = without_overlaps(rows("location_0.csv", texts.location, &mut bad)).into_iter().unzip();
    let movements = without_overlaps(rows("annotations_0.csv", texts.annotations, &mut bad));
    let pir = rows("pir.csv", texts.pir, &mut bad);
    let second = texts.second_location.map(|text| without_overlaps(rows("location_1.csv", text, &mut bad)));
    let run = AnnotatedRun {
        rooms,
        room_lines,
        movements: intervals(movements),
        pir: intervals(pir),
        second_rooms: second.map(intervals),
    };
    if run.rooms.is_empty() && bad.is_empty() {
        bad.push(SphereRowError { file: "location_0.csv", line: 1, what: RowMessage::NoRoom });
    }
    if bad.is_empty() { Ok(run) } else { Err(bad) }
}

fn intervals(rows: Vec<(Interval, usize)>) -> Vec<Interval> {
    rows.into_iter().map(|(interval, _)| interval).collect()
}

const COLUMNS: &str = "start,end,name,index";

/// The rows of a file, in order of time, each with its line.
fn rows(file: &'static str, text: &str, bad: &mut Vec<SphereRowError>) -> Vec<(Interval, usize)> {
    let text = text.trim_start_matches('\u{feff}');
    let mut reader =
        ReaderBuilder::new().has_headers(false).flexible(true).trim(Trim::All).from_reader(text.as_bytes());
    let mut rows = Vec::new();
    for (index, record) in reader.records().enumerate() {
        // Text is read from memory, and rows may have any number of fields.
        let record = record.expect("a text is UTF-8");
        let line = line_of(&record, text);
        let parsed = match index {
            0 if record.iter().eq(COLUMNS.split(',')) => continue,
            0 => Err(RowMessage::Heading { line: readable(fields(&record).join(",")), expected: COLUMNS }),
            _ if fields(&record) == [""] => continue,
            _ => row(&record),
        };
        match parsed {
            Ok(interval) => rows.push((interval, line)),
            Err(what) => bad.push(SphereRowError { file, line, what }),
        }
    }
    rows.sort_by(|(a, _), (b, _)| a.start_s.total_cmp(&b.start_s));
    rows
}

fn fields(record: &StringRecord) -> Vec<&str> {
    record.iter().collect()
}

/// The line of a record, counted from 1. The reader's own place is the end of the record before: the rest of that line's end,
/// and empty lines, come in between.
fn line_of(record: &StringRecord, text: &str) -> usize {
    let Some(place) = record.position() else { return 0 };
    let left = text.as_bytes().get(place.byte() as usize..).unwrap_or_default();
    let ends = left.iter().take_while(|byte| matches!(byte, b'\r' | b'\n'));
    place.line() as usize + ends.filter(|byte| **byte == b'\n').count()
}

fn row(record: &StringRecord) -> Result<Interval, RowMessage> {
    let [start, end, name, _index] = fields(record)[..] else {
        return Err(RowMessage::Fields { count: record.len() });
    };
    let second = |text: &str| match text.parse::<f64>() {
        Ok(second) if second.is_finite() && second >= 0.0 => Ok(second),
        _ => Err(RowMessage::Time { text: readable(text.to_owned()) }),
    };
    let (start_s, end_s) = (second(start)?, second(end)?);
    if end_s < start_s {
        return Err(RowMessage::Backward { start_s, end_s });
    }
    if name.is_empty() {
        return Err(RowMessage::NoName);
    }
    Ok(Interval { start_s, end_s, name: name.into() })
}

/// A person is in one room and does one thing: a start ends the row before.
fn without_overlaps(mut rows: Vec<(Interval, usize)>) -> Vec<(Interval, usize)> {
    for index in 1..rows.len() {
        let start_s = rows[index].0.start_s;
        let (before, _) = &mut rows[index - 1];
        before.end_s = before.end_s.min(start_s);
    }
    rows.retain(|(interval, _)| interval.end_s > interval.start_s);
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    const LOCATION: &str = "start,end,name,index\n1.5,4,hall,3\n4.1,9,living,5\n";

    fn texts<'a>(location: &'a str, pir: &'a str) -> RecordingTexts<'a> {
        RecordingTexts { location, annotations: "start,end,name,index\n1.4,4.2,a_walk,4\n", pir, second_location: None }
    }

    #[test]
    fn rows_come_in_order_of_time() {
        let pir = "start,end,name,index\r\n7.5,8,hall,3\r\n2,3.25,living,5\r\n\r\n";
        let run = parse(&texts(LOCATION, pir)).unwrap();
        let on = |start_s, end_s, name: &str| Interval { start_s, end_s, name: name.into() };
        assert_eq!(run.pir, [on(2.0, 3.25, "living"), on(7.5, 8.0, "hall")]);
        assert_eq!(run.rooms, [on(1.5, 4.0, "hall"), on(4.1, 9.0, "living")]);
        assert_eq!((run.begin_s(), run.end_s()), (1.4, 9.0));
        assert_eq!(run.annotators_agree(), None);
    }

    #[test]
    fn a_start_ends_the_row_before() {
        let run = parse(&texts("start,end,name,index\n1,6,hall,3\n4,9,living,5\n4,5,bath,0\n", LOCATION)).unwrap();
        let rooms: Vec<_> = run.rooms.iter().map(|room| (room.start_s, room.end_s, room.name.as_str())).collect();
        assert_eq!(rooms, [(1.0, 4.0, "hall"), (4.0, 5.0, "bath")]);
        assert_eq!(run.room_lines, [2, 4], "the row between them has no time left");
    }

    #[test]
    fn reports_all_wrong_rows_at_once() {
        let location = "start,end,name,index\nnow,2,hall,3\n3,2,hall,3\n3,4,,3\n3,4,hall\n3,NaN,hall,3\n";
        let bad = parse(&texts(location, "start;end\n")).unwrap_err();
        let bad: Vec<_> = bad.into_iter().map(|row| (row.file, row.line, row.what)).collect();
        let (time, of_rooms) = (|text: &str| RowMessage::Time { text: text.into() }, "location_0.csv");
        assert_eq!(
            bad,
            [
                (of_rooms, 2, time("now")),
                (of_rooms, 3, RowMessage::Backward { start_s: 3.0, end_s: 2.0 }),
                (of_rooms, 4, RowMessage::NoName),
                (of_rooms, 5, RowMessage::Fields { count: 3 }),
                (of_rooms, 6, time("NaN")),
                ("pir.csv", 1, RowMessage::Heading { line: "start;end".into(), expected: COLUMNS }),
            ]
        );
        assert!(parse(&texts("start,end,name,index\n", LOCATION)).is_err());
    }

    #[test]
    fn lines_are_those_of_the_file_whatever_ends_them() {
        for end in ["\n", "\r\n"] {
            let location =
                "\u{feff}start,end,name,index\n\n1,2,hall,3\n  \n\n3,4,living,5\n5,now,hall,3\n".replace('\n', end);
            let bad = parse(&texts(&location, LOCATION)).unwrap_err();
            let bad: Vec<String> = bad.iter().map(SphereRowError::to_string).collect();
            assert_eq!(bad, ["location_0.csv:7: \"now\" is not a time in seconds"], "{end:?}");
            let right = location.replace("now", "6");
            assert_eq!(parse(&texts(&right, LOCATION)).unwrap().room_lines, [3, 6, 7], "{end:?}");
        }
    }

    #[test]
    fn a_field_may_be_quoted() {
        let run =
            parse(&texts("start,end,name,index\n1,4,\"hall\",3\n4, 9 ,\"living, upstairs\",5\n", LOCATION)).unwrap();
        assert_eq!(run.rooms.iter().map(|room| &room.name[..]).collect::<Vec<_>>(), ["hall", "living, upstairs"]);
    }

    #[test]
    fn annotators_agree_by_the_second() {
        let second = "start,end,name,index\n1.5,5,hall,3\n5,9,living,5\n";
        let run = parse(&RecordingTexts { second_location: Some(second), ..texts(LOCATION, LOCATION) }).unwrap();
        // Seven seconds, 1.9 to 7.9, have a room from both; at 4.9 it is not the same.
        assert_eq!(run.annotators_agree(), Some((6, 7)));
    }
}
