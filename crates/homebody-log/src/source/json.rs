//! JSON in one piece: lists of rows, alone or in objects around them, and what servers answer: Home Assistant's history and logbook,
//! SensorThings, InfluxDB, Prometheus, Graphite.
//!
//! A row is an object with a time, or a list with a time and a value. If a row names no sensor, the text above it does:
//! the key of a list, such as an entity's id, or the name in an object around it. Such texts have the rows of each sensor together, so that
//! they are put into the order of time.
//!
//! Values are looked at one by one, so that a text may be of any size. Left out: what names a sensor behind more than a mebibyte of its
//! rows.

mod above;
mod devices;
mod hint;
pub(crate) mod jsonl;
mod object_rows;
mod one_home;
mod parallel;
pub(crate) mod payload;
pub(crate) mod said;
mod text;

use super::gathered::Gathered;
use super::instant::LogInstant;
use super::messages::FormMessage;
use super::reading::LogReading;
use super::start::FileStart;
use super::{LogForm, Shows};
use crate::error::{LengthMessage, LogError, place_of};
use crate::log::{ColumnRole, Log};
use above::{Above, JsonLevel, LIST};
use hint::hint;
use homebody_core::scenario::logger::LoggerFile;
use object_rows::{ObjectRows, ObjectUse};
use said::{Object, instant, text};
use serde_json::Value;
use std::path::Path;
use text::JsonText;

pub(crate) const FORM: LogForm = LogForm {
    name: "json",
    what: "one JSON document: a list of rows, alone or inside objects; Home Assistant's history, logbook and WebSocket \
           replies, OGC SensorThings, InfluxDB, Prometheus and Graphite",
    shows,
    read,
};

/// The most lists and objects within each other.
const DEEPEST: usize = 64;

/// A text with this many rows at its beginning is a log.
const ENOUGH: u64 = 2;

/// Largest number of values of a text that are searched for its first rows.
const MOST_SEARCHED: u64 = 10_000;

/// Largest number of column names in a list.
const MOST_NAMES: usize = 100;

fn shows(start: &FileStart) -> Shows {
    Shows::rows_if(begins_as_json(start) && has_rows(&start.path))
}

pub(crate) fn begins_as_json(start: &FileStart) -> bool {
    let mut letters = start.lines().next().into_iter().flat_map(|line| line.chars().collect::<Vec<_>>());
    let first = letters.next();
    let second = letters.find(|letter| !letter.is_whitespace());
    match first {
        Some('{') => matches!(second, None | Some('"' | '}')),
        Some('[') => matches!(second, None | Some('{' | '[' | '"' | ']')),
        _ => false,
    }
}

fn has_rows(path: &Path) -> bool {
    let mut is_enough = |_: &Log| Ok(());
    let mut reading = LogReading::new(&mut is_enough);
    let walked = JsonWalk::open(path, &LoggerFile::default(), Gathered::as_they_come(path, &mut reading), Some(ENOUGH))
        .and_then(|mut walk| walk.all().map(|()| walk.rows));
    walked.is_ok_and(|rows| rows > 0)
}

fn read(path: &Path, file: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    let mut walk = JsonWalk::open(path, file, Gathered::in_order(path, reading), None)?;
    walk.all()?;
    walk.objects.end(&walk.out)?;
    if walk.rows > 0 || walk.out.reading.log.skipped > 0 {
        return walk.out.end();
    }
    if walk.values == 1 && walk.no_row.is_none() {
        return Err(LogError::no_log(place_of(path), FormMessage::EmptyJson));
    }
    let (at, object) = walk.no_row.unwrap_or_default();
    let at = if object.is_some() || !at.is_empty() { at } else { ".[]".into() };
    let command = hint(&at, object.as_ref(), &mut walk.out.reading.instants);
    Err(LogError::no_log(place_of(path), FormMessage::JsonWithoutRows { command }))
}

struct JsonWalk<'w, 'r, 't> {
    text: JsonText,
    file: &'w LoggerFile,
    above: Above,
    objects: ObjectRows,
    out: Gathered<'r, 't>,
    /// Rows so far, and after how many it is enough.
    rows: u64,
    enough: Option<u64>,
    values: u64,
    /// The first object of a list without the parts of a row, and its place.
    no_row: Option<(String, Option<Object>)>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Passed {
    Whole,
    /// A part of it cannot be parsed as JSON; the walk continues in the list around it.
    Broken,
    /// It is enough, or the text is at its end.
    End,
}

