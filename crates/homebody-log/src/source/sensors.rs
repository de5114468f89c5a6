//! What is known of a log's sensors: from the table that a run leaves beside its log.

use crate::error::{LogError, place_of};
use crate::limits::beginning;
use crate::places::SENSORS;
use crate::plain;
use crate::sensor_info::SensorInfo;
use crate::sensor_table::{self, LARGEST_TABLE_BYTES};
use crate::spreadsheet::unescaped;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::Path;

/// A row of the table.
#[derive(Deserialize)]
struct Row {
    id: String,
    name: String,
    kind: String,
    room: String,
    x_m: f64,
    y_m: f64,
    #[serde(default)]
    unit: String,
}

/// The sensors of a log's table: its own, else that of its run. None without such a table. One that
/// is too large is not read, which is among the remarks.
pub(crate) fn known_beside(log: &Path, remarks: &mut Vec<String>) -> Result<Vec<SensorInfo>, LogError> {
    let tables = [sensor_table::beside(log), log.with_file_name(SENSORS)];
    let Some(path) = tables.into_iter().find(|path| path.is_file() && path != log) else { return Ok(Vec::new()) };
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
        let Row { id, name, kind, room, x_m, y_m, unit } = self;
        let cells = [id, name, kind, room, unit].map(|cell| unescaped(&cell).to_owned());
        SensorInfo { at_m: [x_m, y_m], ..SensorInfo::of_cells(cells) }
    }
}

/// What a home calls sensors that a log knows by ids: a table with the columns `id` and `name`, such as the one that a run leaves
/// beside its log.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SensorMap(BTreeMap<String, String>);

impl SensorMap {
    /// Reads a table.
    ///
    /// # Errors
    ///
    /// [`LogError::Missing`] if it is not there, [`LogError::SensorMap`] with all that is wrong: columns that it lacks, rows without
    /// an id or a name, ids and names that are there twice.
    pub fn read(path: &Path) -> Result<SensorMap, LogError> {
        let table = plain::read(path, LARGEST_TABLE_BYTES).map_err(|error| match error.kind() {
            ErrorKind::NotFound => LogError::Missing { place: place_of(path) },
            _ => LogError::reading(path, error),
        })?;
        let mut reader = csv::ReaderBuilder::new().flexible(true).trim(csv::Trim::All).from_reader(&table[..]);
        let wrong = |line: u64, what: String| format!("{}:{line}: {what}", place_of(path));
        let header = reader.byte_headers().cloned().unwrap_or_default();
        let place = |name: &str| header.iter().position(|cell| cell.trim_ascii() == name.as_bytes());
        let (Some(id), Some(name)) = (place("id"), place("name")) else {
            return Err(LogError::SensorMap { problems: vec![wrong(1, "there are no columns id and name".into())] });
        };
        let (mut map, mut names, mut problems) = (BTreeMap::new(), BTreeMap::new(), Vec::new());
        for row in reader.byte_records() {
            let row = row.map_err(|error| LogError::reading(path, error.into()))?;
            let line = row.position().map_or(0, csv::Position::line);
            let cell = |place: usize| String::from_utf8_lossy(row.get(place).unwrap_or_default()).into_owned();
            let [id, name] = [id, name].map(|place| unescaped(&cell(place)).to_owned());
            if id.is_empty() || name.is_empty() {
                problems.push(wrong(line, "an id or a name is empty".into()));
                continue;
            }
            if let Some(first) = names.insert(name.clone(), line) {
                problems.push(wrong(line, format!("the name {} is that of line {first}, too", beginning(&name))));
            }
            if map.insert(id.clone(), name).is_some() {
                problems.push(wrong(line, format!("the id {} has a name already", beginning(&id))));
            }
        }
        if problems.is_empty() { Ok(SensorMap(map)) } else { Err(LogError::SensorMap { problems }) }
    }

    /// What the home calls a sensor, if the table has its id.
    pub fn name(&self, id: &str) -> Option<&str> {
        self.0.get(id).map(String::as_str)
    }
}
