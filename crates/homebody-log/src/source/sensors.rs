//! What is known of a log's sensors: from the table that a run leaves beside its log.

use crate::error::LogError;
use crate::places::SENSORS;
use crate::sensor_info::SensorInfo;
use crate::spreadsheet::unescaped;
use homebody_core::sensors::kinds::KINDS;
use serde::Deserialize;
use std::fs;
use std::path::Path;

/// No table of sensors has more bytes (ours): a home of a thousand has a tenth of a mebibyte.
const LARGEST_BYTES: u64 = 4 << 20;

/// A row of the table.
#[derive(Deserialize)]
struct Row {
    id: String,
    name: String,
    kind: String,
    room: String,
    x_m: f64,
    y_m: f64,
}

/// The sensors of the table beside a log; none where no table of ours lies there.
pub(crate) fn beside(log: &Path) -> Result<Vec<SensorInfo>, LogError> {
    let path = log.with_file_name(SENSORS);
    let is_table = fs::metadata(&path).is_ok_and(|found| found.is_file() && found.len() <= LARGEST_BYTES);
    if !is_table || path == log {
        return Ok(Vec::new());
    }
    let wrong = |error: csv::Error| LogError::file(&path, error.into());
    let rows = csv::Reader::from_path(&path).map_err(wrong)?.into_deserialize().collect::<Result<Vec<Row>, _>>();
    // Another program's table of this name tells us nothing.
    Ok(rows.unwrap_or_default().into_iter().map(Row::info).collect())
}

impl Row {
    fn info(self) -> SensorInfo {
        let Row { id, name, kind, room, x_m, y_m } = self;
        let [id, name, room] = [id, name, room].map(|cell| unescaped(&cell).to_owned());
        let row = KINDS.iter().find(|row| row.key == kind);
        SensorInfo {
            name,
            id,
            is_motion: row.is_some_and(|row| row.senses_motion()),
            unit: row.and_then(|row| row.unit).map(|unit| unit.symbol.to_owned()),
            values: row.map(|row| row.values.iter().map(ToString::to_string).collect()).unwrap_or_default(),
            kind,
            room: Some(room).filter(|room| !room.is_empty()),
            at_m: [x_m, y_m],
        }
    }
}
