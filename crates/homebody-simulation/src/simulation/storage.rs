//! The files of a simulation: opened at its start, and completed at its end.

use super::Simulation;
use super::input::KeyInput;
use super::output::RunOutput;
use crate::VERSION;
use crate::error::{SimulationError, StepError};
use crate::progress::RunProgress;
use crate::run_summary::RunSummary;
use homebody_core::drivers::input::{Input, KeysFile};
use homebody_core::event::Events;
use homebody_core::ids::ResidentId;
use homebody_core::recording::Recording;
use homebody_core::run::Run;
use homebody_core::time::RunTime;
use homebody_log::destination::Treatment;
use homebody_log::run::places::{RECORDING, TRUTH};
use homebody_log::{Destination, LogError, RunLog, RunPlaces, Stored, WriteMode};
use std::path::{Path, PathBuf};
use std::time::Instant;

impl Simulation {
    /// Moves a resident by keys: `file` is the name of their file of keys, and `lines` the input that the scenario has already.
    pub fn moved_by_keys(mut self, resident: ResidentId, file: String, lines: Vec<KeysFile>) -> Simulation {
        self.run.open_input(resident);
        self.input = Some(KeyInput { resident, file, known: lines.len(), lines });
        self
    }

    /// The lines of input so far.
    pub fn input_lines(&self) -> &[KeysFile] {
        self.input.as_ref().map_or(&[], |input| &input.lines)
    }

    /// Applies a line of input now, and keeps it for the recording.
    pub fn apply_input(&mut self, line: KeysFile) {
        let Some(input) = &mut self.input else { return };
        self.run.input(input.resident, Input::written(&line, &self.run.home().plan));
        input.lines.push(line);
    }

    /// Writes the input, also while the run is paused.
    ///
    /// # Errors
    ///
    /// The recording cannot be written.
    pub fn keep_input(&mut self) -> Result<(), LogError> {
        match (&mut self.output, &self.input) {
            (Some(output), Some(input)) => output.store(&self.run, &Events::default(), Some(input)),
            _ => Ok(()),
        }
    }
}

impl Simulation {
    /// Opens the files of a run at its start: from now on each step is stored there.
    ///
    /// # Errors
    ///
    /// A file cannot be written.
    pub fn open_output(&mut self, places: RunPlaces, how: WriteMode) -> Result<(), LogError> {
        self.open_output_with(places, Vec::new(), &Treatment::default(), how)
    }

    fn open_output_with(
        &mut self,
        places: RunPlaces,
        own: Vec<Destination>,
        servers: &Treatment,
        how: WriteMode,
    ) -> Result<(), LogError> {
        let recording = Recording { version: VERSION.into(), ..self.recording.clone() };
        let cancel = self.paced.cancel().clone();
        let own = own.into_iter().map(|destination| Destination { cancel: cancel.clone(), ..destination });
        let own = own.inspect(|destination| self.metrics.hear(destination)).collect();
        let servers = &Treatment { cancel, ..servers.clone() };
        let log = RunLog::open_with(&places, own, servers, &self.scenario, &self.run, &recording, how)?;
        self.metrics.begin(self.scenario.calendar.timestamp(RunTime::START), log.meters());
        let input = match (&places.recording, &self.input) {
            (Some(place), Some(input)) => Some(input.recorder(place, recording.clone())?),
            _ => None,
        };
        self.output = Some(RunOutput::new(places, log, recording, input));
        Ok(())
    }

    /// The places of its files, once it has some.
    pub fn places(&self) -> Option<&RunPlaces> {
        self.output.as_ref().map(|output| &output.places)
    }

    /// True while its files are open and not complete.
    pub fn is_recording(&self) -> bool {
        self.output.as_ref().is_some_and(|output| output.log.is_some())
    }

    /// Completes the files; `None` without open ones.
    ///
    /// # Errors
    ///
    /// A file cannot be completed.
    pub fn finish(&mut self) -> Result<Option<Stored>, LogError> {
        self.complete(|log, _, recording, run| log.finish(run, recording))
    }

