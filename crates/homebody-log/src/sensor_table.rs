//! The table of a log's sensors: the id of each in the log, its name in the home, its kind, room, place and unit, and the time zone.
//!
//! A run's folder has one, `sensors.csv`. Any other log has its own, such as `week.sensors.csv` of `week.csv`. A database has a
//! table instead, and files of Parquet and Arrow say it in their own words.

use crate::error::{LogError, place_of};
use crate::fresh::FreshFile;
use crate::plain;
use crate::run_info::RunInfo;
use crate::spreadsheet::escaped;
use crate::url::Url;
use homebody_core::scenario::scheme::Scheme;
use std::path::{Path, PathBuf};

/// The ending of its file.
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
    match url.scheme() {
        Scheme::Sqlite | Scheme::Parquet | Scheme::Arrow => None,
        _ => url.file().filter(|file| plain::may_have_beside(file)).map(beside),
    }
}

/// A table: a file, and its bytes.
pub(crate) struct SensorTable {
    pub path: PathBuf,
    bytes: Vec<u8>,
}

impl SensorTable {
    /// The table of a run's sensors, a row each.
    pub fn of(path: PathBuf, run: &RunInfo) -> Result<SensorTable, LogError> {
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

/// Writes the table of a run's sensors.
pub(crate) fn write(path: &Path, run: &RunInfo, force: bool) -> Result<(), LogError> {
    SensorTable::of(path.to_owned(), run)?.write(force)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_form_of_file_has_its_sensors_beside_it() {
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
