//! The silhouettes of a run's cameras, in a separate database: readers of the log need not see them, and they can be deleted alone.
//!
//! A row is a picture with a person in it. The table `camera` has the size, the rate and the position of pictures; `silhouette` has the
//! picture, packed by [`Silhouette::packed`], and its features.

use crate::error::{ChangedMessage, LogError, place_of};
use crate::files::WriteMode;
use crate::files::database::{connect, first_row};
use crate::run::RunInfo;
use crate::sink::database::Database;
use crate::sink::sqlite::{can_go_on, tell_run};
use crate::table::InstantWriter;
use homebody_core::camera::silhouette::{Features, Picture, Silhouette};
use homebody_core::event::Frame;
use homebody_core::home::resolved::ResolvedHome;
use homebody_core::ids::SensorId;
use homebody_core::scenario::logger::TimeFormat;
use homebody_core::sensors::camera::CameraFile;
use homebody_core::time::{Interval, RunTime, UtcTime};
use rusqlite::{Connection, OptionalExtension, params};
use std::path::{Path, PathBuf};

/// Rows that are inserted together (our choice): some seconds of a camera.
const BATCH: usize = 256;

/// Rows after which the database makes them durable (our choice).
const DURABLE_ROWS: usize = 20_000;

const CAMERA: &str = "CREATE TABLE camera (camera TEXT PRIMARY KEY, name TEXT NOT NULL, columns INTEGER NOT NULL, \
    rows INTEGER NOT NULL, frames_per_s REAL NOT NULL, x_m REAL NOT NULL, y_m REAL NOT NULL, height_m REAL NOT NULL, \
    facing_deg REAL NOT NULL, tilt_deg REAL NOT NULL, field_deg REAL NOT NULL) WITHOUT ROWID";

const SILHOUETTE: &str = "CREATE TABLE silhouette (utc_us INTEGER NOT NULL, camera TEXT NOT NULL, area_px INTEGER NOT NULL, \
    left_px INTEGER NOT NULL, top_px INTEGER NOT NULL, right_px INTEGER NOT NULL, bottom_px INTEGER NOT NULL, \
    centroid_x_px REAL NOT NULL, centroid_y_px REAL NOT NULL, orientation_deg REAL NOT NULL, elongation REAL NOT NULL, \
    packed BLOB NOT NULL)";

/// The first row from a number on.
const FROM_ROW: &str = "SELECT rowid, utc_us FROM silhouette WHERE rowid >= ? ORDER BY rowid LIMIT 1";

const INSERT: &str = "INSERT INTO silhouette VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)";

/// Keeps silhouettes as they come.
pub struct SilhouetteLog {
    database: Database,
    /// The ids of the sensors in the log.
    ids: Vec<String>,
    start: UtcTime,
    waiting: Vec<Frame>,
    not_durable: usize,
    /// The number of rows of the file at the beginning; as many of the run are not written again.
    there: u64,
}

/// The cameras of a home, each with its number among the sensors.
pub fn cameras(home: &ResolvedHome) -> impl Iterator<Item = (SensorId, &CameraFile)> {
    home.sensors.iter().enumerate().filter_map(|(index, sensor)| Some((SensorId::new(index), sensor.camera()?)))
}

impl SilhouetteLog {
    /// Begins the file of a run, or resumes it.
    pub fn open(path: &Path, home: &ResolvedHome, run: &RunInfo, how: WriteMode) -> Result<SilhouetteLog, LogError> {
        let left = if how == WriteMode::Resume { Database::reopen(path)? } else { None };
        let mut there = 0;
        let database = match left {
            Some(database) => {
                can_go_on(&database, run)?;
                let count = |connection: &Connection| {
                    connection.query_row("SELECT count(*) FROM silhouette", [], |row| row.get::<_, i64>(0))
                };
                there = database.ask(count)? as u64;
                database
            }
            None => {
                let mut clock = InstantWriter::new(&run.calendar, TimeFormat::default());
                let begin = |connection: &Connection| {
                    tell_run(run, TimeFormat::default(), &mut clock)(connection)?;
                    cameras(home).try_for_each(|(sensor, camera)| {
                        tell_camera(connection, &run.sensors[sensor.index()].id, camera)
                    })
                };
                Database::create(path, how == WriteMode::Overwrite, &[CAMERA, SILHOUETTE], begin)?
            }
        };
        let ids = run.sensors.iter().map(|sensor| sensor.id.clone()).collect();
        let start = run.calendar.timestamp(RunTime::START).into();
        Ok(SilhouetteLog { database, ids, start, waiting: Vec::new(), not_durable: 0, there })
    }

