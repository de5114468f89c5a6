//! All files of a run: its log, its truth in a separate file, the table of its sensors, and the recording that replays it.

pub(crate) mod logger;
pub(crate) mod truth_log;

use crate::destination::{Destination, Treatment};
use crate::error::{LogError, Reason};
use crate::files::{FileLock, FolderLock, FreshFile, WriteMode, plain, remove_parts};
use crate::limits::LARGEST_RECORDING_BYTES;
use crate::policy::SinkMetrics;
use crate::run::{RunInfo, RunPlaces, SILHOUETTES, SensorTable, sensor_table};
use crate::silhouettes::{SilhouetteLog, cameras};
use crate::sink::database::remove_database;
use crate::sink::sqlite::can_be_replaced;
use crate::url::Url;
use homebody_core::event::{Events, Fact};
use homebody_core::recording::{Recording, RunDigest};
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::scheme::Scheme;
use homebody_core::time::{RunTime, Span};
pub use logger::destinations;
use logger::{Logger, RowsOfFirings, Stored};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};
use truth_log::TruthLog;

/// Rows of log and truth after which both are made durable (our choice). This costs a database three waits for the
/// disk, so it is not done more often.
const DURABLE_ROWS: u64 = 200_000;

/// Longest time until rows are durable, as long as the run reports the time (our choice).
const DURABLE_AFTER: Duration = Duration::from_secs(1);

/// The open places of a run.
pub struct RunLog {
    /// Until it is completed.
    logger: Option<Logger>,
    truth: Option<TruthLog>,
    /// Of a home with cameras, in the folder of its run.
    silhouettes: Option<SilhouetteLog>,
    record: Option<PathBuf>,
    /// Files to remove if the run fails and leaves no log to resume from.
    given_up: Option<GivenUp>,
    digest: RunDigest,
    /// The truth of a stopped run, which is written anew next to the old one.
    anew: Option<Anew>,
    /// The tables of sensors of logs outside a run's folder, and the run.
    names: (Vec<PathBuf>, Arc<RunInfo>),
    how: WriteMode,
    /// Why the truth was left behind, if its place was away when the run was stopped.
    away: Option<LogError>,
    /// The number of rows of log and truth at the last request to make them durable, and its time.
    settled: (u64, Instant),
    /// Of a run's folder, or of a recording elsewhere, from the beginning to the end.
    _lock: (Option<FolderLock>, Option<FileLock>),
}

/// Files that take the places of others when all are complete: each, and the one that it replaces.
struct Anew {
    files: Vec<(PathBuf, PathBuf)>,
}

impl Anew {
    fn take_their_places(&self) -> Result<(), LogError> {
        self.files.iter().try_for_each(|(beside, place)| {
            std::fs::rename(beside, place).map_err(|error| LogError::file(place, error))
        })
    }

    fn remove(&self) {
        self.files.iter().for_each(|(beside, _)| {
            remove_database(beside);
            // Of a text, what is not whole has another name.
            let _ = remove_parts(beside);
        });
    }
}

impl RunLog {
    /// Opens the places of a run before its first step. Its seed and the program's version are those of the recording, which is written
    /// now.
    ///
    /// A resumed run is simulated from its beginning: existing rows are compared, and missing ones are written. The truth of a stopped run
    /// has ends of activities at the stop, so it is written anew, and replaces the old one at the end.
    pub fn open(
        places: &RunPlaces,
        scenario: &Scenario,
        run: &Run,
        recording: &Recording,
        how: WriteMode,
    ) -> Result<RunLog, LogError> {
        RunLog::open_with(places, Vec::new(), &Treatment::default(), scenario, run, recording, how)
    }

