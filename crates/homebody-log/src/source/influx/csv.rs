//! Tables of InfluxDB: the annotated CSV of Influx 2, with a row for each field or with fields as columns, and what
//! `influx -format csv` prints.
//!
//! A text has several tables, each with a heading and those of Influx 2 with annotations above it. They have the rows of each series
//! together, so that they are put into the order of time.

use super::{InfluxPoint, Series};
use crate::error::LogError;
use crate::log::ColumnRole;
use crate::source::gathered::Gathered;
use crate::source::instant::date_parts::no_instant;
use crate::source::instant::{InstantReader, LogInstant, since_1970_whole};
use crate::source::reading::LogReading;
use crate::source::records::{Record, RecordReader};
use crate::source::start::FileStart;
use crate::source::{LogForm, Shows};
use homebody_core::scenario::logger::LoggerFile;
use std::path::Path;

pub(crate) const FORM: LogForm = LogForm {
    name: "influx-csv",
    what: "tables of InfluxDB: the annotated CSV of Influx 2, pivoted or not, and the output of influx -format csv",
    shows,
    read,
};

const GROUP: &str = "#group";
const TYPES: &str = "#datatype";
const DEFAULTS: &str = "#default";

fn shows(start: &FileStart) -> Shows {
    let mut cells = start.cells();
    let (first, second) = (cells.next().unwrap_or_default(), cells.next().unwrap_or_default());
    let is_annotated = first.first().is_some_and(|cell| [GROUP, TYPES, DEFAULTS].contains(&cell.as_str()));
    let has = |name: &str| first.iter().any(|cell| cell == name);
    let is_in_nanoseconds = |time: usize| {
        second.get(time).is_some_and(|time| time.len() >= NANOSECONDS && time.bytes().all(|byte| byte.is_ascii_digit()))
    };
    let is_printed = first.first().is_some_and(|cell| cell == "name")
        && first.iter().position(|cell| cell == "time").is_some_and(|time| has("tags") || is_in_nanoseconds(time));
    let is_of_query = has("_value") || has("_measurement") || has("result") && has("table");
    Shows::rows_if(is_annotated || has("_time") && is_of_query || is_printed)
}

/// A number of nanoseconds since 1970 has so many digits, up to the year 2286.
const NANOSECONDS: usize = 19;

#[derive(Clone, Debug, PartialEq)]
enum InfluxColumn {
    Unused,
    Time,
    Measurement,
    Field,
    Value,
    Tag(String),
    Reading(String),
    /// Tags as one text, such as `room=hall,entity_id=pir`.
    Tags,
    /// A tag or a field, which its first cell tells.
    Either(String),
}

#[derive(Default)]
struct InfluxTable {
    groups: Vec<String>,
    types: Vec<String>,
    defaults: Vec<String>,
    columns: Vec<InfluxColumn>,
}

impl InfluxTable {
    /// Takes a row of annotations or of names; whether it is one.
    fn learn(&mut self, cells: &[String]) -> bool {
        let annotation = match cells.first().map(String::as_str) {
            Some(GROUP) => &mut self.groups,
            Some(TYPES) => &mut self.types,
            Some(DEFAULTS) => &mut self.defaults,
            _ => {
                let is_heading = cells.iter().any(|cell| cell == "_time")
                    || cells.first().is_some_and(|cell| cell == "name") && cells.iter().any(|cell| cell == "time")
                    || cells.iter().any(|cell| cell == "error") && cells.iter().any(|cell| cell == "reference");
                if is_heading {
                    self.columns = cells.iter().enumerate().map(|(at, name)| self.column(at, name, cells)).collect();
                }
                return is_heading;
            }
        };
        *annotation = cells.to_vec();
        self.columns.clear();
        true
    }

    fn column(&self, at: usize, name: &str, all: &[String]) -> InfluxColumn {
        let is_printed = all.first().is_some_and(|cell| cell == "name");
        let has_value = all.iter().any(|cell| cell == "_value");
        match name {
            "" | "result" | "table" | "_start" | "_stop" if !is_printed => InfluxColumn::Unused,
            "error" | "reference" if !all.iter().any(|cell| cell == "_time") => InfluxColumn::Unused,
            "_time" => InfluxColumn::Time,
            "time" if is_printed => InfluxColumn::Time,
            "name" if is_printed && at == 0 => InfluxColumn::Measurement,
            "tags" if is_printed => InfluxColumn::Tags,
            "_measurement" => InfluxColumn::Measurement,
            "_field" => InfluxColumn::Field,
            "_value" => InfluxColumn::Value,
            "value" | "state" => InfluxColumn::Reading(name.into()),
            name if has_value => InfluxColumn::Tag(name.into()),
            name => match (self.groups.get(at).map(String::as_str), self.types.get(at).map(String::as_str)) {
                (Some("true"), _) => InfluxColumn::Tag(name.into()),
                (Some("false"), _) => InfluxColumn::Reading(name.into()),
                (_, Some("string")) => InfluxColumn::Tag(name.into()),
                (_, Some(_)) => InfluxColumn::Reading(name.into()),
                (None, None) => InfluxColumn::Either(name.into()),
                (Some(_), None) => InfluxColumn::Either(name.into()),
            },
        }
    }

