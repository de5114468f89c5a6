//! The limits of a simulation for one answer.

use homebody_core::time::{DAY, RunTime, Span};
use homebody_simulation::{AdaptiveStep, Cancel, Simulation, StepError};
use std::time::{Duration, Instant};

/// Time of simulation without a check for other work (our choice).
pub const AT_ONCE: Duration = Duration::from_millis(20);

/// Time of simulation for one answer, and additional time for each of its days (our choice): many times what a home
/// takes.
const LONGEST_ANSWER: Duration = Duration::from_secs(5);
const LONGEST_ANSWER_A_DAY: Duration = Duration::from_millis(100);

/// Largest number of items in an answer (our choice).
const MOST_ENTRIES: usize = 200_000;

/// The budget for one answer.
pub struct SimulationBudget<'c> {
    cancel: &'c Cancel,
    started: Instant,
    simulated: Span,
}

/// Steps of at most this length, after which an answer is checked for its limits.
pub fn draft_steps(longest: Span) -> AdaptiveStep {
    AdaptiveStep::new(longest).within(AT_ONCE)
}

impl SimulationBudget<'_> {
    /// The budget for a request, until it is cancelled.
    pub fn new(cancel: &Cancel) -> SimulationBudget<'_> {
        SimulationBudget { cancel, started: Instant::now(), simulated: Span::ZERO }
    }

    /// The reason to simulate no further, as a sentence; `entries` is the size of the answer so far.
    pub fn check(&self, entries: usize) -> Result<(), String> {
        let days = u32::try_from(self.simulated / DAY).unwrap_or(u32::MAX);
        let longest = LONGEST_ANSWER + LONGEST_ANSWER_A_DAY.saturating_mul(days);
        if self.cancel.is_cancelled() {
            Err("The request was cancelled.".into())
        } else if entries > MOST_ENTRIES {
            Err(format!("The answer is limited to {MOST_ENTRIES} entries."))
        } else if self.started.elapsed() > longest {
            Err(format!("The simulation stopped here after {} seconds, because too much happens.", longest.as_secs()))
        } else {
            Ok(())
        }
    }

    /// Simulates a step, at most until an instant.
    pub fn step(&mut self, run: &mut Simulation, until: RunTime) -> Result<(), StepError> {
        let begin = run.now();
        let stepped = run.step(until);
        self.simulated += run.now() - begin;
        stepped
    }
}
