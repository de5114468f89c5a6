//! What is known of a log's sensors: from the table that a run leaves beside its log.

use crate::error::{LogError, place_of};
use crate::places::SENSORS;
use crate::plain;
use crate::sensor_info::SensorInfo;
use crate::spreadsheet::unescaped;
use homebody_core::sensors::kinds::KINDS;
use serde::Deserialize;
use std::io::ErrorKind;
use std::path::Path;

/// No table of sensors has more bytes (ours): a home of a thousand has a tenth of a mebibyte.
const LARGEST_TABLE_BYTES: u64 = 4 << 20;

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

/// The sensors of the table beside a log; none where no table of ours lies there. One that is too large is not read, which is
/// among the remarks.
pub(crate) fn known_beside(log: &Path, remarks: &mut Vec<String>) -> Result<Vec<SensorInfo>, LogError> {
    let path = log.with_file_name(SENSORS);
    if !path.is_file() || path == log {
        return Ok(Vec::new());
    }
    let table = match plain::read(&path, LARGEST_TABLE_BYTES) {
        Ok(table) => table,
        Err(error) if error.kind() == ErrorKind::FileTooLarge => {
            remarks.push(format!("of its sensors only the ids are known: {}: {error}", place_of(&path)));
            return Ok(Vec::new());
        }
        Err(error) => return Err(LogError::reading(&path, error)),
    };
    let rows = csv::Reader::from_reader(&table[..]).into_deserialize().collect::<Result<Vec<Row>, _>>();
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
