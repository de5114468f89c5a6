//! The first days of a run, simulated for a short time to see which sentences have room in them.

use crate::error::SimulationError;
use crate::open_scenario::one_line;
use crate::scenario_warnings::ScenarioWarning;
use crate::setup::PlannedRun;
use homebody_core::problem::{Problem, counted};
use homebody_core::time::{DAY, Span};
use homebody_log::Cancel;
use homebody_routine::behaviour::difference::Difference;
use std::time::{Duration, Instant};

/// Longest time of a sample before a command (our choice), as users expect an answer by then.
pub const SAMPLE_TIME: Duration = Duration::from_secs(2);

/// Fewest days that are judged (our choice): the first day begins at night, and the last one is not over.
const LEAST_DAYS: f64 = 3.0;

/// The first days of a run.
#[derive(Clone, Debug)]
pub struct SampledRun {
    /// The simulated days.
    pub days: f64,
    /// The days of the run.
    pub of_days: f64,
    /// The sentences without room in these days, the largest loss first.
    pub differences: Vec<Difference>,
}

impl SampledRun {
    /// Whether it is the whole run.
    pub fn is_whole(&self) -> bool {
        self.days >= self.of_days
    }

    /// Warnings of its differences.
    pub fn warnings(&self) -> Vec<Problem> {
        difference_warnings(&self.differences, self.days, self.of_days)
    }
}

/// Warnings of sentences that do not happen as they say, after `days` simulated days of a run of `of_days`. Those that are certain
/// before the run are among the warnings about the scenario.
pub fn difference_warnings(differences: &[Difference], days: f64, of_days: f64) -> Vec<Problem> {
    let (whole, of) = (counted(days.round() as usize, "day", "days"), of_days.round());
    let days = if days < of_days { format!("the first {whole} of {of}") } else { whole };
    let warning = |Difference { file, line, text, expected, lived, .. }: &Difference| {
        let (sentence, days) = (one_line(text), days.clone());
        let message =
            ScenarioWarning::NotAsSaid { sentence, expected: expected.clone(), simulated: lived.clone(), days };
        Problem { line: *line, column: 1, ..Problem::of_file(file, message, None) }
    };
    differences.iter().filter(|one| !one.told).map(warning).collect()
}

/// The first warnings, and the number of the others.
pub fn shortened(mut warnings: Vec<Problem>, most: usize) -> Vec<Problem> {
    let count = warnings.len().saturating_sub(most);
    warnings.truncate(most);
    warnings.extend((count > 0).then(|| Problem::from(ScenarioWarning::MoreNotAsSaid { count })));
    warnings
}

impl PlannedRun {
    /// Simulates the run for a limited time. A run that ends within it is judged as a whole. `None` if it was cancelled.
    ///
    /// # Errors
    ///
    /// [`SimulationError::Driver`] if the run stops because of an impossible decision of a driver.
    pub fn sample(self, within: Duration, cancel: &Cancel) -> Result<Option<SampledRun>, SimulationError> {
        let begun = Instant::now();
        let mut run = self.simulation();
        while begun.elapsed() < within && run.next_batch()?.is_some() {
            if cancel.is_cancelled() {
                return Ok(None);
            }
        }
        let progress = run.progress();
        let days = |span: Span| span.ratio(DAY);
        let (days, of_days) = (days(progress.done), days(progress.length));
        let is_judged = run.is_over() || days >= LEAST_DAYS;
        let differences = if is_judged { run.differences() } else { Vec::new() };
        Ok(Some(SampledRun { days, of_days, differences }))
    }
}
