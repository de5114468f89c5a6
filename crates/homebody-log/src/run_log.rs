//! All that a run leaves: its log, the truth apart from it, and the recording that lives it again.

use crate::error::LogError;
use crate::fresh::FreshFile;
use crate::logger::{Logger, RunInfo, Stored};
use crate::places::Places;
use crate::truth::{Names, TruthLog};
use homebody_core::event::Events;
use homebody_core::recording::{Recording, RunDigest};
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;

/// The open files of a run that is being lived.
pub struct RunLog {
    logger: Logger,
    truth: Option<TruthLog>,
    record: Option<FreshFile>,
    digest: RunDigest,
}

impl RunLog {
    /// Opens the files of a run that has not been advanced. Its seed and the program's version are those of the recording;
    /// files that exist are only replaced if `force` is given.
    pub fn open(
        places: &Places,
        scenario: &Scenario,
        run: &Run,
        recording: &Recording,
        force: bool,
    ) -> Result<RunLog, LogError> {
        let record = places.recording.as_ref().map(|path| FreshFile::create(path, force)).transpose()?;
        let sensors: Vec<String> = run.sensors().iter().map(|sensor| sensor.name.clone()).collect();
        let rooms: Vec<String> = run.home().plan.rooms.iter().map(|room| room.name.clone()).collect();
        let things: Vec<String> = run.home().plan.things.iter().map(|thing| thing.name.clone()).collect();
        let residents = run.names();
        let Scenario { file, logger: mapping, calendar, .. } = scenario;
        let Recording { seed, version, .. } = recording;
        let info = RunInfo { id: 1, scenario: file.name.clone(), seed: *seed, version: version.clone() };
        let logger = Logger::open(&places.log, mapping, &sensors, calendar, &info, force)?;
        let names = Names { residents: &residents, rooms: &rooms, things: &things, sensors: &sensors };
        let truth = places.truth.as_ref();
        let truth = truth.map(|path| TruthLog::open(path, &places.log, mapping, names, calendar, &info, force));
        Ok(RunLog { logger, truth: truth.transpose()?, record, digest: RunDigest::default() })
    }

    /// Hands on what has happened in the run since the last time.
    pub fn store(&mut self, run: &Run, events: &Events) -> Result<(), LogError> {
        self.digest.add(&events.firings);
        self.logger.store(&events.firings, run.settled())?;
        match &mut self.truth {
            Some(truth) => truth.store(events),
            None => Ok(()),
        }
    }

    /// Completes all files, and returns what was stored and the recording of what was lived: its length is where the run has
    /// come to, and its other fields are those of `recording`.
    pub fn finish(self, run: &Run, recording: Recording) -> Result<(Stored, Recording), LogError> {
        let stored = self.logger.finish()?;
        if let Some(truth) = self.truth {
            truth.finish(run.now())?;
        }
        let (firings, sha256) = (self.digest.firings(), self.digest.hex());
        let recording = Recording { length_us: run.now(), firings, sha256, ..recording };
        if let Some(mut file) = self.record {
            file.write(serde_json::to_string_pretty(&recording)?.as_bytes())?;
            file.write(b"\n")?;
            file.finish()?;
        }
        Ok((stored, recording))
    }
}