impl<'w, 'r, 't> JsonWalk<'w, 'r, 't> {
    fn open(
        path: &Path,
        file: &'w LoggerFile,
        out: Gathered<'r, 't>,
        enough: Option<u64>,
    ) -> Result<JsonWalk<'w, 'r, 't>, LogError> {
        let text = JsonText::open(path)?;
        Ok(JsonWalk {
            text,
            file,
            above: Above::default(),
            objects: ObjectRows::default(),
            out,
            rows: 0,
            enough,
            values: 0,
            no_row: None,
        })
    }

    fn all(&mut self) -> Result<(), LogError> {
        while let Some(byte) = self.text.peek()? {
            let passed = match byte {
                b',' => {
                    self.text.pass(1);
                    continue;
                }
                b']' | b'}' | b':' => {
                    let line = self.text.line;
                    self.broken(line)?
                }
                _ => self.value(None)?,
            };
            if passed == Passed::End {
                break;
            }
        }
        Ok(())
    }

    fn value(&mut self, key: Option<String>) -> Result<Passed, LogError> {
        if self.above.depth() > DEEPEST {
            return Err(self.text.too_long(LengthMessage::Depth { most: DEEPEST }));
        }
        self.values += 1;
        if self.enough.is_some() && self.values > MOST_SEARCHED {
            return Ok(Passed::End);
        }
        let line = self.text.line;
        let whole = self.text.length()?;
        let said = whole.and_then(|length| serde_json::from_slice::<Value>(self.text.bytes(length)).ok());
        if let (Some(said), Some(length)) = (&said, whole) {
            let taken = self.row(line, said)?;
            if taken != ObjectUse::Nothing {
                self.text.pass(length);
                self.rows += u64::from(taken == ObjectUse::Row);
                return Ok(if self.enough.is_some_and(|enough| self.rows >= enough) {
                    Passed::End
                } else {
                    Passed::Whole
                });
            }
        }
        match (self.text.peek()?, said, whole) {
            (Some(b'{'), Some(Value::Object(object)), _) => self.object(key, kept(object)),
            (Some(b'{'), _, _) => self.object(key, Object::new()),
            (Some(b'['), _, _) => self.list(key),
            (None, _, _) => Ok(Passed::End),
            (_, _, None) if self.text.is_cut() => self.cut(line, self.rows),
            (_, _, None) => Err(self.text.too_long(LengthMessage::JsonText)),
            (_, None, Some(length)) => {
                self.text.pass(length);
                self.broken(line)
            }
            (_, Some(said), Some(length)) => {
                self.text.pass(length);
                if let (Some(key), Some(level)) = (key, self.above.innermost()) {
                    level.members.insert(key, said);
                }
                Ok(Passed::Whole)
            }
        }
    }

    fn row(&mut self, line: u64, said: &Value) -> Result<ObjectUse, LogError> {
        match said {
            Value::Object(object) => self.row_or_columns(line, object),
            Value::Array(cells) if cells.iter().all(|cell| !cell.is_array() && !cell.is_object()) => {
                self.cells(line, cells)
            }
            _ => Ok(ObjectUse::Nothing),
        }
    }

    /// Takes an object that is a row, or whose members are the columns of a table.
    fn row_or_columns(&mut self, line: u64, object: &Object) -> Result<ObjectUse, LogError> {
        let taken = self.objects.take(line, object, &mut self.above, self.file, &mut self.out)?;
        if taken != ObjectUse::Nothing {
            return Ok(taken);
        }
        let mut all = ObjectUse::Nothing;
        for row in parallel::rows(object, &mut self.out.reading.instants).unwrap_or_default() {
            let taken = self.objects.take(line, &row, &mut self.above, self.file, &mut self.out)?;
            all = if all == ObjectUse::Row { all } else { taken };
        }
        if all == ObjectUse::Nothing && self.rows == 0 {
            // One in a list may be one of many rows.
            let at = self.above.path();
            let is_better = |(known, _): &(String, _)| at.ends_with(LIST) && !known.ends_with(LIST);
            if self.no_row.as_ref().is_none_or(is_better) {
                self.no_row = Some((at, Some(object.clone())));
            }
        }
        Ok(all)
    }

    /// Takes a list of cells: by the names of columns above it, or a time with a value, or a time with a sensor and a value.
    fn cells(&mut self, line: u64, cells: &[Value]) -> Result<ObjectUse, LogError> {
        if let Some(names) = self.above.columns().filter(|names| names.len() == cells.len()) {
            if names.iter().zip(cells).all(|(name, cell)| cell == name) {
                return Ok(ObjectUse::Nothing);
            }
            let object: Object = names.into_iter().zip(cells.iter().cloned()).collect();
            return self.objects.take(line, &object, &mut self.above, self.file, &mut self.out);
        }
        let mut at = |cell: &Value| instant(cell, &mut self.out.reading.instants);
        match cells {
            [first, second] => {
                let is_behind = self.above.key() == Some("datapoints");
                let (time, value) = match (at(first), at(second)) {
                    (Some(_), Some(_)) if first.is_string() && second.is_string() => return Ok(ObjectUse::Nothing),
                    (_, Some(time)) if is_behind => (time, first),
                    (Some(time), _) => (time, second),
                    (None, Some(time)) => (time, first),
                    (None, None) => return Ok(ObjectUse::Nothing),
                };
                self.pair(line, time, value)
            }
            [time, Value::String(sensor), value] => {
                let Some(time) = at(time) else { return Ok(ObjectUse::Nothing) };
                self.out.column("the first of each list", ColumnRole::Time, "it is an instant");
                self.out.column("the second of each list", ColumnRole::Sensor, "its place");
                self.out.column("the third of each list", ColumnRole::Value, "its place");
                self.out.row(line, time, [sensor, &text(value)], None)?;
                Ok(ObjectUse::Row)
            }
            _ => Ok(ObjectUse::Nothing),
        }
    }

    /// Takes a time and a value, whose sensor is named above them.
    fn pair(&mut self, line: u64, time: LogInstant, value: &Value) -> Result<ObjectUse, LogError> {
        let row = Object::new();
        let Some(sensor) = self.above.sensor(&row) else { return Ok(ObjectUse::Nothing) };
        if !self.out.knows(&sensor) {
            self.out.know(self.above.info(&sensor, &row));
        }
        self.out.column("pairs of time and value", ColumnRole::Time, "one of the two is an instant");
        self.out.column("the names above the rows", ColumnRole::Sensor, "the rows name no sensor");
        match value.is_null() {
            true => self.out.count("values that are null, which report nothing"),
            false => self.out.row(line, time, [&sensor, &text(value)], None)?,
        }
        Ok(ObjectUse::Row)
    }

    fn object(&mut self, key: Option<String>, members: Object) -> Result<Passed, LogError> {
        let (begun, before) = (self.text.line, self.rows);
        self.above.enter(JsonLevel { key, members, ..JsonLevel::default() });
        self.text.pass(1);
        let passed = loop {
            let key = match self.text.peek()? {
                Some(b'}') => {
                    self.text.pass(1);
                    break Passed::Whole;
                }
                Some(b',') => {
                    self.text.pass(1);
                    continue;
                }
                Some(b'"') => {
                    let length = self.text.length()?;
                    let Some(length) = length else {
                        if self.text.is_cut() {
                            break self.cut(begun, before)?;
                        }
                        return Err(self.text.too_long(LengthMessage::JsonKey));
                    };
                    serde_json::from_slice::<String>(self.text.bytes(length)).ok().map(|key| (key, length))
                }
                Some(_) => None,
                None => break self.cut(begun, before)?,
            };
            let Some((key, length)) = key else { break self.broken(begun)? };
            self.text.pass(length);
            if self.text.peek()? != Some(b':') {
                break self.broken(begun)?;
            }
            self.text.pass(1);
            if !matches!(self.text.peek()?, Some(byte) if !b",:]}".contains(&byte)) {
                break self.broken(begun)?;
            }
            match self.value(Some(key))? {
                Passed::Whole => {}
                passed => break passed,
            }
        };
        self.above.leave();
        Ok(passed)
    }

    fn list(&mut self, key: Option<String>) -> Result<Passed, LogError> {
        let (begun, before) = (self.text.line, self.rows);
        self.above.enter(JsonLevel { key, is_list: true, ..JsonLevel::default() });
        self.text.pass(1);
        let passed = loop {
            let passed = match self.text.peek()? {
                Some(b']') => {
                    self.text.pass(1);
                    break Passed::Whole;
                }
                Some(b',') => {
                    self.text.pass(1);
                    continue;
                }
                Some(b'}' | b':') => {
                    let line = self.text.line;
                    self.broken(line)?
                }
                Some(_) => self.value(None)?,
                None => break self.cut(begun, before)?,
            };
            if passed == Passed::End {
                break passed;
            }
        };
        self.above.leave();
        Ok(passed)
    }

    /// Reports that the text ends within what begins in a line, behind which so many rows were before.
    fn cut(&mut self, begun: u64, before: u64) -> Result<Passed, LogError> {
        match self.rows > before {
            // The rows in it are whole.
            true => self.out.count("lists and objects that have no end, because the text ends"),
            false => self.out.reading.skip(begun, "the text ends within what begins here".into()),
        }
        Ok(Passed::End)
    }

    /// Reports a value that cannot be parsed as JSON, and passes the rest of its line.
    fn broken(&mut self, begun: u64) -> Result<Passed, LogError> {
        self.out.reading.skip(begun, "it is no JSON".into());
        if self.text.line == begun {
            self.text.pass_line()?;
        }
        Ok(if self.enough.is_some() { Passed::End } else { Passed::Broken })
    }
}

/// The members that may say something of the rows in an object: all but lists of lists or objects, and long lists.
fn kept(object: Object) -> Object {
    let is_kept = |said: &Value| match said {
        Value::Array(names) => {
            names.len() <= MOST_NAMES && names.iter().all(|name| !name.is_array() && !name.is_object())
        }
        Value::Object(inner) => inner.values().all(|said| !said.is_array()),
        _ => true,
    };
    object.into_iter().filter(|(_, said)| is_kept(said)).collect()
}
