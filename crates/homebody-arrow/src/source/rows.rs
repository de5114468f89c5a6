//! Rows of a log, or spans of activities, by the names of columns.

use super::batches::OpenedTable;
use super::cells::{TextCells, TimeCell, Times};
use super::files::files;
use super::here::{here, of_place};
use crate::layout::sensors;
use crate::messages::ColumnsMessage;
use arrow_array::{Array, ArrayRef, RecordBatch};
use arrow_schema::{DataType, Schema};
use homebody_core::scenario::logger::LoggerFile;
use homebody_log::LogError;
use homebody_log::log::SPAN_COLUMNS;
use homebody_log::source::{ColumnPlaces, LogInstant, LogReading};
use homebody_log::table::LOG;
use serde_json::Value;
use std::path::Path;

/// Largest number of characters of unknown names in a message (our choice).
const LONGEST_TOLD: usize = 200;

pub(super) fn read(path: &Path, mapping: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    let (_kept, folder) = here(path)?;
    let mut line = 0;
    for file in files(&folder).map_err(|error| of_place(path, error))? {
        let opened = OpenedTable::open(&file)?;
        if let Some(columns) = spans(&opened.schema) {
            read_spans(&file, opened, &columns, &mut line, reading)?;
        } else {
            read_rows(&file, opened, mapping, &mut line, reading)?;
        }
    }
    Ok(())
}

pub(super) fn are_activities(path: &Path) -> bool {
    OpenedTable::open(path).is_ok_and(|opened| spans(&opened.schema).is_some())
}

fn names(schema: &Schema) -> Vec<String> {
    schema.fields().iter().map(|field| field.name().clone()).collect()
}

fn spans(schema: &Schema) -> Option<[usize; 3]> {
    let place = |wanted: &str| schema.fields().iter().position(|field| field.name() == wanted);
    let [begin, end, activity] = SPAN_COLUMNS.map(place);
    let is_log = ColumnPlaces::by_name(&names(schema), &LoggerFile::default()).is_some();
    Some([begin?, end?, activity?]).filter(|_| !is_log)
}

/// For unknown names: the first column of instants is the time, and the next two are sensor and value, if they are texts. This covers our
/// own logs with names of a network. Of our own files, tables of a truth are left out.
fn by_types(opened: &OpenedTable) -> Option<ColumnPlaces> {
    let about = |told: &String| serde_json::from_str::<Value>(told).ok()?.get("about")?.as_str().map(|it| it == LOG);
    if opened.about.as_ref().is_some_and(|told| about(told) == Some(false)) {
        return None;
    }
    let is = |place: usize| opened.schema.fields().get(place).map(|field| field.data_type());
    let count = opened.schema.fields().len();
    let time = (0..count).find(|&place| matches!(is(place), Some(DataType::Timestamp(..))))?;
    let are_texts = [time + 1, time + 2].iter().all(|&place| is(place).is_some_and(TextCells::are_texts));
    are_texts.then_some(ColumnPlaces { time, sensor: time + 1, value: time + 2, label: None, is_mapped: false })
}

/// Takes so many rows of some columns.
pub(super) type Take<'t> = dyn FnMut(usize, &[ArrayRef]) -> Result<(), LogError> + 't;

/// Reads columns, and gives each batch with them in this order.
pub(super) fn each_batch(
    path: &Path,
    opened: OpenedTable,
    columns: &[usize],
    take: &mut Take<'_>,
) -> Result<(), LogError> {
    let mut sorted = columns.to_vec();
    sorted.sort_unstable();
    sorted.dedup();
    for batch in opened.rows(Some(&sorted))? {
        let batch: RecordBatch = batch?;
        let column = |wanted: &usize| {
            let place = sorted.binary_search(wanted).ok()?;
            batch.columns().get(place).cloned()
        };
        let arrays: Option<Vec<ArrayRef>> = columns.iter().map(column).collect();
        let arrays =
            arrays.ok_or_else(|| LogError::no_log(path.display().to_string(), ColumnsMessage::MissingColumn))?;
        take(batch.num_rows(), &arrays)?;
    }
    Ok(())
}