    /// Keeps what the cameras have kept since the last time.
    pub fn store(&mut self, frames: &[Frame]) -> Result<(), LogError> {
        for frame in frames {
            if self.there > 0 {
                self.there -= 1;
                continue;
            }
            self.waiting.push(frame.clone());
            if self.waiting.len() >= BATCH {
                self.insert()?;
            }
        }
        Ok(())
    }

    /// Writes what waits, and makes sure of it.
    pub fn make_durable(&mut self) -> Result<(), LogError> {
        self.insert()?;
        self.not_durable = 0;
        self.database.make_durable()
    }

    /// Completes the file.
    pub fn finish(mut self) -> Result<(), LogError> {
        if self.there > 0 {
            let more = ChangedMessage::RowsAhead { rows: self.there };
            return Err(LogError::changed(place_of(self.database.path()), more));
        }
        self.insert()?;
        self.database.close()
    }

    fn insert(&mut self) -> Result<(), LogError> {
        let (frames, ids, start) = (std::mem::take(&mut self.waiting), &self.ids, self.start);
        self.database.change(frames.len(), |connection| {
            let mut insert = connection.prepare_cached(INSERT)?;
            frames.iter().try_for_each(|Frame { at, sensor, picture }| {
                let Picture { packed, features } = picture;
                let Features {
                    area_px,
                    box_px: [left, top, right, bottom],
                    centroid_px: [x, y],
                    orientation_deg,
                    elongation,
                } = *features;
                let id = &ids[sensor.index()];
                insert
                    .execute(params![
                        (start + at.since_zero()).micros(),
                        id,
                        area_px,
                        left,
                        top,
                        right,
                        bottom,
                        x,
                        y,
                        orientation_deg,
                        elongation,
                        packed
                    ])
                    .map(|_| ())
            })
        })?;
        self.not_durable += frames.len();
        if self.not_durable >= DURABLE_ROWS {
            self.not_durable = 0;
            self.database.make_durable()?;
        }
        Ok(())
    }
}

fn tell_camera(connection: &Connection, id: &str, camera: &CameraFile) -> rusqlite::Result<()> {
    let CameraFile { name, at: [x, y], height_m, facing_deg, tilt_deg, field_deg, pixels: [columns, rows], .. } =
        camera;
    let frames_per_s = camera.frames_per_s;
    let values = params![id, name, columns, rows, frames_per_s, x, y, height_m, facing_deg, tilt_deg, field_deg];
    connection.execute("INSERT INTO camera VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)", values).map(|_| ())
}

/// The silhouettes that a run has left.
pub struct Silhouettes {
    path: PathBuf,
    connection: Connection,
    /// The cameras, in the order of their ids.
    pub cameras: Vec<SilhouetteCamera>,
    start: UtcTime,
}

/// A camera that has kept silhouettes.
#[derive(Clone, Debug, PartialEq)]
pub struct SilhouetteCamera {
    /// Its id in the log.
    pub id: String,
    /// Its form, as the home had it; what wakes it is not told.
    pub file: CameraFile,
}

/// One stored silhouette.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptSilhouettes {
    /// When it was taken.
    pub at: RunTime,
    /// Which of the cameras took it.
    pub camera: usize,
    /// The picture.
    pub silhouette: Silhouette,
    /// Its features.
    pub features: Features,
}

impl Silhouettes {
    /// Opens the file of a run that began at `start`.
    pub fn open(path: &Path, start: UtcTime) -> Result<Silhouettes, LogError> {
        std::fs::metadata(path).map_err(|error| LogError::reading(path, error))?;
        let wrong = |error| LogError::database(path, error);
        let connection = connect(path).map_err(wrong)?;
        let cameras = {
            let sql = "SELECT camera, name, columns, rows, frames_per_s, x_m, y_m, height_m, facing_deg, tilt_deg, field_deg \
                       FROM camera ORDER BY camera";
            let mut rows = connection.prepare(sql).map_err(wrong)?;
            let camera = |row: &rusqlite::Row| {
                let file = CameraFile {
                    name: row.get(1)?,
                    pixels: [row.get(2)?, row.get(3)?],
                    frames_per_s: row.get(4)?,
                    at: [row.get(5)?, row.get(6)?],
                    height_m: row.get(7)?,
                    facing_deg: row.get(8)?,
                    tilt_deg: row.get(9)?,
                    field_deg: row.get(10)?,
                    woken_by: Vec::new(),
                    sleeps_after_s: 0.0,
                    always: false,
                };
                Ok(SilhouetteCamera { id: row.get(0)?, file })
            };
            rows.query_map([], camera).and_then(Iterator::collect).map_err(wrong)?
        };
        Ok(Silhouettes { path: path.into(), connection, cameras, start })
    }

