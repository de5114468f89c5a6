//! The files of a run while it is simulated.

use super::input::{InputRecorder, KeyInput};
use homebody_core::event::Events;
use homebody_core::recording::Recording;
use homebody_core::run::Run;
use homebody_core::time::RunTime;
use homebody_log::{LogError, RunLog, RunPlaces};
use std::collections::VecDeque;

pub(super) struct RunOutput {
    pub places: RunPlaces,
    /// Until the files are complete.
    pub log: Option<RunLog>,
    pub recording: Recording,
    /// Until then, if a resident is moved by hand.
    input: Option<InputRecorder>,
    /// The events that wait until the recording has the input that caused them.
    waiting: VecDeque<WaitingEvents>,
    /// The instant up to which everything is stored.
    pub stored_to: RunTime,
}

struct WaitingEvents {
    /// The number of lines of input before their end.
    lines: usize,
    now: RunTime,
    settled: RunTime,
    events: Events,
}

impl RunOutput {
    pub fn new(places: RunPlaces, log: RunLog, recording: Recording, input: Option<InputRecorder>) -> RunOutput {
        RunOutput { places, log: Some(log), recording, input, waiting: VecDeque::new(), stored_to: RunTime::START }
    }

    /// Takes the events of a step, and stores those whose input is in the recording.
    pub fn store(&mut self, run: &Run, events: &Events, input: Option<&KeyInput>) -> Result<(), LogError> {
        let Some(log) = &mut self.log else { return Ok(()) };
        let (Some(recorder), Some(input)) = (&mut self.input, input) else {
            log.store(run, events)?;
            self.stored_to = run.now();
            return Ok(());
        };
        if !events.is_empty() || run.now() > self.waiting.back().map_or(self.stored_to, |last| last.now) {
            let (now, settled) = (run.now(), run.settled());
            self.waiting.push_back(WaitingEvents { lines: input.lines.len(), now, settled, events: events.clone() });
        }
        let kept = recorder.keep(&input.lines)?;
        while let Some(first) = self.waiting.front().filter(|first| first.lines <= kept) {
            log.store_settled(first.settled, &first.events)?;
            self.stored_to = first.now;
            self.waiting.pop_front();
        }
        Ok(())
    }

    /// Stores all waiting events: the recording is completed next. Returns the log.
    pub fn close(&mut self) -> Result<Option<RunLog>, LogError> {
        self.input = None;
        let Some(mut log) = self.log.take() else { return Ok(None) };
        for WaitingEvents { now, settled, events, .. } in self.waiting.drain(..) {
            log.store_settled(settled, &events)?;
            self.stored_to = now;
        }
        Ok(Some(log))
    }
}