    /// The same, with destinations of a caller's own, too, and a treatment of the servers among the places.
    pub fn open_with(
        places: &RunPlaces,
        own: Vec<Destination>,
        as_said: &Treatment,
        scenario: &Scenario,
        run: &Run,
        recording: &Recording,
        how: WriteMode,
    ) -> Result<RunLog, LogError> {
        let info = Arc::new(RunInfo::of(scenario, run, recording));
        let folder = places.sensors.as_deref().and_then(Path::parent);
        let lock = (
            folder.map(FolderLock::take).transpose()?,
            places.recording.as_deref().filter(|_| folder.is_none()).map(FileLock::take).transpose()?,
        );
        let logs = places.log.iter().filter_map(Url::file).map(Path::to_owned);
        for file in logs.chain(places.truth.iter().flat_map(|truth| truth.files(&places.kept.tables()))) {
            // Its sink takes it for as long as it writes. Asked here, nothing is touched if one of them is another's.
            FileLock::take(&file)?;
        }
        if how == WriteMode::Resume {
            for path in places.recording.iter().chain(&places.sensors) {
                // A program that died while it wrote one of them has left a part.
                remove_parts(path)?;
            }
        }
        let truth_on_server = places.truth.as_ref().is_some_and(|truth| truth.server().is_some());
        let truth_how = if truth_on_server && how != WriteMode::Resume { places.truth_on_server } else { how };
        let (mut truth_url, mut truth_how, mut anew) = (places.truth.clone(), truth_how, None);
        let stopped = places.truth.as_ref().filter(|_| how == WriteMode::Resume && was_stopped(places));
        if let Some((url, place)) = stopped.and_then(|url| Some((url, url.file()?))) {
            if url.scheme() == Scheme::Sqlite {
                can_be_replaced(place, &info)?;
            }
            let beside = url.at(beside(place));
            let kept = places.kept.tables();
            let files = beside.files(&kept).into_iter().zip(url.files(&kept)).collect();
            let begun = Anew { files };
            // A program that died on its way has left some.
            begun.remove();
            (truth_url, truth_how, anew) = (Some(beside), WriteMode::Create, Some(begun));
        }
        for path in places.tables_of_sensors() {
            SensorTable::new(path, &info)?.may_be_written(how != WriteMode::Create)?;
        }
        if let (Some(path), false) = (&places.recording, how == WriteMode::Resume) {
            // This comes first, so that the run can be resumed after any failure.
            write_recording(path, recording, how)?;
        }
        let mut all = destinations(&places.log, how)?;
        if places.is_followed {
            all = places.log.iter().map(Destination::followed).collect();
        }
        let is_server = places.log.iter().map(|url| url.server().is_some());
        let all = all.into_iter().zip(is_server);
        let treated = |(of, is_server): (Destination, bool)| if is_server { of.treated(as_said) } else { of };
        let mut all: Vec<Destination> = all.map(treated).collect();
        all.extend(own);
        let opened = Logger::open(all, &scenario.logger, &info, how).and_then(|logger| {
            let truth = truth_url.as_ref();
            let logs: Vec<&Path> = places.log.iter().filter_map(Url::file).collect();
            let treated = (&logs[..], as_said);
            let open = |url| TruthLog::open_keeping(places.kept, url, treated, &scenario.logger, &info, truth_how);
            let truth = truth.map(open).transpose()?;
            let mut silhouettes = None;
            if let Some(path) = &places.sensors {
                sensor_table::write(path, &info, true)?;
                if cameras(&scenario.home).next().is_some() {
                    let path = path.with_file_name(SILHOUETTES);
                    silhouettes = Some(SilhouetteLog::open(&path, &scenario.home, &info, how)?);
                }
            }
            Ok((logger, truth, silhouettes))
        });
        match opened {
            Ok((logger, truth, silhouettes)) => {
                let record = places.recording.clone();
                let beside = record.iter().chain(&places.sensors).cloned().collect();
                let is_folder = places.sensors.is_some();
                let in_folder = |url: &&Url| is_folder && (url.file().is_some() || url.is_data_set());
                let logs = places.log.iter().filter(in_folder).map(|url| url.path().to_owned()).collect();
                let given_up = (how == WriteMode::Create || !is_folder).then_some(GivenUp { beside, logs });
                let (logger, digest) = (Some(logger), RunDigest::default());
                Ok(RunLog {
                    logger,
                    truth,
                    silhouettes,
                    record,
                    given_up,
                    digest,
                    anew,
                    names: (places.tables_of_sensors(), info),
                    how,
                    away: None,
                    settled: (0, Instant::now()),
                    _lock: lock,
                })
            }
            Err(error) => {
                if let (Some(path), WriteMode::Create) = (&places.recording, how) {
                    // The run has not begun, so it cannot be resumed.
                    let _ = std::fs::remove_file(path);
                }
                Err(error)
            }
        }
    }

