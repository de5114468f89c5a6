//! The table of a log's sensors, which a run leaves in the log's folder, or a person writes.

use crate::error::{LogError, place_of};
use crate::limits::beginning;
use crate::places::SENSORS;
use crate::plain;
use crate::problems::SensorTableMessage;
use crate::sensor_info::SensorInfo;
use crate::sensor_table::{self, LARGEST_TABLE_BYTES};
use crate::skipped::Skipped;
use crate::spreadsheet::unescaped;
use homebody_core::problem::{Problem, Problems, readable};
use homebody_core::sensed::{Kind, meaning};
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::Path;

/// The contents of a table of sensors.
#[derive(Default)]
pub(crate) struct Beside {
    /// The sensors; none where no table of ours lies there.
    pub known: Vec<SensorInfo>,
    /// Rows and cells that mean nothing.
    pub problems: Vec<Skipped>,
    /// Why the table was not read.
    pub remark: Option<String>,
}

/// The table of sensors of a log: its own, else that of its run. One that is too large is not read: that is a remark.
///
/// A person may write it by hand: besides `id` it has any of the columns `name`, `kind`, `room`, `x_m`, `y_m` and `unit`, in any order.
pub(crate) fn known_beside(log: &Path) -> Result<Beside, LogError> {
    let tables = [sensor_table::beside(log), log.with_file_name(SENSORS)];
    let Some(path) = tables.into_iter().find(|path| path.is_file() && path != log) else {
        return Ok(Beside::default());
    };
    match plain::read(&path, LARGEST_TABLE_BYTES) {
        Ok(table) => Ok(Beside::of(&table, &readable(place_of(&path)))),
        Err(error) if error.kind() == ErrorKind::FileTooLarge => {
            let remark = format!("of its sensors only the ids are known: {}: {error}", place_of(&path));
            Ok(Beside { remark: Some(remark), ..Beside::default() })
        }
        Err(error) => Err(LogError::reading(&path, error)),
    }
}

impl Beside {
    fn of(table: &[u8], file: &str) -> Beside {
        let mut beside = Beside::default();
        let table = table.strip_prefix(b"\xef\xbb\xbf").unwrap_or(table);
        let heading = table.split(|byte| *byte == b'\n').next().unwrap_or_default();
        let is_german = heading.contains(&b';') && !heading.contains(&b',');
        let mut builder = csv::ReaderBuilder::new();
        builder.flexible(true).trim(csv::Trim::All).delimiter(if is_german { b';' } else { b',' });
        let mut reader = builder.from_reader(table);
        let header = reader.byte_headers().cloned().unwrap_or_default();
        let place = |name: &str| header.iter().position(|cell| cell.eq_ignore_ascii_case(name.as_bytes()));
        let places = ["name", "kind", "room", "unit", "x_m", "y_m"].map(place);
        // Another program's table of this name tells us nothing.
        let (Some(id), [Some(_), ..] | [_, Some(_), ..] | [_, _, Some(_), ..]) = (place("id"), places) else {
            return beside;
        };
        for row in reader.byte_records() {
            let (line, told) = match &row {
                Ok(row) => (row.position().map_or(0, csv::Position::line), info(row, id, places)),
                Err(error) => (error.position().map_or(0, csv::Position::line), Err(vec!["it is no row".into()])),
            };
            let (known, faults) = match told {
                Ok((known, faults)) => (Some(known), faults),
                Err(faults) => (None, faults),
            };
            let is_new = |known: &SensorInfo| beside.known.iter().all(|other| other.id != known.id);
            let faults = match &known {
                Some(known) if !is_new(known) => vec![format!("the id {} has a row already", beginning(&known.id))],
                _ => faults,
            };
            beside.known.extend(known.filter(is_new));
            let told = faults.into_iter().map(|why| Skipped { line, beside: Some(file.to_owned()), why });
            beside.problems.extend(told);
        }
        beside
    }
}

/// The sensor of a row, with the cells that mean nothing; or why the row means nothing.
fn info(
    row: &csv::ByteRecord,
    id: usize,
    places: [Option<usize>; 6],
) -> Result<(SensorInfo, Vec<String>), Vec<String>> {
    let cell = |place: Option<usize>| {
        let cell = place.and_then(|place| row.get(place)).unwrap_or_default();
        unescaped(&String::from_utf8_lossy(cell)).to_owned()
    };
    let id = cell(Some(id));
    if id.is_empty() {
        return Err(vec!["there is no id".into()]);
    }
    let mut faults = Vec::new();
    let [name, kind, room, unit, x_m, y_m] = places.map(cell);
    let kind = match kind.is_empty() || meaning(&kind, "").is_some() {
        true => kind,
        false => {
            let kinds = Kind::ALL.map(Kind::word).join(", ");
            let kind = beginning(&kind);
            faults.push(format!(
                "the kind {kind} is not known: there are {kinds}, and words such as door, bed and light"
            ));
            String::new()
        }
    };
    let mut metres = |text: String, what: &str| match text.parse::<f64>() {
        Ok(metres) if metres.is_finite() => metres,
        _ if text.is_empty() => 0.0,
        _ => {
            faults.push(format!("{what} is no number: {}", beginning(&text)));
            0.0
        }
    };
    let at_m = [metres(x_m, "x_m"), metres(y_m, "y_m")];
    let known = SensorInfo { at_m, ..SensorInfo::of_cells([id, name, kind, room, unit]) };
    Ok((known, faults))
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
        let wrong = |line: u64, what: SensorTableMessage| {
            let problem = Problem::of_file(&place_of(path), what, None);
            Problem { line: u32::try_from(line).unwrap_or(u32::MAX), column: 1, ..problem }
        };
        let header = reader.byte_headers().cloned().unwrap_or_default();
        let place = |name: &str| header.iter().position(|cell| cell.trim_ascii() == name.as_bytes());
        let (Some(id), Some(name)) = (place("id"), place("name")) else {
            return Err(LogError::SensorMap(Problems(vec![wrong(1, SensorTableMessage::NoHeading)])));
        };
        let (mut map, mut names, mut problems) = (BTreeMap::new(), BTreeMap::new(), Vec::new());
        for row in reader.byte_records() {
            let row = row.map_err(|error| LogError::reading(path, error.into()))?;
            let line = row.position().map_or(0, csv::Position::line);
            let cell = |place: usize| String::from_utf8_lossy(row.get(place).unwrap_or_default()).into_owned();
            let [id, name] = [id, name].map(|place| unescaped(&cell(place)).to_owned());
            if id.is_empty() || name.is_empty() {
                problems.push(wrong(line, SensorTableMessage::EmptyCell));
                continue;
            }
            if let Some(first) = names.insert(name.clone(), line) {
                problems.push(wrong(line, SensorTableMessage::SameName { name: beginning(&name), line: first }));
            }
            if map.insert(id.clone(), name).is_some() {
                problems.push(wrong(line, SensorTableMessage::SameId { id: beginning(&id) }));
            }
        }
        if problems.is_empty() { Ok(SensorMap(map)) } else { Err(LogError::SensorMap(Problems(problems))) }
    }

    /// What the home calls a sensor, if the table has its id.
    pub fn name(&self, id: &str) -> Option<&str> {
        self.0.get(id).map(String::as_str)
    }
}
