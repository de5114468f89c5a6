//! The summary of a run that was stored.

use crate::progress::RunProgress;
use homebody_core::recording::Recording;
use homebody_log::{Stored, Url};
use homebody_routine::behaviour::difference::Difference;
use std::path::PathBuf;
use std::time::Duration;

/// The result of a run that was stored.
#[derive(Debug)]
pub struct RunSummary {
    /// The sentences of routines that did not come true.
    pub differences: Vec<Difference>,
    /// The recording, whose length is where the run ended.
    pub recording: Recording,
    /// The rows of the log.
    pub stored: Stored,
    /// The names of the sensors, in the order of `stored.by_sensor`.
    pub sensors: Vec<String>,
    /// The place of the ground truth, if there is one.
    pub truth: Option<Url>,
    /// The file of the recording, if there is one.
    pub recorded: Option<PathBuf>,
    /// The folder that resumes a stopped run ([`IncompleteRun`](crate::IncompleteRun)); `None` if its files are not in one folder.
    pub folder: Option<PathBuf>,
    /// The simulated part: less than the length if the run was cancelled.
    pub progress: RunProgress,
    /// Of a complete replay: whether every firing is the same.
    pub agrees: Option<bool>,
    /// Of a replay: its recording.
    pub before: Option<Recording>,
    /// The time that the simulation took.
    pub took: Duration,
}

impl RunSummary {
    /// Whether it ended early.
    pub fn is_stopped(&self) -> bool {
        self.progress.done < self.progress.length
    }

    /// The number of rows of each sensor in each of the places, by name.
    pub fn rows_by_sensor(&self) -> impl Iterator<Item = (&str, u64)> {
        self.sensors.iter().map(String::as_str).zip(self.stored.by_sensor.iter().copied())
    }
}