    /// The places that are written, each with what counts what it takes.
    pub fn meters(&self) -> Vec<(String, Arc<SinkMetrics>)> {
        let logs = self.logger.iter().flat_map(Logger::meters);
        logs.chain(self.truth.iter().map(TruthLog::meter)).collect()
    }

    /// Whether a resumed run is past all rows that its places had: from then on it may differ.
    pub fn is_past_replayed_part(&self) -> bool {
        self.logger.as_ref().is_none_or(Logger::is_past_replayed_part)
            && self.truth.as_ref().is_none_or(TruthLog::is_past_replayed_part)
    }

    /// Writes the recording anew after an intervention, before any of its consequences is stored.
    pub fn note(&self, recording: &Recording) -> Result<(), LogError> {
        let Some(path) = self.record.as_deref() else { return Ok(()) };
        match left_by(path).filter(Recording::is_complete) {
            // Until the run ends, its truth is that of a stopped run, and the next resume has to know.
            Some(stopped) => write_over(path, &Recording { outside: recording.outside.clone(), ..stopped }),
            None => write_over(path, recording),
        }
    }

    /// Hands on what has happened in the run since the last time.
    pub fn store(&mut self, run: &Run, events: &Events) -> Result<(), LogError> {
        self.store_settled(run.settled(), events)
    }

    /// The same some time later, after all firings up to `settled` were reported.
    pub fn store_settled(&mut self, settled: RunTime, events: &Events) -> Result<(), LogError> {
        self.digest.add(&events.firings);
        if let Some(silhouettes) = &mut self.silhouettes {
            silhouettes.store(&events.frames)?;
        }
        let Some(logger) = &mut self.logger else { return Ok(()) };
        let joined = logger.store(&events.firings, settled)?;
        if let Some(truth) = &mut self.truth {
            let stored = truth.store(events, joined);
            self.unless_away(stored)?;
        }
        self.make_durable_if_due()
    }

    /// Has the log and the truth make sure of their rows together, now and then. Neither does so again before the other has:
    /// wherever the program dies, one of them has at most that much more than the other.
    fn make_durable_if_due(&mut self) -> Result<(), LogError> {
        let Some(logger) = &mut self.logger else { return Ok(()) };
        let rows = logger.rows() + self.truth.as_ref().map_or(0, TruthLog::rows);
        let (rows_before, at) = self.settled;
        let due = rows - rows_before >= DURABLE_ROWS || rows > rows_before && at.elapsed() >= DURABLE_AFTER;
        if !due {
            return Ok(());
        }
        logger.wait_durable()?;
        if let Some(truth) = &mut self.truth {
            let settled = truth.wait_durable().and_then(|()| truth.make_durable());
            self.unless_away(settled)?;
        }
        if let Some(silhouettes) = &mut self.silhouettes {
            silhouettes.make_durable()?;
        }
        self.logger.as_mut().map_or(Ok(()), Logger::make_durable)?;
        self.settled = (rows, Instant::now());
        Ok(())
    }

    /// A truth that was away when the run was stopped is left behind: all else is to hold the run up to there.
    fn unless_away(&mut self, done: Result<(), LogError>) -> Result<(), LogError> {
        match done {
            Err(error @ LogError::StoppedAway { .. }) => {
                (self.truth, self.away) = (None, Some(error));
                // From here on the rows of the log alone are counted.
                self.settled.0 = self.logger.as_ref().map_or(0, Logger::rows);
                Ok(())
            }
            done => done,
        }
    }

