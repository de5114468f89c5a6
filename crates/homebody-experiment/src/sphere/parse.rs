//! The recording's files: rows of `start,end,name,index`.

use super::{AnnotatedRun, Interval};
use csv::{ReaderBuilder, StringRecord, Trim};
use std::fmt;

/// The text of a recording's files.
#[derive(Clone, Copy, Debug)]
pub struct Texts<'a> {
    /// `location_0.csv`.
    pub location: &'a str,
    /// `annotations_0.csv`.
    pub annotations: &'a str,
    /// `pir.csv`.
    pub pir: &'a str,
    /// `location_1.csv`, where a second annotator saw the recording.
    pub second_location: Option<&'a str>,
}

/// A row that cannot be understood.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadRow {
    pub file: &'static str,
    /// Counted from 1.
    pub line: usize,
    pub what: String,
}

impl fmt::Display for BadRow {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}:{}: {}", self.file, self.line, self.what)
    }
}

impl std::error::Error for BadRow {}

/// Reads a recording, or says everything that is wrong with it.
pub fn parse(texts: &Texts) -> Result<AnnotatedRun, Vec<BadRow>> {
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
        bad.push(BadRow { file: "location_0.csv", line: 1, what: "no room is annotated".into() });
    }
    if bad.is_empty() { Ok(run) } else { Err(bad) }
}

fn intervals(rows: Vec<(Interval, usize)>) -> Vec<Interval> {
    rows.into_iter().map(|(interval, _)| interval).collect()
}

/// The columns of every file.
const COLUMNS: &str = "start,end,name,index";

/// The rows of a file, in order of time, each with its line.
fn rows(file: &'static str, text: &str, bad: &mut Vec<BadRow>) -> Vec<(Interval, usize)> {
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
            0 => Err(format!("the first line must be {COLUMNS}, but is {:?}", fields(&record).join(","))),
            _ if fields(&record) == [""] => continue,
            _ => row(&record),
        };
        match parsed {
            Ok(interval) => rows.push((interval, line)),
            Err(what) => bad.push(BadRow { file, line, what }),
        }
    }
    rows.sort_by(|(a, _), (b, _)| a.start_s.total_cmp(&b.start_s));
    rows
}

fn fields(record: &StringRecord) -> Vec<&str> {
    record.iter().collect()
}

/// The line that a record begins on, counted from 1. The reader's own place is where the record before ended: what is left
/// of that line's end, and empty lines, come in between.
fn line_of(record: &StringRecord, text: &str) -> usize {
    let Some(place) = record.position() else { return 0 };
    let left = text.as_bytes().get(place.byte() as usize..).unwrap_or_default();
    let ends = left.iter().take_while(|byte| matches!(byte, b'\r' | b'\n'));
    place.line() as usize + ends.filter(|byte| **byte == b'\n').count()
}

fn row(record: &StringRecord) -> Result<Interval, String> {
    let [start, end, name, _index] = fields(record)[..] else {
        return Err(format!("a row has 4 fields, but this one {}", record.len()));
    };
    let second = |text: &str| match text.parse::<f64>() {
        Ok(second) if second.is_finite() && second >= 0.0 => Ok(second),
        _ => Err(format!("{text:?} is no time in seconds")),
    };
    let (start_s, end_s) = (second(start)?, second(end)?);
    if end_s < start_s {
        return Err(format!("it ends at {end_s} s, before it starts at {start_s} s"));
    }
    if name.is_empty() {
        return Err("it has no name".into());
    }
    Ok(Interval { start_s, end_s, name: name.into() })
}

/// A person is in one room and does one thing: what begins ends what was before.
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

    fn texts<'a>(location: &'a str, pir: &'a str) -> Texts<'a> {
        Texts { location, annotations: "start,end,name,index\n1.4,4.2,a_walk,4\n", pir, second_location: None }
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
    fn what_begins_ends_what_was_before() {
        let run = parse(&texts("start,end,name,index\n1,6,hall,3\n4,9,living,5\n4,5,bath,0\n", LOCATION)).unwrap();
        let rooms: Vec<_> = run.rooms.iter().map(|room| (room.start_s, room.end_s, room.name.as_str())).collect();
        assert_eq!(rooms, [(1.0, 4.0, "hall"), (4.0, 5.0, "bath")]);
        assert_eq!(run.room_lines, [2, 4], "the row between them has no time left");
    }

    #[test]
    fn everything_that_is_wrong_is_said_at_once() {
        let location = "start,end,name,index\nnow,2,hall,3\n3,2,hall,3\n3,4,,3\n3,4,hall\n3,NaN,hall,3\n";
        let bad = parse(&texts(location, "start;end\n")).unwrap_err();
        let bad: Vec<String> = bad.iter().map(BadRow::to_string).collect();
        assert_eq!(
            bad,
            [
                "location_0.csv:2: \"now\" is no time in seconds",
                "location_0.csv:3: it ends at 2 s, before it starts at 3 s",
                "location_0.csv:4: it has no name",
                "location_0.csv:5: a row has 4 fields, but this one 3",
                "location_0.csv:6: \"NaN\" is no time in seconds",
                "pir.csv:1: the first line must be start,end,name,index, but is \"start;end\"",
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
            let bad: Vec<String> = bad.iter().map(BadRow::to_string).collect();
            assert_eq!(bad, ["location_0.csv:7: \"now\" is no time in seconds"], "{end:?}");
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
        let run = parse(&Texts { second_location: Some(second), ..texts(LOCATION, LOCATION) }).unwrap();
        // Seven seconds, 1.9 to 7.9, have a room from both; at 4.9 it is not the same.
        assert_eq!(run.annotators_agree(), Some((6, 7)));
    }
}
