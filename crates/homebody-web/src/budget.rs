//! The budget of simulation for one answer, while a client waits for it.

use homebody_core::drivers::error::DriverError;
use homebody_core::event::Events;
use homebody_core::run::Run;
use homebody_core::time::{DAY, RunTime, Span};
use homebody_simulation::{AdaptiveStep, Cancel};
use std::time::{Duration, Instant};

/// Time of simulation without a check for other work (our choice).
pub const AT_ONCE: Duration = Duration::from_millis(20);

/// Time of simulation for one answer, and additional time for each of its days (our choice): many times what a home
/// takes.
const LONGEST_ANSWER: Duration = Duration::from_secs(5);
const LONGEST_ANSWER_A_DAY: Duration = Duration::from_millis(100);

/// Largest number of items in an answer (our choice).
const MOST_TOLD: usize = 200_000;

pub struct SimulationBudget<'c> {
    step: AdaptiveStep,
    cancel: &'c Cancel,
    begun: Instant,
    lived: Span,
}

impl SimulationBudget<'_> {
    /// Until the request is cancelled, in steps of at most `longest`.
    pub fn new(cancel: &Cancel, longest: Span) -> SimulationBudget<'_> {
        let step = AdaptiveStep::new(longest).within(AT_ONCE);
        SimulationBudget { step, cancel, begun: Instant::now(), lived: Span::ZERO }
    }

    /// An error, in a sentence, if the simulation has to stop. `items` is the number of items in the answer so far.
    pub fn check(&self, items: usize) -> Result<(), String> {
        let days = u32::try_from(self.lived / DAY).unwrap_or(u32::MAX);
        let longest = LONGEST_ANSWER + LONGEST_ANSWER_A_DAY.saturating_mul(days);
        if self.cancel.is_cancelled() {
            Err("The request was cancelled.".into())
        } else if items > MOST_TOLD {
            Err(format!("The answer is limited to {MOST_TOLD} entries."))
        } else if self.begun.elapsed() > longest {
            Err(format!("The simulation stopped here after {} seconds, because too much happens.", longest.as_secs()))
        } else {
            Ok(())
        }
    }

    /// Simulates a step, at most until `until`, and adds its events.
    pub fn advance(&mut self, run: &mut Run, until: RunTime, events: &mut Events) -> Result<(), DriverError> {
        let begin = run.now();
        let lived = self.step.advance(run, until, events);
        self.lived += run.now() - begin;
        lived
    }
}