    /// Completes all places, and returns a summary and the recording: its length is the present instant of the run, and its other fields
    /// are those of `recording`. A destination that was away when the run was stopped is an error once all others are complete, and the
    /// run can be resumed.
    pub fn finish(self, run: &Run, recording: Recording) -> Result<(Stored, Recording), LogError> {
        self.complete(run.now(), run.length(), run.under_way().collect(), recording)
    }

    /// The same for a run that broke and cannot be asked any more: `now` is where it had come to when it was stored last. Its
    /// length is that of `recording`.
    pub fn give_up(self, now: RunTime, recording: Recording) -> Result<(Stored, Recording), LogError> {
        self.complete(now, recording.length_us, Vec::new(), recording)
    }

    fn complete(
        mut self,
        now: RunTime,
        length: Span,
        under_way: Vec<Fact>,
        recording: Recording,
    ) -> Result<(Stored, Recording), LogError> {
        // A stop before the earlier one has changed nothing.
        let lived = now.since_zero();
        let is_early = self.how == WriteMode::Resume && lived < length;
        let early = |error| match error {
            LogError::Changed(Reason { place, .. }) if is_early => LogError::NotYet { place },
            error => error,
        };
        let mut stored = self.logger.take().map(Logger::finish).transpose().map_err(early)?.unwrap_or_default();
        if let Some(mut truth) = self.truth.take() {
            let under_way = Events { facts: under_way, ..Events::default() };
            let told = truth.store(&under_way, &RowsOfFirings::default()).and_then(|()| truth.finish(now));
            self.unless_away(told.map_err(early))?;
        }
        if let Some(silhouettes) = self.silhouettes.take() {
            silhouettes.finish().map_err(early)?;
        }
        if let Some(anew) = self.anew.take() {
            anew.take_their_places()?;
        }
        let (tables, info) = &self.names;
        tables.iter().try_for_each(|path| sensor_table::write(path, info, self.how != WriteMode::Create))?;
        let (firings, sha256) = (self.digest.firings(), self.digest.hex());
        let stopped_of_us = (lived < length).then_some(length);
        let (length_us, rows) = (lived, Some(stored.rows));
        let recording = Recording { length_us, stopped_of_us, rows, firings, sha256, ..recording };
        // If some place lacks rows of a finished run, its recording stays incomplete: a complete run is not resumed.
        let is_told = stored.away.is_none() && self.away.is_none() || lived < length;
        if let (Some(path), true) = (&self.record, is_told) {
            write_recording(path, &recording, WriteMode::Overwrite)?;
        }
        self.given_up = None;
        match stored.away.take().or(self.away.take()) {
            Some(away) => Err(away),
            None => Ok((stored, recording)),
        }
    }
}

/// The files that are of no use without a log.
struct GivenUp {
    beside: Vec<PathBuf>,
    logs: Vec<PathBuf>,
}

impl Drop for RunLog {
    fn drop(&mut self) {
        // They decide first what stays of the logs.
        (self.logger, self.truth, self.silhouettes) = (None, None, None);
        if let Some(anew) = self.anew.take() {
            anew.remove();
        }
        let Some(GivenUp { beside, logs }) = self.given_up.take() else { return };
        // A folder of a data set that is not empty has days of it.
        if !logs.iter().any(|log| log.is_file() || log.read_dir().is_ok_and(|mut inner| inner.next().is_some())) {
            beside.iter().for_each(|path| {
                let _ = std::fs::remove_file(path);
            });
        }
    }
}

/// The place of a truth that will replace another. Its extension stays, since it decides on packing and on files of tables.
fn beside(place: &Path) -> PathBuf {
    let mut name = std::ffi::OsString::from("anew.");
    name.push(place.file_name().unwrap_or_default());
    place.with_file_name(name)
}

