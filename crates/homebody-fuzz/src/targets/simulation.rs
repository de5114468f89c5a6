//! Simulation of checked scenarios: for an hour of run time, and once more into files.

use super::messages;
use crate::target::ReadVerdict;
use homebody_core::time::{HOUR, MINUTE, RunTime, Span};
use homebody_log::read;
use homebody_simulation::{
    Cancel, Destinations, OpenScenario, RecordedRun, RunProgress, ScenarioSource, SimulationError, Url,
};
use std::collections::BTreeMap;
use std::path::Path;
use std::time::{Duration, Instant};

/// Part of a run that is stored, read back, and simulated again from its recording (our choice).
const STORED: Span = MINUTE.times(10);

/// Time after which a run is stopped, as a user may stop it between two batches (our choice).
const LONGEST: Duration = Duration::from_millis(250);

/// Checks a scenario, and simulates it if it is valid.
pub fn check_and_simulate(texts: &BTreeMap<String, String>, folder: &Path) -> Result<ReadVerdict, String> {
    let source = ScenarioSource::from_texts(texts.clone(), "scenario.json");
    let opened = source.clone().open();
    // A scenario without a check of its routines has no more problems than with it.
    if let (Ok(_), Err(error)) = (&opened, source.scenario()) {
        return Err(format!("it passes the whole check, but not its first part: {error}"));
    }
    match opened {
        Ok(opened) => simulate(&opened, folder).map(|()| ReadVerdict::Accepted),
        Err(error) => messages::error(&error, texts).map(|()| ReadVerdict::Refused),
    }
}

/// Simulates a scenario that has passed the check.
pub fn simulate(opened: &OpenScenario, folder: &Path) -> Result<(), String> {
    let is_whole = batches(opened)?;
    if is_whole { store_and_replay(opened, folder) } else { Ok(()) }
}

fn disagreed(error: SimulationError) -> String {
    format!("the check lets it pass, and the run says: {error}")
}

/// Simulates an hour in batches; false if it was stopped.
fn batches(opened: &OpenScenario) -> Result<bool, String> {
    let begun = Instant::now();
    let mut run = opened.run().length(HOUR).start().map_err(disagreed)?;
    let (is_linked, sensors) = (opened.scenario().file.link.is_some(), run.sensors().count());
    let (mut next, mut last, mut settled, mut end) = (0, RunTime::MIN, RunTime::START, RunTime::START);
    while let Some(batch) = run.next_batch().map_err(disagreed)? {
        if batch.begin != end || batch.end < batch.begin {
            return Err(format!("a batch from {} to {} after one to {end}", batch.begin, batch.end));
        }
        for firing in batch.firings {
            if firing.seq != next || firing.sensor.index() >= sensors {
                return Err(format!("firing {next} is {firing:?}, of {sensors} sensors"));
            }
            if firing.at < settled || !is_linked && firing.at < last {
                return Err(format!("not in order of time: {firing:?} after {last}, settled {settled}"));
            }
            (next, last) = (next + 1, firing.at);
        }
        (settled, end) = (batch.settled, batch.end);
        if begun.elapsed() > LONGEST {
            return Ok(false);
        }
    }
    Ok(true)
}

/// Simulates the beginning into files, reads the log back, and replays the recording.
fn store_and_replay(opened: &OpenScenario, folder: &Path) -> Result<(), String> {
    let begun = Instant::now();
    let cancel = Cancel::new();
    let hurry = |_: RunProgress| {
        if begun.elapsed() > LONGEST {
            cancel.cancel();
        }
    };
    // The scenario's own destination is never used.
    let url = Url::new(homebody_core::scenario::scheme::Scheme::Csv, folder.join("log.csv"));
    let recording = folder.join("recording.json");
    let to = Destinations {
        log: vec![url.clone()],
        recording: Some(recording.clone()),
        runs: None,
        ..Destinations::default()
    };
    let run = opened.run().length(STORED).cancel(&cancel).start().map_err(disagreed)?;
    let stored = run.store(&to, hurry).map_err(disagreed)?;
    let rows = stored.stored.rows;
    match read(&url, &opened.scenario().logger) {
        Ok(log) if log.rows != rows || log.skipped > 0 => {
            return Err(format!("{rows} rows were stored, {} are read, {} are not understood", log.rows, log.skipped));
        }
        Ok(_) => {}
        // The columns of a log without rows are unknown.
        Err(error) if rows > 0 => return Err(format!("what was stored cannot be read: {error}")),
        Err(_) => {}
    }
    let again = RecordedRun::open(&recording).map_err(|error| format!("its own recording is refused: {error}"))?;
    let stored = again.start().store(&Destinations::own(), |_| ()).map_err(disagreed)?;
    match stored.agrees {
        Some(false) => Err("its recording replays to another log".into()),
        _ => Ok(()),
    }
}
