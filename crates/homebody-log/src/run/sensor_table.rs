//! The table of a log's sensors: the id of each in the log, its name in the home, its kind, room, place and unit, and the time zone.
//!
//! A run's folder has one, `sensors.csv`. Any other log has its own, such as `week.sensors.csv` of `week.csv`. A database has a
//! table instead, and files of Parquet and Arrow say it in their own words.

use super::RunInfo;
use crate::error::{LogError, SensorTableMessage, Skipped, place_of};
use crate::files::{FreshFile, plain};
use crate::limits::beginning;
use crate::log::SensorInfo;
use crate::text::{escaped, unescaped};
use crate::url::Url;
use homebody_core::problem::{Problem, Problems, readable};
use homebody_core::scenario::inside::SENSORS;
use homebody_core::sensed::{Kind, meaning};
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

const ENDING: &str = "sensors.csv";

/// The columns of the file.
const COLUMNS: [&str; 8] = ["id", "name", "kind", "room", "x_m", "y_m", "unit", "zone"];

/// Largest size of a table of sensors. A thousand sensors take a tenth of a mebibyte.
pub(crate) const LARGEST_TABLE_BYTES: u64 = 4 << 20;

/// The path of the table of one log: `week.sensors.csv` of `week.csv` and of `week.csv.gz`.
pub(crate) fn beside(log: &Path) -> PathBuf {
    let packed = log.extension().is_some_and(|ending| ending == "gz" || ending == "zst");
    let text = if packed { log.with_extension("") } else { log.to_owned() };
    text.with_extension(ENDING)
}

/// The path of the table that is written with a log; None for a place that holds the sensors itself.
pub(crate) fn beside_url(url: &Url) -> Option<PathBuf> {
    let file = url.file().filter(|_| !url.scheme().row().has_sensors);
    file.filter(|file| plain::may_have_beside(file)).map(beside)
}

/// A table: a file, and its bytes.
pub(crate) struct SensorTable {
    pub path: PathBuf,
    bytes: Vec<u8>,
}

impl SensorTable {
    /// The table of a run's sensors, a row each.
    pub fn new(path: PathBuf, run: &RunInfo) -> Result<SensorTable, LogError> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let wrong = |error: csv::Error| LogError::file(&path, error.into());
        writer.write_record(COLUMNS).map_err(wrong)?;
        let zone = run.zone().unwrap_or_default();
        for sensor in &run.sensors {
            let [x, y] = sensor.at_m.map(|metres| format!("{metres:.3}"));
            let room = sensor.room.as_deref().unwrap_or_default();
            let unit = sensor.unit.as_deref().unwrap_or_default();
            let [id, name, kind, room, unit] = [&sensor.id, &sensor.name, &sensor.kind, room, unit].map(escaped);
            writer.write_record([&*id, &*name, &*kind, &*room, &x, &y, &*unit, zone]).map_err(wrong)?;
        }
        let bytes = writer.into_inner().map_err(|error| LogError::file(&path, error.into_error()))?;
        Ok(SensorTable { path, bytes })
    }

    /// Whether the file has these bytes already, as a killed program may have left it.
    pub fn is_there(&self) -> bool {
        plain::read(&self.path, self.bytes.len() as u64).is_ok_and(|found| found == self.bytes)
    }

    /// Refuses where another file is in its place, unless `force` allows to replace it. Logs of one name share their table.
    pub fn may_be_written(&self, force: bool) -> Result<(), LogError> {
        match force || !self.path.exists() || self.is_there() {
            true => Ok(()),
            false => Err(LogError::Exists { place: place_of(&self.path) }),
        }
    }

    /// Writes the file; `force` allows to replace another.
    pub fn write(&self, force: bool) -> Result<(), LogError> {
        match self.is_there() {
            true => Ok(()),
            false => FreshFile::write_whole(&self.path, &self.bytes, force),
        }
    }
}

pub(crate) fn write(path: &Path, run: &RunInfo, force: bool) -> Result<(), LogError> {
    SensorTable::new(path.to_owned(), run)?.write(force)
}

#[derive(Default)]
pub(crate) struct KnownSensors {
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
pub(crate) fn known_beside(log: &Path) -> Result<KnownSensors, LogError> {
    let tables = [beside(log), log.with_file_name(SENSORS)];
    let Some(path) = tables.into_iter().find(|path| path.is_file() && path != log) else {
        return Ok(KnownSensors::default());
    };
    match plain::read(&path, LARGEST_TABLE_BYTES) {
        Ok(table) => Ok(KnownSensors::parse(&table, &readable(place_of(&path)))),
        Err(error) if error.kind() == ErrorKind::FileTooLarge => {
            let remark = format!("of its sensors only the ids are known: {}: {error}", place_of(&path));
            Ok(KnownSensors { remark: Some(remark), ..KnownSensors::default() })
        }
        Err(error) => Err(LogError::reading(&path, error)),
    }
}

impl KnownSensors {
    fn parse(table: &[u8], file: &str) -> KnownSensors {
        let mut beside = KnownSensors::default();
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

/// The names in the home of sensors that a log has by ids: a table with the columns `id` and `name`, such as the one that a run leaves
/// next to its log.
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

    /// The name of a sensor in the home, if the table has its id.
    pub fn name(&self, id: &str) -> Option<&str> {
        self.0.get(id).map(String::as_str)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_form_of_file_has_a_sensor_table() {
        for (place, table) in [
            ("csv:a/week.csv", Some("a/week.sensors.csv")),
            ("csv:week.csv.gz", Some("week.sensors.csv")),
            ("casas:log.txt", Some("log.sensors.csv")),
            ("jsonl:log", Some("log.sensors.csv")),
            ("parquet:week.parquet", None),
            ("parquet:s3://bucket/lives", None),
            ("sqlite:log.db", None),
            ("csv:-", None),
            ("postgresql://ann@host/homes", None),
        ] {
            let url: Url = place.parse().unwrap();
            assert_eq!(beside_url(&url).as_deref(), table.map(Path::new), "{place}");
        }
    }
}