    /// Hands over all silhouettes in order of time, one at a time.
    pub fn for_each<E: From<LogError>>(&self, each: impl FnMut(KeptSilhouettes) -> Result<(), E>) -> Result<(), E> {
        self.for_each_within(Interval::ALL, each)
    }

    /// The same of a span; nothing else of the file is read, but for what finds its beginning.
    pub fn for_each_within<E: From<LogError>>(
        &self,
        span: Interval<RunTime>,
        mut each: impl FnMut(KeptSilhouettes) -> Result<(), E>,
    ) -> Result<(), E> {
        let wrong = |error| LogError::database(&self.path, error);
        let sql = "SELECT utc_us, camera, area_px, left_px, top_px, right_px, bottom_px, centroid_x_px, centroid_y_px, \
                   orientation_deg, elongation, packed FROM silhouette WHERE rowid >= ? ORDER BY rowid";
        let mut statement = self.connection.prepare_cached(sql).map_err(wrong)?;
        let mut rows = statement.query([self.row_from(span.begin)?]).map_err(wrong)?;
        let mut last = RunTime::MIN;
        while let Some(row) = rows.next().map_err(wrong)? {
            let kept = self.kept(row)?;
            if kept.at >= span.end {
                break;
            }
            if kept.at < last {
                return Err(self.no_picture("it was taken before the one before it").into());
            }
            last = kept.at;
            each(kept)?;
        }
        Ok(())
    }

    /// The instants of the first and the last silhouette; None if there are none.
    pub fn span(&self) -> Result<Option<Interval<RunTime>>, LogError> {
        let last = "SELECT rowid, utc_us FROM silhouette ORDER BY rowid DESC LIMIT 1";
        let Some((_, last)) = self.row(last, [])? else { return Ok(None) };
        Ok(self.next_from(RunTime::MIN)?.map(|first| Interval::new(first, last)))
    }

    /// The instant of the first silhouette that was not taken before an instant.
    pub fn next_from(&self, at: RunTime) -> Result<Option<RunTime>, LogError> {
        let row = self.row_from(at)?;
        Ok(self.row(FROM_ROW, [row])?.map(|(_, at)| at))
    }

    /// The instant of the last silhouette that was taken before an instant.
    pub fn last_before(&self, at: RunTime) -> Result<Option<RunTime>, LogError> {
        let sql = "SELECT rowid, utc_us FROM silhouette WHERE rowid < ? ORDER BY rowid DESC LIMIT 1";
        let row = self.row_from(at)?;
        Ok(self.row(sql, [row])?.map(|(_, at)| at))
    }

    /// The number of the first row at an instant or later. Rows are in order of time, so bisection finds it in some twenty steps; deleted
    /// rows do not matter.
    fn row_from(&self, at: RunTime) -> Result<i64, LogError> {
        if at == RunTime::MIN {
            return Ok(0);
        }
        let last = self.row("SELECT rowid, utc_us FROM silhouette ORDER BY rowid DESC LIMIT 1", [])?;
        let is_before = |middle| Ok(self.row(FROM_ROW, [middle])?.is_some_and(|(_, then)| then < at));
        first_row(last.map_or(0, |(row, _)| row), is_before)
    }

    /// A row's number and its instant.
    fn row<const N: usize>(&self, sql: &str, numbers: [i64; N]) -> Result<Option<(i64, RunTime)>, LogError> {
        let wrong = |error| LogError::database(&self.path, error);
        let mut statement = self.connection.prepare_cached(sql).map_err(wrong)?;
        let row = |row: &rusqlite::Row| Ok((row.get(0)?, self.of_run(row.get(1)?)));
        statement.query_row(rusqlite::params_from_iter(numbers), row).optional().map_err(wrong)
    }