    /// Completes the files of a run that failed, as far as everything is stored; `None` without open ones. The run itself is no longer
    /// used.
    ///
    /// # Errors
    ///
    /// A file cannot be completed.
    pub fn give_up(&mut self) -> Result<Option<Stored>, LogError> {
        self.furthest = None;
        self.events.clear();
        self.complete(|log, now, recording, _| log.give_up(now, recording))
    }

    fn complete(
        &mut self,
        end: impl FnOnce(RunLog, RunTime, Recording, &Run) -> Result<(Stored, Recording), LogError>,
    ) -> Result<Option<Stored>, LogError> {
        let Some(output) = &mut self.output else { return Ok(None) };
        let Some(log) = output.close()? else { return Ok(None) };
        let mut recording = output.recording.clone();
        if let Some(input) = &self.input {
            recording.files.insert(input.file.clone(), input.text());
        }
        let furthest = self.furthest.as_ref().unwrap_or(&self.run);
        let (stored, recording) = end(log, output.stored_to, recording, furthest)?;
        self.recording = recording;
        Ok(Some(stored))
    }

    /// The folder in which the run can be resumed, where there is one.
    pub(crate) fn folder_in(&self, places: &RunPlaces) -> Option<PathBuf> {
        folder_of_all(places).filter(|_| self.recording.can_replay())
    }

    /// Simulates the run to its end, or until it is cancelled, into these places and the caller's own destinations.
    pub(crate) fn store_into(
        self,
        places: RunPlaces,
        own: Vec<Destination>,
        servers: &Treatment,
        how: WriteMode,
        progress: impl FnMut(RunProgress),
    ) -> Result<RunSummary, SimulationError> {
        let folder = self.folder_in(&places);
        self.stored(places, own, servers, how, progress).map_err(|error| error.resumable_in(folder))
    }

    fn stored(
        mut self,
        places: RunPlaces,
        own: Vec<Destination>,
        servers: &Treatment,
        how: WriteMode,
        mut progress: impl FnMut(RunProgress),
    ) -> Result<RunSummary, SimulationError> {
        let started = Instant::now();
        let (truth, recorded, folder) = (places.truth.clone(), places.recording.clone(), self.folder_in(&places));
        let before = Some(self.recording.clone()).filter(|before| !before.sha256.is_empty());
        self.open_output_with(places, own, servers, how)?;
        let ended = loop {
            self.take_orders()?;
            match self.next_step() {
                Ok(true) => {
                    self.metrics.simulated(self.run.now());
                    progress(self.progress());
                }
                Ok(false) => break Ok(()),
                Err(StepError::Driver(error)) => break Err(error),
                Err(StepError::Log(error)) => return Err(error.into()),
            }
        };
        let stored = self.finish()?.unwrap_or_default();
        ended?;
        let is_same =
            |before: &Recording| (&before.sha256, before.firings) == (&self.recording.sha256, self.recording.firings);
        let is_whole = self.run.now().since_zero() == self.run.length();
        Ok(RunSummary {
            agrees: before.as_ref().filter(|_| is_whole).map(is_same),
            before,
            differences: self.differences(),
            sensors: self.sensors().map(str::to_owned).collect(),
            truth,
            recorded,
            folder,
            progress: self.progress(),
            stored,
            took: started.elapsed(),
            recording: self.recording,
        })
    }
}

/// The folder that all of a run goes into, where there is one.
fn folder_of_all(places: &RunPlaces) -> Option<PathBuf> {
    let folder = places.sensors.as_deref()?.parent()?;
    let is_here = |path: &Path, name: &str| path == folder.join(name);
    let is_whole = places.recording.as_deref().is_some_and(|path| is_here(path, RECORDING))
        && places.truth.as_ref().is_some_and(|truth| match truth.file() {
            Some(path) => is_here(path, TRUTH),
            None => truth.server().is_some(),
        });
    is_whole.then(|| folder.to_owned())
}