    /// The point of a row and what tells its instant; None where no cell tells one.
    fn point(&mut self, cells: &[String]) -> Option<(InfluxPoint, String)> {
        let (mut point, mut time, mut field, mut value) = (InfluxPoint::default(), None, None, None);
        for (at, column) in self.columns.iter_mut().enumerate() {
            let cell = cells.get(at).filter(|cell| !cell.is_empty()).or_else(|| self.defaults.get(at));
            let Some(cell) = cell.filter(|cell| !cell.is_empty()).cloned() else { continue };
            if let InfluxColumn::Either(name) = column {
                let is_reading = cell.parse::<f64>().is_ok() || ["true", "false"].contains(&cell.as_str());
                let name = std::mem::take(name);
                *column = if is_reading || name.ends_with("_str") {
                    InfluxColumn::Reading(name)
                } else {
                    InfluxColumn::Tag(name)
                };
            }
            match column {
                InfluxColumn::Unused | InfluxColumn::Either(_) => {}
                InfluxColumn::Time => time = Some(cell),
                InfluxColumn::Measurement => point.measurement = cell,
                InfluxColumn::Field => field = Some(cell),
                InfluxColumn::Value => value = Some(cell),
                InfluxColumn::Tag(name) => point.tags.push((name.clone(), cell)),
                InfluxColumn::Reading(name) => point.fields.push((name.clone(), cell)),
                InfluxColumn::Tags => {
                    let tags = cell.split(',').filter_map(|tag| tag.split_once('='));
                    point.tags.extend(tags.map(|(key, value)| (key.to_owned(), value.to_owned())));
                }
            }
        }
        if let Some(value) = value {
            point.fields.push((field.unwrap_or_else(|| "value".into()), value));
        }
        Some((point, time?))
    }
}

struct Tables {
    records: RecordReader,
    table: InfluxTable,
    instants: InstantReader,
}

/// A row as a point and its time, or the fault in it.
type PointResult = Result<(InfluxPoint, String), &'static str>;

impl Tables {
    fn open(path: &Path) -> Result<Tables, LogError> {
        Ok(Tables {
            records: RecordReader::open(path)?,
            table: InfluxTable::default(),
            instants: InstantReader::default(),
        })
    }

    /// The next row of cells with its line, past annotations and headings; None at the end.
    fn next(&mut self) -> Result<Option<(u64, PointResult)>, LogError> {
        loop {
            let time = self.table.columns.iter().position(|column| *column == InfluxColumn::Time);
            let instants = &mut self.instants;
            let mut is_row = |alone: &Record| {
                let time = time.and_then(|time| alone.get(time)).map(String::from_utf8_lossy);
                time.is_some_and(|time| instant(&time, instants).is_some())
            };
            let Some((line, record)) = self.records.next(&mut is_row)? else { return Ok(None) };
            if record.is_broken {
                return Ok(Some((line, Err("a quote in it is never closed"))));
            }
            let cells = record.texts();
            if cells.iter().all(String::is_empty) || self.table.learn(&cells) {
                continue;
            }
            let told = match self.table.columns.is_empty() {
                true => Err("no heading with a time is above it"),
                false => self.table.point(&cells).ok_or("it has no time"),
            };
            return Ok(Some((line, told)));
        }
    }
}

fn read(path: &Path, _: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    let mut series = Series::default();
    // A state as a word and as a number may be in rows of their own: which fields a series has must be known first.
    let mut tables = Tables::open(path)?;
    while let Some((_, told)) = tables.next()? {
        if let Ok((point, _)) = told {
            let fields = point.fields.iter().map(|(name, _)| name.clone());
            series.fields.entry(point.series()).or_default().extend(fields);
        }
    }
    let mut out = Gathered::in_order(path, reading);
    out.column("_time or time", ColumnRole::Time, "its heading");
    let mut tables = Tables::open(path)?;
    while let Some((line, told)) = tables.next()? {
        match told {
            Ok((point, time)) => match instant(&time, &mut out.reading.instants) {
                Some(at) => series.take(line, at, &point, &mut out)?,
                None => out.reading.skip(line, no_instant(&time)),
            },
            Err(why) => out.reading.skip(line, why.into()),
        }
    }
    out.end()
}

fn instant(time: &str, instants: &mut InstantReader) -> Option<LogInstant> {
    instants.read(time).or_else(|| since_1970_whole(time.trim().parse().ok()?))
}