/// Whether the run that left these places was stopped, and not killed.
fn was_stopped(places: &RunPlaces) -> bool {
    places.recording.as_deref().and_then(left_by).is_some_and(|recording| recording.is_complete())
}

fn left_by(path: &Path) -> Option<Recording> {
    serde_json::from_str(&plain::read_text(path, LARGEST_RECORDING_BYTES).ok()?).ok()
}

/// Writes the recording of a run that continues over the earlier one, in one piece.
pub fn write_over(path: &Path, recording: &Recording) -> Result<(), LogError> {
    write_recording(path, recording, WriteMode::Overwrite)
}

fn write_recording(path: &Path, recording: &Recording, how: WriteMode) -> Result<(), LogError> {
    let text = serde_json::to_string_pretty(recording)? + "\n";
    FreshFile::write_whole(path, text.as_bytes(), how != WriteMode::Create)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::log::Log;
    use crate::policy::Policy;
    use crate::sink::{Begin, Sink, Watermark};
    use crate::table::Batch;
    use homebody_core::calendar::Calendar;
    use homebody_core::event::{Firing, Value};
    use homebody_core::ids::SensorId;
    use homebody_core::scenario::logger::LoggerFile;
    use std::sync::Mutex;
    use std::thread;

    /// The number of times that log and truth have made rows durable, and the longest interval between them.
    #[derive(Default)]
    struct Counts {
        settled: [u64; 2],
        apart: u64,
    }

    struct Counting {
        which: usize,
        takes: Duration,
        counts: Arc<Mutex<Counts>>,
    }

    impl Sink for Counting {
        fn begin(&mut self, _: &Begin) -> Result<Watermark, LogError> {
            Ok(Watermark::none())
        }

        fn write(&mut self, _: &Batch) -> Result<(), LogError> {
            Ok(())
        }

        fn make_durable(&mut self) -> Result<Watermark, LogError> {
            thread::sleep(self.takes);
            let mut counts = self.counts.lock().unwrap();
            counts.settled[self.which] += 1;
            counts.apart = counts.apart.max(counts.settled[0].abs_diff(counts.settled[1]));
            Ok(Watermark::none())
        }

        fn finish(&mut self, _: RunTime) -> Result<(), LogError> {
            Ok(())
        }
    }

    fn run() -> Arc<RunInfo> {
        let calendar = Calendar::new("2009-03-02T00:00:00", "UTC").unwrap();
        Arc::new(RunInfo::of_log("flat", calendar, &Log { sensors: vec!["motion".into()], ..Log::default() }))
    }

    #[test]
    fn log_and_truth_become_durable_together() {
        let counts = Arc::<Mutex<Counts>>::default();
        let own = |which, takes| {
            let sink = Counting { which, takes: Duration::from_millis(takes), counts: counts.clone() };
            Destination::own("counting", sink, Policy::default())
        };
        let (file, run) = (LoggerFile::default(), run());
        let mut log = RunLog {
            logger: Some(Logger::open(vec![own(0, 10)], &file, &run, WriteMode::Create).unwrap()),
            truth: Some(TruthLog::into(own(1, 0), &file, &run, WriteMode::Create).unwrap()),
            silhouettes: None,
            record: None,
            given_up: None,
            digest: RunDigest::default(),
            anew: None,
            names: (Vec::new(), run.clone()),
            how: WriteMode::Create,
            away: None,
            settled: (0, Instant::now()),
            _lock: (None, None),
        };
        for seq in 0..30 {
            // Long ago, so that it is due each time.
            log.settled.1 = Instant::now() - DURABLE_AFTER;
            let at = RunTime::from_micros(seq as i64);
            let firing = Firing { seq, at, sensor: SensorId::new(0), value: Value::Fire };
            log.store_settled(at + Span::MICROSECOND, &Events { firings: vec![firing], ..Events::default() }).unwrap();
        }
        drop(log);
        let counts = counts.lock().unwrap();
        assert!(counts.settled[0] >= 30 && counts.apart <= 1, "{:?}, {} apart", counts.settled, counts.apart);
    }
}