fn read_rows(
    path: &Path,
    opened: OpenedTable,
    mapping: &LoggerFile,
    line: &mut u64,
    reading: &mut LogReading<'_>,
) -> Result<(), LogError> {
    let schema = opened.schema.clone();
    let names = names(&schema);
    let no_log = |why: ColumnsMessage| LogError::no_log(path.display().to_string(), why);
    let Some(places) = ColumnPlaces::by_name(&names, mapping).or_else(|| by_types(&opened)) else {
        let told: String = names.join(", ").chars().take(LONGEST_TOLD).collect();
        return Err(no_log(ColumnsMessage::NoColumns { columns: told }));
    };
    let label = places.label.filter(|&place| TextCells::may_be(schema.field(place).data_type()));
    for place in [places.time, places.sensor, places.value] {
        let field = schema.field(place);
        let fits = if place == places.time { Times::may_be } else { TextCells::may_be };
        if !fits(field.data_type()) {
            return Err(no_log(ColumnsMessage::ColumnType { column: field.name().clone() }));
        }
    }
    let columns: Vec<usize> = [places.time, places.sensor, places.value].into_iter().chain(label).collect();
    // All files of a data set say the same.
    if let Some(about) = opened.about.as_deref().filter(|_| *line == 0) {
        sensors(about).into_iter().for_each(|sensor| reading.know(sensor));
    }
    let [mut time_buffer, mut sensor_buffer, mut value_buffer] = [(); 3].map(|()| String::new());
    each_batch(path, opened, &columns, &mut |rows, arrays| {
        let typed = || no_log(ColumnsMessage::OtherType);
        let times = Times::from_array(&arrays[0]).ok_or_else(typed)?;
        let (sensors, values) = (
            TextCells::from_array(&arrays[1]).ok_or_else(typed)?,
            TextCells::from_array(&arrays[2]).ok_or_else(typed)?,
        );
        let labels = arrays.get(3).and_then(TextCells::from_array);
        for row in 0..rows {
            *line += 1;
            if arrays[0].is_null(row) {
                reading.skip(*line, "there is no time".into());
                continue;
            }
            let (sensor, value) = (sensors.get(row, &mut sensor_buffer), values.get(row, &mut value_buffer));
            let is_row = match times.get(row, &mut time_buffer) {
                TimeCell::At(at) => reading.event(*line, at, sensor, value)?,
                TimeCell::Text(text) => reading.row(*line, text, sensor, value)?,
                TimeCell::OutOfRange => {
                    reading.skip(*line, "the time is out of range".into());
                    false
                }
            };
            if let (true, Some(labels)) = (is_row, &labels) {
                let label = labels.get(row, &mut time_buffer);
                reading.label(Some(label).filter(|label| !label.is_empty()));
            }
        }
        Ok(())
    })
}

fn read_spans(
    path: &Path,
    opened: OpenedTable,
    columns: &[usize; 3],
    line: &mut u64,
    reading: &mut LogReading<'_>,
) -> Result<(), LogError> {
    let mut buffer = String::new();
    each_batch(path, opened, columns, &mut |rows, arrays| {
        let typed = || LogError::no_log(path.display().to_string(), ColumnsMessage::ActivityType);
        let (begins, ends) =
            (Times::from_array(&arrays[0]).ok_or_else(typed)?, Times::from_array(&arrays[1]).ok_or_else(typed)?);
        let activities = TextCells::from_array(&arrays[2]).ok_or_else(typed)?;
        for row in 0..rows {
            *line += 1;
            let mut at = |times: &Times, array: &ArrayRef| -> Option<LogInstant> {
                match times.get(row, &mut buffer) {
                    _ if array.is_null(row) => None,
                    TimeCell::At(at) => Some(at),
                    TimeCell::Text(text) => reading.instant(text),
                    TimeCell::OutOfRange => None,
                }
            };
            match (at(&begins, &arrays[0]), at(&ends, &arrays[1])) {
                (Some(begin), Some(end)) => reading.span(*line, begin, end, activities.get(row, &mut buffer)),
                _ => reading.skip(*line, "an end is no date and time".into()),
            }
        }
        Ok(())
    })
}
