//! The types of columns, and the description that a file has of itself.
//!
//! Instants are microseconds since 1970 in UTC, and the file has the zone of the home. If the mapping wants local time without its offset,
//! they are local time without a zone. Texts are dictionaries, readings too.

use arrow_schema::{DataType, Field, Schema, TimeUnit};
use homebody_core::scenario::logger::TimeFormat;
use homebody_core::time::RunTime;
use homebody_log::log::{SENSOR_COLUMNS, says_more_of, sensor_cells};
use homebody_log::table::{Column, ColumnKind, Table};
use homebody_log::{Begin, SensorInfo};
use serde_json::{Map, Value, json};
use std::collections::HashMap;

/// The key of a file's description, an object of JSON.
pub(crate) const ABOUT: &str = "homebody";

const SENSORS: &str = "sensors";

/// In it: how many rows of the table come before those of the file. A data set is read in this order.
pub(crate) const ROWS_BEFORE: &str = "rows_before";

/// The columns of a table; `has_run` says whether the first is that of the run's id.
pub(crate) fn schema(table: &Table, begin: &Begin, has_run: bool) -> Schema {
    let run = has_run.then(|| Field::new(&begin.run_column, DataType::Int64, false));
    let is_key = |index: usize| table.is_numbered && index == 0;
    let columns = table.columns.iter().enumerate().map(|(index, column)| {
        Field::new(&column.name, data_type(column.kind, begin.time), !is_key(index))
            .with_metadata(field_metadata(column))
    });
    Schema::new(run.into_iter().chain(columns).collect::<Vec<_>>())
}

fn data_type(kind: ColumnKind, time: TimeFormat) -> DataType {
    match kind {
        ColumnKind::Instant => DataType::Timestamp(TimeUnit::Microsecond, zone(time).map(Into::into)),
        ColumnKind::Integer => DataType::Int64,
        ColumnKind::Real => DataType::Float64,
        ColumnKind::Text => DataType::Dictionary(Box::new(DataType::Int32), Box::new(DataType::Utf8)),
    }
}

/// The zone of instants; None where they are by the clock on the wall.
pub(crate) fn zone(time: TimeFormat) -> Option<&'static str> {
    (time != TimeFormat::Local).then_some("UTC")
}

fn field_metadata(column: &Column) -> HashMap<String, String> {
    let unit = (!column.unit.is_empty()).then(|| ("unit".to_owned(), column.unit.to_owned()));
    let about = ("about".to_owned(), column.about.to_owned());
    std::iter::once(about).chain(unit).collect()
}

/// A file's description, without the number of rows before its own.
pub(crate) fn about(table: &Table, begin: &Begin) -> Map<String, Value> {
    let run = &begin.run;
    let mut about = Map::new();
    about.insert("table".into(), table.name.clone().into());
    about.insert("about".into(), table.about.into());
    about.insert("name".into(), run.scenario.clone().into());
    if run.is_simulated {
        about.insert("synthetic".into(), true.into());
        about.insert("scenario".into(), run.scenario.clone().into());
        about.insert("home".into(), run.home.clone().into());
        about.insert("run".into(), run.id.into());
        // Programs that read JSON into floats would round a large one.
        about.insert("seed".into(), run.seed.to_string().into());
        about.insert("zone".into(), run.calendar.local(RunTime::START).time_zone().iana_name().into());
    }
    about.insert("version".into(), run.version.clone().into());
    let columns = table.columns.iter().map(|column| {
        let unit = if column.unit.is_empty() { Value::Null } else { column.unit.into() };
        (column.name.clone(), json!({ "unit": unit, "about": column.about }))
    });
    about.insert("columns".into(), Value::Object(columns.collect()));
    // The rows of a log are numbered, those of a truth are not.
    if table.is_numbered && says_more_of(&run.sensors) {
        let row = |sensor| Value::Object(SENSOR_COLUMNS.map(str::to_owned).into_iter().zip(cells(sensor)).collect());
        about.insert(SENSORS.into(), run.sensors.iter().map(row).collect());
    }
    about
}

fn cells(sensor: &SensorInfo) -> [Value; 5] {
    sensor_cells(sensor).map(|cell| cell.map_or(Value::Null, Into::into))
}

/// Largest number of sensors that are read from a file.
const MOST_SENSORS: usize = 1000;

/// The sensors in the metadata of a log's file; none in files of other programs.
pub(crate) fn sensors(about: &str) -> Vec<SensorInfo> {
    let about: Value = serde_json::from_str(about).unwrap_or_default();
    let rows = about[SENSORS].as_array().into_iter().flatten().take(MOST_SENSORS);
    let sensor = |row: &Value| {
        let cells = SENSOR_COLUMNS.map(|name| row[name].as_str().unwrap_or_default().to_owned());
        (!cells[0].is_empty()).then(|| SensorInfo::of_cells(cells))
    };
    rows.filter_map(sensor).collect()
}