    fn kept(&self, row: &rusqlite::Row) -> Result<KeptSilhouettes, LogError> {
        let wrong = |error| LogError::database(&self.path, error);
        let id: String = row.get(1).map_err(wrong)?;
        let camera = self.cameras.iter().position(|camera| camera.id == id);
        let camera = camera.ok_or_else(|| self.no_picture(&format!("no camera is called {id:?}")))?;
        let [columns, rows] = self.cameras[camera].file.pixels;
        let packed: Vec<u8> = row.get(11).map_err(wrong)?;
        let silhouette = Silhouette::unpacked(&packed, columns, rows)
            .ok_or_else(|| self.no_picture("its bytes are not a picture"))?;
        let features = || -> rusqlite::Result<Features> {
            Ok(Features {
                area_px: row.get(2)?,
                box_px: [row.get(3)?, row.get(4)?, row.get(5)?, row.get(6)?],
                centroid_px: [row.get(7)?, row.get(8)?],
                orientation_deg: row.get(9)?,
                elongation: row.get(10)?,
            })
        };
        let at = self.of_run(row.get(0).map_err(wrong)?);
        Ok(KeptSilhouettes { at, camera, silhouette, features: features().map_err(wrong)? })
    }

    fn of_run(&self, utc_us: i64) -> RunTime {
        RunTime::START + (UtcTime::from_micros(utc_us) - self.start)
    }

    fn no_picture(&self, reason: &str) -> LogError {
        LogError::changed(place_of(&self.path), ChangedMessage::Silhouette { reason: reason.into() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::SECOND;

    const START: UtcTime = UtcTime::from_micros(1_000_000_000_000_000);

    fn at(second: i64) -> RunTime {
        RunTime::START + second * SECOND
    }

    /// A file with a row each second, of two cameras in turns, in which some rows were deleted.
    fn file(path: &Path) {
        let connection = Connection::open(path).unwrap();
        connection.execute_batch(&format!("{CAMERA}; {SILHOUETTE}; BEGIN")).unwrap();
        for (id, name) in [("C1", "east"), ("C2", "west")] {
            let file = serde_json::from_value(serde_json::json!({ "name": name, "at": [1.0, 1.0], "facing_deg": 0.0 }));
            tell_camera(&connection, id, &file.unwrap()).unwrap();
        }
        let mut picture = Silhouette::new(160, 120);
        picture.set(3, 4, true);
        for second in 0..1000i64 {
            let id = ["C1", "C2"][second as usize % 2];
            let at = (START + second * SECOND).micros();
            connection.execute(INSERT, params![at, id, 1, 3, 4, 3, 4, 3.5, 4.5, 0.0, 1.0, picture.packed()]).unwrap();
        }
        connection.execute_batch("COMMIT; DELETE FROM silhouette WHERE rowid BETWEEN 301 AND 400").unwrap();
    }

    fn seconds_within(silhouettes: &Silhouettes, from: i64, to: i64) -> Vec<i64> {
        let mut found = Vec::new();
        let take = |kept: KeptSilhouettes| {
            let second = kept.at.since_zero() / SECOND;
            assert_eq!(kept.camera as i64, second % 2);
            found.push(second);
            Ok::<(), LogError>(())
        };
        silhouettes.for_each_within(Interval::new(at(from), at(to)), take).unwrap();
        found
    }

    #[test]
    fn finds_an_interval_without_an_index_despite_deleted_rows() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("silhouettes.db");
        file(&path);
        let silhouettes = Silhouettes::open(&path, START).unwrap();
        assert_eq!(silhouettes.span().unwrap(), Some(Interval::new(at(0), at(999))));
        for (from, to) in [(-5, 3), (0, 1), (7, 7), (290, 305), (299, 405), (350, 401), (998, 2000), (1000, 2000)] {
            let expected: Vec<i64> =
                (from.max(0)..to.min(1000)).filter(|second| !(300..400).contains(second)).collect();
            assert_eq!(seconds_within(&silhouettes, from, to), expected, "{from} to {to}");
        }
        assert_eq!(silhouettes.next_from(at(350)).unwrap(), Some(at(400)));
        assert_eq!(silhouettes.last_before(at(350)).unwrap(), Some(at(299)));
        assert_eq!(silhouettes.next_from(at(1000)).unwrap(), None);
        assert_eq!(silhouettes.last_before(at(0)).unwrap(), None);
    }

    #[test]
    fn reports_rows_out_of_order() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("silhouettes.db");
        file(&path);
        let change = format!("UPDATE silhouette SET utc_us = {START} WHERE rowid = 700");
        Connection::open(&path).unwrap().execute_batch(&change).unwrap();
        let silhouettes = Silhouettes::open(&path, START).unwrap();
        let read = silhouettes.for_each(|_| Ok::<(), LogError>(()));
        assert!(read.unwrap_err().to_string().contains("before the one before it"));
    }
}
