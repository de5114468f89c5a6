//! The ground truth next to a log, if both are of the same run.

use crate::error::QueryError;
use crate::log_ref::LogRef;
use crate::long_log::MOST_COMPARED;
use homebody_analysis::dates::on_wall;
use homebody_core::time::WallTime;
use homebody_log::truth::is_truth_of;
use homebody_log::{Event, Log, Url, truth_of};

impl LogRef {
    /// Reads the log, with the ground truth next to it.
    pub(crate) fn read_with_truth(&self) -> Result<(Log, Option<Url>), QueryError> {
        let mut log = self.read()?;
        let first = log.events.iter().take(MOST_COMPARED).copied().collect();
        let truth = self.truth_of_run(&mut log, first)?;
        Ok((log, truth))
    }

    /// The ground truth next to the log, if it is of the same run: `first` are the first rows. Otherwise a remark of the log says so.
    pub(crate) fn truth_of_run(&self, log: &mut Log, first: Vec<Event>) -> Result<Option<Url>, QueryError> {
        let Some(truth) = self.truth() else { return Ok(None) };
        let zone = self.zone();
        let also = |at: WallTime| zone.as_ref().map_or(at, |zone| on_wall(at, zone));
        let rows: Vec<(&str, WallTime)> = first.iter().map(|event| (log.sensor(event), event.at)).collect();
        if is_truth_of(&truth, &rows, &also)? {
            return Ok(Some(truth));
        }
        log.remarks.push(format!(
            "Homebody ignores {truth}: it is the ground truth of another run. Move the log to a folder of its own."
        ));
        Ok(None)
    }

    pub fn truth(&self) -> Option<Url> {
        truth_of(&self.place)
    }
}
